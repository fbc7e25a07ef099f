//! Project files come back as they were, and bad ones are refused in words.

use std::path::Path;
use std::sync::Arc;

use proptest::prelude::*;
use toile::fit::Moved;
use toile::geometry::ids::MarkId;
use toile::session::project_file::{ProjectFileError, from_bytes, open, save, to_bytes};
use toile::session::{BodyChoice, Command, Project, Session};
use toile::sim::{GarmentSource, Runner, Simulation};

use crate::common::{project, run, session};

fn dressed() -> Project {
    let mut s = session();
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(&mut s, 20);
    s.project()
}

fn plain() -> Project {
    let mut project = project();
    project.document.body = BodyChoice::default();
    project
}

fn refused(bytes: &[u8], word: &str) {
    let why = from_bytes(bytes).expect_err("refused").to_string();
    assert!(why.contains(word), "{why:?} should speak of {word:?}");
}

#[test]
fn plain_and_dressed_projects_come_back_as_they_were() {
    let dressed = dressed();
    assert!(dressed.dressed.is_some());
    for project in [plain(), project(), dressed] {
        let bytes = to_bytes(&project).expect("bytes");
        assert_eq!(from_bytes(&bytes).expect("a project"), project);
        assert_eq!(to_bytes(&project).expect("bytes"), bytes, "the same project gives the same bytes");
    }
    assert!(to_bytes(&plain()).expect("bytes").starts_with(b"{"));
}

#[test]
fn it_is_kept_whether_cloth_was_draped_and_old_files_tell_nothing() {
    let mut s = session();
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(&mut s, 2000);
    let told = |s: &mut Session| {
        let project = s.project();
        let text = serde_json::to_string(&project).expect("json");
        assert_eq!(from_bytes(&to_bytes(&project).expect("bytes")).expect("a project"), project);
        let was_draped = project.dressed.expect("cloth").moved == Moved::Draped;
        assert_eq!(text.contains("was_draped"), was_draped, "cloth of the marks alone is written as before");
        was_draped
    };
    assert!(!told(&mut s));
    s.apply_alone(Command::StepDraping { ticks: 2 }).expect("draped");
    run(&mut s, 20);
    assert!(told(&mut s));
    let mut again = Session::new(s.project(), Runner::inline(Simulation::default()));
    again.update();
    assert!(told(&mut again), "opened again");
    s.apply_alone(Command::Undo).expect("undone");
    run(&mut s, 20);
    assert!(!told(&mut s));
    s.apply_alone(Command::Redo).expect("done again");
    run(&mut s, 20);
    assert!(told(&mut s));
    s.apply_alone(Command::Wrap).expect("wrapped anew");
    run(&mut s, 20);
    assert!(!told(&mut s));
}

#[test]
fn saving_keeps_the_version_before() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("a name with ü.toile");
    save(&path, &plain()).expect("saved");
    save(&path, &project()).expect("saved");
    assert_eq!(open(&path).expect("opened"), project());
    assert_eq!(open(&path.with_extension("toile.bak")).expect("opened"), plain());
    let files = std::fs::read_dir(folder.path()).expect("listed").count();
    assert_eq!(files, 2, "no temporary file stays");
}

#[test]
fn a_project_that_could_not_be_read_back_is_not_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("p.toile");
    save(&path, &plain()).expect("saved");
    let mut bad = plain();
    bad.document.settings.edge_length = f64::NAN;
    save(&path, &bad).expect_err("refused");
    assert_eq!(open(&path).expect("still there"), plain());
}

#[test]
fn names_of_marks_are_kept_and_old_files_have_none() {
    let mut s = session();
    let text = |p: &Project| String::from_utf8(to_bytes(p).expect("bytes")).expect("json");
    assert!(!text(&plain()).contains("names"), "a project without names is written as before");
    s.apply_alone(Command::RenameMark { mark: MarkId(1), name: "hem".to_owned() }).expect("named");
    let project = Project {
        document: toile::session::Document { body: BodyChoice::default(), ..s.document().clone() },
        dressed: None,
    };
    assert_eq!(from_bytes(text(&project).as_bytes()).expect("a project"), project);
    refused(text(&project).replace("\"1\": \"hem\"", "\"9\": \"hem\"").as_bytes(), "mark 9");
}

#[test]
fn places_of_marks_on_the_body_are_kept() {
    let mut s = session();
    s.apply_alone(Command::AddBodyMark { points: crate::common::line_on_ball(0.75, 0.1, 0.1) })
        .expect("painted");
    let project = s.project();
    assert_eq!(project.document.marks.ties.values().map(Vec::len).collect::<Vec<_>>(), [3, 3]);
    assert_eq!(from_bytes(&to_bytes(&project).expect("bytes")).expect("a project"), project);
}

#[test]
fn bad_files_are_refused_in_words() {
    let text = String::from_utf8(to_bytes(&plain()).expect("bytes")).expect("json");
    refused(b"", "empty");
    refused(b"\xef\xbb\xbf  ", "empty");
    refused(b"o octopus\nv 1 2 3\n", "not a project");
    refused(&text.as_bytes()[..text.len() / 2], "not a project");
    refused(text.replace("\"version\": 1", "\"version\": 2").as_bytes(), "newer program");
    refused(text.replace("toile-project", "toile-recording").as_bytes(), "toile-recording");
    refused(text.replace("0.06", "6.0").as_bytes(), "mesh size");
    refused(text.replace("\"last_mark\": 2", "\"last_mark\": 1").as_bytes(), "behind");
    refused(text.replace("toile-project", "toile-\\u202e\\u0007").as_bytes(), "toile-\\u{202e}\\u{7}");
    let no_file = open(Path::new("/nowhere/at all.toile")).expect_err("no such file");
    assert!(matches!(no_file, ProjectFileError::File { .. }) && no_file.to_string().contains("nowhere"));
}

/// What no session would have let in, though every number in it is one.
#[test]
fn what_cannot_be_worked_with_is_refused_before_the_work() {
    let refused = |change: &dyn Fn(&mut Project), words: &str| {
        let mut damaged = dressed();
        change(&mut damaged);
        // Not by `to_bytes`, which holds for sound projects.
        let why = damaged.problem().unwrap_or_else(|| panic!("taken, without {words}"));
        assert!(why.contains(words), "{why}");
    };
    let source = |change: fn(&mut GarmentSource)| {
        move |project: &mut Project| {
            change(Arc::make_mut(&mut project.dressed.as_mut().expect("dressed").source));
        }
    };
    refused(
        &source(|source| source.edge_length = 1e-300),
        "what the dressed cloth was cut from: the mesh size",
    );
    refused(&source(|source| source.relax.offset = f64::NAN), "the distance from the skin");
    refused(
        &|project| {
            let cloth = &mut project.dressed.as_mut().expect("dressed").cloth;
            Arc::make_mut(cloth).positions[0].x = 1e300;
        },
        "near the origin",
    );
    refused(
        &|project| {
            let BodyChoice::Imported { mesh, .. } = &mut project.document.body else { panic!("a mesh") };
            Arc::make_mut(mesh).positions[0].y = 1e300;
        },
        "a vertex of ball is not within 1000000 m of the origin",
    );
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn damaged_zips_never_panic(at in 0.0..1.0f64, bit in 0..8u8, cut in any::<bool>()) {
        let mut bytes = to_bytes(&project()).expect("bytes");
        let i = ((bytes.len() - 1) as f64 * at) as usize;
        if cut {
            bytes.truncate(i);
            prop_assert!(from_bytes(&bytes).is_err());
        } else {
            bytes[i] ^= 1 << bit;
            // A flipped bit in a name or a time may go unseen; contents are checked by their sums.
            if let Ok(read) = from_bytes(&bytes) {
                prop_assert_eq!(read, project());
            }
        }
    }
}
