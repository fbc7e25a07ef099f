//! A wrap in steps: root edges, growth, settling. One step is one tick of the simulation.

use std::sync::Arc;

use crate::body::Surface;
use crate::cloth::{ClothState, Garment};
use crate::pattern::Problem;
use crate::relax::RelaxSettings;
use crate::wrap::Marks;

/// How far a dressing has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Phase {
    /// Cloth is being laid from the marks outward.
    Growing,
    /// All cloth lies; it is being evened out.
    Settling,
    /// Nothing moves any more.
    AtRest,
}

/// A wrap under way.
#[derive(Clone, Debug)]
pub struct Dressing {
    garment: Arc<Garment>,
    surface: Arc<Surface>,
    settings: RelaxSettings,
    phase: Phase,
}

impl Dressing {
    /// Pastes the cloth round its marks. Problems tell what was left out; with no usable pair of marks nothing is mapped
    /// and the phase is `AtRest`.
    pub fn new(
        garment: Arc<Garment>,
        surface: Arc<Surface>,
        marks: &Marks,
        settings: RelaxSettings,
    ) -> (Self, ClothState, Vec<Problem>) {
        let _ = marks;
        let state = ClothState {
            positions: vec![glam::DVec3::ZERO; garment.vertex_count],
            mapped: vec![false; garment.vertex_count],
        };
        (Self { garment, surface, settings, phase: Phase::AtRest }, state, Vec::new())
    }

    /// One tick of work on `state`: a band of growth, or an iteration of settling. Same input, same bits.
    pub fn step(&mut self, state: &mut ClothState) -> Phase {
        let _ = (&self.garment, &self.surface, &self.settings, state);
        self.phase
    }

    /// How far it has come.
    pub fn phase(&self) -> Phase {
        self.phase
    }

    /// 0..=1 over growing and settling.
    pub fn progress(&self) -> f64 {
        1.0
    }
}
