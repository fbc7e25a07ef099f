//! The body the cloth is put on.

pub mod mannequin;
pub mod measure;
pub mod skeleton;
pub mod surface;

pub use mannequin::{Landmarks, Mannequin, MannequinError, Measurements};
pub use skeleton::{Joint, Skeleton};
pub use surface::{Hit, Nearest, Surface};
