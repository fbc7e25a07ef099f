//! Signals and closed outputs.

#![cfg(unix)]

use std::io::Read;
use std::process::{Command, Stdio};
use std::time::Duration;

use crate::program::{Place, ended};

/// Mesh so fine that it is still at work when the signal comes.
fn slow_place() -> Place {
    let place = Place::new();
    let mut project = crate::common::project();
    project.document.settings.edge_length = 0.002;
    place.save("slow.toile", &project);
    place
}

#[test]
fn a_signal_stops_it_with_its_code_and_no_files() {
    for (signal, code) in [("INT", 130), ("TERM", 143)] {
        let place = slow_place();
        let child =
            place.command("dress slow.toile --out out").stderr(Stdio::piped()).spawn().expect("started");
        std::thread::sleep(Duration::from_millis(400));
        let kill = Command::new("kill").args([format!("-{signal}"), child.id().to_string()]).status();
        assert!(kill.is_ok_and(|s| s.success()));
        let ended = ended(child.wait_with_output().expect("ended"));
        assert_eq!(ended.code, code, "{ended:#?}");
        assert!(ended.err.contains("stopped by signal"), "{ended:#?}");
        assert!(place.names("out").is_empty());
    }
}

#[test]
fn a_reader_that_goes_away_is_no_failure() {
    let place = Place::with_ball();
    let mut child = place
        .command("dress ball.toile --json --out out")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .expect("started");
    drop(child.stdout.take());
    let mut err = String::new();
    child.stderr.take().expect("piped").read_to_string(&mut err).expect("read");
    assert_eq!(child.wait().expect("ended").code(), Some(0), "{err}");
    assert!(!err.contains("internal error"), "{err}");
}
