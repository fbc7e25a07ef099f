//! The sewn garment as solvers see it.

pub mod build;
pub mod garment;

pub use build::build;
pub use garment::{ClothState, Corner, Garment};
