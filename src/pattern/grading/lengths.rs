//! Lengths of seams in the sizes of a pattern: sides that were drawn to fit must fit in every size.

use crate::geometry::ids::SeamId;
use crate::pattern::grading::apply::{Graded, graded};
use crate::pattern::{Pattern, Seam};

/// The two sides of a seam in one size.
#[derive(Clone, Debug, PartialEq)]
pub struct SeamGrowth {
    /// The seam.
    pub seam: SeamId,
    /// Name of the size.
    pub size: String,
    /// Lengths of its sides in that size, metres.
    pub lengths: [f64; 2],
    /// The excess of the first side over the second, compared with that in the base size, metres.
    pub change: f64,
}

/// The sides of every seam in every size, by size, then by seam. Seams on edges that are not there are left out.
pub fn seam_growth(pattern: &Pattern) -> Vec<SeamGrowth> {
    let mut all = Vec::new();
    for size in &pattern.sizes.names {
        let Ok(graded) = graded(pattern, size) else { continue };
        all.extend(growth_in(pattern, &graded, size));
    }
    all
}

/// The sides of every seam of `pattern` in the size called `size`, in which it is `graded`.
pub fn growth_in(pattern: &Pattern, graded: &Graded, size: &str) -> Vec<SeamGrowth> {
    let of = |(&seam, sides): (&SeamId, &Seam)| {
        let (base, lengths) = (lengths(pattern, sides)?, lengths(&graded.pattern, sides)?);
        let change = (lengths[0] - lengths[1]) - (base[0] - base[1]);
        Some(SeamGrowth { seam, size: size.to_owned(), lengths, change })
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
    use crate::pattern::grading::{GradeRule, SizeRun};
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
        let changes: Vec<(String, f64)> =
            seam_growth(&pattern).into_iter().map(|g| (g.size, (g.change * 1e9).round() / 1e9)).collect();
        assert_eq!(changes, [("S".to_owned(), -0.02), ("M".to_owned(), 0.0), ("L".to_owned(), 0.02)]);
    }
}
