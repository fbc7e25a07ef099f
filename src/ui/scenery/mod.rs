//! Converts document and cloth to what the renderer draws, with and without a window.

pub mod body_look;
pub(in crate::ui) mod covered;
pub mod environment;
pub mod fabric_looks;
pub mod fabric_textures;
pub mod front_and_back;
pub mod map_colours;
pub mod mapped;
pub(in crate::ui) mod parted;
pub mod pictures;
pub mod portrait;
pub mod print_match;
pub mod rims;
pub(in crate::ui) mod ring;
pub mod scene;
pub mod size_maps;
pub(in crate::ui) mod stitches;
pub(in crate::ui) mod trims;
pub mod worn;
