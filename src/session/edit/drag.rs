//! Commands for pushpins and dragging.

use std::sync::Arc;

use glam::DVec2;

use crate::drag::{DragMode, Ray};
use crate::geometry::ids::{PieceId, PinId};
use crate::geometry::words::words;
use crate::session::command::Rejection;
use crate::session::document::{Document, Pin};
use crate::session::edit::{ClothChange, Edit, checks};
use crate::sim::ClothPlace;

/// Most pins of a garment.
const MOST_PINS: usize = 1000;

pub fn add_pin(mut document: Document, piece: PieceId, at: DVec2) -> Result<Edit, Rejection> {
    let place = ClothPlace { piece, at };
    checks::cloth_place(&document.pattern, place)?;
    if document.pins.len() >= MOST_PINS {
        return Err(Rejection(words!("a garment may have {most} pins", most = MOST_PINS)));
    }
    if document.pins.iter().any(|pin| pin.place == place) {
        return Err(Rejection(words!("there is a pin already")));
    }
    document.last_pin += 1;
    let pin = Pin { id: PinId(document.last_pin), place, locked: false };
    Arc::make_mut(&mut document.pins).push(pin);
    Ok(Edit::new(words!("pin"), document).with(ClothChange::SetPins))
}

pub fn delete_pin(document: Document, pin: PinId) -> Result<Edit, Rejection> {
    delete_pins(document, &[pin])
}

pub fn delete_pins(mut document: Document, pins: &[PinId]) -> Result<Edit, Rejection> {
    for &pin in pins {
        loose(&document, pin)?;
    }
    let label = match pins {
        [] => return Err(Rejection(words!("no pin is named"))),
        [_] => words!("pull a pin out"),
        _ => words!("pull {n} pins out", n = pins.len()),
    };
    Arc::make_mut(&mut document.pins).retain(|pin| !pins.contains(&pin.id));
    Ok(Edit::new(label, document).with(ClothChange::SetPins))
}

pub fn clear_pins(mut document: Document) -> Result<Edit, Rejection> {
    if document.pins.is_empty() {
        return Err(Rejection(words!("there are no pins")));
    }
    if document.pins.iter().all(|pin| pin.locked) {
        return Err(Rejection(words!("all pins are locked")));
    }
    Arc::make_mut(&mut document.pins).retain(|pin| pin.locked);
    Ok(Edit::new(words!("pull all pins out"), document).with(ClothChange::SetPins))
}

pub fn move_pin(mut document: Document, pin: PinId, piece: PieceId, at: DVec2) -> Result<Edit, Rejection> {
    let place = ClothPlace { piece, at };
    checks::cloth_place(&document.pattern, place)?;
    let index = loose(&document, pin)?;
    if document.pins.iter().any(|other| other.id != pin && other.place == place) {
        return Err(Rejection(words!("there is a pin already")));
    }
    Arc::make_mut(&mut document.pins)[index].place = place;
    Ok(Edit::new(words!("move a pin"), document).with(ClothChange::SetPins))
}

pub fn lock_pins(mut document: Document, pins: &[PinId], locked: bool) -> Result<Edit, Rejection> {
    let label = match pins {
        [] => return Err(Rejection(words!("no pin is named"))),
        [pin] if locked => words!("lock pin {n}", n = pin.0),
        [pin] => words!("unlock pin {n}", n = pin.0),
        _ if locked => words!("lock {n} pins", n = pins.len()),
        _ => words!("unlock {n} pins", n = pins.len()),
    };
    for &pin in pins {
        let index = find(&document, pin)?;
        Arc::make_mut(&mut document.pins)[index].locked = locked;
    }
    Ok(Edit::new(label, document))
}

fn find(document: &Document, pin: PinId) -> Result<usize, Rejection> {
    let index = document.pins.iter().position(|p| p.id == pin);
    index.ok_or_else(|| Rejection(words!("there is no {what}", what = pin)))
}

/// Index of a pin, if it is not locked.
fn loose(document: &Document, pin: PinId) -> Result<usize, Rejection> {
    let index = find(document, pin)?;
    if document.pins[index].locked {
        return Err(Rejection(words!("{what} is locked: unlock it first", what = pin)));
    }
    Ok(index)
}

pub fn grab(document: Document, piece: PieceId, at: DVec2, mode: DragMode) -> Result<Edit, Rejection> {
    let place = ClothPlace { piece, at };
    checks::cloth_place(&document.pattern, place)?;
    Ok(Edit::new(words!("drag the cloth"), document).with(ClothChange::Grab { at: place, mode }))
}

pub fn drag_to(document: Document, ray: Ray) -> Result<Edit, Rejection> {
    if !ray.is_valid() {
        return Err(Rejection(words!("the pointer is nowhere in the scene")));
    }
    Ok(Edit::new(words!("drag the cloth"), document).with(ClothChange::DragTo(ray)))
}
