//! Comparison of a benchmark with an earlier run of it, row by row.

use std::path::{Path, PathBuf};

use serde::Serialize;
use serde_json::Value;

use crate::cli::failure::Failure;
use crate::cli::output;

/// Share of the old figure by which the new one may be worse; medians on a shared machine vary by a few hundredths.
const BEARABLE: f64 = 0.1;
/// Name of the wall-clock time of a row.
const SECONDS: &str = "seconds";

/// An earlier run, and the figures that are worse now.
pub struct Against {
    path: PathBuf,
    old: Vec<Value>,
    held: usize,
    losses: Vec<String>,
}

/// A figure of a row.
struct Measure<'a> {
    /// Its name.
    what: &'a str,
    value: f64,
    /// Whether more is better.
    is_rate: bool,
}

impl Against {
    /// Reads the file at `path`, which holds the output of `toile bench --json`. Fails at the first line that is no row.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        let text = std::fs::read_to_string(path).map_err(|e| Failure::file(path, e))?;
        let row = |(i, line): (usize, &str)| {
            let row = serde_json::from_str(line).ok().filter(|row| scene(row).is_some());
            row.ok_or_else(|| {
                let words = format!("line {}: no row of toile bench --json", i + 1);
                Failure::input(path, words)
            })
        };
        let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
        let old = lines.map(row).collect::<Result<Vec<_>, _>>()?;
        Ok(Self { path: path.to_owned(), old, held: 0, losses: Vec::new() })
    }

    /// Compares `row` with the row of the same scene and number of triangles. Returns a line for each figure that both have.
    pub fn hold(&mut self, row: &impl Serialize) -> Result<Vec<String>, Failure> {
        let new = serde_json::to_value(row).map_err(|e| Failure::Internal(e.to_string()))?;
        let same = |old: &&Value| scene(old) == scene(&new) && old["triangles"] == new["triangles"];
        let Some(old) = self.old.iter().find(same) else { return Ok(Vec::new()) };
        let mut lines = Vec::new();
        for before in measures(old) {
            let Some(now) = measures(&new).find(|now| now.what == before.what) else { continue };
            let is_loss = now.is_loss_from(before.value);
            let change = (now.value / before.value - 1.0) * 100.0;
            let change = if change.is_finite() { format!("{change:+.1} %") } else { "-".to_owned() };
            let loss = if is_loss { "   LOSS" } else { "" };
            let words =
                format!("{:<44} {:>12.6} -> {:>12.6}  {change:>9}{loss}", now.what, before.value, now.value);
            if is_loss {
                let scene = scene(&new).unwrap_or_default();
                self.losses.push(format!("{scene}, {}: {:.6} -> {:.6}", now.what, before.value, now.value));
            }
            lines.push(words);
            self.held += 1;
        }
        Ok(lines)
    }

    /// Fails if a figure was worse by more than [`BEARABLE`], or if nothing could be compared.
    pub fn finish(self) -> Result<(), Failure> {
        if self.held == 0 {
            return Err(Failure::input(
                &self.path,
                "none of its rows was measured again: another bench, or other sizes",
            ));
        }
        output::complain(&format!("{} figures held against {}", self.held, self.path.display()));
        if self.losses.is_empty() {
            return Ok(());
        }
        let words = format!("worse by more than {:.0} %: {}", BEARABLE * 100.0, self.losses.join("; "));
        Err(Failure::Check(words))
    }
}

impl Measure<'_> {
    /// Whether the figure is worse than `before` by more than [`BEARABLE`].
    fn is_loss_from(&self, before: f64) -> bool {
        let bearable = before.abs() * BEARABLE;
        if self.is_rate { self.value < before - bearable } else { self.value > before + bearable }
    }
}

fn scene(row: &Value) -> Option<&str> {
    row["scene"].as_str()
}

/// The figures of a row: its checks, and its time and errors.
fn measures(row: &Value) -> impl Iterator<Item = Measure<'_>> {
    let checks = row["checks"].as_array().map(Vec::as_slice).unwrap_or_default();
    let checks = checks.iter().filter_map(|check| {
        let (what, value) = (check["what"].as_str()?, check["value"].as_f64()?);
        Some(Measure { what, value, is_rate: check["unit"] == "per_second" })
    });
    let own = [SECONDS, "excess_p99", "position"].into_iter();
    checks.chain(own.filter_map(|what| Some(Measure { what, value: row[what].as_f64()?, is_rate: false })))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn row(seconds: f64, rate: f64, inside: f64) -> Value {
        json!({"scene": "a", "triangles": 9, "seconds": seconds, "checks": [
            {"what": "rate", "value": rate, "unit": "per_second"},
            {"what": "inside", "value": inside, "unit": "count"},
        ]})
    }

    fn against(old: Value) -> Against {
        Against { path: PathBuf::from("old.json"), old: vec![old], held: 0, losses: Vec::new() }
    }

    #[test]
    fn more_than_a_tenth_is_a_loss_in_the_direction_that_counts() {
        let lost = |new: Value| {
            let mut against = against(row(1.0, 10.0, 0.0));
            assert_eq!(against.hold(&new).expect("compared").len(), 3);
            against.losses.len()
        };
        assert_eq!(lost(row(1.09, 9.1, 0.0)), 0);
        assert_eq!(lost(row(0.5, 20.0, 0.0)), 0);
        assert_eq!(lost(row(1.11, 10.0, 0.0)), 1);
        assert_eq!(lost(row(1.0, 8.9, 0.0)), 1);
        assert_eq!(lost(row(1.0, 10.0, 1.0)), 1, "nothing has become something");
    }

    #[test]
    fn what_is_not_the_same_scene_is_not_compared() {
        let mut against = against(row(1.0, 10.0, 0.0));
        assert!(
            against.hold(&json!({"scene": "b", "triangles": 9, "seconds": 5.0})).expect("read").is_empty()
        );
        assert!(
            against.hold(&json!({"scene": "a", "triangles": 8, "seconds": 5.0})).expect("read").is_empty()
        );
        assert!(matches!(against.finish(), Err(Failure::Input { .. })));
    }
}
