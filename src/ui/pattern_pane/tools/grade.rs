//! Moving points in a size other than the base: changes their grade rules.

use glam::DVec2;

use crate::pattern::edit::PatternEdit;
use crate::pattern::{GradeRule, RulePoint};
use crate::ui::language::say;
use crate::ui::pattern_pane::table::Table;

/// The rules that move `points` of size number `size` by `by` on the table. With `even` all other sizes move in proportion to
/// their distance from the base.
pub(super) fn moved(
    table: &Table<'_>,
    size: usize,
    points: &[(RulePoint, DVec2)],
    by: DVec2,
    even: bool,
) -> Option<PatternEdit> {
    let sizes = &table.pattern().sizes;
    let rule = |&(point, p): &(RulePoint, DVec2)| {
        let piece = table.pattern().pieces.get(&point.piece)?;
        let GradeRule(mut own) = table.nests.rule(point)?;
        let moved = piece.pose.piece_from_plane(p + by) - piece.place_of(&point)?;
        if even {
            let steps = size as f64 - sizes.base as f64;
            own = GradeRule::even(moved / steps, sizes.len(), sizes.base).0;
        }
        *own.get_mut(size)? = moved;
        Some((point, Some(GradeRule(own))))
    };
    let rules: Vec<_> = points.iter().filter_map(rule).collect();
    (!rules.is_empty()).then_some(PatternEdit::SetRules { rules })
}

/// How far the first of `points` is from its place in the base size.
pub(super) fn readout(table: &Table<'_>, size: usize, points: &[(RulePoint, DVec2)], by: DVec2) -> String {
    let Some((point, p)) = points.first() else { return String::new() };
    let Some(piece) = table.pattern().pieces.get(&point.piece) else { return String::new() };
    let Some(base) = piece.place_of(point) else { return String::new() };
    let seen =
        crate::pattern::grading::rule::by_grain(piece.pose.piece_from_plane(*p + by) - base, piece.grain());
    let unit = table.laid.unit;
    let name = table.pattern().sizes.names.get(size).map_or("", String::as_str);
    let (across, along) = (unit.number(seen.x), unit.text(seen.y));
    say!("{name}: across {across}, along {along}", name, across, along)
}
