//! The rooms of the library, one by one, most of them against exact answers.

mod answers;
mod bad_inputs;
mod baked;
mod bones;
#[path = "../common/mod.rs"]
mod common;
mod converged;
mod corpus;
mod depth_of_field;
mod drag;
mod drape;
mod editing;
mod layers;
mod led;
mod memory;
mod pattern;
mod placing;
mod render;
mod skips;
mod splits;
mod suggested;
mod wrap;
