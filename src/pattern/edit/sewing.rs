//! Edits of seams.

use std::collections::BTreeSet;

use crate::geometry::ids::SeamId;
use crate::geometry::words::{Words, words};
use crate::pattern::edit::mirror::image_seam;
use crate::pattern::edit::{Change, PatternEdit, find};
use crate::pattern::{Pattern, Seam, Stretch};

/// Length by which two stretches of one edge may overlap, metres.
const TOUCHING: f64 = 1e-6;
/// Fraction of an edge within which ends of stretches count as one place.
const SAME_PLACE: f64 = 1e-9;
/// Range of the length ratio of a seam.
pub const RATIOS: std::ops::RangeInclusive<f64> = 0.01..=100.0;

pub(super) fn sew(pattern: &mut Pattern, seam: Seam) -> Result<Change, Words> {
    fits(pattern, &seam)?;
    let names: Vec<String> = seam.sides.iter().map(|side| pattern.pieces[&side.piece].name.clone()).collect();
    let held = held(pattern, &seam.sides[0]);
    pattern.add_seam(seam);
    Ok(Change { held, ..Change::new(words!("sew {one} to {other}", one = names[0], other = names[1])) })
}

/// The edit of seams that does the same to the mirror images, on twins and symmetric halves. None where there are none, or
/// where the image cannot be sewn because its place is taken. `before` and `after` are the pattern without and with `edit`.
pub(super) fn for_images(before: &Pattern, after: &Pattern, edit: &PatternEdit) -> Option<PatternEdit> {
    let image = |id: &SeamId| {
        let image = image_seam(before, before.seams.get(id)?)?;
        let found = before.seams.iter().find(|(_, seam)| is_same(seam, &image));
        found.map(|(&other, _)| other).filter(|other| other != id)
    };
    Some(match edit {
        PatternEdit::Sew { seam } => {
            let seam = image_seam(after, seam)?;
            fits(after, &seam).ok()?;
            PatternEdit::Sew { seam }
        }
        PatternEdit::Unpick { seams } => {
            let images: BTreeSet<SeamId> = seams.iter().filter_map(image).collect();
            let seams: Vec<SeamId> = images.into_iter().filter(|id| !seams.contains(id)).collect();
            if seams.is_empty() {
                return None;
            }
            PatternEdit::Unpick { seams }
        }
        PatternEdit::TurnSeam { seam } => PatternEdit::TurnSeam { seam: image(seam)? },
        PatternEdit::SetRatio { seam, ratio } => {
            let id = image(seam)?;
            let drawn = image_seam(before, before.seams.get(seam)?)?;
            let is_turned = !near(&drawn.sides[0], &before.seams.get(&id)?.sides[0]);
            let ratio = if is_turned { ratio.map(f64::recip) } else { *ratio };
            PatternEdit::SetRatio { seam: id, ratio }
        }
        _ => return None,
    })
}

/// Whether two seams join the same stretches in the same direction; the order of the sides does not matter.
fn is_same(one: &Seam, other: &Seam) -> bool {
    let [a, b] = &one.sides;
    let [c, d] = &other.sides;
    one.same_direction == other.same_direction && (near(a, c) && near(b, d) || near(a, d) && near(b, c))
}

fn near(a: &Stretch, b: &Stretch) -> bool {
    let fractions = (a.from - b.from).abs().max((a.to - b.to).abs());
    a.piece == b.piece && a.edge == b.edge && a.further == b.further && fractions < SAME_PLACE
}

/// Checks that the stretches of a seam exist and are free.
pub(super) fn fits(pattern: &Pattern, seam: &Seam) -> Result<(), Words> {
    sound(pattern, seam)?;
    if overlap(pattern, &seam.sides[0], &seam.sides[1]).is_some() {
        return Err(words!("an edge cannot be sewn to itself"));
    }
    for side in seam.sides {
        let others = pattern.seams.values().flat_map(|s| &s.sides);
        if let Some(edge) = others.filter_map(|other| overlap(pattern, &side, other)).next() {
            return Err(words!(
                "edge {n} of {name} is sewn already",
                n = edge + 1,
                name = pattern.pieces[&side.piece].name
            ));
        }
    }
    Ok(())
}

/// Checks that the stretches of a seam exist and that its ratio is valid.
pub fn sound(pattern: &Pattern, seam: &Seam) -> Result<(), Words> {
    for side in &seam.sides {
        let piece = find(pattern, side.piece)?;
        if side.edge >= piece.edge_count() {
            return Err(words!("{name} has no edge {n}", name = piece.name, n = side.edge.saturating_add(1)));
        }
        if side.parts(piece).is_none() {
            return Err(words!("there is no such stretch on {name}", name = piece.name));
        }
    }
    match seam.ratio {
        Some(ratio) if !RATIOS.contains(&ratio) => Err(words!(
            "one side of a seam is {least} to {most} times the other",
            least = RATIOS.start(),
            most = RATIOS.end()
        )),
        _ => Ok(()),
    }
}

/// The number of an edge that both stretches cover in part, if any.
fn overlap(pattern: &Pattern, one: &Stretch, other: &Stretch) -> Option<usize> {
    if one.piece != other.piece {
        return None;
    }
    let piece = pattern.pieces.get(&one.piece)?;
    let (parts, others) = (one.parts(piece)?, other.parts(piece)?);
    let both = |(edge, from, to): &(usize, f64, f64)| {
        let length = piece.edge_length(*edge);
        others.iter().any(|(e, f, t)| e == edge && (to.min(*t) - from.max(*f)) * length > TOUCHING)
    };
    parts.iter().find(|part| both(part)).map(|part| part.0)
}

/// The points of a side, which are held while the other side adapts.
fn held(pattern: &Pattern, side: &Stretch) -> BTreeSet<crate::pattern::EdgeRef> {
    let Some(piece) = pattern.pieces.get(&side.piece) else { return Default::default() };
    let parts = side.parts(piece).unwrap_or_default();
    let points = parts.iter().flat_map(|part| [part.0, piece.next_edge(part.0)]);
    points.map(|edge| crate::pattern::EdgeRef { piece: side.piece, edge }).collect()
}

pub(super) fn unpick(pattern: &mut Pattern, seams: &[SeamId]) -> Result<Change, Words> {
    for seam in seams {
        pattern.seams.remove(seam).ok_or_else(|| words!("there is no {what}", what = seam))?;
    }
    Ok(Change::new(match seams {
        [one] => words!("unpick seam {n}", n = one.0),
        _ => words!("unpick {n} seams", n = seams.len()),
    }))
}

pub(super) fn turn(pattern: &mut Pattern, id: SeamId) -> Result<Change, Words> {
    let seam = pattern.seams.get_mut(&id).ok_or_else(|| words!("there is no {what}", what = id))?;
    seam.same_direction = !seam.same_direction;
    Ok(Change::new(words!("turn seam {n} round", n = id.0)))
}

pub(super) fn set_ratio(pattern: &mut Pattern, id: SeamId, ratio: Option<f64>) -> Result<Change, Words> {
    let seam = *pattern.seams.get(&id).ok_or_else(|| words!("there is no {what}", what = id))?;
    let new = Seam { ratio, ..seam };
    sound(pattern, &new)?;
    let held = held(pattern, &seam.sides[0]);
    pattern.seams.insert(id, new);
    Ok(Change { held, ..Change::new(words!("change the gather of seam {n}", n = id.0)) })
}
