//! Pushpins and dragging.

use std::sync::Arc;

use glam::DVec2;

use crate::drag::{DragMode, Ray};
use crate::geometry::ids::{PieceId, PinId};
use crate::session::command::Rejection;
use crate::session::document::{Document, Pin};
use crate::session::edit::{ClothChange, Edit, checks};
use crate::sim::ClothPlace;

/// Pins one garment may have.
const MOST_PINS: usize = 1000;

pub fn add_pin(mut document: Document, piece: PieceId, at: DVec2) -> Result<Edit, Rejection> {
    let place = ClothPlace { piece, at };
    checks::cloth_place(&document.pattern, place)?;
    if document.pins.len() >= MOST_PINS {
        return Err(Rejection(format!("a garment may have {MOST_PINS} pins")));
    }
    if document.pins.iter().any(|pin| pin.place == place) {
        return Err(Rejection::new("there is a pin already"));
    }
    document.last_pin += 1;
    let pin = Pin { id: PinId(document.last_pin), place };
    Arc::make_mut(&mut document.pins).push(pin);
    Ok(Edit::new("pin", document).with(ClothChange::SetPins))
}

pub fn delete_pin(mut document: Document, pin: PinId) -> Result<Edit, Rejection> {
    let at = document.pins.iter().position(|p| p.id == pin);
    let at = at.ok_or_else(|| Rejection(format!("there is no {pin}")))?;
    Arc::make_mut(&mut document.pins).remove(at);
    Ok(Edit::new("pull a pin out", document).with(ClothChange::SetPins))
}

pub fn clear_pins(mut document: Document) -> Result<Edit, Rejection> {
    if document.pins.is_empty() {
        return Err(Rejection::new("there are no pins"));
    }
    document.drop_pins();
    Ok(Edit::new("pull all pins out", document).with(ClothChange::SetPins))
}

pub fn grab(document: Document, piece: PieceId, at: DVec2, mode: DragMode) -> Result<Edit, Rejection> {
    let place = ClothPlace { piece, at };
    checks::cloth_place(&document.pattern, place)?;
    Ok(Edit::new("drag the cloth", document).with(ClothChange::Grab { at: place, mode }))
}

pub fn drag_to(document: Document, ray: Ray) -> Result<Edit, Rejection> {
    if !ray.is_valid() {
        return Err(Rejection::new("the pointer is nowhere in the scene"));
    }
    Ok(Edit::new("drag the cloth", document).with(ClothChange::DragTo(ray)))
}
