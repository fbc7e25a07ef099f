//! Physics of cloth against exact answers.

#[path = "drape/bends.rs"]
mod bends;
#[path = "drape/capstan.rs"]
mod capstan;
mod common;
#[path = "drape/crossings.rs"]
mod crossings;
#[path = "drape/cusick.rs"]
mod cusick;
#[path = "drape/inflates.rs"]
mod inflates;
#[path = "drape/meshes.rs"]
mod meshes;
#[path = "drape/moves.rs"]
mod moves;
#[path = "drape/orders.rs"]
mod orders;
#[path = "drape/panels.rs"]
mod panels;
#[path = "drape/patches.rs"]
mod patches;
#[path = "drape/rests.rs"]
mod rests;
#[path = "drape/slips.rs"]
mod slips;
#[path = "drape/springs.rs"]
mod springs;
#[path = "drape/stability.rs"]
mod stability;
