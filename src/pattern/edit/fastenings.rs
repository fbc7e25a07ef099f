//! Edits of buttons and zips.

use crate::geometry::ids::{ButtonId, SeamId};
use crate::geometry::polygon;
use crate::pattern::edit::{Carried, Change, find};
use crate::pattern::{Button, Pattern, PiecePoint, Zip};

/// Most buttons of a pattern.
pub const MOST_BUTTONS: usize = 1_000;

pub(super) fn add_buttons(pattern: &mut Pattern, buttons: &[Button]) -> Result<Change, String> {
    if buttons.is_empty() {
        return Err("there is no button to sew on".to_owned());
    }
    if pattern.buttons.len() + buttons.len() > MOST_BUTTONS {
        return Err(format!("a pattern may have {MOST_BUTTONS} buttons"));
    }
    for button in buttons {
        check(pattern, button)?;
        pattern.add_button(*button);
    }
    Ok(Change::new("sew on buttons"))
}

pub(super) fn set_button(pattern: &mut Pattern, id: ButtonId, button: &Button) -> Result<Change, String> {
    check(pattern, button)?;
    *known(pattern, id)? = *button;
    Ok(Change::new("change a button"))
}

pub(super) fn delete_buttons(pattern: &mut Pattern, buttons: &[ButtonId]) -> Result<Change, String> {
    for &id in buttons {
        known(pattern, id)?;
        pattern.buttons.remove(&id);
    }
    Ok(Change::new("take buttons off"))
}

pub(super) fn fasten(pattern: &mut Pattern, buttons: &[ButtonId], fastened: bool) -> Result<Change, String> {
    for &id in buttons {
        known(pattern, id)?.open = !fastened;
    }
    Ok(Change::new(if fastened { "fasten" } else { "unfasten" }))
}

pub(super) fn set_zip(pattern: &mut Pattern, id: SeamId, zip: Option<Zip>) -> Result<Change, String> {
    let seam = pattern.seams.get_mut(&id).ok_or_else(|| format!("there is no {id}"))?;
    let label = match (seam.zip, zip) {
        (None, Some(_)) => "put in a zip",
        (_, None) => "take a zip out",
        (Some(old), Some(new)) if new.open > old.open => "open a zip",
        (Some(old), Some(new)) if new.open < old.open => "close a zip",
        _ => "change a zip",
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

fn known(pattern: &mut Pattern, id: ButtonId) -> Result<&mut Button, String> {
    pattern.buttons.get_mut(&id).ok_or_else(|| format!("there is no {id}"))
}

fn check(pattern: &Pattern, button: &Button) -> Result<(), String> {
    for piece in button.pieces() {
        find(pattern, piece)?;
    }
    button.problem().map_or(Ok(()), Err)
}
