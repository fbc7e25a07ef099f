//! Cloth against body, and against itself.

pub mod layers;
pub mod tracker;

pub use tracker::{Plane, Tracker};
