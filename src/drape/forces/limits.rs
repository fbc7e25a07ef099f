//! Springs along edges: a net of them in place of a membrane, or strain control, by which edges resist with a multiple of the
//! cloth's stiffness beyond a strain they should not pass.

use glam::{DMat3, DVec3};

use crate::drape::sheet::Sheet;

/// Springs that pull beyond a length; those of a net also push below it.
#[derive(Clone, Debug)]
pub struct StrainLimits {
    edges: Vec<[u32; 2]>,
    /// Metres.
    longest: Vec<f64>,
    /// N/m.
    stiffness: Vec<f64>,
    /// Below their length they push.
    pushes: bool,
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
        let longest = lengths.iter().map(|l| l * (1.0 + limit)).collect();
        Self { edges, longest, stiffness, pushes: false }
    }

    /// The mass-spring model (paper B) of a membrane of `stiffness`, N/m. It pulls as triangles of constant strain and a Poisson's
    /// ratio of 1/3 do where all of them are equilateral; elsewhere both figures hang on how the cloth is cut.
    pub fn net(sheet: &Sheet, stiffness: f64) -> Self {
        Self { pushes: true, ..Self::new(sheet, 0.0, stiffness) }
    }

    /// Of edge `e` with the cloth at `x`: its vector, its length and by how much that is too long, metres; None where it does
    /// not act.
    fn acting(&self, e: usize, x: &[DVec3]) -> Option<(DVec3, f64, f64)> {
        let [a, b] = self.edges[e].map(|v| x[v as usize]);
        let along = b - a;
        let length = along.length();
        let over = length - self.longest[e];
        // What has no length has no direction to push in.
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

    /// The block (b, b) of each edge [a, b] that acts, N/m: (a, a) is the same, (a, b) its negative. Without `exact` they are made
    /// positive semidefinite: what pushes does not give way sideways.
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
