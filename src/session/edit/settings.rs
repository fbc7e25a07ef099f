//! The command that changes settings.

use crate::geometry::words::words;
use crate::session::command::Rejection;
use crate::session::document::{Document, Settings};
use crate::session::edit::{ClothChange, Edit, checks};

pub fn set(mut document: Document, settings: &Settings) -> Result<Edit, Rejection> {
    checks::settings(settings)?;
    let relax_changed = document.settings.relax != settings.relax;
    let strain_changed = document.settings.strain != settings.strain;
    document.settings = *settings;
    let edit = Edit::new(words!("change settings"), document);
    Ok(match (relax_changed, strain_changed) {
        (true, _) => edit.with(ClothChange::SetRelax(settings.relax)),
        (false, true) => edit.with(ClothChange::SetFabrics),
        (false, false) => edit,
    })
}
