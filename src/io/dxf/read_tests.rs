use super::*;
use crate::io::dxf::write;
use crate::pattern::{Notch, Pattern, Piece};

/// A block of a name with a square of `size` units on `layer`, and more.
fn block(name: &str, layer: u32, size: f64, more: &str) -> String {
    let corners = [(0.0, 0.0), (size, 0.0), (size, size), (0.0, size)];
    let vertices: String =
        corners.iter().map(|(x, y)| format!("0\nVERTEX\n8\n{layer}\n10\n{x}\n20\n{y}\n")).collect();
    format!(
        "0\nBLOCK\n8\n0\n2\n{name}\n70\n0\n10\n0\n20\n0\n0\nPOLYLINE\n8\n{layer}\n66\n1\n70\n1\n{vertices}0\nSEQEND\n{more}0\nENDBLK\n"
    )
}

fn text(words: &str) -> String {
    format!("0\nTEXT\n8\n1\n10\n0\n20\n0\n40\n5\n1\n{words}\n")
}

fn file(blocks: &str, entities: &str) -> String {
    format!(
        "0\nSECTION\n2\nBLOCKS\n{blocks}0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n"
    )
}

fn good(text: &str) -> ReadPattern {
    read(text.as_bytes(), None).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

fn bad(text: &str, unit: Option<DrawingUnit>) -> String {
    read(text.as_bytes(), unit).expect_err(text).to_string()
}

/// Width of the only piece, metres.
fn width(read: &ReadPattern) -> f64 {
    let piece = read.pattern.pieces.values().next().expect("a piece");
    let (lower, upper) = trace::contour::Contour::new(piece.flattened(1e-5)).bounds();
    (upper - lower).x
}

#[test]
fn units_are_those_said() {
    let with = |words: &str, size: f64| file(&block("A", 1, size, ""), &text(words));
    assert!((width(&good(&with("UNITS: METRIC", 300.0))) - 0.3).abs() < 1e-9);
    assert!((width(&good(&with("Units: English", 20.0))) - 0.508).abs() < 1e-9);
    // Nothing said, and only one unit makes a garment of it.
    let silent = good(&file(&block("A", 1, 1000.0, ""), ""));
    assert!((width(&silent) - 1.0).abs() < 1e-9);
    assert!(silent.notes[0].contains("taken to be in millimetres"), "{:?}", silent.notes);
}

#[test]
fn doubtful_units_are_asked_for() {
    let text_of = |words: &str, size: f64| file(&block("A", 1, size, ""), &text(words));
    let doubt = bad(&text_of("UNITS: METRIC", 60.0), None);
    assert!(doubt.contains("cm (the largest piece is 60.0 × 60.0 cm)"), "{doubt}");
    let doubt = bad(&text_of("UNITS: ENGLISH", 600.0), None);
    assert!(doubt.contains("says inches") && doubt.contains("mm (the largest"), "{doubt}");
    let Err(PatternFileError::Scale(question)) = read(text_of("", 50.0).as_bytes(), None) else {
        panic!("asked")
    };
    assert_eq!(question.candidates, [DrawingUnit::Centimetre, DrawingUnit::Inch]);
    let told = read(text_of("UNITS: METRIC", 60.0).as_bytes(), Some(DrawingUnit::Inch)).expect("a pattern");
    assert!((width(&told) - 60.0 * 0.0254).abs() < 1e-9);
}

#[test]
fn cut_and_seam_line_are_told_apart() {
    let seam = "0\nPOLYLINE\n8\n14\n66\n1\n70\n1\n".to_owned()
        + &[(10, 10), (290, 10), (290, 290), (10, 290)]
            .map(|(x, y)| format!("0\nVERTEX\n8\n14\n10\n{x}\n20\n{y}\n"))
            .concat()
        + "0\nSEQEND\n";
    for seam in [seam.clone(), seam.replace("8\n14\n", "8\n8\n")] {
        let read = good(&file(&block("A", 1, 300.0, &seam), ""));
        let piece = read.pattern.pieces.values().next().expect("a piece");
        assert!((width(&read) - 0.28).abs() < 1e-9);
        assert_eq!((piece.cut_line.len(), piece.allowance), (4, 0.01));
    }
}

#[test]
fn names_come_from_texts_and_blocks_of_one_name_are_all_read() {
    let named = block("B1", 1, 200.0, &text("PIECE NAME: Front \\U+00E9"));
    let all = named + &block("B2", 1, 300.0, "") + &block("B2", 1, 250.0, "");
    let inserts: String = ["B1", "B2", "B2"]
        .iter()
        .enumerate()
        .map(|(i, b)| format!("0\nINSERT\n8\n1\n2\n{b}\n10\n{}\n20\n0\n", i * 400))
        .collect();
    let read = good(&file(&all, &inserts));
    let names: Vec<&str> = read.pattern.pieces.values().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["Front é", "B2", "B2 2"]);
    let left: Vec<f64> = read.pattern.pieces.values().map(|p| p.pose.offset.x).collect();
    assert!((left[2] - left[1] - 0.375).abs() < 1e-9, "{left:?}");
}

#[test]
fn shift_jis_names_are_read() {
    let header = "0\nSECTION\n2\nHEADER\n9\n$DWGCODEPAGE\n3\nANSI_932\n0\nENDSEC\n";
    let body = file(&block("A", 1, 600.0, &text("PIECE NAME: NAME")), "");
    let mut bytes = (header.to_owned() + &body).into_bytes();
    let at = bytes
        .windows(5)
        .position(|w| w == b" NAME\n")
        .or(bytes.windows(6).position(|w| w == b" NAME\n"))
        .expect("it")
        + 1;
    let at = bytes[at..].windows(5).position(|w| w == b"NAME\n").map_or(at, |i| at + i);
    bytes.splice(at..at + 4, [0x91, 0x4f]);
    let read = read(&bytes, None).expect("a pattern");
    assert_eq!(read.pattern.pieces.values().next().expect("a piece").name, "前");
}

#[test]
fn blocks_without_end_are_refused() {
    let inside = |name: &str| format!("0\nINSERT\n8\n1\n2\n{name}\n10\n0\n20\n0\n");
    let round = block("A", 1, 300.0, &inside("B")) + &block("B", 1, 300.0, &inside("A"));
    assert!(bad(&file(&round, &inside("A")), None).contains("without end"));
    let array = inside("A") + "70\n30000\n71\n30000\n";
    assert!(bad(&file(&block("A", 1, 300.0, ""), &array), None).contains("inserted 900000000 times"));
}

#[test]
fn bulges_are_arcs() {
    let text = file(&block("A", 1, 300.0, ""), "").replacen("10\n300\n20\n0\n", "10\n300\n20\n0\n42\n1\n", 1);
    let read = good(&text);
    let piece = read.pattern.pieces.values().next().expect("a piece");
    let half_disc = std::f64::consts::PI * 0.15 * 0.15 / 2.0;
    assert!((piece.signed_area() - 0.09 - half_disc).abs() < 1e-4, "{}", piece.signed_area());
}

/// A piece with everything the format holds goes out and in again unchanged.
#[test]
fn a_full_piece_comes_back() {
    let p = |x: f64, y: f64| DVec2::new(x, y);
    let mut piece = Piece::polygon("Rücken (links)", &[p(0.0, 0.0), p(0.4, 0.0), p(0.42, 0.5), p(0.1, 0.55)]);
    piece.outline[1].shape = EdgeShape::Cubic { controls: [p(0.35, 0.2), p(0.45, 0.3)] };
    piece.outline[2].shape = EdgeShape::Arc { radius: 0.3, large: false, sweep: false };
    piece.outline[3].shape = EdgeShape::Cubic { controls: [p(0.05, 0.4), p(-0.02, 0.2)] };
    piece.outline[2].smooth = true;
    piece.holes.push(
        [p(0.1, 0.1), p(0.15, 0.1), p(0.15, 0.2)].map(|start| Edge { start, ..Edge::default() }).to_vec(),
    );
    piece.lines.push(crate::pattern::InternalLine {
        edges: vec![Edge { start: p(0.2, 0.1), ..Edge::default() }],
        end: p(0.2, 0.3),
        name: String::new(),
        ..crate::pattern::InternalLine::default()
    });
    piece.notches = vec![Notch { edge: 1, at: 0.3 }, Notch { edge: 3, at: 0.7 }];
    piece.grainline = Some([p(0.25, 0.1), p(0.25, 0.4)]);
    piece.allowance = 0.01;
    let mut pattern = Pattern::default();
    let id = pattern.add_piece(piece);
    let once = good(std::str::from_utf8(&write(&pattern).bytes).expect("ASCII")).pattern;
    assert!(write(&pattern).left_out.is_empty(), "{:?}", write(&pattern).left_out);
    assert!(!write(&pattern).bytes.windows(3).any(|w| w == b"$TD"), "no time of day");
    let written = write(&once);
    let twice = good(std::str::from_utf8(&written.bytes).expect("ASCII")).pattern;
    for (first, again) in [(&pattern, &once), (&once, &twice)] {
        let (a, b) = (&first.pieces[&id], &again.pieces[&id]);
        assert_eq!((a.name.as_str(), a.outline.len()), (b.name.as_str(), b.outline.len()));
        let shift = a.outline[0].start - b.outline[0].start;
        let near = |q: DVec2, r: DVec2| assert!(q.distance(r + shift) < 1e-6, "{q} {r}");
        for i in 0..a.edge_count() {
            let fractions = [0.0, 0.3, 0.6, 1.0];
            for (q, r) in a.edge_points(i, &fractions).into_iter().zip(b.edge_points(i, &fractions)) {
                near(q, r);
            }
            assert_eq!(a.edge(i).smooth, b.edge(i).smooth);
        }
        near(a.lines[0].end, b.lines[0].end);
        near(a.grainline.expect("grain")[1], b.grainline.expect("grain")[1]);
        for (m, n) in a.notches.iter().zip(&b.notches) {
            assert!(m.edge == n.edge && (m.at - n.at).abs() < 1e-4, "{m:?} {n:?}");
        }
        assert_eq!(b.allowance, 0.01);
    }
    let lengths = |pattern: &Pattern| -> f64 {
        let edges = &pattern.pieces[&id].cut_line;
        crate::pattern::piece::flattened_loop(edges, 1e-5).len() as f64
    };
    assert_eq!(lengths(&once), lengths(&twice));
}

/// Rules go out as numbers at their points and a table beside, and come in again, whatever way the piece lies.
#[test]
fn grade_rules_come_back_with_their_table() {
    use crate::io::rul;
    use crate::pattern::grading::{READY_SIZES, graded};
    use crate::pattern::{GradeRule, PlanePose};
    let p = |x: f64, y: f64| DVec2::new(x, y);
    let sizes = READY_SIZES[0].run();
    let rule = |x: f64, y: f64| Some(GradeRule::even(p(x, y), sizes.len(), sizes.base));
    for (rotation, flipped) in [(0.0, false), (std::f64::consts::FRAC_PI_2, false), (0.4, true)] {
        let mut piece = Piece::polygon("front", &[p(0.0, 0.0), p(0.3, 0.0), p(0.3, 0.5), p(0.0, 0.5)]);
        piece.outline[1].rule = rule(0.01, 0.0);
        piece.outline[2].rule = rule(0.01, 0.005);
        piece.lines.push(crate::pattern::InternalLine {
            edges: vec![Edge { start: p(0.1, 0.1), ..Edge::default() }],
            end: p(0.1, 0.3),
            end_rule: rule(0.0, 0.005),
            ..crate::pattern::InternalLine::default()
        });
        piece.pose = PlanePose { offset: p(0.2, 0.1), rotation, flipped };
        let mut pattern = Pattern { sizes: sizes.clone(), ..Pattern::default() };
        let id = pattern.add_piece(piece);
        let written = write(&pattern);
        assert!(written.left_out.is_empty(), "{:?}", written.left_out);
        let table = rul::read(&written.rules.expect("a table")).expect("a sound table");
        assert_eq!((table.rules.len(), &table.sizes), (3, &sizes));
        let read = read_with_rules(&written.bytes, None, Some(&table)).expect("a pattern");
        assert!(read.notes.is_empty(), "{:?}", read.notes);
        assert_eq!(read.pattern.sizes, sizes);
        for size in ["XS", "L", "XXL"] {
            let [was, is] = [&pattern, &read.pattern]
                .map(|pattern| graded(pattern, size).expect("a size").pattern.pieces[&id].clone());
            assert!((was.signed_area().abs() - is.signed_area().abs()).abs() < 1e-7, "{size} {rotation}");
            let length = |piece: &Piece| piece.lines[0].edges[0].start.distance(piece.lines[0].end);
            assert!((length(&was) - length(&is)).abs() < 1e-6, "{size} {rotation}");
        }
        let read = super::read(&written.bytes, None).expect("a pattern without its table");
        assert!(read.pattern.sizes.is_empty());
    }
}
