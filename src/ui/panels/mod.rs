//! The side panel: its sections and their fields.

mod animation;
pub(in crate::ui) mod artwork;
pub(in crate::ui) mod colours;
pub(in crate::ui) mod context;
pub(in crate::ui) mod fabric;
pub(in crate::ui) mod fastenings;
pub(in crate::ui) mod fields;
pub(in crate::ui) mod joint;
pub(in crate::ui) mod marks;
pub(in crate::ui) mod pattern;
pub(in crate::ui) mod pins;
pub(in crate::ui) mod pose;
pub(in crate::ui) mod pose_slider;
pub(in crate::ui) mod side;
pub(in crate::ui) mod size;
pub(in crate::ui) mod sizes;
pub(in crate::ui) mod tape;
pub(in crate::ui) mod tight;
pub(in crate::ui) mod trims;
