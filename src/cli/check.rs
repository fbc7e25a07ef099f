//! `toile check`: lists what is wrong with a project, pattern or body file.

use std::path::Path;

use serde::Serialize;

use crate::cli::arguments::Check;
use crate::cli::failure::Failure;
use crate::cli::input::{self, Content};
use crate::cli::output;
use crate::cli::report::PairLengths;
use crate::cloth;
use crate::geometry::words::{Words, words};
use crate::pattern::{Problem, ProblemKind};
use crate::session::{Project, body};

#[derive(Default, Serialize)]
struct Findings {
    pieces: usize,
    seams: usize,
    triangles: usize,
    /// Lengths of each pair of marks, where there is a body.
    marks: Vec<PairLengths>,
    problems: Vec<Problem>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    notes: Vec<String>,
}

/// Prints what was found. The check fails if there are problems other than notes.
pub fn check(arguments: &Check) -> Result<(), Failure> {
    let findings = match input::content(&arguments.file, arguments.input.body_file, arguments.input.scale)? {
        Content::Body(body) => {
            let triangles = body.mesh.triangles.len();
            let notes = body.notes.into_iter().map(String::from).collect();
            Findings { triangles, problems: body.problems, notes, ..Findings::default() }
        }
        Content::Pattern(pattern) => {
            let mut project = Project::default();
            input::take_pattern(&mut project, pattern);
            input::take_options(&mut project, &arguments.file, false, &arguments.input)?;
            let options = &arguments.input;
            of_project(&project, options.body.is_some() || options.sized.sizes.is_some())
        }
        Content::Project(mut project) => {
            input::take_options(&mut project, &arguments.file, false, &arguments.input)?;
            of_project(&project, true)
        }
    };
    tell(&findings, &arguments.file, arguments.json)?;
    match findings.problems.iter().filter(|p| !p.kind.is_note()).count() {
        0 => Ok(()),
        1 => Err(Failure::Check("1 problem".to_owned())),
        count => Err(Failure::Check(format!("{count} problems"))),
    }
}

fn of_project(project: &Project, with_body: bool) -> Findings {
    let document = &project.document;
    let (garment, mut problems) = cloth::build(&document.pattern, document.settings.edge_length);
    let mut marks = Vec::new();
    if with_body || document.marks.pairs().next().is_some() {
        match body::surface_of(&document.body) {
            Ok(surface) => marks = PairLengths::all(document, &surface),
            Err(why) => {
                let place = Words::plain(document.body.name());
                problems.push(Problem { kind: ProblemKind::Body, place, words: why.0 });
            }
        }
    }
    problems.extend(lonely_marks(project));
    Findings {
        pieces: document.pattern.pieces.len(),
        seams: document.pattern.seams.len(),
        triangles: garment.triangles.len(),
        notes: marks.iter().filter_map(PairLengths::doubt).collect(),
        marks,
        problems,
    }
}

fn lonely_marks(project: &Project) -> Option<Problem> {
    let marks = &project.document.marks;
    let (cloth, body) = (marks.cloth.len(), marks.body.len());
    (cloth != body).then(|| Problem {
        kind: ProblemKind::Mark,
        place: words!("mark {n}", n = cloth.min(body) + 1),
        words: words!(
            "{cloth} strokes on the cloth and {body} on the body: the last have no partner",
            cloth,
            body
        ),
    })
}

fn tell(findings: &Findings, path: &Path, json: bool) -> Result<(), Failure> {
    if json {
        let text = serde_json::to_string_pretty(findings).map_err(|e| Failure::Internal(e.to_string()))?;
        output::say(&text);
        return Ok(());
    }
    let Findings { pieces, seams, triangles, marks, problems, notes } = findings;
    output::say(&format!("{}: {pieces} pieces, {seams} seams, {triangles} triangles", path.display()));
    for pair in marks {
        output::say(&pair.to_string());
    }
    for problem in problems {
        let note = if problem.kind.is_note() { "note: " } else { "" };
        output::say(&format!("{note}{}: {}", problem.place, problem.words));
    }
    for note in notes {
        output::say(&format!("note: {note}"));
    }
    Ok(())
}
