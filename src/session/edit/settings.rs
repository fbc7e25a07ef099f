//! Settings.

use crate::session::command::Rejection;
use crate::session::document::{Document, Settings};
use crate::session::edit::{ClothChange, Edit, checks};

pub fn set(mut document: Document, settings: &Settings) -> Result<Edit, Rejection> {
    checks::settings(settings)?;
    let relax_changed = document.settings.relax != settings.relax;
    document.settings = *settings;
    let edit = Edit::new("change settings", document);
    Ok(if relax_changed { edit.with(ClothChange::SetRelax(settings.relax)) } else { edit })
}
