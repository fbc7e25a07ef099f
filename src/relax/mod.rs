//! Paper A's relaxation: shape matching, flattening, gravity, friction, contact.

mod acceleration;
pub mod flatten;
pub mod global;
pub mod goals;
mod matching;
pub mod memory;
mod normals;
pub mod relaxer;
pub mod settings;
pub mod step;
mod targets;

pub use acceleration::Acceleration;
pub use memory::Memory;
pub use relaxer::Relaxer;
pub use settings::{RelaxSettings, Rotation};
pub use step::GlobalStep;
