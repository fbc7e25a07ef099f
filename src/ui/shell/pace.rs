//! Measures the speed of the window and of the simulation, and estimates when work is done.

use crate::ui::language::say;

/// Time over which speeds are averaged, seconds.
const WINDOW: f64 = 0.5;
/// Shortest duration of work for which the remaining time is shown, seconds.
const LONG: f64 = 2.0;

/// A kind of work of the simulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Work {
    /// A wrap grows cloth.
    Growing,
    /// The cloth settles.
    Settling,
    /// Starts are tried.
    Dressing,
    /// The cloth follows a drag.
    Hand,
}

/// The figures for the status bar.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pace {
    /// Frames per second of the window; None while nothing moves.
    pub frames: Option<f64>,
    /// Time per tick of the simulation including pauses, milliseconds.
    pub tick_ms: Option<f64>,
    /// Estimated remaining time of the work in progress, seconds.
    pub left: Option<f64>,
}

/// Measures the speeds from frame to frame.
#[derive(Clone, Debug, Default)]
pub struct Pacer {
    /// Start of the present averaging interval, with the numbers of frames and ticks at that time.
    since: Option<(f64, u64, u64)>,
    /// The work in progress, the time when it was first seen, and its progress then.
    work: Option<(Work, f64, f64)>,
    pace: Pace,
}

impl Pacer {
    /// Updates the figures in a frame at `time` seconds. `frames` and `ticks` are totals; `work` is the work in progress and its
    /// progress, 0..=1.
    pub fn frame(&mut self, time: f64, frames: u64, ticks: u64, work: Option<(Work, f64)>) -> Pace {
        self.work = work.map(|(kind, progress)| match self.work {
            Some((known, began, from)) if known == kind && progress >= from => (known, began, from),
            _ => (kind, time, progress),
        });
        let Some((kind, progress)) = work else {
            (self.since, self.pace) = (None, Pace::default());
            return self.pace;
        };
        let (began, frames_then, ticks_then) = *self.since.get_or_insert((time, frames, ticks));
        let seconds = time - began;
        if seconds >= WINDOW {
            let rate = |now: u64, then: u64| now.saturating_sub(then) as f64 / seconds;
            let ticked = rate(ticks, ticks_then);
            self.pace.frames = Some(rate(frames, frames_then));
            self.pace.tick_ms = (ticked > 0.0 && kind != Work::Hand).then(|| 1000.0 / ticked);
            self.since = Some((time, frames, ticks));
        }
        self.pace.left = self.work.and_then(|(_, began, from)| {
            let (seconds, done) = (time - began, progress - from);
            (seconds > LONG && done > 0.0).then(|| (1.0 - progress) * seconds / done)
        });
        // At the end, progress may stand still: no time is told then.
        self.pace.left = self.pace.left.filter(|left| *left >= 0.5);
        self.pace
    }
}

/// The remaining time in words: "3 s left", "2 min left".
pub fn left_words(seconds: f64) -> String {
    match seconds.ceil() {
        s if s < 60.0 => say!("{seconds} s left", seconds = format!("{s:.0}")),
        s => say!("{minutes} min left", minutes = format!("{:.0}", (s / 60.0).ceil())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speeds_are_told_while_something_moves_and_the_end_of_what_lasts() {
        let mut pacer = Pacer::default();
        let mut pace = Pace::default();
        // 50 frames and 100 ticks a second; done after ten.
        for i in 0..=200_u64 {
            let time = 7.0 + i as f64 * 0.02;
            pace = pacer.frame(time, i, 2 * i, Some((Work::Growing, i as f64 * 0.002)));
            assert_eq!(pace.left.is_some(), time - 7.0 > LONG, "at {time}");
        }
        let near =
            |a: Option<f64>, b: f64| assert!(a.is_some_and(|a| (a - b).abs() < 1e-6 * b), "{a:?}, {b}");
        near(pace.frames, 50.0);
        near(pace.tick_ms, 10.0);
        near(pace.left, 6.0);
        assert_eq!(pacer.frame(12.0, 250, 300, None), Pace::default());
        // Something else is measured from its own beginning.
        assert_eq!(pacer.frame(12.1, 251, 301, Some((Work::Settling, 0.5))).left, None);
    }

    #[test]
    fn the_end_is_told_in_seconds_and_minutes() {
        assert_eq!(left_words(2.1), "3 s left");
        assert_eq!(left_words(61.0), "2 min left");
    }
}
