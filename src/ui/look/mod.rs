//! Colours, fonts and icons.

pub(in crate::ui) mod chip;
pub(in crate::ui) mod contrast;
pub(in crate::ui) mod scheme;
pub(in crate::ui) mod signs;
pub(in crate::ui) mod theme;
