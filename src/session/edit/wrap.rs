//! Commands that wrap, rewrap and take the cloth off.

use crate::session::command::Rejection;
use crate::session::document::Document;
use crate::session::edit::{ClothChange, Edit};

pub fn wrap(mut document: Document) -> Result<Edit, Rejection> {
    if document.pattern.pieces.is_empty() {
        return Err(Rejection::new("there is no piece of cloth to wrap"));
    }
    if document.marks.pairs().next().is_none() {
        return Err(Rejection::new(
            "there is no pair of marks: paint at least one stroke on the cloth and one on the body",
        ));
    }
    // Pins held the previous cloth.
    document.drop_pins();
    Ok(Edit::new("wrap", document).with(ClothChange::Wrap))
}

pub fn rewrap(document: Document, pairs: &[usize]) -> Result<Edit, Rejection> {
    let count = document.marks.pairs().count();
    if count == 0 {
        return Err(Rejection::new("there is no pair of marks to wrap it by"));
    }
    if let Some(number) = pairs.iter().find(|&&number| number == 0 || number > count) {
        return Err(Rejection(format!("there is no pair of marks {number}")));
    }
    Ok(Edit::new("rewrap", document).with(ClothChange::Rewrap(pairs.to_vec())))
}

pub fn unwrap(mut document: Document) -> Result<Edit, Rejection> {
    document.drop_pins();
    Ok(Edit::new("take the cloth off", document).with(ClothChange::Clear))
}

pub fn set_relaxing(document: Document, on: bool) -> Result<Edit, Rejection> {
    let label = if on { "go on relaxing" } else { "pause" };
    Ok(Edit::new(label, document).with(ClothChange::SetRelaxing(on)))
}
