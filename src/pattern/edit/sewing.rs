//! Seams.

use std::collections::BTreeSet;

use crate::geometry::ids::SeamId;
use crate::pattern::edit::mirror::image_seam;
use crate::pattern::edit::{Change, PatternEdit, find};
use crate::pattern::{Pattern, Seam, Stretch};

/// Two stretches of one edge may have this much in common, metres.
const TOUCHING: f64 = 1e-6;
/// Ends of stretches nearer than this fraction of their edge are one place.
const SAME_PLACE: f64 = 1e-9;
/// The ratio of a gather, at least and at most.
pub const RATIOS: std::ops::RangeInclusive<f64> = 0.01..=100.0;

pub(super) fn sew(pattern: &mut Pattern, seam: Seam) -> Result<Change, String> {
    fits(pattern, &seam)?;
    let names: Vec<String> = seam.sides.iter().map(|side| pattern.pieces[&side.piece].name.clone()).collect();
    let held = held(pattern, &seam.sides[0]);
    pattern.add_seam(seam);
    Ok(Change { held, ..Change::new(format!("sew {} to {}", names[0], names[1])) })
}

/// What an edit of seams does to their images on twins and symmetric halves; nothing where there are none, or where the
/// image cannot be sewn because something else is there. `before`: without the edit; `after`: with it.
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

/// Whether two seams join the same, the same way round; which side comes first does not matter.
fn is_same(one: &Seam, other: &Seam) -> bool {
    let [a, b] = &one.sides;
    let [c, d] = &other.sides;
    one.same_direction == other.same_direction && (near(a, c) && near(b, d) || near(a, d) && near(b, c))
}

fn near(a: &Stretch, b: &Stretch) -> bool {
    let fractions = (a.from - b.from).abs().max((a.to - b.to).abs());
    a.piece == b.piece && a.edge == b.edge && a.further == b.further && fractions < SAME_PLACE
}

/// That a seam joins what is there and free.
pub(super) fn fits(pattern: &Pattern, seam: &Seam) -> Result<(), String> {
    sound(pattern, seam)?;
    if overlap(pattern, &seam.sides[0], &seam.sides[1]).is_some() {
        return Err("an edge cannot be sewn to itself".to_owned());
    }
    for side in seam.sides {
        let others = pattern.seams.values().flat_map(|s| &s.sides);
        if let Some(edge) = others.filter_map(|other| overlap(pattern, &side, other)).next() {
            return Err(format!("edge {} of {} is sewn already", edge + 1, pattern.pieces[&side.piece].name));
        }
    }
    Ok(())
}

/// That a seam joins what is there, and keeps a ratio that can be.
pub fn sound(pattern: &Pattern, seam: &Seam) -> Result<(), String> {
    for side in &seam.sides {
        let piece = find(pattern, side.piece)?;
        if side.edge >= piece.edge_count() {
            return Err(format!("{} has no edge {}", piece.name, side.edge.saturating_add(1)));
        }
        if side.parts(piece).is_none() {
            return Err(format!("there is no such stretch on {}", piece.name));
        }
    }
    match seam.ratio {
        Some(ratio) if !RATIOS.contains(&ratio) => {
            Err(format!("one side of a seam is {} to {} times the other", RATIOS.start(), RATIOS.end()))
        }
        _ => Ok(()),
    }
}

/// An edge that both stretches run over in part.
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

/// The points of a side: they stay when the other side must follow.
fn held(pattern: &Pattern, side: &Stretch) -> BTreeSet<crate::pattern::EdgeRef> {
    let Some(piece) = pattern.pieces.get(&side.piece) else { return Default::default() };
    let parts = side.parts(piece).unwrap_or_default();
    let points = parts.iter().flat_map(|part| [part.0, piece.next_edge(part.0)]);
    points.map(|edge| crate::pattern::EdgeRef { piece: side.piece, edge }).collect()
}

pub(super) fn unpick(pattern: &mut Pattern, seams: &[SeamId]) -> Result<Change, String> {
    for seam in seams {
        pattern.seams.remove(seam).ok_or_else(|| format!("there is no {seam}"))?;
    }
    Ok(Change::new(match seams {
        [one] => format!("unpick {one}"),
        _ => format!("unpick {} seams", seams.len()),
    }))
}

pub(super) fn turn(pattern: &mut Pattern, id: SeamId) -> Result<Change, String> {
    let seam = pattern.seams.get_mut(&id).ok_or_else(|| format!("there is no {id}"))?;
    seam.same_direction = !seam.same_direction;
    Ok(Change::new(format!("turn {id} round")))
}

pub(super) fn set_ratio(pattern: &mut Pattern, id: SeamId, ratio: Option<f64>) -> Result<Change, String> {
    let seam = *pattern.seams.get(&id).ok_or_else(|| format!("there is no {id}"))?;
    let new = Seam { ratio, ..seam };
    sound(pattern, &new)?;
    let held = held(pattern, &seam.sides[0]);
    pattern.seams.insert(id, new);
    Ok(Change { held, ..Change::new(format!("change the gather of {id}")) })
}
