//! Commands, undo, recordings, replays and project files, through the library's front door.

mod activities;
mod animations;
mod artwork;
mod bodies;
mod commands;
#[path = "../common/mod.rs"]
mod common;
mod determinism;
mod dragging;
mod draping;
mod fuzz;
mod grading;
mod live;
mod project_files;
mod random_work;
mod recordings;
mod recovery;
mod replays;
mod reposing;
mod resizing;
mod rewrapping;
mod samples;
mod scales;
mod scenario;
mod starts;
mod threads;
mod trims;
mod undo;
