//! The end of a change of pose by draping: in the pose, or along the way to it.

use std::sync::Arc;

use crate::cloth::ClothState;
use crate::contact::Splits;
use crate::fit::{Moved, fallen_from, tops};
use crate::sim::source::DrapeSource;
use crate::sim::world::World;
use crate::sim::world::draped::walk::{Going, Walk};
use crate::sim::world::draped::{Draping, worn};
use crate::sim::world::posed::Posed;

/// What is still to be done for a change of pose once the cloth rests.
#[derive(Clone, Debug)]
pub(super) struct EndOfPose {
    /// The change of pose; None where the body got other triangles with it.
    posed: Option<Arc<Posed>>,
    /// For cloth that is draped along the way: what it would be otherwise.
    otherwise: Option<Otherwise>,
}

/// The result of a change of pose, kept while the cloth is draped along the way.
#[derive(Clone, Debug)]
struct Otherwise {
    cloth: Arc<ClothState>,
    splits: Option<Arc<Splits>>,
    /// Number of its faults, and of places with them.
    faults: (usize, usize),
}

impl World {
    /// Drapes cloth that has just come to another pose until it rests; then its position counts as the result of that change of
    /// pose.
    pub(in crate::sim) fn drape_posed(&mut self, source: Arc<DrapeSource>) {
        let ends = Some(EndOfPose { posed: self.posed.clone(), otherwise: None });
        self.draping = Some(Arc::new(Draping { ends, ..Draping::new(source) }));
    }

    /// Begins to drape draped cloth along the way to the pose that it has come to by `posed`, where it had no fault before and has one
    /// now.
    pub(in crate::sim) fn walk_if_worse(&mut self, posed: Option<Arc<Posed>>, source: &Arc<DrapeSource>) {
        let Some(posed) = posed.filter(|_| self.moved == Moved::Draped) else { return };
        let before = || Self {
            cloth: Arc::new(posed.reposer.cloth().clone()),
            body: Some(Arc::clone(posed.reposer.from())),
            splits: None,
            ..self.clone()
        };
        let Some(judged) = self.judged().filter(|judged| !judged.faults.is_empty()) else { return };
        if before().judged().is_some_and(|before| before.faults.is_empty())
            && let Some(walk) = self.begun_walk(&posed, source)
        {
            let (cloth, splits) = (Arc::clone(&self.cloth), self.splits.clone());
            let faults = (judged.faults.len(), judged.places);
            let otherwise = Some(Otherwise { cloth, splits, faults });
            let ends = Some(EndOfPose { posed: Some(posed), otherwise });
            let walk = Some(Arc::new(walk));
            self.draping = Some(Arc::new(Draping { ends, walk, ..Draping::new(Arc::clone(source)) }));
        }
    }

    fn begun_walk(&self, posed: &Posed, fabrics: &DrapeSource) -> Option<Walk> {
        let garment = Arc::clone(self.active.as_ref().or(self.garment.as_ref())?);
        let (held, skips) = (self.held(), self.source.as_ref()?.relax.skips);
        Walk::new(posed.reposer.clone(), Arc::clone(self.body.as_ref()?), |cloth, body| {
            worn((garment, cloth), body, fabrics, &held, skips).ok()
        })
    }

    /// Does a part of a tick on the way to a pose.
    pub(super) fn walk(&mut self) {
        let Some(draping) = self.draping.as_mut().map(Arc::make_mut) else { return };
        let Some(walk) = &mut draping.walk else { return };
        match Arc::make_mut(walk).go_on() {
            Going::On => {}
            Going::Arrived => {
                let Some(Walk { mut worn, cloth, .. }) = draping.walk.take().map(Arc::unwrap_or_clone) else {
                    return;
                };
                self.separated = self.separated.and(worn.take_separation());
                draping.worn = Some(match &self.card {
                    Some(slot) => worn.with_card(slot),
                    None => worn,
                });
                // Where it would hang had it not been draped, as far as that is known.
                self.hung_at = self.garment.as_ref().map(|garment| tops(garment, &self.cloth).into());
                self.cloth = Arc::new(cloth);
                (self.splits, self.posed) = (None, None);
            }
            Going::Stuck => self.go_otherwise(),
        }
    }

    /// Takes the cloth as it came to the pose without being draped along the way.
    fn go_otherwise(&mut self) {
        let ends = self.draping.take().and_then(|draping| draping.ends.clone());
        let Some(EndOfPose { posed: Some(posed), otherwise: Some(otherwise) }) = ends else { return };
        (self.cloth, self.splits, self.hung_at) = (otherwise.cloth, otherwise.splits, None);
        let was_draped = posed.is_draped;
        self.lies_as(posed, was_draped);
    }

    /// Ends a change of pose with the cloth at rest.
    pub(super) fn finish_pose(&mut self) {
        let Some(draping) = self.draping.clone() else { return };
        let Some(EndOfPose { posed, otherwise }) = draping.ends.clone() else { return };
        if let Some(otherwise) = otherwise {
            let judged = self.judged().map(|judged| (judged.faults.len(), judged.places));
            let is_better = judged.is_some_and(|faults| faults <= otherwise.faults) && !self.has_fallen();
            self.hung_at = None;
            return if is_better { self.end_pose(posed) } else { self.go_otherwise() };
        }
        self.end_pose(posed);
        self.walk_if_worse(self.posed.clone(), &draping.source);
    }

    /// Whether pieces hang much lower than they did.
    fn has_fallen(&self) -> bool {
        let (Some(tops), Some(source), Some(garment)) = (&self.hung_at, &self.source, &self.garment) else {
            return false;
        };
        !fallen_from(tops, &source.pattern, garment, &self.cloth).is_empty()
    }

    fn end_pose(&mut self, posed: Option<Arc<Posed>>) {
        self.draping = None;
        if let Some(posed) = posed {
            self.lies_as(posed, true);
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::sim::simulation::tests::{ball, cotton, source};
    use crate::sim::source::ClothPlace;
    use crate::sim::world::posed::Then;

    /// A patch that was draped on a ball without a fault, carried to where the ball is moved to, and damaged there.
    fn damaged() -> World {
        let mut world = World::wrapped(source(), ball());
        while !world.lies_still() {
            world.advance();
        }
        let piece = *source().pattern.pieces.keys().next().expect("a piece");
        let at = [(0.0, 0.1), (0.2, 0.1)].map(|at| ClothPlace { piece, at: at.into() });
        world.set_pins(&at);
        world.moved = Moved::Draped;
        let aside = ball().mesh.positions.iter().map(|p| *p + DVec3::X * 0.05).collect();
        let there = Arc::new(ball().reposed(aside).expect("as many vertices"));
        let moved = world.reposed(there, Arc::default(), Then::Part(cotton()));
        let mut world = moved.expect("moved").expect("there is cloth");
        world.finish_posing();
        assert!(world.draping.is_none() && world.outcome().is_some(), "carried without a fault");
        let middle = DVec3::X * 0.05;
        Arc::make_mut(&mut world.cloth).positions.iter_mut().for_each(|p| *p = p.lerp(middle, 0.5));
        world.walk_if_worse(world.posed.clone(), &cotton());
        assert!(world.drape_state().is_some_and(|state| state.way == Some(0.0) && state.runs));
        world
    }

    fn at_rest(mut world: World) -> World {
        while world.drapes_now() {
            world.step();
        }
        assert!(world.draping.is_none() && world.outcome().is_some(), "the end of a change of pose");
        world
    }

    #[test]
    fn what_has_a_fault_in_a_pose_is_draped_along_the_way_there() {
        let world = at_rest(damaged());
        let faults = world.judged().expect("a garment").faults;
        assert!(faults.is_empty(), "{faults:?}");
    }

    #[test]
    fn what_comes_out_worse_on_the_way_stays_as_it_was() {
        let mut damaged = damaged();
        let before = Arc::clone(&damaged.cloth);
        let otherwise = Otherwise { cloth: Arc::clone(&before), splits: None, faults: (9, 9) };
        let ends = Arc::make_mut(damaged.draping.as_mut().expect("begun")).ends.as_mut().expect("a pose");
        ends.otherwise = Some(otherwise);
        while damaged.draping.as_ref().is_some_and(|draping| draping.walk.is_some()) {
            damaged.step();
        }
        // It lies below where it was to lie, as if it had slid down.
        damaged.hung_at = Some(vec![10.0].into());
        assert!(Arc::ptr_eq(&at_rest(damaged).cloth, &before));
    }
    #[test]
    fn another_pin_on_the_way_ends_it() {
        let mut damaged = damaged();
        let before = Arc::clone(&damaged.cloth);
        damaged.step();
        assert!(!damaged.hold_draped(&[0]));
        assert!(damaged.draping.is_none() && Arc::ptr_eq(&damaged.cloth, &before));
    }
}
