//! Reading and writing of files for the window. Errors are messages for the user.

pub(in crate::ui) mod obj_sequence;
pub(in crate::ui) mod posed_motion;
pub(in crate::ui) mod recent;
pub(in crate::ui) mod thumbnails;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec3;

use crate::body::pose::motion::Clip;
use crate::body::{Unit, UpAxis, guess_unit, import};
use crate::geometry::mesh::TriMesh;
use crate::geometry::words::{Words, words};
use crate::io::body_file;
use crate::io::pattern_file::PatternFileError;
use crate::io::pattern_formats::{self, PatternFormat, endings};
use crate::io::pdf::Paper;
use crate::io::rul;
use crate::io::scale::{DrawingUnit, ScaleQuestion};
use crate::io::{FILE_BYTES, bvh, gltf};
use crate::marker::{FinishedMarker, MarkerFormat};
use crate::pattern::Pattern;
use crate::render::ImageLight;
use crate::session::project_file::ProjectFileError;
use crate::session::samples::Sample;
use crate::session::{
    AnimatedFile, Animations, BodyChoice, Command, Document, ImageFile, Project, project_file, whole_file,
};
use crate::sim::Snapshot;
use crate::ui::language::{said, say, tr};
use crate::ui::scenery::environment::light_of;
use crate::ui::scenery::worn::{self, Worn, WornFiles, WornOptions};

/// Extensions of the pattern formats that can be written.
const WRITTEN_ENDINGS: [&str; 4] = {
    let [a, b, c, d] = PatternFormat::ALL;
    [a.ending(), b.ending(), c.ending(), d.ending()]
};
/// Extensions of the pattern formats that can be read.
const READ_ENDINGS: [&str; 3] = {
    let [_, b, c, d] = PatternFormat::ALL;
    assert!(b.is_read() && c.is_read() && d.is_read());
    [b.ending(), c.ending(), d.ending()]
};

/// The purpose of a file dialog.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Open a project.
    Open,
    /// Save the project.
    Save,
    /// Save a copy of the project.
    Copy,
    /// Read a pattern.
    ImportPattern,
    /// Read a body.
    ImportBody,
    /// Read another pose of the body, or a motion.
    Pose,
    /// Read poses of the body in numbered files.
    Sequence,
    /// Read a table of sizes.
    Sizes,
    /// Read an image.
    Image,
    /// Write the dressed garment.
    Export,
    /// Write the pattern.
    ExportPattern,
    /// Write the recording.
    Recording,
    /// Write a picture of the body pane.
    Picture,
    /// Write a turntable (numbered pictures of a full turn).
    Turn,
    /// Write the fit report.
    FitPage,
    /// Write the tech pack.
    TechPack,
    /// Write the marker.
    Marker(MarkerFormat),
    /// Write the table of all sizes.
    AllSizes,
    /// Read another project, to compare with.
    Compare,
    /// Read an image of the surroundings, which lights the scene.
    Environment,
}

impl Purpose {
    /// Title of the dialog.
    pub fn title(self) -> &'static str {
        match self {
            Self::Open => "Open a project",
            Self::Save => "Save the project",
            Self::Copy => "Save a copy of the project",
            Self::ImportPattern => "Import a pattern",
            Self::ImportBody => "Import a body",
            Self::Pose => "Take a pose from a file",
            Self::Sequence => "Take a sequence of OBJ files: choose any one of them",
            Self::Sizes => "Read a table of sizes",
            Self::Image => "Take an image",
            Self::Export => "Export the dressed garment",
            Self::ExportPattern => "Export the pattern",
            Self::Recording => "Save the recording",
            Self::Picture => "Save a picture",
            Self::Turn => "Save a turn of pictures",
            Self::FitPage => "Write the fit report",
            Self::TechPack => "Write the tech pack",
            Self::Marker(_) => "Save the marker",
            Self::AllSizes => "Save the table of all sizes",
            Self::Compare => "Compare with another project",
            Self::Environment => "Choose an environment map",
        }
    }

    /// The kind of file in words, and its extensions.
    pub fn filter(self) -> (&'static str, &'static [&'static str]) {
        match self {
            Self::Open | Self::Save | Self::Copy | Self::Compare => ("Toile project", &["toile"]),
            Self::ImportPattern => ("Pattern", &READ_ENDINGS),
            Self::ExportPattern => ("Pattern", &WRITTEN_ENDINGS),
            Self::ImportBody => ("Body", &["obj", "glb", "gltf"]),
            Self::Pose => ("Body or motion", &["obj", "glb", "gltf", "bvh"]),
            Self::Sequence => ("Body", &["obj"]),
            Self::Sizes => ("Table of sizes", &["csv", "tsv", "txt"]),
            Self::Image => ("Image", &["png", "jpg", "jpeg"]),
            Self::Export => ("Garment", &worn::ENDINGS),
            Self::Recording => ("Recording", &["jsonl"]),
            Self::Picture | Self::Turn => ("Picture", &["png"]),
            Self::FitPage => ("Page", &["html"]),
            Self::TechPack => ("Document", &["pdf"]),
            Self::Marker(MarkerFormat::Pdf) => ("Marker", &["pdf"]),
            Self::Marker(MarkerFormat::Svg) => ("Marker", &["svg"]),
            Self::Marker(MarkerFormat::Dxf) => ("Marker", &["dxf"]),
            Self::AllSizes => ("Table", &["csv"]),
            Self::Environment => ("Environment map", &["hdr", "png", "jpg", "jpeg"]),
        }
    }

    /// Whether the purpose is to write a file.
    pub fn writes(self) -> bool {
        matches!(
            self,
            Self::Save
                | Self::Copy
                | Self::Export
                | Self::ExportPattern
                | Self::Recording
                | Self::Picture
                | Self::Turn
                | Self::FitPage
                | Self::TechPack
                | Self::Marker(_)
                | Self::AllSizes
        )
    }

    /// The suggested name of a new file.
    pub fn default_name(self) -> String {
        let stem = match self {
            Self::Recording => "recording",
            Self::Export => "garment",
            Self::ExportPattern => "pattern",
            Self::Picture => "picture",
            Self::Turn => "turn",
            Self::FitPage => "fit",
            Self::TechPack => "techpack",
            Self::Marker(_) => "marker",
            Self::AllSizes => "sizes",
            _ => "untitled",
        };
        format!("{stem}.{}", self.filter().1[0])
    }
}

/// Properties of a file that tell whether another program has changed it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OnDisk {
    bytes: u64,
    modified: Option<std::time::SystemTime>,
}

impl OnDisk {
    /// The properties of the file at `path`; None if it does not exist.
    pub fn of(path: &Path) -> Option<Self> {
        let file = std::fs::metadata(path).ok()?;
        Some(Self { bytes: file.len(), modified: file.modified().ok() })
    }
}

/// Reads a project.
pub fn open(path: &Path) -> Result<Project, String> {
    project_file::open(path).map_err(|e| in_words(path, Deed::Open, &reason(&e)))
}

/// Writes a project.
pub fn save(path: &Path, project: &Project) -> Result<(), String> {
    project_file::save(path, project).map_err(|e| in_words(path, Deed::Save, &reason(&e)))
}

/// Writes a project over a write-protected file.
pub fn save_over(path: &Path, project: &Project) -> Result<(), String> {
    project_file::save_over(path, project).map_err(|e| in_words(path, Deed::Save, &reason(&e)))
}

/// Writes a file atomically: whole or not at all.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), String> {
    whole_file::write(path, bytes).map_err(|e| in_words(path, Deed::Write, &whole_file::words(&e)))
}

/// The result of importing a pattern.
#[derive(Debug)]
pub enum PatternImport {
    /// The command that replaces the pattern, and notes for the user.
    Pattern(Command, Vec<Words>),
    /// A question: the file does not state its unit of length.
    Question(ScaleQuestion),
}

/// Reads a pattern. `unit` is the user's answer to the question about the unit of length.
pub fn import_pattern(path: &Path, unit: Option<DrawingUnit>) -> Result<PatternImport, String> {
    let rules = rules_beside(path)?;
    match pattern_formats::read_with_rules(&read(path)?, unit, rules.as_deref()) {
        Ok(read) => {
            let pattern = Arc::new(read.pattern);
            let command = Command::ReplacePattern { name: stem(path), pattern, marks: Arc::default() };
            Ok(PatternImport::Pattern(command, read.notes))
        }
        Err(PatternFileError::Scale(question)) => Ok(PatternImport::Question(question)),
        Err(error) => Err(in_words(path, Deed::Import, &error.words())),
    }
}

/// The grade rule table beside a DXF, if there is one.
fn rules_beside(path: &Path) -> Result<Option<Vec<u8>>, String> {
    let mut names = rul::names_beside(path).into_iter();
    names.find(|name| name.is_file()).map(|name| read(&name)).transpose()
}

/// Writes `pattern` in the format of the file's extension; `paper` is for PDF. Returns what the format cannot hold.
pub fn export_pattern(path: &Path, pattern: &Pattern, paper: Paper) -> Result<Vec<Words>, String> {
    let ending = path.extension().unwrap_or_default().to_string_lossy();
    let Some(format) = PatternFormat::of_ending(&ending) else {
        let words = words!("the name must end in {endings}", endings = endings(PatternFormat::ALL));
        return Err(in_words(path, Deed::Write, &words));
    };
    let written = pattern_formats::write(format, pattern, &stem(path), paper);
    let written = written.map_err(|e| in_words(path, Deed::Write, &e.words()))?;
    match written.rules {
        Some(rules) => {
            let files = [(path.to_owned(), written.bytes), (path.with_extension(rul::ENDING), rules)];
            write_together(&files)?;
        }
        None => write(path, &written.bytes)?,
    }
    Ok(written.left_out)
}

/// Writes a marker; `paper` is for PDF.
pub fn write_marker(
    path: &Path,
    made: &FinishedMarker,
    format: MarkerFormat,
    paper: Paper,
) -> Result<(), String> {
    let bytes = made.file(format, paper).map_err(|e| in_words(path, Deed::Write, &e.words()))?;
    write(path, &bytes)
}

/// A body as read from a file, before its unit and up axis are settled.
#[derive(Clone, Debug)]
pub struct RawBody {
    /// Name for the user.
    pub name: String,
    /// The mesh in the file's unit and axes.
    pub mesh: TriMesh,
    /// Sides of its bounding box, in the file's unit.
    pub size: DVec3,
    /// The axis that points up in the file.
    pub up: UpAxis,
    /// The guessed unit.
    pub unit: Unit,
    /// Whether the user must confirm the unit and axis: there is no guess, or not the usual one.
    pub is_doubtful: bool,
    /// The file's contents, if it has animations.
    animated: Option<Box<AnimatedFile>>,
}

/// Reads a body and guesses its unit and up axis.
pub fn read_body(path: &Path) -> Result<RawBody, String> {
    let (bytes, name) = (read(path)?, stem(path));
    let mut animated = None;
    let mesh = if gltf::is_gltf(&bytes) {
        let read = body_file::model_with_buffers(path, &bytes, &read);
        let (model, buffers) = read.map_err(|e| in_words(path, Deed::Import, e.words()))?;
        if model.animations().next().is_some() {
            let (up, unit, name) = (UpAxis::default(), Unit::default(), name.clone());
            animated = Some(Box::new(AnimatedFile { name, bytes, buffers, up, unit }));
        }
        model.mesh()
    } else {
        body_file::read(path, &bytes, &read).map_err(|e| in_words(path, Deed::Import, e.words()))?
    };
    let (lower, upper) = mesh.bounds();
    let size = upper - lower;
    let up = UpAxis::guess(size);
    let guess = guess_unit(up.height(size));
    let is_doubtful = guess != Some(Unit::Metre) || up != UpAxis::Y;
    Ok(RawBody { name, mesh, size, up, unit: guess.unwrap_or_default(), is_doubtful, animated })
}

impl RawBody {
    /// Height of the body if lengths are in `unit`, metres.
    pub fn height(&self, unit: Unit) -> f64 {
        self.up.height(self.size) * unit.metres()
    }

    /// Takes the user's answer for an earlier file, if it gives the body a plausible height.
    pub fn answered_before(&mut self, before: Option<(Unit, UpAxis)>) {
        if let Some((unit, up)) = before
            && guess_unit(up.height(self.size) * unit.metres() / Unit::Metre.metres()) == Some(Unit::Metre)
        {
            (self.unit, self.up) = (unit, up);
        }
    }
}

/// A pose read from a file.
pub enum PoseFile {
    /// A pose of the body, or animations of it.
    Body(Command),
    /// A captured motion (BVH).
    Motion(Clip),
}

/// Reads a pose of the body whose mesh is `dressed` (the same triangles in other positions, in the unit that gives them the same
/// edge lengths), or a captured motion.
pub fn read_pose(path: &Path, dressed: &TriMesh) -> Result<PoseFile, String> {
    let bytes = read(path)?;
    if bvh::is_bvh(&bytes) {
        let read = bvh::read(&bytes).map(PoseFile::Motion);
        return read.map_err(|e| in_words(path, Deed::Read, &e.words()));
    }
    let raw = RawBody { up: UpAxis::Y, ..read_body(path)? };
    let raw = RawBody { unit: unit_like(dressed, &raw.mesh), ..raw };
    Ok(PoseFile::Body(match animations(&raw)? {
        Some(animations) => Command::TakeAnimations { animations },
        None => Command::AimPose { body: imported(raw)?.0 },
    }))
}

/// The unit in which the triangles of `raw` have the edge lengths of those of `dressed`.
pub(in crate::ui) fn unit_like(dressed: &TriMesh, raw: &TriMesh) -> Unit {
    let sides = |mesh: &TriMesh| {
        let sides = (0..mesh.triangles.len()).map(|t| mesh.corners(t)).map(|[a, b, _]| a.distance(b));
        sides.sum::<f64>() / mesh.triangles.len().max(1) as f64
    };
    let metres = sides(dressed) / sides(raw);
    let far = |unit: &Unit| (unit.metres() / metres).ln().abs();
    Unit::ALL.into_iter().min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or_default()
}

/// The command that replaces the body by `raw`, and notes on what was corrected.
pub fn take_body(raw: RawBody) -> Result<(Command, Vec<Words>), String> {
    let animations = animations(&raw)?;
    let (body, notes) = imported(raw)?;
    Ok((Command::SetBody { body, animations }, notes))
}

/// The animations of `raw`, if it has any.
fn animations(raw: &RawBody) -> Result<Option<Arc<Animations>>, String> {
    let Some(file) = raw.animated.as_deref() else { return Ok(None) };
    let animations = Animations::new(AnimatedFile { up: raw.up, unit: raw.unit, ..file.clone() });
    let (animations, _) = animations.map_err(|why| said(&why))?;
    Ok(Some(Arc::new(animations)))
}

fn imported(mut raw: RawBody) -> Result<(BodyChoice, Vec<Words>), String> {
    raw.up.set_upright(&mut raw.mesh);
    let imported = import(raw.mesh, raw.unit);
    if !imported.is_usable() {
        let faults: Vec<String> = imported.problems.iter().map(|p| said(&p.words)).collect();
        let why = faults.join("; ");
        return Err(say!("{name} cannot be used as a body: {why}", name = raw.name, why));
    }
    let body = BodyChoice::Imported { name: raw.name, mesh: Arc::new(imported.mesh) };
    Ok((body, imported.notes))
}

/// The command that takes the image at `path` into the document.
pub fn take_image(path: &Path) -> Result<Command, String> {
    let name = path.file_name().map_or_else(|| "image".into(), |name| name.to_string_lossy());
    let file = ImageFile::new(name, read(path)?);
    file.picture().map_err(|why| in_words(path, Deed::Take, why))?;
    Ok(Command::AddImage { file: Arc::new(file) })
}

/// Light from all sides out of the image at `path`.
pub fn read_environment(path: &Path) -> Result<ImageLight, String> {
    light_of(&read(path)?).map_err(|why| in_words(path, Deed::Read, &why))
}

/// The files of the dressed garment of `snapshot` with its trims and textures: as .obj with files beside it, as .glb or USD
/// together with its body. `pattern` gives the texture coordinates.
pub fn exported(
    path: &Path,
    snapshot: &Snapshot,
    pattern: &Pattern,
    document: &Document,
) -> Result<WornFiles, String> {
    let Some((garment, cloth)) = snapshot.drawn().filter(|_| snapshot.is_dressed()) else {
        return Err(tr("There is no cloth on the body to be written").to_owned());
    };
    let worn = Worn { garment, cloth, pattern, document };
    let body = snapshot.body.as_ref().map(|b| &b.mesh);
    worn.files(WornOptions::default(), body, path).map_err(|why| in_words(path, Deed::Write, &why))
}

/// Writes files, all or none of them.
pub fn write_together(files: &[(PathBuf, Vec<u8>)]) -> Result<(), String> {
    match files {
        [(path, bytes)] => write(path, bytes),
        _ => whole_file::write_together(files)
            .map_err(|(path, e)| in_words(&path, Deed::Write, &whole_file::words(&e))),
    }
}

/// The names of the files beside the first of `files` that are there already and would be lost.
pub fn there_beside(files: &[(PathBuf, Vec<u8>)]) -> Vec<String> {
    let others = files.iter().skip(1).filter(|(path, _)| path.exists());
    others.map(|(path, _)| name_of(path)).collect()
}

/// The project of a sample on the body that it is made for.
pub fn sample(sample: Sample) -> Project {
    sample.usual()
}

/// The command that restores the built-in figure.
pub fn use_mannequin() -> Command {
    Command::SetBody { body: BodyChoice::default(), animations: None }
}

/// Reads the whole file at `path`. The error is a message.
pub fn read(path: &Path) -> Result<Vec<u8>, String> {
    whole_file::read(path, FILE_BYTES).map_err(|e| in_words(path, Deed::Read, &whole_file::words(&e)))
}

/// The next version of a file name that does not exist yet: "shirt-2.toile" for "shirt.toile", "shirt-8.toile" for
/// "shirt-7.toile".
pub fn next_version(path: &Path) -> PathBuf {
    let name = stem(path);
    let (base, number) = match name.rsplit_once('-') {
        Some((base, digits)) if !base.is_empty() && digits.len() < 9 => match digits.parse::<u32>() {
            Ok(number) => (base.to_owned(), number),
            Err(_) => (name.clone(), 1),
        },
        _ => (name.clone(), 1),
    };
    let named = |number: u32| path.with_file_name(format!("{base}-{number}.toile"));
    let mut next = number + 1;
    while named(next).exists() {
        next += 1;
    }
    named(next)
}

/// The name of a file without its extension.
pub fn stem(path: &Path) -> String {
    path.file_stem().map_or_else(|| "file".to_owned(), |n| n.to_string_lossy().into_owned())
}

/// The message of an error without the file's name, which is given before it.
fn reason(error: &ProjectFileError) -> Words {
    match error {
        ProjectFileError::File { source, .. } => whole_file::words(source),
        other => other.words(),
    }
}

/// What was to be done with a file.
#[derive(Clone, Copy, Debug)]
enum Deed {
    Open,
    Save,
    Write,
    Import,
    Read,
    Take,
}

/// The name of a file, for people.
pub fn name_of(path: &Path) -> String {
    path.file_name().map_or_else(|| path.display().to_string(), |name| name.to_string_lossy().into_owned())
}

fn in_words(path: &Path, deed: Deed, why: &Words) -> String {
    let why = said(why);
    let name = name_of(path);
    match deed {
        Deed::Open => say!("{name} could not be opened: {why}", name, why),
        Deed::Save => say!("{name} could not be saved: {why}", name, why),
        Deed::Write => say!("{name} could not be written: {why}", name, why),
        Deed::Import => say!("{name} could not be imported: {why}", name, why),
        Deed::Read => say!("{name} could not be read: {why}", name, why),
        Deed::Take => say!("{name} could not be taken: {why}", name, why),
    }
}
