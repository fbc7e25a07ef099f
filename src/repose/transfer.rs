//! Joins neighbours that conforming moves apart because they are bound to different limbs. The rotations of the skin are smoothed
//! over the cloth; then the triangles, so rotated, are joined again (Yu et al. 2004, "Mesh Editing with Poisson-Based Gradient
//! Field Manipulation"; rotations as in Sumner and Popovic 2004, "Deformation Transfer for Triangle Meshes").

use glam::{DQuat, DVec3};

use crate::cloth::{ClothState, Counters, Garment};
use crate::relax::global::GlobalSolver;

/// Poisson solver of a garment, factored once for all poses.
#[derive(Clone, Debug)]
pub(super) struct Transfer {
    solver: GlobalSolver,
    /// Weight that ties each vertex to its given value, on the matrix diagonal.
    ties: Vec<f64>,
}

impl Transfer {
    /// A solver for the laid triangles of `garment` on a body of `scale`. None when the matrix cannot be factored (out of
    /// memory).
    pub fn new(garment: &Garment, cloth: &ClothState, scale: f64) -> Option<Self> {
        let mut solver = GlobalSolver::new(garment)?;
        solver.set_triangles(garment, &cloth.mapped);
        // A length scale, metres on a body whose largest side is 1.5 m: above it rotations and positions follow the skin, below it the
        // cloth itself. Chosen by trial.
        let tie = (garment.mean_edge() / (0.06 * scale)).powi(2);
        Some(Self { solver, ties: vec![tie; garment.vertex_count] })
    }

    /// Moves each position in `carried`, given with the rotation of its skin, so that the triangles keep their shapes in `cloth`,
    /// rotated, as well as they can (least squares). Leaves the positions unchanged where the solve fails.
    pub fn join(
        &mut self,
        garment: &Garment,
        cloth: &ClothState,
        carried: &mut [(DVec3, DQuat)],
        counters: &mut Counters,
    ) {
        let Some(turns) = self.evened(carried, counters) else { return };
        let mut forces = vec![DVec3::ZERO; carried.len()];
        for vs in garment.triangles.iter().filter(|vs| vs.iter().all(|&v| cloth.mapped[v as usize])) {
            let vs = vs.map(|v| v as usize);
            let (corners, there) = (vs.map(|v| cloth.positions[v]), vs.map(|v| carried[v].0));
            let [centre, middle] = [corners, there].map(|[a, b, c]| (a + b + c) / 3.0);
            let turn = (turns[vs[0]] + turns[vs[1]] + turns[vs[2]]).normalize();
            for k in 0..3 {
                forces[vs[k]] += turn * (corners[k] - centre) + middle - there[k];
            }
        }
        if self.solve(&mut forces, counters) {
            let laid = carried.iter_mut().zip(&forces).zip(&cloth.mapped).filter(|(_, mapped)| **mapped);
            laid.for_each(|(((place, _), way), _)| *place += *way);
        }
    }

    /// The rotations in `carried`, smoothed over the cloth.
    fn evened(&mut self, carried: &[(DVec3, DQuat)], counters: &mut Counters) -> Option<Vec<DQuat>> {
        let one_half = |q: DQuat| if q.w < 0.0 { -q } else { q };
        let tied = |(&(_, turn), tie): (&(DVec3, DQuat), &f64)| one_half(turn) * *tie;
        let tied: Vec<DQuat> = carried.iter().zip(&self.ties).map(tied).collect();
        let mut axes: Vec<DVec3> = tied.iter().map(|q| q.xyz()).collect();
        let mut cosines: Vec<DVec3> = tied.iter().map(|q| DVec3::X * q.w).collect();
        if !(self.solve(&mut axes, counters) && self.solve(&mut cosines, counters)) {
            return None;
        }
        Some(
            axes.iter()
                .zip(&cosines)
                .map(|(v, w)| DQuat::from_xyzw(v.x, v.y, v.z, w.x).normalize())
                .collect(),
        )
    }

    fn solve(&mut self, sides: &mut [DVec3], counters: &mut Counters) -> bool {
        let none = vec![DVec3::ZERO; sides.len()];
        self.solver.solve(&self.ties, sides, &none, counters)
    }
}
