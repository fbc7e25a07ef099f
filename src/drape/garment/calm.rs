//! Damping that lets cloth down and brings it to rest.

use crate::drape::garment::TICK;

/// Damping, 1/s, in tick `ticks` since the cloth was disturbed, while a tick lasts `pace` times [`TICK`]. It grows after half a
/// second, to stop what still creeps or trembles.
pub fn calming(ticks: u64, pace: f64) -> f64 {
    // By 10/s², up to 8/s: about critical for a hanging skirt, whose slow swings then end soonest.
    let grown = (10.0 * (ticks as f64 * TICK - 0.5)).clamp(0.0, 8.0);
    // In turn so much per second of unslowed time, which stops trembling, and per second of simulated time. Under the first alone,
    // four times that in slowed time, cloth that hangs freely would only creep to its place: with both a gown rests after 471 ticks
    // instead of 1029, a T-shirt as before.
    let (trembles, swings) = (120, 300);
    if ticks % (trembles + swings) < trembles { grown / pace } else { grown }
}

/// Damping, 1/s, of cloth that has been let down for `age` seconds of unslowed time: let down rather than dropped. It falls to
/// nothing within three quarters of a second. The cloth comes from a wrap with slack above tight places, and a skirt that falls 5 cm
/// pulls its band over the hips, as soft as it is.
pub fn gentle(age: f64) -> f64 {
    60.0 * (1.0 - age / 0.75).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn trembling_and_swings_are_damped_in_turn() {
        let at = |ticks| calming(ticks, 0.25);
        assert_eq!(at(30), 0.0, "not at once");
        assert_eq!([at(119), at(120), at(419), at(420), at(539), at(540)], [32.0, 8.0, 8.0, 32.0, 32.0, 8.0]);
        assert_eq!(calming(100, 1.0), calming(200, 1.0), "one and the same while time is not slowed");
    }

    #[test]
    fn cloth_is_let_down_for_a_while() {
        assert_eq!([0.0, 0.375, 0.75, 9.0, f64::INFINITY].map(gentle), [60.0, 30.0, 0.0, 0.0, 0.0]);
    }
}
