//! Parts of a garment that only buttons hold, such as a bow, go with what they are buttoned to. Global steps and contact do not know of
//! buttons: without this such a part drifts away on a long way.

use std::cmp::Reverse;

use glam::DVec3;

use crate::cloth::trims::ClothPoint;
use crate::cloth::{ClothState, Garment};
use crate::geometry::disjoint_sets::DisjointSets;

/// A part that is sewn to nothing else.
#[derive(Clone, Debug)]
struct Part {
    vertices: Vec<u32>,
    /// Its buttons: the place on the larger part that it is buttoned to, and the place on itself.
    buttons: Vec<[ClothPoint; 2]>,
}

/// The parts of a garment that follow others, each after the one that it follows.
#[derive(Clone, Debug, Default)]
pub(super) struct Fastened {
    parts: Vec<Part>,
}

impl Fastened {
    /// Of two parts that are buttoned to each other the one with fewer vertices follows.
    pub fn of(garment: &Garment) -> Self {
        if garment.trims.buttons.is_empty() {
            return Self::default();
        }
        let mut sets = DisjointSets::new(garment.vertex_count);
        garment.adjacency.edges.iter().for_each(|&[a, b]| sets.join(a, b));
        let part_of: Vec<u32> = (0..garment.vertex_count as u32).map(|v| sets.root(v)).collect();
        let mut sizes = vec![0u32; garment.vertex_count];
        part_of.iter().for_each(|&part| sizes[part as usize] += 1);
        let part = |point: &ClothPoint| part_of[garment.corners[point.corners[0] as usize].vertex as usize];
        // Larger parts first; of equal ones the first.
        let rank = |part: u32| (Reverse(sizes[part as usize]), part);
        let mut order: Vec<u32> = garment.trims.buttons.iter().flatten().map(part).collect();
        order.sort_by_key(|&part| rank(part));
        order.dedup();
        let follows = |&own: &u32| {
            let buttons = garment.trims.buttons.iter().filter_map(|&[a, b]| match [part(&a), part(&b)] {
                [of_a, of_b] if of_b == own && rank(of_a) < rank(own) => Some([a, b]),
                [of_a, of_b] if of_a == own && rank(of_b) < rank(own) => Some([b, a]),
                _ => None,
            });
            let vertices = (0..part_of.len() as u32).filter(|&v| part_of[v as usize] == own);
            Part { vertices: vertices.collect(), buttons: buttons.collect() }
        };
        let parts = order.iter().map(follows).filter(|part| !part.buttons.is_empty()).collect();
        Self { parts }
    }

    /// Moves each part that has come away from what it is buttoned to by more than `far`, metres, back to it. Returns whether one was
    /// moved.
    pub fn follow(&self, garment: &Garment, state: &mut ClothState, far: f64) -> bool {
        let mut has_moved = false;
        for Part { vertices, buttons } in &self.parts {
            let gap = |[other, own]: &[ClothPoint; 2]| {
                Some(other.place(garment, state)? - own.place(garment, state)?)
            };
            let gaps: Vec<DVec3> = buttons.iter().filter_map(gap).collect();
            let way = gaps.iter().sum::<DVec3>() / gaps.len().max(1) as f64;
            if way.length() > far {
                vertices.iter().for_each(|&v| state.positions[v as usize] += way);
                has_moved = true;
            }
        }
        has_moved
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::cloth::build;
    use crate::geometry::ids::PieceId;
    use crate::pattern::{Button, Pattern, Piece, PiecePoint};

    /// A panel with a bow of two pieces in a row tacked to it: the knot to the panel, the tail to the knot.
    #[test]
    fn what_is_buttoned_to_something_larger_goes_after_it() {
        let mut pattern = Pattern::default();
        let square = |size: f64| [[0.0, 0.0], [size, 0.0], [size, size], [0.0, size]].map(DVec2::from);
        // The smallest comes first, so that the order does not come by itself.
        let [tail, knot, panel] =
            [0.05, 0.1, 0.4].map(|size| pattern.add_piece(Piece::polygon("piece", &square(size))));
        let tack = |pattern: &mut Pattern, ends: [PieceId; 2]| {
            let [button, hole] = ends.map(|piece| PiecePoint { piece, at: DVec2::splat(0.025) });
            pattern.add_button(Button {
                button,
                hole,
                diameter: 0.01,
                colour: [0; 3],
                open: false,
                tack: true,
            });
        };
        tack(&mut pattern, [tail, knot]);
        tack(&mut pattern, [knot, panel]);
        let (garment, _) = build(&pattern, 0.02);
        let fastened = Fastened::of(&garment);
        assert_eq!(garment.trims.buttons.len(), 2);
        let mut before = ClothState {
            positions: vec![DVec3::ZERO; garment.vertex_count],
            mapped: vec![true; garment.vertex_count],
        };
        for corner in &garment.corners {
            before.positions[corner.vertex as usize] = corner.uv.extend(0.0);
        }
        let moved_by = |by: [f64; 3], far: f64| {
            let mut state = before.clone();
            for (vs, piece) in garment.triangles.iter().zip(&garment.triangle_pieces) {
                let k = [tail, knot, panel].iter().position(|p| p == piece).expect("a piece");
                vs.iter().for_each(|&v| state.positions[v as usize].z = by[k]);
            }
            let has_moved = fastened.follow(&garment, &mut state, far);
            let heights = [tail, knot, panel].map(|piece| {
                let t = garment.triangle_pieces.iter().position(|p| *p == piece).expect("a triangle");
                state.positions[garment.triangles[t][0] as usize].z
            });
            (has_moved, heights)
        };
        let near = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
        let (has_moved, heights) = moved_by([0.3, -0.2, 0.1], 0.004);
        assert!(has_moved && near(heights, [0.1; 3]), "{heights:?}");
        let (has_moved, heights) = moved_by([0.006, 0.003, 0.0], 0.004);
        assert!(!has_moved && near(heights, [0.006, 0.003, 0.0]), "as near as buttons are: {heights:?}");
    }
}
