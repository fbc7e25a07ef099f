//! A piece as it is drawn: seen from its front, turned as in the pattern pane, each in a plane of its own.

use glam::DVec2;

use crate::io::cutting_line;
use crate::pattern::piece::flattened_loop;
use crate::pattern::{Piece, PlanePose};

/// Largest distance of chords from the curves, metres.
const CHORDS: f64 = 3e-4;
/// Half the length of a grainline where the piece has none, as a share of its size along it.
const GRAIN: f64 = 0.2;

/// Maps a piece's own plane to that of its drawing.
#[derive(Clone, Copy, Debug)]
pub struct Front {
    pose: PlanePose,
    /// Whether the pose shows the back, so that the drawing is its mirror image.
    is_back: bool,
}

impl Front {
    pub fn of(piece: &Piece) -> Self {
        let pose = PlanePose { offset: DVec2::ZERO, ..piece.pose };
        Self { pose, is_back: (piece.signed_area() < 0.0) != pose.flipped }
    }

    /// The point `p` of the piece in the drawing, metres, y up.
    pub fn at(&self, p: DVec2) -> DVec2 {
        let q = self.pose.plane_from_piece(p);
        if self.is_back { DVec2::new(-q.x, q.y) } else { q }
    }

    pub fn all(&self, points: Vec<DVec2>) -> Vec<DVec2> {
        points.into_iter().map(|p| self.at(p)).collect()
    }

    /// Unit vector along the grain of `piece` in the drawing.
    pub fn grain(&self, piece: &Piece) -> DVec2 {
        (self.at(piece.grain()) - self.at(DVec2::ZERO)).normalize_or(DVec2::Y)
    }
}

/// The lines of a piece, metres, y up.
#[derive(Clone, Debug)]
pub struct Shape {
    /// The line along which it is cut.
    pub cut: Vec<DVec2>,
    /// The seam line, where it is another one.
    pub seam: Vec<DVec2>,
    pub holes: Vec<Vec<DVec2>>,
    pub lines: Vec<Vec<DVec2>>,
    /// Points of notches on the seam line, each with the unit vector into the piece.
    pub notches: Vec<[DVec2; 2]>,
    pub grain: [DVec2; 2],
    /// Lower and upper corner of the bounding box of all lines.
    pub bounds: [DVec2; 2],
}

impl Shape {
    pub fn of(piece: &Piece) -> Self {
        let front = Front::of(piece);
        let cut = front.all(cutting_line(piece, CHORDS));
        let seam = front.all(piece.flattened(CHORDS));
        let has_allowance = piece.allowance > 0.0 || !piece.cut_line.is_empty();
        let lines: Vec<Vec<DVec2>> =
            piece.lines.iter().map(|line| front.all(line.flattened(CHORDS))).collect();
        let bounds = bounds(cut.iter().chain(&seam).chain(lines.iter().flatten()));
        let grain = match piece.grainline {
            Some(ends) => ends.map(|p| front.at(p)),
            None => {
                let (middle, way) = ((bounds[0] + bounds[1]) / 2.0, front.grain(piece));
                let half = way * ((bounds[1] - bounds[0]).dot(way.abs()) * GRAIN);
                [middle - half, middle + half]
            }
        };
        Self {
            seam: if has_allowance { seam } else { Vec::new() },
            holes: piece.holes.iter().map(|hole| front.all(flattened_loop(hole, CHORDS))).collect(),
            notches: piece.notches.iter().map(|notch| notch_at(piece, front, notch.edge, notch.at)).collect(),
            cut,
            lines,
            grain,
            bounds,
        }
    }

    /// Width and height, metres.
    pub fn size(&self) -> DVec2 {
        self.bounds[1] - self.bounds[0]
    }
}

/// A place on an edge, and the unit vector from there into the piece.
fn notch_at(piece: &Piece, front: Front, edge: usize, at: f64) -> [DVec2; 2] {
    let around = [(at - 0.01).max(0.0), at.clamp(0.0, 1.0), (at + 0.01).min(1.0)];
    let points = front.all(piece.edge_points(edge, &around));
    // Seen from the front an outline runs counter-clockwise: the cloth is on the left, as it is round holes if they run the other
    // way.
    let left = (points[2] - points[0]).perp().normalize_or_zero();
    let area = crate::geometry::polygon::signed_area(
        &front.all(flattened_loop(piece.loop_edges(piece.loop_of(edge).0), CHORDS)),
    );
    let is_hole = piece.loop_of(edge).0 > 0;
    [points[1], if (area > 0.0) == is_hole { -left } else { left }]
}

/// Width and height of a piece as it is drawn, without its seam allowance, metres.
pub fn size_of(piece: &Piece) -> DVec2 {
    let front = Front::of(piece);
    let [low, high] = bounds(front.all(piece.flattened(CHORDS)).iter());
    high - low
}

fn bounds<'p>(points: impl Iterator<Item = &'p DVec2>) -> [DVec2; 2] {
    let mut points = points.copied();
    let first = points.next().unwrap_or_default();
    points.fold([first; 2], |[low, high], p| [low.min(p), high.max(p)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::polygon::signed_area;
    use crate::pattern::Notch;

    #[test]
    fn pieces_are_seen_from_their_front_and_notches_point_inwards() {
        let corners = [DVec2::ZERO, DVec2::X * 0.4, DVec2::new(0.4, 0.2), DVec2::Y * 0.2];
        let mut piece = Piece::polygon("a", &corners);
        piece.notches.push(Notch { edge: 0, at: 0.5 });
        let mut back = Piece::polygon("b", &corners.map(|p| DVec2::new(-p.x, p.y)));
        back.notches = piece.notches.clone();
        for piece in [&mut piece, &mut back] {
            for flipped in [false, true] {
                piece.pose = PlanePose { offset: DVec2::ONE, rotation: 0.0, flipped };
                let shape = Shape::of(piece);
                assert!(signed_area(&shape.cut) > 0.0, "{} {flipped}", piece.name);
                let [at, inward] = shape.notches[0];
                assert!((inward - DVec2::Y).length() < 1e-9 && at.y.abs() < 1e-9, "{at} {inward}");
                assert!((shape.size() - DVec2::new(0.4, 0.2)).length() < 1e-9);
            }
        }
        piece.allowance = 0.01;
        assert!((Shape::of(&piece).size() - DVec2::new(0.42, 0.22)).length() < 1e-3);
        assert!((size_of(&piece) - DVec2::new(0.4, 0.2)).length() < 1e-9);
    }
}
