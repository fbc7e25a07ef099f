//! Small steps that the height of hanging cloth asks for.

use glam::DVec3;

use crate::cloth::GRAVITY;
use crate::drape::garment::TICK;
use crate::drape::sheet::Sheet;
use crate::drape::solver::small_steps::substeps;

/// What decides how many small steps hanging cloth needs.
#[derive(Debug)]
pub(super) struct Hanging {
    /// For each vertex the first vertex of its connected component.
    parts: Vec<u32>,
    /// Mean length of the edges, metres.
    edge: f64,
    /// Strain beyond which cloth is rigid.
    strain: f64,
}

impl Hanging {
    pub fn new(sheet: &Sheet, strain: f64) -> Self {
        Self { parts: sheet.adjacency.parts(), edge: sheet.mean_edge(), strain }
    }

    /// Small steps in a tick that keep cloth at `positions` within the strain: as many as its highest part needs.
    pub fn steps_a_tick(&self, positions: &[DVec3]) -> usize {
        let mut reach = vec![(f64::MAX, f64::MIN); positions.len()];
        for (p, &part) in positions.iter().zip(&self.parts) {
            let (low, high) = &mut reach[part as usize];
            (*low, *high) = (p.y.min(*low), p.y.max(*high));
        }
        let highest = reach.iter().map(|(low, high)| high - low).fold(self.edge, f64::max);
        substeps(TICK, self.strain, GRAVITY.length(), highest, self.edge)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;

    #[test]
    fn parts_that_lie_far_apart_need_no_more_steps_than_the_highest_of_them() {
        let triangle = [DVec2::ZERO, DVec2::new(0.02, 0.0), DVec2::new(0.0, 0.02)];
        let sheet = Sheet::new(6, vec![[0, 1, 2], [3, 4, 5]], vec![triangle; 2]).expect("two triangles");
        let hanging = Hanging::new(&sheet, 0.01);
        let at = |heights: [f64; 6]| hanging.steps_a_tick(&heights.map(|y| DVec3::Y * y));
        let flat = at([0.0; 6]);
        assert!(at([0.0, 0.0, 1.0, 0.0, 0.0, 0.0]) > 3 * flat, "one hangs a metre");
        assert_eq!(at([0.0, 0.0, 0.0, 9.0, 9.0, 9.0]), flat, "one is nine metres above the other");
    }
}
