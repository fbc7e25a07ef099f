//! Paper A: marks, root edges, growth.

pub mod dressing;
pub mod marks;

pub use dressing::{Dressing, Phase};
pub use marks::{BodyMark, ClothMark, ClothSide, Marks};
