//! What cloth does to itself: stretching, bending, limits of strain, the pressure of what it holds.

pub mod bending;
pub mod elastic;
pub mod limits;
pub mod membrane;

pub use elastic::Elastic;
