//! Sessions on damaged files go on for a while.

use crate::session::Session;

/// Ticks after something was taken.
const MOST_TICKS: usize = 3;

/// A few ticks, after which the cloth must lie where finite points are.
pub fn go_on(session: &mut Session) {
    if let Some(simulation) = session.runner().simulation() {
        (0..MOST_TICKS).take_while(|_| simulation.tick()).for_each(drop);
    }
    session.update();
    let cloth = &session.snapshot().cloth;
    let mut laid = cloth.positions.iter().zip(&cloth.mapped).filter(|(_, mapped)| **mapped);
    assert!(laid.all(|(p, _)| p.is_finite()), "cloth lies where no finite point is");
}
