//! The real program in an empty folder: files, words and exit codes.

#[path = "cli/bad_input.rs"]
mod bad_input;
#[path = "cli/batch.rs"]
mod batch;
#[path = "cli/bench.rs"]
mod bench;
#[path = "cli/bodies.rs"]
mod bodies;
#[path = "common/chance.rs"]
mod chance;
mod common;
#[path = "cli/compare.rs"]
mod compare;
#[path = "cli/dress.rs"]
mod dress;
#[path = "cli/faults.rs"]
mod faults;
#[path = "cli/fit_page.rs"]
mod fit_page;
#[path = "cli/gltf.rs"]
mod gltf;
#[path = "common/limb.rs"]
mod limb;
#[path = "cli/patterns.rs"]
mod patterns;
#[path = "cli/program.rs"]
mod program;
#[path = "cli/replay.rs"]
mod replay;
#[path = "cli/repose.rs"]
mod repose;
#[path = "cli/sequence.rs"]
mod sequence;
#[path = "cli/signals.rs"]
mod signals;
#[path = "cli/simulate.rs"]
mod simulate;
#[path = "cli/starts.rs"]
mod starts;
#[path = "cli/stopped.rs"]
mod stopped;
