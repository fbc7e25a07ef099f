//! Owner of the moving state: runs the stages, takes requests between ticks, keeps checkpoints, publishes snapshots.

mod activity;
mod checkpoints;
pub mod draped;
pub mod fault;
pub mod hash;
mod posed;
pub mod protocol;
pub mod runner;
pub mod sewn;
pub mod simulation;
pub mod starts;
pub mod stats;
pub mod thread;
mod world;

pub use draped::DrapeSource;
pub use fault::{Concerned, Fault, Lies, faults};
pub use protocol::{ClothPlace, DrapeState, Event, GarmentSource, Request, RequestKind, Snapshot};
pub use runner::Runner;
pub use simulation::Simulation;
pub use starts::{Start, StartChoice, Started, Tried};
pub use stats::Stats;
pub use thread::SimThread;
