//! Readers of files from elsewhere, followed by a little use: what is accepted is built, opened or replayed for a while, and must
//! be finite.

use std::path::Path;

use crate::body::mannequin::{Measurements, mannequin};
use crate::body::pose::motion::Retarget;
use crate::body::{Unit, UpAxis, import};
use crate::geometry::mesh::TriMesh;
use crate::io::moving_body::MovingBody;
use crate::io::{
    body_file, bvh, cloth_obj, dxf, environment, garmentcode, joints, pattern_formats, picture, rul, sizes,
    svg,
};
use crate::pattern::Pattern;
use crate::session::body::Body;
use crate::session::recording::Recording;
use crate::session::replay::Replay;
use crate::session::{BodyChoice, Command, Document, Project, Session, marks_file, project_file};
use crate::sim::{Runner, Simulation};
use crate::trust::structure::Form;
use crate::trust::ticks::go_on;
use crate::trust::{commands, good};

/// Edge length at which patterns are triangulated, metres: fine enough to show a fault, coarse enough to be fast.
const EDGE_LENGTH: f64 = 0.05;
/// Largest coordinate of patterns that are triangulated, metres: larger ones would take too long.
const WIDEST: f64 = 20.0;
/// Most steps of a recording that are replayed.
const MOST_STEPS: usize = 60;

/// Reads a file: Ok, or a message why it is refused.
pub type Read = Box<dyn Fn(&[u8]) -> Result<(), String>>;

/// A reader of files, with valid files for it.
pub struct Reader {
    /// Name of the format.
    pub name: &'static str,
    /// Structure of the format.
    pub form: Form,
    /// Valid files, at least one.
    pub good: Vec<Vec<u8>>,
    /// The function that reads a file.
    pub read: Read,
}

impl Reader {
    /// A reader with its valid files.
    pub fn new(
        name: &'static str,
        form: Form,
        good: Vec<Vec<u8>>,
        read: impl Fn(&[u8]) -> Result<(), String> + 'static,
    ) -> Self {
        Self { name, form, good, read: Box::new(read) }
    }
}

/// All readers.
pub fn readers() -> Vec<Reader> {
    let pattern = good::pattern();
    let (texts, binaries) = good::gltfs();
    let mut session = good::session();
    let packed = project_file::to_bytes(&session.project()).expect("a project");
    let plain = Document { pattern: pattern.clone().into(), ..Document::default() };
    let plain = project_file::to_bytes(&Project { document: plain, dressed: None }).expect("a project");
    let marks = marks_file::write(&good::project().document.marks, &pattern).expect("marks");
    // Warm-up: building the first mannequin takes as long as reading a thousand motions.
    mannequin(&Measurements::default()).expect("the usual one");
    let motions = good::MOTION.as_bytes().to_vec();
    vec![
        Reader::new("obj", Form::Text, good::objs(), body),
        Reader::new("cloth obj", Form::Text, good::cloths(), |bytes| {
            let cloth = cloth_obj::read(bytes).map_err(|e| e.to_string())?;
            assert_finite(&cloth.mesh);
            Ok(())
        }),
        Reader::new("gltf", Form::Json, texts, moving_body),
        Reader::new("glb", Form::Glb, binaries, moving_body),
        Reader::new("svg", Form::Text, vec![svg::write(&pattern).bytes], flat),
        Reader::new("dxf", Form::Tags, vec![dxf::write(&pattern).bytes], flat),
        Reader::new("garmentcode", Form::Json, vec![garmentcode::write(&pattern).bytes], flat),
        Reader::new("project", Form::Json, vec![plain], project),
        Reader::new("packed project", Form::Zip, vec![packed], project),
        Reader::new("recording", Form::Lines, vec![session.recording().into_bytes()], recording),
        Reader::new("marks", Form::Json, vec![marks.into_bytes()], move |bytes| {
            let mut project = good::project();
            project.document.take_marks(marks_file::read(bytes, &pattern)?.into());
            checked(&project)
        }),
        Reader::new("commands", Form::Json, commands::good(), commands::done),
        Reader::new("joints", Form::Json, vec![good::JOINTS.as_bytes().to_vec()], |bytes| {
            joints::read(bytes).map(drop).map_err(|e| e.to_string())
        }),
        Reader::new("sizes", Form::Text, vec![good::SIZES.as_bytes().to_vec()], |bytes| {
            let sizes = sizes::read(bytes).map_err(|e| e.to_string())?;
            sizes.iter().try_for_each(|size| size.checked().map(drop)).map_err(|e| e.to_string())
        }),
        Reader::new("grade rules", Form::Text, vec![good::rules()], |bytes| {
            rul::read(bytes).map(drop).map_err(|e| e.to_string())
        }),
        Reader::new("motion", Form::Text, vec![motions], motion),
        Reader::new("picture", Form::Bytes, vec![good::picture()], |bytes| {
            picture::read(bytes).map(drop).map_err(String::from)
        }),
        Reader::new("environment", Form::Bytes, vec![good::environment()], |bytes| {
            environment::read(bytes).map(drop).map_err(String::from)
        }),
    ]
}

fn assert_finite(mesh: &TriMesh) {
    assert!(mesh.positions.iter().all(|p| p.is_finite()), "a vertex is not a finite point");
    let count = mesh.positions.len();
    assert!(
        mesh.triangles.iter().flatten().all(|&v| (v as usize) < count),
        "a triangle names a vertex that is not there"
    );
}

fn no_file(_: &Path) -> Result<Vec<u8>, String> {
    Err("its buffer is not there".to_owned())
}

fn body(bytes: &[u8]) -> Result<(), String> {
    let mesh = body_file::read(Path::new("body.obj"), bytes, &no_file).map_err(|e| e.to_string())?;
    assert_finite(&mesh);
    imported(mesh)
}

fn imported(mesh: TriMesh) -> Result<(), String> {
    let body = import(mesh, Unit::Metre);
    if !body.is_usable() {
        let faults: Vec<&str> = body.problems.iter().map(|p| p.words.as_str()).collect();
        return Err(faults.join("; "));
    }
    assert_finite(&body.mesh);
    let choice = BodyChoice::Imported { name: "body".to_owned(), mesh: body.mesh.into() };
    Body::new(&choice).map(drop).map_err(|why| why.to_string())
}

fn moving_body(bytes: &[u8]) -> Result<(), String> {
    let model = body_file::model(Path::new("body.glb"), bytes, &no_file).map_err(|e| e.to_string())?;
    let (moving, body) = MovingBody::new(model, UpAxis::default(), Unit::Metre);
    for clip in 0..moving.animations().count() {
        for share in [0.0, 0.3, 1.0] {
            let seconds = moving.seconds(clip).unwrap_or_default() * share;
            let positions = moving.positions(Some((clip, seconds)));
            assert!(
                positions.iter().all(|p| p.is_finite()),
                "animation {clip} moves a vertex to no finite point"
            );
        }
    }
    imported(body.mesh)
}

fn flat(bytes: &[u8]) -> Result<(), String> {
    let read = pattern_formats::read(bytes, None).map_err(|e| e.to_string())?;
    checked(&Project {
        document: Document { pattern: read.pattern.into(), ..Document::default() },
        dressed: None,
    })
}

fn checked(project: &Project) -> Result<(), String> {
    project.problem().map_or(Ok(()), Err)?;
    built(&project.document.pattern);
    Ok(())
}

/// Triangulates and sews a pattern, unless it is too large.
fn built(pattern: &Pattern) {
    let points = pattern.pieces.values().flat_map(|piece| piece.outline.iter().map(|edge| edge.start));
    if points.into_iter().all(|p| p.abs().max_element() < WIDEST) {
        let (garment, _) = crate::cloth::build(pattern, EDGE_LENGTH);
        assert!(garment.rest.iter().flatten().all(|p| p.is_finite()), "cloth is built of what is no number");
    }
}

/// Whether building the body is fast.
fn is_quick(document: &Document) -> bool {
    matches!(document.body, BodyChoice::Imported { .. })
}

fn project(bytes: &[u8]) -> Result<(), String> {
    let project = project_file::from_bytes(bytes).map_err(|e| e.to_string())?;
    built(&project.document.pattern);
    if is_quick(&project.document) {
        let mut session = Session::new(project, Runner::inline(Simulation::default()));
        go_on(&mut session);
        if session.apply_alone(Command::Wrap).is_ok() {
            go_on(&mut session);
        }
        project_file::to_bytes(&session.project()).map_err(|e| e.to_string())?;
    }
    Ok(())
}

fn recording(bytes: &[u8]) -> Result<(), String> {
    let text = std::str::from_utf8(bytes).map_err(|_| "not a recording: not UTF-8 text".to_owned())?;
    let recording = Recording::parse(text).map_err(|e| e.to_string())?;
    recording.project.problem().map_or(Ok(()), Err)?;
    if is_quick(&recording.project.document) {
        let mut replay = Replay::new(recording);
        for _ in 0..MOST_STEPS {
            if !replay.step().map_err(|e| e.to_string())? {
                break;
            }
        }
        go_on(replay.session());
    }
    Ok(())
}

fn motion(bytes: &[u8]) -> Result<(), String> {
    let mut clip = bvh::read(bytes).map_err(|e| e.to_string())?;
    clip.set_upright(clip.likely_up());
    let figure = mannequin(&Measurements::default()).map_err(|e| e.to_string())?;
    let retarget = Retarget::new(&clip, &figure.skeleton)?;
    for frame in [0, clip.frames() - 1] {
        let (pose, placement) = retarget.frame(&clip, 0, frame);
        if let Some(why) = pose.problem() {
            panic!("frame {frame}: {why}");
        }
        assert!(placement.turn.is_finite() && placement.shift.is_finite(), "frame {frame} is no place");
    }
    Ok(())
}
