//! Runs the simulation on its own thread, at a fixed rate that does not depend on frames.
//!
//! Requests arrive in an inbox that is emptied between ticks; snapshots leave by a mailbox that keeps only the newest. With
//! nothing to do the thread sleeps on the inbox. The clock decides only *when* a tick runs, never what it computes.

use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, TryRecvError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use crate::sim::protocol::{Event, Request, Snapshot};
use crate::sim::simulation::Simulation;

/// Default tick rate, 1/s.
pub const DEFAULT_RATE_HZ: f64 = 60.0;

/// Idle time before cloth at rest is checked for faults, so that a person who goes on working does not wait for that.
const BEFORE_JUDGING: Duration = Duration::from_millis(150);

/// Callback on the simulation's thread whenever there is a new snapshot or event.
pub type OnNews = Box<dyn Fn() + Send>;

/// Handle to a simulation running on its own thread. Dropping it ends the thread.
#[derive(Debug)]
pub struct SimThread {
    inbox: Option<Sender<Request>>,
    mailbox: Arc<Mutex<Option<Arc<Snapshot>>>>,
    events: Receiver<Event>,
    thread: Option<JoinHandle<()>>,
}

impl SimThread {
    /// Starts `simulation` at `rate_hz` ticks a second (more than 0). The error is the system's: no thread could be created.
    pub fn start(simulation: Simulation, rate_hz: f64, on_news: OnNews) -> std::io::Result<Self> {
        let (inbox, requests) = channel();
        let (event_sender, events) = channel();
        let mailbox = Arc::new(Mutex::new(None));
        let worker = Worker {
            simulation,
            requests,
            events: event_sender,
            mailbox: Arc::clone(&mailbox),
            on_news,
            period: Duration::from_secs_f64(1.0 / rate_hz.clamp(0.001, 1e6)),
        };
        let thread = std::thread::Builder::new().name("simulation".to_owned()).spawn(|| worker.run())?;
        Ok(Self { inbox: Some(inbox), mailbox, events, thread: Some(thread) })
    }

    /// Sends `request`, which takes effect between two ticks.
    pub fn send(&self, request: Request) {
        if let Some(inbox) = &self.inbox {
            // The receiver lives as long as this handle.
            inbox.send(request).ok();
        }
    }

    /// The newest snapshot that was not taken yet.
    pub fn take_snapshot(&self) -> Option<Arc<Snapshot>> {
        self.mailbox.lock().unwrap_or_else(PoisonError::into_inner).take()
    }

    /// Events since the last call, in order.
    pub fn take_events(&self) -> Vec<Event> {
        self.events.try_iter().collect()
    }
}

impl Drop for SimThread {
    fn drop(&mut self) {
        self.inbox = None;
        if let Some(thread) = self.thread.take() {
            thread.join().ok();
        }
    }
}

struct Worker {
    simulation: Simulation,
    requests: Receiver<Request>,
    events: Sender<Event>,
    mailbox: Arc<Mutex<Option<Arc<Snapshot>>>>,
    on_news: OnNews,
    period: Duration,
}

impl Worker {
    /// The thread's main loop; it ends when the handle is dropped.
    fn run(mut self) {
        while self.sleep_until_work() && self.tick_until_rest() {}
    }

    /// Blocks until there is work. False when the handle is gone.
    fn sleep_until_work(&mut self) -> bool {
        while self.simulation.is_at_rest() {
            match self.next_request() {
                Some(request) => self.apply(request),
                None => return false,
            }
        }
        true
    }

    /// Blocks until the next request; cloth at rest is checked for faults meanwhile. None when the handle is gone.
    fn next_request(&mut self) -> Option<Request> {
        match self.requests.recv_timeout(BEFORE_JUDGING) {
            Ok(request) => return Some(request),
            Err(RecvTimeoutError::Disconnected) => return None,
            Err(RecvTimeoutError::Timeout) => {}
        }
        if self.simulation.judge() {
            self.publish();
        }
        self.requests.recv().ok()
    }

    /// Ticks at the fixed rate until at rest; late ticks are not made up for. False when the handle is gone.
    fn tick_until_rest(&mut self) -> bool {
        let mut due = Instant::now();
        while !self.simulation.is_at_rest() {
            if !self.empty_inbox() {
                return false;
            }
            let simulation = &mut self.simulation;
            // On a rayon worker: from another thread every parallel loop in it would be handed over and waited for.
            rayon::scope(|_| simulation.tick());
            self.publish();
            due = (due + self.period).max(Instant::now());
            if !self.wait_until(due) {
                return false;
            }
        }
        true
    }

    fn empty_inbox(&mut self) -> bool {
        loop {
            match self.requests.try_recv() {
                Ok(request) => self.apply(request),
                Err(TryRecvError::Empty) => return true,
                Err(TryRecvError::Disconnected) => return false,
            }
        }
    }

    /// Waits until `due`; requests that arrive meanwhile take effect at once. False when the handle is gone.
    fn wait_until(&mut self, due: Instant) -> bool {
        loop {
            let left = due.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return true;
            }
            match self.requests.recv_timeout(left) {
                Ok(request) => self.apply(request),
                Err(RecvTimeoutError::Timeout) => return true,
                Err(RecvTimeoutError::Disconnected) => return false,
            }
        }
    }

    fn apply(&mut self, request: Request) {
        self.simulation.apply(request);
        self.publish();
    }

    fn publish(&mut self) {
        // The snapshot first: who has read an event then finds a snapshot at least as new.
        let snapshot = Arc::new(self.simulation.snapshot());
        *self.mailbox.lock().unwrap_or_else(PoisonError::into_inner) = Some(snapshot);
        for event in self.simulation.take_events() {
            // No reader: the handle is being dropped.
            self.events.send(event).ok();
        }
        (self.on_news)();
    }
}
