//! How places inside a piece move when its outline does, by mean value coordinates.
//!
//! Hormann and Floater, *Mean Value Coordinates for Arbitrary Planar Polygons* (2006): smooth inside, equal to the
//! displacements on the outline, and exact where all of the outline is moved, turned, stretched or sheared as one.

use glam::DVec2;

use crate::geometry::polygon::sides;
use crate::pattern::{EdgeShape, Piece};

/// Stretches into which a curve is divided.
const STRETCHES: usize = 16;
/// Distance from the outline within which a place counts as on it, metres.
const ON_OUTLINE: f64 = 1e-9;

/// Displacements along a closed polyline, and of every other place from them.
#[derive(Clone, Debug)]
pub struct Field {
    polygon: Vec<DVec2>,
    moved: Vec<DVec2>,
}

impl Field {
    /// How `piece` moves where its outline becomes that of `graded`, which has as many edges.
    pub fn between(piece: &Piece, graded: &Piece) -> Self {
        let (mut polygon, mut moved) = (Vec::new(), Vec::new());
        for (i, edge) in piece.outline.iter().enumerate() {
            let count = if edge.shape == EdgeShape::Line { 1 } else { STRETCHES };
            let fractions: Vec<f64> = (0..count).map(|k| k as f64 / count as f64).collect();
            let (from, to) = (piece.edge_points(i, &fractions), graded.edge_points(i, &fractions));
            moved.extend(from.iter().zip(&to).map(|(p, q)| *q - *p));
            polygon.extend(from);
        }
        Self { polygon, moved }
    }

    /// The displacement of `p`, metres.
    pub fn at(&self, p: DVec2) -> DVec2 {
        let Self { polygon, moved } = self;
        let n = polygon.len();
        let away: Vec<DVec2> = polygon.iter().map(|q| *q - p).collect();
        for (i, [a, b]) in sides(polygon).enumerate() {
            let along = (b - a).length_squared();
            let t = if along > 0.0 { ((p - a).dot(b - a) / along).clamp(0.0, 1.0) } else { 0.0 };
            if p.distance(a.lerp(b, t)) < ON_OUTLINE {
                return moved[i].lerp(moved[(i + 1) % n], t);
            }
        }
        // tan(α/2) of the angle α between neighbours as p sees them.
        let half: Vec<f64> = sides(&away)
            .map(|[u, v]| {
                let (cross, dot) = (u.perp_dot(v), u.dot(v));
                let lengths = u.length() * v.length();
                if cross == 0.0 { 0.0 } else { (lengths - dot) / cross }
            })
            .collect();
        let weight = |i: usize| (half[(i + n - 1) % n] + half[i]) / away[i].length();
        let (mut sum, mut total) = (DVec2::ZERO, 0.0);
        for (i, by) in moved.iter().enumerate() {
            sum += *by * weight(i);
            total += weight(i);
        }
        if total == 0.0 || !sum.is_finite() { DVec2::ZERO } else { sum / total }
    }

    /// Where `p` comes to lie.
    pub fn moved(&self, p: DVec2) -> DVec2 {
        p + self.at(p)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shape() -> Piece {
        let mut piece = Piece::polygon(
            "l",
            &[(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (0.0, 2.0)].map(DVec2::from),
        );
        piece.outline[3].shape = EdgeShape::Quadratic { control: DVec2::new(0.2, 1.0) };
        piece
    }

    #[test]
    fn what_is_stretched_and_sheared_as_one_is_exact_inside() {
        let piece = shape();
        let map = |p: DVec2| DVec2::new(1.1 * p.x + 0.05 * p.y + 0.2, 0.9 * p.y - 0.1);
        let mut graded = piece.clone();
        for edge in &mut graded.outline {
            (edge.start, edge.shape) = (map(edge.start), edge.shape.mapped(false, map));
        }
        // Points by arc length are not the same places on a curve that is sheared: straight edges here.
        for polygon in [&mut graded, &mut piece.clone()] {
            polygon.outline[3].shape = EdgeShape::Line;
        }
        let mut straight = piece;
        straight.outline[3].shape = EdgeShape::Line;
        let field = Field::between(&straight, &graded);
        for p in [(0.5, 0.5), (1.9, 0.1), (0.1, 1.7), (0.9, 1.0), (3.0, 3.0)].map(DVec2::from) {
            assert!(field.moved(p).distance(map(p)) < 1e-12, "{p}: {}", field.moved(p));
        }
    }

    #[test]
    fn on_the_outline_it_is_what_the_outline_does() {
        let piece = shape();
        let mut graded = piece.clone();
        graded.outline[1].start += DVec2::new(0.1, 0.0);
        let field = Field::between(&piece, &graded);
        assert!(field.at(DVec2::new(2.0, 0.0)).distance(DVec2::new(0.1, 0.0)) < 1e-12);
        assert!(field.at(DVec2::new(1.0, 0.0)).distance(DVec2::new(0.05, 0.0)) < 1e-12);
        assert_eq!(field.at(DVec2::new(0.0, 1.0)), DVec2::ZERO);
        let inside = field.at(DVec2::new(1.0, 0.4));
        assert!(inside.x > 0.0 && inside.x < 0.1 && inside.y == 0.0, "{inside}");
    }
}
