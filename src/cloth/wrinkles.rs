//! Wrinkles on the mesh of a piece: the angle at rest of each edge that bends.
//!
//! An edge's angle is that of the two triangles beside it when the mesh lies over the ridge: its points are moved to where the
//! profile puts them. So all angles fit one surface, on any mesh. Curvature across the edge times the distance of the triangles' far
//! corners, which agrees with it at edges along the line, does not: on an equilateral mesh it asks edges at 60° to bend, which lie
//! straight on a ridge, and the cloth comes to rest lower, and bent along the line as well.

use glam::{DVec2, DVec3};

use crate::geometry::adjacency::Adjacency;
use crate::pattern::wrinkles::{ridges, risen};
use crate::pattern::{Piece, PieceMesh};

/// How cloth bends across an edge in a wrinkle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bend {
    /// Angle at rest, radians; positive where the fronts of the two triangles turn towards each other.
    pub angle: f64,
    /// Bending stiffness besides that of the cloth, N·m.
    pub stiffness: f64,
    /// Mean height of the two triangles over the edge, metres. A hinge as stiff as the bending stiffness over this, per length,
    /// bends an equilateral mesh with the energy of a plate.
    pub across: f64,
}

impl Bend {
    /// Moment per length and radian of a hinge at the edge, N, of cloth with this bending `stiffness` of its own, N·m.
    pub fn strength(&self, stiffness: f64) -> f64 {
        (self.stiffness + stiffness) / self.across
    }
}

/// The edges that bend in the wrinkles of `piece`, each by its two points of `mesh`: all of the triangles that have a corner in one.
pub fn bends(piece: &Piece, mesh: &PieceMesh) -> Vec<([u32; 2], Bend)> {
    let ridges = ridges(piece);
    if ridges.is_empty() {
        return Vec::new();
    }
    let held = |p: DVec2| {
        let within = ridges.iter().filter(|ridge| ridge.holds(p));
        within.map(|ridge| ridge.wrinkle.stiffness()).fold(0.0, f64::max)
    };
    let stiffness: Vec<f64> = mesh.points.iter().map(|&p| held(p)).collect();
    // As the front of the cloth is seen.
    let side = if mesh.front_is_far { DVec3::new(-1.0, 1.0, 1.0) } else { DVec3::ONE };
    let flat = |v: u32| mesh.points[v as usize].extend(0.0) * side;
    let raised: Vec<DVec3> = mesh.points.iter().map(|&p| risen(&ridges, p) * side).collect();
    let adjacency = Adjacency::new(mesh.points.len(), &mesh.triangles);
    let mut found = Vec::new();
    for e in 0..adjacency.edges.len() as u32 {
        let Some(corners) = adjacency.hinge(&mesh.triangles, e) else { continue };
        let stiffness = corners.iter().map(|&v| stiffness[v as usize]).fold(0.0, f64::max);
        if stiffness > 0.0 {
            let [a, b, ..] = corners;
            let across = heights(corners.map(flat));
            let angle = angle(corners.map(|v| raised[v as usize]));
            found.push(([a, b], Bend { angle, stiffness, across }));
        }
    }
    found
}

/// Mean height of the triangles a b c and b a d over a b.
fn heights([a, b, c, d]: [DVec3; 4]) -> f64 {
    let along = (b - a).normalize_or_zero();
    (along.cross(c - a).length() + along.cross(d - a).length()) / 2.0
}

/// Angle between the triangles a b c and b a d, radians, positive where their fronts turn towards each other.
fn angle([a, b, c, d]: [DVec3; 4]) -> f64 {
    let along = b - a;
    let (first, second) = (along.cross(c - a), (d - a).cross(along));
    second.cross(first).dot(along.normalize_or_zero()).atan2(first.dot(second))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cloth::build;
    use crate::cloth::trims::Along;
    use crate::pattern::{Edge, Fold, InternalLine, Pattern, Trims, Wrinkle};

    /// A panel 0.2 × 0.1 m with a wrinkle across its middle, from edge to edge, seen from the front or drawn from its back.
    fn panel(wrinkle: Wrinkle, is_turned: bool) -> Pattern {
        let mut corners = [(0.0, 0.0), (0.2, 0.0), (0.2, 0.1), (0.0, 0.1)].map(DVec2::from);
        if is_turned {
            corners.reverse();
        }
        let trims = Trims { wrinkle: Some(wrinkle), ..Trims::default() };
        let edges = vec![Edge { start: DVec2::new(0.1, 0.0), trims, ..Edge::default() }];
        let lines = vec![InternalLine { edges, end: DVec2::new(0.1, 0.1), ..InternalLine::default() }];
        let mut pattern = Pattern::default();
        pattern.add_piece(Piece { lines, ..Piece::polygon("panel", &corners) });
        pattern
    }

    #[test]
    fn the_ends_of_a_wrinkle_are_flat_and_its_crest_turns_back() {
        for (height, is_turned) in [(0.002, false), (-0.002, false), (0.002, true)] {
            let (garment, problems) = build(&panel(Wrinkle { width: 0.06, height }, is_turned), 0.02);
            assert!(problems.is_empty(), "{problems:?}");
            let bends = &garment.trims.wrinkles;
            let ends = |bend: &Along<Bend>| bend.corners.map(|c| garment.corners[c as usize].uv);
            // What an edge turns the slope across the line, times its length along the line.
            let turn = |bend: &Along<Bend>| {
                let [a, b] = ends(bend);
                bend.what.angle * (b - a).y.powi(2) / a.distance(b)
            };
            let sum: f64 = bends.iter().map(turn).sum();
            let all: f64 = bends.iter().map(|bend| turn(bend).abs()).sum();
            assert!(all > 0.03 && sum.abs() < 0.02 * all, "{sum} of {all}");
            let is_crest = |bend: &&Along<Bend>| ends(bend).iter().all(|p| (p.x - 0.1).abs() < 1e-9);
            let crest: Vec<f64> = bends.iter().filter(is_crest).map(|bend| bend.what.angle).collect();
            assert!(crest.len() >= 7, "{crest:?}");
            assert!(
                crest.iter().all(|angle| angle * height < 0.0),
                "the front of a ridge turns away: {crest:?}"
            );
        }
    }

    #[test]
    fn six_edges_lie_across_a_wrinkle_and_none_is_too_thin() {
        for width in [0.1, 0.06, 0.03, 0.012] {
            let (garment, problems) = build(&panel(Wrinkle { width, height: width / 8.0 }, false), 0.02);
            assert!(problems.is_empty(), "{problems:?}");
            // Edges that cross a line across the middle of the wrinkle.
            let crossed: std::collections::BTreeSet<[u32; 2]> = garment
                .triangle_corners
                .iter()
                .flat_map(|t| [0, 1, 2].map(|k| [t[k], t[(k + 1) % 3]]))
                .filter(|ends| {
                    let [a, b] = ends.map(|c| garment.corners[c as usize].uv);
                    let share = (0.0503 - a.y) / (b.y - a.y);
                    let x = a.x + share * (b.x - a.x);
                    (0.0..=1.0).contains(&share) && (x - 0.1).abs() < width / 2.0
                })
                .map(|[a, b]| [a.min(b), a.max(b)])
                .collect();
            assert!(crossed.len() >= 6, "{width}: {}", crossed.len());
            let area = |r: &[DVec2; 3]| (r[1] - r[0]).perp_dot(r[2] - r[0]) / 2.0;
            let whole: f64 = garment.rest.iter().map(area).sum();
            assert!((whole - 0.02).abs() < 1e-12, "{whole} m²");
            let smallest = garment.rest.iter().flat_map(|r| {
                let turn = |k: usize| (r[(k + 1) % 3] - r[k]).angle_to(r[(k + 2) % 3] - r[k]);
                [0, 1, 2].map(|k| turn(k).abs().to_degrees())
            });
            let smallest = smallest.fold(f64::MAX, f64::min);
            assert!(smallest > 5.0, "{width}: smallest angle {smallest}°");
        }
    }

    #[test]
    fn a_mesh_without_wrinkles_has_no_bends_and_a_fold_has_its_own_edges() {
        let mut pattern = panel(Wrinkle::USUAL, false);
        let piece = std::sync::Arc::make_mut(pattern.pieces.values_mut().next().expect("a piece"));
        piece.lines[0].edges[0].trims.fold = Some(Fold::pressed(1.0));
        let both = build(&pattern, 0.02).0.trims;
        let folded = both.folds.iter().filter(|fold| {
            let same = |bend: &&Along<Bend>| bend.corners.iter().all(|c| fold.corners.contains(c));
            both.wrinkles.iter().any(|bend| same(&bend))
        });
        assert_eq!(folded.count(), both.folds.len(), "both are told; the solver takes the fold first");
        let piece = std::sync::Arc::make_mut(pattern.pieces.values_mut().next().expect("a piece"));
        piece.lines[0].edges[0].trims.wrinkle = None;
        assert!(build(&pattern, 0.02).0.trims.wrinkles.is_empty());
    }
}
