//! Distortion of the cloth compared with its flat shape: strain, area, perimeter, folds.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::cloth::Garment;
use crate::fit::laid::Laid;
use crate::geometry::disjoint_sets::DisjointSets;
use crate::geometry::ids::PieceId;

/// Flat edges shorter than this (metres) have no strain.
const SHORTEST: f64 = 1e-9;
/// Triangles smaller than this (square metres) are degenerate.
const SMALLEST_AREA: f64 = 1e-12;
/// Two faces are folded onto each other when the cosine of the angle between their normals is below this.
const FOLDED: f64 = -0.5;

/// Statistics of |l / l0 - 1| over the edges of the flat cloth; an edge in a seam counts once for each piece. Along elastic, where
/// the cloth is gathered, it has no strain down to the length of the elastic.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Strain {
    /// Number of edges.
    pub edges: usize,
    /// Maximum.
    pub max: f64,
    /// 99th percentile.
    pub p99: f64,
    /// 95th percentile.
    pub p95: f64,
    /// Root mean square.
    pub rms: f64,
    /// Median.
    pub median: f64,
    /// 99th percentile of stretch, compressed edges counting as 0.
    pub stretch_p99: f64,
    /// 99th percentile of compression, stretched edges counting as 0.
    pub compress_p99: f64,
    /// Edges stretched to more than twice their length.
    #[serde(default)]
    pub doubled: usize,
}

/// A piece compared with its flat shape.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PieceChange {
    /// Name of the piece.
    pub name: String,
    /// Triangles with positions in space.
    pub triangles: usize,
    /// Triangles without positions in space.
    pub missing_triangles: usize,
    /// Area over flat area, minus one.
    pub area_change: f64,
    /// Length of the border over its flat length, minus one.
    pub perimeter_change: f64,
}

/// An edge of the flat cloth: each side of a seam has its own.
struct FlatEdge {
    piece: PieceId,
    border: bool,
    flat: f64,
    /// Length down to which it has no strain, metres: along elastic the cloth is gathered.
    gathered: f64,
    length: f64,
}

fn flat_edges(garment: &Garment, laid: &Laid) -> Vec<FlatEdge> {
    let mut sides: Vec<([u32; 2], PieceId)> = laid
        .corners
        .iter()
        .zip(&laid.pieces)
        .flat_map(|(&[a, b, c], &piece)| [[a, b], [b, c], [c, a]].map(|[a, b]| ([a.min(b), a.max(b)], piece)))
        .collect();
    sides.sort_unstable();
    let along = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
    let elastics = garment.trims.elastics.iter();
    let ratios: BTreeMap<[u32; 2], f64> = elastics.map(|e| (along(e.corners), e.what.ratio)).collect();
    sides
        .chunk_by(|a, b| a.0 == b.0)
        .map(|group| {
            let (ends, piece) = group[0];
            let [a, b] = ends.map(|c| garment.corners[c as usize]);
            let [p, q] = [a, b].map(|c| laid.mesh.positions[c.vertex as usize]);
            let flat = a.uv.distance(b.uv);
            let gathered = ratios.get(&ends).map_or(flat, |ratio| flat * ratio);
            FlatEdge { piece, border: group.len() == 1, flat, gathered, length: p.distance(q) }
        })
        .collect()
}

/// Strain |l / l0 - 1| over all flat edges, and the change of each piece.
pub(super) fn strain_and_pieces(garment: &Garment, laid: &Laid) -> (Strain, Vec<PieceChange>) {
    let edges = flat_edges(garment, laid);
    let strain_of = |e: &FlatEdge| e.length / e.length.clamp(e.gathered, e.flat) - 1.0;
    let strains = edges.iter().filter(|e| e.flat > SHORTEST).map(strain_of).collect();
    let pieces =
        garment.pieces.iter().map(|(id, name)| piece_change(garment, laid, &edges, *id, name)).collect();
    (strain(strains), pieces)
}

fn strain(signed: Vec<f64>) -> Strain {
    if signed.is_empty() {
        return Strain::default();
    }
    let sorted_by = |f: fn(f64) -> f64| {
        let mut v: Vec<f64> = signed.iter().map(|&s| f(s)).collect();
        v.sort_unstable_by(f64::total_cmp);
        v
    };
    let sizes = sorted_by(f64::abs);
    let n = sizes.len() as f64;
    Strain {
        edges: sizes.len(),
        max: sizes[sizes.len() - 1],
        p99: quantile(&sizes, 0.99),
        p95: quantile(&sizes, 0.95),
        rms: (sizes.iter().map(|s| s * s).sum::<f64>() / n).sqrt(),
        median: quantile(&sizes, 0.5),
        stretch_p99: quantile(&sorted_by(|s| s.max(0.0)), 0.99),
        compress_p99: quantile(&sorted_by(|s| (-s).max(0.0)), 0.99),
        doubled: signed.iter().filter(|s| **s > 1.0).count(),
    }
}

/// Quantile of sorted values, linearly interpolated; 0 without values.
pub(super) fn quantile(sorted: &[f64], fraction: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else {
        return 0.0;
    };
    let place = fraction * last as f64;
    let below = place.floor() as usize;
    let above = (below + 1).min(last);
    sorted[below] + (sorted[above] - sorted[below]) * (place - below as f64)
}

fn piece_change(garment: &Garment, laid: &Laid, edges: &[FlatEdge], id: PieceId, name: &str) -> PieceChange {
    let (mut flat_area, mut area, mut triangles) = (0.0, 0.0, 0);
    for t in (0..laid.pieces.len()).filter(|&t| laid.pieces[t] == id) {
        let [a, b, c] = laid.corners[t].map(|c| garment.corners[c as usize].uv);
        flat_area += (b - a).perp_dot(c - a).abs() / 2.0;
        area += area_in_space(laid, t);
        triangles += 1;
    }
    let (mut flat_border, mut border) = (0.0, 0.0);
    for e in edges.iter().filter(|e| e.border && e.piece == id) {
        flat_border += e.flat;
        border += e.length;
    }
    let of_piece = |t: &&PieceId| **t == id;
    PieceChange {
        name: name.to_owned(),
        triangles,
        missing_triangles: garment.triangle_pieces.iter().filter(of_piece).count() - triangles,
        area_change: change(area, flat_area),
        perimeter_change: change(border, flat_border),
    }
}

fn change(now: f64, before: f64) -> f64 {
    if before > 0.0 { now / before - 1.0 } else { 0.0 }
}

fn area_in_space(laid: &Laid, t: usize) -> f64 {
    let [a, b, c] = laid.mesh.corners(t);
    (b - a).cross(c - a).length() / 2.0
}

/// Triangles without area.
pub(super) fn degenerate_faces(laid: &Laid) -> usize {
    (0..laid.mesh.triangles.len()).filter(|&t| area_in_space(laid, t) < SMALLEST_AREA).count()
}

/// Number of interior edges, and of those whose triangles are folded onto each other.
pub(super) fn interior_and_folded_edges(laid: &Laid) -> (usize, usize) {
    let normal = |t: usize| {
        let [a, b, c] = laid.mesh.corners(t);
        (b - a).cross(c - a).normalize_or_zero()
    };
    let pairs = neighbours(laid);
    let folded = pairs.iter().filter(|[s, t]| normal(*s).dot(normal(*t)) < FOLDED).count();
    (pairs.len(), folded)
}

/// Pairs of triangles that share an edge.
pub(super) fn neighbours(laid: &Laid) -> Vec<[usize; 2]> {
    let mut sides: Vec<([u32; 2], usize)> = laid
        .mesh
        .triangles
        .iter()
        .enumerate()
        .flat_map(|(t, &[a, b, c])| [[a, b], [b, c], [c, a]].map(|[a, b]| ([a.min(b), a.max(b)], t)))
        .collect();
    sides.sort_unstable();
    sides.windows(2).filter(|w| w[0].0 == w[1].0).map(|w| [w[0].1, w[1].1]).collect()
}

/// Number of connected components in space.
pub(super) fn pieces_in_space(laid: &Laid) -> usize {
    let mut sets = DisjointSets::new(laid.mesh.positions.len());
    for &[a, b, c] in &laid.mesh.triangles {
        sets.join(a, b);
        sets.join(a, c);
    }
    laid.used.iter().filter(|&&v| sets.root(v) == v).count()
}

/// Sewn vertices that belong to more than one piece.
pub(super) fn vertices_shared_by_pieces(laid: &Laid) -> usize {
    let mut pairs: Vec<(u32, PieceId)> =
        laid.mesh.triangles.iter().zip(&laid.pieces).flat_map(|(t, &p)| t.map(|v| (v, p))).collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs.chunk_by(|a, b| a.0 == b.0).filter(|group| group.len() > 1).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_linear_between_values() {
        let v = [0.0, 1.0, 2.0, 10.0];
        assert_eq!([0.0, 0.5, 1.0].map(|q| quantile(&v, q)), [0.0, 1.5, 10.0]);
        assert_eq!(quantile(&[], 0.5), 0.0);
    }

    #[test]
    fn strain_of_known_values() {
        let s = strain(vec![0.1, -0.2, 0.0]);
        assert_eq!((s.edges, s.max, s.median), (3, 0.2, 0.1));
        assert!((s.rms - (0.05f64 / 3.0).sqrt()).abs() < 1e-15);
        assert!((s.p99 - (0.1 + 0.1 * 0.98)).abs() < 1e-12);
    }
}
