//! The verdict on a dressed project, read from its report.json.

use std::fs;
use std::path::Path;

use serde::{Deserialize, Deserializer, Serialize};

use crate::cli::failure::Failure;
use crate::fit::{Causes, Penetration, Seams, Strain, Tight};
use crate::pattern::Problem;
use crate::sim::Start;
use crate::wrap::MarkError;

/// File name of the report.
pub const FILE_NAME: &str = "report.json";
/// Name of the picture beside it.
pub const PICTURE_NAME: &str = "view.png";

/// The part of a report that tells whether the project is dressed.
#[derive(Debug, Serialize, Deserialize)]
pub struct Verdict {
    /// Name of the garment.
    pub name: String,
    /// Whether nothing moves any more.
    #[serde(rename(deserialize = "at_rest"))]
    settled: bool,
    triangles: usize,
    seams: Seams,
    open_seams: Vec<String>,
    penetration: Penetration,
    edges_through_body: usize,
    self_crossings: usize,
    strain: Strain,
    #[serde(default, skip_serializing)]
    strain_causes: Causes,
    /// The tightest place of the garment; None when it fits everywhere.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    tight: Option<Tight>,
    mark_error: MarkError,
    /// How a garment without marks was put on the body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    start: Option<TakenStart>,
    /// Why this is not a dressed garment: piece, seam or place, and a message.
    faults: Vec<Fault>,
    /// What is wrong with the pattern, its seams and marks.
    problems: Vec<Problem>,
    #[serde(flatten, deserialize_with = "times")]
    times: Times,
}

/// How long it took.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Times {
    /// Total wall-clock time, seconds.
    pub seconds: f64,
    /// Processor time of all threads, seconds; None where the system does not tell.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub processor_seconds: Option<f64>,
}

/// The start that was taken.
#[derive(Debug, Serialize, Deserialize)]
struct TakenStart {
    taken: Start,
    draped: bool,
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    as_built: bool,
}

/// A fault without its list of marks, which its message names.
#[derive(Debug, Serialize, Deserialize)]
struct Fault {
    #[serde(flatten)]
    problem: Problem,
}

fn times<'de, D: Deserializer<'de>>(from: D) -> Result<Times, D::Error> {
    #[derive(Deserialize)]
    struct Report {
        seconds: Seconds,
    }
    #[derive(Deserialize)]
    struct Seconds {
        total: f64,
        #[serde(default)]
        processor: Option<f64>,
    }
    let Report { seconds } = Report::deserialize(from)?;
    Ok(Times { seconds: seconds.total, processor_seconds: seconds.processor })
}

impl Verdict {
    /// The verdict and text of the report in `folder`, if there is one whose inputs have the hash `made_from`.
    pub fn stored(folder: &Path, made_from: &str) -> Option<(Self, String)> {
        let text = fs::read_to_string(folder.join(FILE_NAME)).ok()?;
        let report: serde_json::Value = serde_json::from_str(&text).ok()?;
        let is_same = report["made_from"] == made_from;
        is_same
            .then(|| serde_json::from_value(report).ok())?
            .map(|verdict| (verdict, text.trim_end().to_owned()))
    }

    /// The message of each fault, without its place.
    pub fn reasons(&self) -> impl Iterator<Item = &str> {
        self.faults.iter().map(|fault| fault.problem.words.as_str())
    }

    /// Total wall-clock time, seconds.
    pub fn seconds(&self) -> f64 {
        self.times.seconds
    }

    /// Number of triangles of the garment.
    pub fn triangles(&self) -> usize {
        self.triangles
    }

    /// 99th percentile of the strain of edges, a fraction.
    pub fn strain_p99(&self) -> f64 {
        self.strain.p99
    }

    /// Whether the garment was put on by marks of its own.
    pub fn has_marks(&self) -> bool {
        self.start.is_none() && self.mark_error.points > 0
    }

    /// Whether it has faults, and is smaller than the body.
    pub fn is_too_small(&self) -> bool {
        !self.faults.is_empty() && self.strain_causes.too_small().is_some()
    }

    /// All faults with their places; none when the project is dressed.
    fn told(&self) -> Vec<String> {
        self.faults.iter().map(|f| format!("{}: {}", f.problem.place, f.problem.words)).collect()
    }

    /// All faults with their places in one message; None when the project is dressed.
    pub fn failed_check(&self) -> Option<String> {
        self.failure().map(|failure| failure.to_string())
    }

    /// All faults as a failure, which is told a line for each; None when the project is dressed.
    pub fn failure(&self) -> Option<Failure> {
        let told = self.told();
        (!told.is_empty()).then_some(Failure::Faults { faults: told, then: Vec::new() })
    }

    /// A summary in one line, for people, that counts the faults; what they are is told by [`Self::failure`].
    pub fn summary(&self) -> String {
        let outcome = match self.faults.len() {
            0 => "dressed".to_owned(),
            1 => "not dressed, 1 fault".to_owned(),
            n => format!("not dressed, {n} faults"),
        };
        format!("{}: {outcome}, {}", self.name, self.figures())
    }

    /// The figures of a summary.
    fn figures(&self) -> String {
        let told = |tight: &Tight| {
            let what = if tight.strain < 0.0 { "most pressed together" } else { "tightest" };
            format!(" ({what}: {tight})")
        };
        let tight = self.tight.as_ref().map(told).unwrap_or_default();
        let millimetres = self.mark_error.max * 1000.0;
        let start = match &self.start {
            Some(TakenStart { taken: Start::Placement, .. }) => ", sewn from placement".to_owned(),
            Some(TakenStart { taken: Start::Marks, draped: true, .. }) => {
                ", by suggested marks, draped".to_owned()
            }
            Some(TakenStart { taken: Start::Marks, .. }) => ", by suggested marks".to_owned(),
            None if self.mark_error.points > 0 => format!(", marks met within {millimetres:.1} mm"),
            None => String::new(),
        };
        let carried = self.start.as_ref().filter(|start| start.as_built);
        let carried = carried.map_or("", |_| ", carried from the built pose");
        let (triangles, percent) = (self.triangles, self.strain.p99 * 100.0);
        let seconds = self.times.seconds;
        format!("{triangles} triangles, strain p99 {percent:.1} %{tight}{start}{carried}, {seconds:.2} s")
    }
}

/// A summary in one line, for people, with the first fault.
impl std::fmt::Display for Verdict {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let told = self.told();
        let more = match told.len() {
            0 | 1 => String::new(),
            2 => " (and 1 more fault)".to_owned(),
            n => format!(" (and {} more faults)", n - 1),
        };
        match told.first() {
            None => write!(f, "{}: dressed, {}", self.name, self.figures()),
            Some(first) => write!(f, "{}: not dressed: {first}{more}; {}", self.name, self.figures()),
        }
    }
}
