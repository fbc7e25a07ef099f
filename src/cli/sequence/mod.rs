//! `toile repose --sequence` and `--motion`: carries the dressed garment through the frames of a motion, each from the frame
//! before.

mod animated;
mod body_files;
mod captured;

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use serde::Serialize;

use crate::body::Surface;
use crate::cli::arguments::{InputOptions, Repose};
use crate::cli::failure::Failure;
use crate::cli::seconds::Seconds;
use crate::cli::{files, formats, input, interrupt, output, repose, run};
use crate::fit;
use crate::io::dressed::{Dressed, Frame};
use crate::io::{glb, gltf, usd};
use crate::repose::{ReposeSettings, Reposer};
use crate::session::recording::Hex;
use crate::session::{BodyChoice, Document, Session};
use crate::sim::Snapshot;
use crate::sim::hash::{Fnv, cloth_hash};
use crate::ui::scenery::fabric_textures::USUAL_SIDE;
use crate::ui::scenery::worn::{MovingWorn, Worn};
use crate::wrap::Phase;

use animated::Animated;
use body_files::Files;
use captured::Captured;

/// Largest number of frames of a sequence.
const MOST_FRAMES: usize = 10_000;
/// Frames per second of body files and of animated bodies when --fps is not given.
const USUAL_FPS: f64 = 30.0;
/// Largest size of an animated file, bytes: lengths in GLB and USDZ are 32-bit.
const MOST_BYTES: usize = u32::MAX as usize;

/// The source of the bodies of the frames.
enum Source {
    Files(Files),
    Captured(Captured),
    Animated(Box<Animated>, PathBuf),
}

impl Source {
    /// Reads the motion in the file at `path`. Returns it with its number of frames, its frames per second, and notes on what was
    /// not understood.
    fn moving(
        path: &Path,
        arguments: &Repose,
        body: &BodyChoice,
    ) -> Result<(Self, usize, f64, Vec<String>), Failure> {
        let bytes = files::read(path)?;
        if gltf::is_gltf(&bytes) {
            let fps = arguments.fps.map_or(USUAL_FPS, |fps| fps * arguments.every as f64);
            let asked = arguments.animation.as_deref();
            let animated = Animated::new(path, &bytes, arguments.body_file, asked, fps)?;
            let (count, notes) = (animated.frames(), animated.notes(asked));
            return Ok((Self::Animated(Box::new(animated), path.to_owned()), count, fps, notes));
        }
        if arguments.animation.is_some() {
            let words = "--animation chooses among those of a glTF body: this is none";
            return Err(Failure::input(path, words));
        }
        let first = arguments.frames.as_ref().map_or(0, |range| range.start);
        let captured = Captured::new(path, &bytes, body, arguments.body_file.up, first)?;
        let (count, fps, notes) = (captured.frames(), captured.fps(), captured.notes());
        Ok((Self::Captured(captured), count, fps, notes))
    }
}

/// The motion and its frames that are made.
struct Motion {
    source: Source,
    /// Indices of the chosen frames in the source, from 0.
    frames: Vec<usize>,
    /// Frames per second of the result.
    fps: f64,
    /// Notes on what was not understood.
    notes: Vec<String>,
    /// Files that were read.
    inputs: Vec<PathBuf>,
}

impl Motion {
    fn new(arguments: &Repose, body: &BodyChoice) -> Result<Self, Failure> {
        let (source, count, own_fps, notes) = match &arguments.motion {
            Some(path) => Source::moving(path, arguments, body)?,
            None => {
                let files = Files::new(&arguments.bodies, arguments.body_file)?;
                let count = files.paths.len();
                (Source::Files(files), count, USUAL_FPS, Vec::new())
            }
        };
        let frames = chosen(arguments, count)?;
        let inputs = match &source {
            Source::Files(files) => frames.iter().map(|&i| files.paths[i].clone()).collect(),
            Source::Captured(_) | Source::Animated(..) => arguments.motion.iter().cloned().collect(),
        };
        let fps = arguments.fps.unwrap_or(own_fps / arguments.every as f64);
        Ok(Self { source, frames, fps, notes, inputs })
    }

    /// The name of frame `i` for messages.
    fn name(&self, i: usize) -> String {
        match &self.source {
            Source::Files(files) => files.paths[self.frames[i]].display().to_string(),
            Source::Captured(_) | Source::Animated(..) => {
                format!("frame {} of the motion", self.frames[i] + 1)
            }
        }
    }

    /// The body in frame `i`, which has the triangles of `dressed`.
    fn body(&mut self, i: usize, dressed: &Surface) -> Result<Arc<Surface>, Failure> {
        match &mut self.source {
            Source::Files(files) => files.body(self.frames[i], dressed),
            Source::Captured(captured) => captured.body(self.frames[i]),
            Source::Animated(animated, path) => animated.body(self.frames[i], dressed, path),
        }
    }
}

/// Indices of the chosen frames, of `count`.
fn chosen(arguments: &Repose, count: usize) -> Result<Vec<usize>, Failure> {
    if count == 0 {
        let words = "--sequence takes bodies: --body FILE, several times, or a folder";
        return Err(Failure::Usage(words.to_owned()));
    }
    let range = arguments.frames.clone().unwrap_or(0..count);
    if range.end > count {
        let words = format!("--frames {}..{}: there are {count} frames", range.start, range.end);
        return Err(Failure::Usage(words));
    }
    match range.len().div_ceil(arguments.every) {
        n if n > MOST_FRAMES => Err(Failure::Limit(format!("{n} frames, at most {MOST_FRAMES} are made"))),
        _ => Ok(range.step_by(arguments.every).collect()),
    }
}

/// The result of one frame.
#[derive(Debug, Serialize)]
struct Line {
    frame: usize,
    name: String,
    file: String,
    /// Number of vertices inside the body.
    inside: usize,
    /// Number of cloth edges that cross the skin.
    through: usize,
    /// 99th percentile of the edges' strain in excess of that of the dressed cloth.
    excess_p99: f64,
    /// 99th percentile of the edges' strain relative to the flat pattern.
    strain_p99: f64,
    seconds: f64,
}

/// The contents of `report.json`.
#[derive(Debug, Serialize)]
struct Summary {
    version: &'static str,
    name: String,
    inputs: Vec<String>,
    frames_per_second: f64,
    /// Size of the animated file.
    bytes: usize,
    frames: Vec<Line>,
    notes: Vec<String>,
    state_hash: String,
    seconds: Seconds,
}

/// Carries the garment through all frames. If a frame has cloth inside the body the check fails.
pub fn sequence(arguments: &Repose) -> Result<(), Failure> {
    let start = Instant::now();
    let input = input::load(&arguments.project, &InputOptions::default())?;
    let mut motion = Motion::new(arguments, &input.project.document.body)?;
    for note in &motion.notes {
        output::complain(&format!("note: {note}"));
    }
    let mut session = run::opened(input.project, &arguments.project)?;
    let mut seconds = Seconds { load: start.elapsed().as_secs_f64(), ..Seconds::default() };
    repose::dress_first(&mut session, arguments, &mut seconds)?;
    let snapshot = Arc::clone(session.snapshot());
    let body = body_of(&session, &snapshot, &arguments.project)?;
    let with = moving(&snapshot, session.document(), arguments)?;
    check_size(&snapshot, &body, &with, motion.frames.len(), arguments.usd)?;
    output::make_folder(&arguments.out)?;
    // The old report is of another motion and must not stay beside new frames, nor that motion as USD.
    for name in ["report.json", "sequence.usdz"] {
        output::take_away(&arguments.out.join(name))?;
    }
    let mut carrier = Carrier::new(&snapshot, Arc::clone(&body), &arguments.project)?;
    let (mut frames, mut lines, mut hash) = (Vec::new(), Vec::new(), Fnv::default());
    let count = motion.frames.len();
    for i in 0..count {
        interrupt::check()?;
        output::progress(&format!("frame {} of {count}", i + 1));
        let surface = motion.body(i, &body)?;
        let (frame, line) = carrier.frame(i, &surface, &motion.name(i), &arguments.out, &mut hash)?;
        output::progress("");
        tell(&line, count, arguments.json)?;
        frames.push(frame);
        lines.push(line);
    }
    seconds.repose = Some(lines.iter().map(|line: &Line| line.seconds).sum());
    let (bytes, usd) = carrier.animated(&body, &frames, motion.fps, &with, arguments.usd)?;
    seconds.total = start.elapsed().as_secs_f64();
    let fault = fault(&lines);
    let read = motion.inputs.iter().map(|path| path.display().to_string());
    let summary = Summary {
        version: env!("CARGO_PKG_VERSION"),
        name: input.name,
        inputs: input.files.into_iter().chain(read).collect(),
        frames_per_second: motion.fps,
        bytes: bytes.len(),
        frames: lines,
        notes: motion.notes,
        state_hash: Hex(hash.finish()).to_string(),
        seconds,
    };
    let text = serde_json::to_string_pretty(&summary).map_err(|e| Failure::Internal(e.to_string()))?;
    let (mean, mib) =
        (summary.seconds.repose.unwrap_or_default() / count as f64, bytes.len() as f64 / 1048576.0);
    let into = |name: &str, bytes: Vec<u8>| (arguments.out.join(name), bytes);
    let mut written = vec![into("sequence.glb", bytes)];
    written.extend(usd.map(|bytes| into("sequence.usdz", bytes)));
    written.push(into("report.json", format!("{text}\n").into_bytes()));
    output::write_together(&written)?;
    if !arguments.json {
        output::say(&format!("{count} frames, {:.0} ms each, sequence.glb of {mib:.1} MiB", mean * 1000.0));
    }
    fault.map_or(Ok(()), |words| Err(Failure::Check(words)))
}

fn body_of(session: &Session, snapshot: &Snapshot, project: &Path) -> Result<Arc<Surface>, Failure> {
    let body = snapshot.body.as_ref().or(session.surface()).cloned();
    body.ok_or_else(|| Failure::input(project, "there is no cloth on the body"))
}

/// What the cloth is written with: its materials, textures and trims. What is left out is told.
fn moving(snapshot: &Snapshot, document: &Document, arguments: &Repose) -> Result<MovingWorn, Failure> {
    let (Some(garment), Some(source)) = (&snapshot.garment, &snapshot.source) else {
        return Err(Failure::input(&arguments.project, "there is no cloth on the body"));
    };
    let worn = Worn { garment, cloth: &snapshot.cloth, pattern: &source.pattern, document };
    let with = worn.moving(arguments.textures.worn(USUAL_SIDE)).map_err(|why| Failure::Limit(why.into()))?;
    with.left_out.iter().for_each(|line| output::complain(&format!("note: {line}")));
    Ok(with)
}

/// Refuses, before the work is done, a sequence that would not fit in the file.
fn check_size(
    snapshot: &Snapshot,
    body: &Surface,
    with: &MovingWorn,
    frames: usize,
    usd: bool,
) -> Result<(), Failure> {
    let cloth = snapshot.garment.as_ref().map_or(0, |garment| garment.corners.len());
    let others = body.mesh.positions.len() + with.trims.vertices();
    let glb = (glb::animated::bytes_per_frame(cloth, others), "glTF");
    let usd = usd.then(|| (usd::bytes_per_frame(cloth, others), "USDZ"));
    for (each, format) in std::iter::once(glb).chain(usd) {
        if each.saturating_mul(frames) >= MOST_BYTES {
            let words = format!(
                "{frames} frames of {each} bytes are more than a {format} file can hold: take at most {}",
                MOST_BYTES / each
            );
            return Err(Failure::Limit(words));
        }
    }
    Ok(())
}

fn tell(line: &Line, count: usize, json: bool) -> Result<(), Failure> {
    if json {
        let text = serde_json::to_string(line).map_err(|e| Failure::Internal(e.to_string()))?;
        output::say(&text);
        return Ok(());
    }
    let Line { frame, name, inside, through, excess_p99, seconds, .. } = line;
    output::say(&format!(
        "frame {} of {count}, {name}: {inside} vertices inside, {through} edges through, strain p99 {:+.1} %, {:.0} ms",
        frame + 1,
        excess_p99 * 100.0,
        seconds * 1000.0
    ));
    Ok(())
}

/// A message if frames have cloth inside the body.
fn fault(lines: &[Line]) -> Option<String> {
    let worst = lines.iter().max_by_key(|line| (line.inside, std::cmp::Reverse(line.frame)))?;
    let bad = lines.iter().filter(|line| line.inside > 0).count();
    let words = || {
        format!(
            "{bad} of {} frames have cloth inside the body; most in frame {} ({}): {} vertices",
            lines.len(),
            worst.frame + 1,
            worst.name,
            worst.inside
        )
    };
    (bad > 0).then(words)
}

/// The garment bound to its body, carried from frame to frame.
struct Carrier<'a> {
    snapshot: &'a Snapshot,
    reposer: Reposer,
}

impl<'a> Carrier<'a> {
    fn new(snapshot: &'a Snapshot, body: Arc<Surface>, project: &Path) -> Result<Self, Failure> {
        let (Some(garment), Some(source)) = (&snapshot.garment, &snapshot.source) else {
            return Err(Failure::input(project, "there is no cloth on the body"));
        };
        let cloth = snapshot.cloth.as_ref().clone();
        let reposer = Reposer::new(garment, body, cloth, source.relax);
        let words = "the garment is too large for this machine's memory";
        Ok(Self { snapshot, reposer: reposer.ok_or_else(|| Failure::Limit(words.to_owned()))? })
    }

    /// Carries the cloth to `surface`, measures it and writes it to a file such as "garment_0000.obj".
    fn frame(
        &mut self,
        i: usize,
        surface: &Arc<Surface>,
        name: &str,
        out: &Path,
        hash: &mut Fnv,
    ) -> Result<(Frame, Line), Failure> {
        let (Some(garment), Some(source)) = (&self.snapshot.garment, &self.snapshot.source) else {
            return Err(Failure::Internal("the garment is gone".to_owned()));
        };
        let start = Instant::now();
        let done = self.reposer.reposed(surface, ReposeSettings::LIVE);
        let (state, outcome) =
            done.ok_or_else(|| Failure::Internal("a frame of another body was let through".to_owned()))?;
        let seconds = start.elapsed().as_secs_f64();
        let fit = fit::measure(&source.pattern, garment, &state, &fit::BodyIndex::new(surface));
        hash.number(cloth_hash(&state, Some(Phase::AtRest), true));
        let file = PathBuf::from(format!("garment_{i:04}.obj"));
        output::write(&out.join(&file), &formats::garment_obj(garment, &state, &source.pattern))?;
        let line = Line {
            frame: i,
            name: name.to_owned(),
            file: file.display().to_string(),
            inside: fit.penetration.vertices,
            through: fit.edges_through_body,
            excess_p99: outcome.excess_p99,
            strain_p99: fit.strain.p99,
            seconds,
        };
        Ok((Frame { cloth: state.positions, body: surface.mesh.positions.clone() }, line))
    }

    /// The frames as binary glTF, and as USD where that is wanted.
    fn animated(
        &self,
        body: &Surface,
        frames: &[Frame],
        fps: f64,
        with: &MovingWorn,
        usd: bool,
    ) -> Result<(Vec<u8>, Option<Vec<u8>>), Failure> {
        let (Some(garment), Some(source)) = (&self.snapshot.garment, &self.snapshot.source) else {
            return Err(Failure::Internal("the garment is gone".to_owned()));
        };
        let MovingWorn { colours, trims, .. } = with;
        let (state, pattern) = (&*self.snapshot.cloth, &*source.pattern);
        let dressed = Dressed { garment, state, pattern, trims: &trims.parts };
        let glb = formats::sequence_glb(dressed, &body.mesh, frames, fps, colours)?;
        let usd = usd.then(|| formats::sequence_usdz(dressed, &body.mesh, frames, fps, colours));
        Ok((glb, usd.transpose()?))
    }
}
