//! What a measured garment says of itself, in the language that is shown: its faults, tight places, and what is cut too small.

use crate::fit::{Smaller, Tight};
use crate::ui::language::{number, say, signed, tr, translated};

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
    use crate::fit::{Moved, Opening, Penetration, PieceChange, Report, Seams, Strain, faults};
    use crate::geometry::ids::SeamId;
    use crate::geometry::words::words;
    use crate::language::{Table, said, shown_in};

    /// A garment with every fault at once.
    fn faulty() -> Report {
        let piece = |name: &str, triangles| PieceChange {
            name: name.to_owned(),
            triangles,
            missing_triangles: 3,
            ..PieceChange::default()
        };
        let opening = Opening { length: 0.8, height: 1.25, ..Opening::default() };
        let mut report = Report {
            triangles: 10,
            not_finite_vertices: 1,
            pieces: vec![piece("front; left", 0), piece("1.5 back", 7)],
            seams: Seams { closed: 1, open: 2, max_gap: 0.0125 },
            open_seams: [1, 2].map(|n| SeamId(n).into()).into(),
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
        let mut all: Vec<_> =
            faults(&faulty(), Moved::Draped).into_iter().map(|(problem, _)| problem).collect();
        assert!(all.len() >= 14, "{all:#?}");
        all.extend(faults(&Report::default(), Moved::Wrapped).into_iter().map(|(problem, _)| problem));
        let english: Vec<[String; 2]> = all.iter().map(|p| [said(&p.words), said(&p.place)]).collect();
        shown_in(Table::german(), || {
            for (problem, english) in all.iter().zip(english) {
                assert_eq!(
                    english,
                    [problem.words.as_str(), problem.place.as_str()],
                    "English stays as it is"
                );
                let german = said(&problem.words);
                assert!(german != english[0] && !german.contains("the "), "{german}");
                assert!(!german.contains(".5") && !german.contains("0.1 mm"), "{german}");
                assert_ne!(said(&problem.place), english[1]);
            }
            let place = words!("piece {name}", name = "1.5 back");
            assert_eq!(said(&place), "Teil 1.5 back", "names are no numbers");
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
