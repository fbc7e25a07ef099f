//! Paper C (Zhong, "Fast Virtual Garment Dressing on Posed Human Model"): dressed cloth goes along when its body takes
//! another pose.

mod between;
mod change;
mod conform;
mod distance_map;
mod excess;
mod folds;
mod limit;
mod looks;
mod reposer;
mod transfer;
mod turns;

#[cfg(test)]
mod tests;

pub use between::Way;
pub use change::Change;
pub use conform::conformed;
pub use distance_map::{Binding, DistanceMap};
pub use reposer::{Care, Outcome, Reposer};
