//! Recordings kept in `tests/replays` still give their hashes.
//!
//! After a change that is meant to move cloth differently: `TOILE_BLESS=1 cargo test --test sessions replays` writes them anew.

mod demos;

use std::fs;
use std::path::{Path, PathBuf};

use toile::session::Session;
use toile::session::recording::{Recording, machine};
use toile::session::replay::{Replay, recorded_again};
use toile::sim::{Runner, Simulation};

use crate::{common, scenario};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/replays")
}

fn recordings() -> Vec<PathBuf> {
    let entries = fs::read_dir(folder()).expect("tests/replays");
    let mut paths: Vec<PathBuf> = entries.flatten().map(|e| e.path()).collect();
    paths.retain(|p| p.extension().is_some_and(|e| e == "jsonl"));
    paths.sort();
    paths
}

fn bless() {
    for (name, project, play) in [
        ("ball.jsonl", common::project(), scenario::play as fn(&mut Session)),
        ("frozen.jsonl", common::project(), scenario::frozen),
        ("laser.jsonl", common::tube_project(), scenario::laser),
    ] {
        let path = folder().join(name);
        if !path.exists() {
            let mut session = Session::new(project, Runner::inline(Simulation::default()));
            play(&mut session);
            fs::write(path, session.recording()).expect("written");
        }
    }
    for path in recordings() {
        let text = fs::read_to_string(&path).expect("read");
        let recording = Recording::parse(&text).expect("a recording");
        fs::write(&path, recorded_again(recording).expect("accepted")).expect("written");
    }
}

#[test]
fn kept_recordings_give_their_hashes() {
    if std::env::var_os("TOILE_BLESS").is_some() {
        bless();
    }
    assert!(!recordings().is_empty());
    for path in recordings() {
        let text = fs::read_to_string(&path).expect("read");
        let recording = Recording::parse(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        if recording.machine != machine() {
            println!(
                "{}: made on {}, this is {}: not compared",
                path.display(),
                recording.machine,
                machine()
            );
            continue;
        }
        let mut replay = Replay::new(recording);
        replay.run().unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        assert!(replay.hashes_compared() > 3, "{}", path.display());
    }
}
