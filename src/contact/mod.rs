//! Cloth against body, and against itself.

pub mod apart;
pub mod bones;
pub mod faces;
pub mod layers;
mod pockets;
pub mod separation;
pub mod splits;
pub mod tracker;

pub use apart::Apart;
pub use bones::{Bone, Bones};
pub use faces::Faces;
pub use layers::Met;
pub use separation::{Obstacle, Separation};
pub use splits::Splits;
pub use tracker::{Plane, Tracker};
