//! Lets sessions run for a few ticks.

use crate::session::Session;

/// Most ticks after a file or a command was accepted.
const MOST_TICKS: usize = 3;

/// Runs a few ticks, and asserts that all cloth then has finite positions.
pub fn go_on(session: &mut Session) {
    if let Some(simulation) = session.runner().simulation() {
        (0..MOST_TICKS).take_while(|_| simulation.tick()).for_each(drop);
    }
    session.update();
    let cloth = &session.snapshot().cloth;
    let mut laid = cloth.positions.iter().zip(&cloth.mapped).filter(|(_, mapped)| **mapped);
    assert!(laid.all(|(p, _)| p.is_finite()), "cloth lies where no finite point is");
}
