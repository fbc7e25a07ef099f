//! Springs along edges, used in two ways: as a mass-spring net in place of a membrane, or for strain control, where edges beyond
//! a strain limit resist with a multiple of the cloth's stiffness.

use glam::{DMat3, DVec3};

use crate::drape::sheet::Sheet;

/// Springs along edges that pull when too long; those of a net also push when too short.
#[derive(Clone, Debug)]
pub struct StrainLimits {
    edges: Vec<[u32; 2]>,
    /// Length of each edge beyond which it pulls, metres.
    longest: Vec<f64>,
    /// Spring stiffness of each edge, N/m.
    stiffness: Vec<f64>,
    /// Whether springs push below that length.
    pushes: bool,
}

impl StrainLimits {
    /// Strain control beyond a strain of `limit`, with a membrane stiffness of `stiffness`, N/m. Each edge gets its share of the
    /// area, as in a spring net for an isotropic membrane (Van Gelder 1998).
    pub fn new(sheet: &Sheet, limit: f64, stiffness: f64) -> Self {
        let edges = sheet.adjacency.edges.clone();
        let lengths: Vec<f64> = (0..edges.len()).map(|e| sheet.rest_length(e)).collect();
        let share = |e: usize| -> f64 {
            let beside = sheet.adjacency.edge_triangles.of(e as u32);
            beside.iter().map(|&t| sheet.areas[t as usize]).sum()
        };
        let stiffness = (0..edges.len()).map(|e| stiffness * share(e) / (lengths[e] * lengths[e])).collect();
        let longest = lengths.iter().map(|l| l * (1.0 + limit)).collect();
        Self { edges, longest, stiffness, pushes: false }
    }

    /// Mass-spring model (paper B) of a membrane of `stiffness`, N/m. Where all triangles are equilateral it behaves like
    /// constant-strain triangles with a Poisson's ratio of 1/3; elsewhere stiffness and Poisson's ratio depend on the mesh.
    pub fn net(sheet: &Sheet, stiffness: f64) -> Self {
        Self { pushes: true, ..Self::new(sheet, 0.0, stiffness) }
    }

    /// Vector, length (m) and elongation beyond the limit (m) of edge `e` with the cloth at `x`; None where the spring does not
    /// act.
    fn acting(&self, e: usize, x: &[DVec3]) -> Option<(DVec3, f64, f64)> {
        let [a, b] = self.edges[e].map(|v| x[v as usize]);
        let along = b - a;
        let length = along.length();
        let over = length - self.longest[e];
        // An edge of length zero has no direction to push in.
        (over > 0.0 || (self.pushes && length > 0.0)).then_some((along, length, over))
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
            if let Some((along, length, over)) = self.acting(e, x) {
                energy += self.stiffness[e] * over * over / 2.0;
                let pull = along * (self.stiffness[e] * over / length);
                gradient[b as usize] += pull;
                gradient[a as usize] -= pull;
            }
        }
        energy
    }

    /// Hessian block (b, b) of each acting edge [a, b], N/m: block (a, a) equals it, (a, b) is its negative. Without `exact` it
    /// is made positive semidefinite by leaving out the geometric stiffness of compressed springs.
    pub fn hessian(&self, x: &[DVec3], exact: bool, mut block: impl FnMut([u32; 2], DMat3)) {
        for (e, &ends) in self.edges.iter().enumerate() {
            if let Some((along, length, over)) = self.acting(e, x) {
                let u = along / length;
                let outer = DMat3::from_cols(u * u.x, u * u.y, u * u.z);
                let tension = if exact { over } else { over.max(0.0) };
                let side = (DMat3::IDENTITY - outer) * (tension / length);
                block(ends, (outer + side) * self.stiffness[e]);
            }
        }
    }
}
