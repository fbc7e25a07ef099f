//! Physics: cloth that falls, hangs and lies.
//!
//! A [`Sheet`] of constant-strain triangles with quadratic bending, moved by implicit steps or by many small ones; [`Drape`]
//! chooses. [`settle`] finds the rest directly. Positions are f64: in f32 the fall of a small step is lost below rounding.

mod blocks;
mod ordering;

pub mod bending;
pub mod clear;
pub mod contact;
#[allow(clippy::module_inception, reason = "the room is named after what it makes")]
pub mod drape;
pub mod elastic;
mod laid;
pub mod limits;
pub mod membrane;
pub mod net;
pub mod newton;
mod pair;
mod routes;
pub mod self_contact;
pub mod settle;
pub mod sewing;
pub mod sheet;
pub mod small_steps;
pub mod state;
pub mod steps;
pub mod worn;

pub use contact::{Collider, Contacts};
pub use drape::{Drape, DrapeError, DrapeSettings, Method};
pub use elastic::Elastic;
pub use sheet::{Sheet, SheetError};
pub use state::State;
pub use steps::{Integrator, Scene, Steps};
pub use worn::{Undrapable, Worn, WornSettings};
