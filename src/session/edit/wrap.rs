//! Commands that wrap, rewrap and take the cloth off.

use crate::geometry::words::words;
use crate::session::command::Rejection;
use crate::session::document::Document;
use crate::session::edit::{ClothChange, Edit};

pub fn wrap(mut document: Document) -> Result<Edit, Rejection> {
    if document.pattern.pieces.is_empty() {
        return Err(Rejection(words!("there is no piece of cloth to wrap")));
    }
    if document.marks.pairs().next().is_none() {
        return Err(Rejection(words!(
            "there is no pair of marks: paint at least one stroke on the cloth and one on the body"
        )));
    }
    // Pins held the previous cloth.
    document.drop_pins();
    Ok(Edit::new(words!("wrap"), document).with(ClothChange::Wrap))
}

pub fn rewrap(document: Document, pairs: &[usize]) -> Result<Edit, Rejection> {
    let count = document.marks.pairs().count();
    if count == 0 {
        return Err(Rejection(words!("there is no pair of marks to wrap it by")));
    }
    if let Some(number) = pairs.iter().find(|&&number| number == 0 || number > count) {
        return Err(Rejection(words!("there is no pair of marks {number}", number)));
    }
    Ok(Edit::new(words!("rewrap"), document).with(ClothChange::Rewrap(pairs.to_vec())))
}

pub fn unwrap(mut document: Document) -> Result<Edit, Rejection> {
    document.drop_pins();
    Ok(Edit::new(words!("take the cloth off"), document).with(ClothChange::Clear))
}

pub fn set_relaxing(document: Document, on: bool) -> Result<Edit, Rejection> {
    let label = if on { words!("go on relaxing") } else { words!("pause") };
    Ok(Edit::new(label, document).with(ClothChange::SetRelaxing(on)))
}
