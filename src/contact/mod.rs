//! Contact of cloth with the body and with itself.

pub mod body_overlaps;
pub mod bones;
pub mod faces;
pub mod intersections;
mod pockets;
pub mod separation;
pub mod splits;
pub mod tracker;

pub use body_overlaps::BodyOverlaps;
pub use bones::{Bone, Bones};
pub use faces::Faces;
pub use intersections::Intersections;
pub use separation::{Obstacle, Separation};
pub use splits::Splits;
pub use tracker::{Plane, Tracker};
