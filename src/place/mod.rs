//! Placement of pieces in space before they are sewn: arrangement points round the body, tubes round its limbs, a
//! file's placement moved to another body, and sleeves led to their arms.

pub mod led;
pub mod limbs;
pub mod onto;
pub mod points;
pub mod turned;

pub use led::led;
pub use limbs::{Limb, Part, limbs};
pub use onto::{Moved, onto};
pub use points::{Point, points, rolled_up, stood_at};
pub use turned::Turned;
