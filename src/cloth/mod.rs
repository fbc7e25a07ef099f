//! The sewn garment as solvers see it.

pub mod build;
pub mod carry;
pub mod counters;
pub mod garment;

pub use build::build;
pub use carry::Carry;
pub use counters::Counters;
pub use garment::{ClothState, Corner, Garment};
