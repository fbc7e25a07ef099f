//! Which pairs of the cloth with itself can touch in the next few small steps: the others need not be looked at in each.

use glam::DVec3;

/// Small steps that a vertex is given room for, at the pace of its last one.
const STEPS: f64 = 10.0;
/// Of the thickness: room that every vertex is given.
const LEAST_ROOM: f64 = 0.2;

/// What is known of how far vertices may go.
#[derive(Clone, Debug, Default)]
pub(super) struct Near {
    /// The pairs that can touch, in their order.
    pub pairs: Vec<u32>,
    /// Where the vertices were when they were found,
    at: Vec<DVec3>,
    /// and in the small step before this one.
    last: Vec<DVec3>,
    /// How far from there each may go beside the mean of all, metres.
    pub room: Vec<f64>,
}

impl Near {
    /// Pairs are found again next time.
    pub fn forget(&mut self) {
        self.at.clear();
        self.pairs.clear();
    }

    /// Of so few pairs any may touch: to know better would cost more.
    pub fn all(&mut self, count: usize) {
        self.at.clear();
        self.last.clear();
        if self.pairs.len() != count {
            self.pairs.clear();
            self.pairs.extend(0..count as u32);
        }
    }

    /// Whether all vertices, now at `x`, are where they were expected, and will be after another small step like the last.
    pub fn holds(&mut self, x: &[DVec3]) -> bool {
        if self.at.len() != x.len() {
            return false;
        }
        let [drift, pace] = [&self.at, &self.last].map(|from| drift(from, x));
        let stays = |i: usize| {
            let (come, step) = (x[i] - self.at[i] - drift, x[i] - self.last[i] - pace);
            come.length() + step.length() <= self.room[i]
        };
        let holds = (0..x.len()).all(stays);
        if holds {
            self.last.copy_from_slice(x);
        }
        holds
    }

    /// Gives the vertices, now at `x`, room to go on.
    pub fn begin(&mut self, x: &[DVec3], thickness: f64) {
        let least = LEAST_ROOM * thickness;
        self.room.clear();
        if self.last.len() == x.len() {
            let pace = drift(&self.last, x);
            let room = |(from, to): (&DVec3, &DVec3)| (STEPS * (*to - *from - pace).length()).max(least);
            self.room.extend(self.last.iter().zip(x).map(room));
        } else {
            self.room.resize(x.len(), least);
        }
        for places in [&mut self.at, &mut self.last] {
            places.clear();
            places.extend_from_slice(x);
        }
    }
}

/// The mean way.
fn drift(from: &[DVec3], to: &[DVec3]) -> DVec3 {
    from.iter().zip(to).map(|(from, to)| *to - *from).sum::<DVec3>() / to.len().max(1) as f64
}
