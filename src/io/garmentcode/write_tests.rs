use super::*;
use crate::io::garmentcode::read;
use crate::pattern::{EdgeRef, Notch};

fn square(name: &str) -> Piece {
    let corners = [(0.0, 0.0), (0.2, 0.0), (0.2, 0.3), (0.0, 0.3)];
    Piece::polygon(name, &corners.map(|(x, y)| DVec2::new(x, y)))
}

fn again(pattern: &Pattern) -> (Pattern, Vec<Words>) {
    let written = write(pattern);
    (read(&written.bytes).expect("what was written can be read"), written.left_out)
}

#[test]
fn every_kind_of_edge_comes_back() {
    let mut pattern = Pattern::default();
    let mut piece = square("zebra");
    piece.outline[0].shape = EdgeShape::Arc { radius: 0.15, large: false, sweep: true };
    piece.outline[1].shape = EdgeShape::Quadratic { control: DVec2::new(0.27, 0.1) };
    piece.outline[2].shape = EdgeShape::Cubic { controls: [DVec2::new(0.15, 0.33), DVec2::new(0.1, 0.25)] };
    piece.outline[3].label = Some("side".to_owned());
    pattern.add_piece(piece);
    pattern.add_piece(square("apple"));
    let (read, left_out) = again(&pattern);
    assert!(left_out.is_empty(), "{left_out:?}");
    let names: Vec<&str> = read.pieces.values().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["zebra", "apple"], "in their own order");
    for (a, b) in pattern.pieces.values().zip(read.pieces.values()) {
        for i in 0..4 {
            assert_eq!(a.outline[i].label, b.outline[i].label);
            for (p, q) in
                a.edge_points(i, &[0.0, 0.3, 0.7]).into_iter().zip(b.edge_points(i, &[0.0, 0.3, 0.7]))
            {
                assert!(p.distance(q) < 1e-9, "edge {i}: {p} {q}");
            }
        }
    }
}

#[test]
fn a_seam_along_a_stretch_is_written_by_cutting_edges() {
    let mut pattern = Pattern::default();
    let [a, b] = ["a", "b"].map(|n| pattern.add_piece(square(n)));
    // The left 10 cm of one lower edge to the whole of the other: 10 cm to 20 cm.
    let sides = [Stretch { to: 0.5, ..Stretch::edge(a, 0) }, Stretch::edge(b, 0)];
    pattern.add_seam(Seam { sides, same_direction: false, ratio: Some(0.5), zip: None });
    let (read, left_out) = again(&pattern);
    let [a, b] = ["a", "b"].map(|n| read.piece_named(n).expect(n));
    assert_eq!((read.pieces[&a].outline.len(), read.pieces[&b].outline.len()), (5, 4));
    let seam = read.seams.values().next().expect("a seam");
    let lengths = seam.sides.map(|s| s.length(&read.pieces[&s.piece]).expect("it is there"));
    assert!((lengths[0] - 0.1).abs() < 1e-9 && (lengths[1] - 0.2).abs() < 1e-9, "{lengths:?}");
    assert_eq!(left_out, ["1 seams: not in the file: that lengths of seams are kept"]);
}

#[test]
fn what_cannot_be_held_is_said() {
    let mut pattern = Pattern::default();
    let mut piece = square("same");
    piece.holes.push(square("").outline.into_iter().map(|e| Edge { start: e.start * 0.2, ..e }).collect());
    piece.notches.push(Notch { edge: 0, at: 0.5 });
    piece.allowance = 0.01;
    let a = pattern.add_piece(piece);
    let b = pattern.add_piece(square("same"));
    let id = pattern
        .add_seam(Seam::of_edges([EdgeRef { piece: a, edge: 5 }, EdgeRef { piece: b, edge: 0 }], false));
    let (read, left_out) = again(&pattern);
    assert_eq!((read.pieces.len(), read.seams.len()), (2, 0));
    let words = left_out.join("\n");
    for part in ["holes", "notches", "the seam allowance", "\"same_2\"", &id.to_string()] {
        assert!(words.contains(part), "{part} in {words}");
    }
}

/// Two half circles are a disc; the format wants three edges.
#[test]
fn a_panel_of_two_edges_gets_more() {
    let disc = || {
        let mut piece = Piece::polygon("disc", &[DVec2::new(-0.1, 0.0), DVec2::new(0.1, 0.0)]);
        for edge in &mut piece.outline {
            edge.shape = EdgeShape::Arc { radius: 0.1, large: false, sweep: true };
        }
        piece
    };
    let mut pattern = Pattern::default();
    let [a, b] = [disc(), disc()].map(|p| pattern.add_piece(p));
    pattern.add_seam(Seam::of_edges([EdgeRef { piece: a, edge: 0 }, EdgeRef { piece: b, edge: 1 }], false));
    pattern.add_piece(disc());
    let (read, _) = again(&pattern);
    let counts: Vec<usize> = read.pieces.values().map(|p| p.outline.len()).collect();
    assert_eq!(counts, [4, 4, 6]);
    assert_eq!(read.seams.len(), 3);
    for piece in read.pieces.values() {
        assert!((piece.signed_area() - std::f64::consts::PI * 0.01).abs() < 1e-4);
    }
}
