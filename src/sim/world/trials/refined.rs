//! The start that was taken in a coarser mesh, in the garment's own: it settles there, and where it has a fault then it is mended, taken
//! undraped, or left for another start.

use std::sync::Arc;

use crate::fit::Moved;
use crate::geometry::words::Words;
use crate::sim::start::{Started, Tried};
use crate::sim::world::World;
use crate::sim::world::trials::Trials;

/// Stages of settling in the garment's own mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Refinement {
    /// From where the coarser mesh came to rest.
    First,
    /// Relaxing what had a fault then, which turns cloth that lies wrong side out.
    Mending,
    /// Draping once more.
    Again,
    /// Relaxing from where the coarser mesh came to rest: what has a fault when draped may have none without.
    Undraped,
}

impl World {
    /// The cloth in the garment's own mesh that is taken: this, which has these faults in so many places, or what it was before it was
    /// relaxed once more.
    pub(super) fn ended(
        &self,
        trials: &mut Trials,
        mut started: Started,
        (faults, places): (Vec<Words>, usize),
    ) -> Self {
        let taken = &mut started.tried[started.taken];
        let Some((draped, its_faults, its_places)) = trials.draped_fine.take() else {
            (taken.faults, taken.places, taken.ticks) = (faults, places, taken.ticks + trials.ticks);
            return Self { started: Some(Arc::new(started)), ..self.clone() };
        };
        (taken.faults, taken.places) = (its_faults, its_places);
        let is_better = faults.is_empty();
        let undraped = Tried { draped: false, faults, places, ticks: trials.ticks, ..taken.clone() };
        started.tried.push(undraped);
        if is_better {
            started.taken = started.tried.len() - 1;
            return Self { started: Some(Arc::new(started)), ..self.clone() };
        }
        Self { started: Some(Arc::new(started)), ..Arc::unwrap_or_clone(draped) }
    }

    /// The next start where `ended`, in the garment's own mesh, is only nearly clean; None where it is to be taken.
    pub(super) fn after_faulty(trials: &mut Trials, ended: &Self) -> Option<Self> {
        let started = ended.started.as_ref().filter(|s| s.taken().is_nearly_clean())?;
        trials.tried.clone_from(&started.tried);
        trials.best = Some((Arc::new(Self { started: None, ..ended.clone() }), started.taken));
        (trials.refinement, trials.coarse) = (Refinement::First, None);
        Self::next_start(trials)
    }

    /// Goes on with draped cloth that had `faults` in the garment's own mesh. False when there is nothing more to try.
    pub(super) fn mends_refined(&mut self, trials: &mut Trials, faults: &[Words], places: usize) -> bool {
        match trials.refinement {
            Refinement::First if trials.draping && !faults.is_empty() && self.not_finite().is_none() => {
                trials.refinement = Refinement::Mending;
                self.draping = None;
                self.settle();
                true
            }
            Refinement::Mending => {
                trials.refinement = Refinement::Again;
                self.drape_for(None, Arc::clone(&trials.fabrics));
                true
            }
            Refinement::Again if !faults.is_empty() && !trials.choice.draped => {
                let (Some(coarse), Some(edge_length)) = (trials.coarse.take(), trials.fine) else {
                    return false;
                };
                (trials.refinement, trials.draping) = (Refinement::Undraped, false);
                if let Some(started) = &mut trials.refining {
                    started.tried[started.taken].ticks += std::mem::take(&mut trials.ticks);
                }
                trials.draped_fine = Some((Arc::new(self.clone()), faults.to_vec(), places));
                let undraped = Self { moved: Moved::Wrapped, hung_at: None, ..Arc::unwrap_or_clone(coarse) };
                *self = undraped.refined(edge_length, Arc::clone(&trials.fabrics));
                true
            }
            Refinement::First | Refinement::Again | Refinement::Undraped => false,
        }
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::sim::simulation::tests::{ball, cotton, source};
    use crate::sim::start::{Start, StartChoice};
    use crate::sim::world::trials::FINER;
    use crate::sim::world::trials::tests::rested;

    /// Trials whose cloth has a fault in the garment's own mesh although it was draped twice there, and the world of that cloth.
    pub fn faulty() -> (World, Trials) {
        let begun = World::dressed(source(), ball().into(), cotton(), StartChoice::default());
        let mut world = begun.expect("begun");
        let mut trials = Arc::unwrap_or_clone(world.trials.take().expect("begun"));
        let world = rested(world);
        let (faults, places, ticks) = (Vec::new(), 0, 9);
        let tried =
            Tried { start: Start::Marks, draped: true, finer: false, as_built: None, faults, places, ticks };
        trials.fine = Some(0.03);
        trials.refining = Some(Started { tried: vec![tried], taken: 0 });
        (trials.refinement, trials.draping) = (Refinement::Again, true);
        trials.coarse = Some(Arc::new(World { moved: Moved::Draped, ..world.clone() }));
        (World { moved: Moved::Draped, ..world }, trials)
    }

    #[test]
    fn what_has_a_fault_draped_in_its_own_mesh_alone_is_taken_undraped() {
        let (mut world, mut trials) = faulty();
        let before = world.garment.as_ref().map_or(0, |garment| garment.triangles.len());
        assert!(world.after_start(&mut trials, Some(Words::plain("it fell off"))).is_none());
        assert_eq!(
            (trials.refinement, trials.now(), trials.count()),
            (Refinement::Undraped, (Start::Marks, false), 1)
        );
        let world = rested(world).after_start(&mut trials, None).expect("taken");
        let started = world.started.expect("told");
        let told: Vec<(bool, usize)> =
            started.tried.iter().map(|tried| (tried.draped, tried.faults.len())).collect();
        assert_eq!((told, started.taken), (vec![(true, 1), (false, 0)], 1));
        assert!(
            world.moved != Moved::Draped
                && world.garment.is_some_and(|garment| garment.triangles.len() > before)
        );
    }

    #[test]
    fn draped_cloth_is_taken_where_relaxed_cloth_has_a_fault_too() {
        let (mut world, mut trials) = faulty();
        assert!(world.after_start(&mut trials, Some(Words::plain("it fell off"))).is_none());
        let world =
            rested(world).after_start(&mut trials, Some(Words::plain("it crosses itself"))).expect("taken");
        let started = world.started.expect("told");
        assert_eq!((started.taken, &started.taken().faults[..]), (0, &[Words::plain("it fell off")][..]));
        assert!(world.moved == Moved::Draped && started.tried.len() == 2);
    }

    #[test]
    fn other_starts_follow_where_a_few_places_have_faults_in_the_garments_own_mesh() {
        let (world, mut trials) = faulty();
        let ended = |places: usize| {
            let (faults, ticks) = (vec![Words::plain("it crosses itself")], 9);
            let tried = Tried {
                start: Start::Marks,
                draped: true,
                finer: false,
                as_built: None,
                faults,
                places,
                ticks,
            };
            World { started: Some(Arc::new(Started { tried: vec![tried], taken: 0 })), ..world.clone() }
        };
        trials.left.clear();
        assert!(World::after_faulty(&mut trials, &ended(Tried::FEW + 1)).is_none());
        let own = trials.source.edge_length;
        assert!(World::after_faulty(&mut trials, &ended(Tried::FEW)).is_some());
        assert!(trials.finer && trials.source.edge_length == own * FINER && trials.tried.len() == 1);
        trials.left.clear();
        assert!(World::after_faulty(&mut trials, &ended(1)).is_none(), "once is enough");
        trials.finer = false;
        assert!(
            World::after_faulty(&mut trials, &ended(0)).is_none(),
            "a fault without a place is no chance"
        );
    }

    #[test]
    fn only_draped_cloth_is_taken_where_that_is_asked_for() {
        let (mut world, mut trials) = faulty();
        trials.choice.draped = true;
        let world = world.after_start(&mut trials, Some(Words::plain("it fell off"))).expect("taken");
        assert_eq!(world.started.expect("told").tried.len(), 1);
    }
}
