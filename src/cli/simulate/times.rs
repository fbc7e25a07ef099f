//! Wall-clock and processor time of work.

use std::sync::OnceLock;
use std::time::{Duration, Instant};

/// Smallest processor time that is trusted, in steps of the clock; a shorter one is mostly rounding.
const STEPS: f64 = 20.0;
/// Longest wait for the processor clock to advance while the processor is busy; a clock that takes longer is not used.
const STANDS: Duration = Duration::from_millis(200);

/// Processor time of all threads of the program so far, seconds; None where the system does not tell.
#[cfg(unix)]
pub fn cpu_seconds() -> Option<f64> {
    let time = rustix::time::clock_gettime(rustix::time::ClockId::ProcessCPUTime);
    Some(time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9)
}

/// Processor time of all threads of the program so far, seconds; None where the system does not tell.
#[cfg(not(unix))]
pub fn cpu_seconds() -> Option<f64> {
    None
}

/// Sums the wall-clock and processor time of pieces of work.
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

    /// Processor time of all threads, seconds; the wall-clock time where the processor clock is missing or too coarse for what
    /// was timed. Some systems count in hundredths of a second, so that short work takes no time at all.
    pub fn processor(&self) -> f64 {
        known(self.cpu, clock_step()).unwrap_or(self.wall)
    }
}

fn known(cpu: Option<f64>, step: Option<f64>) -> Option<f64> {
    cpu.zip(step).and_then(|(cpu, step)| (cpu > STEPS * step).then_some(cpu))
}

/// Step of the processor clock in seconds, found by watching it: what systems state is not always true.
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
