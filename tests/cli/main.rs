//! The real program in an empty folder: files, words and exit codes.

mod bad_input;
mod batch;
mod bench;
mod blender;
mod bodies;
#[path = "../common/mod.rs"]
mod common;
mod compare;
mod dress;
mod environment;
mod faults;
mod fit_page;
mod gltf;
mod icon;
mod images;
mod install;
mod limits;
mod marker;
mod patterns;
mod program;
mod python;
mod quiet;
mod replay;
mod repose;
mod sample_pictures;
mod sequence;
mod signals;
mod simulate;
mod sizes;
mod starts;
mod stopped;
mod techpack;
mod textures;
mod thousand;
mod trust;
mod usd;
