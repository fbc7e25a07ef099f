//! Finds the unit of length of a DXF drawing.

use glam::DVec2;

use super::clean::Clean;
use crate::geometry::words::{Words, decimal, words};
use crate::io::pattern_file::PatternFileError;
use crate::io::scale::{DrawingUnit, ScaleQuestion};

/// Usual size of the larger side of a garment's largest piece, metres, from a child's collar to a circle skirt. It is used to
/// guess the unit.
const LIKELY: std::ops::RangeInclusive<f64> = 0.12..=2.6;
/// Size of the larger side of the largest piece (metres) for which a unit stated in the file is believed.
const POSSIBLE: std::ops::RangeInclusive<f64> = 0.1..=5.0;

/// The unit of a drawing, and a note when it was guessed. `largest` is the size of the largest piece in drawing units.
pub fn unit(
    clean: &Clean,
    texts: &[String],
    largest: DVec2,
) -> Result<(DrawingUnit, Option<Words>), PatternFileError> {
    let side = largest.max_element();
    let possible = |unit: DrawingUnit| POSSIBLE.contains(&(side * unit.metres()));
    let (said, by) = match (said_in_text(texts), said_in_header(clean)) {
        (Some(unit), _) => (unit, words!("the text UNITS")),
        (None, Some(unit)) => (unit, words!("the header")),
        (None, None) => return guessed(largest),
    };
    if possible(said) {
        return Ok((said, None));
    }
    let why = words!(
        "{by} says {unit}, but then the largest piece would be {length} cm long",
        by,
        unit = Words::listed(said.long()),
        length = decimal(side * said.metres() * 100.0, 1)
    );
    let others = candidates().filter(|&unit| unit != said && possible(unit));
    Err(question(why, largest, others.chain([said]).collect()))
}

fn candidates() -> impl Iterator<Item = DrawingUnit> {
    [DrawingUnit::Millimetre, DrawingUnit::Centimetre, DrawingUnit::Inch, DrawingUnit::Metre].into_iter()
}

fn question(why: Words, largest: DVec2, candidates: Vec<DrawingUnit>) -> PatternFileError {
    PatternFileError::Scale(ScaleQuestion { why, largest, candidates })
}

/// The unit in a text "UNITS: …"; METRIC stands for millimetres.
fn said_in_text(texts: &[String]) -> Option<DrawingUnit> {
    let value = texts.iter().find_map(|text| {
        let (key, value) = text.split_once(':')?;
        key.trim().eq_ignore_ascii_case("UNITS").then(|| value.trim().to_ascii_uppercase())
    })?;
    match value.as_str() {
        "METRIC" | "MM" | "MILLIMETERS" | "MILLIMETRES" => Some(DrawingUnit::Millimetre),
        "CM" | "CENTIMETERS" | "CENTIMETRES" => Some(DrawingUnit::Centimetre),
        "ENGLISH" | "IMPERIAL" | "INCH" | "INCHES" => Some(DrawingUnit::Inch),
        _ => None,
    }
}

/// The unit that `$INSUNITS` in the header states, if it is one of inch, millimetre, centimetre and metre.
fn said_in_header(clean: &Clean) -> Option<DrawingUnit> {
    match clean.units {
        Some(1) => Some(DrawingUnit::Inch),
        Some(4) => Some(DrawingUnit::Millimetre),
        Some(5) => Some(DrawingUnit::Centimetre),
        Some(6) => Some(DrawingUnit::Metre),
        _ => None,
    }
}

/// The unit when the file states none: the only one that gives the largest piece a usual size; a question if there are several or
/// none.
fn guessed(largest: DVec2) -> Result<(DrawingUnit, Option<Words>), PatternFileError> {
    let fitting: Vec<DrawingUnit> =
        candidates().filter(|unit| LIKELY.contains(&(largest.max_element() * unit.metres()))).collect();
    match fitting[..] {
        [unit] => {
            let unit_name = Words::listed(unit.long());
            Ok((unit, Some(words!("taken to be in {unit}, by the size of its pieces", unit = unit_name))))
        }
        [] => Err(question(words!("it does not say its unit"), largest, candidates().collect())),
        _ => Err(question(words!("it does not say its unit"), largest, fitting)),
    }
}
