//! Grading: one pattern in several sizes, by rules that say how far points move from size to size.

pub mod apply;
pub mod field;
pub mod lengths;
pub mod rule;
pub mod sizes;

pub use apply::{Graded, graded};
pub use field::Field;
pub use lengths::{SeamGrowth, growth_in};
pub use rule::{GradeRule, RulePoint};
pub use sizes::{READY_SIZES, ReadySizes, SizeRun};
