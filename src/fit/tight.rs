//! Tight places of a garment: where to look, or to cut the pattern wider.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};
use serde::{Deserialize, Serialize};

use crate::body::Landmarks;
use crate::cloth::{ClothState, Garment};
use crate::fit::laid::Laid;
use crate::fit::report::Report;
use crate::geometry::ids::PieceId;

/// A garment fits when the 99th percentile of its strain is at most this.
const FITS: f64 = 0.02;
/// A piece is reported as tight when its strain beyond [`FITS`], summed over edges, is at least this share of the tightest
/// piece's.
const SHARE: f64 = 0.1;
/// Radius within which edges are averaged for the strain of a place, metres: a single sliver says nothing.
const ABOUT: f64 = 0.03;
/// Most pieces reported.
const MOST_PLACES: usize = 5;

/// The tightest place of a garment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tight {
    /// The piece with the largest sum of strain beyond the limit.
    pub piece: String,
    /// Centre of that strain on the cloth, metres.
    pub at: [f64; 3],
    /// The body's landmark nearest to it; None for a body without landmarks.
    pub landmark: Option<String>,
    /// Length-weighted mean strain of the strained edges near it: positive is stretched, negative compressed.
    pub strain: f64,
}

/// A tight place, with its position on the flat cloth.
#[derive(Clone, Debug, PartialEq)]
pub struct TightPlace {
    /// The piece.
    pub piece: PieceId,
    /// Position in the piece's own plane, metres.
    pub flat: DVec2,
    /// Description for the user.
    pub tight: Tight,
}

/// One of the most strained edges.
struct Edge {
    middle: DVec3,
    flat: DVec2,
    /// Flat length, metres.
    length: f64,
    strain: f64,
}

/// The tightest place of the garment of `report`; None where the garment fits. `landmarks` are those of its body.
pub fn tightest<'a>(
    report: &Report,
    garment: &Garment,
    state: &ClothState,
    landmarks: impl FnOnce() -> Option<&'a Landmarks>,
) -> Option<Tight> {
    tight_places(report, garment, state, landmarks).into_iter().next().map(|place| place.tight)
}

/// The tightest place of each tight piece, the tightest piece first; empty where the garment fits.
pub fn tight_places<'a>(
    report: &Report,
    garment: &Garment,
    state: &ClothState,
    landmarks: impl FnOnce() -> Option<&'a Landmarks>,
) -> Vec<TightPlace> {
    if report.strain.p99 <= FITS {
        return Vec::new();
    }
    let beyond = |edges: &[Edge]| edges.iter().map(|e| (e.strain.abs() - FITS) * e.length).sum::<f64>();
    let pieces = strained(garment, &Laid::new(garment, state));
    let mut pieces: Vec<(f64, PieceId, Vec<Edge>)> =
        pieces.into_iter().map(|(id, edges)| (beyond(&edges), id, edges)).collect();
    pieces.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let least = pieces.first().map_or(0.0, |(most, ..)| SHARE * most);
    let landmarks = landmarks();
    let place = |(_, id, edges): (f64, PieceId, Vec<Edge>)| {
        let middle = middle(&edges)?;
        let name = garment.pieces.iter().find(|(piece, _)| *piece == id).map(|(_, name)| name.clone());
        let near = landmarks.as_ref().and_then(|l| l.near(middle.middle, f64::INFINITY));
        let tight = Tight {
            piece: name.unwrap_or_default(),
            at: middle.middle.to_array(),
            landmark: near.map(str::to_owned),
            strain: strain_about(middle, &edges),
        };
        Some(TightPlace { piece: id, flat: middle.flat, tight })
    };
    let tight = pieces.into_iter().filter(|(beyond, ..)| *beyond >= least).take(MOST_PLACES);
    tight.filter_map(place).collect()
}

/// The hundredth of edges with the largest strain, by piece.
fn strained(garment: &Garment, laid: &Laid) -> BTreeMap<PieceId, Vec<Edge>> {
    let mut all: Vec<(PieceId, Edge)> = Vec::new();
    for ((vs, corners), &piece) in laid.mesh.triangles.iter().zip(&laid.corners).zip(&laid.pieces) {
        for (k, j) in [(0, 1), (1, 2), (2, 0)] {
            let [a, b] = [vs[k], vs[j]].map(|v| laid.mesh.positions[v as usize]);
            let [p, q] = [corners[k], corners[j]].map(|c| garment.corners[c as usize].uv);
            let length = p.distance(q).max(1e-9);
            let strain = a.distance(b) / length - 1.0;
            all.push((piece, Edge { middle: (a + b) / 2.0, flat: (p + q) / 2.0, length, strain }));
        }
    }
    all.sort_by(|a, b| b.1.strain.abs().total_cmp(&a.1.strain.abs()));
    all.truncate(all.len().div_ceil(100));
    let mut pieces: BTreeMap<PieceId, Vec<Edge>> = BTreeMap::new();
    all.into_iter().for_each(|(piece, edge)| pieces.entry(piece).or_default().push(edge));
    pieces
}

/// The edge with the least strain-weighted distance to the others: between two tight places it is at one of them, not halfway.
fn middle(edges: &[Edge]) -> Option<&Edge> {
    let far = |edge: &Edge| -> f64 {
        edges.iter().map(|o| o.middle.distance(edge.middle) * o.strain.abs() * o.length).sum()
    };
    edges.iter().min_by(|a, b| far(a).total_cmp(&far(b)))
}

/// Length-weighted mean strain of the `edges` near `middle`, counting only those with the sign of the total.
fn strain_about(middle: &Edge, edges: &[Edge]) -> f64 {
    let about: Vec<&Edge> =
        edges.iter().filter(|edge| edge.middle.distance(middle.middle) <= ABOUT).collect();
    let all: f64 = about.iter().map(|edge| edge.strain * edge.length).sum();
    let alike = about.iter().filter(|edge| edge.strain * all >= 0.0);
    let (strain, length) =
        alike.fold((0.0, 0.0), |(s, l), edge| (s + edge.strain * edge.length, l + edge.length));
    strain / length
}

/// A landmark's name in plain words. Of a limb's sides the one towards the body is its inside; x grows to the body's left.
fn plain(landmark: &str) -> String {
    let sides = [("left_high_x", "left, outside"), ("left_low_x", "left, inside")];
    let others = [("right_high_x", "right, inside"), ("right_low_x", "right, outside")];
    let side = sides.into_iter().chain(others).find(|(end, _)| landmark.ends_with(end));
    let named = side.map_or(landmark.to_owned(), |(end, words)| landmark.replace(end, words));
    named.replace('_', " ")
}

impl std::fmt::Display for Tight {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.piece)?;
        if let Some(landmark) = &self.landmark {
            write!(f, " near {}", plain(landmark))?;
        }
        write!(f, ", {:+.1} %", self.strain * 100.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sliver_does_not_tell_how_tight_a_place_is() {
        let edge = |x: f64, length: f64, strain: f64| Edge {
            middle: DVec3::new(x, 0.0, 0.0),
            flat: DVec2::new(x, 0.0),
            length,
            strain,
        };
        let mut edges: Vec<Edge> = (0..9).map(|i| edge(0.002 * f64::from(i), 0.02, 0.1)).collect();
        edges.push(edge(0.018, 0.001, 0.77));
        // Pressed ones beside, and stretched ones elsewhere, are not of it.
        edges.push(edge(0.01, 0.02, -0.05));
        edges.push(edge(0.3, 0.02, 0.5));
        let middle = middle(&edges).expect("edges");
        assert!((0.004..=0.018).contains(&middle.middle.x), "{}", middle.middle.x);
        let told = strain_about(middle, &edges);
        assert!((told - (0.018 + 0.00077) / 0.181).abs() < 1e-12, "{told}");
    }
}
