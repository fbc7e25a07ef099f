//! Equilibrium of cloth under gravity, found directly by minimising the energy, without time steps.

use glam::DVec3;

use crate::drape::contact::body::Contacts;
use crate::drape::contact::itself::SelfContact;
use crate::drape::solver::newton::{Loads, Newton, NewtonSettings, Solved, Task};
use crate::drape::solver::steps::Scene;

/// Settings of [`settle`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SettleSettings {
    /// Largest residual force on a vertex, as a share of the total weight (or of `scale`).
    pub residual: f64,
    /// Newton iterations in all.
    pub most_iterations: usize,
    /// Force that `residual` is a share of, N; zero for the total weight.
    pub scale: f64,
    /// Contact stiffness per area, N/m³.
    pub contact_stiffness: f64,
}

impl Default for SettleSettings {
    fn default() -> Self {
        Self { residual: 1e-8, most_iterations: 400, scale: 0.0, contact_stiffness: 1e6 }
    }
}

/// Moves `x` to where elastic forces, gravity, contact and the forces `extra` (N per vertex; empty for none) balance. Springs
/// that hold each vertex at its position weaken from stage to stage, five- or a hundredfold, so that a distant start does not
/// diverge.
pub fn settle(
    scene: &Scene,
    newton: &mut Newton,
    contacts: &mut Contacts,
    extra: &[DVec3],
    settings: &SettleSettings,
    x: &mut Vec<DVec3>,
) -> Solved {
    let count = scene.sheet.len();
    let weight: f64 = scene.mass.iter().sum::<f64>() * scene.gravity.length();
    let scale = if settings.scale > 0.0 { settings.scale } else { weight };
    let mut itself = SelfContact::default();
    let stiffness: Vec<f64> = (0..count)
        .map(|v| if scene.pinned[v] { 0.0 } else { settings.contact_stiffness * scene.sheet.vertex_area[v] })
        .collect();
    let mut left = settings.most_iterations;
    let mut solved = Solved::default();
    // Each stage is like one step of implicit Euler from rest, of 0.1 s at first and longer from stage to stage.
    let mut hold = 100.0;
    while left > 0 {
        let start = x.clone();
        let loads = Loads {
            inertia: scene.mass.iter().map(|m| m * hold).collect(),
            target: x.clone(),
            force: (0..count)
                .map(|v| scene.gravity * scene.mass[v] + extra.get(v).copied().unwrap_or_default())
                .collect(),
        };
        let task = Task {
            sheet: &scene.sheet,
            elastic: &scene.elastic,
            pinned: &scene.pinned,
            loads: &loads,
            start: &start,
            collider: scene.collider.as_ref(),
            stiffness: &stiffness,
        };
        let rough = hold > 0.0;
        let newton_settings = NewtonSettings {
            residual: scale * if rough { settings.residual.max(1e-4) } else { settings.residual },
            // Rounding alone leaves larger forces in stiff cloth than in soft cloth.
            motion: if rough { 1e-6 } else { 1e-9 * scene.sheet.mean_edge() },
            most_iterations: left.min(if rough { 60 } else { left }),
            exact: true,
        };
        solved = newton.minimise(&task, contacts, &mut itself, &newton_settings, x);
        if let Some(collider) = &scene.collider {
            contacts.settle_anchors(collider, x);
        }
        left = left.saturating_sub(solved.iterations.max(1));
        if !rough {
            break;
        }
        let moved = x.iter().zip(&start).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        hold = if hold < 1e-6 {
            0.0
        } else if moved < 0.02 * scene.sheet.mean_edge() {
            hold * 1e-2
        } else {
            hold * 0.2
        };
    }
    solved
}
