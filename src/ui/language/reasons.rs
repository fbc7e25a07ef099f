//! Tests that the reasons of other rooms are told in German: each error in every variant, problems of patterns, what is refused.

use std::path::Path;
use std::sync::Arc;

use glam::DVec2;

use crate::body::mannequin::{MannequinError, Measurements};
use crate::body::pose::anatomy::JointAngle;
use crate::body::{Unit, import};
use crate::cloth;
use crate::drape::SheetError;
use crate::geometry::shapes::cylinder;
use crate::geometry::words::{Part, Value, Words, words};
use crate::io::bvh::{self, BvhError};
use crate::io::glb::GlbError;
use crate::io::pattern_file::PatternFileError;
use crate::io::pdf::PdfError;
use crate::io::sizes::{self, SizesError};
use crate::io::usd::UsdError;
use crate::io::{body_file, environment, joints, pattern_formats, picture, rul};
use crate::language::{Table, said, shown_in};
use crate::marker::MarkerError;
use crate::pattern::{EdgeRef, Pattern, Piece, ProblemKind, Seam};
use crate::session::project_file::{self, ProjectFileError};
use crate::session::recording::Recording;
use crate::session::replay::Divergence;
use crate::session::{Command, Project, Session, marks_file, whole_file};
use crate::sim::{Runner, Simulation};

/// Asserts that German has every text of `words`, and that they are not names alone.
fn is_german(words: &Words) {
    has_german(words);
    assert!(words.is_empty() || words.parts().iter().any(|part| matches!(part, Part::Text(..))), "{words:?}");
}

fn has_german(words: &Words) {
    let table = Table::german().expect("it is built in");
    for part in words.parts() {
        let Part::Text(text, values) = part else { continue };
        assert!(text.is_empty() || table.text(text).is_some(), "not in German: {text:?}, in {words:?}");
        for (_, value) in values {
            if let Value::Words(words) = value {
                has_german(words);
            }
        }
    }
}

fn german(words: &Words) -> String {
    is_german(words);
    shown_in(Table::german(), || said(words))
}

#[test]
fn why_there_is_no_marker_is_told_in_german() {
    let piece = || "v1.5, left".to_owned();
    let too_wide = MarkerError::TooWide { piece: piece(), needs: 2.0, width: 1.1 };
    let no_size = Pattern::default().sizes.number("M").expect_err("no size");
    let wrong =
        crate::marker::garments(&Pattern::default(), &[], &["M=x".to_owned()]).expect_err("no number");
    let MarkerError::Number(no_number) = wrong else { panic!("{wrong}") };
    for why in [
        MarkerError::Empty,
        MarkerError::Nothing,
        MarkerError::Size(no_size),
        MarkerError::Number(no_number),
        too_wide.clone(),
        MarkerError::TooMany(500),
        MarkerError::NoArea(piece()),
        MarkerError::Stopped,
    ] {
        match why {
            // Another variant belongs into this test.
            MarkerError::Empty
            | MarkerError::Nothing
            | MarkerError::Size(_)
            | MarkerError::Number(_)
            | MarkerError::TooWide { .. }
            | MarkerError::TooMany(_)
            | MarkerError::NoArea(_)
            | MarkerError::Stopped => {}
        }
        assert_ne!(german(&why.words()), why.to_string());
    }
    let told = german(&too_wide.words());
    assert_eq!(told, "„v1.5, left“ braucht 200,0 cm breiten Stoff, und dieser ist 110,0 cm breit");
}

#[test]
fn why_there_is_no_pdf_is_told_in_german() {
    for why in [
        PdfError::Empty,
        PdfError::TooLarge { width: 20_000, height: 300, most: 14_400 },
        PdfError::TooManyPages(5_000),
        PdfError::Library("no font".to_owned()),
    ] {
        match why {
            // Another variant belongs into this test.
            PdfError::Empty
            | PdfError::TooLarge { .. }
            | PdfError::TooManyPages(_)
            | PdfError::Library(_) => {}
        }
        assert_ne!(german(&why.words()), why.to_string());
    }
}

#[test]
fn why_there_is_no_scene_is_told_in_german() {
    let json = serde_json::from_str::<u8>("x").expect_err("no number");
    for why in [GlbError::Empty, GlbError::TooLarge, GlbError::Json(json)] {
        match why {
            // Another variant belongs into this test.
            GlbError::Empty | GlbError::TooLarge | GlbError::Json(_) => {}
        }
        assert_ne!(german(&why.words()), why.to_string());
    }
    for why in [UsdError::Empty, UsdError::TooLarge, UsdError::Package("full".to_owned())] {
        match why {
            // Another variant belongs into this test.
            UsdError::Empty | UsdError::TooLarge | UsdError::Package(_) => {}
        }
        assert_ne!(german(&why.words()), why.to_string());
    }
}

#[test]
fn why_cloth_cannot_be_draped_is_told_in_german() {
    for why in [SheetError::Empty, SheetError::Corner(1), SheetError::Area(2), SheetError::Lonely(3)] {
        match why {
            // Another variant belongs into this test.
            SheetError::Empty | SheetError::Corner(_) | SheetError::Area(_) | SheetError::Lonely(_) => {}
        }
        assert_ne!(german(&why.words()), why.to_string());
    }
}

#[test]
fn why_there_is_no_mannequin_is_told_in_german() {
    assert_ne!(german(&MannequinError::Unreachable.words()), MannequinError::Unreachable.to_string());
    let usual = Measurements::default();
    let mut given = std::collections::BTreeSet::new();
    for (name, _) in usual.named() {
        for share in [0.2, 0.99, 1.01, 1.04, 1.1, 1.3, 3.0] {
            let wished = |other: &str| (other == name).then(|| share * value(&usual, name));
            let all = |other: &str| wished(other).or_else(|| Some(value(&usual, other)));
            let Err(why) = Measurements::completed(all).check() else { continue };
            given.insert(why.given);
            let words = german(&MannequinError::from(why).words());
            assert!(words.contains("ein Mannequin lässt sich mit"), "{words}");
        }
    }
    assert!(given.len() > 3, "{given:?}");
}

fn value(measurements: &Measurements, name: &str) -> f64 {
    measurements.named().into_iter().find(|(known, _)| *known == name).map_or(f64::NAN, |(_, value)| value)
}

fn square(name: &str, side: f64) -> Piece {
    Piece::polygon(name, &[DVec2::ZERO, DVec2::X * side, DVec2::splat(side), DVec2::Y * side])
}

#[test]
fn problems_of_a_pattern_are_told_in_german() {
    let mut pattern = Pattern::default();
    let front = pattern.add_piece(square("front", 0.2));
    let back = pattern.add_piece(square("back", 0.3));
    let bow = [DVec2::ZERO, DVec2::splat(0.2), DVec2::X * 0.2, DVec2::Y * 0.2];
    pattern.add_piece(Piece::polygon("bow", &bow));
    let seam = |edges: [usize; 2]| {
        Seam::of_edges(
            [EdgeRef { piece: front, edge: edges[0] }, EdgeRef { piece: back, edge: edges[1] }],
            true,
        )
    };
    for edges in [[0, 0], [0, 1], [1, 9]] {
        pattern.add_seam(seam(edges));
    }
    let (_, problems) = cloth::build(&pattern, 0.05);
    let mut kinds: Vec<ProblemKind> = Vec::new();
    for problem in &problems {
        let told = german(&problem.in_words());
        assert_ne!(told, *problem.in_words(), "{problem:?}");
        kinds.push(problem.kind);
    }
    for kind in [
        ProblemKind::SelfCrossing,
        ProblemKind::SeamToNothing,
        ProblemKind::EdgeSewnTwice,
        ProblemKind::UnequalSeam,
        ProblemKind::PieceUnsewn,
    ] {
        assert!(kinds.contains(&kind), "{kind:?} is not in {problems:#?}");
    }
    let unsewn = problems.iter().find(|problem| problem.kind == ProblemKind::PieceUnsewn).expect("unsewn");
    assert_eq!(german(&unsewn.in_words()), "bow (Teil 3): keine Naht hält dieses Teil");
}

#[test]
fn what_is_refused_and_what_was_done_is_told_in_german() {
    let mut session = Session::new(Project::default(), Runner::inline(Simulation::default()));
    let mut told = Vec::new();
    for command in [
        Command::Undo,
        Command::Wrap,
        Command::ClearPins,
        Command::ClearMarks,
        Command::SetFabric { piece: None, fabric: Some("paper".to_owned()) },
        Command::StepDraping { ticks: 0 },
        Command::DeletePair { number: 7 },
    ] {
        told.push(german(&session.apply_alone(command).expect_err("refused").0));
    }
    assert_eq!(told[0], "es gibt nichts rückgängig zu machen");
    assert!(told.iter().all(|words| !words.contains("the ") && !words.contains("there ")), "{told:#?}");
    let piece = Arc::new(square("Ärmel {n}", 0.2));
    let edits = vec![crate::pattern::edit::PatternEdit::AddPiece { piece }];
    session.apply_alone(Command::EditPattern { edits, anew: false }).expect("taken");
    let [undo, _] = session.next_labels();
    assert_eq!(german(undo.expect("a step")), "Ärmel {n} hinzufügen");
    assert_eq!(session.undo_label(), Some("add Ärmel {n}"));
}

/// Asserts that German tells `words`, and otherwise than English.
fn is_told(words: &Words) {
    assert_ne!(german(words), words.as_str());
}

#[test]
fn why_a_pattern_cannot_be_read_is_told_in_german() {
    for bytes in [
        &b""[..],
        b"{",
        b"{\"a\": 1, \"a\": 2}",
        b"{}",
        b"{\"properties\": 1}",
        b"{\"properties\": {\"units_in_meter\": 1e9}}",
        b"%PDF-1.7",
        b"AC1015",
        b"0\nSECTION\n2\nENTITIES\nx\n1\n",
        b"0\nSECTION\n2\nENTITIES\n0\nENDSEC\n0\nEOF\n",
        b"<svg",
        b"<html/>",
        b"<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"one\"/>",
        b"<svg xmlns=\"http://www.w3.org/2000/svg\"><path d=\"M0 0H200V300Z\"/></svg>",
    ] {
        let why = pattern_formats::read(bytes, None).expect_err("no pattern");
        match why {
            // Another variant belongs into this test.
            PatternFileError::Bad { .. }
            | PatternFileError::Whole(_)
            | PatternFileError::OverLimit(_)
            | PatternFileError::Scale(_) => {}
        }
        is_told(&why.words());
    }
    for table in ["", "UNITS: FURLONG", "SIZE LIST: S M", "RULE: DELTA 1 2,x", "RULE: DELTA 1 2"] {
        is_told(&rul::read(table.as_bytes()).expect_err("no table").words());
    }
    let why =
        pattern_formats::read(b"{\"properties\": {\"units_in_meter\": 0.0005}}", None).expect_err("no unit");
    let told = german(&why.words());
    assert_eq!(told, "/properties/units_in_meter: 0,0005 Einheiten je Meter können nicht sein");
}

#[test]
fn what_was_left_out_of_a_pattern_is_told_in_german() {
    let drawing = b"<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"400mm\" height=\"400mm\" viewBox=\"0 0 400 400\"><path d=\"M0 0H200V300H0Z\"/><path d=\"M300 300h1v1h-1Z\"/></svg>";
    let notes = pattern_formats::read(drawing, None).expect("a pattern").notes;
    let told: Vec<String> = notes.iter().map(german).collect();
    assert_eq!(told, ["weggelassene kleine oder offene Linien außerhalb aller Schnittteile: 1"]);
    let line = |ends: &str| format!("0\nLINE\n8\n1\n{ends}");
    let ends = |from: [&str; 2], to: [&str; 2]| {
        format!("10\n{}\n20\n{}\n11\n{}\n21\n{}\n", from[0], from[1], to[0], to[1])
    };
    let corners = [["0", "0"], ["300", "0"], ["300", "400"], ["0", "400"]];
    let lines: String = (0..4).map(|i| line(&ends(corners[i], corners[(i + 1) % 4]))).collect();
    let faulty = line(&ends(["0", "0,5"], ["1", "1"]));
    let block =
        format!("0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n8\n1\n2\nfront\n70\n0\n10\n0\n20\n0\n{lines}{faulty}");
    let drawing = format!("{block}0\nENDBLK\n8\n1\n0\nENDSEC\n0\nEOF\n");
    let notes = pattern_formats::read(drawing.as_bytes(), None).expect("a pattern").notes;
    notes.iter().for_each(is_told);
    let told = german(&notes[0]);
    assert!(told.ends_with(": „0,5“ ist keine Zahl (ein Dezimalkomma?); LINE wurde weggelassen"), "{told}");
}

#[test]
fn why_a_body_a_motion_or_a_table_cannot_be_read_is_told_in_german() {
    let none = |_: &Path| Err("its buffer is not there".to_owned());
    for bytes in [
        &b""[..],
        b"\0",
        b"v 1 2\n",
        b"v 1 2 3,5\n",
        b"v 1 2 3\nf 0 1 2\n",
        b"hello\n",
        b"glTF\x02\0\0\0\x01\0\0\0",
    ] {
        is_told(body_file::read(Path::new("body.obj"), bytes, &none).expect_err("no body").words());
    }
    let motions = ["x", "HIERARCHY", "HIERARCHY\nROOT a\n{\nOFFSET 1\n}", "HIERARCHY\nROOT a\n{\nx\n}"];
    for text in motions {
        let why = bvh::read(text.as_bytes()).expect_err("no motion");
        match why {
            // Another variant belongs into this test.
            BvhError::Line { .. } | BvhError::OverLimit(_) => {}
        }
        is_told(&why.words());
    }
    for text in
        ["", "size\nM\n", "size,bust\nM,x\n", "size,bust (ell)\nM,3\n", "size,bust\n", "size,height\nM,500\n"]
    {
        let why = sizes::read(text.as_bytes()).and_then(|sizes| sizes[0].checked()).expect_err("no size");
        match why {
            // Another variant belongs into this test.
            SizesError::File(_)
            | SizesError::Cell { .. }
            | SizesError::Row { .. }
            | SizesError::OverLimit(_) => {}
        }
        is_told(&why.words());
    }
    is_told(&picture::read(b"GIF89a").expect_err("no picture"));
    is_told(&environment::read(b"GIF89a").expect_err("no environment"));
}

#[test]
fn why_marks_joints_or_texts_cannot_be_read_is_told_in_german() {
    let mut pattern = Pattern::default();
    pattern.add_piece(square("front", 0.2));
    for (piece, cloth) in [("back", "[[0, 0]]"), ("front", "[]")] {
        let pair = format!("{{\"piece\": \"{piece}\", \"cloth\": {cloth}, \"body\": [[0, 0, 0]]}}");
        for file in [format!("{{\"pairs\": [{pair}]}}"), "{\"pairs\": []}".to_owned(), "{".to_owned()] {
            is_told(&marks_file::read(file.as_bytes(), &pattern).expect_err("no marks"));
        }
    }
    for (name, degrees) in [("tail", 1.0), ("left_hip.bend", 1.0), ("left_knee.twist", 1.0)] {
        is_told(&JointAngle::new(name, degrees).expect_err("no angle"));
    }
    assert_eq!(
        german(&JointAngle::new("spine.abduction", 20.25).expect_err("too far")),
        "spine: abduction 20,25° liegt außerhalb des Bereichs von -17,5° bis 17,5°"
    );
    is_told(&joints::read(b"{\"left_elbow\": 200}").expect_err("too far").words());
    for table in [
        "{",
        r#"{"code": "../de", "name": "D", "texts": {}}"#,
        r#"{"code": "de", "name": " ", "texts": {}}"#,
        r#"{"code": "de", "name": "D", "decimal_sign": "x", "texts": {}}"#,
        r#"{"code": "de", "name": "D", "texts": {"{a} of": "{b}"}}"#,
    ] {
        is_told(&Table::read(table.as_bytes()).expect_err("no table"));
    }
}

#[test]
fn what_was_found_in_a_body_is_told_in_german() {
    let mut mesh = cylinder(10.0, 170.0, 12, 8);
    mesh.triangles[0].swap(0, 1);
    mesh.positions.push(mesh.positions[0]);
    let notes = import(mesh, Unit::Metre).notes;
    assert!(notes.len() > 1, "{notes:?}");
    notes.iter().for_each(is_told);
    let last = notes.last().map(german).unwrap_or_default();
    assert_eq!(
        last,
        "der Körper ist 170,000 m hoch; mit der Einheit cm wären es 1,70 m: mit dieser versuchen (--unit cm)"
    );
}

#[test]
fn why_a_project_or_a_recording_cannot_be_read_is_told_in_german() {
    for bytes in [&b""[..], b"{}", b"PK", b"{\"format\": \"a\", \"version\": 1}"] {
        let why = project_file::from_bytes(bytes).expect_err("no project");
        match why {
            // Another variant belongs into this test.
            ProjectFileError::File { .. } | ProjectFileError::Contents(_) | ProjectFileError::TooLarge(_) => {
            }
        }
        is_told(&why.words());
    }
    for text in ["", "x", "{\"header\": {\"format\": \"a\", \"version\": 1}}"] {
        is_told(&Recording::parse(text).expect_err("no recording").words());
    }
    is_told(
        &Divergence { tick: 3, seq: 2, words: words!("the recording goes back to tick {tick}", tick = 1) }
            .words(),
    );
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("long");
    std::fs::write(&path, "long").expect("a file");
    let why = whole_file::read(&path, 3).expect_err("too long");
    assert_eq!(why.to_string(), "it has 4 bytes, at most 3 are read");
    assert_eq!(german(&whole_file::words(&why)), "die Datei hat 4 Byte; gelesen werden höchstens 3");
}
