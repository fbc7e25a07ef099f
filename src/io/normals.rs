//! Normals of cloth for files, which the sides of seams and of fold lines have of their own where they are folded sharply.

use std::ops::Range;

use glam::DVec3;

use crate::cloth::{Garment, Wedges};
use crate::geometry::ids::PieceId;
use crate::geometry::mesh::vertex_normals;

/// Cosines of the angle between the normal of a vertex and that of one of its wedges, from which on the wedge has more and more of its
/// own normal, and beyond which it has it wholly, as in src/render/buffers.rs.
const SHARP: [f64; 2] = [0.86, 0.5];

/// The wedges of `piece` of `garment`, whose wedges are `all`.
pub(super) fn wedges_of_piece(all: &Wedges, garment: &Garment, piece: PieceId) -> PieceWedges {
    let corner = |first: bool| {
        garment.corners.partition_point(|c| if first { c.piece < piece } else { c.piece <= piece })
    };
    let (own, count) = (corner(true)..corner(false), garment.corners.len());
    let further = |end: usize| count + all.corners[count..].partition_point(|&c| (c as usize) < end);
    PieceWedges { further: further(own.start)..further(own.end), own }
}

/// The wedges of a piece, which are the vertices of its arrays.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct PieceWedges {
    /// One for each of its flat corners.
    own: Range<usize>,
    /// The further ones on its fold lines.
    further: Range<usize>,
}

impl PieceWedges {
    /// They in the order of the arrays.
    pub fn iter(&self) -> impl Iterator<Item = usize> {
        self.own.clone().chain(self.further.clone())
    }

    /// The place in the arrays of a wedge that is one of them.
    pub fn place(&self, wedge: u32) -> u32 {
        let wedge = wedge as usize;
        let place = if wedge < self.own.end {
            wedge - self.own.start
        } else {
            self.own.len() + wedge - self.further.start
        };
        place as u32
    }
}

/// Area-weighted unit normals of cloth; zero where no triangle is on the body.
#[derive(Clone, Debug)]
pub(super) struct Normals {
    /// Of each vertex of the garment, over all sides of its seams and folds.
    pub vertices: Vec<DVec3>,
    /// Of each wedge: that of its vertex, but that of its own side where a seam or fold line is folded sharply, as at a turn-up or a
    /// pleat. There the normals of both sides cancel each other out.
    pub wedges: Vec<DVec3>,
}

impl Normals {
    /// The normals at `positions` of the triangles with the indices `laid`.
    pub fn new(garment: &Garment, wedges: &Wedges, positions: &[DVec3], laid: &[usize]) -> Self {
        let triangles: Vec<[u32; 3]> = laid.iter().map(|&t| garment.triangles[t]).collect();
        let vertices = vertex_normals(positions, &triangles);
        let mut own = vec![DVec3::ZERO; wedges.corners.len()];
        for &t in laid {
            let [a, b, c] = garment.triangles[t].map(|v| positions[v as usize]);
            let normal = (b - a).cross(c - a);
            wedges.triangles[t].iter().for_each(|&wedge| own[wedge as usize] += normal);
        }
        let of_wedge = |(&corner, own): (&u32, DVec3)| {
            let common = vertices[garment.corners[corner as usize].vertex as usize];
            let Some(own) = own.try_normalize() else { return common };
            let share = (SHARP[0] - own.dot(common)) / (SHARP[0] - SHARP[1]);
            if share > 0.0 { common.lerp(own, share.min(1.0)).normalize_or(own) } else { common }
        };
        let wedges = wedges.corners.iter().zip(own).map(of_wedge).collect();
        Self { vertices, wedges }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::cloth::build;
    use crate::io::dressed::tests::{bent_squares, folded_square, two_squares};
    use crate::pattern::{Pattern, Piece};

    fn normals_of(garment: &Garment, positions: &[DVec3]) -> (Wedges, Normals) {
        let wedges = Wedges::new(garment);
        let all: Vec<usize> = (0..garment.triangles.len()).collect();
        let normals = Normals::new(garment, &wedges, positions, &all);
        (wedges, normals)
    }

    #[test]
    fn the_sides_of_a_seam_that_is_folded_sharply_have_normals_of_their_own() {
        // At 40 degrees no side is far enough from the common normal, beyond 120 at least one is wholly.
        for (angle, is_parted) in [(0.0, false), (40.0, false), (125.0, true), (175.0, true)] {
            let (_, garment, state) = bent_squares(angle);
            let (wedges, normals) = normals_of(&garment, &state.positions);
            assert_eq!(wedges.triangles, garment.triangle_corners, "no fold line, no further wedges");
            let (sin, cos) = f64::to_radians(angle).sin_cos();
            let first = garment.corners[0].piece;
            let (_, pairs) = &garment.seam_pairs[0];
            let on_seam: Vec<usize> = pairs.iter().flatten().map(|&c| c as usize).collect();
            for (i, (corner, normal)) in garment.corners.iter().zip(&normals.wedges).enumerate() {
                let face = if corner.piece == first { DVec3::Z } else { DVec3::new(sin, 0.0, cos) };
                assert!(normal.dot(face) > SHARP[1] - 1e-9, "{angle}: {normal} on {face}");
                assert!(on_seam.contains(&i) || normal.distance(face) < 1e-9, "{angle}: {normal} on {face}");
            }
            assert!(pairs.len() > 3);
            for [a, b] in pairs.iter().map(|pair| pair.map(|c| normals.wedges[c as usize])) {
                assert_eq!(a.dot(b) < SHARP[1], is_parted, "{angle}: {a} {b}");
                assert_eq!(a != b, is_parted, "{angle}: {a} {b}");
            }
        }
    }

    #[test]
    fn a_fold_line_within_a_piece_parts_normals_as_a_seam_does() {
        for (angle, is_parted) in [(30.0, false), (170.0, true)] {
            let (_, garment, state) = folded_square(angle);
            let (wedges, normals) = normals_of(&garment, &state.positions);
            let (sin, cos) = f64::to_radians(angle).sin_cos();
            let faces = [DVec3::Z, DVec3::new(sin, 0.0, cos)];
            // Away from the outline, where lines may end beside a corner of it.
            let is_inside = |corner: u32| (0.01..0.09).contains(&garment.corners[corner as usize].uv.y);
            let on_line = |&c: &u32| (garment.corners[c as usize].uv.x - 0.1).abs() < 1e-9 && is_inside(c);
            let inside: Vec<u32> = (0..garment.corners.len() as u32).filter(on_line).collect();
            let further: Vec<u32> =
                wedges.corners[garment.corners.len()..].iter().copied().filter(on_line).collect();
            assert!(inside.len() > 1);
            assert_eq!(further, inside, "two wedges for each");
            for (own, corners) in wedges.triangles.iter().zip(&garment.triangle_corners) {
                let middle: f64 =
                    corners.iter().map(|&c| garment.corners[c as usize].uv.x).sum::<f64>() / 3.0;
                let face = faces[usize::from(middle > 0.1)];
                for (&wedge, &corner) in own.iter().zip(corners) {
                    assert_eq!(wedges.corners[wedge as usize], corner);
                    let normal = normals.wedges[wedge as usize];
                    assert!(!is_inside(corner) || normal.dot(face) > SHARP[1], "{angle}: {normal} on {face}");
                }
            }
            for (further, &corner) in wedges.corners.iter().enumerate().skip(garment.corners.len()) {
                let [a, b] = [corner as usize, further].map(|wedge| normals.wedges[wedge]);
                assert_eq!(a != b, is_parted, "{angle}: {a} {b}");
            }
        }
    }

    #[test]
    fn wedges_of_a_piece_are_its_corners_and_the_further_ones_on_its_fold_lines() {
        for (_, garment, _) in [folded_square(90.0), two_squares()] {
            let wedges = Wedges::new(&garment);
            let mut seen = Vec::new();
            for (piece, _) in &garment.pieces {
                let own = wedges_of_piece(&wedges, &garment, *piece);
                for (place, wedge) in own.iter().enumerate() {
                    assert_eq!(own.place(wedge as u32) as usize, place);
                    assert_eq!(garment.corners[wedges.corners[wedge] as usize].piece, *piece);
                    seen.push(wedge);
                }
            }
            seen.sort_unstable();
            assert_eq!(seen, (0..wedges.corners.len()).collect::<Vec<_>>());
        }
    }

    #[test]
    fn cloth_that_is_not_laid_has_no_normals() {
        let square = [DVec2::ZERO, DVec2::X * 0.1, DVec2::splat(0.1), DVec2::Y * 0.1];
        let mut pattern = Pattern::default();
        pattern.add_piece(Piece::polygon("square", &square));
        let garment = build(&pattern, 0.03).0;
        let positions = vec![DVec3::NAN; garment.vertex_count];
        let normals = Normals::new(&garment, &Wedges::new(&garment), &positions, &[]);
        assert!(normals.wedges.iter().chain(&normals.vertices).all(|n| *n == DVec3::ZERO));
        assert_eq!(normals.wedges.len(), garment.corners.len());
    }
}
