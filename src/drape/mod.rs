//! Physics: cloth that falls, hangs and comes to rest.
//!
//! A [`Sheet`] of constant-strain triangles with quadratic bending, moved by implicit steps or by many small ones; [`Drape`]
//! chooses. [`solver::settle`] finds the equilibrium directly. Positions are f64: in f32 the displacement of one small step would
//! be lost to rounding.
//!
//! | what moves | by | forces on it |
//! | --- | --- | --- |
//! | a garment on its body: the window's *Drape*, `toile dress` | [`DrapedGarment`], always in [`solver::small_steps`] | `Surroundings`: bending, gravity, drag, contact; stretching as the springs of `solver::net`; folds, elastic and buttons by projection |
//! | any cloth mesh: `toile simulate`, the bench | [`Drape`], in implicit ([`solver::steps`]) or small steps | [`Elastic`] in implicit ones: `forces` |
//!
//! A new force must be added to both.

pub mod contact;
#[allow(clippy::module_inception, reason = "the room is named after what it makes")]
pub mod drape;
pub mod forces;
pub mod garment;
pub mod sheet;
pub mod solver;
pub mod state;

pub use contact::{Collider, Contacts};
pub use drape::{Drape, DrapeError, DrapeSettings, Method};
pub use forces::Elastic;
pub use garment::{DrapedGarment, DrapedSettings, Undrapable};
pub use sheet::{Sheet, SheetError};
pub use solver::{Integrator, Scene, Steps};
pub use state::State;
