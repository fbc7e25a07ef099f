//! Paper C (Zhong, "Fast Virtual Garment Dressing on Posed Human Model"): dressed cloth follows its body into another pose.

mod change;
mod conform;
mod distance_map;
mod excess;
mod fastened;
mod folds;
mod limit;
mod normal_check;
mod pose_path;
mod reposer;
mod settings;
mod transfer;
mod turns;

#[cfg(test)]
mod tests;

pub use change::Change;
pub use conform::conformed;
pub use distance_map::{Binding, DistanceMap};
pub use pose_path::PosePath;
pub use reposer::Reposer;
pub use settings::{Outcome, ReposeSettings};
