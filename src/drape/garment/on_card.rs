//! Draping on a graphics card, where one may be used.
//!
//! A card makes the small steps of cloth that is above the floor, that intersects neither itself nor the body, and on which nothing
//! acts that is not [`is_plain`](crate::drape::solver::small_steps::SmallSteps::is_plain). Everything else, and every tick that the
//! card could not make, the processor does. What a card has moved is not the same on every machine, see [`crate::card`].

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use glam::DVec3;
use rayon::prelude::*;

use crate::body::Surface;
use crate::card::{Body, Card, CardFault, CardSlot, CardSteps, Cloth, Hand, Span};
use crate::cloth::GRAVITY;
use crate::drape::garment::{Begun, DrapedGarment, Fixed, TICK};
use crate::drape::solver::advance::Advance;
use crate::drape::solver::surroundings::{EASE, Surroundings};
use crate::geometry::parallel::LEAST_SEARCHES;

/// Triangles from which on a card is faster than two processor cores: at 10,000 three times (H100), and more with more.
pub const LEAST_TRIANGLES: usize = 8000;
/// Vertices times small steps in one call of [`DrapedGarment::go_on`]. Chosen by trial; it bounds for how long a call has to wait
/// for the card.
const MOST_WORK: usize = 12_000_000;
/// Ticks for which the processor drapes after the card could not. Chosen by trial; it bounds how often the card is tried in vain.
const PAUSE: u32 = 12;

/// A garment on a card.
#[derive(Clone, Debug)]
pub(in crate::drape) struct OnCard {
    /// Shared by clones: every run begins by writing all that moves.
    steps: Arc<Mutex<CardSteps>>,
    /// Small steps in a tick.
    substeps: usize,
    /// Ticks for which the card is not used.
    pause: u32,
}

impl OnCard {
    fn lock(&self) -> MutexGuard<'_, CardSteps> {
        self.steps.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl DrapedGarment {
    /// Uses the card of `slot` from now on, where there is one for cloth of this size.
    pub fn with_card(mut self, slot: &CardSlot) -> Self {
        if !self.settings.self_collision || self.will_be.is_some() {
            return self;
        }
        let Some(card) = slot.for_cloth(self.fixed.sheet.triangles.len()) else { return self };
        match steps((&self.fixed, &self.collider.surface), card, &self.state.positions, self.settings.strain)
        {
            Ok(steps) => {
                let substeps = (self.substeps as f64 * steps.slowness()).ceil() as usize;
                self.card = Some(OnCard { steps: Arc::new(Mutex::new(steps)), substeps, pause: 0 });
            }
            Err(fault) => tracing::warn!("draped without the graphics card: {fault}"),
        }
        self
    }

    /// Whether a card has moved the cloth, now or before.
    pub fn was_on_card(&self) -> bool {
        self.was_on_card
    }

    /// Begins a tick on the card, if it can be made there: number of small steps.
    pub(super) fn steps_on_card(&mut self) -> Option<usize> {
        let can = !self.floats && self.rubs.is_none() && self.crossings == 0 && self.small.is_plain();
        let is_near_floor = self.card.is_some() && self.may_reach_floor();
        let card = self.card.as_mut()?;
        if !can || card.pause > 0 {
            card.pause = card.pause.saturating_sub(1);
            return None;
        }
        if is_near_floor || !self.small.is_clean(&self.state.positions, &self.collider) {
            card.pause = PAUSE;
            return None;
        }
        Some(card.substeps)
    }

    /// Whether some of the cloth may come to the floor within a tick.
    fn may_reach_floor(&self) -> bool {
        let Some(floor) = self.floor() else { return false };
        let lowest = self.state.positions.iter().map(|x| x.y).fold(f64::INFINITY, f64::min);
        lowest - self.fixed.offset < floor + (self.progress.speed + GRAVITY.length() * TICK) * TICK
    }

    /// Makes some of the small steps of a tick on the card. Where that fails, the tick begins again on the processor.
    pub(super) fn move_on_card(&mut self, begun: &mut Begun, around: &Surroundings<'_>) {
        let Some(card) = self.card.clone() else { return };
        let count = begun.advance.take((MOST_WORK / self.state.positions.len()).max(1));
        let span = Span {
            small: begun.advance.small(),
            gravity: around.gravity,
            damping: around.damping,
            bending_damping: around.bending_damping,
            offset: around.offset,
            grip: around.grip,
            ease: EASE,
            eases_off_body: true,
            lift: self.small.lift(),
            inverse_mass: self.small.inverse_mass(),
            hand: self.small.hand.map(|hand| Hand {
                vertex: hand.vertex,
                target: hand.target,
                stiffness: hand.stiffness,
                most: hand.most,
            }),
        };
        let moving = (&mut self.state.positions[..], &mut self.state.velocities[..]);
        let mut steps = card.lock();
        let before = steps.detections;
        let outcome = steps.run(moving, &span, count);
        if let Some(separation) = &mut self.small.separation {
            separation.counters.detections += steps.detections - before;
        }
        drop(steps);
        match outcome {
            Ok(()) => self.was_on_card = true,
            Err(fault) => {
                tracing::info!("this tick is draped by the processor: {fault}");
                self.state = begun.before.clone();
                begun.advance = Advance::new(begun.span, self.finer(self.substeps));
                begun.on_card = false;
                let lasts = matches!(fault, CardFault::Broken(_) | CardFault::Full);
                self.card = (!lasts).then_some(OnCard { pause: PAUSE, ..card });
            }
        }
    }

    /// Which simulated vertices are near the body.
    pub(super) fn near_body(&self) -> Vec<bool> {
        let (collider, offset) = (&self.collider, self.fixed.offset);
        if self.card.is_none() {
            return self
                .state
                .positions
                .iter()
                .enumerate()
                .map(|(v, x)| self.small.height(v, *x).is_some())
                .collect();
        }
        // The processor's look-ups are old by now. As for those, twice the offset is near.
        let lifts = self.small.lift();
        let is_near =
            |(x, lift): (&DVec3, &f64)| collider.surface.nearest_within(*x, 2.0 * (offset + lift)).is_some();
        self.state.positions.par_iter().zip(lifts).with_min_len(LEAST_SEARCHES).map(is_near).collect()
    }
}

fn steps(
    (fixed, surface): (&Fixed, &Surface),
    card: &Arc<Card>,
    x: &[DVec3],
    limit: f64,
) -> Result<CardSteps, CardFault> {
    let Fixed { sheet, bending, .. } = fixed;
    let rows: Vec<Vec<(u32, f64)>> = (0..sheet.len()).map(|v| bending.row(v).collect()).collect();
    let cloth = Cloth {
        triangles: &sheet.triangles,
        adjacency: &sheet.adjacency,
        springs: &fixed.springs,
        limit,
        bending: &rows,
        mass: &fixed.mass,
        area: &sheet.vertex_area,
        friction: &fixed.friction,
        thickness: Some(fixed.thickness),
    };
    let normals = surface.pseudonormals();
    let body = Body { mesh: &surface.mesh, adjacency: &surface.adjacency, normals: &normals };
    CardSteps::new(Arc::clone(card), &cloth, Some(&body), x)
}
