//! Bytes in, checked data out, and back. Nothing here opens a file: callers hand over bytes and name the place.
//!
//! | files | hold |
//! | --- | --- |
//! | `pattern_formats` | the list of formats of patterns: begin there to add one; `garmentcode`, `dxf`, `svg`, `pdf` are theirs |
//! | `pattern_file` | what reading a pattern gives, and its errors |
//! | `body_file` | the formats of bodies: `obj`, `gltf`; `moving_body`, `bvh`, `joints` are how they move, `sizes` how large they are |
//! | `obj`, `glb` | dressed cloth written; `cloth_obj` cloth read |
//! | `trace`, `polygon`, `sheet`, `scale` | what drawings share: lines to pieces, how large a drawing is |
//! | `json`, `limits`, `words`, `written` | what all share |

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
pub mod pattern_formats;
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
