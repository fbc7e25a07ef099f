//! Owner of the moving state: runs the stages, takes requests between ticks, keeps checkpoints, publishes snapshots.

mod checkpoints;
pub mod fault;
pub mod hash;
pub mod protocol;
pub mod runner;
pub mod simulation;
pub mod source;
pub mod start;
pub mod stats;
pub mod thread;
mod world;

pub use fault::{Concerned, Fault, Lies, faults};
pub use protocol::{DrapeState, Event, Request, RequestKind, Snapshot};
pub use runner::Runner;
pub use simulation::Simulation;
pub use source::{ClothPlace, DrapeSource, GarmentSource};
pub use start::{AsBuilt, Start, StartChoice, Started, Tried, Trying};
pub use stats::Stats;
pub use thread::SimThread;
