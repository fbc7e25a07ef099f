//! Cloth against body.

pub mod tracker;

pub use tracker::{Plane, Tracker};
