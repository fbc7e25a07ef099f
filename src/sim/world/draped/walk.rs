//! The way to another pose by physics: the cloth is draped while its body goes there, and so cannot come to cross itself.
//!
//! Before each tick the body goes on a little and the cloth goes along with the skin near it; in the tick it is draped on a body at
//! rest. (A body that moves within the tick would be stopped by nothing: cloth that lies on cloth is held where it is by the planes
//! between the two, and the skin would come through.)

use std::sync::Arc;

use crate::body::Surface;
use crate::cloth::ClothState;
use crate::drape::DrapedGarment;
use crate::repose::{PosePath, Reposer};

/// Farthest that a point of the body goes from one tick to the next, metres. Chosen by trial: half an edge of a triangle, over which
/// neighbours keep together.
const STEP: f64 = 0.01;

/// Cloth on its way to another pose of its body.
#[derive(Clone, Debug)]
pub(super) struct Walk {
    path: Arc<PosePath>,
    reposer: Reposer,
    pub(super) worn: DrapedGarment,
    pub(super) cloth: ClothState,
    body: Arc<Surface>,
    to: Arc<Surface>,
    /// Share of the way that the body has gone, 0..=1.
    share: f64,
    /// Share that it goes in a step.
    stride: f64,
    /// Whether a tick is partly done.
    in_tick: bool,
}

/// How a walk goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Going {
    On,
    /// The body is in its pose; the cloth still moves.
    Arrived,
    /// It does not go on without crossing.
    Stuck,
}

impl Walk {
    /// The way from the pose that `reposer` was bound in to `to`. `worn` makes the simulation of cloth on a body. None where there is
    /// no way.
    pub(super) fn new(
        reposer: Reposer,
        to: Arc<Surface>,
        worn: impl FnOnce(&ClothState, Arc<Surface>) -> Option<DrapedGarment>,
    ) -> Option<Self> {
        let body = Arc::clone(reposer.from());
        let cloth = reposer.cloth().clone();
        let path = PosePath::new(&body, &to)?;
        let ends = body.mesh.positions.iter().zip(&to.mesh.positions);
        let farthest = ends.map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        let stride = (STEP * body.scale() / farthest).min(1.0);
        let worn = worn(&cloth, Arc::clone(&body))?.rested(&cloth);
        Some(Self {
            path: Arc::new(path),
            reposer,
            worn,
            cloth,
            body,
            to,
            share: 0.0,
            stride,
            in_tick: false,
        })
    }

    /// Share of the way that lies behind, 0..=1.
    pub(super) fn progress(&self) -> f64 {
        self.share
    }

    /// Does a part of a tick.
    pub(super) fn go_on(&mut self) -> Going {
        if !self.in_tick && !self.step() {
            return Going::Stuck;
        }
        let Ok(whole) = self.worn.go_on(&mut self.cloth) else { return Going::Stuck };
        self.in_tick = !whole;
        if whole && self.share >= 1.0 { Going::Arrived } else { Going::On }
    }

    /// Takes body and cloth a step further. False where that cannot be done without crossing.
    fn step(&mut self) -> bool {
        let share = (self.share + self.stride).min(1.0);
        let Some(body) = self.at(share) else { return false };
        let ways = self.reposer.along(&self.body, &body, &self.cloth);
        let goes = self.worn.carry(Arc::clone(&body), &ways, &mut self.cloth);
        tracing::debug!("the way to the pose: {share:.4} {goes} {:?}", self.worn.faults());
        (self.body, self.share) = (body, share);
        goes
    }

    fn at(&self, share: f64) -> Option<Arc<Surface>> {
        if share >= 1.0 {
            return Some(Arc::clone(&self.to));
        }
        self.body.reposed(self.path.positions(share)?).map(Arc::new)
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use glam::{DQuat, DVec3};

    use super::*;
    use crate::cloth::{Garment, Skips, build};
    use crate::contact::Intersections;
    use crate::drape::DrapedSettings;
    use crate::geometry::shapes::icosphere;
    use crate::pattern::{Pattern, Piece};
    use crate::relax::RelaxSettings;
    use crate::sim::simulation::tests::cotton;

    const RADIUS: f64 = 0.3;

    fn worn(garment: &Arc<Garment>, cloth: &ClothState, body: Arc<Surface>) -> DrapedGarment {
        let settings = DrapedSettings { strain: 0.01, self_collision: true, skips: Skips::default() };
        let fabrics = (&BTreeMap::new(), &cotton().fabric);
        DrapedGarment::new(Arc::clone(garment), cloth, body, fabrics, &[], settings).expect("drapes")
    }

    /// A cloth draped over a ball until it rests.
    fn on_a_ball() -> (Arc<Garment>, ClothState, Arc<Surface>) {
        let half = 0.4;
        let corners = [(-half, -half), (half, -half), (half, half), (-half, half)].map(glam::DVec2::from);
        let mut pattern = Pattern::default();
        pattern.add_piece(Piece::polygon("cloth", &corners));
        let (garment, _) = build(&pattern, 0.06);
        let mut positions = vec![DVec3::ZERO; garment.vertex_count];
        for corner in &garment.corners {
            positions[corner.vertex as usize] = DVec3::new(corner.uv.x, RADIUS + 0.01, -corner.uv.y);
        }
        let mut cloth = ClothState { mapped: vec![true; positions.len()], positions };
        let body = Arc::new(Surface::new(icosphere(RADIUS, 3)).expect("a ball"));
        let garment = Arc::new(garment);
        rested(worn(&garment, &cloth, Arc::clone(&body)), &mut cloth);
        (garment, cloth, body)
    }

    fn rested(mut worn: DrapedGarment, cloth: &mut ClothState) -> u64 {
        while !worn.progress().at_rest {
            worn.tick(cloth).expect("a tick");
        }
        worn.progress().ticks
    }

    #[test]
    fn cloth_at_rest_that_is_draped_again_hardly_moves() {
        let (garment, cloth, body) = on_a_ball();
        let again = worn(&garment, &cloth, Arc::clone(&body)).rested(&cloth);
        let mut moved = cloth.clone();
        let ticks = rested(again, &mut moved);
        let far = cloth.positions.iter().zip(&moved.positions).map(|(p, q)| p.distance(*q));
        let far = far.fold(0.0, f64::max);
        assert!(far < 0.004, "{far} after {ticks} ticks; unslowed, it slips by centimetres");
    }

    #[test]
    fn a_pin_put_into_cloth_at_rest_and_taken_out_again_hardly_moves_it() {
        let (garment, mut cloth, body) = on_a_ball();
        let before = cloth.clone();
        let mut worn = worn(&garment, &cloth, body).rested(&cloth);
        let mut farthest = 0.0f64;
        for pins in [&[][..], &[0], &[]] {
            worn.pin(pins);
            while !worn.progress().at_rest {
                worn.tick(&mut cloth).expect("a tick");
                let far = before.positions.iter().zip(&cloth.positions).map(|(p, q)| p.distance(*q));
                farthest = far.fold(farthest, f64::max);
            }
        }
        assert!(farthest < 0.006, "{farthest}");
    }

    #[test]
    fn cloth_that_rested_and_has_lost_its_hold_falls_in_unslowed_time() {
        let (garment, mut cloth, body) = on_a_ball();
        cloth.positions.iter_mut().for_each(|p| p.y += 0.3);
        let mut falls = worn(&garment, &cloth, body).rested(&cloth);
        // It falls by 30 cm in 15 ticks, or in 60 of slowed time.
        for _ in 0..40 {
            falls.tick(&mut cloth).expect("a tick");
        }
        let lowest = cloth.positions.iter().map(|p| p.length()).fold(f64::MAX, f64::min);
        assert!(lowest < RADIUS * 1.02, "{lowest}");
    }

    #[test]
    fn cloth_goes_along_with_a_ball_that_turns_and_moves() {
        let (garment, cloth, body) = on_a_ball();
        let (turn, way) = (DQuat::from_rotation_y(0.6), DVec3::new(0.2, 0.0, 0.1));
        let there = |p: &DVec3| turn * *p + way;
        let to = body.reposed(body.mesh.positions.iter().map(there).collect()).expect("as many vertices");
        let reposer = Reposer::new(&garment, Arc::clone(&body), cloth.clone(), RelaxSettings::default());
        let mut walk =
            Walk::new(reposer.expect("bound"), Arc::new(to), |cloth, body| Some(worn(&garment, cloth, body)))
                .expect("a way");
        let mut ticks = 0;
        while walk.go_on() == Going::On {
            ticks += usize::from(!walk.in_tick);
            assert!(Intersections::new(&garment, &walk.cloth).places.is_empty());
            assert!(ticks < 200, "{}", walk.progress());
        }
        assert_eq!(walk.progress(), 1.0);
        let is_on = |p: &DVec3| (*p - way).length() < RADIUS + 0.01;
        let far = |walk: &Walk, of: &dyn Fn(&DVec3) -> bool| {
            let pairs = cloth.positions.iter().zip(&walk.cloth.positions);
            pairs.filter(|(_, q)| of(q)).map(|(p, q)| q.distance(there(p))).fold(0.0, f64::max)
        };
        assert!(walk.cloth.positions.iter().all(|q| (*q - way).length() > RADIUS * 0.99), "inside the ball");
        // Of a way of 22 cm and a turn of 34 degrees, in which cloth that hangs swings.
        let (lies, hangs) = (far(&walk, &is_on), far(&walk, &|_| true));
        assert!(lies < 0.007 && hangs < 0.012, "{lies} {hangs}");
    }
}
