//! What a measured garment says of itself, in the language that is shown: its faults, tight places, and what is cut too small.

use crate::fit::{Smaller, Tight};
use crate::language::sentences::translated_by;
use crate::ui::language::{decimal_signs, number, say, signed, tr, translated};

/// Sentences, and parts of them between semicolons, with which faults are told; see `fit::faults` and `sim::faults`.
const FAULTS: &[&str] = &[
    "{n} vertices have no finite position: the simulation broke",
    "no cloth lies on the body: the wrap found no pair of marks to begin with",
    "it still lies in the pattern plane: sew it to the others or give it a pair of marks",
    "{n} of its triangles never reached the body",
    "{n} of {count} seams are open: {names}",
    "the widest gap is {mm} mm",
    "it lies in {n} separate parts",
    "its seams should make {count}",
    "{n} fastened buttons do not close",
    "{n} vertices and {faces} triangles of the cloth are inside the body, up to {mm} mm",
    "cloth and skin cut through each other in {n} places",
    "{n} triangles lie wrong side out",
    "the body does not pass through it: the cloth lies on one side of the limb, or a seam has a hole",
    "the cloth passes through itself in {n} places",
    "{n} triangles have shrunk to nothing",
    "{n} edges are stretched to more than twice their length, by up to {percent} %: the cloth or a seam would have torn",
    "its worst hundredth is strained by {percent} % and more: it does not fit this body",
    "the pattern is {cm} cm smaller than the body round the {place} ({pattern} for {body} cm)",
    "it has slid down by {cm} cm from where it was placed: nothing holds it",
    "nearest mark: {marks}",
    "nearest marks: {marks}",
];

/// The places of faults.
const PLACES: &[&str] =
    &["garment", "seams", "body", "fastenings", "piece {name}", "opening of {cm} cm, {m} m above the ground"];

/// What is wrong, from its English words. A part that is not known stays English.
pub fn fault_words(english: &str) -> String {
    let parts = english.split("; ").map(|part| known_fault(part).unwrap_or_else(|| part.to_owned()));
    parts.collect::<Vec<_>>().join("; ")
}

fn known_fault(part: &str) -> Option<String> {
    translated_by(FAULTS, part, value)
}

/// Where it is wrong, from its English words.
pub fn place_words(english: &str) -> String {
    translated_by(PLACES, english, value).unwrap_or_else(|| english.to_owned())
}

/// A value of a fault: names stay as they are, places of the body are translated, numbers have the decimal sign of the language.
fn value(name: &str, english: &str) -> String {
    match name {
        "name" | "names" => english.to_owned(),
        "place" => tr(english).to_owned(),
        _ => decimal_signs(english),
    }
}

/// A tight place with its strain: "front near armpit left, +5.0 %".
pub fn tight_words(tight: &Tight) -> String {
    let strain = signed(tight.strain * 100.0, 1);
    let near = tight.landmark.as_ref().map(|landmark| translated(&landmark.replace('_', " ")));
    match near {
        None => format!("{}, {strain} %", tight.piece),
        Some(Some(near)) => {
            say!("{piece} near {place}, {strain} %", piece = tight.piece, place = near, strain)
        }
        Some(None) => tight.to_string(),
    }
}

/// Where the pattern is smaller than the body, and by how much.
pub fn smaller_words(smaller: &Smaller) -> String {
    let [body, pattern] = [smaller.body, smaller.pattern].map(|metres| metres * 100.0);
    say!(
        "The pattern is {cm} cm smaller than the body round the {place} ({pattern} for {body} cm)",
        cm = number(body - pattern, 1),
        place = tr(&smaller.place),
        pattern = number(pattern, 1),
        body = number(body, 1)
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::{Opening, Penetration, PieceChange, Report, Seams, Strain, faults};
    use crate::language::{Table, shown_in};

    /// A garment with every fault at once.
    fn faulty() -> Report {
        let piece = |name: &str, triangles| PieceChange {
            name: name.to_owned(),
            triangles,
            missing_triangles: 3,
            ..PieceChange::default()
        };
        let opening = Opening { length: 0.8, height: 1.25, body_through: false };
        let mut report = Report {
            triangles: 10,
            not_finite_vertices: 1,
            pieces: vec![piece("front; left", 0), piece("1.5 back", 7)],
            seams: Seams { closed: 1, open: 2, max_gap: 0.0125 },
            open_seams: vec!["seam 1".to_owned(), "seam 2".to_owned()],
            pieces_in_space: 2,
            pieces_expected: 1,
            penetration: Penetration { vertices: 3, faces: 4, max_depth: 0.0031 },
            edges_through_body: 5,
            flipped_faces: 6,
            openings: vec![opening, opening],
            self_crossings: 7,
            degenerate_faces: 8,
            strain: Strain { edges: 100, doubled: 50, max: 2.5, ..Strain::default() },
            uneased_p99: 0.5,
            ..Report::default()
        };
        report.fastenings.apart = 2;
        report.fastenings.max_gap = 0.0061;
        let smaller = Smaller { place: "waist".to_owned(), body: 0.7, pattern: 0.65 };
        report.strain_causes.smaller.push(smaller);
        report
    }

    #[test]
    fn every_fault_is_told_in_german() {
        let mut all: Vec<_> = faults(&faulty(), true).into_iter().map(|(problem, _)| problem).collect();
        assert!(all.len() >= 14, "{all:#?}");
        let none = faults(&Report::default(), false);
        all.extend(none.into_iter().map(|(problem, _)| problem));
        for problem in &mut all {
            let english = [problem.words.clone(), problem.place.clone()];
            assert_eq!(
                [fault_words(&english[0]), place_words(&english[1])],
                english,
                "English stays as it is"
            );
            problem.words += "; nearest marks: 1 (+3.5 %), 2 (-1.0 %)";
        }
        shown_in(Table::german(), || {
            for problem in &all {
                for part in problem.words.split("; ") {
                    let told = known_fault(part).unwrap_or_else(|| panic!("not in German: {part}"));
                    assert!(told != part && !told.contains(".5") && !told.contains("the "), "{told}");
                }
                assert_ne!(place_words(&problem.place), problem.place);
            }
            assert_eq!(place_words("piece 1.5 back"), "Teil 1.5 back", "names are no numbers");
            assert_eq!(fault_words("something new"), "something new");
        });
    }

    #[test]
    fn tight_places_are_told_in_german() {
        let tight = Tight {
            piece: "front".to_owned(),
            at: [0.0; 3],
            landmark: Some("armpit_left".to_owned()),
            strain: 0.055,
        };
        assert_eq!(tight_words(&tight), tight.to_string());
        let bare = Tight { landmark: None, ..tight.clone() };
        assert_eq!(tight_words(&bare), bare.to_string());
        let told = shown_in(Table::german(), || [tight_words(&tight), tight_words(&bare)]);
        assert_eq!(told, ["front (linke Achsel), +5,5 %", "front, +5,5 %"]);
    }
}
