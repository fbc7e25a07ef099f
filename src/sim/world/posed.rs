//! Change of pose: the cloth follows when its body takes another pose.

use std::sync::Arc;

use crate::body::Surface;
use crate::cloth::ClothState;
use crate::contact::Splits;
use crate::fit::Moved;
use crate::geometry::words::{Words, words};
use crate::repose::{Change, Outcome, ReposeSettings, Reposer};
use crate::sim::source::DrapeSource;
use crate::sim::source::GarmentSource;
use crate::sim::world::World;
use crate::wrap::Marks;

/// Approximate number of vertices moved by global steps in one tick of a change of pose; at least one step is done.
const VERTICES_A_TICK: usize = 40_000;

/// A finished change of pose. Until the cloth moves otherwise, the next change starts from the pose that the cloth was dressed
/// in: after any number of poses, it returns exactly to where it was.
#[derive(Clone, Debug)]
pub struct Posed {
    pub(super) reposer: Reposer,
    pub(super) cloth: Arc<ClothState>,
    outcome: Outcome,
    /// Whether it was draped in the pose.
    pub(super) is_draped: bool,
}

/// A change of pose in progress. The cloth keeps its old state until it is done; meanwhile a preview in the new pose is shown.
#[derive(Clone, Debug)]
pub struct Posing {
    source: Arc<GarmentSource>,
    /// The body in the new pose.
    body: Arc<Surface>,
    /// The body in its new size, to which the cloth is moved at the end; None for a change of pose alone.
    size: Option<Arc<Surface>>,
    then: Then,
    reposer: Reposer,
    change: Change,
    shown: Arc<ClothState>,
}

/// What is done with the cloth once it is in the new pose.
#[derive(Clone, Debug)]
pub enum Then {
    /// Nothing: the pose is a preview.
    Nothing,
    /// Where the cloth intersects itself in more places than before, drapes it with these fabrics until it rests; so too where it was
    /// draped without a fault and has one in the new pose.
    Part(Arc<DrapeSource>),
    /// Drapes like [`Then::Part`] where that is needed, and settles the cloth otherwise.
    Settle(Arc<DrapeSource>),
}

impl Then {
    fn care(&self) -> ReposeSettings {
        if matches!(self, Self::Nothing) { ReposeSettings::LIVE } else { ReposeSettings::THOROUGH }
    }
}

impl Posing {
    /// Gives the pieces the placements that they have in `source`.
    pub(in crate::sim) fn place_as(&mut self, source: &GarmentSource) {
        Arc::make_mut(&mut self.source).pattern = Arc::clone(&source.pattern);
    }

    /// Progress, 0..=1.
    pub fn progress(&self) -> f64 {
        self.change.progress()
    }
}

impl World {
    /// A world in which the cloth begins to follow its body to the pose of `body`, which takes some ticks. None where nothing is
    /// dressed; cloth that still grows starts again there. The error is in words.
    pub fn reposed(
        &mut self,
        body: Arc<Surface>,
        marks: Arc<Marks>,
        then: Then,
    ) -> Result<Option<Self>, Words> {
        let (Some(garment), Some(from), Some(source)) = (&self.garment, &self.body, &self.source) else {
            return Ok(None);
        };
        let mut source = Arc::clone(source);
        if let Some(trials) = &self.trials {
            source = Arc::clone(trials.source());
        }
        Arc::make_mut(&mut source).marks = marks;
        if let Some(world) = self.tried_again(Arc::clone(&source), Arc::clone(&body)) {
            let places = Arc::clone(&self.places);
            return world.map(|world| Some(Self { places, ..world }));
        }
        if self.dressing.as_ref().is_some_and(|dressing| dressing.relaxer().is_none()) {
            let places = Arc::clone(&self.places);
            return Ok(Some(Self { relaxing: self.relaxing, places, ..Self::wrapped(source, body) }));
        }
        if let Some(world) = self.placed_again(Arc::clone(&source), Arc::clone(&body)) {
            return world.map(Some);
        }
        let (garment, from) = (Arc::clone(garment), Arc::clone(from));
        let known = self.lying_as_posed().map(|posed| posed.reposer.clone());
        self.release();
        let new = || Reposer::new(&garment, from, ClothState::clone(&self.cloth), source.relax);
        let mut reposer =
            known.or_else(new).ok_or_else(|| words!("the garment is too large for this machine's memory"))?;
        let mut change = Change::new(&mut reposer, Arc::clone(&body), then.care())
            .ok_or_else(|| words!("the body in the new pose has other triangles than the dressed one"))?;
        change.step(&mut reposer);
        let shown = Arc::new(change.cloth().clone());
        let posing = Posing { source, body, size: None, then, reposer, change, shown };
        Ok(Some(Self { posing: Some(Arc::new(posing)), ..self.clone() }))
    }

    /// A world in which the cloth begins to follow its body to the size of `body`; `through` is that size in the present
    /// triangles. None where nothing is dressed; cloth that still grows or is being sewn starts again there. The error is in
    /// words.
    pub fn resized(
        &mut self,
        through: Arc<Surface>,
        body: Arc<Surface>,
        marks: Arc<Marks>,
        fabrics: Arc<DrapeSource>,
    ) -> Result<Option<Self>, Words> {
        let then = if self.moved == Moved::Draped { Then::Part(fabrics) } else { Then::Settle(fabrics) };
        let grows = self.dressing.as_ref().is_some_and(|dressing| dressing.relaxer().is_none());
        if grows || self.sewing.is_some() || self.trials.is_some() {
            return self.reposed(body, marks, then);
        }
        let mut world = self.reposed(through, marks, then)?;
        if let Some(posing) = world.as_mut().and_then(|world| world.posing.as_mut()) {
            Arc::make_mut(posing).size = Some(body);
        }
        Ok(world)
    }

    /// What is shown and saved: the cloth, the source of its garment, and the body it is on.
    pub fn shown(&self) -> (&Arc<ClothState>, Option<&Arc<GarmentSource>>, Option<&Arc<Surface>>) {
        match &self.posing {
            Some(posing) => {
                let body = posing.size.as_ref().unwrap_or(&posing.body);
                (&posing.shown, Some(&posing.source), Some(body))
            }
            None => (&self.cloth, self.source.as_ref(), self.body.as_ref()),
        }
    }

    /// Does a tick of the change of pose.
    pub(in crate::sim) fn pose(&mut self) {
        let Some(posing) = &mut self.posing else { return };
        let posing = Arc::make_mut(posing);
        let most = (VERTICES_A_TICK / self.cloth.positions.len().max(1)).max(1);
        let mut done = 0;
        while done < most && !posing.change.is_done() {
            done += posing.change.step(&mut posing.reposer);
        }
        if posing.change.is_done() {
            self.finish_posing();
        }
    }

    /// Finishes the change of pose, if there is one, at once.
    pub fn finish_posing(&mut self) {
        let Some(posing) = self.posing.take() else { return };
        let Posing { source, body, size, then, mut reposer, mut change, .. } = Arc::unwrap_or_clone(posing);
        while !change.is_done() {
            change.step(&mut reposer);
        }
        let (cloth, outcome) = change.into_cloth();
        let cloth = Arc::new(cloth);
        let to = size.as_ref().unwrap_or(&body);
        self.splits = self
            .garment
            .as_ref()
            .and_then(|garment| Splits::of_lying(garment, &cloth, to, source.relax.offset).map(Arc::new));
        let more_crossings = outcome.crossings > reposer.crossings();
        // The next change of pose cannot start from triangles that the body no longer has.
        let posed = Posed { reposer, cloth: Arc::clone(&cloth), outcome, is_draped: false };
        self.posed = size.is_none().then(|| Arc::new(posed));
        (self.source, self.body, self.cloth) = (Some(source), Some(size.unwrap_or(body)), cloth);
        (self.dressing, self.draping, self.was_sewn, self.hung_at) = (None, None, false, None);
        if self.moved == Moved::Wrapped {
            self.moved = Moved::Carried;
        }
        match then {
            Then::Part(fabrics) | Then::Settle(fabrics) if more_crossings => self.drape_posed(fabrics),
            Then::Part(fabrics) => self.walk_if_worse(self.posed.clone(), &fabrics),
            Then::Settle(_) => self.settle(),
            Then::Nothing => {}
        }
        self.part_active();
    }

    /// Statistics of the last change of pose; None once the cloth has moved since.
    pub fn outcome(&self) -> Option<Outcome> {
        self.lying_as_posed().map(|posed| posed.outcome)
    }

    /// Whether the cloth lies as it was carried to the pose of the body, not draped there.
    pub fn is_carried(&self) -> bool {
        self.lying_as_posed().is_some_and(|posed| !posed.is_draped)
    }

    /// Declares the present position of the cloth the result of the change of pose `posed`; `is_draped` tells whether it was draped
    /// in the pose.
    pub(in crate::sim) fn lies_as(&mut self, posed: Arc<Posed>, is_draped: bool) {
        let cloth = Arc::clone(&self.cloth);
        self.posed = Some(Arc::new(Posed { cloth, is_draped, ..Arc::unwrap_or_clone(posed) }));
    }

    fn lying_as_posed(&self) -> Option<&Arc<Posed>> {
        self.posed.as_ref().filter(|posed| Arc::ptr_eq(&posed.cloth, &self.cloth))
    }
}
