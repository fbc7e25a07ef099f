//! Position of the cloth relative to the body: inside, intersecting, or wrong side out.

use std::borrow::Cow;
use std::collections::BTreeSet;

use glam::DVec3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::body::Surface;
use crate::contact::BodyOverlaps;
use crate::fit::beside::{Beside, beside};
use crate::fit::inside::signed_distances;
use crate::fit::laid::Laid;
use crate::fit::openings::{Opening, openings};
use crate::fit::shape::quantile;
use crate::geometry::bvh::Bvh;
use crate::geometry::crossings::meetings;
use crate::geometry::ids::PieceId;
use crate::geometry::mesh::TriMesh;
use crate::geometry::parallel::{LEAST_SEARCHES, LEAST_SHARE};
use crate::geometry::winding::Winding;

/// Distance from the skin within which cloth must have its inner side towards it, metres.
pub(super) const NEAR: f64 = 0.02;
/// Distance within which another layer makes a triangle part of a fold, metres.
const FOLD: f64 = 0.03;
/// Distance of skin from the inner side of a triangle within which the triangle belongs to that skin, even if its outer side is
/// near other skin, metres.
const BETWEEN: f64 = 0.10;
/// Cosine of the angle between the normals of cloth and skin below which a triangle is wrong side out.
pub(super) const WRONG_SIDE: f64 = -0.2;
/// Distance in front of a body triangle, metres, at which a point is tested: where it is inside the body the triangle is hidden.
const BEFORE_SKIN: f64 = 1e-4;
/// Sample points of a triangle, in unnormalised barycentric coordinates.
const SAMPLES: [[f64; 3]; 7] = [
    [1.0, 1.0, 1.0],
    [4.0, 1.0, 1.0],
    [1.0, 4.0, 1.0],
    [1.0, 1.0, 4.0],
    [1.0, 1.0, 0.0],
    [0.0, 1.0, 1.0],
    [1.0, 0.0, 1.0],
];

/// Penetration of the body by cloth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Penetration {
    /// Vertices inside.
    pub vertices: usize,
    /// Triangles with one of seven samples inside.
    pub faces: usize,
    /// Depth of the deepest vertex or sample, metres.
    pub max_depth: f64,
}

/// Distribution of the signed distances of vertices from the skin, metres.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Clearance {
    /// The median.
    pub median: f64,
    /// The 95th percentile.
    pub p95: f64,
}

/// A body prepared for measurements.
#[derive(Debug)]
pub struct BodyIndex<'a> {
    surface: &'a Surface,
    winding: Winding<'a>,
}

impl<'a> BodyIndex<'a> {
    /// The body of `surface`, which keeps what is built for it.
    pub fn new(surface: &'a Surface) -> Self {
        Self { surface, winding: surface.winding() }
    }

    /// The body.
    pub fn surface(&self) -> &'a Surface {
        self.surface
    }

    /// Whether `p` is inside the body, by winding number; the body may intersect itself.
    pub fn contains(&self, p: DVec3) -> bool {
        self.winding.contains(p)
    }

    /// Bounding volume hierarchy of the body's triangles.
    pub(super) fn tree(&self) -> &Bvh {
        self.winding.tree()
    }

    /// Distance to the surface, metres, never negative.
    fn distance(&self, p: DVec3) -> f64 {
        self.surface.nearest(p).point.distance(p)
    }

    /// Whether triangle `t` is on the outside: where a body intersects itself, such as in the armpits, some are not.
    fn is_skin(&self, t: u32) -> bool {
        let [a, b, c] = self.surface.mesh.corners(t as usize);
        let before = (a + b + c) / 3.0 + self.surface.face_normals[t as usize] * BEFORE_SKIN;
        !self.contains(before)
    }

    fn is_skin_edge(&self, e: u32) -> bool {
        self.surface.adjacency.edge_triangles.of(e).iter().any(|&t| self.is_skin(t))
    }
}

/// Measurements of cloth against a body; fields as in [`Report`](crate::fit::Report).
pub(super) struct OnBody {
    pub penetration: Penetration,
    pub edges_through_body: usize,
    pub body_edges_through_garment: usize,
    pub cuts_at_body_overlaps: usize,
    pub faces_near_body: usize,
    pub flipped_faces: usize,
    pub faces_in_folds: usize,
    pub faces_between: usize,
    pub faces_beside: usize,
    pub clearance: Clearance,
    pub openings: Vec<Opening>,
}

/// Measures `laid`, whose triangles have the bounding volumes `cloth_tree`. The pieces `applied` are tacked on: their borders are no
/// openings. `flat` gives the length of an edge on its flat piece, metres.
pub(super) fn on_body(
    laid: &Laid,
    cloth_tree: &Bvh,
    body: &BodyIndex<'_>,
    applied: &BTreeSet<PieceId>,
    flat: impl Fn([u32; 2]) -> f64,
) -> OnBody {
    let garment = match applied.is_empty() {
        true => Cow::Borrowed(&laid.mesh),
        false => Cow::Owned(without(laid, applied)),
    };
    let body_mesh = &body.surface.mesh;
    let body_edges = &body.surface.adjacency.edges;
    let through_body = meetings(&laid.mesh.positions, &laid.edges, body_mesh, body.winding.tree());
    let through_cloth = meetings(&body_mesh.positions, body_edges, &laid.mesh, cloth_tree);
    let mut cut_edges = vec![false; laid.edges.len()];
    through_body.iter().for_each(|&[e, _]| cut_edges[e as usize] = true);
    let (distances, penetrating_vertices) = distances(laid, body, &cut_edges);
    let cut = cut_faces(laid, &cut_edges, &through_cloth, &penetrating_vertices);
    let wrong = wrong_side_out(laid, body);
    let beside = beside(laid, &wrong);
    let is_smooth = |t: usize| beside[t] == Beside::Smooth;
    let mut folded = in_folds(laid, cloth_tree, body, &wrong);
    folded.retain(|(t, _)| !is_smooth(*t));
    let hangs = |t: usize| beside[t] == Beside::Crumpled || is_between(laid, body, t);
    let through_skin: Vec<u32> = through_body.iter().map(|&[_, t]| t).filter(|&t| body.is_skin(t)).collect();
    let skin_through: Vec<u32> =
        through_cloth.iter().map(|&[e, _]| e).filter(|&e| body.is_skin_edge(e)).collect();
    let side = |&e: &u32| body.surface.adjacency.edge_triangles.of(e).first().copied();
    let cuts: Vec<u32> = through_skin.iter().copied().chain(skin_through.iter().filter_map(side)).collect();
    OnBody {
        penetration: penetration(laid, body, &distances, &cut),
        edges_through_body: through_skin.len(),
        body_edges_through_garment: skin_through.len(),
        cuts_at_body_overlaps: at_overlaps(body.surface, &cuts),
        faces_near_body: wrong.iter().filter(|f| f.is_some()).count(),
        flipped_faces: wrong.iter().filter(|f| **f == Some(true)).count(),
        faces_in_folds: folded.iter().filter(|(_, folded)| *folded).count(),
        faces_beside: (0..wrong.len()).filter(|&t| is_smooth(t)).count(),
        faces_between: folded.iter().filter(|(t, folded)| !folded && hangs(*t)).count(),
        clearance: Clearance { median: quantile(&distances, 0.5), p95: quantile(&distances, 0.95) },
        openings: openings(&garment, body_mesh, body.winding.tree(), flat, |t| body.is_skin(t)),
    }
}

/// How many of these triangles of the body are near places where parts of it pass through each other.
fn at_overlaps(surface: &Surface, triangles: &[u32]) -> usize {
    let overlaps = if triangles.is_empty() { None } else { BodyOverlaps::of(surface, &[]) };
    overlaps.map_or(0, |overlaps| triangles.iter().filter(|&&t| overlaps.is_crossed(t)).count())
}

/// The mesh of `laid` without these pieces.
fn without(laid: &Laid, pieces: &BTreeSet<PieceId>) -> TriMesh {
    let kept = laid.mesh.triangles.iter().zip(&laid.pieces).filter(|(_, piece)| !pieces.contains(piece));
    TriMesh { positions: laid.mesh.positions.clone(), triangles: kept.map(|(vs, _)| *vs).collect() }
}

/// Signed distances of the vertices, ascending, and for each vertex whether it is inside.
fn distances(laid: &Laid, body: &BodyIndex<'_>, cut_edges: &[bool]) -> (Vec<f64>, Vec<bool>) {
    let signed = signed_distances(laid, (body.surface, &body.winding), cut_edges);
    let mut inside = vec![false; laid.mesh.positions.len()];
    for (&v, &d) in laid.used.iter().zip(&signed) {
        inside[v as usize] = d < 0.0;
    }
    let mut sorted = signed;
    sorted.sort_unstable_by(f64::total_cmp);
    (sorted, inside)
}

/// Triangles that may have a point inside: a vertex is inside, or the body's surface cuts them. All others are wholly on the side
/// of their vertices.
fn cut_faces(laid: &Laid, cut_edges: &[bool], through_cloth: &[[u32; 2]], inside: &[bool]) -> Vec<u32> {
    let mut cut: Vec<bool> = laid
        .mesh
        .triangles
        .iter()
        .map(|&[a, b, c]| {
            [[a, b], [b, c], [c, a]].iter().any(|&[a, b]| {
                let edge = laid.edges.binary_search(&[a.min(b), a.max(b)]);
                inside[a as usize] || edge.is_ok_and(|e| cut_edges[e])
            })
        })
        .collect();
    for &[_, t] in through_cloth {
        cut[t as usize] = true;
    }
    (0u32..).zip(cut).filter_map(|(t, cut)| cut.then_some(t)).collect()
}

fn penetration(laid: &Laid, body: &BodyIndex<'_>, distances: &[f64], cut: &[u32]) -> Penetration {
    let depths: Vec<f64> = cut
        .par_iter()
        .with_min_len(LEAST_SEARCHES)
        .filter_map(|&t| face_depth(laid.mesh.corners(t as usize), body))
        .collect();
    let vertex_depth = distances.first().map_or(0.0, |&d| (-d).max(0.0));
    Penetration {
        vertices: distances.iter().filter(|&&d| d < 0.0).count(),
        faces: depths.len(),
        max_depth: depths.iter().copied().fold(vertex_depth, f64::max),
    }
}

/// Depth of the deepest sample of a triangle inside the body, metres; None when no sample is inside.
fn face_depth(corners: [DVec3; 3], body: &BodyIndex<'_>) -> Option<f64> {
    SAMPLES
        .iter()
        .map(|w| {
            let sum: DVec3 = w.iter().zip(corners).map(|(&w, p)| p * w).sum();
            sum / w.iter().sum::<f64>()
        })
        .filter(|&p| body.contains(p))
        .map(|p| body.distance(p))
        .reduce(f64::max)
}

/// Triangles with their outer side to the body, each with whether it is in a fold: within [`FOLD`] above or below it, or a neighbour
/// of it, there is cloth the right way round. At the crease itself there is none.
fn in_folds(
    laid: &Laid,
    cloth_tree: &Bvh,
    body: &BodyIndex<'_>,
    wrong: &[Option<bool>],
) -> Vec<(usize, bool)> {
    let shown: Vec<usize> = (0..wrong.len()).filter(|&t| wrong[t] == Some(true)).collect();
    let (mut ends, mut segments) = (Vec::new(), Vec::new());
    for &t in &shown {
        let [a, b, c] = laid.mesh.corners(t);
        let middle = (a + b + c) / 3.0;
        let skin = body.surface.nearest(middle);
        let first = ends.len() as u32;
        ends.extend([middle - skin.normal * skin.distance.clamp(0.0, FOLD), middle + skin.normal * FOLD]);
        segments.push([first, first + 1]);
    }
    let mut folded = vec![false; segments.len()];
    for [s, t] in meetings(&ends, &segments, &laid.mesh, cloth_tree) {
        folded[s as usize] |= wrong[t as usize] != Some(true);
    }
    let edges = |t: usize| {
        let [a, b, c] = laid.mesh.triangles[t];
        [[a, b], [b, c], [c, a]].map(|[p, q]| [p.min(q), p.max(q)])
    };
    let sides: BTreeSet<[u32; 2]> =
        shown.iter().zip(&folded).filter(|(_, folded)| **folded).flat_map(|(&t, _)| edges(t)).collect();
    for (&t, folded) in shown.iter().zip(&mut folded) {
        *folded |= edges(t).iter().any(|edge| sides.contains(edge));
    }
    shown.into_iter().zip(folded).collect()
}

/// Whether triangle `t` hangs between two parts of the body, such as the side of a loose bodice beside an arm: its inner side has
/// skin in front of it too, within [`BETWEEN`].
fn is_between(laid: &Laid, body: &BodyIndex<'_>, t: usize) -> bool {
    let [a, b, c] = laid.mesh.corners(t);
    let inward = -(b - a).cross(c - a).normalize_or_zero();
    let hit = body.surface.ray((a + b + c) / 3.0, inward);
    hit.is_some_and(|hit| hit.distance <= BETWEEN && hit.normal.dot(inward) < 0.0)
}

/// For each triangle whether its outer side faces any of the nearest facets of the body; None where it is not near the body.
pub(super) fn wrong_side_out(laid: &Laid, body: &BodyIndex<'_>) -> Vec<Option<bool>> {
    (0..laid.mesh.triangles.len())
        .into_par_iter()
        .with_min_len(LEAST_SHARE)
        .map(|t| {
            let [a, b, c] = laid.mesh.corners(t);
            let normal = (b - a).cross(c - a).normalize_or_zero();
            let (facing, _) = body.surface.least_facing((a + b + c) / 3.0, NEAR, normal)?;
            Some(facing < WRONG_SIDE)
        })
        .collect()
}
