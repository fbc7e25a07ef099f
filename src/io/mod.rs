//! Bytes in, checked data out, and back. Nothing here opens a file: callers hand over bytes and name the place.

pub mod body_file;
pub mod bvh;
pub mod cloth_obj;
pub mod dxf;
pub mod garmentcode;
pub mod glb;
pub mod gltf;
pub mod joints;
pub mod json;
pub mod limits;
pub mod moving_body;
pub mod obj;
pub mod pattern_file;
pub mod pdf;
mod polygon;
pub mod scale;
mod sheet;
pub mod sizes;
pub mod svg;
mod trace;
pub mod words;
pub mod written;

pub use limits::{FILE_BYTES, Limits};
pub use written::Written;
