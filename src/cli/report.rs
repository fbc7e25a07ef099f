//! The report of a dressed garment, and the files beside it.

use std::path::{Path, PathBuf};
use std::time::Instant;

use serde::Serialize;

use crate::body::Surface;
use crate::cli::arguments::PictureOptions;
use crate::cli::failure::Failure;
use crate::cli::graphics::Graphics;
use crate::cli::seconds::{Begun, Seconds};
use crate::cli::verdict::{FILE_NAME, PICTURE_NAME, Verdict};
use crate::cli::{formats, interrupt, output, run};
use crate::fit;
use crate::geometry::words::words;
use crate::pattern::{Problem, ProblemKind};
use crate::repose::Outcome;
use crate::session::recording::Hex;
use crate::session::{Document, Session};
use crate::sim::{self, DrapeState, Fault, Snapshot, Start, Started, Stats, Tried};
use crate::wrap::{MarkError, PairStretch, Phase, mark_error, stretches};

/// The contents of `report.json`.
#[derive(Debug, Serialize)]
pub struct Report {
    version: &'static str,
    name: String,
    /// Files and samples that were read.
    pub inputs: Vec<String>,
    /// Hash of the inputs; see [`crate::cli::made_from`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub made_from: Option<String>,
    ticks: u64,
    at_rest: bool,
    #[serde(flatten)]
    fit: fit::Report,
    /// The tightest place of the garment; None when it fits everywhere.
    #[serde(skip_serializing_if = "Option::is_none")]
    tight: Option<fit::Tight>,
    /// Why this is not a dressed garment; empty when it is.
    faults: Vec<Fault>,
    /// How a garment without marks was put on the body.
    #[serde(skip_serializing_if = "Option::is_none")]
    start: Option<StartReport>,
    /// Lengths of each pair of marks, before the wrap.
    marks: Vec<PairLengths>,
    mark_error: MarkError,
    /// The outcome of carrying the garment to another pose.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reposed: Option<Outcome>,
    /// The final state of draping.
    #[serde(skip_serializing_if = "Option::is_none")]
    drape: Option<DrapeState>,
    problems: Vec<Problem>,
    seconds: Seconds,
    counters: Stats,
    state_hash: String,
    /// Why view.png was left out; None when it was drawn.
    #[serde(skip_serializing_if = "Option::is_none")]
    pictures_left_out: Option<String>,
    /// Names and contents of the files beside the report.
    #[serde(skip)]
    files: Vec<(&'static str, Vec<u8>)>,
}

/// The start that was taken, and all that were tried.
#[derive(Clone, Debug, Serialize)]
struct StartReport {
    taken: Start,
    draped: bool,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    as_built: bool,
    tried: Vec<TriedReport>,
}

#[derive(Clone, Debug, Serialize)]
struct TriedReport {
    #[serde(flatten)]
    tried: Tried,
    /// Wall-clock seconds of its ticks and of judging the result.
    seconds: f64,
}

impl StartReport {
    /// The report on `started`; `seconds` are the times of `started.tried`, in the same order.
    fn new(started: &Started, seconds: &[f64]) -> Self {
        let seconds = seconds.iter().copied().chain(std::iter::repeat(0.0));
        let tried = started.tried.iter().cloned().zip(seconds);
        Self {
            taken: started.taken().start,
            draped: started.taken().draped,
            as_built: started.taken().as_built.is_some(),
            tried: tried.map(|(tried, seconds)| TriedReport { tried, seconds }).collect(),
        }
    }
}

/// The lengths of a pair of marks on cloth and body.
#[derive(Clone, Debug, Serialize)]
pub struct PairLengths {
    number: usize,
    /// Length on the cloth, metres.
    cloth: f64,
    /// Length on the body, at the cloth's offset from the skin, metres.
    body: f64,
    /// Relative difference: body / cloth - 1.
    stretch: f64,
    #[serde(skip)]
    is_large: bool,
}

impl PairLengths {
    /// The lengths of all pairs of marks of `document` on its body.
    pub fn all(document: &Document, surface: &Surface) -> Vec<Self> {
        let offset = document.settings.relax.offset * surface.scale();
        stretches(&document.marks, surface, offset).into_iter().map(Self::from).collect()
    }

    /// A warning if the two lengths are very different.
    pub fn doubt(&self) -> Option<String> {
        let more = if self.stretch > 0.0 { "longer" } else { "shorter" };
        let percent = self.stretch.abs() * 100.0;
        let words =
            format!("mark {}: on the body it is {percent:.1} % {more} than on the cloth", self.number);
        self.is_large.then_some(words)
    }
}

impl From<PairStretch> for PairLengths {
    fn from(pair: PairStretch) -> Self {
        let PairStretch { number, cloth, body } = pair;
        Self { number, cloth, body, stretch: pair.stretch(), is_large: pair.is_large() }
    }
}

impl std::fmt::Display for PairLengths {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { number, cloth, body, stretch, .. } = self;
        if *cloth == 0.0 {
            return write!(f, "mark {number}: a point");
        }
        let [cloth, body, percent] = [cloth, body, stretch].map(|x| x * 100.0);
        write!(f, "mark {number}: {cloth:.1} cm on the cloth, {body:.1} cm on the body, {percent:+.1} %")
    }
}

/// The report on `session`, with garment.obj, body.obj and, where a picture is asked for, view.png. [`Report::finish`] writes them.
pub fn report(
    session: &mut Session,
    name: &str,
    picture: Option<(&PictureOptions, &mut Graphics)>,
    mut seconds: Seconds,
) -> Result<Report, Failure> {
    session.update();
    let state_hash = Hex(state_hash(session)?).to_string();
    let snapshot = session.snapshot();
    let start = Instant::now();
    let Measured { fit, tight, faults, marks, mark_error } = measured(snapshot)?;
    seconds.measure = start.elapsed().as_secs_f64();
    let at_rest = snapshot.phase == Some(Phase::AtRest);
    let mut files: Vec<(&'static str, Vec<u8>)> = Vec::new();
    if let (Some((garment, cloth)), Some(source)) = (snapshot.drawn(), &snapshot.source) {
        files.push(("garment.obj", formats::garment_obj(garment, cloth, &source.pattern)));
    }
    if let Some(body) = snapshot.body.as_ref().or(session.surface()) {
        files.push(("body.obj", formats::body_obj(&body.mesh)));
    }
    let start = Instant::now();
    interrupt::check()?;
    let none = || Ok(Err("--no-picture".to_owned()));
    let drawn = picture.map_or_else(none, |(options, graphics)| draw(session, options, graphics));
    let pictures_left_out = match drawn? {
        Ok(png) => {
            files.push((PICTURE_NAME, png));
            None
        }
        Err(why) => Some(why),
    };
    seconds.picture = start.elapsed().as_secs_f64();
    Ok(Report {
        version: env!("CARGO_PKG_VERSION"),
        name: name.to_owned(),
        inputs: Vec::new(),
        made_from: None,
        ticks: snapshot.tick,
        at_rest,
        tight,
        faults: faults.into_iter().chain((!at_rest).then(still_moving)).collect(),
        start: snapshot.started.as_deref().map(|started| StartReport::new(started, &seconds.starts)),
        fit,
        marks,
        mark_error,
        reposed: snapshot.reposed,
        drape: snapshot.drape,
        problems: snapshot.problems.to_vec(),
        seconds,
        counters: snapshot.stats,
        state_hash,
        pictures_left_out,
        files,
    })
}

/// Hash of the state of a simulation that runs inline.
pub fn state_hash(session: &mut Session) -> Result<u64, Failure> {
    Ok(run::simulation(session)?.hash())
}

/// Measurements of a garment on its body.
struct Measured {
    fit: fit::Report,
    tight: Option<fit::Tight>,
    faults: Vec<Fault>,
    marks: Vec<PairLengths>,
    mark_error: MarkError,
}

fn measured(snapshot: &Snapshot) -> Result<Measured, Failure> {
    let (Some((garment, cloth)), Some(body), Some(source)) =
        (snapshot.drawn(), &snapshot.body, &snapshot.source)
    else {
        return Err(Failure::Check("there is no cloth on the body".to_owned()));
    };
    let index = fit::BodyIndex::new(body);
    let fit = fit::measure(&source.pattern, garment, cloth, &index);
    let tight = fit::tightest(&fit, garment, cloth, || body.landmarks());
    let faults = sim::faults(&fit, source, garment, cloth, &index, snapshot.lies());
    let offset = source.relax.offset * body.scale();
    let marks = stretches(&source.marks, body, offset).into_iter().map(PairLengths::from).collect();
    let mark_error = mark_error(garment, cloth, body, &source.marks, offset);
    Ok(Measured { fit, tight, faults, marks, mark_error })
}

fn still_moving() -> Fault {
    let (kind, place) = (ProblemKind::Dressing, words!("garment"));
    let problem = Problem { kind, place, words: words!("it still moves") };
    Fault { problem, marks: Vec::new() }
}

/// Draws view.png; the inner error says why there is no picture when there is no graphics adapter.
fn draw(
    session: &Session,
    options: &PictureOptions,
    graphics: &mut Graphics,
) -> Result<Result<Vec<u8>, String>, Failure> {
    match graphics.png(session, options) {
        Ok(png) => Ok(Ok(png)),
        Err(Failure::Graphics(words)) => {
            output::complain(&format!("view.png left out: {words}"));
            Ok(Err(words))
        }
        Err(failure) => Err(failure),
    }
}

impl Report {
    /// Writes the files and report.json to `folder`, which is made if needed. `start` is when the work began. All files are put
    /// in place together, report.json last: if the machine fails meanwhile, there is no report.json, and where there is one, the
    /// other files are whole and of the same garment.
    pub fn finish(&mut self, folder: &Path, start: Begun) -> Result<(), Failure> {
        self.seconds.total = start.seconds();
        self.seconds.processor = start.processor_seconds();
        let mut text = self.json()?;
        text.push('\n');
        output::make_folder(folder)?;
        if self.files.iter().all(|(name, _)| *name != PICTURE_NAME) {
            output::take_away(&folder.join(PICTURE_NAME))?;
        }
        let placed = std::mem::take(&mut self.files).into_iter();
        let mut files: Vec<(PathBuf, Vec<u8>)> =
            placed.map(|(name, bytes)| (folder.join(name), bytes)).collect();
        files.push((folder.join(FILE_NAME), text.into_bytes()));
        output::write_together(&files)
    }

    /// The report on several lines.
    pub fn json(&self) -> Result<String, Failure> {
        serde_json::to_string_pretty(self).map_err(|e| Failure::Internal(e.to_string()))
    }

    /// The report on one line.
    pub fn json_line(&self) -> Result<String, Failure> {
        serde_json::to_string(self).map_err(|e| Failure::Internal(e.to_string()))
    }

    /// The verdict: the part of the report that tells whether this is a dressed garment.
    pub fn verdict(&self) -> Result<Verdict, Failure> {
        let read = serde_json::to_value(self).and_then(serde_json::from_value);
        read.map_err(|e| Failure::Internal(e.to_string()))
    }
}
