//! Which plan of growth is taken: those that leave many faults are given up, and the next is tried.

use glam::DVec3;

use crate::cloth::ClothState;
use crate::relax::Relaxer;
use crate::wrap::dressing::{Dressing, Stage};
use crate::wrap::growth::Growth;
use crate::wrap::plan::PLANS;
use crate::wrap::settling::Settling;

/// Numbers of triangles per fault. With 400 for `failed`, four faults of a T-shirt of 1,422 triangles, which finer meshes repaired, took a
/// second try. With 6 to 12 for `many`, no plan is given up either that would have succeeded (86 plans for 30 garments).
const TRIANGLES_PER_FAULT: TrianglesPerFault = TrianglesPerFault { failed: 150, many: 8 };

#[derive(Clone, Copy, Debug)]
struct TrianglesPerFault {
    /// With fewer a wrap has failed; finer meshes repair fewer faults.
    failed: usize,
    /// With fewer it has so many faults that they must get fewer while it settles.
    many: usize,
}

/// The best result of the plans tried before.
#[derive(Clone, Debug)]
pub(super) struct Attempt {
    faults: usize,
    contact: f64,
    relaxer: Relaxer,
    cloth: ClothState,
    /// [`Stage::GivenUp`] or [`Stage::Rest`].
    stage: Stage,
}

impl Dressing {
    /// Whether cloth that settles after it grew by a plan has many faults that do not get fewer.
    pub(super) fn is_hopeless(&mut self, state: &ClothState, settling: &mut Settling) -> bool {
        if self.plan.is_none() || !settling.is_to_be_looked_at() {
            return false;
        }
        let faults = self.relaxer.faults(state);
        let before = settling.faults.replace(faults);
        let are_many = faults * TRIANGLES_PER_FAULT.many > self.relaxer.garment.triangles.len();
        are_many && before.is_some_and(|before| faults >= before)
    }

    /// Judges cloth that grew by a plan and is at rest or given up: if it has too many faults, the next plan is tried,
    /// and after the last the best result is taken.
    pub(super) fn judge(&mut self, state: &mut ClothState) {
        let Some(plan) = self.plan.take() else { return };
        let counted = if let Stage::GivenUp(settling) = &self.stage { settling.faults } else { None };
        let faults = counted.unwrap_or_else(|| self.relaxer.faults(state));
        if faults * TRIANGLES_PER_FAULT.failed <= self.relaxer.garment.triangles.len() {
            self.best = None;
            return;
        }
        if self.best.as_ref().is_none_or(|best| faults < best.faults) {
            let (relaxer, cloth) = (self.relaxer.clone(), state.clone());
            let (contact, stage) = (self.contact, self.stage.clone());
            self.best = Some(Box::new(Attempt { faults, contact, relaxer, cloth, stage }));
        }
        if plan + 1 < PLANS.len() && self.begin_again(state).is_some() {
            self.plan = Some(plan + 1);
            self.contact = self.way().contact;
        } else if let Some(best) = self.best.take() {
            let counters = self.relaxer.counters;
            self.relaxer = best.relaxer;
            self.contact = best.contact;
            self.relaxer.counters = counters;
            *state = best.cloth;
            // What was given up settles to its end where nothing better was reached.
            self.stage = match best.stage {
                Stage::GivenUp(settling) => Stage::Settle(settling),
                stage => stage,
            };
        }
    }

    /// Starts again from the roots. None when there is not enough memory.
    fn begin_again(&mut self, state: &mut ClothState) -> Option<()> {
        let (garment, surface) = (self.relaxer.garment.clone(), self.relaxer.surface.clone());
        let mut relaxer = Relaxer::new(garment, surface, self.relaxer.settings)?;
        relaxer.counters = self.relaxer.counters;
        state.mapped.fill(false);
        // Friction and momentum take a vertex whose last position is the origin for a new one.
        state.positions.fill(DVec3::ZERO);
        for root in &self.roots {
            state.positions[root.vertex as usize] = root.position;
            state.mapped[root.vertex as usize] = true;
            relaxer.hold(root.vertex, root.position);
        }
        self.growth = Growth::new(&relaxer.garment, &self.order, &state.mapped);
        self.relaxer = relaxer;
        self.tier = 0;
        self.mapped = self.roots.len();
        let fresh = self.roots.iter().map(|r| r.vertex).collect();
        self.stage = Stage::Grow { limit: 0.0, bands: 0, fresh };
        Some(())
    }
}
