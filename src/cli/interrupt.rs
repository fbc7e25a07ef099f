//! Signals: the first asks the work to stop at the next safe point. Work that does not come to one soon is ended where it is, and
//! so is all of it by a second signal.
//!
//! Most work looks for a signal between its ticks. What is one long call (triangles of a piece, a large file, a driver that
//! compiles its shaders) cannot look; a thread of its own, which does nothing but wait, ends the program then. Files are none
//! the worse for it: they take their places whole, and none does while the program is being ended.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use crate::cli::failure::Failure;
use crate::cli::output;

/// The signal that came; 0: none.
static NUMBER: AtomicUsize = AtomicUsize::new(0);
/// Whether it has been told on standard error.
static TOLD: AtomicBool = AtomicBool::new(false);

/// An error once a signal has come.
pub fn check() -> Result<(), Failure> {
    match u8::try_from(NUMBER.load(Ordering::Relaxed)) {
        Ok(0) => Ok(()),
        Ok(number) => Err(Failure::Signal(number)),
        Err(_) => Err(Failure::Signal(u8::MAX - 128)),
    }
}

/// Says why the program ends; that a signal came is said once, whichever thread comes to it first.
pub fn tell(failure: &Failure) {
    if !matches!(failure, Failure::Signal(_)) || !TOLD.swap(true, Ordering::Relaxed) {
        output::complain(&format!("toile: {failure}"));
    }
}

#[cfg(unix)]
pub use unix::listen;

/// This system has no such signals.
#[cfg(not(unix))]
pub fn listen() {}

#[cfg(unix)]
mod unix {
    use std::thread;
    use std::time::{Duration, Instant};

    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level;

    use super::{Failure, NUMBER, Ordering, tell};
    use crate::session::whole_file::HeldBack;

    /// So long the work has to come to a safe point,
    const GRACE: Duration = Duration::from_millis(300);
    /// and files that are just taking their places to get there: that is quick unless the disk is far away, and some of them
    /// without the others would be worse than to wait.
    const PLACING: Duration = Duration::from_secs(2);
    /// Between two looks at what has happened meanwhile.
    const NAP: Duration = Duration::from_millis(5);

    /// Listens from now on. Where the system has no thread to spare, signals do what they do by themselves.
    pub fn listen() {
        let Ok(signals) = Signals::new([SIGHUP, SIGINT, SIGTERM]) else { return };
        let handle = signals.handle();
        if thread::Builder::new().name("signals".to_owned()).spawn(|| wait(signals)).is_err() {
            handle.close();
            [SIGHUP, SIGINT, SIGTERM].into_iter().for_each(end_at_once);
        }
    }

    fn end_at_once(signal: i32) {
        let always = std::sync::Arc::new(std::sync::atomic::AtomicBool::new(true));
        signal_hook::flag::register_conditional_shutdown(signal, 128 + signal, always).ok();
    }

    /// For the first signal, and then for the work to end; a second signal, or too long a time, ends the program.
    fn wait(mut signals: Signals) {
        let Some(number) = signals.forever().next() else { return };
        NUMBER.store(number as usize, Ordering::Relaxed);
        let since = Instant::now();
        while since.elapsed() < GRACE && signals.pending().next().is_none() {
            thread::sleep(NAP);
        }
        tell(&Failure::Signal(u8::try_from(number).unwrap_or_default()));
        let since = Instant::now();
        let mut held = HeldBack::new();
        while held.is_none() && since.elapsed() < PLACING {
            thread::sleep(NAP);
            held = HeldBack::new();
        }
        if let Some(held) = &mut held {
            held.remove_unplaced();
        }
        low_level::exit(128 + number);
    }
}
