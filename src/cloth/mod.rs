//! The sewn garment as solvers see it, fabrics, and the shapes of trims on the cloth.

pub mod build;
pub mod carry;
pub mod cords;
pub mod counters;
pub mod dashes;
pub mod distance;
pub mod fabric;
pub mod garment;
pub mod locate;
pub mod look;
pub mod refine;
pub mod skips;
pub mod trim_parts;
pub mod trim_shapes;
pub mod trims;
pub mod wedges;
pub mod wrinkles;

pub use build::{build, build_again};
pub use carry::Carry;
pub use counters::Counters;
pub use distance::{EdgeMetric, Reached};
pub use fabric::{Fabric, GRAVITY};
pub use garment::{ClothState, Corner, Garment};
pub use locate::{FlatPiece, FlatPlace};
pub use look::{FabricLook, Weave};
pub use skips::{Skip, Skips};
pub use trim_parts::{TrimPart, TrimParts};
pub use trim_shapes::TrimShapes;
pub use trims::GarmentTrims;
pub use wedges::Wedges;
