//! Faults of a dressed garment, each with the pairs of marks near it, which a person can paint differently.

use glam::DVec3;
use serde::Serialize;

use crate::body::Surface;
use crate::cloth::{ClothState, EdgeMetric, FlatPiece, Garment};
use crate::fit::{self, BodyIndex, Fallen, Moved, Report};
use crate::geometry::words::{Value, Words, decimal, words};
use crate::pattern::{Problem, ProblemKind};
use crate::sim::source::GarmentSource;
use crate::wrap::{BodyMark, ClothMark, Marks, PairStretch, are_suggested, stretches};

/// Most pairs of marks named for one fault.
const MOST_PAIRS: usize = 3;
/// A pair is named when it is the nearest pair for at least this share of the fault's vertices.
const SHARE: f64 = 0.1;

/// A fault, and the pairs of marks near it, the one nearest to most of its vertices first.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fault {
    /// Description, which names the marks.
    #[serde(flatten)]
    pub problem: Problem,
    /// Pairs of marks nearest to the fault along the cloth.
    pub marks: Vec<Concerned>,
}

/// How the cloth came to its present position.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lies<'a> {
    /// How it came there.
    pub moved: Moved,
    /// Whether it was sewn from the placement of its pieces, and the body has not moved since.
    pub sewn: bool,
    /// Heights of the highest points of its pieces before a start draped it, metres; None where none did, or the body has moved.
    pub hung_at: Option<&'a [f64]>,
    /// Unbalanced force as a share of the weight, where draping ended though the cloth never came to rest.
    pub unbalanced: Option<f64>,
}

/// A pair of marks near a fault.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Concerned {
    /// Number of the pair, from 1.
    pub number: usize,
    /// Length of the pair on the body over its length on the cloth, minus one.
    pub stretch: f64,
}

/// The faults of the garment that `report` measures; see [`fit::faults`].
pub fn faults(
    report: &Report,
    source: &GarmentSource,
    garment: &Garment,
    cloth: &ClothState,
    body: &BodyIndex<'_>,
    lies: Lies<'_>,
) -> Vec<Fault> {
    let mut found = fit::faults(report, lies.moved);
    // Cloth that could not be sewn to its neighbours falls off: that is reported already.
    if report.seams.open == 0 {
        let fallen = match lies.hung_at {
            Some(tops) => fit::fallen_from(tops, &source.pattern, garment, cloth),
            None if lies.sewn => fit::fallen(&source.pattern, garment, cloth),
            None => Vec::new(),
        };
        found.extend(fallen.into_iter().map(|fallen| told_fallen(fallen, garment)));
    }
    found.extend(lies.unbalanced.map(told_restless));
    if found.is_empty() {
        return Vec::new();
    }
    let nearest = nearest_pairs(garment, &source.marks);
    let surface = body.surface();
    let lengths = stretches(&source.marks, surface, source.relax.offset * surface.scale());
    let places = are_suggested(&source.marks, &source.pattern).then(|| places(source, surface));
    let fault = |(problem, spot): (Problem, fit::Spot)| {
        let marks = concerned(&spot.vertices(garment, cloth, body), &nearest, &lengths);
        Fault { problem: told(problem, &marks, places.as_deref()), marks }
    };
    found.into_iter().map(fault).collect()
}

fn told_fallen(fallen: Fallen, garment: &Garment) -> (Problem, fit::Spot) {
    let place = garment
        .pieces
        .get(fallen.piece)
        .map_or_else(Words::default, |(_, name)| words!("piece {name}", name));
    let words = words!(
        "it has slid down by {cm} cm from where it was put: nothing holds it",
        cm = decimal(fallen.by * 100.0, 0)
    );
    (Problem { kind: ProblemKind::Dressing, place, words }, fit::Spot::Piece(fallen.piece))
}

fn told_restless(unbalanced: f64) -> (Problem, fit::Spot) {
    let words = words!(
        "it does not come to rest: {percent} % of its weight is still out of balance",
        percent = decimal(unbalanced * 100.0, 1)
    );
    (Problem { kind: ProblemKind::Dressing, place: words!("garment"), words }, fit::Spot::Nowhere)
}

/// `problem` with the marks near it: by their numbers, or by their `places` where the marks were suggested, since nobody knows numbers
/// that were not painted.
fn told(problem: Problem, marks: &[Concerned], places: Option<&[Place]>) -> Problem {
    if marks.is_empty() {
        return problem;
    }
    let each = marks.iter().map(|mark| {
        let percent = Value::Number(format!("{:+.1}", mark.stretch * 100.0));
        match places.and_then(|places| places.get(mark.number - 1)) {
            None => words!("{n} ({percent} %)", n = mark.number, percent),
            Some(Place { piece, near: None }) => words!("{piece} ({percent} %)", piece, percent),
            Some(Place { piece, near: Some(place) }) => {
                words!("{piece} near {place} ({percent} %)", piece, place, percent)
            }
        }
    });
    let all = Words::joined(each, ", ");
    let nearest = match (marks.len(), places.is_some()) {
        (1, false) => words!("nearest mark: {marks}", marks = all),
        (_, false) => words!("nearest marks: {marks}", marks = all),
        (1, true) => words!("nearest suggested mark: {marks}", marks = all),
        (_, true) => words!("nearest suggested marks: {marks}", marks = all),
    };
    Problem { words: problem.words.and("; ", nearest), ..problem }
}

/// Where a pair of marks is.
struct Place {
    /// Name of the piece.
    piece: String,
    /// The body's landmark nearest to the middle of the stroke; None for a body without landmarks.
    near: Option<Words>,
}

/// Where each pair of marks is, in the order of their numbers. Of landmarks at the sides of a limb only the limb is named.
fn places(source: &GarmentSource, surface: &Surface) -> Vec<Place> {
    let named = surface
        .landmarks()
        .into_iter()
        .flat_map(|found| found.iter())
        .filter(|(name, _)| !name.ends_with("_x"));
    let named: Vec<(&str, DVec3)> = named.collect();
    let place = |(cloth, body): (&ClothMark, &BodyMark)| {
        let middle = body.points.get(body.points.len() / 2).copied();
        let nearest = middle.and_then(|middle| {
            let far = |place: &&(&str, DVec3)| place.1.distance(middle);
            named.iter().min_by(|a, b| far(a).total_cmp(&far(b)))
        });
        Place {
            piece: source
                .pattern
                .pieces
                .get(&cloth.piece)
                .map(|piece| piece.name.clone())
                .unwrap_or_default(),
            near: nearest.map(|(name, _)| Words::listed(name.replace('_', " "))),
        }
    };
    source.marks.pairs().map(place).collect()
}

/// Number of the pair nearest to each vertex, by distance along the cloth and across seams; None where no path leads to a pair.
fn nearest_pairs(garment: &Garment, marks: &Marks) -> Vec<Option<usize>> {
    let metric = EdgeMetric::new(garment);
    let mut nearest = vec![(f64::INFINITY, None); garment.vertex_count];
    for ((mark, _), number) in marks.pairs().zip(1..) {
        let piece = FlatPiece::new(garment, mark.piece);
        let places = mark.points.iter().filter_map(|&p| piece.inside(garment, p));
        let sources: Vec<(u32, f64)> =
            places.flat_map(|place| place.vertices(garment).map(|(v, _)| (v, 0.0))).collect();
        for (known, distance) in nearest.iter_mut().zip(metric.from(&sources, |_| true).distance) {
            if distance < known.0 {
                *known = (distance, Some(number));
            }
        }
    }
    nearest.into_iter().map(|(_, number)| number).collect()
}

fn concerned(vertices: &[u32], nearest: &[Option<usize>], lengths: &[PairStretch]) -> Vec<Concerned> {
    let mut counts: Vec<(usize, usize)> = Vec::new();
    for number in vertices.iter().filter_map(|&v| nearest[v as usize]) {
        match counts.iter_mut().find(|(_, known)| *known == number) {
            Some((count, _)) => *count += 1,
            None => counts.push((1, number)),
        }
    }
    counts.retain(|(count, _)| *count as f64 >= SHARE * vertices.len() as f64);
    counts.sort_unstable_by_key(|&(count, number)| (std::cmp::Reverse(count), number));
    let stretch = |number| lengths.iter().find(|l| l.number == number).map_or(0.0, PairStretch::stretch);
    let named = counts.into_iter().take(MOST_PAIRS);
    named.map(|(_, number)| Concerned { number, stretch: stretch(number) }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn suggested_marks_are_told_by_their_places_and_painted_ones_by_their_numbers() {
        let problem = || Problem {
            kind: ProblemKind::Dressing,
            place: words!("garment"),
            words: words!("it still moves"),
        };
        let marks = [Concerned { number: 1, stretch: 0.034 }, Concerned { number: 2, stretch: -0.01 }];
        let place = |piece: &str, near: Option<&str>| Place {
            piece: piece.to_owned(),
            near: near.map(Words::listed),
        };
        let places = [place("front", Some("waist front")), place("back", None)];
        let check = |marks: &[Concerned], places: Option<&[Place]>, told_so: &str| {
            assert_eq!(told(problem(), marks, places).words, told_so);
        };
        check(&marks, None, "it still moves; nearest marks: 1 (+3.4 %), 2 (-1.0 %)");
        check(&marks[..1], None, "it still moves; nearest mark: 1 (+3.4 %)");
        let suggested =
            "it still moves; nearest suggested marks: front near waist front (+3.4 %), back (-1.0 %)";
        check(&marks, Some(&places), suggested);
        check(&[], Some(&places), "it still moves");
        let one = "it still moves; nearest suggested mark: front near waist front (+3.4 %)";
        check(&marks[..1], Some(&places), one);
    }
}
