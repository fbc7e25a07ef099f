//! How fine the mesh of a piece must be: a narrow part that is folded over needs several rows of triangles.

use glam::DVec2;

use crate::geometry::polygon::sides;
use crate::pattern::{EdgeShape, Fold, Piece, curve};

/// Range of the mesh size that a piece may ask for, metres.
pub const MESH_SIZES: std::ops::RangeInclusive<f64> = 0.003..=0.1;
/// Rows of triangles across a part that is folded over. With one row it has no points but those of its two borders, and passes
/// through the cloth under it in between. More rows turn over less surely while they are sewn.
const ROWS: f64 = 2.0;
/// Least edge length that a fold asks for, metres.
const FINEST: f64 = 0.004;
/// Share of a piece that must be folded over for the whole piece to be meshed finer.
const WORTH: f64 = 0.25;
/// Places along a fold at which the width beside it is measured.
const PLACES: usize = 5;
/// Tolerance with which outlines and lines are flattened to chords where they are only measured, metres.
pub const CHORDS: f64 = 1e-3;

/// The length of the edges of the mesh of `piece`, metres: `edge_length`, or less where the piece asks for it or a narrow part is folded
/// over.
pub fn edge_length_of(piece: &Piece, edge_length: f64) -> f64 {
    let edge_length = piece.mesh_size.map_or(edge_length, |own| own.min(edge_length));
    let outline = (0..piece.edge_count()).filter(|&i| turns_over(piece.edge(i).trims.fold)).map(|i| {
        let (from, to) = piece.edge_ends(i);
        (from, piece.edge(i).shape, to)
    });
    let lines = piece.lines.iter().flat_map(|line| {
        let creased = (0..line.edges.len()).filter(|&i| turns_over(line.edges[i].trims.fold));
        creased.map(|i| (line.edges[i].start, line.edges[i].shape, line.edge_end(i)))
    });
    let mut folds = outline.chain(lines).peekable();
    if folds.peek().is_none() {
        return edge_length;
    }
    let outline = piece.flattened(CHORDS);
    let (mut narrowest, mut folded) = (f64::INFINITY, 0.0);
    for (from, shape, to) in folds {
        if let Some(width) = width_beside(&outline, &fold_places(from, shape, to)) {
            narrowest = narrowest.min(width);
            folded += width * curve::exact_length(from, shape, to);
        }
    }
    let is_worth = folded >= WORTH * piece.signed_area().abs();
    if is_worth { edge_length.min((narrowest / ROWS).max(FINEST)) } else { edge_length }
}

fn turns_over(fold: Option<Fold>) -> bool {
    fold.is_some_and(|fold| fold.turns_over())
}

/// Places in the middle of equal parts of a fold, each with the unit vector along it.
fn fold_places(from: DVec2, shape: EdgeShape, to: DVec2) -> Vec<(DVec2, DVec2)> {
    let fractions: Vec<f64> = (0..=2 * PLACES).map(|k| k as f64 / (2 * PLACES) as f64).collect();
    let mut points = curve::points(from, shape, to, &fractions[..2 * PLACES]);
    points.push(to);
    let place = |k: usize| (points[2 * k + 1], (points[2 * k + 2] - points[2 * k]).normalize_or_zero());
    (0..PLACES).map(place).collect()
}

/// Width of the cloth beside a fold, metres: the median over its places, on the narrower side. None where there is no cloth.
fn width_beside(outline: &[DVec2], places: &[(DVec2, DVec2)]) -> Option<f64> {
    let of_side = |sign: f64| {
        let mut widths: Vec<f64> =
            places.iter().filter_map(|&(p, along)| way_out(outline, p, along.perp() * sign)).collect();
        widths.sort_by(f64::total_cmp);
        widths.get(widths.len() / 2).copied()
    };
    of_side(1.0).into_iter().chain(of_side(-1.0)).min_by(f64::total_cmp)
}

/// Distance from `p` along the unit vector `way` to the outline, where the cloth is on that side, metres.
fn way_out(outline: &[DVec2], p: DVec2, way: DVec2) -> Option<f64> {
    let met: Vec<f64> = sides(outline)
        .filter_map(|[a, b]| {
            let turn = way.perp_dot(b - a);
            let share = (a - p).perp_dot(way) / turn;
            let far = (a - p).perp_dot(b - a) / turn;
            ((0.0..1.0).contains(&share) && far > CHORDS * 2.0).then_some(far)
        })
        .collect();
    (met.len() % 2 == 1).then(|| met.into_iter().fold(f64::INFINITY, f64::min))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::{Edge, InternalLine, Trims};

    fn strip(width: f64, folded: Option<f64>) -> Piece {
        let points = [(0.0, 0.0), (0.4, 0.0), (0.4, width), (0.0, width)].map(|(x, y)| DVec2::new(x, y));
        let mut piece = Piece::polygon("strip", &points);
        piece.outline[0].trims.fold = folded.map(Fold::pressed);
        piece
    }

    #[test]
    fn a_strip_that_turns_over_has_two_rows_of_triangles() {
        assert!((edge_length_of(&strip(0.03, Some(3.0)), 0.03) - 0.015).abs() < 1e-12);
        assert!((edge_length_of(&strip(0.03, Some(-3.0)), 0.03) - 0.015).abs() < 1e-12);
        assert_eq!(edge_length_of(&strip(0.03, Some(1.0)), 0.03), 0.03, "it does not turn over");
        assert_eq!(edge_length_of(&strip(0.03, None), 0.03), 0.03, "nor does this");
        assert_eq!(edge_length_of(&strip(0.12, Some(3.0)), 0.03), 0.03, "wide enough");
        assert_eq!(edge_length_of(&strip(0.006, Some(3.0)), 0.03), FINEST);
        // As where several pieces are sewn to it.
        let mut cut = strip(0.03, Some(3.0));
        let of_fold = cut.outline[0].clone();
        let parts = (1..8).map(|k| Edge { start: DVec2::new(0.05 * f64::from(k), 0.0), ..of_fold.clone() });
        cut.outline.splice(1..1, parts);
        assert!((edge_length_of(&cut, 0.03) - 0.015).abs() < 1e-12);
    }

    #[test]
    fn a_piece_may_ask_for_a_finer_mesh_but_for_no_coarser_one() {
        let asks = |size: f64| Piece { mesh_size: Some(size), ..strip(0.12, None) };
        assert_eq!([0.01, 0.05].map(|size| edge_length_of(&asks(size), 0.03)), [0.01, 0.03]);
        let folded = Piece { mesh_size: Some(0.02), ..strip(0.03, Some(3.0)) };
        assert!((edge_length_of(&folded, 0.03) - 0.015).abs() < 1e-12, "the fold asks for less");
    }

    #[test]
    fn a_fold_inside_a_piece_counts_where_much_of_the_piece_turns_over() {
        let folded = |width: f64, at: f64| {
            let trims = Trims::from(Fold::pressed(3.0));
            let edge = Edge { start: DVec2::new(0.0, at), trims, ..Edge::default() };
            let line =
                InternalLine { edges: vec![edge], end: DVec2::new(0.4, at), ..InternalLine::default() };
            Piece { lines: vec![line], ..strip(width, None) }
        };
        assert!((edge_length_of(&folded(0.09, 0.06), 0.03) - 0.015).abs() < 1e-12);
        assert_eq!(edge_length_of(&folded(0.9, 0.87), 0.03), 0.03);
    }
}
