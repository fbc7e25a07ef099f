//! `toile import`: makes a project of pattern and body files.

use crate::cli::arguments::Import;
use crate::cli::failure::Failure;
use crate::cli::input::{self, Content};
use crate::cli::output;
use crate::session::{Project, project_file};

/// Reads the files, prints what was found and writes the project.
pub fn import(arguments: &Import) -> Result<(), Failure> {
    let mut project = Project::default();
    let (mut patterns, mut bodies) = (0, 0);
    for path in &arguments.files {
        match input::content(path, arguments.input.body_file, arguments.input.scale)? {
            Content::Pattern(pattern) => {
                patterns += 1;
                input::take_pattern(&mut project, pattern);
            }
            Content::Body(body) => {
                bodies += 1;
                input::take_body(&mut project, path, body)?;
            }
            Content::Project(_) => {
                return Err(Failure::input(
                    path,
                    "this is a project already: import takes patterns and bodies",
                ));
            }
        }
    }
    if patterns > 1 || bodies > 1 {
        return Err(Failure::Usage("import takes at most one pattern and one body".to_owned()));
    }
    input::take_options(&mut project, &arguments.files[0], patterns > 0, &arguments.input)?;
    if let Some(words) = project.problem() {
        return Err(Failure::input(&arguments.files[0], words));
    }
    project_file::save(&arguments.output, &project)
        .map_err(|e| input::project_failure(&arguments.output, e))?;
    let document = &project.document;
    output::say(&format!(
        "{}: {} pieces, {} seams, {} pairs of marks, body: {}",
        arguments.output.display(),
        document.pattern.pieces.len(),
        document.pattern.seams.len(),
        document.marks.pairs().count(),
        document.body.name(),
    ));
    Ok(())
}
