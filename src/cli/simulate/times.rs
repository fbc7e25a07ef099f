//! Seconds of work by the wall's clock and by the processor's.

use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// Shortest processor time that counts, in steps of its clock: a shorter one is mostly rounding.
const STEPS: f64 = 20.0;
/// A clock that stands still for longer than this while the processor is busy is of no use.
const STANDS: Duration = Duration::from_millis(200);

/// Seconds that all threads of the program have run so far; None where the system does not tell.
#[cfg(unix)]
pub fn cpu_seconds() -> Option<f64> {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    Some(time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9)
}

/// Seconds that all threads of the program have run so far; None where the system does not tell.
#[cfg(not(unix))]
pub fn cpu_seconds() -> Option<f64> {
    None
}

/// Adds up how long pieces of work take.
#[derive(Default)]
pub struct Stopwatch {
    wall: f64,
    cpu: Option<f64>,
}

impl Stopwatch {
    pub fn time<T>(&mut self, work: impl FnOnce() -> T) -> T {
        let (start, before) = (Instant::now(), cpu_seconds());
        let result = work();
        self.wall += start.elapsed().as_secs_f64();
        if let (Some(before), Some(now)) = (before, cpu_seconds()) {
            *self.cpu.get_or_insert(0.0) += now - before;
        }
        result
    }

    pub fn wall(&self) -> f64 {
        self.wall
    }

    /// Seconds of processor, of all threads; those by the wall's clock where the processor's is missing or too coarse for what
    /// was timed. Some systems count in hundredths of a second, by which short work takes none at all.
    pub fn processor(&self) -> f64 {
        known(self.cpu, clock_step()).unwrap_or(self.wall)
    }
}

fn known(cpu: Option<f64>, step: Option<f64>) -> Option<f64> {
    cpu.zip(step).and_then(|(cpu, step)| (cpu > STEPS * step).then_some(cpu))
}

/// What the processor's clock counts in, in seconds, found by watching it: what systems say of it is not always so.
fn clock_step() -> Option<f64> {
    static STEP: OnceLock<Option<f64>> = OnceLock::new();
    *STEP.get_or_init(|| {
        let first = next_change(cpu_seconds()?)?;
        next_change(first).map(|second| second - first)
    })
}

fn next_change(of: f64) -> Option<f64> {
    let start = Instant::now();
    while start.elapsed() < STANDS {
        let now = cpu_seconds()?;
        if now > of {
            return Some(now);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_time_counts_when_its_clock_is_fine_enough_for_it() {
        assert_eq!(known(Some(0.3), Some(0.01)), Some(0.3));
        assert_eq!(known(Some(0.01), Some(0.01)), None);
        assert_eq!(known(Some(0.0), Some(1e-7)), None);
        assert_eq!(known(None, Some(0.01)), None);
        assert_eq!(known(Some(0.3), None), None);
    }

    #[test]
    fn work_takes_time_by_either_clock() {
        let mut watch = Stopwatch::default();
        let sum = watch.time(|| (0..200_000_u64).fold(0_u64, |a, b| std::hint::black_box(a ^ b)));
        assert_eq!(sum, (0..200_000_u64).fold(0, |a, b| a ^ b));
        assert!(watch.wall() > 0.0 && watch.processor() > 0.0);
    }
}
