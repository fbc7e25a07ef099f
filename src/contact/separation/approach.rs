//! Which triangles of the obstacle a triangle of the cloth may meet. The obstacle is still: how far the triangle is from all of it at
//! least stays known while the triangle is near where that was measured, and until it may come so near there is nothing to look for.

use glam::DVec3;

use crate::contact::separation::broad::Around;
use crate::contact::separation::candidates::MARGIN;
use crate::contact::separation::grown;
use crate::contact::separation::topology::{Obstacle, PlacedTriangle, surely};

/// A triangle of the cloth before the obstacle.
#[derive(Clone, Debug)]
pub(super) struct Approach {
    /// Corners of the triangle when its distance was measured, metres.
    at: [DVec3; 3],
    /// Its distance from the whole obstacle was at least this, metres; negative where that is not known.
    least: f64,
    /// The box in which `near` are all triangles of the obstacle.
    around: Around,
    /// Triangles of the obstacle, as indices in the order of the leaves of its tree, which rise.
    near: Vec<u32>,
}

impl Approach {
    /// Nothing is known yet.
    pub fn unknown() -> Self {
        Self { at: [DVec3::ZERO; 3], least: -1.0, around: Around::default(), near: Vec::new() }
    }

    /// Whether the triangle cannot come to the obstacle within its reach.
    pub fn is_off(&self, own: &PlacedTriangle) -> bool {
        let moved = (0..3).map(|k| own.corners[k].distance_squared(self.at[k])).fold(0.0, f64::max).sqrt();
        self.least - moved > surely(own.farthest)
    }

    /// Calls `look` for every triangle of the obstacle that the triangle may come to within its reach, as an index in the order of the
    /// leaves, which rise, and measures its distance.
    pub fn look(&mut self, own: &PlacedTriangle, obstacle: &Obstacle, look: &mut dyn FnMut(u32)) {
        self.gather(own, obstacle);
        let (now, boxes, order) = (Around::of(&own.around), obstacle.broad.items(), obstacle.broad.order());
        let far = surely(own.farthest);
        self.at = own.corners;
        // Nothing else is as near. Of what is about twice as far as the triangle may go it is enough to know that; the box is a little
        // larger than that, as it is rounded.
        self.least = self.around.room_round(&now).min(1.9 * far);
        let round = now.grown((2.0 * far) as f32);
        for &at in self.near.iter().filter(|&&at| round.meets(&boxes[at as usize])) {
            let mut gap = now.gap(&boxes[at as usize]);
            if gap <= far {
                let other = &obstacle.placed[order[at as usize] as usize];
                gap = gap.max(own.gap(other));
                if gap <= far {
                    gap = gap.max(other.gap(own));
                }
                if gap <= far {
                    look(at);
                }
            }
            self.least = self.least.min(gap);
        }
    }

    /// Calls `look` for every triangle of the obstacle that the triangle may meet where it is, as [`Self::look`] does.
    pub fn touch(&mut self, own: &PlacedTriangle, obstacle: &Obstacle, look: &mut dyn FnMut(u32)) {
        self.gather(own, obstacle);
        let (now, boxes) = (Around::of(&own.around), obstacle.broad.items());
        self.near.iter().filter(|&&at| now.meets(&boxes[at as usize])).for_each(|&at| look(at));
    }

    /// Searches the tree if the triangle may leave the box in which what is near is known.
    fn gather(&mut self, own: &PlacedTriangle, obstacle: &Obstacle) {
        let now = Around::of(&grown(&own.around, own.farthest));
        if !self.around.contains(&now) {
            self.around = now.grown((MARGIN * own.farthest) as f32);
            self.near.clear();
            obstacle.broad.meeting(&self.around, |at| self.near.push(at));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::separation::topology::Topology;
    use crate::geometry::adjacency::Adjacency;
    use crate::geometry::random::Random;

    /// A hilly ground of `side` × `side` squares, 1 cm each.
    fn ground(side: u32) -> Obstacle {
        let row = side + 1;
        let place = |k: u32| {
            let (x, z) = (f64::from(k % row) * 0.01, f64::from(k / row) * 0.01);
            DVec3::new(x, 0.01 * (x * 70.0).sin() * (z * 50.0).cos(), z)
        };
        let positions: Vec<DVec3> = (0..row * row).map(place).collect();
        let corner = |k: u32| k / side * row + k % side;
        let triangles: Vec<[u32; 3]> = (0..side * side)
            .map(corner)
            .flat_map(|a| [[a, a + row, a + row + 1], [a, a + row + 1, a + 1]])
            .collect();
        Obstacle::new(&positions, &triangles, &Adjacency::new(positions.len(), &triangles))
    }

    #[test]
    fn what_is_passed_over_is_out_of_reach() {
        let (obstacle, mut random) = (ground(20), Random::stream(11, 0));
        let topology = Topology::new(&[[0, 1, 2]], &Adjacency::new(3, &[[0, 1, 2]]));
        let (mut approach, mut passed_over, mut met) = (Approach::unknown(), 0, 0);
        let mut at = DVec3::new(0.1, 0.03, 0.1);
        for step in 0..2000 {
            let mut part = |size: f64| DVec3::from_array([0; 3].map(|_| random.between(-size, size)));
            at = (at + part(0.002)).clamp(DVec3::new(0.02, -0.01, 0.02), DVec3::new(0.18, 0.03, 0.18));
            let x = [DVec3::ZERO, DVec3::X * 0.01, DVec3::Z * 0.01].map(|corner| at + corner + part(5e-4));
            let own = PlacedTriangle::new(&topology, &x, &[0.002, 0.001, 5e-4], 0);
            // What a box and planes do not tell apart.
            let near = |other: &PlacedTriangle| {
                let boxes = [&own.around, &other.around].map(Around::of);
                let gap = boxes[0].gap(&boxes[1]).max(own.gap(other)).max(other.gap(&own));
                gap <= own.farthest
            };
            let all: Vec<u32> =
                (0..obstacle.placed.len() as u32).filter(|t| near(&obstacle.placed[*t as usize])).collect();
            if approach.is_off(&own) {
                passed_over += 1;
                assert!(all.is_empty(), "step {step}: {all:?}");
                continue;
            }
            let mut found = Vec::new();
            approach.look(&own, &obstacle, &mut |at| found.push(obstacle.broad.order()[at as usize]));
            found.sort_unstable();
            assert_eq!(found, all, "step {step}");
            met += usize::from(!all.is_empty());
        }
        assert!(passed_over > 200 && met > 200, "{passed_over} passed over, {met} met");
    }
}
