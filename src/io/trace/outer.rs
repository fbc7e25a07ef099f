//! The outer boundary of what a closed polyline that runs over itself winds round.

use glam::DVec2;
use i_overlay::core::fill_rule::FillRule;
use i_overlay::float::simplify::SimplifyShape;

use super::contour::Contour;

/// The outer boundary of the largest part of the plane that `lines` wind round, each in its own direction. The lines are closed
/// polylines that run the same way round, and so does the boundary; it has no loops. What it encloses counts as wound round, too.
pub fn outer(lines: [Vec<DVec2>; 2]) -> Vec<DVec2> {
    let is_reversed = Contour::new(lines[1].clone()).signed_area() < 0.0;
    let turned = |mut line: Vec<DVec2>| {
        if is_reversed {
            line.reverse();
        }
        line
    };
    let lines = lines.map(|line| turned(line).into_iter().map(|p| p.to_array()).collect::<Vec<_>>());
    // The rule takes lines that run counter-clockwise as positive. In 64 bits coordinates lose nothing that matters.
    let parts = lines.to_vec().simplify_shape_as::<i64>(FillRule::Positive);
    let boundaries = parts.into_iter().filter_map(|rings| rings.into_iter().next());
    let boundaries = boundaries.map(|ring| ring.into_iter().map(DVec2::from).collect::<Vec<_>>());
    let area = |line: &Vec<DVec2>| Contour::new(line.clone()).signed_area().abs();
    turned(boundaries.max_by(|a, b| area(a).total_cmp(&area(b))).unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn loops_are_cut_off_where_the_line_crosses_itself() {
        let square = [[1.0, 1.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0]].map(DVec2::from).to_vec();
        // A larger square with a loop outside its right side that is wound the other way.
        let line =
            [[0.0, 0.0], [3.0, 0.0], [3.0, 1.0], [3.5, 2.0], [4.0, 1.0], [3.0, 1.0], [3.0, 3.0], [0.0, 3.0]];
        let line = line.map(DVec2::from).to_vec();
        for is_reversed in [false, true] {
            let turned = |mut line: Vec<DVec2>| {
                if is_reversed {
                    line.reverse();
                }
                line
            };
            let found = outer([turned(line.clone()), turned(square.clone())]);
            let area = Contour::new(found.clone()).signed_area();
            let wanted = if is_reversed { -9.0 } else { 9.0 };
            assert!((area - wanted).abs() < 1e-12, "{area} {found:?}");
            assert_eq!(found.len(), 4, "{found:?}");
        }
    }
}
