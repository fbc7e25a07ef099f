//! Paper A's relaxation: shape match, flatten, gravity, friction.

pub mod flatten;
pub mod global;
pub mod goals;
mod matching;
pub mod memory;
mod normals;
mod pacing;
pub mod relaxer;
pub mod settings;
mod wants;

pub use memory::Memory;
pub use pacing::Pace;
pub use relaxer::{GlobalStep, Relaxer};
pub use settings::{RelaxSettings, Rotation};
