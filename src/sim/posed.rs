//! Cloth that went along when its body took another pose.

use std::sync::Arc;

use crate::body::Surface;
use crate::cloth::ClothState;
use crate::contact::Splits;
use crate::repose::{Care, Outcome, Reposer};
use crate::sim::world::World;
use crate::wrap::Marks;

/// A change of pose. While the cloth lies as it left it, the next one starts from the pose that the cloth was dressed in:
/// through however many poses it goes, it comes back to where it lay.
#[derive(Clone, Debug)]
pub struct Posed {
    reposer: Reposer,
    cloth: Arc<ClothState>,
    outcome: Outcome,
}

impl World {
    /// The dressed cloth on its body in the pose of `body`. None where nothing is dressed; cloth that still grows begins again
    /// there. The error is in words.
    pub fn reposed(
        &mut self,
        body: Arc<Surface>,
        marks: Arc<Marks>,
        settle: bool,
        care: Care,
    ) -> Result<Option<Self>, String> {
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
            known.or_else(new).ok_or("the garment is too large for this machine's memory".to_owned())?;
        let (cloth, outcome) = reposer
            .reposed(&body, care)
            .ok_or("the body in the new pose has other triangles than the dressed one".to_owned())?;
        let cloth = Arc::new(cloth);
        let splits = Splits::of_lying(&garment, &cloth, &body, source.relax.offset).map(Arc::new);
        let posed = Some(Arc::new(Posed { reposer, cloth: Arc::clone(&cloth), outcome }));
        let mut world = Self {
            source: Some(source),
            body: Some(body),
            cloth,
            dressing: None,
            splits,
            posed,
            draping: None,
            was_sewn: false,
            ..self.clone()
        };
        if settle {
            world.settle();
        }
        Ok(Some(world))
    }

    /// The dressed cloth on `body`, its own in another size, of which `through` is the same in the triangles of its own. None
    /// where nothing is dressed; cloth that still grows or is sewn begins again there. The error is in words.
    pub fn resized(
        &mut self,
        through: Arc<Surface>,
        body: Arc<Surface>,
        marks: Arc<Marks>,
    ) -> Result<Option<Self>, String> {
        let grows = self.dressing.as_ref().is_some_and(|dressing| dressing.relaxer().is_none());
        if grows || self.sewing.is_some() || self.trials.is_some() {
            return self.reposed(body, marks, false, Care::THOROUGH);
        }
        let Some(world) = self.reposed(through, marks, false, Care::THOROUGH)? else { return Ok(None) };
        let (garment, source) = (world.garment.as_ref(), world.source.as_ref());
        let splits = garment.zip(source).and_then(|(garment, source)| {
            Splits::of_lying(garment, &world.cloth, &body, source.relax.offset).map(Arc::new)
        });
        // Another pose is not gone to from triangles that the body has no longer.
        let mut world = Self { body: Some(body), splits, posed: None, ..world };
        if !world.was_draped {
            world.settle();
        }
        Ok(Some(world))
    }

    /// What came of the last change of pose, while the cloth lies as it left it.
    pub fn outcome(&self) -> Option<Outcome> {
        self.lying_as_posed().map(|posed| posed.outcome)
    }

    fn lying_as_posed(&self) -> Option<&Arc<Posed>> {
        self.posed.as_ref().filter(|posed| Arc::ptr_eq(&posed.cloth, &self.cloth))
    }
}
