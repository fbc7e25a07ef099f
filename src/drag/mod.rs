//! Paper A: dragging cloth along the surface. A dependency graph from the hand (the dragged vertex) outward; motion
//! carried along it in local frames, weakened towards pushpins.

pub mod dragging;
pub mod graph;
pub mod pins;
mod transport;

pub use dragging::{DragMode, Dragging, Ray};
pub use graph::Graph;
