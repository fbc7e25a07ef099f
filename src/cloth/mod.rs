//! The sewn garment as solvers see it, and fabrics.

pub mod build;
pub mod carry;
pub mod counters;
pub mod distance;
pub mod fabric;
pub mod garment;
pub mod locate;
pub mod look;
pub mod refine;
pub mod skips;
pub mod trims;
pub mod wrinkles;

pub use build::{build, build_again};
pub use carry::Carry;
pub use counters::Counters;
pub use distance::{EdgeMetric, Reached};
pub use fabric::Fabric;
pub use garment::{ClothState, Corner, Garment};
pub use locate::{FlatPiece, FlatPlace};
pub use look::{FabricLook, Weave};
pub use skips::{Skip, Skips};
pub use trims::GarmentTrims;
