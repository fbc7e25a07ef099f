//! The sewn garment as solvers see it.

pub mod garment;

pub use garment::{ClothState, Corner, Garment};
