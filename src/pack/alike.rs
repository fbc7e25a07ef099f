//! Pieces that are cut alike: the same as another, or its mirror image.

use glam::DVec2;

use crate::pack::shape::Front;
use crate::pattern::{Piece, Trims};

/// Difference of lengths up to which they are equal, metres.
const ALIKE: f64 = 5e-4;
/// Difference of angles up to which grains are equal, radians: half a degree.
const ANGLE: f64 = 0.009;

/// How a piece is cut like another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Likeness {
    Same,
    Mirrored,
}

/// What is compared of a piece, seen from its front: its outline runs counter-clockwise.
#[derive(Clone, Debug)]
pub struct Cut {
    corners: Vec<DVec2>,
    lengths: Vec<f64>,
    trims: Vec<Trims>,
    /// Area within the outline, square metres.
    area: f64,
    grain: DVec2,
    /// Allowance, metres, and numbers of holes, internal lines and notches.
    others: (f64, [usize; 3]),
    /// Whether it has a cutting line of its own, which is not compared.
    has_own_line: bool,
}

impl Cut {
    pub fn of(piece: &Piece) -> Self {
        let front = Front::of(piece);
        Self {
            corners: piece.outline.iter().map(|edge| front.at(edge.start)).collect(),
            lengths: (0..piece.outline.len()).map(|i| piece.edge_length(i)).collect(),
            trims: piece.outline.iter().map(|edge| edge.trims).collect(),
            area: piece.signed_area().abs(),
            grain: front.grain(piece),
            others: (piece.allowance, [piece.holes.len(), piece.lines.len(), piece.notches.len()]),
            has_own_line: !piece.cut_line.is_empty(),
        }
    }

    /// How `other` is cut like this; None where it is another shape, or on another grain.
    pub fn likeness(&self, other: &Self) -> Option<Likeness> {
        let count = self.corners.len();
        let perimeter = |cut: &Self| cut.lengths.iter().sum::<f64>();
        let is_near = count == other.corners.len()
            && count > 1
            && self.others == other.others
            && !(self.has_own_line || other.has_own_line)
            && (perimeter(self) - perimeter(other)).abs() < ALIKE * count as f64
            && (self.area - other.area).abs() < ALIKE * perimeter(self);
        if !is_near {
            return None;
        }
        let fits = |likeness: Likeness| (0..count).any(|shift| self.fits(other, likeness, shift));
        [Likeness::Same, Likeness::Mirrored].into_iter().find(|likeness| fits(*likeness))
    }

    /// Whether corner 0 on corner `shift` of `other` brings all others together.
    fn fits(&self, other: &Self, likeness: Likeness, shift: usize) -> bool {
        let count = self.corners.len();
        let corner = |i: usize| match likeness {
            Likeness::Same => (shift + i) % count,
            Likeness::Mirrored => (shift + count - i % count) % count,
        };
        let edge = |i: usize| match likeness {
            Likeness::Same => corner(i),
            Likeness::Mirrored => corner(i + 1),
        };
        let near = |one: f64, other: f64| (one - other).abs() < ALIKE;
        let own = |from: usize, to: usize| self.corners[from].distance(self.corners[to]);
        let its = |from: usize, to: usize| other.corners[corner(from)].distance(other.corners[corner(to)]);
        let chord = |corners: &[DVec2], [from, to]: [usize; 2]| corners[to] - corners[from];
        let far = (0..count).max_by(|a, b| own(0, *a).total_cmp(&own(0, *b))).unwrap_or(0);
        (0..count).all(|i| {
            near(self.lengths[i], other.lengths[edge(i)])
                && self.trims[i] == other.trims[edge(i)]
                && near(own(0, i), its(0, i))
                && near(own(far, i), its(far, i))
        }) && {
            let one = self.grain.angle_to(chord(&self.corners, [0, far]));
            let two = other.grain.angle_to(chord(&other.corners, [corner(0), corner(far)]));
            let two = if likeness == Likeness::Mirrored { -two } else { two };
            // A grain has no head.
            (one - two).sin().abs() < ANGLE
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::{EdgeShape, Elastic, PlanePose};

    /// A sleeve of no symmetry, with a curved cap.
    fn sleeve() -> Piece {
        let corners = [DVec2::ZERO, DVec2::X * 0.4, DVec2::new(0.45, 0.3), DVec2::new(0.1, 0.35)];
        let mut piece = Piece::polygon("sleeve", &corners);
        piece.outline[2].shape = EdgeShape::Quadratic { control: DVec2::new(0.3, 0.5) };
        piece
    }

    /// Its mirror image, which begins at another corner.
    fn mirrored() -> Piece {
        let mut piece = sleeve();
        piece.outline = crate::pattern::curve::reversed(&piece.outline);
        for edge in &mut piece.outline {
            edge.start.x = -edge.start.x;
            edge.shape = edge.shape.mapped(true, |p| DVec2::new(-p.x, p.y));
        }
        piece.outline.rotate_left(1);
        piece
    }

    fn likeness(one: &Piece, other: &Piece) -> Option<Likeness> {
        Cut::of(one).likeness(&Cut::of(other))
    }

    #[test]
    fn copies_and_mirror_images_are_found() {
        let turned = Piece { pose: PlanePose { offset: DVec2::ONE, ..PlanePose::default() }, ..sleeve() };
        assert_eq!(likeness(&sleeve(), &turned), Some(Likeness::Same));
        assert_eq!(likeness(&sleeve(), &mirrored()), Some(Likeness::Mirrored));
        let mut longer = sleeve();
        longer.outline[1].start.x += 0.002;
        assert_eq!(likeness(&sleeve(), &longer), None);
        let mut gathered = sleeve();
        gathered.outline[0].trims.elastic = Some(Elastic::USUAL);
        assert_eq!(likeness(&sleeve(), &gathered), None);
        let bias = Piece { grainline: Some([DVec2::ZERO, DVec2::ONE]), ..sleeve() };
        assert_eq!(likeness(&sleeve(), &bias), None);
        let mirrored_bias = Piece { grainline: Some([DVec2::ZERO, DVec2::new(1.0, -1.0)]), ..mirrored() };
        assert_eq!(likeness(&bias, &mirrored_bias), Some(Likeness::Mirrored));
    }
}
