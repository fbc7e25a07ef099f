//! Check, while cloth relaxes in another pose, whether its folds go away.

use crate::cloth::ClothState;

/// What the checks found.
#[derive(Clone, Debug)]
pub(super) struct Looks {
    /// Folded edges when the cloth was bound.
    bound: usize,
    folds: usize,
    fewest: usize,
    since_fewer: usize,
    strain: f64,
    /// The state with the least strain, and that strain, among those with no more folds than when the cloth was bound.
    unfolded: Option<(ClothState, f64)>,
}

impl Looks {
    /// No checks yet, for cloth that was bound with `bound` folded edges.
    pub fn new(bound: usize) -> Self {
        Self { bound, folds: 0, fewest: usize::MAX, since_fewer: 0, strain: 0.0, unfolded: None }
    }

    /// Records a check: the cloth in `state` has `folds` folded edges and this `strain`.
    pub fn see(&mut self, state: &ClothState, folds: usize, strain: f64) {
        (self.folds, self.strain) = (folds, strain);
        self.since_fewer = if folds < self.fewest { 0 } else { self.since_fewer + 1 };
        self.fewest = self.fewest.min(folds);
        if folds <= self.bound && self.unfolded.as_ref().is_none_or(|(_, least)| strain < *least) {
            self.unfolded = Some((state.clone(), strain));
        }
    }

    /// Whether there are no folds, or they are taken to stay, as two checks in a row found no fewer.
    pub fn is_unfolded(&self) -> bool {
        self.fewest == 0 || self.since_fewer >= 2
    }

    /// If the cloth has gained folds, restores the best state without them, unless that was strained more by over a
    /// tenth.
    pub fn give_back(self, state: &mut ClothState) {
        if let Some((unfolded, strain)) = self.unfolded
            && self.folds > self.bound
            && strain <= self.strain * 1.1
        {
            *state = unfolded;
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    fn cloth(at: f64) -> ClothState {
        ClothState { positions: vec![DVec3::X * at], mapped: vec![true] }
    }

    #[test]
    fn folds_that_stay_are_let_be() {
        let mut looks = Looks::new(0);
        for (folds, unfolded) in [(9, false), (7, false), (7, false), (8, true), (6, false), (0, true)] {
            looks.see(&cloth(0.0), folds, 0.1);
            assert_eq!(looks.is_unfolded(), unfolded, "{folds}");
        }
    }

    #[test]
    fn cloth_that_got_folds_is_given_back_without() {
        for (strain, back) in [(0.081, 1.0), (0.05, 2.0)] {
            let mut looks = Looks::new(1);
            looks.see(&cloth(0.0), 3, 0.06);
            looks.see(&cloth(1.0), 1, 0.082);
            looks.see(&cloth(2.0), 2, strain);
            let mut state = cloth(2.0);
            looks.give_back(&mut state);
            assert_eq!(state, cloth(back));
        }
    }
}
