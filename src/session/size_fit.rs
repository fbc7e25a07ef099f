//! How each size of a graded pattern fits: whether it is dressed, its ease at every girth, and which size fits a body best.

use std::fmt::Write;

use serde::Serialize;

use crate::fit::girths;
use crate::geometry::words::Words;
use crate::io::words::quoted;
use crate::pattern::grading::{Graded, growth_in};
use crate::pattern::{Pattern, Problem};
use crate::session::body::readings_of;
use crate::session::{BodyChoice, Outfit};

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

    /// The ease of `outfit` at every girth that its cloth goes round; `body` is what it is on.
    pub fn of(body: &BodyChoice, outfit: &Outfit) -> Vec<Self> {
        let readings = readings_of(body, &outfit.body.mesh).unwrap_or_default();
        let round = girths(&outfit.garment, &outfit.state, &readings);
        let ease = |i: usize, flat| Self { name: readings[i].name, body: readings[i].metres, pattern: flat };
        round.into_iter().map(|(i, girth)| ease(i, girth.flat)).collect()
    }
}

/// One size, as it is cut and dressed.
#[derive(Clone, Debug, Serialize)]
pub struct SizeFit {
    /// Name of the size.
    pub size: String,
    /// Name of the folder of its files, where it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub folder: Option<String>,
    /// Why it is not dressed; None when it is, without a fault.
    pub why: Option<Words>,
    /// What cannot be cut in this size.
    pub problems: Vec<Words>,
    /// Seams whose first side outgrows the second since the base size, each by how many metres.
    pub seams_apart: Vec<(String, f64)>,
    triangles: Option<usize>,
    /// 99th percentile of the strain of edges, a fraction.
    pub strain_p99: Option<f64>,
    /// Ease at every girth that the cloth goes round.
    pub ease: Vec<Ease>,
}

impl SizeFit {
    /// `pattern` cut in `size`, which is not dressed yet.
    pub fn cut(pattern: &Pattern, size: &str, graded: &Graded) -> Self {
        let apart = growth_in(pattern, graded, size).into_iter();
        Self {
            problems: graded.problems.iter().map(Problem::in_words).collect(),
            seams_apart: apart.map(|growth| (growth.seam.to_string(), growth.change)).collect(),
            ..Self::named(size)
        }
    }

    /// A size that cannot be cut or dressed, and why.
    pub fn refused(size: &str, why: Words) -> Self {
        Self { why: Some(why), ..Self::named(size) }
    }

    fn named(size: &str) -> Self {
        Self {
            size: size.to_owned(),
            folder: None,
            why: None,
            problems: Vec::new(),
            seams_apart: Vec::new(),
            triangles: None,
            strain_p99: None,
            ease: Vec::new(),
        }
    }

    /// Takes the figures of its verdict, and why it is not dressed.
    pub fn take(&mut self, triangles: usize, strain_p99: f64, why: Option<Words>) {
        (self.triangles, self.strain_p99, self.why) = (Some(triangles), Some(strain_p99), why);
    }

    /// Whether it is cut and dressed without a fault.
    pub fn is_clean(&self) -> bool {
        self.why.is_none() && self.problems.is_empty()
    }

    /// The least ease, metres, with the name of its girth.
    pub fn tightest(&self) -> Option<(f64, &'static str)> {
        let all = self.ease.iter().map(|ease| (ease.metres(), ease.name));
        all.min_by(|a, b| a.0.total_cmp(&b.0))
    }

    /// The size in one line, for people.
    pub fn words(&self) -> String {
        let mut line = format!("{:<6}", self.size);
        // Writing to a string cannot fail.
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

/// Names of all girths at which `sizes` have ease, each once.
pub fn girth_names(sizes: &[SizeFit]) -> Vec<&'static str> {
    let mut names = Vec::new();
    for ease in sizes.iter().flat_map(|size| &size.ease) {
        if !names.contains(&ease.name) {
            names.push(ease.name);
        }
    }
    names
}

/// A table of CSV with a row for each size: the body's girth, the pattern's and the ease at every girth, centimetres.
pub fn csv(sizes: &[SizeFit]) -> String {
    let names = girth_names(sizes);
    let mut csv = "size,dressed,strain_p99_percent".to_owned();
    for name in &names {
        let name = name.replace(' ', "_");
        write!(csv, ",{name}_body_cm,{name}_pattern_cm,{name}_ease_cm").unwrap_or_default();
    }
    csv.push('\n');
    for size in sizes {
        let strain = size.strain_p99.map_or(String::new(), |p99| format!("{:.3}", p99 * 100.0));
        write!(csv, "{},{},{strain}", quoted(&size.size), size.is_clean()).unwrap_or_default();
        for name in &names {
            match size.ease.iter().find(|ease| ease.name == *name) {
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

/// The best of sizes on one body, which are in order from small to large: the smallest that is dressed without a fault and nowhere
/// tighter than the body, else the one that is least tight. None where nothing was measured.
pub fn best(sizes: &[SizeFit]) -> Option<&SizeFit> {
    let measured = || sizes.iter().filter(|size| !size.ease.is_empty());
    let is_wide = |size: &&SizeFit| size.is_clean() && size.tightest().is_some_and(|(ease, _)| ease >= 0.0);
    let ease = |size: &SizeFit| size.tightest().map_or(f64::NEG_INFINITY, |(ease, _)| ease);
    measured().find(is_wide).or_else(|| {
        let less_tight =
            |a: &&SizeFit, b: &&SizeFit| a.is_clean().cmp(&b.is_clean()).then(ease(a).total_cmp(&ease(b)));
        measured().max_by(less_tight)
    })
}

/// The result in one or two lines, for people; `on_one_body` where all sizes were put on the same.
pub fn summary(sizes: &[SizeFit], on_one_body: bool) -> String {
    let clean = sizes.iter().filter(|size| size.is_clean()).count();
    let mut words = format!("{clean} of {} sizes are dressed without a fault", sizes.len());
    if let Some(size) = best(sizes).filter(|_| on_one_body) {
        write!(words, "\n{} fits this body best", size.size).unwrap_or_default();
        if let Some((ease, name)) = size.tightest() {
            write!(words, ": its least ease is {:+.1} cm, at the {name}", ease * 100.0).unwrap_or_default();
        }
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    fn size(name: &str, ease: &[(&'static str, f64)]) -> SizeFit {
        let ease = ease.iter().map(|&(name, by)| Ease { name, body: 0.9, pattern: 0.9 + by }).collect();
        SizeFit { ease, ..SizeFit::named(name) }
    }

    #[test]
    fn the_best_size_is_the_smallest_that_is_nowhere_tight() {
        let of = |sizes: &[SizeFit]| best(sizes).map(|size| size.size.clone()).unwrap_or_default();
        let s = || size("S", &[("bust", 0.01), ("hip", -0.02)]);
        let m = || size("M", &[("bust", 0.04), ("hip", 0.01)]);
        let l = || size("L", &[("bust", 0.08), ("hip", 0.05)]);
        assert_eq!(of(&[s(), m(), l()]), "M");
        let faulty = SizeFit { why: Some(Words::plain("torn")), ..m() };
        assert_eq!(of(&[s(), faulty, l()]), "L");
        assert_eq!(of(&[size("XS", &[("hip", -0.05)]), s()]), "S", "none is wide: the least tight");
        assert_eq!(of(&[size("S", &[])]), "", "nothing was measured");
    }

    #[test]
    fn the_table_has_a_row_for_each_size() {
        let mut first = size("S", &[("bust", 0.025)]);
        first.take(7, 0.0312, None);
        let second = SizeFit { why: Some(Words::plain("torn")), ..size("M", &[]) };
        let sizes = [first, second];
        assert_eq!(
            csv(&sizes),
            "size,dressed,strain_p99_percent,bust_body_cm,bust_pattern_cm,bust_ease_cm\n\"S\",true,3.120,90.00,92.50,2.50\n\"M\",false,,,,\n"
        );
        let words = summary(&sizes, true);
        assert!(words.ends_with("S fits this body best: its least ease is +2.5 cm, at the bust"), "{words}");
        assert!(sizes[0].words().contains("strain p99 3.1 %; ease in cm: bust +2.5"));
    }
}
