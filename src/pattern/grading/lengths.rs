//! Lengths of seams in the sizes of a pattern: sides that were drawn to fit must fit in every size.

use crate::geometry::ids::SeamId;
use crate::pattern::grading::apply::Graded;
use crate::pattern::{Pattern, Seam};

/// Change of the difference between a seam's sides from which it is told, metres.
const APART: f64 = 1e-3;

/// A seam whose sides grow apart in one size.
#[derive(Clone, Debug, PartialEq)]
pub struct SeamGrowth {
    /// The seam.
    pub seam: SeamId,
    /// Name of the size.
    pub size: String,
    /// The excess of the first side over the second, compared with that in the base size, metres.
    pub change: f64,
}

/// The seams of `pattern` whose sides grow apart by more than a millimetre in the size called `size`, in which it is `graded`. Seams
/// on edges that are not there are left out.
pub fn growth_in(pattern: &Pattern, graded: &Graded, size: &str) -> Vec<SeamGrowth> {
    let of = |(&seam, sides): (&SeamId, &Seam)| {
        let excess = |pattern| lengths(pattern, sides).map(|[one, other]| one - other);
        let change = excess(&graded.pattern)? - excess(pattern)?;
        (change.abs() > APART).then(|| SeamGrowth { seam, size: size.to_owned(), change })
    };
    pattern.seams.iter().filter_map(of).collect()
}

/// Lengths of the sides of `seam`, metres.
fn lengths(pattern: &Pattern, seam: &Seam) -> Option<[f64; 2]> {
    let [one, other] = seam.sides.map(|side| side.length(pattern.pieces.get(&side.piece)?));
    Some([one?, other?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::grading::{GradeRule, SizeRun, graded};
    use crate::pattern::{EdgeRef, Piece};
    use glam::DVec2;

    #[test]
    fn a_side_that_grows_alone_is_told_by_how_much() {
        let square = |rule: Option<GradeRule>| {
            let mut piece = Piece::polygon("a", &[DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y]);
            piece.outline[2].rule = rule;
            piece
        };
        let mut pattern =
            Pattern { sizes: SizeRun::new(["S", "M", "L"], "M").expect("a run"), ..Pattern::default() };
        let front = pattern.add_piece(square(Some(GradeRule::even(DVec2::new(0.0, 0.02), 3, 1))));
        let back = pattern.add_piece(square(None));
        pattern.add_seam(Seam::of_edges([front, back].map(|piece| EdgeRef { piece, edge: 1 }), false));
        let change = |size: &str| {
            let graded = graded(&pattern, size).expect("a size");
            growth_in(&pattern, &graded, size).first().map(|growth| (growth.change * 1e9).round() / 1e9)
        };
        let changes = ["S", "M", "L"].map(change);
        assert_eq!(changes, [Some(-0.02), None, Some(0.02)]);
    }
}
