//! Commands, undo, recordings and project files, through the library's front door.

#[path = "sessions/activities.rs"]
mod activities;
#[path = "sessions/animations.rs"]
mod animations;
#[path = "sessions/bodies.rs"]
mod bodies;
#[path = "sessions/commands.rs"]
mod commands;
mod common;
#[path = "sessions/dragging.rs"]
mod dragging;
#[path = "sessions/draping.rs"]
mod draping;
#[path = "common/limb.rs"]
mod limb;
#[path = "sessions/live.rs"]
mod live;
#[path = "sessions/project_files.rs"]
mod project_files;
#[path = "sessions/recordings.rs"]
mod recordings;
#[path = "sessions/reposing.rs"]
mod reposing;
#[path = "sessions/resizing.rs"]
mod resizing;
#[path = "sessions/rewrapping.rs"]
mod rewrapping;
#[path = "sessions/scenario.rs"]
mod scenario;
#[path = "sessions/starts.rs"]
mod starts;
#[path = "sessions/threads.rs"]
mod threads;
#[path = "sessions/undo.rs"]
mod undo;
