//! Cloth on a graphics card: many small steps of all vertices at once, with contact, by compute shaders.
//!
//! Plain buffers in, positions and velocities out. The method is that of `drape::solver::small_steps` with one difference: the
//! corrections of a vertex's springs are added up instead of made one after the other. For that they must be smaller, see
//! [`Shares`], and steps shorter. Positions are whole numbers of 2⁻²⁹ m: single precision would lose the displacement of a small
//! step. Results are the same on every run of one card, not on every card: they are never the source of recorded hashes.

mod buffers;
mod device;
mod lists;
mod pipelines;
mod scene;
mod shares;
mod slot;
mod steps;

pub use device::NoCard;
pub use scene::{Body, Cloth, Hand, Span};
pub use shares::{Shares, Spring};
pub use slot::{Card, CardSlot};
pub use steps::{CardFault, CardSteps};
