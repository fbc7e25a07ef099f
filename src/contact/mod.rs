//! Cloth against body, and against itself.

pub mod faces;
pub mod layers;
pub mod tracker;

pub use faces::Faces;
pub use tracker::{Plane, Tracker};
