//! Elastic sewn along edges: springs that pull from a share of the cloth's length on. The cloth along them is gathered, more finely
//! than the mesh shows, and so resists only beyond its own length.

use std::collections::BTreeMap;

use glam::{DMat3, DVec3};

use crate::drape::sheet::Sheet;
use crate::drape::solver::chain::{Chain, Drawn, chains};
use crate::drape::solver::net::Spring;
use crate::drape::solver::ties::THREAD_SPEED;

/// Number of times that a row is solved in a small step, each with its share of the stiffness. Gathered cloth turns its links by
/// so much that once leaves 2.5 % of a ratio of 0.85 over, twice 0.2 %.
const PASSES: usize = 3;

/// Elastic along one edge of a sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// The vertices.
    pub ends: [u32; 2],
    /// Length of the elastic at rest as a share of that of the cloth, above 0 and at most 1.
    pub ratio: f64,
    /// Force at double length, N.
    pub tension: f64,
    /// Length of the cloth at rest, metres.
    pub length: f64,
    /// Stiffness of the cloth beyond that length, N/m; 0 where the membrane has it.
    pub stiffness: f64,
}

/// The elastic of a sheet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bands {
    bands: Vec<Band>,
    /// The rows that they form.
    rows: Vec<Chain>,
}

impl Band {
    /// Length of the elastic at rest, metres.
    fn short(&self) -> f64 {
        self.ratio * self.length
    }

    /// Stiffness of the elastic, N/m.
    fn pull(&self) -> f64 {
        self.tension / self.short()
    }
}

impl Bands {
    /// Elastic along edges of `sheet`, each given by its ends, its ratio and its force at double length (N). What is no edge of the
    /// sheet is left out; of several at one edge the first counts.
    pub fn new(sheet: &Sheet, edges: impl IntoIterator<Item = ([u32; 2], f64, f64)>) -> Self {
        let mut known = BTreeMap::new();
        for (ends, ratio, tension) in edges {
            if let Some(e) = sheet.edge_between(ends) {
                let (ends, length) = (sheet.adjacency.edges[e as usize], sheet.rest_length(e as usize));
                known.entry(e).or_insert(Band { ends, ratio, tension, length, stiffness: 0.0 });
            }
        }
        Self::of(known.into_values().collect())
    }

    fn of(bands: Vec<Band>) -> Self {
        let ends: Vec<[u32; 2]> = bands.iter().map(|band| band.ends).collect();
        Self { bands, rows: chains(&ends) }
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.bands.is_empty()
    }

    /// The bands.
    pub fn all(&self) -> &[Band] {
        &self.bands
    }

    /// Takes length and stiffness of the cloth from the springs along the bands, and gives back the other springs.
    pub fn take_springs(&mut self, springs: impl Iterator<Item = Spring>) -> Vec<Spring> {
        if self.bands.is_empty() {
            return springs.collect();
        }
        let places: BTreeMap<[u32; 2], usize> =
            self.bands.iter().enumerate().map(|(i, band)| (band.ends, i)).collect();
        let mut left = Vec::new();
        for spring in springs {
            let [a, b] = spring.ends;
            match places.get(&[a.min(b), a.max(b)]) {
                Some(&i) => {
                    self.bands[i].length = spring.length;
                    self.bands[i].stiffness = spring.stiffness;
                }
                None => left.push(spring),
            }
        }
        left
    }

    /// Adds the gradient of the elastic without the cloth along it, N, and gives the energy, J.
    pub fn add_gradient(&self, x: &[DVec3], gradient: &mut [DVec3]) -> f64 {
        let mut energy = 0.0;
        for band in &self.bands {
            let [a, b] = band.ends.map(|v| v as usize);
            let along = x[b] - x[a];
            let over = along.length() - band.short();
            if over > 0.0 {
                energy += band.pull() * over * over / 2.0;
                let force = along.normalize() * (band.pull() * over);
                gradient[b] += force;
                gradient[a] -= force;
            }
        }
        energy
    }

    /// Hessian block (b, b) of each stretched band [a, b], N/m: block (a, a) equals it, (a, b) is its negative.
    pub fn hessian(&self, x: &[DVec3], mut block: impl FnMut([u32; 2], DMat3)) {
        for band in &self.bands {
            let [a, b] = band.ends.map(|v| x[v as usize]);
            let length = (b - a).length();
            if length > band.short() {
                let u = (b - a) / length;
                let outer = DMat3::from_cols(u * u.x, u * u.y, u * u.z);
                let side = (DMat3::IDENTITY - outer) * (1.0 - band.short() / length);
                block(band.ends, (outer + side) * band.pull());
            }
        }
    }

    /// Projects every band in a small step of `small` seconds (XPBD), those of a row together; cloth is rigid beyond a strain of
    /// `limit`. `inverse_mass` in 1/kg. Writes how far elastic moved each of its vertices into `pulled`, metres.
    pub fn project(
        &self,
        x: &mut [DVec3],
        inverse_mass: &[f64],
        limit: f64,
        small: f64,
        pulled: &mut Vec<f64>,
    ) {
        if self.bands.is_empty() {
            return;
        }
        for band in &self.bands {
            let [a, b] = band.ends.map(|v| v as usize);
            let (wa, wb) = (inverse_mass[a], inverse_mass[b]);
            if wa + wb == 0.0 {
                continue;
            }
            let along = x[b] - x[a];
            let mut length = along.length();
            let start = length;
            let longest = band.length * (1.0 + limit);
            for (rest, stiffness) in [(longest, f64::INFINITY), (band.length, band.stiffness)] {
                if length > rest && stiffness > 0.0 {
                    let softness = 1.0 / (stiffness * small * small);
                    length -= (length - rest) * (wa + wb) / (wa + wb + softness);
                }
            }
            if length < start {
                let way = along * ((start - length) / (start * (wa + wb)));
                x[a] += way * wa;
                x[b] -= way * wb;
            }
        }
        let drawn = |i: u32| {
            let band = &self.bands[i as usize];
            Drawn { length: band.short(), stiffness: band.pull() / PASSES as f64 }
        };
        let most = THREAD_SPEED * small / PASSES as f64;
        pulled.clear();
        pulled.resize(x.len(), 0.0);
        let ends = || self.bands.iter().flat_map(|band| band.ends).map(|v| v as usize);
        let before: Vec<DVec3> = ends().map(|v| x[v]).collect();
        for _ in 0..PASSES {
            self.rows.iter().for_each(|row| row.project(x, inverse_mass, drawn, (small, most)));
        }
        ends().zip(before).for_each(|(v, before)| pulled[v] = x[v].distance(before));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn band() -> Bands {
        let band = Band { ends: [0, 1], ratio: 0.6, tension: 3.0, length: 0.02, stiffness: 500.0 };
        Bands::of(vec![band])
    }

    #[test]
    fn elastic_pulls_from_its_own_length_on_and_never_pushes() {
        for (length, force) in [(0.008, 0.0), (0.012, 0.0), (0.018, 1.5), (0.024, 3.0)] {
            let x = [DVec3::ZERO, DVec3::X * length];
            let mut gradient = [DVec3::ZERO; 2];
            let energy = band().add_gradient(&x, &mut gradient);
            assert!((gradient[1].x - force).abs() < 1e-9, "{length} m: {gradient:?}");
            assert!((energy - force * (length - 0.012f64).max(0.0) / 2.0).abs() < 1e-12);
        }
    }

    #[test]
    fn steps_that_are_long_enough_bring_it_to_its_length() {
        for (start, end) in [(0.05, 0.012), (0.02, 0.012), (0.01, 0.01)] {
            let mut x = [DVec3::ZERO, DVec3::X * start];
            for _ in 0..200 {
                band().project(&mut x, &[1.0, 2.0], 0.01, 0.1, &mut Vec::new());
            }
            assert!((x[0].distance(x[1]) - end).abs() < 1e-6, "{x:?}");
            assert!((x[0].x * 2.0 + x[1].x - start).abs() < 1e-12, "momentum is kept");
        }
    }
}
