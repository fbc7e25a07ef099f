//! Deformation transfer: rebuilds a mesh from a deformation gradient for each triangle (Sumner and Popović 2004,
//! "Deformation Transfer for Triangle Meshes", 3; Yu et al. 2004, "Mesh Editing with Poisson-Based Gradient Field
//! Manipulation", 3). Vertex positions are a least squares fit to the gradients with cotangent weights: a Poisson
//! equation, whose sparse factor serves every deformation of the mesh.

use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use glam::{DMat3, DVec3};
use rayon::prelude::*;

use crate::geometry::adjacency::Adjacency;
use crate::geometry::factor::{Factor, Symbolic};
use crate::geometry::mesh::TriMesh;
use crate::geometry::parallel::LEAST_SHARE;

/// Bounds of half the cotangent of a corner: sliver triangles keep some weight, but do not dominate.
const WEIGHTS: [f64; 2] = [0.02, 20.0];

/// Factor of the cotangent Laplacian of a mesh, scaled, plus a diagonal matrix.
#[derive(Clone, Debug)]
struct Laplacian {
    factor: Factor,
}

/// A mesh ready to be rebuilt from deformation gradients.
#[derive(Clone, Debug)]
pub struct Rebuild {
    mesh: TriMesh,
    adjacency: Adjacency,
    /// Half the cotangent at each corner of each triangle, which weights the side opposite the corner.
    weights: Vec<[f64; 3]>,
    laplacian: Laplacian,
    /// One vertex of each connected component, which is held: gradients determine a component only up to a
    /// translation.
    anchors: Vec<u32>,
}

impl Rebuild {
    /// Factors the Laplacian of `mesh`. None when it has no triangle, or when the factor does not fit in memory.
    pub fn new(mesh: &TriMesh) -> Option<Self> {
        let adjacency = Adjacency::new(mesh.positions.len(), &mesh.triangles);
        let weights: Vec<[f64; 3]> =
            (0..mesh.triangles.len()).map(|t| half_cotangents(mesh.corners(t))).collect();
        let parts = adjacency.parts();
        let anchors: Vec<u32> = (0..).zip(&parts).filter(|(v, part)| v == *part).map(|(v, _)| v).collect();
        let mut diagonal = vec![0.0; mesh.positions.len()];
        anchors.iter().for_each(|&v| diagonal[v as usize] = 1.0);
        let laplacian = Laplacian::new(mesh, &adjacency, &weights, 1.0, &diagonal)?;
        Some(Self { mesh: mesh.clone(), adjacency, weights, laplacian, anchors })
    }

    /// The mesh at rest.
    pub fn mesh(&self) -> &TriMesh {
        &self.mesh
    }

    /// The adjacency of the mesh.
    pub fn adjacency(&self) -> &Adjacency {
        &self.adjacency
    }

    /// Vertex positions (metres) whose triangles are as near as possible to being deformed by `gradients`, one for
    /// each triangle; the first vertex of each connected component goes to the position given by `anchored`. None
    /// when there are not as many gradients as triangles.
    pub fn positions(&self, gradients: &[DMat3], anchored: impl Fn(usize) -> DVec3) -> Option<Vec<DVec3>> {
        if gradients.len() != self.mesh.triangles.len() {
            return None;
        }
        let mut sides: Vec<DVec3> = (0..self.mesh.positions.len() as u32)
            .into_par_iter()
            .with_min_len(LEAST_SHARE)
            .map(|v| self.pulls(v, gradients))
            .collect();
        self.anchors.iter().for_each(|&v| sides[v as usize] += anchored(v as usize));
        self.laplacian.factor.solve(&mut sides).then_some(sides)
    }

    /// The right-hand side at vertex `v`: the weighted sum of its edge vectors as deformed by the gradients.
    fn pulls(&self, v: u32, gradients: &[DMat3]) -> DVec3 {
        let around = self.adjacency.vertex_triangles.of(v).iter().map(|&t| t as usize);
        around
            .map(|t| {
                let corners = self.mesh.triangles[t];
                let Some(k) = corners.iter().position(|&c| c == v) else { return DVec3::ZERO };
                let [a, b, c] = [0, 1, 2].map(|i| self.mesh.positions[corners[(k + i) % 3] as usize]);
                let weights = self.weights[t];
                gradients[t] * ((a - b) * weights[(k + 2) % 3] + (a - c) * weights[(k + 1) % 3])
            })
            .sum()
    }

    /// Prepares smoothing of vertex values by implicit diffusion: (M + r² L) x = M y with lumped masses M and `reach`
    /// = r in metres. Applied n times it spreads a step over about r √n on both sides. Three fields are smoothed at
    /// once. None when the factor does not fit in memory.
    pub fn smoother(&self, reach: f64) -> Option<Smoother> {
        let mut masses = vec![0.0; self.mesh.positions.len()];
        for (t, corners) in self.mesh.triangles.iter().enumerate() {
            let [a, b, c] = self.mesh.corners(t);
            let third = (b - a).cross(c - a).length() / 6.0;
            corners.iter().for_each(|&v| masses[v as usize] += third);
        }
        let laplacian = Laplacian::new(&self.mesh, &self.adjacency, &self.weights, reach * reach, &masses)?;
        Some(Smoother { laplacian, masses })
    }
}

/// Implicit diffusion of vertex values over a mesh, made by [`Rebuild::smoother`].
#[derive(Clone, Debug)]
pub struct Smoother {
    laplacian: Laplacian,
    masses: Vec<f64>,
}

impl Smoother {
    /// Smooths `values` (three fields) once, in place. False when the factor cannot be used.
    pub fn smooth(&self, values: &mut [DVec3]) -> bool {
        values.iter_mut().zip(&self.masses).for_each(|(value, &mass)| *value *= mass);
        self.laplacian.factor.solve(values)
    }
}

impl Laplacian {
    fn new(
        mesh: &TriMesh,
        adjacency: &Adjacency,
        weights: &[[f64; 3]],
        times: f64,
        diagonal: &[f64],
    ) -> Option<Self> {
        // On one thread: the order of sums must not depend on the number of threads.
        faer::set_global_parallelism(faer::Par::Seq);
        let n = mesh.positions.len();
        let mut of_edge = vec![0.0; adjacency.edges.len()];
        for (edges, weights) in adjacency.triangle_edges.iter().zip(weights) {
            for k in 0..3 {
                // The edge from corner k to k + 1 is opposite corner k + 2.
                of_edge[edges[k] as usize] += times * weights[(k + 2) % 3];
            }
        }
        let mut starts = vec![0; n + 1];
        adjacency.edges.iter().for_each(|e| starts[e[0] as usize + 1] += 1);
        for v in 0..n {
            starts[v + 1] += starts[v] + 1;
        }
        let (mut rows, mut values) = (vec![0; starts[n]], vec![0.0; starts[n]]);
        for v in 0..n {
            (rows[starts[v]], values[starts[v]]) = (v, diagonal[v]);
        }
        let mut next: Vec<usize> = starts[..n].iter().map(|&s| s + 1).collect();
        // Edges are sorted: rows of a column come in order.
        for (e, &weight) in adjacency.edges.iter().zip(&of_edge) {
            let [a, b] = e.map(|v| v as usize);
            (rows[next[a]], values[next[a]]) = (b, -weight);
            next[a] += 1;
            values[starts[a]] += weight;
            values[starts[b]] += weight;
        }
        // A vertex without triangles is fixed.
        for v in 0..n {
            if values[starts[v]] == 0.0 {
                values[starts[v]] = 1.0;
            }
        }
        let pattern = SymbolicSparseColMat::new_checked(n, n, starts, None, rows);
        let symbolic = Symbolic::new(pattern.as_ref())?;
        Some(Self { factor: symbolic.factor(SparseColMatRef::new(pattern.as_ref(), &values), None)? })
    }
}

/// Half the cotangent of the angle at each corner, clamped to [`WEIGHTS`].
fn half_cotangents(corners: [DVec3; 3]) -> [f64; 3] {
    [0, 1, 2].map(|k| {
        let (u, v) = (corners[(k + 1) % 3] - corners[k], corners[(k + 2) % 3] - corners[k]);
        let half = 0.5 * u.dot(v) / u.cross(v).length();
        if half.is_finite() { half.clamp(WEIGHTS[0], WEIGHTS[1]) } else { WEIGHTS[0] }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::shapes::cylinder;

    #[test]
    fn gradients_that_fit_together_give_exactly_their_shape() {
        let mesh = cylinder(0.2, 0.6, 24, 12);
        let rebuild = Rebuild::new(&mesh).expect("a factor");
        let map = DMat3::from_rotation_y(0.8) * DMat3::from_diagonal(DVec3::new(1.2, 0.7, 1.0));
        let gradients = vec![map; mesh.triangles.len()];
        let shift = DVec3::new(0.4, -2.0, 0.1);
        let placed = |v: usize| map * mesh.positions[v] + shift;
        let found = rebuild.positions(&gradients, placed).expect("as many as triangles");
        for (v, p) in found.iter().enumerate() {
            assert!(p.distance(placed(v)) < 1e-12, "{v}: {p}");
        }
        assert!(rebuild.positions(&gradients[1..], placed).is_none());
    }

    #[test]
    fn smoothing_keeps_the_sum_and_softens_a_step() {
        let mesh = cylinder(0.2, 0.6, 48, 30);
        let rebuild = Rebuild::new(&mesh).expect("a factor");
        let smoother = rebuild.smoother(0.05).expect("a factor");
        let step = |p: &DVec3| DVec3::splat(f64::from(u8::from(p.y > 0.31)));
        let mut values: Vec<DVec3> = mesh.positions.iter().map(step).collect();
        let sum = |values: &[DVec3]| values.iter().zip(&smoother.masses).map(|(v, m)| v.x * m).sum::<f64>();
        let before = sum(&values);
        assert!(smoother.smooth(&mut values));
        assert!((sum(&values) - before).abs() < 1e-9);
        assert!(values.iter().all(|v| (0.0..=1.0 + 1e-12).contains(&v.x)), "it stays between both");
        let rim = mesh.positions.iter().zip(&values).filter(|(p, _)| (p.y - 0.31).abs() < 0.02);
        assert!(rim.clone().count() > 20 && rim.clone().all(|(_, v)| (0.2..0.8).contains(&v.x)));
    }
}
