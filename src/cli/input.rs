//! Loads a project from what is named on the command line.

use std::path::Path;
use std::sync::Arc;

use crate::body::Imported;
use crate::body::mannequin::Measurements;
use crate::cli::arguments::{BodyFile, InputOptions, SizeOptions};
use crate::cli::failure::Failure;
use crate::cli::files::{MANNEQUIN, is_sample, name_of, read, sample_name, table_of_sizes};
use crate::cli::{formats, output};
use crate::geometry::polygon::signed_area;
use crate::io::gltf;
use crate::io::pattern_formats::{self, PatternFormat};
use crate::io::scale::DrawingUnit;
use crate::io::sizes::{self, SizesError};
use crate::pattern::{Pattern, Piece};
use crate::session::body::{Body, surface_of};
use crate::session::carry::carried;
use crate::session::grading::grade;
use crate::session::placing::brought;
use crate::session::project_file::ProjectFileError;
use crate::session::samples::Sample;
use crate::session::{BodyChoice, Document, Project, marks_file, project_file};
use crate::wrap::suggest;

/// Largest number of triangles of the cloth of a project: each takes about a kilobyte while it is draped.
const MOST_TRIANGLES: f64 = 4e6;

/// The contents of a file, by its type.
pub enum Content {
    Project(Box<Project>),
    Pattern(Pattern),
    Body(Imported),
}

/// A loaded project, with the options applied.
pub struct Input {
    /// Name of the project, for messages and folders.
    pub name: String,
    pub project: Project,
    /// Files and samples that it was made from.
    pub files: Vec<String>,
    /// Whether it came from a project file, to which it can be saved.
    pub is_project_file: bool,
}

/// Loads the project, pattern or sample called `path` and applies `options`.
pub fn load(path: &Path, options: &InputOptions) -> Result<Input, Failure> {
    let (mut project, is_file) = match content(path, options.body_file, options.scale)? {
        Content::Project(project) => (*project, false),
        Content::Pattern(pattern) => {
            let mut project = Project::default();
            take_pattern(&mut project, pattern);
            (project, true)
        }
        Content::Body(_) => {
            return Err(Failure::input(
                path,
                "this is a body: name a pattern or project, and the body with --body",
            ));
        }
    };
    take_options(&mut project, path, is_file, options)?;
    if let Some(words) = project.problem() {
        return Err(Failure::input(path, words));
    }
    few_enough_triangles(path, &project.document)?;
    for (name, why) in project.document.artwork.unreadable() {
        let words = format!("the image {name:?} is shown as squares: {why}");
        output::complain(&format!("{}: note: {words}", path.display()));
    }
    let read = [&options.body, &options.sized.sizes, &options.marks];
    let named = std::iter::once(path).chain(read.into_iter().filter_map(Option::as_deref));
    let files = named.map(|p| p.display().to_string()).collect();
    let is_project_file = !is_file && !is_sample(path);
    Ok(Input { name: name_of(path), project, files, is_project_file })
}

/// Refuses an edge length that would give `document`, read from `path`, too many triangles. This is checked before any cloth is
/// triangulated.
fn few_enough_triangles(path: &Path, document: &Document) -> Result<(), Failure> {
    let edge_length = document.settings.edge_length;
    let area: f64 = document.pattern.pieces.values().map(|piece| piece_area(piece)).sum();
    // The area of an equilateral triangle is √3/4 times the square of its edge.
    let count = area / (edge_length * edge_length * 0.433);
    match count <= MOST_TRIANGLES {
        true => Ok(()),
        false => Err(Failure::Limit(format!(
            "{}: {area:.1} m² of cloth would be about {count:.0} triangles, at most {MOST_TRIANGLES} are cut: raise its edge length \
             of {edge_length} m (--edge-length)",
            path.display()
        ))),
    }
}

/// Area of the polygon through a piece's corners, m².
fn piece_area(piece: &Piece) -> f64 {
    let corners: Vec<_> = piece.outline.iter().map(|edge| edge.start).collect();
    signed_area(&corners).abs()
}

/// Reads `path` and determines its type by its contents.
pub fn content(path: &Path, how: BodyFile, scale: Option<DrawingUnit>) -> Result<Content, Failure> {
    if let Some(name) = sample_name(path) {
        return sample(path, name).map(|project| Content::Project(Box::new(project)));
    }
    let bytes = read(path)?;
    let is_called_project = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toile"));
    if is_called_project || project_file::is_project(&bytes) {
        return project_file::from_bytes(&bytes)
            .map(|project| Content::Project(Box::new(project)))
            .map_err(|e| project_failure(path, e));
    }
    let is_pattern = !gltf::is_gltf(&bytes)
        && (pattern_formats::format(&bytes).is_some() || (is_called_pattern(path) && bytes.contains(&0)));
    if bytes.trim_ascii().is_empty() || is_pattern {
        return formats::pattern(path, &bytes, scale).map(Content::Pattern);
    }
    formats::body(path, &bytes, how).map(Content::Body)
}

/// Whether the name of `path` ends like that of a pattern file.
fn is_called_pattern(path: &Path) -> bool {
    path.extension().and_then(|ending| PatternFormat::of_ending(ending.to_str()?)).is_some()
}

fn sample(path: &Path, name: &str) -> Result<Project, Failure> {
    let Some(sample) = Sample::named(name) else {
        let names = Sample::ALL.map(Sample::file_stem).join(", ");
        return Err(Failure::input(path, format!("there is no such sample; there are {names}")));
    };
    Ok(sample.usual())
}

/// The failure for an error of a project file at `path`.
pub fn project_failure(path: &Path, error: ProjectFileError) -> Failure {
    match error {
        ProjectFileError::File { path, source } => Failure::File { path, error: source },
        ProjectFileError::Contents(words) => Failure::input(path, words),
        ProjectFileError::TooLarge(words) => Failure::Limit(format!("{}: {words}", path.display())),
    }
}

/// Replaces the pattern; marks and cloth of the old one are removed.
pub fn take_pattern(project: &mut Project, pattern: Pattern) {
    project.document.pattern = Arc::new(pattern);
    project.document.marks = Arc::default();
    project.dressed = None;
}

/// Replaces the body. Marks are carried over to it, cloth is removed. A body that cannot carry cloth is refused.
pub fn take_body(project: &mut Project, path: &Path, body: Imported) -> Result<(), Failure> {
    if !body.is_usable() {
        let faults: Vec<&str> = body.problems.iter().map(|p| p.words.as_str()).collect();
        return Err(Failure::input(path, faults.join("; ")));
    }
    for note in &body.notes {
        output::complain(&format!("{}: note: {note}", path.display()));
    }
    set_body(project, path, BodyChoice::Imported { name: name_of(path), mesh: Arc::new(body.mesh) })
}

fn set_body(project: &mut Project, path: &Path, body: BodyChoice) -> Result<(), Failure> {
    let document = &mut project.document;
    if document.body == body {
        return Ok(());
    }
    if !document.marks.body.is_empty() {
        let to = Body::new(&body).map_err(|why| Failure::input(path, why))?;
        let from = Body::new(&document.body).ok();
        let (marks, lost) = carried(&document.marks, from.as_ref(), &to, body.name());
        document.marks = Arc::new(marks);
        for problem in lost {
            output::complain(&format!("{}: {}: {}", path.display(), problem.place, problem.words));
        }
    }
    document.body = body;
    (document.animations, document.moment) = (None, None);
    project.dressed = None;
    Ok(())
}

/// Applies `options` to `project`, read from `path`. `is_file`: the pattern is from a pattern file, whose placement was made for
/// another body.
pub fn take_options(
    project: &mut Project,
    path: &Path,
    is_file: bool,
    options: &InputOptions,
) -> Result<(), Failure> {
    let body_before = project.document.body.clone();
    if options.marks.is_some() || options.suggest_marks {
        // The marks of the option replace those of the project.
        project.document.marks = Arc::default();
    }
    if let Some(size) = &options.grade {
        take_size(project, path, size)?;
    }
    match &options.body {
        Some(body) if body == Path::new(MANNEQUIN) => set_body(project, body, BodyChoice::default())?,
        Some(body) => {
            let bytes = read(body)?;
            take_body(project, body, formats::body(body, &bytes, options.body_file)?)?;
            project.document.animations = formats::animations(body, &bytes, options.body_file)?;
        }
        None => {}
    }
    if let Some((table, measurements)) = sized(&options.sized)? {
        let body = BodyChoice::Mannequin(measurements);
        let posed = project.document.body.pose().and_then(|pose| body.posed(pose));
        set_body(project, table, posed.unwrap_or(body))?;
    }
    if let Some(by) = options.raise {
        raise(Arc::make_mut(&mut project.document.pattern), by)
            .map_err(|words| Failure::input(path, words))?;
    }
    if let Some(pose) = options.pose {
        let posed = project.document.body.in_named_pose(pose);
        let words = "its body is from a file: only the mannequin takes a pose by name";
        set_body(project, path, posed.ok_or_else(|| Failure::input(path, words))?)?;
    }
    // Marks determine the place of the cloth, so placements need not be adapted.
    let is_sewn =
        options.marks.is_none() && !options.suggest_marks && project.document.marks.cloth.is_empty();
    let is_brought = is_sewn && !options.as_placed;
    let for_others = is_file || project.document.body != body_before;
    if is_brought && for_others {
        bring(&mut project.document, None, path)?;
    }
    for over in &options.over {
        let mut outer = match content(over, options.body_file, options.scale)? {
            Content::Project(outer) => Arc::unwrap_or_clone(outer.document.pattern),
            Content::Pattern(outer) => outer,
            Content::Body(_) => return Err(Failure::input(over, "this is a body: it is named with --body")),
        };
        if let Some(by) = options.raise {
            raise(&mut outer, by).map_err(|words| Failure::input(over, words))?;
        }
        if is_brought {
            bring(&mut project.document, Some(&mut outer), over)?;
        }
        let pattern = &mut project.document.pattern;
        let worn = Arc::make_mut(pattern).wear_over(&outer, &name_of(over));
        worn.map_err(|words| Failure::input(over, words))?;
        project.dressed = None;
    }
    if let Some(edge_length) = options.edge_length {
        project.document.settings.edge_length = edge_length;
    }
    if let Some(marks) = &options.marks {
        let marks_read = marks_file::read(&read(marks)?, &project.document.pattern);
        project.document.take_marks(Arc::new(marks_read.map_err(|words| Failure::input(marks, words))?));
    }
    if options.suggest_marks {
        suggest_marks(project, path)?;
    }
    Ok(())
}

/// Takes the pattern of `project`, read from `path`, in the size called `size`; the cloth comes off.
fn take_size(project: &mut Project, path: &Path, size: &str) -> Result<(), Failure> {
    let before = Arc::clone(&project.document.pattern);
    let problems = grade(&mut project.document, size).map_err(|why| Failure::input(path, why))?;
    for problem in problems {
        output::complain(&format!("{}: {}: {}", path.display(), problem.place, problem.words));
    }
    if !Arc::ptr_eq(&before, &project.document.pattern) {
        project.dressed = None;
    }
    Ok(())
}

/// The chosen size, with the path of the table it is in.
pub fn sized(options: &SizeOptions) -> Result<Option<(&Path, Measurements)>, Failure> {
    let (Some(path), Some(name)) = (&options.sizes, &options.body_size) else { return Ok(None) };
    let size = sizes::read(&table_of_sizes(path)?).and_then(|sizes| sizes::chosen(&sizes, name)?.checked());
    let size = size.map_err(|error| match error {
        SizesError::OverLimit(words) => Failure::Limit(format!("{}: {words}", path.display())),
        error => Failure::input(path, error),
    });
    Ok(Some((path, size?)))
}

/// Moves all placed pieces up by `by` metres.
fn raise(pattern: &mut Pattern, by: f64) -> Result<(), String> {
    if !by.is_finite() {
        return Err("--raise takes a number of metres".to_owned());
    }
    let mut placed = false;
    for piece in pattern.pieces.values_mut().filter(|piece| piece.placement.is_some()) {
        if let Some(pose) = &mut Arc::make_mut(piece).placement {
            pose.translation.y += by;
            placed = true;
        }
    }
    match placed {
        true => Ok(()),
        false => Err("none of its pieces is placed in space: there is nothing to raise".to_owned()),
    }
}

/// Adapts the placement of the document's pattern, or of `other`, to the document's body, and prints what was moved.
fn bring(document: &mut Document, other: Option<&mut Pattern>, path: &Path) -> Result<(), Failure> {
    let body = Body::new(&document.body).map_err(|why| Failure::input(path, why))?;
    let moved = brought(other.as_deref().unwrap_or(&document.pattern), document, &body);
    if !moved.placements.is_empty() {
        moved.carry_out(other.unwrap_or_else(|| Arc::make_mut(&mut document.pattern)));
    }
    if !moved.words.is_empty() {
        let words = moved.words.join(", ");
        output::complain(&format!("{}: note: placed for another body: {words}", path.display()));
    }
    Ok(())
}

fn suggest_marks(project: &mut Project, path: &Path) -> Result<(), Failure> {
    let document = &mut project.document;
    let surface = surface_of(&document.body).map_err(|why| Failure::input(path, why))?;
    let offset = document.settings.relax.offset * surface.scale();
    let marks = suggest::suggested(&document.pattern, &surface, offset);
    if marks.pairs().next().is_none() {
        let words = "no marks can be proposed: none of its pieces is placed in front of or behind the body";
        return Err(Failure::input(path, words));
    }
    document.take_marks(Arc::new(marks));
    Ok(())
}
