//! Strain control: edges resist with a multiple of the cloth's stiffness beyond a strain they should not pass.

use glam::{DMat3, DVec3};

use crate::drape::sheet::Sheet;

/// Springs that only pull, and only beyond a length.
#[derive(Clone, Debug)]
pub struct StrainLimits {
    edges: Vec<[u32; 2]>,
    /// Metres.
    longest: Vec<f64>,
    /// N/m.
    stiffness: Vec<f64>,
}

impl StrainLimits {
    /// Beyond a strain of `limit` with a membrane stiffness of `stiffness`, N/m: an edge stands for its share of area, as
    /// springs of an isotropic net do (Van Gelder 1998).
    pub fn new(sheet: &Sheet, limit: f64, stiffness: f64) -> Self {
        let edges = sheet.adjacency.edges.clone();
        let lengths: Vec<f64> = (0..edges.len()).map(|e| sheet.rest_length(e)).collect();
        let share = |e: usize| -> f64 {
            let beside = sheet.adjacency.edge_triangles.of(e as u32);
            beside.iter().map(|&t| sheet.areas[t as usize]).sum()
        };
        let stiffness = (0..edges.len()).map(|e| stiffness * share(e) / (lengths[e] * lengths[e])).collect();
        Self { edges, longest: lengths.iter().map(|l| l * (1.0 + limit)).collect(), stiffness }
    }

    /// Each edge with the length from which it pulls (m) and its stiffness (N/m).
    pub fn springs(&self) -> impl Iterator<Item = ([u32; 2], f64, f64)> {
        let figures = self.longest.iter().zip(&self.stiffness);
        self.edges.iter().zip(figures).map(|(&ends, (&length, &stiffness))| (ends, length, stiffness))
    }

    /// Adds the gradient, N, and gives the energy, J.
    pub fn add_gradient(&self, x: &[DVec3], gradient: &mut [DVec3]) -> f64 {
        let mut energy = 0.0;
        for (e, &[a, b]) in self.edges.iter().enumerate() {
            let along = x[b as usize] - x[a as usize];
            let length = along.length();
            let over = length - self.longest[e];
            if over > 0.0 {
                energy += self.stiffness[e] * over * over / 2.0;
                let pull = along * (self.stiffness[e] * over / length);
                gradient[b as usize] += pull;
                gradient[a as usize] -= pull;
            }
        }
        energy
    }

    /// The block (b, b) of each edge [a, b] that pulls, N/m: (a, a) is the same, (a, b) its negative.
    pub fn hessian(&self, x: &[DVec3], mut block: impl FnMut([u32; 2], DMat3)) {
        for (e, &[a, b]) in self.edges.iter().enumerate() {
            let along = x[b as usize] - x[a as usize];
            let length = along.length();
            let over = length - self.longest[e];
            if over > 0.0 {
                let u = along / length;
                let outer = DMat3::from_cols(u * u.x, u * u.y, u * u.z);
                let side = (DMat3::IDENTITY - outer) * (over / length);
                block([a, b], (outer + side) * self.stiffness[e]);
            }
        }
    }
}
