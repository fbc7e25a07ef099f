//! Starts on the mannequin in the pose that it is built in, for garments that fail in the pose that it has: patterns are placed round
//! that pose, and what is dressed there is carried to the other.

use std::sync::Arc;

use crate::body::{Surface, bones};
use crate::geometry::words::Words;
use crate::pattern::Pattern;
use crate::place::onto;
use crate::sim::source::GarmentSource;
use crate::sim::start::Start;
use crate::sim::world::World;
use crate::sim::world::posed::Then;
use crate::sim::world::trials::Trials;

/// A body, and the same in the pose that it is built in; None: it has no other pose.
#[derive(Clone, Debug)]
pub struct BodyAndPose {
    pub body: Arc<Surface>,
    pub built: Option<Arc<Surface>>,
}

impl BodyAndPose {
    /// Without a built pose that is no other, or from which cloth cannot be carried since it has other triangles.
    pub(super) fn checked(self) -> Self {
        let is_another = |built: &Arc<Surface>| {
            let [one, other] = [&built.mesh, &self.body.mesh];
            one.triangles == other.triangles && one.positions != other.positions
        };
        Self { built: self.built.filter(is_another), ..self }
    }
}

impl From<Arc<Surface>> for BodyAndPose {
    fn from(body: Arc<Surface>) -> Self {
        Self { body, built: None }
    }
}

/// A start, and the pose that the body has then.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Try {
    pub start: Start,
    /// Whether it is the pose that the body is built in.
    pub as_built: bool,
}

/// What is tried of `starts`, in this order. Where the body is built in another pose, all are tried in that before any is sewn from its
/// placement in the pose that it has: patterns are drafted for a standing body. Marks find a body in any pose.
pub(super) fn tries(starts: &[Start], has_other: bool) -> Vec<Try> {
    let in_pose = |start: &Start| Try { start: *start, as_built: false };
    let built = |start: &Start| Try { start: *start, as_built: true };
    let (first, last) = starts.split_at(starts.iter().take_while(|start| **start == Start::Marks).count());
    let built = starts.iter().filter(|_| has_other).map(built);
    first.iter().map(in_pose).chain(built).chain(last.iter().map(in_pose)).collect()
}

impl Trials {
    /// Whether the present start is still on the body as it is built.
    pub(super) fn is_on_built(&self) -> bool {
        self.as_built && !self.carrying
    }

    /// Whether cloth with these faults, draped on the body as it is built, goes on to its pose. Few faults may come out on the way, or in
    /// the garment's own mesh; with more it goes on only where there is nothing else to take.
    pub(super) fn goes_into_pose(&self, faults: &[Words], places: usize) -> bool {
        let is_fair = faults.is_empty() || self.result(faults.to_vec(), places).is_nearly_clean();
        self.is_on_built() && self.now().1 && (is_fair || (self.best.is_none() && self.left.is_empty()))
    }

    /// What is taken where no start could be begun in the body's pose and none came to it: the cloth of the last one, on the body in
    /// its pose.
    pub(super) fn left_on_built(&self, world: &World) -> (Arc<World>, usize) {
        let world = World { body: Some(Arc::clone(&self.body)), ..world.clone() };
        (Arc::new(world), self.tried.len().saturating_sub(1))
    }

    /// The garment and the body of the present start.
    pub(super) fn source_and_body(&self) -> (Arc<GarmentSource>, Arc<Surface>) {
        match self.built.as_ref().filter(|_| self.as_built) {
            Some(built) => (placed_round(&self.source, built), Arc::clone(built)),
            None => (Arc::clone(&self.source), Arc::clone(&self.body)),
        }
    }
}

impl World {
    /// Begins to carry cloth on the body as it is built to the body's pose. False where that cannot be begun.
    pub(super) fn carry_into_pose(&mut self, trials: &mut Trials) -> bool {
        let then = Then::Part(Arc::clone(&trials.fabrics));
        // Marks that were suggested for the other pose are not where they would be suggested for this one.
        let carried = self.reposed(Arc::clone(&trials.body), Arc::default(), then);
        let Ok(Some(carried)) = carried else { return false };
        *self = carried;
        // The pieces are placed as the user placed them.
        if let Some(posing) = &mut self.posing {
            Arc::make_mut(posing).place_as(&trials.source);
        }
        (trials.carrying, trials.ticks) = (true, 0);
        true
    }

    /// Begins to carry the cloth as it was before it was draped on the body as it is built. False where that had faults, or was
    /// carried already.
    pub(super) fn carry_undraped(&mut self, trials: &mut Trials) -> bool {
        let Some(world) = trials.undraped.take() else { return false };
        *self = Self { relaxing: self.relaxing, ..Arc::unwrap_or_clone(world) };
        trials.draping = false;
        self.carry_into_pose(trials)
    }
}

/// `source` with its pieces placed round `body`.
fn placed_round(source: &Arc<GarmentSource>, body: &Surface) -> Arc<GarmentSource> {
    let bones = body.landmarks().map(|marks| bones::extracted(body, marks)).unwrap_or_default();
    let mut pattern = Pattern::clone(&source.pattern);
    onto(&pattern, body, &bones, source.relax.offset * body.scale()).carry_out(&mut pattern);
    Arc::new(GarmentSource { pattern: Arc::new(pattern), ..GarmentSource::clone(source) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::Moved;
    use crate::sim::simulation::tests::ball;
    use crate::sim::start::{AsBuilt, Tried};
    use crate::sim::world::trials::refined::tests::faulty;
    use crate::sim::world::trials::tests::rested;

    /// Trials on a ball aside of where it is built, of which no start is left, and the world of cloth where it is built.
    fn on_built() -> (World, Trials, Arc<Surface>) {
        let (world, mut trials) = faulty();
        let aside = ball().mesh.positions.iter().map(|p| *p + glam::DVec3::X * 0.05).collect();
        let posed = Arc::new(ball().reposed(aside).expect("as many vertices"));
        (trials.body, trials.built, trials.fine, trials.refining) =
            (Arc::clone(&posed), Some(ball()), None, None);
        (trials.left, trials.draping) = (Vec::new(), true);
        (world, trials, posed)
    }

    fn posed_there(mut world: World) -> World {
        while world.posing.is_some() {
            world.pose();
        }
        rested(world)
    }

    #[test]
    fn what_fails_in_a_pose_is_dressed_in_the_built_one_and_carried_to_it() {
        let (world, mut trials, posed) = on_built();
        trials.note(world.clone(), vec![Words::plain("it crosses itself")], Tried::FEW + 1);
        trials.left = vec![Try { start: Start::Marks, as_built: true }];
        let again = World::next_start(&mut trials).expect("once more");
        assert!(trials.as_built && again.body.as_ref().is_some_and(|body| body.mesh == ball().mesh));
        trials.draping = true;
        let mut world = World { moved: Moved::Draped, ..rested(again) };
        let before = Arc::clone(&world.cloth);
        assert!(world.after_start(&mut trials, None).is_none() && world.posing.is_some());
        let world = posed_there(world).after_start(&mut trials, None).expect("taken");
        let started = world.started.as_ref().expect("told");
        assert_eq!(started.taken().as_built, Some(AsBuilt::Carried));
        assert!(started.taken().faults.is_empty());
        assert!(world.body.as_ref().is_some_and(|body| Arc::ptr_eq(body, &posed)));
        for (p, q) in before.positions.iter().zip(&world.cloth.positions) {
            assert!((*q - *p).distance(glam::DVec3::X * 0.05) < 1e-3, "{p} to {q}");
        }
    }

    #[test]
    fn what_is_faulty_in_the_built_pose_is_carried_where_there_is_nothing_else() {
        let (world, mut trials, posed) = on_built();
        trials.as_built = true;
        let words = || Some(Words::plain("it crosses itself"));
        let mut world = World { moved: Moved::Draped, ..world };
        assert!(world.after_start(&mut trials, words()).is_none() && world.posing.is_some());
        let world = posed_there(world).after_start(&mut trials, words()).expect("taken");
        assert!(world.body.as_ref().is_some_and(|body| Arc::ptr_eq(body, &posed)));
        assert_eq!(world.started.as_ref().map(|started| (started.taken, started.tried.len())), Some((1, 2)));
    }

    #[test]
    fn cloth_that_never_lay_ends_the_search_on_the_right_body() {
        let (world, mut trials, posed) = on_built();
        (trials.as_built, trials.draping) = (true, false);
        let mut unlaid = World { cloth: Arc::default(), ..world };
        let world = unlaid.after_start(&mut trials, Some(Words::plain("it was not laid"))).expect("the end");
        assert!(world.body.is_some_and(|body| Arc::ptr_eq(&body, &posed)));
        assert_eq!(world.started.map(|started| started.taken().faults.len()), Some(1));
    }

    #[test]
    fn the_built_pose_comes_before_sewing_in_another() {
        let told = |starts: &[Start], has_other| -> String {
            let one = |t: Try| format!("{}{} ", if t.as_built { "built " } else { "" }, t.start);
            tries(starts, has_other).into_iter().map(one).collect()
        };
        let [marks, placement] = Start::ALL;
        assert_eq!(told(&[marks, placement], false), "marks placement ");
        assert_eq!(told(&[marks, placement], true), "marks built marks built placement placement ");
        assert_eq!(told(&[placement, marks], true), "built placement built marks placement marks ");
        assert_eq!(told(&[placement], true), "built placement placement ");
    }

    #[test]
    fn a_body_in_its_built_pose_has_no_other() {
        let both = |built| BodyAndPose { body: ball(), built: Some(built) }.checked();
        assert!(both(ball()).built.is_none());
        let larger = ball().mesh.positions.iter().map(|p| *p * 1.1).collect();
        assert!(both(Arc::new(ball().reposed(larger).expect("as many vertices"))).built.is_some());
    }

    #[test]
    fn cloth_that_fails_draped_in_the_built_pose_is_carried_undraped() {
        let (world, mut trials, posed) = on_built();
        (trials.as_built, trials.draping) = (true, false);
        let mut world = World { moved: Moved::Wrapped, ..world };
        assert!(world.after_start(&mut trials, None).is_none());
        assert!(trials.draping && trials.undraped.is_some(), "draped next");
        let fault = Some(Words::plain("it does not fit this body"));
        // What was found in the pose itself has a fault, too.
        (trials.carrying, trials.as_built) = (false, false);
        trials.note(world.clone(), fault.iter().cloned().collect(), 0);
        trials.as_built = true;
        assert!(world.after_start(&mut trials, fault.clone()).is_none() && world.posing.is_some());
        let mut world = posed_there(world);
        assert!(world.after_start(&mut trials, None).is_none() && trials.draping, "draped in its pose");
        let world = world.after_start(&mut trials, fault).expect("taken");
        let started = world.started.as_ref().expect("told");
        assert_eq!((started.taken().draped, started.taken().as_built), (false, Some(AsBuilt::Carried)));
        assert!(world.moved != Moved::Draped && world.body.is_some_and(|body| Arc::ptr_eq(&body, &posed)));
    }
}
