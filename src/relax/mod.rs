//! Paper A's relaxation: shape match, flatten, gravity, friction.

pub mod settings;

pub use settings::RelaxSettings;
