//! What a hand does with the mouse: clicks, drags, strokes.

pub(in crate::ui) mod clicks;
pub(in crate::ui) mod mouse;
pub(in crate::ui) mod stroke;
