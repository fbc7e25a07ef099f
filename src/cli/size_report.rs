//! The report on all sizes of a pattern: which of them dresses clean, its ease, and which fits a body best.

use std::fmt::Write;
use std::path::Path;

use serde::Serialize;

use crate::cli::failure::Failure;
use crate::cli::fit::quoted;
use crate::pattern::Pattern;

/// The ease of a garment at one girth of the body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Ease {
    /// Name of the girth, such as "bust".
    pub name: &'static str,
    /// Girth of the body, metres.
    pub body: f64,
    /// Girth of the flat pattern where the cloth goes round it, metres.
    pub pattern: f64,
}

impl Ease {
    /// How much wider the pattern is than the body, metres; negative where it is tighter.
    pub fn metres(&self) -> f64 {
        self.pattern - self.body
    }
}

/// One size.
#[derive(Debug, Serialize)]
pub struct SizeRow {
    size: String,
    folder: String,
    /// Why it is not dressed; None when it is, without a fault.
    pub why: Option<String>,
    /// What cannot be cut in this size.
    pub problems: Vec<String>,
    /// Seams whose first side outgrows the second since the base size, each by how many metres.
    pub seams_apart: Vec<(String, f64)>,
    triangles: Option<usize>,
    /// 99th percentile of the strain of edges, a fraction.
    strain_p99: Option<f64>,
    /// Ease at every girth that the cloth goes round.
    pub ease: Vec<Ease>,
}

impl SizeRow {
    /// A size that is not dressed yet.
    pub fn new(size: &str, folder: &Path) -> Self {
        let folder = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
        Self {
            size: size.to_owned(),
            folder,
            why: None,
            problems: Vec::new(),
            seams_apart: Vec::new(),
            triangles: None,
            strain_p99: None,
            ease: Vec::new(),
        }
    }

    /// Takes the figures of its verdict, and why it is not dressed.
    pub fn take(&mut self, triangles: usize, strain_p99: f64, why: Option<String>) {
        (self.triangles, self.strain_p99, self.why) = (Some(triangles), Some(strain_p99), why);
    }

    fn is_clean(&self) -> bool {
        self.why.is_none() && self.problems.is_empty()
    }

    /// The least ease, metres, with the name of its girth.
    fn tightest(&self) -> Option<(f64, &'static str)> {
        let all = self.ease.iter().map(|ease| (ease.metres(), ease.name));
        all.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The size in one line, for people.
    pub fn words(&self) -> String {
        let mut line = format!("{:<6}", self.size);
        match &self.why {
            None => line += "dressed",
            Some(why) => write!(line, "not dressed: {why}").unwrap_or_default(),
        }
        if let Some(p99) = self.strain_p99 {
            write!(line, ", strain p99 {:.1} %", p99 * 100.0).unwrap_or_default();
        }
        if !self.ease.is_empty() {
            let each: Vec<String> =
                self.ease.iter().map(|ease| format!("{} {:+.1}", ease.name, ease.metres() * 100.0)).collect();
            write!(line, "; ease in cm: {}", each.join(", ")).unwrap_or_default();
        }
        for problem in &self.problems {
            write!(line, "; {problem}").unwrap_or_default();
        }
        if !self.seams_apart.is_empty() {
            let each: Vec<String> =
                self.seams_apart.iter().map(|(seam, by)| format!("{seam} {:+.1}", by * 1000.0)).collect();
            write!(line, "; sides of seams grow apart, in mm: {}", each.join(", ")).unwrap_or_default();
        }
        line
    }
}

/// All sizes.
#[derive(Debug, Serialize)]
pub struct SizeReport {
    version: &'static str,
    name: String,
    base: String,
    sizes: Vec<SizeRow>,
    /// The size that fits the body best, where all sizes were put on one body: the smallest that is dressed without a fault and
    /// nowhere tighter than the body, else the one that is least tight.
    #[serde(skip_serializing_if = "Option::is_none")]
    best: Option<String>,
}

impl SizeReport {
    /// The report of `pattern`'s sizes; `on_one_body` where all were put on the same.
    pub fn new(name: &str, pattern: &Pattern, on_one_body: bool, sizes: Vec<SizeRow>) -> Self {
        let best = best(&sizes).filter(|_| on_one_body).map(|row| row.size.clone());
        let base = pattern.sizes.base_name().to_owned();
        Self { version: env!("CARGO_PKG_VERSION"), name: name.to_owned(), base, sizes, best }
    }

    /// It as JSON.
    pub fn json(&self) -> Result<String, Failure> {
        serde_json::to_string_pretty(self).map_err(|e| Failure::Internal(e.to_string()))
    }

    /// A row for each size, with the body's girth, the pattern's and the ease at every girth, centimetres.
    pub fn csv(&self) -> String {
        let mut names: Vec<&str> = Vec::new();
        for ease in self.sizes.iter().flat_map(|row| &row.ease) {
            if !names.contains(&ease.name) {
                names.push(ease.name);
            }
        }
        let mut csv = "size,dressed,strain_p99_percent".to_owned();
        for name in &names {
            let name = name.replace(' ', "_");
            // Writing to a string cannot fail.
            write!(csv, ",{name}_body_cm,{name}_pattern_cm,{name}_ease_cm").unwrap_or_default();
        }
        csv.push('\n');
        for row in &self.sizes {
            let strain = row.strain_p99.map_or(String::new(), |p99| format!("{:.3}", p99 * 100.0));
            write!(csv, "{},{},{strain}", quoted(&row.size), row.is_clean()).unwrap_or_default();
            for name in &names {
                match row.ease.iter().find(|ease| ease.name == *name) {
                    Some(ease) => {
                        let [body, own, by] = [ease.body, ease.pattern, ease.metres()].map(|m| m * 100.0);
                        write!(csv, ",{body:.2},{own:.2},{by:.2}").unwrap_or_default();
                    }
                    None => csv += ",,,",
                }
            }
            csv.push('\n');
        }
        csv
    }

    /// The result in one or two lines, for people.
    pub fn summary(&self) -> String {
        let clean = self.sizes.iter().filter(|row| row.is_clean()).count();
        let mut words = format!("{clean} of {} sizes are dressed without a fault", self.sizes.len());
        let row = self.best.as_ref().and_then(|best| self.sizes.iter().find(|row| row.size == *best));
        if let Some(row) = row {
            write!(words, "\n{} fits this body best", row.size).unwrap_or_default();
            if let Some((ease, name)) = row.tightest() {
                write!(words, ": its least ease is {:+.1} cm, at the {name}", ease * 100.0)
                    .unwrap_or_default();
            }
        }
        words
    }

    /// The sizes that are not dressed, in words; None when all are.
    pub fn failed(&self) -> Option<String> {
        let failed: Vec<&str> =
            self.sizes.iter().filter(|row| !row.is_clean()).map(|row| row.size.as_str()).collect();
        (!failed.is_empty()).then(|| format!("not dressed without a fault: {}", failed.join(", ")))
    }
}

/// The best of sizes on one body, which are in order from small to large.
fn best(sizes: &[SizeRow]) -> Option<&SizeRow> {
    let measured = || sizes.iter().filter(|row| !row.ease.is_empty());
    let is_wide = |row: &&SizeRow| row.is_clean() && row.tightest().is_some_and(|(ease, _)| ease >= 0.0);
    let ease = |row: &SizeRow| row.tightest().map_or(f64::NEG_INFINITY, |(ease, _)| ease);
    measured().find(is_wide).or_else(|| {
        let least_tight =
            |a: &&SizeRow, b: &&SizeRow| a.is_clean().cmp(&b.is_clean()).then(ease(a).total_cmp(&ease(b)));
        measured().max_by(least_tight)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(size: &str, ease: &[(&'static str, f64)]) -> SizeRow {
        let mut row = SizeRow::new(size, Path::new("out/x"));
        row.ease = ease.iter().map(|&(name, by)| Ease { name, body: 0.9, pattern: 0.9 + by }).collect();
        row
    }

    #[test]
    fn the_best_size_is_the_smallest_that_is_nowhere_tight() {
        let of = |rows: &[SizeRow]| best(rows).map(|row| row.size.clone()).unwrap_or_default();
        let s = || row("S", &[("bust", 0.01), ("hip", -0.02)]);
        let m = || row("M", &[("bust", 0.04), ("hip", 0.01)]);
        let l = || row("L", &[("bust", 0.08), ("hip", 0.05)]);
        assert_eq!(of(&[s(), m(), l()]), "M");
        let faulty = SizeRow { why: Some("torn".to_owned()), ..m() };
        assert_eq!(of(&[s(), faulty, l()]), "L");
        assert_eq!(of(&[row("XS", &[("hip", -0.05)]), s()]), "S", "none is wide: the least tight");
        assert_eq!(of(&[row("S", &[])]), "", "nothing was measured");
    }

    #[test]
    fn the_table_has_a_row_for_each_size() {
        let mut first = row("S", &[("bust", 0.025)]);
        first.take(7, 0.0312, None);
        let second = SizeRow { why: Some("torn".to_owned()), ..row("M", &[]) };
        let report = SizeReport::new("shirt", &Pattern::default(), true, vec![first, second]);
        assert_eq!(
            report.csv(),
            "size,dressed,strain_p99_percent,bust_body_cm,bust_pattern_cm,bust_ease_cm\n\"S\",true,3.120,90.00,92.50,2.50\n\"M\",false,,,,\n"
        );
        assert_eq!(report.failed().as_deref(), Some("not dressed without a fault: M"));
        assert!(report.summary().ends_with("S fits this body best: its least ease is +2.5 cm, at the bust"));
        assert!(report.sizes[0].words().contains("strain p99 3.1 %; ease in cm: bust +2.5"));
    }
}
