//! The command line arguments. Doc comments of options and commands are their help texts.

mod bench;
mod install;
mod marker;
mod picture;
mod report;
mod techpack;

use std::ops::Range;
use std::path::{Path, PathBuf};

use clap::{ArgGroup, Args, Parser, Subcommand};

use crate::body::pose::anatomy::JointAngle;
use crate::body::{NamedPose, Unit, UpAxis};
pub use crate::cli::arguments::bench::{Bench, BenchKind, CorpusOptions, TrustOptions};
pub use crate::cli::arguments::install::{Completions, Man};
pub use crate::cli::arguments::marker::Marker;
pub use crate::cli::arguments::picture::{LensOptions, PictureOptions};
use crate::cli::arguments::picture::{rotation, size, view};
pub use crate::cli::arguments::report::{Merge, Report, ReportTask};
pub use crate::cli::arguments::techpack::TechPack;
use crate::cli::cloth_options::ClothOptions;
use crate::cli::texture_options::TextureOptions;
use crate::cloth::Skips;
use crate::draft::Shard;
use crate::fit::MapKind;
use crate::io::pdf::Paper;
use crate::io::scale::DrawingUnit;
use crate::render::View;
use crate::session::document::EDGE_LENGTHS;
use crate::sim::Start;

/// Dress a body in cloth: draw and sew flat pieces, paint marks, press Wrap.
///
/// Exit codes: 0 done, 1 a check failed, 2 usage, 3 bad input, 4 over a limit, 5 no graphics, 6 file error, 70 internal
/// error, 130/143 stopped by a signal.
#[derive(Debug, Parser)]
#[command(name = "toile", version, args_conflicts_with_subcommands = true, disable_help_subcommand = true)]
pub struct Arguments {
    /// Opens the editor on this project, pattern or sample (sample:NAME); without one, on the start page
    pub project: Option<PathBuf>,
    /// Writes everything done to this file as it happens
    #[arg(long, value_name = "FILE")]
    pub record: Option<PathBuf>,
    #[command(subcommand)]
    pub task: Option<Task>,
}

/// What can be done without a window.
#[derive(Debug, Subcommand)]
pub enum Task {
    Dress(Dress),
    Replay(Replay),
    Render(Render),
    Import(Import),
    Export(Export),
    Check(Check),
    Measure(Measure),
    Simulate(Simulate),
    Repose(Repose),
    Sizes(Sizes),
    Marker(Marker),
    #[command(name = "techpack")]
    TechPack(TechPack),
    Fit(Fit),
    Compare(Compare),
    Generate(Generate),
    Report(Report),
    Bench(Bench),
    Help(Help),
    Completions(Completions),
    Man(Man),
}

/// The manual: what the program does, topic by topic
#[derive(Debug, Args)]
pub struct Help {
    /// A topic or a command; without one, the topics are listed
    pub topic: Option<String>,
}

/// Default limit of ticks: a simulation that is not at rest by then oscillates and will not get there.
const MAX_TICKS: u64 = 20_000;

/// Options for reading a body file.
#[derive(Clone, Copy, Debug, Default, Args)]
pub struct BodyFile {
    /// The unit of body files: m, dm, cm, mm or in; if left out, it is guessed from the body's height
    #[arg(long)]
    pub unit: Option<Unit>,
    /// The axis of body files and motions that points up: y or z; if left out, y, or for a motion the one its skeleton suggests
    #[arg(long, value_name = "AXIS")]
    pub up: Option<UpAxis>,
}

/// Options that choose a size from a size table.
#[derive(Clone, Debug, Default, Args)]
pub struct SizeOptions {
    /// A table of sizes (CSV): a row for each size, its name in the first column, and a measurement of the mannequin in each
    /// other column, in cm or the unit that the column's title names; measurements that it leaves out are in proportion. Built in
    /// are sizes:adults (xs to xxl) and sizes:children (98 to 164)
    #[arg(long, value_name = "CSV", requires = "body_size")]
    pub sizes: Option<PathBuf>,
    /// Takes the mannequin in the size of this name in the table of --sizes, which may be sizes:adults
    #[arg(long, value_name = "NAME", requires = "sizes")]
    pub body_size: Option<String>,
}

/// Options that add to or change the project that is read.
#[derive(Clone, Debug, Default, Args)]
pub struct InputOptions {
    /// Puts the cloth on this body (OBJ, glTF); "mannequin" is the built-in figure
    #[arg(long, value_name = "FILE", conflicts_with = "sizes")]
    pub body: Option<PathBuf>,
    #[command(flatten)]
    pub body_file: BodyFile,
    #[command(flatten)]
    pub sized: SizeOptions,
    /// Takes the pattern in this size of its run; marks and graphics on it go along
    #[arg(long, value_name = "SIZE")]
    pub grade: Option<String>,
    /// Puts the mannequin in this pose, bare: a, t, standing, walking, running, sitting, arms-up or kung-fu; marks move with it,
    /// cloth comes off
    #[arg(long, value_name = "NAME")]
    pub pose: Option<NamedPose>,
    /// Wears the pattern of this file over it, and over those named before, each on a layer of its own
    #[arg(long, value_name = "PROJECT")]
    pub over: Vec<PathBuf>,
    /// Moves its placed pieces up by this height, metres: for files whose heights do not count from the floor
    #[arg(long, value_name = "METRES", allow_negative_numbers = true)]
    pub raise: Option<f64>,
    /// Leaves pieces where the pattern file places them. Otherwise pieces that are sewn without marks are moved to the body where
    /// they are too high or low for it, or where sleeves are beside its arms
    #[arg(long)]
    pub as_placed: bool,
    /// The unit of a DXF or SVG pattern: mm, cm, m, in, px, px90 or pt; if left out, the one that the file states; if it states
    /// none, an error asks for it
    #[arg(long, value_name = "UNIT")]
    pub scale: Option<DrawingUnit>,
    /// Takes the marks from this JSON file
    #[arg(long, value_name = "FILE", conflicts_with = "suggest_marks")]
    pub marks: Option<PathBuf>,
    /// Proposes marks from the placement of the pieces in the pattern file
    #[arg(long)]
    pub suggest_marks: bool,
    /// Length of the triangles' edges, metres
    #[arg(long, value_name = "METRES", value_parser = edge_length, allow_negative_numbers = true)]
    pub edge_length: Option<f64>,
}

fn edge_length(text: &str) -> Result<f64, String> {
    let (least, most) = (EDGE_LENGTHS.start(), EDGE_LENGTHS.end());
    let length = text.parse().ok().filter(|length| EDGE_LENGTHS.contains(length));
    length.ok_or_else(|| format!("edges of triangles are {least} to {most} metres long"))
}

/// Wraps by the marks or, without any, by the best start (suggested marks, or sewn from where the pieces are placed; see
/// --start); relaxes to rest, and writes garment.obj, body.obj, report.json and view.png
///
/// Several projects are dressed one after the other: each gets a folder and, on standard output, a line with its result (with
/// --json an object). The exit code is the greatest that any of them would have had alone. After an interruption the folders of
/// those that were done are complete.
///
/// A line of a list is a path, or a JSON object: {"project": "shirt.json", "name": "0001", "body": "body.obj", "drape": true},
/// with any option of one garment by its name. The names of folders do not depend on --shard. What came of each garment is also
/// added, a line each, to lines.jsonl (lines-2-of-8.jsonl of shard 2/8) in the folder that is written to: see report merge.
#[derive(Clone, Debug, Args)]
pub struct Dress {
    /// Projects, patterns or samples (sample:NAME); several get a folder each
    #[arg(required_unless_present = "list", value_name = "PROJECT")]
    pub projects: Vec<PathBuf>,
    /// Also dresses the projects that this file names, one a line, relative to its own folder; lines that begin with # are
    /// skipped, lines that begin with { hold options of their own
    #[arg(long, value_name = "FILE")]
    pub list: Option<PathBuf>,
    /// Dresses only one part of the list, such as 2/8 for the second of eight: every eighth line
    #[arg(long, value_name = "PART/OF", requires = "list")]
    pub shard: Option<Shard>,
    /// The folder to write to
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    #[command(flatten)]
    pub input: InputOptions,
    /// How a pattern without marks is put on: marks (by suggested marks, then draped) or placement (sewn from where its pieces
    /// are placed); if left out, the first of these that ends without a fault. placement also ignores the marks of a project
    #[arg(long, value_name = "marks|placement", conflicts_with_all = ["marks", "suggest_marks"])]
    pub start: Option<Start>,
    /// Then drapes it by weight and fabric until it rests
    #[arg(long)]
    pub drape: bool,
    /// Drapes on the graphics card, with the same accuracy but other last digits on every kind of card; with =software on the
    /// processor's stand-in for one, to try it
    #[arg(long, value_name = "software", num_args = 0..=1, require_equals = true, default_missing_value = "hardware")]
    pub card: Option<CardKind>,
    #[command(flatten)]
    pub cloth: ClothOptions,
    /// Also writes the dressed project to this file
    #[arg(long, value_name = "PROJECT")]
    pub save: Option<PathBuf>,
    /// Also writes a recording to this file
    #[arg(long, value_name = "FILE")]
    pub record: Option<PathBuf>,
    /// Limit of ticks; a simulation that needs more is given up (exit code 4)
    #[arg(long, default_value_t = MAX_TICKS)]
    pub max_ticks: u64,
    #[command(flatten)]
    pub picture: PictureOptions,
    /// Leaves out view.png
    #[arg(long)]
    pub no_picture: bool,
    #[command(flatten)]
    pub work: WorkOptions,
    /// Skips projects whose result is already there, made from the same bytes with the same options and the same version of the
    /// program
    #[arg(long, conflicts_with_all = ["save", "record"])]
    pub resume: bool,
    /// Reports which of several projects has begun, even when standard error is no terminal
    #[arg(long)]
    pub progress: bool,
    /// Prints the report; for several projects, one line each
    #[arg(long)]
    pub json: bool,
    /// Number of threads; the result is the same
    #[arg(long)]
    pub threads: Option<usize>,
}

impl Dress {
    /// The arguments that dress `project` into `out`, with the default of every other option.
    pub fn sample(project: &Path, out: &Path) -> Self {
        Self {
            projects: vec![project.to_owned()],
            list: None,
            shard: None,
            out: out.to_owned(),
            input: InputOptions::default(),
            start: None,
            drape: false,
            card: None,
            cloth: ClothOptions::default(),
            save: None,
            record: None,
            max_ticks: MAX_TICKS,
            picture: PictureOptions::seen_from(View::ThreeQuarter),
            no_picture: false,
            work: WorkOptions::default(),
            resume: false,
            progress: false,
            json: false,
            threads: None,
        }
    }
}

/// What counts as a graphics card.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum CardKind {
    /// A device of its own or one beside the processor.
    Hardware,
    /// The driver's software, too.
    Software,
}

/// Options that switch off optimisations.
#[derive(Clone, Copy, Debug, Default, Args)]
pub struct WorkOptions {
    /// Does all the work that is usually skipped as unnecessary, for comparison: certificates, planes, triangles, faces,
    /// crossings, refactor, fine, edges, bones, walks, or all; several with commas
    #[arg(long, value_name = "NAME", default_value = "", hide_default_value = true, value_parser = skips)]
    pub no_skip: Skips,
}

fn skips(text: &str) -> Result<Skips, String> {
    if text.is_empty() { Ok(Skips::default()) } else { text.parse() }
}

/// Runs a recording, compares its hashes, and stops at the first difference
#[derive(Debug, Args)]
pub struct Replay {
    /// JSON lines, as written by --record or the window; demo:NAME for one that comes with the program
    pub recording: PathBuf,
    /// Writes the same files as dress to this folder
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Also writes the project as it is at the end to this file
    #[arg(long, value_name = "PROJECT")]
    pub save: Option<PathBuf>,
    #[command(flatten)]
    pub picture: PictureOptions,
    #[command(flatten)]
    pub work: WorkOptions,
    /// Prints the outcome as JSON
    #[arg(long)]
    pub json: bool,
    /// Number of threads; the result is the same
    #[arg(long)]
    pub threads: Option<usize>,
}

/// Moves any cloth mesh by physics: writes positions.f32 (start and every frame, vertices × 3, little-endian) and
/// simulate.json
#[derive(Debug, Args)]
pub struct Simulate {
    /// JSON: {"cloth": OBJ, "seconds": 2} and, each with a default, "pins": [0-based ids], "collider": OBJ or [OBJ per frame],
    /// "fabric": preset or object, "density_kg_per_m2", "gravity": [0, -9.81, 0], "fps": 60, "self_collision": false,
    /// "thickness_m", "strain": 0.01, "solver": "implicit" or "small_steps", "steps_per_frame": 1, "integrator": "bdf2",
    /// "membrane": "triangles" or "springs", "folds": [{"vertices": [ids along it], "angle_degrees", "strength": 0.02}],
    /// "elastics": [{"vertices": [ids], "ratio", "tension": 15}]
    pub scene: PathBuf,
    /// The folder to write to
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Number of threads; the result is the same
    #[arg(long)]
    pub threads: Option<usize>,
}

/// Carries the dressed garment of a project to its body in other poses, and writes the same files as dress
///
/// A project without dressed cloth is dressed first. The body of each pose has the triangles of the dressed one, vertex for
/// vertex. With several poses, each starts from the dressed one and gets its own folder.
#[derive(Debug, Args)]
#[command(group(ArgGroup::new("where").required(true).multiple(true)))]
pub struct Repose {
    /// Dressed project, as saved by dress --save; or a sample (sample:NAME)
    pub project: PathBuf,
    /// The body in another pose (OBJ, glTF); several times for several poses
    #[arg(long = "body", value_name = "FILE", group = "where")]
    pub bodies: Vec<PathBuf>,
    /// The mannequin in this pose: a, t, standing, walking, running, sitting, arms-up or kung-fu; several times for several
    #[arg(long = "pose", value_name = "NAME", group = "where")]
    pub poses: Vec<NamedPose>,
    /// The mannequin with this joint turned, in degrees from hanging arms, straight limbs: left_elbow=60,
    /// right_hip.abduction=20 (flexion, abduction or twist); several times for one pose of several joints, on top of the
    /// pose that --pose names, or of the one it is in
    #[arg(long = "joint", value_name = "JOINT=DEGREES", group = "where", allow_hyphen_values = true)]
    pub joints: Vec<JointAngle>,
    /// Joint angles in a JSON file: {"left_elbow": 60, "right_hip": {"flexion": 30, "abduction": 20}}; several times for several
    /// poses
    #[arg(long = "joints", value_name = "JSON", group = "where")]
    pub joint_files: Vec<PathBuf>,
    #[command(flatten)]
    pub body_file: BodyFile,
    /// Takes the bodies as the frames of a motion, each carried on from the one before, and writes garment_0000.obj and up,
    /// sequence.glb (body and garment, animated) and report.json; a body may be a folder of OBJ files, or "walk*.obj"
    #[arg(long, conflicts_with_all = ["poses", "joints", "joint_files", "settle", "save"])]
    pub sequence: bool,
    /// Takes the frames of a motion, and writes the same files as --sequence: motion capture (BVH) moves the mannequin, its
    /// joints found by name; glTF holds an animated body
    #[arg(long, value_name = "FILE", group = "where", conflicts_with_all = ["bodies", "poses", "joints", "joint_files", "settle", "save"])]
    pub motion: Option<PathBuf>,
    /// The animation in the glTF file, by its name or by its number from 1; if left out, the first
    #[arg(long, value_name = "NAME_OR_NUMBER", requires = "motion")]
    pub animation: Option<String>,
    /// Only these frames of the motion, counted from 0; the last one is not included
    #[arg(long, value_name = "FROM..TO", value_parser = frame_range)]
    pub frames: Option<Range<usize>>,
    /// Only every Nth of these frames
    #[arg(long, value_name = "COUNT", default_value_t = 1, value_parser = step)]
    pub every: usize,
    /// Frames a second of sequence.glb and sequence.usdz; if left out, those of the motion, or 30
    #[arg(long, value_parser = frame_rate)]
    pub fps: Option<f64>,
    /// Also writes sequence.usdz, the same as USD, with --sequence or --motion
    #[arg(long, conflicts_with_all = ["poses", "joints", "joint_files", "settle", "save"])]
    pub usd: bool,
    #[command(flatten)]
    pub textures: TextureOptions,
    /// The folder to write to
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Lets the cloth settle in each pose, with its weight and friction
    #[arg(long)]
    pub settle: bool,
    /// Drapes the cloth in each pose until it rests: skirts fall on to the lap of a sitting figure
    #[arg(long, conflicts_with = "sequence", conflicts_with = "motion")]
    pub drape: bool,
    /// Also writes the project in the pose to this file
    #[arg(long, value_name = "PROJECT")]
    pub save: Option<PathBuf>,
    /// Limit of ticks; a simulation that needs more is given up (exit code 4)
    #[arg(long, default_value_t = MAX_TICKS)]
    pub max_ticks: u64,
    #[command(flatten)]
    pub picture: PictureOptions,
    /// Prints the report
    #[arg(long)]
    pub json: bool,
    /// Number of threads; the result is the same
    #[arg(long)]
    pub threads: Option<usize>,
}

/// The help text of `--map`: the names of all maps.
fn map_names() -> String {
    let names = MapKind::ALL.map(MapKind::name).join(", ");
    format!("{names}; strain for the first four, or all; several times for several maps")
}

/// Reads maps off the dressed garment of a project: figures as JSON and CSV, pictures with their legend
///
/// Writes fit.json (range, statistics for the garment and each piece, histogram), and of each map NAME.csv (a row for each vertex
/// of each piece), NAME-triangles.csv and NAME.png. With --page it writes the fit report: views, girths with their ease, seams,
/// strain and maps on one self-contained page.
#[derive(Debug, Args)]
#[command(override_usage = "toile fit PROJECT --map NAME --out DIR\n       toile fit PROJECT --page FILE")]
pub struct Fit {
    /// Dressed project, as saved by dress --save or repose --save
    pub project: PathBuf,
    #[arg(long = "map", value_name = "NAME", help = map_names(), required_unless_present = "page", requires = "out", value_parser = maps)]
    pub maps: Vec<Maps>,
    /// The folder to write maps to
    #[arg(long, value_name = "DIR", requires = "maps")]
    pub out: Option<PathBuf>,
    /// Writes the fit report to this file (HTML)
    #[arg(long, value_name = "FILE")]
    pub page: Option<PathBuf>,
    /// The language of the fit report: en, de, or that of a table beside the preferences (toile help install)
    #[arg(long, value_name = "CODE", default_value = "en", requires = "page")]
    pub language: String,
    #[command(flatten)]
    pub picture: PictureOptions,
    /// Prints fit.json
    #[arg(long)]
    pub json: bool,
    /// Number of threads; the result is the same
    #[arg(long)]
    pub threads: Option<usize>,
}

/// A value of `--map`: one map, the four strain maps (`strain`), or all of them (`all`).
#[derive(Clone, Debug)]
pub struct Maps(pub Vec<MapKind>);

fn maps(text: &str) -> Result<Maps, String> {
    match text {
        "all" => Ok(Maps(MapKind::ALL.to_vec())),
        "strain" => Ok(Maps(vec![MapKind::Warp, MapKind::Weft, MapKind::Shear, MapKind::Area])),
        _ => text.parse().map(|kind| Maps(vec![kind])).map_err(|e: String| format!("{e}, strain, all")),
    }
}

/// Dresses every size of a graded pattern, and tells how each fits
///
/// With --sizes each size is put on the mannequin of the same name in the table; else all are put on one body, and the report says
/// which fits it best: the smallest that is dressed without a fault and nowhere tighter than the body. Writes a folder for each
/// size as dress does, with dressed.toile in it, and sizes.json, sizes.csv (strain; girths of body and pattern, ease) and sizes.png
/// (a map of each size side by side, in the same colours).
#[derive(Debug, Args)]
pub struct Sizes {
    /// Project whose pattern has a size run
    pub project: PathBuf,
    /// A table of sizes (CSV or built in, as for dress): a body for each size of the run, by its name
    #[arg(long, value_name = "CSV")]
    pub sizes: Option<PathBuf>,
    /// Puts all sizes on this body (OBJ, glTF); "mannequin" is the built-in figure; left out, on that of the project
    #[arg(long, value_name = "FILE", conflicts_with = "sizes")]
    pub body: Option<PathBuf>,
    #[command(flatten)]
    pub body_file: BodyFile,
    /// Dresses only this size; can be repeated
    #[arg(long, value_name = "SIZE")]
    pub only: Vec<String>,
    /// The folder to write to
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Puts the mannequin in this pose, as for dress
    #[arg(long, value_name = "NAME")]
    pub pose: Option<NamedPose>,
    /// How a pattern without marks is put on, as for dress: marks or placement
    #[arg(long, value_name = "marks|placement")]
    pub start: Option<Start>,
    /// Then drapes each size by weight and fabric until it rests
    #[arg(long)]
    pub drape: bool,
    #[command(flatten)]
    pub cloth: ClothOptions,
    /// The unit of a DXF or SVG pattern: mm, cm, m, in, px, px90 or pt
    #[arg(long, value_name = "UNIT")]
    pub scale: Option<DrawingUnit>,
    /// Length of the triangles' edges, metres
    #[arg(long, value_name = "METRES", value_parser = edge_length, allow_negative_numbers = true)]
    pub edge_length: Option<f64>,
    /// The map in sizes.png
    #[arg(long, value_name = "NAME", default_value = "ease")]
    pub map: MapKind,
    /// Limit of ticks for each size; one that needs more is not dressed
    #[arg(long, default_value_t = MAX_TICKS)]
    pub max_ticks: u64,
    #[command(flatten)]
    pub picture: PictureOptions,
    /// Leaves out all pictures
    #[arg(long)]
    pub no_picture: bool,
    /// Leaves sizes whose result is already there, made from the same bytes with the same options
    #[arg(long)]
    pub resume: bool,
    /// Prints sizes.json
    #[arg(long)]
    pub json: bool,
    /// Number of threads; the result is the same
    #[arg(long)]
    pub threads: Option<usize>,
}

/// Compares two dressed projects of the same pieces: other poses, sizes, fabrics or bodies
///
/// Writes compare.json (of each map the mean, the 99th percentile and the maximum of the difference for the garment and each
/// piece; areas, girths), pieces.csv, girths.csv, and of each map NAME.csv (a row for each vertex of each piece of the second)
/// and NAME.png: the first, the second, and the second less the first. Values are matched by their place in the pattern.
#[derive(Debug, Args)]
pub struct Compare {
    /// Dressed project, as saved by dress --save or repose --save
    pub first: PathBuf,
    /// Another one with the same pieces
    pub second: PathBuf,
    #[arg(long = "map", value_name = "NAME", help = map_names(), required = true, value_parser = maps)]
    pub maps: Vec<Maps>,
    /// The folder to write to
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// The view: front, back, left, right, top, below, three-quarter, or YAW,PITCH in degrees
    #[arg(long, default_value = "front", value_parser = view, allow_hyphen_values = true)]
    pub view: View,
    /// Width and height of each of the three pictures, in pixels
    #[arg(long, default_value = "800x800", value_parser = size)]
    pub size: [u32; 2],
    /// Prints compare.json
    #[arg(long)]
    pub json: bool,
    /// Number of threads; the result is the same
    #[arg(long)]
    pub threads: Option<usize>,
}

/// Draws a project as it is
#[derive(Debug, Args)]
pub struct Render {
    /// Project, pattern or sample (sample:NAME)
    pub project: PathBuf,
    #[command(flatten)]
    pub input: InputOptions,
    #[command(flatten)]
    pub cloth: ClothOptions,
    #[command(flatten)]
    pub picture: PictureOptions,
    /// Light from all sides out of an image of all directions (PNG, JPEG or Radiance HDR, equirectangular, twice as wide as high),
    /// its middle before the body; its mean brightness is set to the studio's, and its sun is the lamp; the lamp of --light stays if it
    /// has none
    #[arg(long, value_name = "IMAGE")]
    pub environment: Option<PathBuf>,
    /// Rotation of the environment about the vertical axis, 0 to 360 degrees, counter-clockwise as seen from above: at 90 its middle
    /// is to the left of the body
    #[arg(long, value_name = "DEGREES", requires = "environment", value_parser = rotation)]
    pub environment_rotation: Option<f32>,
    #[command(flatten)]
    pub lens: LensOptions,
    /// The picture (PNG)
    #[arg(short, long, value_name = "PNG")]
    pub output: PathBuf,
    /// Number of pictures in a full turn; they are numbered NAME-00.png and up
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u32).range(1..=3600))]
    pub turntable: Option<u32>,
}

/// Makes a project of pattern (GarmentCode JSON, DXF-AAMA/ASTM, SVG) and body (OBJ, glTF) files
#[derive(Debug, Args)]
pub struct Import {
    /// At most one pattern and one body
    #[arg(required = true, value_name = "FILE")]
    pub files: Vec<PathBuf>,
    /// The project to write
    #[arg(short, long, value_name = "PROJECT")]
    pub output: PathBuf,
    #[command(flatten)]
    pub input: InputOptions,
}

/// Writes the pattern as .json (GarmentCode), .dxf (AAMA/ASTM), .svg (1 unit = 1 mm) or .pdf (true size), or the dressed
/// cloth of a project as .obj (alone, its materials beside it), or with the body, materials and textures as .glb, .usda (the
/// textures beside it) or .usdz
#[derive(Debug, Args)]
pub struct Export {
    /// A project, a pattern or a sample (sample:NAME); for .obj, .glb, .usda and .usdz a dressed project; or a built-in table of
    /// sizes (sizes:adults, sizes:children), for .csv
    pub project: PathBuf,
    /// The file to write; its ending gives the format
    #[arg(short, long, visible_alias = "out", value_name = "FILE")]
    pub output: PathBuf,
    #[command(flatten)]
    pub cloth: ClothOptions,
    #[command(flatten)]
    pub textures: TextureOptions,
    /// The paper of a PDF: a4 or letter, to be glued together, or one large page
    #[arg(long, default_value_t, value_name = "a4|letter|one")]
    pub paper: Paper,
    /// The unit of a DXF or SVG pattern that is read: mm, cm, m, in, px, px90 or pt
    #[arg(long, value_name = "UNIT")]
    pub scale: Option<DrawingUnit>,
    /// Takes the pattern in this size of its run
    #[arg(long, value_name = "SIZE")]
    pub grade: Option<String>,
}

/// Says what is wrong with a project, pattern or body, in words
#[derive(Debug, Args)]
pub struct Check {
    /// Project, pattern, sample (sample:NAME) or body (OBJ, glTF)
    pub file: PathBuf,
    #[command(flatten)]
    pub input: InputOptions,
    /// Prints {pieces, seams, triangles, problems}
    #[arg(long)]
    pub json: bool,
}

/// Reads girths, heights, widths, depths, shoulders and arms off a standing human body
#[derive(Debug, Args)]
pub struct Measure {
    /// Body (OBJ, glTF), a project with its body, or mannequin
    #[arg(required_unless_present = "sizes")]
    pub file: Option<PathBuf>,
    #[command(flatten)]
    pub body_file: BodyFile,
    #[command(flatten)]
    pub sized: SizeOptions,
    /// Prints {body, readings: [{name, metres, height}]} in metres
    #[arg(long)]
    pub json: bool,
}

/// Drafts garments at random, each for bodies of six sizes with arms half up and level: a GarmentCode pattern for each,
/// placed round its body
///
/// Writes NUMBER-KIND-SIZE-POSE.json, sizes.csv (for --sizes), corpus.jsonl with a line for each pattern (its file, body, pose and
/// everything that was chosen about its cut), and list.jsonl, with which dress --list dresses them all. The same seed gives the
/// same bytes.
#[derive(Debug, Args)]
pub struct Generate {
    #[command(flatten)]
    pub corpus: CorpusOptions,
    /// The folder to write to
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Leaves out the placement of the pieces round the body
    #[arg(long)]
    pub without_placement: bool,
}

fn frame_range(text: &str) -> Result<Range<usize>, String> {
    let ends = text.split_once("..").and_then(|(from, to)| Some((from.parse().ok()?, to.parse().ok()?)));
    let range = ends.filter(|(from, to)| from < to).map(|(from, to)| from..to);
    range.ok_or_else(|| format!("{text:?} is not FROM..TO, the first less than the second"))
}

fn step(text: &str) -> Result<usize, String> {
    text.parse().ok().filter(|&n| n > 0).ok_or_else(|| format!("{text:?} is not a number from 1 on"))
}

fn frame_rate(text: &str) -> Result<f64, String> {
    let rate = text.parse::<f64>().ok().filter(|rate| (0.1..=1000.0).contains(rate));
    rate.ok_or_else(|| format!("{text:?} is not a number of frames a second from 0.1 to 1000"))
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_arguments_are_consistent() {
        Arguments::command().debug_assert();
    }
}
