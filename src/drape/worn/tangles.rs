//! Where draped cloth runs through itself: it is parted and pulled out.

use std::sync::Arc;

use glam::DVec3;

use crate::cloth::ClothState;
use crate::contact::Met;
use crate::drape::worn::{Worn, own_number};

/// So often in a row without fewer of them: then they stay, and the report tells them.
const MOST_PARTINGS: u32 = 40;
/// And parted by so much each time, metres.
const PARTING: f64 = 0.0005;
/// So often what lies deep is sent out by as much in one go.
const MOST_PULLS: usize = 80;
/// And so often in a row in vain: then it is left where it is.
const MOST_IN_VAIN: u32 = 3;
impl Worn {
    /// Whether it is left as it is.
    pub(super) fn is_tangled(&self) -> bool {
        self.parting.1 >= MOST_PARTINGS
    }

    /// Sends layers that run through each other apart.
    pub(super) fn part(&mut self, cloth: &mut ClothState) {
        if !self.settings.self_collision {
            return;
        }
        let fixed = Arc::clone(&self.fixed);
        self.counters.self_tests += 1;
        let (ways, places) = self.untangle(cloth);
        let was = self.crossings;
        self.crossings = places;
        self.parting = match (places, self.parting) {
            (0, _) => (usize::MAX, 0),
            (places, (fewest, _)) if places < fewest => (places, 0),
            (_, (fewest, times)) => (fewest, times + 1),
        };
        if places == 0 && was == 0 {
            return;
        }
        let ways = self.of_own(|v| ways[v] * PARTING);
        self.small.send(&mut self.state.positions, &fixed.collider, &ways);
    }

    /// Of its own vertices what `of` gives of the garment's; nothing of those that stay.
    fn of_own(&self, of: impl Fn(usize) -> DVec3) -> Vec<DVec3> {
        let places = self.fixed.vertices.iter().zip(&self.pinned);
        places.map(|(&v, pinned)| if *pinned { DVec3::ZERO } else { of(v as usize) }).collect()
    }

    /// Where the cloth runs through itself. The sides of an open seam may: they are to be one.
    fn met(&self, cloth: &ClothState) -> Met {
        let garment = &*self.fixed.garment;
        let mut met = Met::new(garment, cloth);
        if let Some(will_be) = &self.will_be {
            let becomes = |v: u32| own_number(&self.fixed.own, v).map_or(u32::MAX, |v| will_be[v]);
            let (edges, triangles) = (&garment.adjacency.edges, &met.mesh.triangles);
            met.places.retain(|&[e, t]| {
                let ends = edges[e as usize].map(becomes);
                !triangles[t as usize].iter().any(|&v| ends.contains(&becomes(v)))
            });
        }
        met
    }

    /// Takes what lies deep on the wrong side of other cloth out at once: let go half way it would go back. Where that leads
    /// nowhere all stays as it is. For each vertex where to send it, and in how many places the cloth then still runs through
    /// itself.
    fn untangle(&mut self, cloth: &mut ClothState) -> (Vec<DVec3>, usize) {
        let fixed = Arc::clone(&self.fixed);
        let garment = &*fixed.garment;
        let met = self.met(cloth);
        let mut best = (met.ways(garment, cloth), met.places.len());
        if self.will_be.is_some() || self.in_vain >= MOST_IN_VAIN {
            return best;
        }
        let (mut ways, deep) = met.ways_out(garment, cloth);
        if !deep {
            return best;
        }
        self.in_vain += 1;
        let mut least = self.state.clone();
        for _ in 0..MOST_PULLS {
            let mut own = self.of_own(|v| ways[v] * PARTING);
            for (v, way) in own.iter_mut().enumerate().filter(|(_, way)| **way != DVec3::ZERO) {
                self.state.velocities[v] = DVec3::ZERO;
                if let Some((normal, height)) = self.small.height(v, self.state.positions[v] + *way) {
                    *way -= normal * height.min(0.0);
                }
            }
            self.small.send(&mut self.state.positions, &fixed.collider, &own);
            self.write(cloth);
            let met = self.met(cloth);
            if met.places.len() < best.1 {
                best = (met.ways(garment, cloth), met.places.len());
                least = self.state.clone();
            }
            if best.1 == 0 {
                self.in_vain = 0;
                break;
            }
            ways = met.ways_out(garment, cloth).0;
        }
        self.state = least;
        self.write(cloth);
        best
    }
}
