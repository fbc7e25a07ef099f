//! Signals. The first signal asks the work to stop at the next safe point. If the work reaches none soon, or a second signal
//! comes, the program is ended at once.
//!
//! Most work checks for a signal between ticks. A single long call (triangulating a piece, reading a large file, compiling
//! shaders in a driver) cannot check; then a separate thread, which only waits for signals, ends the program. Files are not
//! damaged by that: they are put in place whole, and none is while the program is being ended.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

use crate::cli::failure::Failure;
use crate::cli::output;

/// Number of the signal that came; 0 if none did.
static NUMBER: AtomicUsize = AtomicUsize::new(0);
/// Whether the signal has been reported on standard error.
static TOLD: AtomicBool = AtomicBool::new(false);

/// An error if a signal has come.
pub fn check() -> Result<(), Failure> {
    match u8::try_from(NUMBER.load(Ordering::Relaxed)) {
        Ok(0) => Ok(()),
        Ok(number) => Err(Failure::Signal(number)),
        Err(_) => Err(Failure::Signal(u8::MAX - 128)),
    }
}

/// Reports why the program ends: each fault of a garment in a line of its own, then what was tried and what to do. A signal is
/// reported once, by whichever thread is first.
pub fn tell(failure: &Failure) {
    match failure {
        Failure::Faults { faults, then } => {
            faults.iter().for_each(|words| output::complain(&format!("toile: {words}")));
            then.iter().for_each(|words| output::complain(words));
        }
        Failure::Signal(_) if TOLD.swap(true, Ordering::Relaxed) => {}
        _ => output::complain(&format!("toile: {failure}")),
    }
}

#[cfg(unix)]
pub use unix::listen;

/// On this system no signals are handled.
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

    /// Time that the work has to reach a safe point after a signal.
    const GRACE: Duration = Duration::from_millis(300);
    /// Longest wait for files that are just being put in place. That is quick unless the disk is a slow remote one, and some of
    /// the files without the others would be worse than the wait.
    const PLACING: Duration = Duration::from_secs(2);
    /// Time between two checks while waiting.
    const NAP: Duration = Duration::from_millis(5);

    /// Begins to handle signals. Where no thread can be started, signals end the program as they do by default.
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

    /// Waits for the first signal, then for the work to end. After a second signal or too long a wait it ends the program.
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
