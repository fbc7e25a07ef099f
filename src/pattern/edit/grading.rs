//! Edits of size runs and grade rules.

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::DVec2;

use crate::geometry::words::{Words, words};
use crate::pattern::edit::lines::previous;
use crate::pattern::edit::{Change, find, mirror, points};
use crate::pattern::{GradeRule, Pattern, Piece, RulePoint, SizeRun};

pub(super) fn set_sizes(pattern: &mut Pattern, sizes: &SizeRun) -> Result<Change, Words> {
    if let Some(words) = sizes.problem() {
        return Err(words);
    }
    let old = std::mem::replace(&mut pattern.sizes, sizes.clone());
    for piece in pattern.pieces.values_mut() {
        take_run(piece, &old, sizes);
    }
    Ok(Change::new(if sizes.is_empty() { words!("remove the sizes") } else { words!("set the sizes") }))
}

/// For each size of `new` its number in `old`: that of the same name; where no name is in both but that of the base, the one
/// as far from the base.
fn places(old: &SizeRun, new: &SizeRun) -> Vec<Option<usize>> {
    let named = |name: &String| old.names.iter().position(|known| known == name);
    let by_name: Vec<Option<usize>> = new.names.iter().map(named).collect();
    if by_name.iter().flatten().count() > 1 {
        return by_name;
    }
    let place = |i: usize| (i + old.base).checked_sub(new.base).filter(|place| *place < old.len());
    (0..new.len()).map(place).collect()
}

pub(super) fn set_rules(
    pattern: &mut Pattern,
    rules: &[(RulePoint, Option<GradeRule>)],
) -> Result<Change, Words> {
    if rules.is_empty() {
        return Err(words!("no point was named"));
    }
    let SizeRun { names, base } = &pattern.sizes;
    let (count, base) = (names.len(), *base);
    if count == 0 && rules.iter().any(|(_, rule)| rule.is_some()) {
        return Err(words!("the pattern has no sizes: choose a size run first"));
    }
    if let Some(words) = rules.iter().find_map(|(_, rule)| rule.as_ref()?.problem(count, base)) {
        return Err(words);
    }
    for (at, rule) in rules {
        let piece = find(pattern, at.piece)?;
        if piece.place_of(at).is_none() {
            let number = at.point.saturating_add(1);
            return Err(words!(
                "{name} has no point {n} that could have a rule",
                name = piece.name,
                n = number
            ));
        }
        let image = match at.line {
            None => symmetric_image(piece, at.point),
            Some(_) => None,
        };
        if let Some(piece) = pattern.pieces.get_mut(&at.piece) {
            let piece = Arc::make_mut(piece);
            *rule_mut(piece, at) = rule.clone();
            if let Some(point) = image {
                *rule_mut(piece, &RulePoint { point, ..*at }) = rule.as_ref().map(GradeRule::mirrored);
            }
        }
    }
    let clears = rules.iter().all(|(_, rule)| rule.is_none());
    let n = rules.iter().map(|(at, _)| at).collect::<BTreeSet<_>>().len();
    Ok(Change::new(match (clears, n) {
        (true, 1) => words!("clear a rule"),
        (true, _) => words!("clear {n} rules", n),
        (false, 1) => words!("set a rule"),
        (false, _) => words!("set {n} rules", n),
    }))
}

/// The mirror image of a point of a symmetric piece's outline, where that is another.
fn symmetric_image(piece: &Piece, point: usize) -> Option<usize> {
    let n = piece.outline.len();
    let is_beside = piece.symmetric && point > 0 && point < n && point != n / 2;
    is_beside.then(|| n - point)
}

/// The rule of a point that is there.
fn rule_mut<'p>(piece: &'p mut Piece, at: &RulePoint) -> &'p mut Option<GradeRule> {
    match at.line {
        None => &mut points::shape_mut(piece, at.point).rule,
        Some(line) => {
            let line = &mut piece.lines[line];
            match line.edges.get_mut(at.point) {
                Some(edge) => &mut edge.rule,
                None => &mut line.end_rule,
            }
        }
    }
}

/// The rules of a piece: of its closed lines, then of its internal lines.
pub(in crate::pattern) fn rules_of(piece: &mut Piece) -> impl Iterator<Item = &mut GradeRule> {
    slots_of(piece).flatten()
}

fn slots_of(piece: &mut Piece) -> impl Iterator<Item = &mut Option<GradeRule>> {
    let Piece { outline, holes, lines, .. } = piece;
    let closed = outline.iter_mut().chain(holes.iter_mut().flatten()).map(|edge| &mut edge.rule);
    let open = lines.iter_mut().flat_map(|line| {
        let ends = [&mut line.end_rule];
        line.edges.iter_mut().map(|edge| &mut edge.rule).chain(ends)
    });
    closed.chain(open)
}

fn has_rules(piece: &Piece) -> bool {
    piece.loops().flatten().any(|edge| edge.rule.is_some())
        || piece
            .lines
            .iter()
            .any(|line| line.end_rule.is_some() || line.edges.iter().any(|e| e.rule.is_some()))
}

/// Removes all rules of a piece.
pub(in crate::pattern) fn clear_rules(piece: &mut Piece) {
    slots_of(piece).for_each(|rule| *rule = None);
}

/// Removes the rules of a piece that do not fit a run of sizes.
pub(super) fn drop_foreign(piece: &mut Piece, sizes: &SizeRun) {
    for rule in slots_of(piece) {
        if rule.as_ref().is_some_and(|rule| rule.problem(sizes.len(), sizes.base).is_some()) {
            *rule = None;
        }
    }
}

/// Makes the rules of a piece that is drawn for sizes `of` fit the sizes `to`: by name, or by distance from the base.
pub(in crate::pattern) fn take_run(piece: &mut Arc<Piece>, of: &SizeRun, to: &SizeRun) {
    if of == to || !has_rules(piece) {
        return;
    }
    let piece = Arc::make_mut(piece);
    match to.is_empty() {
        true => clear_rules(piece),
        false => {
            let places = places(of, to);
            rules_of(piece).for_each(|rule| *rule = rule.in_run(&places, to.base));
        }
    }
}

/// The piece with the points of its closed lines at `places`, as where they are moved by hand: curves turn and scale with
/// their chords, smooth points stay smooth, and a symmetric outline symmetric. Its cutting line is left as it was.
pub(in crate::pattern) fn put(piece: &Piece, places: &[DVec2]) -> Piece {
    let mut new = piece.clone();
    points::put_all(&mut new, places);
    points::smooth_piece(&mut new);
    if new.symmetric {
        mirror::mend_symmetry(&mut new);
    }
    new
}

/// Unit tangents of the line at point `i`: arriving and leaving.
pub(in crate::pattern) fn tangents_at(piece: &Piece, i: usize) -> [DVec2; 2] {
    [points::tangents(piece, previous(piece, i))[1], points::tangents(piece, i)[0]]
}

#[cfg(test)]
#[path = "grading_tests.rs"]
mod tests;
