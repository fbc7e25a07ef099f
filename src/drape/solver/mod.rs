//! Time steppers: implicit steps, many small explicit ones, and a direct solve for equilibrium; sparse matrices of 3 × 3 blocks.

pub mod advance;
mod blocks;
pub mod chain;
pub mod net;
pub mod newton;
mod off_body;
mod ordering;
pub mod settle;
mod shares;
pub mod small_steps;
pub mod steps;
pub mod surroundings;
pub mod ties;

pub use steps::{Integrator, Scene, Steps};
