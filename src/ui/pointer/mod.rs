//! Mouse input: button mappings, clicks, strokes.

pub(in crate::ui) mod clicks;
pub(in crate::ui) mod mouse;
pub(in crate::ui) mod stroke;
