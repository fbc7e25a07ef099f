//! What came of dressing a project, as its report.json tells it.

use std::fs;
use std::path::Path;

use serde::{Deserialize, Deserializer, Serialize};

use crate::fit::{Penetration, Seams, Strain, Tight};
use crate::pattern::Problem;
use crate::sim::Start;
use crate::wrap::MarkError;

/// The report's own.
pub const FILE_NAME: &str = "report.json";

/// What is read off a report.
#[derive(Debug, Serialize, Deserialize)]
pub struct Verdict {
    name: String,
    /// Nothing moves any more.
    #[serde(rename(deserialize = "at_rest"))]
    settled: bool,
    triangles: usize,
    seams: Seams,
    open_seams: Vec<String>,
    penetration: Penetration,
    edges_through_body: usize,
    self_crossings: usize,
    strain: Strain,
    /// Where it is tightest, when it does not fit everywhere.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    tight: Option<Tight>,
    mark_error: MarkError,
    /// How it came on to the body, where it had no marks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    start: Option<TakenStart>,
    /// Why this is not a dressed garment: piece, seam or place, and words.
    faults: Vec<Fault>,
    /// What is wrong with the pattern, its seams and marks.
    problems: Vec<Problem>,
    /// Wall-clock seconds in all.
    #[serde(deserialize_with = "total")]
    seconds: f64,
}

/// The start that was taken.
#[derive(Debug, Serialize, Deserialize)]
struct TakenStart {
    taken: Start,
    draped: bool,
}

/// A fault without the marks near it: its words name them.
#[derive(Debug, Serialize, Deserialize)]
struct Fault {
    #[serde(flatten)]
    problem: Problem,
}

fn total<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    #[derive(Deserialize)]
    struct Seconds {
        total: f64,
    }
    Seconds::deserialize(from).map(|seconds| seconds.total)
}

impl Verdict {
    /// Of the report in `folder`, with its text, if there is one that was made from the same.
    pub fn stored(folder: &Path, made_from: &str) -> Option<(Self, String)> {
        let text = fs::read_to_string(folder.join(FILE_NAME)).ok()?;
        let report: serde_json::Value = serde_json::from_str(&text).ok()?;
        let is_same = report["made_from"] == made_from;
        is_same
            .then(|| serde_json::from_value(report).ok())?
            .map(|verdict| (verdict, text.trim_end().to_owned()))
    }

    /// Why this is not a dressed garment: each fault's words, without its place.
    pub fn reasons(&self) -> impl Iterator<Item = &str> {
        self.faults.iter().map(|fault| fault.problem.words.as_str())
    }

    /// Wall-clock seconds in all.
    pub fn seconds(&self) -> f64 {
        self.seconds
    }

    /// Why this is not a dressed garment.
    pub fn failed_check(&self) -> Option<String> {
        let words = |f: &Fault| format!("{}: {}", f.problem.place, f.problem.words);
        let all: Vec<String> = self.faults.iter().map(words).collect();
        (!all.is_empty()).then(|| all.join("; "))
    }
}

/// One line for people.
impl std::fmt::Display for Verdict {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.failed_check() {
            None => write!(f, "{}: dressed, ", self.name)?,
            Some(words) => write!(f, "{}: not dressed: {words}; ", self.name)?,
        }
        write!(f, "{} triangles, strain p99 {:.1} %", self.triangles, self.strain.p99 * 100.0)?;
        if let Some(tight) = &self.tight {
            write!(f, " (tightest: {tight})")?;
        }
        let millimetres = self.mark_error.max * 1000.0;
        match &self.start {
            Some(TakenStart { taken: Start::Placement, .. }) => write!(f, ", sewn from placement")?,
            Some(TakenStart { taken: Start::Marks, draped: true }) => {
                write!(f, ", by suggested marks, draped")?
            }
            Some(TakenStart { taken: Start::Marks, draped: false }) => write!(f, ", by suggested marks")?,
            None => write!(f, ", marks met within {millimetres:.1} mm")?,
        }
        write!(f, ", {:.2} s", self.seconds)
    }
}
