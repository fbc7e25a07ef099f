//! Colours, letters and signs.

pub(in crate::ui) mod signs;
pub(in crate::ui) mod theme;
