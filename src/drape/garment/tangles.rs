//! Self-intersections of draped cloth: small ones are separated, deep ones pulled out.

use std::sync::Arc;

use glam::DVec3;

use crate::cloth::{ClothState, Skip};
use crate::contact::Intersections;
use crate::drape::garment::{DrapedGarment, MOST_WORK, own_number};
use crate::drape::state::State;

/// How self-intersections are looked for and separated.
pub(super) struct Parting {
    /// Ticks between two checks while there are none. The first check is after the first tick, the roughest.
    pub look_ticks: u64,
    /// Ticks between two separation steps while there are some.
    pub ticks: u64,
    /// Displacement of intersecting cloth in each separation step, metres.
    way: f64,
    /// Separation steps in a row without fewer intersections, after which the intersections stay and the report tells them.
    most: u32,
    /// Steps of one attempt to pull out deep intersections.
    most_pulls: usize,
    /// Failed attempts in a row after which deep intersections are left.
    most_in_vain: u32,
}

/// Chosen by trial; the last three bound for how long a way out is looked for where there may be none.
pub(super) const PARTING: Parting =
    Parting { look_ticks: 12, ticks: 4, way: 0.0005, most: 40, most_pulls: 80, most_in_vain: 3 };

/// An attempt to pull out cloth that is deep on the wrong side of other cloth.
#[derive(Clone, Debug)]
pub(in crate::drape) struct Pulling {
    /// Displacement direction of each vertex of the garment, at most a unit long.
    ways: Vec<DVec3>,
    /// Separating displacements at the state with the fewest intersections so far, and that number.
    best: (Vec<DVec3>, usize),
    /// The state with the fewest intersections so far.
    pub(in crate::drape) least: State,
    /// Steps left.
    left: usize,
}

impl DrapedGarment {
    /// Whether separation has been given up.
    pub(in crate::drape) fn is_tangled(&self) -> bool {
        self.parting.1 >= PARTING.most
    }

    /// Separates layers that intersect each other, or begins to pull out deep intersections.
    pub(in crate::drape) fn part(&mut self, cloth: &mut ClothState) {
        if !self.settings.self_collision || (self.crossings == 0 && self.is_known_clean()) {
            return;
        }
        self.counters.self_tests += 1;
        let (met, garment) = (self.met(cloth), &*self.fixed.garment);
        let best = (met.ways(garment, cloth), met.places.len());
        if self.will_be.is_none() && self.in_vain < PARTING.most_in_vain {
            let (ways, deep) = met.ways_out(garment, cloth);
            if deep {
                self.in_vain += 1;
                let least = self.state.clone();
                self.pulling = Some(Box::new(Pulling { ways, best, least, left: PARTING.most_pulls }));
                return self.pull(cloth);
            }
        }
        self.go_on_parting(best);
    }

    /// Whether it is known that the cloth crosses neither itself nor the body: the last detection found it so, and since then no vertex
    /// has passed a plane between features.
    pub(super) fn is_known_clean(&self) -> bool {
        self.settings.skips.allow(Skip::Crossings) && !self.was_on_card && self.small.is_known_clean()
    }

    /// Makes a separation step with the displacements `ways`, and counts the `places` of self-intersection.
    fn go_on_parting(&mut self, (ways, places): (Vec<DVec3>, usize)) {
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
        let ways = self.of_own(|v| ways[v] * PARTING.way);
        self.small.send(&mut self.state.positions, &self.collider, &ways);
    }

    /// Maps `of` from garment vertices to simulated vertices; zero for pinned ones.
    fn of_own(&self, of: impl Fn(usize) -> DVec3) -> Vec<DVec3> {
        let places = self.fixed.vertices.iter().zip(&self.pinned);
        places.map(|(&v, pinned)| if *pinned { DVec3::ZERO } else { of(v as usize) }).collect()
    }

    /// Self-intersections. Those between the sides of an open seam are left out: the sides will be merged.
    pub(super) fn met(&self, cloth: &ClothState) -> Intersections {
        let garment = &*self.fixed.garment;
        let mut met = Intersections::new(garment, cloth);
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

    /// Pulls cloth that is deep on the wrong side of other cloth out without letting time pass, if need be in several calls:
    /// released half way it would slide back. If that fails, the state with the fewest intersections is kept.
    pub(in crate::drape) fn pull(&mut self, cloth: &mut ClothState) {
        let Some(mut pulling) = self.pulling.take() else { return };
        let fixed = Arc::clone(&self.fixed);
        let garment = &*fixed.garment;
        for _ in 0..(MOST_WORK / garment.triangles.len().max(1) as u64).max(1) {
            self.send_out(&pulling.ways);
            self.write(cloth);
            pulling.left -= 1;
            let met = self.met(cloth);
            if met.places.len() < pulling.best.1 {
                pulling.best = (met.ways(garment, cloth), met.places.len());
                pulling.least = self.state.clone();
            }
            if pulling.best.1 == 0 {
                (self.in_vain, pulling.left) = (0, 0);
            }
            if pulling.left == 0 {
                self.state = pulling.least;
                self.write(cloth);
                return self.go_on_parting(pulling.best);
            }
            pulling.ways = met.ways_out(garment, cloth).0;
        }
        self.pulling = Some(pulling);
    }

    /// Moves vertices along `ways`, but not into the body, and stops them.
    fn send_out(&mut self, ways: &[DVec3]) {
        let mut own = self.of_own(|v| ways[v] * PARTING.way);
        for (v, way) in own.iter_mut().enumerate().filter(|(_, way)| **way != DVec3::ZERO) {
            self.state.velocities[v] = DVec3::ZERO;
            if let Some((normal, height)) = self.small.height(v, self.state.positions[v] + *way) {
                *way -= normal * height.min(0.0);
            }
        }
        self.small.send(&mut self.state.positions, &self.collider, &own);
    }
}
