//! The samples: the same bits on 1, 2 and 8 threads, on the simulation's own thread, and in a second run.

use std::sync::mpsc::channel;
use std::time::Duration;

use toile::body::mannequin::{Measurements, mannequin};
use toile::session::samples::Sample;
use toile::session::{Command, Notice, Project, Session};
use toile::sim::hash::cloth_hash;
use toile::sim::{Runner, Simulation};

/// Coarse: what is tested here does not depend on the size of triangles.
fn project(sample: Sample) -> Project {
    let figure = mannequin(&Measurements::default()).expect("the default figure");
    let mut project = sample.project(&figure);
    project.document.settings.edge_length = 0.04;
    project
}

/// Hashes every few ticks on the way, and at rest.
fn hashes(project: &Project) -> Vec<u64> {
    let mut session = Session::new(project.clone(), Runner::inline(Simulation::default()));
    session.apply_alone(Command::Wrap).expect("wrapped");
    let simulation = session.runner().simulation().expect("inline");
    let mut hashes = Vec::new();
    while simulation.tick() {
        if simulation.ticks().is_multiple_of(16) {
            hashes.push(simulation.hash());
        }
    }
    hashes.push(simulation.hash());
    hashes
}

fn with_workers(workers: usize, project: &Project) -> Vec<u64> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(workers).build().expect("workers");
    pool.install(|| hashes(project))
}

#[test]
fn samples_are_the_same_on_any_number_of_threads() {
    for sample in Sample::MARKED {
        let project = project(sample);
        let one = with_workers(1, &project);
        assert!(one.len() > 2, "{}: the cloth moved", sample.name());
        assert_eq!(one, with_workers(2, &project), "{}", sample.name());
        assert_eq!(one, with_workers(8, &project), "{}", sample.name());
    }
}

#[test]
fn the_simulation_thread_ends_where_inline_does() {
    let project = project(Sample::Tshirt);
    let (sender, news) = channel();
    let on_news = Box::new(move || sender.send(()).unwrap_or(()));
    let runner = Runner::threaded(Simulation::default(), 100_000.0, on_news).expect("a thread");
    let mut session = Session::new(project.clone(), runner);
    session.apply_alone(Command::Wrap).expect("wrapped");
    loop {
        news.recv_timeout(Duration::from_secs(60)).expect("it comes to rest");
        if session.update().iter().any(|n| matches!(n, Notice::AtRest { .. })) {
            break;
        }
    }
    let snapshot = session.snapshot();
    let hash = cloth_hash(&snapshot.cloth, snapshot.phase, snapshot.relaxing);
    assert_eq!(Some(&hash), hashes(&project).last());
}
