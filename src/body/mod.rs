//! The body the cloth is put on.

pub mod surface;

pub use surface::{Hit, Nearest, Surface};
