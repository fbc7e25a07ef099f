//! Orientation of seams, solved over the whole garment.
//!
//! Every outline runs counter-clockwise seen from its front, so that a seam joins front to front when start meets
//! end. A piece whose seams all disagree is not twisted but drawn from its back, and is turned over. Seams that still
//! disagree after that are twisted.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::geometry::ids::{PieceId, SeamId};
use crate::geometry::words::{Words, words};
use crate::pattern::edit::symmetry::loosen;
use crate::pattern::edit::{Change, mirror};
use crate::pattern::{Notch, Pattern, Piece, Seam, Stretch, curve};

/// Result of [`twists`]: pieces to turn over, and seams that even then join the front of a piece to the back of
/// another. Pieces are oriented as most of their seams say.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Twists {
    /// Pieces drawn from their backs.
    pub pieces: Vec<PieceId>,
    /// Twisted seams.
    pub seams: Vec<SeamId>,
}

/// Finds pieces drawn from their backs and twisted seams in `pattern`.
pub fn twists(pattern: &Pattern) -> Twists {
    let sides = over(pattern);
    let turned = |side: &Stretch| sides.get(&side.piece).copied().unwrap_or(false);
    let wrong = pattern
        .seams
        .iter()
        .filter(|(_, seam)| seam.same_direction != (turned(&seam.sides[0]) != turned(&seam.sides[1])));
    Twists {
        seams: wrong.map(|(&id, _)| id).collect(),
        pieces: sides.iter().filter(|(_, over)| **over).map(|(&id, _)| id).collect(),
    }
}

/// The value of `same_direction` for which a seam between these sides is not twisted.
pub fn untwisted(pattern: &Pattern, sides: &[Stretch; 2]) -> bool {
    let over = over(pattern);
    let turned = |side: &Stretch| over.get(&side.piece).copied().unwrap_or(false);
    turned(&sides[0]) != turned(&sides[1])
}

/// The length of a seam's first side, metres, and the seam.
type Measured<'a> = (f64, &'a Seam);

/// For each piece whether it is drawn from its back. Two starting points are improved, the pieces as they are drawn and
/// those turned by a forest of the longest seams; the result with fewer twisted seams is taken, on a tie the first.
fn over(pattern: &Pattern) -> BTreeMap<PieceId, bool> {
    let length = |side: &Stretch| pattern.pieces.get(&side.piece).and_then(|p| side.length(p)).unwrap_or(0.0);
    let mut seams: Vec<Measured<'_>> =
        pattern.seams.values().map(|seam| (length(&seam.sides[0]), seam)).collect();
    seams.sort_by(|a, b| b.0.total_cmp(&a.0));
    let as_drawn = pattern.pieces.keys().map(|&id| (id, false)).collect();
    let [drawn, believed] = [as_drawn, by_forest(pattern, &seams)].map(|start| improved(start, &seams));
    let crossed = |over: &BTreeMap<PieceId, bool>| seams.iter().filter(|(_, s)| is_crossed(over, s)).count();
    if crossed(&believed) < crossed(&drawn) { believed } else { drawn }
}

fn is_crossed(over: &BTreeMap<PieceId, bool>, seam: &Seam) -> bool {
    let turned = |k: usize| over.get(&seam.sides[k].piece).copied().unwrap_or(false);
    (turned(0) != turned(1)) != seam.same_direction
}

/// Orients pieces by a spanning forest of the longest seams; of each sewn component the smaller group is turned.
fn by_forest(pattern: &Pattern, seams: &[Measured<'_>]) -> BTreeMap<PieceId, bool> {
    // Each piece knows its root and whether it faces the same way as the root (union-find).
    let mut root: BTreeMap<PieceId, (PieceId, bool)> =
        pattern.pieces.keys().map(|&id| (id, (id, false))).collect();
    for (_, seam) in seams {
        let [Some(&(a, over_a)), Some(&(b, over_b))] = [0, 1].map(|k| root.get(&seam.sides[k].piece)) else {
            continue;
        };
        if a != b {
            let flip = (over_a != over_b) != seam.same_direction;
            for of in root.values_mut().filter(|of| of.0 == b) {
                *of = (a, of.1 != flip);
            }
        }
    }
    let mut count: BTreeMap<PieceId, [usize; 2]> = BTreeMap::new();
    for &(of, over) in root.values() {
        count.entry(of).or_default()[usize::from(over)] += 1;
    }
    root.into_iter().map(|(id, (of, over))| (id, over != (count[&of][1] > count[&of][0]))).collect()
}

/// Turns pieces over, one at a time, while that leaves fewer seams twisted.
fn improved(mut over: BTreeMap<PieceId, bool>, seams: &[Measured<'_>]) -> BTreeMap<PieceId, bool> {
    for _ in 0..over.len() {
        let mut doubt: BTreeMap<PieceId, i64> = BTreeMap::new();
        for (_, seam) in seams {
            let [a, b] = [0, 1].map(|k| seam.sides[k].piece);
            if a != b {
                let weight = if is_crossed(&over, seam) { 1 } else { -1 };
                *doubt.entry(a).or_default() += weight;
                *doubt.entry(b).or_default() += weight;
            }
        }
        let most = doubt.into_iter().max_by_key(|&(piece, doubt)| (doubt, std::cmp::Reverse(piece)));
        match most.filter(|(_, doubt)| *doubt > 0).and_then(|(piece, _)| over.get_mut(&piece)) {
            Some(turned) => *turned = !*turned,
            None => break,
        }
    }
    over
}

pub(super) fn untwist_all(pattern: &mut Pattern) -> Result<Change, Words> {
    let found = twists(pattern);
    if found == Twists::default() {
        return Err(words!("no seam is twisted"));
    }
    for id in &found.seams {
        if let Some(seam) = pattern.seams.get_mut(id) {
            seam.same_direction = !seam.same_direction;
        }
    }
    for &id in &found.pieces {
        turn_over(pattern, id);
    }
    Ok(Change::new(words!("untwist the seams")))
}

/// Turns a piece over: its back becomes its front. Seams still join the same points.
fn turn_over(pattern: &mut Pattern, id: PieceId) {
    loosen(pattern, id);
    let Some(old) = pattern.pieces.get(&id).cloned() else { return };
    let mut new = Piece::clone(&old);
    new.outline = curve::reversed(&old.outline);
    new.holes = old.holes.iter().map(|hole| curve::reversed(hole)).collect();
    let image = |n: &Notch| Notch { edge: mirror::image_edge(&old, n.edge), at: 1.0 - n.at };
    new.notches = old.notches.iter().map(image).collect();
    for seam in pattern.seams.values_mut() {
        for side in seam.sides.iter_mut().filter(|side| side.piece == id) {
            let last = (0..side.further).fold(side.edge, |edge, _| old.next_edge(edge));
            *side = Stretch {
                edge: mirror::image_edge(&old, last),
                from: 1.0 - side.to,
                to: 1.0 - side.from,
                ..*side
            };
            seam.same_direction = !seam.same_direction;
        }
    }
    pattern.pieces.insert(id, Arc::new(new));
}
