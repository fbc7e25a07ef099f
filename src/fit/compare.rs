//! Comparison of two garments with the same pieces: transfers a map from one to the other.

use glam::DVec2;
use rayon::prelude::*;
use serde::Serialize;

use crate::cloth::{FlatPiece, FlatPlace, Garment};
use crate::fit::maps::{Map, Worn};
use crate::fit::shape::quantile;
use crate::geometry::ids::PieceId;
use crate::geometry::parallel::LEAST_SEARCHES;
use crate::geometry::words::{Words, within_quotes, words};
use crate::pattern::Pattern;

/// Barycentric weights below this count as zero.
const LEAST_SHARE: f64 = 1e-9;
/// Flattening tolerance of outlines for bounding boxes, metres.
const TOLERANCE: f64 = 1e-4;

/// Why two garments cannot be compared, in words.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Unlike(pub Words);

/// For each flat corner of the second garment the corresponding place on the first: at the same relative position in the bounding
/// box of its piece, so meshes and sizes may differ.
#[derive(Debug)]
pub struct Matching {
    places: Vec<Option<FlatPlace>>,
}

/// Statistics of the difference between two maps, over the vertices of the second garment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Change {
    /// Number of vertices with a value in both maps.
    pub count: usize,
    /// Mean of the first map there.
    pub first: f64,
    /// Mean of the second map there.
    pub second: f64,
    /// Mean of second minus first.
    pub mean: f64,
    /// 99th percentile of |second - first|.
    pub p99: f64,
    /// Largest |second - first|.
    pub max: f64,
}

impl Matching {
    /// Matches the pieces of two garments. The error names the pieces that one has and the other lacks.
    pub fn new(first: Worn<'_>, second: Worn<'_>) -> Result<Self, Unlike> {
        let pairs = pairs(first.garment, second.garment)?;
        let mut places = vec![None; second.garment.corners.len()];
        for (of_first, of_second) in pairs {
            let piece = FlatPiece::new(first.garment, of_first);
            let [to, from] = [(first, of_first), (second, of_second)].map(|(w, id)| bounds(w.pattern, id));
            let corners = second.garment.corners.par_iter().zip(&mut places).with_min_len(LEAST_SEARCHES);
            corners.filter(|(corner, _)| corner.piece == of_second).for_each(|(corner, place)| {
                let p = carried(corner.uv, from, to);
                *place = piece.nearest(first.garment, p).map(onto);
            });
        }
        Ok(Self { places })
    }

    /// The map over the first garment, transferred to the vertices of the second; on seams the mean of both sides. NaN where
    /// there is no value.
    pub fn carried(&self, first: &Garment, second: &Garment, map: &Map) -> Vec<f64> {
        let mut sums = vec![(0.0, 0usize); second.vertex_count];
        for (corner, place) in second.corners.iter().zip(&self.places) {
            let Some(place) = place else { continue };
            let shared = place.vertices(first).into_iter().filter(|(_, share)| *share > LEAST_SHARE);
            let value: f64 = shared.map(|(v, share)| map.vertices[v as usize] * share).sum();
            if value.is_finite() {
                let (sum, count) = &mut sums[corner.vertex as usize];
                (*sum, *count) = (*sum + value, *count + 1);
            }
        }
        sums.into_iter().map(|(sum, n)| if n > 0 { sum / n as f64 } else { f64::NAN }).collect()
    }

    /// The map over the second garment minus the one over the first, at the vertices of the second; NaN where either has no
    /// value.
    pub fn difference(&self, first: (&Garment, &Map), second: (&Garment, &Map)) -> Map {
        let before = self.carried(first.0, second.0, first.1);
        let vertices: Vec<f64> = second.1.vertices.iter().zip(&before).map(|(b, a)| b - a).collect();
        Map::between(second.1.kind, second.0, vertices)
    }
}

impl Change {
    /// Statistics over the vertices of `garment`, or of one of its pieces. Both lists have a value, or NaN, per vertex.
    pub fn of(garment: &Garment, piece: Option<PieceId>, first: &[f64], second: &[f64]) -> Self {
        let mut vertices: Vec<usize> = match piece {
            None => (0..garment.vertex_count).collect(),
            Some(id) => garment.corners.iter().filter(|c| c.piece == id).map(|c| c.vertex as usize).collect(),
        };
        vertices.sort_unstable();
        vertices.dedup();
        vertices.retain(|&v| first[v].is_finite() && second[v].is_finite());
        if vertices.is_empty() {
            return Self::default();
        }
        let count = vertices.len();
        let mean =
            |value: &dyn Fn(usize) -> f64| vertices.iter().map(|&v| value(v)).sum::<f64>() / count as f64;
        let mut sizes: Vec<f64> = vertices.iter().map(|&v| (second[v] - first[v]).abs()).collect();
        sizes.sort_unstable_by(f64::total_cmp);
        Self {
            count,
            first: mean(&|v| first[v]),
            second: mean(&|v| second[v]),
            mean: mean(&|v| second[v] - first[v]),
            p99: quantile(&sizes, 0.99),
            max: sizes[count - 1],
        }
    }
}

/// Pairs of corresponding pieces: by id where ids and names agree, else by name.
fn pairs(first: &Garment, second: &Garment) -> Result<Vec<(PieceId, PieceId)>, Unlike> {
    if first.pieces == second.pieces {
        return Ok(first.pieces.iter().map(|(id, _)| (*id, *id)).collect());
    }
    let sorted = |garment: &Garment| {
        let mut pieces: Vec<(String, PieceId)> =
            garment.pieces.iter().map(|(id, name)| (name.clone(), *id)).collect();
        pieces.sort();
        pieces
    };
    let (one, other) = (sorted(first), sorted(second));
    let lacking = |has: &[(String, PieceId)], lacks: &[(String, PieceId)]| {
        let missing: Vec<String> = has
            .iter()
            .filter(|(name, _)| !lacks.iter().any(|(known, _)| known == name))
            .map(|(name, _)| format!("{name:?}"))
            .collect();
        (!missing.is_empty()).then(|| missing.join(", "))
    };
    let of_second = lacking(&one, &other).map(|names| words!("the second has no piece {names}", names));
    let of_first = lacking(&other, &one).map(|names| words!("the first has no piece {names}", names));
    let words: Vec<Words> = of_second.into_iter().chain(of_first).collect();
    if !words.is_empty() {
        return Err(Unlike(Words::joined(words, ", ")));
    }
    let twice =
        |pieces: &[(String, PieceId)]| pieces.windows(2).find(|w| w[0].0 == w[1].0).map(|w| w[0].0.clone());
    match twice(&one).or(twice(&other)) {
        Some(name) => Err(Unlike(words!(
            "several pieces are called \"{name}\": which is which cannot be told",
            name = within_quotes(&name)
        ))),
        None => Ok(one.into_iter().zip(other).map(|((_, a), (_, b))| (a, b)).collect()),
    }
}

/// Bounding box of a piece in its own plane, metres.
fn bounds(pattern: &Pattern, id: PieceId) -> [DVec2; 2] {
    let points = pattern.pieces.get(&id).map(|piece| piece.flattened(TOLERANCE)).unwrap_or_default();
    let first = points.first().copied().unwrap_or_default();
    points.iter().fold([first; 2], |[low, high], &p| [low.min(p), high.max(p)])
}

fn carried(p: DVec2, from: [DVec2; 2], to: [DVec2; 2]) -> DVec2 {
    if from == to {
        return p;
    }
    let size = from[1] - from[0];
    let share = (p - from[0]) / DVec2::select(size.cmpgt(DVec2::ZERO), size, DVec2::ONE);
    to[0] + share * (to[1] - to[0])
}

/// The nearest place on the triangle itself: where two meshes approximate a curve by different chords, a point can be outside.
fn onto(place: FlatPlace) -> FlatPlace {
    let shares = place.shares.map(|share| share.max(0.0));
    let sum: f64 = shares.iter().sum();
    FlatPlace { shares: shares.map(|share| share / sum), ..place }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::fit::MapKind;
    use crate::fit::maps::tests::{SIDE, Sheets, sheets};

    /// Along the grain, all alike.
    fn stretched(edge: f64, by: f64) -> Sheets {
        sheets(edge, |p| DVec3::new(p.x, p.y * (1.0 + by), 0.3))
    }

    fn compared(first: &Sheets, second: &Sheets, kind: MapKind) -> Change {
        let matching = first.with_worn(|a| second.with_worn(|b| Matching::new(a, b))).expect("alike");
        let before = matching.carried(&first.garment, &second.garment, &first.map(kind));
        Change::of(&second.garment, None, &before, &second.map(kind).vertices)
    }

    #[test]
    fn a_difference_is_exact_whatever_the_meshes() {
        for edge in [0.05, 0.023] {
            let (first, second) = (stretched(0.05, 0.01), stretched(edge, 0.035));
            let change = compared(&first, &second, MapKind::Warp);
            assert_eq!(change.count, second.garment.vertex_count);
            for (found, exact) in
                [(change.first, 0.01), (change.second, 0.035), (change.mean, 0.025), (change.p99, 0.025)]
            {
                assert!((found - exact).abs() < 1e-9, "{change:?}");
            }
        }
    }

    #[test]
    fn a_difference_is_a_map_over_the_second() {
        let (first, second) = (stretched(0.05, 0.01), stretched(0.031, 0.035));
        let matching = first.with_worn(|a| second.with_worn(|b| Matching::new(a, b))).expect("alike");
        let maps = [&first, &second].map(|sheets| sheets.map(MapKind::Warp));
        let more = matching.difference((&first.garment, &maps[0]), (&second.garment, &maps[1]));
        assert_eq!((more.kind, more.vertices.len()), (MapKind::Warp, second.garment.vertex_count));
        assert_eq!(more.triangles.len(), second.garment.triangles.len());
        assert!(more.vertices.iter().chain(&more.triangles).all(|v| (v - 0.025).abs() < 1e-9));
        let [low, high] = more.range_about_zero(&more.stats());
        assert!((high - 0.025).abs() < 1e-9 && low == -high);
    }

    #[test]
    fn places_are_matched_not_numbers() {
        // Its ease is as large as x: at the same place of another mesh there is no difference.
        let slanted = |edge| sheets(edge, |p| DVec3::new(p.x, p.y, p.x));
        let change = compared(&slanted(0.05), &slanted(0.031), MapKind::Ease);
        assert!(change.max < 1e-9 && change.count > 100, "{change:?}");
        let back = compared(&slanted(0.031), &slanted(0.031), MapKind::Ease);
        assert!(back.max < 1e-12, "{back:?}");
    }

    #[test]
    fn another_size_is_matched_by_share_of_its_pieces() {
        let slanted = || sheets(0.04, |p| DVec3::new(p.x, p.y, p.x));
        let mut large = sheets(0.04, |p| DVec3::new(p.x, p.y, p.x));
        for piece in large.pattern.pieces.values_mut() {
            std::sync::Arc::make_mut(piece).outline.iter_mut().for_each(|edge| edge.start *= 1.25);
        }
        large.garment.corners.iter_mut().for_each(|corner| corner.uv *= 1.25);
        let change = compared(&slanted(), &large, MapKind::Ease);
        assert!(change.max < 1e-9 && change.first > 0.5 * SIDE, "{change:?}");
    }

    #[test]
    fn a_piece_too_many_is_named() {
        let (first, mut second) = (stretched(0.1, 0.0), stretched(0.1, 0.0));
        second.garment.pieces[1].1 = "sleeve".to_owned();
        let told = first.with_worn(|a| second.with_worn(|b| Matching::new(a, b))).expect_err("unlike");
        assert_eq!(told.0, "the second has no piece \"right\", the first has no piece \"sleeve\"");
        // The same pieces by other numbers are the same pieces.
        let mut second = stretched(0.1, 0.0);
        second.garment.pieces.iter_mut().for_each(|piece| piece.0.0 += 10);
        assert!(first.with_worn(|a| second.with_worn(|b| Matching::new(a, b))).is_ok());
    }
}
