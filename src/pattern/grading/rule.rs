//! Grade rules: how far a point moves from the base size to each other size.

use glam::DVec2;
use serde::{Deserialize, Serialize};

use crate::geometry::ids::PieceId;
use crate::geometry::words::{Words, words};

/// Largest displacement of a rule, metres.
pub const FARTHEST: f64 = 1.0;

/// A point that can have a rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RulePoint {
    /// The piece.
    pub piece: PieceId,
    /// The internal line that the point is on, from 0. None: a closed line of the piece.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub line: Option<usize>,
    /// The edge that starts at the point, as [`Piece::edge`](crate::pattern::Piece::edge) counts, or as the internal
    /// line does; on an internal line of n edges point n is its end.
    pub point: usize,
}

/// Displacement of a point in each size of the run, in order; that of the base size is zero. Metres in the piece's own plane,
/// at most 1 m each way.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct GradeRule(pub Vec<DVec2>);

impl GradeRule {
    /// A rule of equal steps: `step` for each size above the base, its opposite for each below, in a run of `count` sizes.
    pub fn even(step: DVec2, count: usize, base: usize) -> Self {
        Self((0..count).map(|i| step * (i as f64 - base as f64)).collect())
    }

    /// The displacement in size number `size`; zero where the rule does not have that many sizes.
    pub fn at(&self, size: usize) -> DVec2 {
        self.0.get(size).copied().unwrap_or_default()
    }

    /// Whether the point stays where it is in all sizes.
    pub fn is_still(&self) -> bool {
        self.0.iter().all(|by| *by == DVec2::ZERO)
    }

    /// The rule with each displacement replaced by `map` of it.
    pub fn mapped(&self, map: impl Fn(DVec2) -> DVec2) -> Self {
        // Zero stays zero, not minus zero.
        Self(self.0.iter().map(|&by| map(by) + DVec2::ZERO).collect())
    }

    /// The rule relative to size number `size` in place of the base.
    pub fn from_size(&self, size: usize) -> Self {
        self.mapped(|by| by - self.at(size))
    }

    /// The rule in a run of `count` sizes of which size i was at `places[i]` of this run, or is new. New sizes go on in even
    /// steps between those beside them, or past the last two; the size `base` stays.
    pub fn in_run(&self, places: &[Option<usize>], base: usize) -> Self {
        let known: Vec<(f64, DVec2)> =
            (0..places.len()).filter_map(|i| Some((i as f64, self.at(places[i]?)))).collect();
        let at = |i: usize| {
            let x = i as f64;
            match known[..] {
                [] => DVec2::ZERO,
                [(_, only)] => only,
                _ => {
                    let right = known.partition_point(|(place, _)| *place < x).clamp(1, known.len() - 1);
                    let ((x0, one), (x1, other)) = (known[right - 1], known[right]);
                    if x == x0 { one } else { one.lerp(other, (x - x0) / (x1 - x0)) }
                }
            }
        };
        Self((0..places.len()).map(at).collect()).from_size(base)
    }

    /// The rule of the mirror image in the line x = 0.
    pub fn mirrored(&self) -> Self {
        self.mapped(|by| DVec2::new(0.0 - by.x, by.y))
    }

    /// The rule seen by the grain: x across it, y along it, for a piece whose grain is the unit vector `grain`.
    pub fn by_grain(&self, grain: DVec2) -> Self {
        self.mapped(|by| by_grain(by, grain))
    }

    /// The reverse of [`GradeRule::by_grain`].
    pub fn from_grain(&self, grain: DVec2) -> Self {
        self.mapped(|by| from_grain(by, grain))
    }

    /// The rule of a place at the share `t` of the way from a point with one rule to a point with the other; no rule
    /// counts as one that stays. None where neither point has one.
    pub fn between(one: Option<&Self>, other: Option<&Self>, t: f64) -> Option<Self> {
        let count = one.or(other)?.0.len();
        let at = |rule: Option<&Self>, size: usize| rule.map_or(DVec2::ZERO, |rule| rule.at(size));
        Some(Self((0..count).map(|size| at(one, size).lerp(at(other, size), t)).collect()))
    }

    /// What is wrong with the rule in a run of `count` sizes with this `base`, in words.
    pub fn problem(&self, count: usize, base: usize) -> Option<Words> {
        if self.0.len() != count {
            return Some(words!(
                "a rule has {n} displacements, but there are {count} sizes",
                n = self.0.len(),
                count
            ));
        }
        if self.0.iter().any(|by| !by.is_finite() || by.abs().max_element() > FARTHEST) {
            return Some(words!(
                "a rule moves its point by no number of metres within {most}",
                most = FARTHEST
            ));
        }
        (self.at(base) != DVec2::ZERO).then(|| words!("a rule moves its point in the base size"))
    }
}

/// A displacement seen by the grain: x across it (to its right), y along it.
pub fn by_grain(by: DVec2, grain: DVec2) -> DVec2 {
    DVec2::new(by.x * grain.y - by.y * grain.x, by.dot(grain))
}

/// The reverse of [`by_grain`].
pub fn from_grain(by: DVec2, grain: DVec2) -> DVec2 {
    DVec2::new(by.x * grain.y + by.y * grain.x, by.y * grain.y - by.x * grain.x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn even_steps_are_nothing_in_the_base_size() {
        let rule = GradeRule::even(DVec2::new(0.01, -0.02), 4, 1);
        assert_eq!((rule.at(0), rule.at(1)), (DVec2::new(-0.01, 0.02), DVec2::ZERO));
        assert_eq!((rule.at(3), rule.at(9)), (DVec2::new(0.02, -0.04), DVec2::ZERO));
        assert_eq!(rule.problem(4, 1), None);
        for (told, words) in [
            (rule.problem(5, 1), "4 displacements, but there are 5"),
            (rule.problem(4, 2), "base size"),
            (GradeRule(vec![DVec2::NAN]).problem(1, 0), "no number"),
            (GradeRule(vec![DVec2::ZERO, DVec2::splat(2.0)]).problem(2, 0), "within 1"),
        ] {
            assert!(told.as_ref().is_some_and(|told| told.contains(words)), "{told:?}");
        }
    }

    #[test]
    fn the_grain_turns_a_rule_and_back() {
        let by = DVec2::new(0.03, 0.01);
        assert_eq!(by_grain(by, DVec2::Y), by);
        assert_eq!(by_grain(by, DVec2::X), DVec2::new(-0.01, 0.03), "y is along the grain");
        let grain = DVec2::from_angle(0.7);
        let rule = GradeRule(vec![by]);
        assert!(rule.by_grain(grain).from_grain(grain).at(0).distance(by) < 1e-15);
        assert_eq!(rule.mirrored().mirrored(), rule);
    }

    #[test]
    fn between_two_points_is_the_share_of_both_rules() {
        let (one, other) = (GradeRule(vec![DVec2::X, DVec2::ZERO]), GradeRule(vec![DVec2::Y, DVec2::ZERO]));
        let between = GradeRule::between(Some(&one), Some(&other), 0.25).expect("two rules");
        assert_eq!(between.at(0), DVec2::new(0.75, 0.25));
        assert_eq!(GradeRule::between(Some(&one), None, 0.5).map(|rule| rule.at(0)), Some(DVec2::X * 0.5));
        assert_eq!(GradeRule::between(None, None, 0.5), None);
    }
}
