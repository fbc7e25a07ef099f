//! The same recording gives the same bits on the simulation's own thread, inline, and on any number of workers.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::channel;
use std::time::Duration;

use toile::session::recording::Recording;
use toile::session::replay::Replay;
use toile::session::{Command, Notice, Session};
use toile::sim::{Runner, Simulation};

use crate::common::project;
use crate::scenario::play;

const PATIENCE: Duration = Duration::from_secs(60);

/// Runs the scene on the simulation's own thread, sending commands while it ticks.
fn recorded_on_a_thread(rate_hz: f64) -> String {
    let (sender, news) = channel();
    let on_news = Box::new(move || sender.send(()).unwrap_or(()));
    let runner = Runner::threaded(Simulation::default(), rate_hz, on_news).expect("a thread");
    let mut s = Session::new(project(), runner);
    play(&mut s);
    let mut rests = 0;
    while rests == 0 {
        news.recv_timeout(PATIENCE).expect("the simulation goes on until it rests");
        rests += s.update().iter().filter(|n| matches!(n, Notice::AtRest { .. })).count();
    }
    s.apply_alone(Command::Unwrap).expect("taken off");
    s.recording()
}

fn replayed(text: &str) -> u64 {
    let mut replay = Replay::new(Recording::parse(text).expect("a recording"));
    replay.run().expect("the same bits");
    assert!(replay.hashes_compared() > 5);
    replay.session().runner().simulation().expect("inline").hash()
}

#[test]
fn a_recording_made_on_a_thread_replays_inline() {
    for rate in [20_000.0, 500.0] {
        replayed(&recorded_on_a_thread(rate));
    }
}

#[test]
fn one_two_and_eight_workers_give_the_same_bits() {
    let mut session = crate::common::session();
    play(&mut session);
    let text = session.recording();
    let with = |workers| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(workers).build().expect("workers");
        pool.install(|| replayed(&text))
    };
    assert!(with(1) == with(2) && with(2) == with(8));
}

#[test]
fn with_nothing_to_do_nothing_is_published() {
    let count = Arc::new(AtomicUsize::new(0));
    let counted = Arc::clone(&count);
    let on_news = Box::new(move || {
        counted.fetch_add(1, Ordering::SeqCst);
    });
    let runner = Runner::threaded(Simulation::default(), 1000.0, on_news).expect("a thread");
    let s = Session::new(project(), runner);
    std::thread::sleep(Duration::from_millis(100));
    // One publication for the hash that every session asks for at its start.
    assert!(count.load(Ordering::SeqCst) <= 1);
    drop(s);
}

#[test]
fn dropping_the_handle_ends_a_running_simulation() {
    let runner = Runner::threaded(Simulation::default(), 10.0, Box::new(|| {})).expect("a thread");
    let mut s = Session::new(project(), runner);
    s.apply_alone(Command::Wrap).expect("wrapped");
    let (done, ended) = channel();
    std::thread::spawn(move || {
        drop(s);
        done.send(()).ok();
    });
    ended.recv_timeout(PATIENCE).expect("the drop returns");
}
