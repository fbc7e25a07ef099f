//! Cloth that goes along with its body to another pose.

use std::sync::Arc;

use glam::DVec3;

use crate::body::Surface;
use crate::cloth::ClothState;
use crate::contact::Obstacle;
use crate::drape::contact::body::Collider;
use crate::drape::garment::DrapedGarment;

impl DrapedGarment {
    /// Replaces the body by `surface`, the same body a little further on, and moves each vertex of the garment by `ways`, metres.
    /// Time stands still meanwhile, and then goes on as slowly as before: the next tick finds a body at rest, and the cloth moves
    /// against it only. Where cloth would come to cross itself, what would meet goes together, by its mean displacement. False where
    /// that does not help; then nothing has changed.
    pub fn carry(&mut self, surface: Arc<Surface>, ways: &[DVec3], cloth: &mut ClothState) -> bool {
        let mut together = Together::new(ways);
        let before = self.state.positions.clone();
        // Every time more goes together, in the end all of it; so far seldom more than three times.
        for _ in 0..16 {
            for (x, (from, &v)) in
                self.state.positions.iter_mut().zip(before.iter().zip(&self.fixed.vertices))
            {
                *x = *from + together.way(v);
            }
            self.write(cloth);
            let met = self.met(cloth);
            if met.places.len() <= self.crossings {
                self.crossings = met.places.len();
                self.stand_on(surface);
                return true;
            }
            let edges = &self.fixed.garment.adjacency.edges;
            for &[e, t] in &met.places {
                together.join(edges[e as usize].into_iter().chain(met.mesh.triangles[t as usize]));
            }
        }
        self.state.positions = before;
        self.write(cloth);
        false
    }

    fn stand_on(&mut self, surface: Arc<Surface>) {
        self.obstacle = Arc::new(Obstacle::of(&surface));
        self.collider = Arc::new(Collider::still(surface));
        self.small.forget_planes();
        if let Some(separation) = &mut self.small.separation {
            separation.set_obstacle(Some(Arc::clone(&self.obstacle)));
        }
        self.stir();
    }
}

/// Displacements of vertices, of which groups go together.
struct Together {
    /// For each vertex another of its group; the last of such a chain stands for the group.
    next: Vec<u32>,
    /// For each vertex that stands for a group the sum of the displacements of its members, metres, and their number.
    sums: Vec<(DVec3, f64)>,
}

impl Together {
    fn new(ways: &[DVec3]) -> Self {
        Self { next: (0..ways.len() as u32).collect(), sums: ways.iter().map(|&way| (way, 1.0)).collect() }
    }

    fn group(&mut self, mut v: u32) -> usize {
        while self.next[v as usize] != v {
            let next = self.next[self.next[v as usize] as usize];
            self.next[v as usize] = next;
            v = next;
        }
        v as usize
    }

    fn join(&mut self, vertices: impl Iterator<Item = u32>) {
        let mut all: Option<usize> = None;
        for v in vertices {
            let group = self.group(v);
            let Some(all) = all else {
                all = Some(group);
                continue;
            };
            if group != all {
                self.next[group] = all as u32;
                let (way, count) = self.sums[group];
                self.sums[all] = (self.sums[all].0 + way, self.sums[all].1 + count);
            }
        }
    }

    /// The displacement of vertex `v`, metres.
    fn way(&mut self, v: u32) -> DVec3 {
        let group = self.group(v);
        let (sum, count) = self.sums[group];
        sum / count
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_goes_together_goes_by_its_mean() {
        let ways: Vec<DVec3> = (0..6).map(|v| DVec3::X * f64::from(v)).collect();
        let mut together = Together::new(&ways);
        together.join([0, 1].into_iter());
        together.join([4, 5, 4].into_iter());
        together.join([1, 5].into_iter());
        together.join([0, 4].into_iter());
        let ways: Vec<f64> = (0..6).map(|v| together.way(v).x).collect();
        assert_eq!(ways, [2.5, 2.5, 2.0, 3.0, 2.5, 2.5]);
    }
}
