use super::*;
use crate::pattern::grading::{GradeRule, SizeRun};
use crate::pattern::{EdgeShape, Notch};

fn v(x: f64, y: f64) -> DVec2 {
    DVec2::new(x, y)
}

fn run() -> SizeRun {
    SizeRun::new(["S", "M", "L", "XL"], "M").expect("a run")
}

/// A step of the run as a rule.
fn step(x: f64, y: f64) -> Option<GradeRule> {
    Some(GradeRule::even(v(x, y), 4, 1))
}

/// A rectangle of 0.5 × 0.7 m whose right side moves by 1 cm and whose top by 2 cm a size.
fn rectangle() -> Piece {
    let mut piece = Piece::polygon("front", &[v(0.0, 0.0), v(0.5, 0.0), v(0.5, 0.7), v(0.0, 0.7)]);
    piece.outline[1].rule = step(0.01, 0.0);
    piece.outline[2].rule = step(0.01, 0.02);
    piece.outline[3].rule = step(0.0, 0.02);
    piece
}

fn of(piece: Piece) -> Pattern {
    let mut pattern = Pattern { sizes: run(), ..Pattern::default() };
    pattern.add_piece(piece);
    pattern
}

fn in_size(piece: &Piece, size: &str) -> Piece {
    let graded = graded(&of(piece.clone()), size).expect("a size");
    assert!(graded.problems.is_empty(), "{:?}", graded.problems);
    Piece::clone(&graded.pattern.pieces[&PieceId(1)])
}

#[test]
fn a_rectangle_has_its_exact_size_in_every_size() {
    for (size, steps) in [("S", -1.0), ("M", 0.0), ("L", 1.0), ("XL", 2.0)] {
        let piece = in_size(&rectangle(), size);
        let (width, height) = (0.5 + 0.01 * steps, 0.7 + 0.02 * steps);
        assert!((piece.signed_area() - width * height).abs() < 1e-12, "{size}");
        for (edge, length) in [width, height, width, height].into_iter().enumerate() {
            assert!((piece.edge_length(edge) - length).abs() < 1e-12, "{size}: edge {edge}");
        }
    }
}

#[test]
fn the_base_size_is_the_pattern_to_the_bit() {
    let pattern = of(rectangle());
    let graded = graded(&pattern, "M").expect("the base");
    assert_eq!(graded.pattern, pattern);
    assert!(graded.moved.is_empty());
    assert!(pattern.pieces.iter().all(|(id, piece)| Arc::ptr_eq(piece, &graded.pattern.pieces[id])));
}

#[test]
fn pieces_without_rules_are_the_very_same_and_unknown_sizes_are_told() {
    let mut pattern = of(rectangle());
    let plain = pattern.add_piece(Piece::polygon("plain", &[v(0.0, 0.0), v(1.0, 0.0), v(0.0, 1.0)]));
    let large = graded(&pattern, "L").expect("a size");
    assert!(Arc::ptr_eq(&pattern.pieces[&plain], &large.pattern.pieces[&plain]));
    assert_eq!(large.moved.len(), 1);
    assert!(graded(&pattern, "46").expect_err("none").contains("S, M, L, XL"));
    assert!(graded(&Pattern::default(), "M").expect_err("none").contains("no sizes"));
}

#[test]
fn points_on_the_way_follow_and_corners_stay() {
    let mut piece = rectangle();
    piece.outline[1].rule = None;
    // A point at a quarter of the hem: the hem's corners stay, so does it.
    piece.outline.insert(1, Edge { start: v(0.125, 0.0), ..Edge::default() });
    assert_eq!(in_size(&piece, "L").outline[1].start, v(0.125, 0.0));
    piece.outline[2].rule = step(0.02, 0.0);
    let large = in_size(&piece, "XL");
    assert!(large.outline[1].start.distance(v(0.125 + 0.01, 0.0)) < 1e-12, "{}", large.outline[1].start);
    assert_eq!(large.outline[0].start, v(0.0, 0.0));
}

#[test]
fn a_line_without_corners_moves_as_a_whole_by_one_rule() {
    let mut disc = Piece::polygon("disc", &[v(1.0, 0.0), v(-1.0, 0.0)]);
    for edge in &mut disc.outline {
        edge.shape = EdgeShape::Arc { radius: 1.0, large: false, sweep: true };
        edge.smooth = true;
    }
    disc.outline[0].rule = step(0.05, 0.03);
    let large = in_size(&disc, "L");
    assert_eq!(large.outline[1].start, v(-0.95, 0.03));
    assert_eq!(large.outline[0].shape, disc.outline[0].shape);
    // Both ends apart: the half circles scale with their chord.
    disc.outline[1].rule = step(-0.05, 0.03);
    let large = in_size(&disc, "L");
    assert!((large.signed_area() - std::f64::consts::PI * 1.05 * 1.05).abs() < 1e-3);
}

#[test]
fn curves_turn_and_scale_with_their_chords() {
    let mut piece = rectangle();
    piece.outline[2].shape = EdgeShape::Cubic { controls: [v(0.4, 0.6), v(0.1, 0.6)] };
    let (base, large) = (piece.edge_length(2), in_size(&piece, "XL").edge_length(2));
    assert!((large / base - 0.52 / 0.5).abs() < 1e-7, "{large} of {base}");
}

#[test]
fn what_is_inside_follows_and_the_grain_keeps_its_direction() {
    let mut piece = rectangle();
    let square = [v(0.2, 0.3), v(0.2, 0.4), v(0.3, 0.4), v(0.3, 0.3)];
    piece.holes = vec![square.map(|start| Edge { start, ..Edge::default() }).to_vec()];
    piece.holes[0][0].rule = step(0.0, 0.001);
    piece.lines.push(InternalLine {
        edges: vec![Edge { start: v(0.1, 0.35), ..Edge::default() }],
        end: v(0.15, 0.5),
        ..InternalLine::default()
    });
    piece.lines[0].end_rule = step(0.003, 0.0);
    piece.grainline = Some([v(0.25, 0.2), v(0.25, 0.5)]);
    piece.notches.push(Notch { edge: 1, at: 0.5 });
    let large = in_size(&piece, "L");
    // The rectangle stretches by 1/50 across and 2/70 along.
    let stretched = |p: DVec2| v(p.x * 1.02, p.y * (0.72 / 0.7));
    for (i, p) in square.into_iter().enumerate() {
        let to = if i == 0 { p + v(0.0, 0.001) } else { stretched(p) };
        assert!(large.holes[0][i].start.distance(to) < 1e-12, "{i}");
    }
    assert!(large.lines[0].edges[0].start.distance(stretched(v(0.1, 0.35))) < 1e-12);
    assert!(large.lines[0].end.distance(v(0.153, 0.5)) < 1e-12);
    let [tail, head] = large.grainline.expect("a grainline");
    assert!(
        (head - tail).distance(v(0.0, 0.3)) < 1e-12
            && tail.distance(stretched(v(0.25, 0.35)) - v(0.0, 0.15)) < 1e-12
    );
    assert_eq!(large.notches, piece.notches);
}

#[test]
fn what_cannot_be_cut_is_told_with_piece_point_and_size() {
    let told = |piece: Piece, size: &str| -> Vec<String> {
        let graded = graded(&of(piece), size).expect("a size");
        graded.problems.into_iter().map(|p| format!("{}: {}", p.place, p.words)).collect()
    };
    let mut crossing = rectangle();
    crossing.outline[2].rule = step(-0.3, 0.0);
    assert!(told(crossing.clone(), "L").is_empty());
    let words = told(crossing, "XL");
    assert_eq!(
        words,
        [
            "front, point 2, size XL: the outline crosses itself: the edge from point 2 meets that from point 4"
        ]
    );
    let mut vanishing = rectangle();
    vanishing.outline[1].rule = step(-0.25, 0.0);
    vanishing.outline[2].rule = step(-0.1, 0.0);
    let words = told(vanishing, "XL");
    assert_eq!(
        words,
        ["front, point 1, size XL: the edge to point 2 vanishes: change the rules of its ends"]
    );
    let mut turned = rectangle();
    turned.outline[1].rule = step(-0.6, 0.0);
    turned.outline[2].rule = step(-0.6, 0.0);
    turned.outline[3].rule = None;
    assert!(told(turned, "L")[0].contains("inside out"));
}

#[test]
fn symmetric_pieces_stay_symmetric() {
    let mut piece = Piece::polygon(
        "yoke",
        &[v(0.0, 0.0), v(0.2, 0.05), v(0.2, 0.3), v(0.0, 0.3), v(-0.2, 0.3), v(-0.2, 0.05)],
    );
    piece.symmetric = true;
    piece.outline[0].shape = EdgeShape::Quadratic { control: v(0.1, 0.0) };
    piece.outline[5].shape = EdgeShape::Quadratic { control: v(-0.1, 0.0) };
    piece.outline[1].rule = step(0.013, 0.007);
    piece.outline[5].rule = step(-0.013, 0.007);
    piece.outline[0].smooth = true;
    for size in ["S", "L", "XL"] {
        assert!(crate::pattern::edit::is_symmetric(&in_size(&piece, size).outline), "{size}");
    }
}
