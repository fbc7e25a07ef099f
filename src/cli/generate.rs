//! `toile generate`: drafts random garments as patterns for the mannequin in six sizes.

use std::path::Path;
use std::sync::Arc;

use serde::Serialize;

use crate::body::NamedPose;
use crate::cli::arguments::Generate;
use crate::cli::failure::Failure;
use crate::cli::{interrupt, output};
use crate::draft::{self, BodySize, Case, Corpus, Design, Form};
use crate::io::garmentcode;
use crate::pattern::Pattern;

/// File name of the table of sizes, written beside the patterns.
pub const SIZES_FILE: &str = "sizes.csv";

/// File name of the list for `dress --list`, written beside the patterns.
const LIST_FILE: &str = "list.jsonl";

/// A line of list.jsonl: a garment with the options that dress it.
#[derive(Serialize)]
struct Listed<'a> {
    project: &'a str,
    sizes: &'static str,
    body_size: &'a str,
    #[serde(skip_serializing_if = "Option::is_none")]
    pose: Option<&'a str>,
}

/// A line of corpus.jsonl, which describes one pattern.
#[derive(Serialize)]
struct Line<'a> {
    file: String,
    body_size: &'a str,
    pose: &'a str,
    #[serde(flatten)]
    design: &'a Design,
}

/// Writes the patterns of all chosen garments.
pub fn generate(arguments: &Generate) -> Result<(), Failure> {
    let corpus = arguments.corpus.corpus();
    let cases = corpus.cases(arguments.corpus.shard.unwrap_or_default());
    output::make_folder(&arguments.out)?;
    write_sizes(&arguments.out)?;
    let mut forms = Forms::default();
    let (mut lines, mut list) = (String::new(), String::new());
    for case in &cases {
        interrupt::check()?;
        let design = corpus.design(case);
        let mut pattern = forms.pattern(case, &design)?;
        if arguments.without_placement {
            pattern.pieces.values_mut().for_each(|piece| Arc::make_mut(piece).placement = None);
        }
        let file = format!("{}.json", case.name(&design));
        output::write(&arguments.out.join(&file), &garmentcode::write(&pattern).bytes)?;
        let (body_size, pose) = (case.size.name, case.pose.name());
        let own = (case.pose != NamedPose::A).then_some(pose);
        list += &json_line(&Listed { project: &file, sizes: SIZES_FILE, body_size, pose: own })?;
        lines += &json_line(&Line { file, body_size, pose, design: &design })?;
    }
    output::write(&arguments.out.join(LIST_FILE), list.as_bytes())?;
    output::write(&arguments.out.join("corpus.jsonl"), lines.as_bytes())?;
    output::say(&told(&corpus, cases.len(), &arguments.out));
    Ok(())
}

fn json_line(line: &impl Serialize) -> Result<String, Failure> {
    serde_json::to_string(line).map(|text| text + "\n").map_err(|e| Failure::Internal(e.to_string()))
}

fn told(corpus: &Corpus, cases: usize, folder: &Path) -> String {
    let Corpus { designs, sizes, poses, .. } = corpus;
    let (sizes, poses) = (sizes.len(), poses.len());
    format!(
        "{cases} patterns of {designs} designs for {sizes} bodies in {poses} poses: {}; dress one with --sizes {} \
         --body-size SIZE --pose POSE, all with --list {}",
        folder.display(),
        folder.join(SIZES_FILE).display(),
        folder.join(LIST_FILE).display()
    )
}

/// Writes the table of sizes to `folder`.
pub fn write_sizes(folder: &Path) -> Result<(), Failure> {
    output::write(&folder.join(SIZES_FILE), draft::ADULTS.csv().as_bytes())
}

/// Cache of measured bodies, by size and pose.
#[derive(Default)]
pub struct Forms(Vec<(BodySize, NamedPose, Form)>);

impl Forms {
    /// Drafts the pattern of a case.
    pub fn pattern(&mut self, case: &Case, design: &Design) -> Result<Pattern, Failure> {
        let known = self.0.iter().position(|(size, pose, _)| *size == case.size && *pose == case.pose);
        let number = match known {
            Some(number) => number,
            None => {
                let form = Form::new(&case.size.measurements(), case.pose);
                let form = form.map_err(|e| Failure::Internal(format!("size {}: {e}", case.size.name)))?;
                self.0.push((case.size, case.pose, form));
                self.0.len() - 1
            }
        };
        Ok(design.drafted(&self.0[number].2))
    }
}
