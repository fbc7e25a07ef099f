//! How the cloth sits on the body: inside or outside, through it, inside out.

use glam::DVec3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::body::Surface;
use crate::fit::laid::Laid;
use crate::fit::openings::{Opening, openings};
use crate::fit::shape::quantile;
use crate::geometry::bvh::Bvh;
use crate::geometry::crossings::meetings;
use crate::geometry::winding::Winding;

/// Cloth nearer to the skin than this (metres) must show it its inner side.
pub(super) const NEAR: f64 = 0.02;
/// Cloth so near, metres, is the other layer of a fold.
const FOLD: f64 = 0.03;
/// Cloth that shows its inner side to skin no farther than this, metres, belongs to that skin, whatever it comes near to outside.
const BETWEEN: f64 = 0.10;
/// A triangle whose normal has a smaller cosine with the skin's than this lies wrong side out.
pub(super) const WRONG_SIDE: f64 = -0.2;
/// A triangle of the body is hidden when a point this far (metres) before it lies inside the body.
const BEFORE_SKIN: f64 = 1e-4;
/// Where a triangle is sampled, in barycentric coordinates times their sum.
const SAMPLES: [[f64; 3]; 7] = [
    [1.0, 1.0, 1.0],
    [4.0, 1.0, 1.0],
    [1.0, 4.0, 1.0],
    [1.0, 1.0, 4.0],
    [1.0, 1.0, 0.0],
    [0.0, 1.0, 1.0],
    [1.0, 0.0, 1.0],
];

/// Cloth inside the body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Penetration {
    /// Vertices.
    pub vertices: usize,
    /// Triangles with one of seven samples inside.
    pub faces: usize,
    /// Of the deepest vertex or sample, metres.
    pub max_depth: f64,
}

/// Signed distances of the vertices from the skin, metres.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Clearance {
    /// The middle one.
    pub median: f64,
    /// 95 of 100 are smaller.
    pub p95: f64,
}

/// A body ready to be measured against; build it once per body.
#[derive(Debug)]
pub struct BodyIndex<'a> {
    surface: &'a Surface,
    winding: Winding<'a>,
}

impl<'a> BodyIndex<'a> {
    /// Builds the index.
    pub fn new(surface: &'a Surface) -> Self {
        Self { surface, winding: Winding::new(&surface.mesh) }
    }

    /// The body.
    pub fn surface(&self) -> &'a Surface {
        self.surface
    }

    /// Whether `p` is inside, where the body may cross itself too.
    pub fn contains(&self, p: DVec3) -> bool {
        self.winding.contains(p)
    }

    /// Over the body's triangles.
    pub(super) fn tree(&self) -> &Bvh {
        self.winding.tree()
    }

    /// Distance to the surface, metres, never negative.
    fn distance(&self, p: DVec3) -> f64 {
        self.surface.nearest(p).point.distance(p)
    }

    /// Whether triangle `t` lies on the outside: where a body crosses itself, in the armpits say, some do not.
    fn is_skin(&self, t: u32) -> bool {
        let [a, b, c] = self.surface.mesh.corners(t as usize);
        let before = (a + b + c) / 3.0 + self.surface.face_normals[t as usize] * BEFORE_SKIN;
        !self.contains(before)
    }

    fn is_skin_edge(&self, e: u32) -> bool {
        self.surface.adjacency.edge_triangles.of(e).iter().any(|&t| self.is_skin(t))
    }
}

/// What cloth and body do to each other.
pub(super) struct OnBody {
    pub penetration: Penetration,
    pub edges_through_body: usize,
    pub body_edges_through_garment: usize,
    pub faces_near_body: usize,
    pub flipped_faces: usize,
    pub faces_in_folds: usize,
    pub faces_between: usize,
    pub clearance: Clearance,
    pub openings: Vec<Opening>,
}

pub(super) fn on_body(laid: &Laid, cloth_tree: &Bvh, body: &BodyIndex<'_>) -> OnBody {
    let body_mesh = &body.surface.mesh;
    let body_edges = &body.surface.adjacency.edges;
    let through_body = meetings(&laid.mesh.positions, &laid.edges, body_mesh, body.winding.tree());
    let through_cloth = meetings(&body_mesh.positions, body_edges, &laid.mesh, cloth_tree);
    let (distances, penetrating_vertices) = distances(laid, body);
    let cut = cut_faces(laid, &through_body, &through_cloth, &penetrating_vertices);
    let wrong = wrong_side_out(laid, body);
    let folded = in_folds(laid, cloth_tree, body, &wrong);
    OnBody {
        penetration: penetration(laid, body, &distances, &cut),
        edges_through_body: through_body.iter().filter(|&&[_, t]| body.is_skin(t)).count(),
        body_edges_through_garment: through_cloth.iter().filter(|&&[e, _]| body.is_skin_edge(e)).count(),
        faces_near_body: wrong.iter().filter(|f| f.is_some()).count(),
        flipped_faces: wrong.iter().filter(|f| **f == Some(true)).count(),
        faces_in_folds: folded.iter().filter(|(_, folded)| *folded).count(),
        faces_between: folded.iter().filter(|(t, folded)| !folded && is_between(laid, body, *t)).count(),
        clearance: Clearance { median: quantile(&distances, 0.5), p95: quantile(&distances, 0.95) },
        openings: openings(&laid.mesh, body_mesh, body.winding.tree(), |t| body.is_skin(t)),
    }
}

/// Signed distances of the vertices, ascending, and which vertices (by number) are inside.
fn distances(laid: &Laid, body: &BodyIndex<'_>) -> (Vec<f64>, Vec<bool>) {
    let signed: Vec<f64> = laid
        .used
        .par_iter()
        .with_min_len(256)
        .map(|&v| {
            let p = laid.mesh.positions[v as usize];
            let distance = body.distance(p);
            if body.contains(p) { -distance } else { distance }
        })
        .collect();
    let mut inside = vec![false; laid.mesh.positions.len()];
    for (&v, &d) in laid.used.iter().zip(&signed) {
        inside[v as usize] = d < 0.0;
    }
    let mut sorted = signed;
    sorted.sort_unstable_by(f64::total_cmp);
    (sorted, inside)
}

/// Triangles of which some point may be inside: a vertex is, or the body's surface cuts them. All others lie wholly on
/// the side of their vertices.
fn cut_faces(
    laid: &Laid,
    through_body: &[[u32; 2]],
    through_cloth: &[[u32; 2]],
    inside: &[bool],
) -> Vec<u32> {
    let mut cut_edges = vec![false; laid.edges.len()];
    for &[e, _] in through_body {
        cut_edges[e as usize] = true;
    }
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
        .with_min_len(64)
        .filter_map(|&t| face_depth(laid.mesh.corners(t as usize), body))
        .collect();
    let vertex_depth = distances.first().map_or(0.0, |&d| (-d).max(0.0));
    Penetration {
        vertices: distances.iter().filter(|&&d| d < 0.0).count(),
        faces: depths.len(),
        max_depth: depths.iter().copied().fold(vertex_depth, f64::max),
    }
}

/// How deep the deepest sample of a triangle lies inside, if any does.
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

/// Triangles that show the body their outer side, and whether they lie in a fold: on them or under them, no farther than
/// [`FOLD`], lies cloth the right way round.
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
    shown.into_iter().zip(folded).collect()
}

/// Whether triangle `t` hangs between two parts of the body, the side of a loose bodice beside an arm: skin is before its inner
/// side too, no farther than [`BETWEEN`].
fn is_between(laid: &Laid, body: &BodyIndex<'_>, t: usize) -> bool {
    let [a, b, c] = laid.mesh.corners(t);
    let inward = -(b - a).cross(c - a).normalize_or_zero();
    let hit = body.surface.ray((a + b + c) / 3.0, inward);
    hit.is_some_and(|hit| hit.distance <= BETWEEN && hit.normal.dot(inward) < 0.0)
}

/// Of each triangle near the body: whether it shows any of the facets it is nearest to its outer side.
pub(super) fn wrong_side_out(laid: &Laid, body: &BodyIndex<'_>) -> Vec<Option<bool>> {
    (0..laid.mesh.triangles.len())
        .into_par_iter()
        .with_min_len(256)
        .map(|t| {
            let [a, b, c] = laid.mesh.corners(t);
            let normal = (b - a).cross(c - a).normalize_or_zero();
            let (facing, _) = body.surface.least_facing((a + b + c) / 3.0, NEAR, normal)?;
            Some(facing < WRONG_SIDE)
        })
        .collect()
}
