//! How fast the window draws, the simulation goes, and when it will be done.

/// Seconds over which speeds are averaged.
const WINDOW: f64 = 0.5;
/// Seconds after which something lasts long enough for its end to be told.
const LONG: f64 = 2.0;

/// What the simulation is at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Work {
    /// The cloth grows.
    Growing,
    /// It settles.
    Settling,
    /// It follows the hand.
    Hand,
}

/// What the status bar tells.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pace {
    /// Pictures of the window in a second; none while nothing moves.
    pub frames: Option<f64>,
    /// Milliseconds a tick of the simulation takes, with the pauses between them.
    pub tick_ms: Option<f64>,
    /// Seconds until the work under way is done.
    pub left: Option<f64>,
}

/// Measures it from frame to frame.
#[derive(Clone, Debug, Default)]
pub struct Pacer {
    /// When the present half second began, and what was then drawn and ticked.
    since: Option<(f64, u64, u64)>,
    /// What work is under way, when it was first seen and how far it had come.
    work: Option<(Work, f64, f64)>,
    pace: Pace,
}

impl Pacer {
    /// A frame at `time` seconds; `frames` and `ticks` so far; the work under way, if any, and how far it has come (0..=1).
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
        self.pace
    }
}

/// "3 s left", "2 min left".
pub fn left_words(seconds: f64) -> String {
    match seconds.ceil() {
        s if s < 60.0 => format!("{s:.0} s left"),
        s => format!("{:.0} min left", (s / 60.0).ceil()),
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
