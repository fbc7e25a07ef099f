//! Tests that the reasons of other rooms are told in German: each error in every variant, problems of patterns, what is refused.

use std::sync::Arc;

use glam::DVec2;

use crate::body::mannequin::{MannequinError, Measurements};
use crate::cloth;
use crate::drape::SheetError;
use crate::geometry::words::{Part, Value, Words};
use crate::io::pdf::PdfError;
use crate::language::{Table, said, shown_in};
use crate::marker::MarkerError;
use crate::pattern::{EdgeRef, Pattern, Piece, ProblemKind, Seam};
use crate::session::{Command, Project, Session};
use crate::sim::{Runner, Simulation};

/// Asserts that German has every text of `words`.
fn is_german(words: &Words) {
    let table = Table::german().expect("it is built in");
    for part in words.parts() {
        let Part::Text(text, values) = part else { continue };
        assert!(text.is_empty() || table.text(text).is_some(), "not in German: {text:?}, in {words:?}");
        for (_, value) in values {
            if let Value::Words(words) = value {
                is_german(words);
            }
        }
    }
    assert!(words.is_empty() || words.parts().iter().any(|part| matches!(part, Part::Text(..))), "{words:?}");
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
