//! Runs the simulation on its own thread (for the window) or inline, as fast as it can (headless, tests).

use std::sync::Arc;

use crate::sim::protocol::{Event, Request, Snapshot};
use crate::sim::simulation::Simulation;
use crate::sim::thread::{OnNews, SimThread};

/// A simulation, inline or on its thread, and its newest snapshot.
#[derive(Debug)]
pub struct Runner {
    place: Place,
    snapshot: Arc<Snapshot>,
}

#[derive(Debug)]
enum Place {
    Inline(Box<Simulation>),
    Thread(SimThread),
}

impl Runner {
    /// Runs on the caller's thread, when told to.
    pub fn inline(simulation: Simulation) -> Self {
        let snapshot = Arc::new(simulation.snapshot());
        Self { place: Place::Inline(Box::new(simulation)), snapshot }
    }

    /// Runs on its own thread at `rate_hz` ticks a second and calls `on_news` there.
    pub fn threaded(simulation: Simulation, rate_hz: f64, on_news: OnNews) -> std::io::Result<Self> {
        let snapshot = Arc::new(simulation.snapshot());
        let thread = SimThread::start(simulation, rate_hz, on_news)?;
        Ok(Self { place: Place::Thread(thread), snapshot })
    }

    /// Sends `request`; inline it takes effect at once.
    pub fn send(&mut self, request: Request) {
        match &mut self.place {
            Place::Inline(simulation) => simulation.apply(request),
            Place::Thread(thread) => thread.send(request),
        }
    }

    /// Events since the last call, in order.
    pub fn take_events(&mut self) -> Vec<Event> {
        match &mut self.place {
            Place::Inline(simulation) => simulation.take_events(),
            Place::Thread(thread) => thread.take_events(),
        }
    }

    /// Takes the newest snapshot. True when it is a new one; inline a snapshot is made here.
    pub fn refresh(&mut self) -> bool {
        let newer = match &self.place {
            Place::Inline(simulation) => Some(Arc::new(simulation.snapshot())),
            Place::Thread(thread) => thread.take_snapshot(),
        };
        match newer {
            Some(snapshot) => {
                self.snapshot = snapshot;
                true
            }
            None => false,
        }
    }

    /// The newest snapshot at the last [`Runner::refresh`].
    pub fn snapshot(&self) -> &Arc<Snapshot> {
        &self.snapshot
    }

    /// The simulation itself; None when it runs on its own thread.
    pub fn simulation(&mut self) -> Option<&mut Simulation> {
        match &mut self.place {
            Place::Inline(simulation) => Some(simulation),
            Place::Thread(_) => None,
        }
    }
}
