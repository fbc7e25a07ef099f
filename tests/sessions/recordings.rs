//! Recordings replay to the same bits; one number changed is found; damaged ones are refused with the line.

use toile::relax::RelaxSettings;
use toile::session::recording::Recording;
use toile::session::replay::{Divergence, Replay};
use toile::session::{Command, Session, Settings};

use crate::common::{run, session};
use crate::scenario::{laser, play};

fn replayed(text: &str) -> Result<u64, Divergence> {
    let mut replay = Replay::new(Recording::parse(text).expect("a recording"));
    replay.run()?;
    Ok(replay.hashes_compared())
}

fn recorded() -> String {
    let mut s = session();
    play(&mut s);
    s.recording()
}

#[test]
fn a_replay_meets_every_hash() {
    let text = recorded();
    let hashes = text.lines().filter(|l| l.starts_with("{\"hash\"")).count() as u64;
    assert!(hashes >= 9, "{hashes}");
    assert_eq!(replayed(&text), Ok(hashes));
}

#[test]
fn strokes_through_front_and_back_are_two_steps_and_dress_the_ball() {
    let runner = toile::sim::Runner::inline(toile::sim::Simulation::default());
    let mut s = Session::new(crate::common::tube_project(), runner);
    laser(&mut s);
    assert_eq!(s.step_labels().count(), 3, "front and back of the cloth, of the body, wrap");
    assert_eq!((s.document().marks.cloth.len(), s.document().marks.body.len()), (2, 2));
    assert!(s.snapshot().cloth.mapped.iter().all(|&m| m) && s.snapshot().problems.is_empty());
    assert!(replayed(&s.recording()).is_ok_and(|hashes| hashes >= 4));
}

/// The session's own marks, given back to it, are to a replay others that are equal.
#[test]
fn marks_that_are_set_again_replay_to_the_same_document() {
    let mut s = session();
    let marks = s.document().marks.clone();
    s.apply_alone(Command::SetMarks { marks }).expect("set");
    let mut replay = Replay::new(Recording::parse(&s.recording()).expect("a recording"));
    replay.run().expect("the same document");
}

#[test]
fn a_replay_of_a_dressed_start_meets_every_hash() {
    let mut s = session();
    play(&mut s);
    let runner = toile::sim::Runner::inline(toile::sim::Simulation::default());
    let mut s = Session::new(s.project(), runner);
    assert!(
        s.snapshot().seq == 0 && {
            s.update();
            s.snapshot().is_dressed()
        }
    );
    let relax = RelaxSettings { offset: 0.01, ..RelaxSettings::default() };
    s.apply_alone(Command::SetSettings { settings: Settings { relax, ..s.document().settings } })
        .expect("set");
    assert!(run(&mut s, 2000) > 5, "adopted cloth wakes");
    assert!(replayed(&s.recording()).is_ok_and(|hashes| hashes >= 3));
}

/// Every whole run of digits outside the header, one at a time, has its last digit changed.
#[test]
fn any_one_number_changed_is_found() {
    let text = recorded();
    let header = text.find('\n').expect("lines");
    let starts: Vec<usize> = (header..text.len())
        .filter(|&i| text.as_bytes()[i].is_ascii_digit() && !text.as_bytes()[i + 1].is_ascii_digit())
        .collect();
    assert!(starts.len() > 100, "{}", starts.len());
    for i in starts.into_iter().step_by(3) {
        let mut changed = text.clone().into_bytes();
        changed[i] = b'0' + (changed[i] - b'0' + 1) % 10;
        let changed = String::from_utf8(changed).expect("digits");
        let Ok(recording) = Recording::parse(&changed) else { continue };
        let line = text[..i].lines().count();
        let divergence =
            Replay::new(recording).run().expect_err(&format!("line {line} byte {i} was changed"));
        assert!(divergence.to_string().starts_with("diverged at tick "), "{divergence}");
    }
}

#[test]
fn a_number_changed_in_the_header_is_found() {
    let text = recorded().replacen("0.06", "0.05", 1);
    let divergence = replayed(&text).expect_err("another mesh size");
    assert!(divergence.seq == 0 && divergence.to_string().contains("document"), "{divergence}");
}

#[test]
fn damaged_recordings_name_the_line() {
    let refused = |text: &str, line: usize, word: &str| {
        let why = Recording::parse(text).expect_err("refused");
        assert!(why.line == line && why.words.contains(word), "{why}");
    };
    let text = recorded();
    let lines: Vec<&str> = text.lines().collect();
    refused("", 1, "empty");
    refused("hello", 1, "header");
    refused(lines[1], 1, "header");
    refused(&lines[0].replace("toile-recording", "toile-project"), 1, "not a recording");
    refused(&lines[0].replace("\"version\":1", "\"version\":99"), 1, "version 99");
    refused(&format!("{}\n{}", lines[0], &lines[2][..30]), 2, "EOF");
    refused(&format!("{}\n{{\"command\":{{}}}}", lines[0]), 2, "seq");
    refused(&format!("{}\n\n{}", lines[0], lines[0]), 3, "second header");
    refused(
        &text.replace("\"undo\"", "\"dance\""),
        text[..text.find("\"undo\"").expect("undo")].lines().count(),
        "dance",
    );
}
