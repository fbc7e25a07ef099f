//! Document and cloth as the buffers that are drawn, in the window and without one.

pub(in crate::ui) mod covered;
pub mod mapped;
pub(in crate::ui) mod parted;
pub mod portrait;
pub(in crate::ui) mod ring;
pub mod scene;
pub(in crate::ui) mod stitches;
