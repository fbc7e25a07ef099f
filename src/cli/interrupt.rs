//! Signals: the first asks the work to stop at the next tick, the second ends the program.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};

use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};

use crate::cli::failure::Failure;

static SIGNAL: OnceLock<Arc<AtomicUsize>> = OnceLock::new();

/// Listens from now on. Where the system has no such signals nothing is heard.
pub fn listen() {
    let number = Arc::clone(SIGNAL.get_or_init(Arc::default));
    for signal in [SIGINT, SIGTERM, SIGHUP] {
        let came_before = Arc::new(AtomicBool::new(false));
        let code = 128 + signal;
        // The order matters: the second signal finds the flag that the first one set.
        signal_hook::flag::register_conditional_shutdown(signal, code, Arc::clone(&came_before)).ok();
        signal_hook::flag::register(signal, came_before).ok();
        signal_hook::flag::register_usize(signal, Arc::clone(&number), signal as usize).ok();
    }
}

/// An error once a signal has come.
pub fn check() -> Result<(), Failure> {
    match SIGNAL.get().map(|n| n.load(Ordering::Relaxed)) {
        Some(number) if number > 0 => Err(Failure::Signal(u8::try_from(number).unwrap_or(2))),
        _ => Ok(()),
    }
}
