//! Reading and writing of files: bytes in, checked data out, and back. Nothing here opens a file; callers pass its bytes and its
//! name.
//!
//! | files | hold |
//! | --- | --- |
//! | `pattern_formats` | the list of pattern formats: begin there to add one; `garmentcode`, `dxf`, `svg`, `pdf` implement them |
//! | `rul` | grade rule tables, beside `dxf` |
//! | `pattern_file` | the result of reading a pattern, and its errors |
//! | `body_file` | the body formats: `obj`, `gltf`; `moving_body`, `bvh`, `joints` are their motion, `sizes` their measurements |
//! | `obj`, `mtl`, `glb`, `usd` | dressed cloth and its trims written (`dressed`), with its `materials` and their textures (`atlas`); their `normals`; `cloth_obj` cloth read |
//! | `cloth_sheet` | the cloth that a marker is drawn on, for `svg`, `dxf` and `pdf` |
//! | `trace`, `polygon`, `sheet`, `scale` | shared by drawings: making pieces of lines, finding the unit of length |
//! | `picture` | PNG and JPEG; `environment`: light from all sides, also Radiance HDR |
//! | `json`, `limits`, `words`, `written` | shared by all |

pub mod atlas;
pub mod body_file;
pub mod bvh;
pub mod cloth_obj;
pub mod cloth_sheet;
pub mod dressed;
pub mod dxf;
pub mod environment;
pub mod garmentcode;
pub mod glb;
pub mod gltf;
pub mod joints;
pub mod json;
pub mod limits;
pub mod materials;
pub mod moving_body;
pub mod mtl;
mod normals;
pub mod obj;
pub mod pattern_file;
pub mod pattern_formats;
pub mod pdf;
pub mod picture;
mod polygon;
pub mod rul;
pub mod scale;
pub mod sheet;
pub mod sizes;
pub mod svg;
mod trace;
pub mod usd;
pub mod words;
pub mod written;

pub use cloth_sheet::ClothSheet;
pub use limits::{FILE_BYTES, Limits};
pub use trace::allowance::{allowance_line, cutting_line};
pub use written::Written;
