//! Where draped cloth runs through itself: it is parted, pulled out, and in the end laid smooth.

use std::sync::Arc;

use glam::DVec3;

use crate::cloth::{ClothState, EdgeMetric};
use crate::contact::Met;
use crate::drape::mend::Film;
use crate::drape::worn::{Worn, own_number};

/// So often in a row without fewer of them: then they stay, and the report tells them.
const MOST_PARTINGS: u32 = 40;
/// And parted by so much each time, metres.
const PARTING: f64 = 0.0005;
/// So often what lies deep is sent out by as much in one go.
const MOST_PULLS: usize = 80;
/// And so often in a row in vain: then it is left where it is.
const MOST_IN_VAIN: u32 = 3;
/// Where that leads nowhere, and there are no more places than this, what is round them is laid smooth: more are no fold that was
/// drawn past shut, but much cloth with nowhere to go.
const FEW: usize = 8;
/// It is what is within so many metres, each time more,
const MENDS: [f64; 2] = [0.03, 0.05];
/// by so many sweeps,
const SWEEPS: usize = 2;
/// so often at most.
const ROUNDS: usize = 4;

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
        if self.is_tangled() && self.itself.sewn.is_none() && places <= FEW && self.mend(cloth) {
            return;
        }
        let mut free = vec![false; fixed.vertices.len()];
        for (v, x) in self.state.positions.iter_mut().enumerate() {
            let way = ways[fixed.vertices[v] as usize];
            if way != DVec3::ZERO {
                free[v] = true;
                let around = fixed.sheet.adjacency.vertex_neighbours.of(v as u32);
                around.iter().for_each(|&w| free[w as usize] = true);
                if !self.pinned[v] {
                    *x += way * PARTING;
                }
            }
        }
        self.itself.free = if places > 0 { free } else { Vec::new() };
        self.itself.forget();
    }

    /// Where the cloth runs through itself. The sides of an open seam may: they are to be one.
    fn met(&self, cloth: &ClothState) -> Met {
        let garment = &*self.fixed.garment;
        let mut met = Met::new(garment, cloth);
        if let Some(sides) = &self.itself.sewn {
            let becomes = |v: u32| own_number(&self.fixed.own, v).map_or(u32::MAX, |v| sides.will_be[v]);
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
        if self.itself.sewn.is_some() || self.in_vain >= MOST_IN_VAIN {
            return best;
        }
        let (mut ways, deep) = met.ways_out(garment, cloth);
        if !deep {
            return best;
        }
        self.in_vain += 1;
        let mut least = self.state.clone();
        for _ in 0..MOST_PULLS {
            for (v, x) in self.state.positions.iter_mut().enumerate() {
                let way = ways[fixed.vertices[v] as usize];
                if way == DVec3::ZERO || self.pinned[v] {
                    continue;
                }
                *x += way * PARTING;
                self.state.velocities[v] = DVec3::ZERO;
                if let Some((normal, height)) = self.small.height(v, *x) {
                    *x -= normal * height.min(0.0);
                }
            }
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

    /// Lays smooth what is round the places where the cloth runs through itself. False where as many are left.
    fn mend(&mut self, cloth: &mut ClothState) -> bool {
        let fixed = Arc::clone(&self.fixed);
        let met = self.met(cloth);
        let of_place = |&[e, t]: &[u32; 2]| {
            let edge = fixed.garment.adjacency.edges[e as usize];
            edge.into_iter().chain(met.mesh.triangles[t as usize])
        };
        let sources: Vec<(u32, f64)> = met.places.iter().flat_map(of_place).map(|v| (v, 0.0)).collect();
        let is_laid = |v: u32| own_number(&fixed.own, v).is_some();
        let far = EdgeMetric::new(&fixed.garment).from(&sources, is_laid).distance;
        let was = self.state.clone();
        while let Some(&reach) = MENDS.get(self.mended) {
            self.mended += 1;
            let near = (0..self.pinned.len() as u32).filter(|v| {
                let place = fixed.vertices[*v as usize];
                far[place as usize] <= reach && !self.pinned[*v as usize]
            });
            let film = Film::new(&fixed.sheet, near.collect());
            for _ in 0..ROUNDS {
                film.smooth(&mut self.state.positions, SWEEPS, &fixed.collider.surface, fixed.offset);
                self.write(cloth);
                let left = self.met(cloth).places.len();
                if left < met.places.len() {
                    let velocities = &mut self.state.velocities;
                    film.vertices.iter().for_each(|&v| velocities[v as usize] = DVec3::ZERO);
                    (self.crossings, self.parting) = (left, (usize::MAX, 0));
                    (self.quiet, self.pace) = (0, 1.0);
                    self.itself.free = Vec::new();
                    self.itself.forget();
                    return true;
                }
            }
            self.state = was.clone();
            self.write(cloth);
        }
        false
    }
}
