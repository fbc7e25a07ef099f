//! Where pieces stand in space before they are sewn: points round the body to stand them at, tubes round its limbs, what a file
//! says for one body brought to another, and sleeves led to their arms.

pub mod led;
pub mod limbs;
pub mod onto;
pub mod points;

pub use led::led;
pub use limbs::{Limb, Part, limbs};
pub use onto::{Moved, onto};
pub use points::{Point, points, rolled_up, stood_at};
