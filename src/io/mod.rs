//! Bytes in, checked data out, and back. Nothing here opens a file: callers hand over bytes and name the place.

pub mod garmentcode;
pub mod glb;
pub mod json;
pub mod limits;
pub mod obj;
mod polygon;
mod sheet;
pub mod written;

pub use limits::Limits;
pub use written::Written;
