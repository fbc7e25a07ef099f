//! Edits of buttons and zips.

use crate::geometry::ids::{ButtonId, SeamId};
use crate::geometry::polygon;
use crate::geometry::words::{Words, words};
use crate::pattern::edit::{Carried, Change, find};
use crate::pattern::{Button, Pattern, PiecePoint, Zip};

/// Most buttons of a pattern.
pub const MOST_BUTTONS: usize = 1_000;

pub(super) fn add_buttons(pattern: &mut Pattern, buttons: &[Button]) -> Result<Change, Words> {
    if buttons.is_empty() {
        return Err(words!("there is no button to sew on"));
    }
    if pattern.buttons.len() + buttons.len() > MOST_BUTTONS {
        return Err(words!("a pattern may have {most} buttons", most = MOST_BUTTONS));
    }
    for button in buttons {
        check(pattern, button)?;
        pattern.add_button(*button);
    }
    Ok(Change::new(words!("sew on buttons")))
}

pub(super) fn set_button(pattern: &mut Pattern, id: ButtonId, button: &Button) -> Result<Change, Words> {
    check(pattern, button)?;
    *known(pattern, id)? = *button;
    Ok(Change::new(words!("change a button")))
}

pub(super) fn delete_buttons(pattern: &mut Pattern, buttons: &[ButtonId]) -> Result<Change, Words> {
    for &id in buttons {
        known(pattern, id)?;
        pattern.buttons.remove(&id);
    }
    Ok(Change::new(words!("take buttons off")))
}

pub(super) fn fasten(pattern: &mut Pattern, buttons: &[ButtonId], fastened: bool) -> Result<Change, Words> {
    for &id in buttons {
        known(pattern, id)?.open = !fastened;
    }
    Ok(Change::new(if fastened { words!("fasten") } else { words!("unfasten") }))
}

pub(super) fn set_zip(pattern: &mut Pattern, id: SeamId, zip: Option<Zip>) -> Result<Change, Words> {
    let seam = pattern.seams.get_mut(&id).ok_or_else(|| words!("there is no {what}", what = id))?;
    let label = match (seam.zip, zip) {
        (None, Some(_)) => words!("put in a zip"),
        (_, None) => words!("take a zip out"),
        (Some(old), Some(new)) if new.open > old.open => words!("open a zip"),
        (Some(old), Some(new)) if new.open < old.open => words!("close a zip"),
        _ => words!("change a zip"),
    };
    seam.zip = zip;
    Ok(Change::new(label))
}

/// Moves the places of buttons along with what they are on, and removes buttons of pieces that are gone.
pub(super) fn carry(pattern: &mut Pattern, carried: &[Carried]) {
    let moved = |place: &mut PiecePoint| {
        let arrives = |c: &&Carried| {
            let to = c.map.transform_point2(place.at);
            c.from == place.piece && c.inside.as_ref().is_none_or(|line| polygon::contains(line, to))
        };
        if let Some(way) = carried.iter().find(arrives) {
            *place = PiecePoint { piece: way.to, at: way.map.transform_point2(place.at) };
        }
    };
    for button in pattern.buttons.values_mut() {
        moved(&mut button.button);
        moved(&mut button.hole);
    }
    let Pattern { pieces, buttons, .. } = pattern;
    buttons.retain(|_, button| button.pieces().iter().all(|piece| pieces.contains_key(piece)));
}

fn known(pattern: &mut Pattern, id: ButtonId) -> Result<&mut Button, Words> {
    pattern.buttons.get_mut(&id).ok_or_else(|| words!("there is no {what}", what = id))
}

fn check(pattern: &Pattern, button: &Button) -> Result<(), Words> {
    for piece in button.pieces() {
        find(pattern, piece)?;
    }
    button.problem().map_or(Ok(()), Err)
}
