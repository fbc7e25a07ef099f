//! The mannequin is built to another size, and the dressed cloth goes along.

use toile::body::mannequin::{Measurements, mannequin};
use toile::body::{NamedPose, mannequin as figures};
use toile::fit::{self, BodyIndex};
use toile::session::recording::Recording;
use toile::session::replay::Replay;
use toile::session::samples::Sample;
use toile::session::{BodyChoice, Command, Session};
use toile::sim::{Runner, Simulation};

use crate::common::{cloth_hash, run};

fn size(given: &[(&str, f64)]) -> Measurements {
    Measurements::completed(|name| given.iter().find(|(known, _)| *known == name).map(|(_, metres)| *metres))
}

fn small() -> Measurements {
    size(&[("height", 1.68), ("bust", 0.84), ("waist", 0.66), ("hip", 0.90)])
}

fn large() -> Measurements {
    size(&[("height", 1.76), ("bust", 1.00), ("waist", 0.78), ("hip", 1.04)])
}

fn dressed(sample: Sample) -> Session {
    let project = sample.project(&figures::default());
    let mut s = Session::new(project, Runner::inline(Simulation::default()));
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(&mut s, 3000);
    s
}

fn faults(s: &mut Session) -> Vec<String> {
    s.update();
    let snapshot = s.snapshot();
    let (garment, cloth) = snapshot.drawn().expect("dressed");
    let (source, body) =
        (snapshot.source.as_ref().expect("a source"), snapshot.body.as_ref().expect("a body"));
    let report = fit::measure(&source.pattern, garment, cloth, &BodyIndex::new(body));
    fit::faults(&report, snapshot.lies().moved).into_iter().map(|(problem, _)| problem.words.into()).collect()
}

#[test]
fn garments_stay_on_when_the_size_changes() {
    for (sample, sizes) in [
        (Sample::Tshirt, [small(), large()]),
        (Sample::Skirt, [large(), small()]),
        (Sample::Dress, [small(), large()]),
    ] {
        let mut s = dressed(sample);
        let pieces = s.snapshot().source.as_ref().expect("a source").pattern.pieces.len();
        for measurements in sizes {
            s.apply_alone(Command::ChangeSize { measurements }).expect("another size");
            run(&mut s, 3000);
            assert_eq!(s.document().body, BodyChoice::Mannequin(measurements));
            let found = faults(&mut s);
            println!("{sample:?} {:.2} m: {found:?}", measurements.height);
            assert!(found.is_empty(), "{sample:?} {:.2} m: {found:?}", measurements.height);
            assert_eq!(
                s.snapshot().body.as_ref().map(|b| &b.mesh),
                mannequin(&measurements).ok().as_ref().map(|f| &f.mesh)
            );
            assert!(s.problems().is_empty() && s.document().pattern.pieces.len() == pieces);
        }
    }
}

#[test]
fn a_change_of_size_is_undone_done_again_and_replayed_in_any_pose() {
    let mut s = dressed(Sample::Scarf);
    let body = s.document().body.in_named_pose(NamedPose::Walking).expect("the mannequin");
    s.apply_alone(Command::Repose { body: body.clone(), settle: false, draft: false }).expect("posed");
    run(&mut s, 10);
    let (document, before) = (s.document().clone(), cloth_hash(&mut s));
    s.apply_alone(Command::ChangeSize { measurements: large() }).expect("another size");
    run(&mut s, 3000);
    let there = cloth_hash(&mut s);
    assert!(there != before && s.document().body.pose() == body.pose());
    assert_eq!(s.document().body.measurements(), Some(large()));
    assert!(s.apply_alone(Command::ChangeSize { measurements: large() }).is_err(), "it has it");
    let nonsense = Measurements { height: 9.0, ..large() };
    assert!(s.apply_alone(Command::ChangeSize { measurements: nonsense }).is_err());
    // From there it goes on to other poses.
    let standing = s.document().body.in_named_pose(NamedPose::Standing).expect("the mannequin");
    s.apply_alone(Command::Repose { body: standing, settle: false, draft: false }).expect("posed");
    run(&mut s, 10);
    for _ in 0..2 {
        s.apply_alone(Command::Undo).expect("undone");
    }
    run(&mut s, 1);
    assert!(*s.document() == document && cloth_hash(&mut s) == before);
    s.apply_alone(Command::Redo).expect("again");
    run(&mut s, 3000);
    assert_eq!(cloth_hash(&mut s), there);
    let recording = Recording::parse(&s.recording()).expect("a recording");
    Replay::new(recording).run().expect("the same hashes");
}

#[test]
fn a_body_from_a_file_has_no_size() {
    let mut s = crate::common::session();
    let why = s.apply_alone(Command::ChangeSize { measurements: large() }).expect_err("a ball");
    assert!(why.0.contains("only the mannequin"), "{why}");
}
