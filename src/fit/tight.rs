//! Where a garment is tightest: the place to look at, or to cut wider.

use std::collections::BTreeMap;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::body::Landmarks;
use crate::cloth::{ClothState, Garment};
use crate::fit::laid::Laid;
use crate::fit::report::Report;
use crate::geometry::ids::PieceId;

/// A garment fits when its worst hundredth is strained by less.
const FITS: f64 = 0.02;

/// The tightest place of a garment.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tight {
    /// The piece that has most of the strain beyond what fits.
    pub piece: String,
    /// The middle of that, on the cloth, metres.
    pub at: [f64; 3],
    /// The landmark of the body nearest to it; None of a body without.
    pub landmark: Option<String>,
    /// Of the edge there: positive is stretched, negative pressed.
    pub strain: f64,
}

/// An edge strained beyond what fits.
struct Edge {
    middle: DVec3,
    strain: f64,
}

/// Where the garment of `report` is tightest; None where it fits. `landmarks` are those of its body.
pub fn tightest(
    report: &Report,
    garment: &Garment,
    state: &ClothState,
    landmarks: impl FnOnce() -> Option<Landmarks>,
) -> Option<Tight> {
    if report.strain.p99 <= FITS {
        return None;
    }
    let pieces = strained(garment, &Laid::new(garment, state));
    let beyond = |edges: &[Edge]| edges.iter().map(|e| e.strain.abs() - FITS).sum::<f64>();
    let most = pieces.iter().max_by(|a, b| beyond(a.1).total_cmp(&beyond(b.1)).then(b.0.cmp(a.0)));
    let (id, edges) = most?;
    let middle = middle(edges)?;
    let name = garment.pieces.iter().find(|(piece, _)| piece == id).map(|(_, name)| name.clone());
    Some(Tight {
        piece: name.unwrap_or_default(),
        at: middle.middle.to_array(),
        landmark: landmarks().and_then(|l| l.near(middle.middle, f64::INFINITY).map(str::to_owned)),
        strain: middle.strain,
    })
}

/// The edges strained as much as the worst hundredth, piece by piece.
fn strained(garment: &Garment, laid: &Laid) -> BTreeMap<PieceId, Vec<Edge>> {
    let mut all: Vec<(PieceId, Edge)> = Vec::new();
    for ((vs, corners), &piece) in laid.mesh.triangles.iter().zip(&laid.corners).zip(&laid.pieces) {
        for (k, j) in [(0, 1), (1, 2), (2, 0)] {
            let [a, b] = [vs[k], vs[j]].map(|v| laid.mesh.positions[v as usize]);
            let [p, q] = [corners[k], corners[j]].map(|c| garment.corners[c as usize].uv);
            let strain = a.distance(b) / p.distance(q).max(1e-9) - 1.0;
            all.push((piece, Edge { middle: (a + b) / 2.0, strain }));
        }
    }
    all.sort_by(|a, b| b.1.strain.abs().total_cmp(&a.1.strain.abs()));
    all.truncate(all.len().div_ceil(100));
    let mut pieces: BTreeMap<PieceId, Vec<Edge>> = BTreeMap::new();
    all.into_iter().for_each(|(piece, edge)| pieces.entry(piece).or_default().push(edge));
    pieces
}

/// The edge from which the others are nearest, by their strain: between two tight places it is at one, not halfway.
fn middle(edges: &[Edge]) -> Option<&Edge> {
    let far = |edge: &Edge| -> f64 {
        edges.iter().map(|other| other.middle.distance(edge.middle) * other.strain.abs()).sum()
    };
    edges.iter().min_by(|a, b| far(a).total_cmp(&far(b)))
}

impl std::fmt::Display for Tight {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.piece)?;
        if let Some(landmark) = &self.landmark {
            write!(f, " near {}", landmark.replace('_', " "))?;
        }
        write!(f, ", {:+.1} %", self.strain * 100.0)
    }
}
