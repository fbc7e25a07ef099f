//! Internal forces of cloth: stretching, bending, strain limits, and the pressure of an enclosed volume.

pub mod bands;
pub mod bending;
pub mod elastic;
pub mod folds;
pub mod limits;
pub mod membrane;

pub use elastic::Elastic;
