use super::*;
use crate::io::svg::write;

fn file(root: &str, body: &str) -> String {
    format!("<svg xmlns=\"http://www.w3.org/2000/svg\" {root}>{body}</svg>")
}

const MILLIMETRES: &str = r#"width="800mm" height="600mm" viewBox="0 0 800 600""#;

fn good(text: &str) -> ReadPattern {
    read(text.as_bytes(), None).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

fn bad(text: &str, expected: &str) {
    let error = read(text.as_bytes(), None).expect_err(expected).to_string();
    assert!(error.contains(expected), "expected {expected:?}, got {error:?}");
}

fn area(read: &ReadPattern, i: usize) -> f64 {
    read.pattern.pieces.values().nth(i).expect("a piece").signed_area()
}

#[test]
fn units_are_taken_from_the_root() {
    let square = r#"<path d="M 0 0 H 300 V 300 H 0 Z"/>"#;
    assert!((area(&good(&file(MILLIMETRES, square)), 0) - 0.09).abs() < 1e-7);
    let inches = r#"width="30in" height="30in" viewBox="0 0 900 900""#;
    assert!((area(&good(&file(inches, square)), 0) - 0.254 * 0.254).abs() < 1e-7);
}

#[test]
fn sizes_that_are_not_said_are_asked_for() {
    let square = r#"<path id="back" d="M 0 0 H 600 V 600 H 0 Z"/>"#;
    for root in ["", r#"width="100%" height="100%""#, r#"viewBox="0 0 9 9""#, r#"width="800" height="800px""#]
    {
        let Err(PatternFileError::Scale(question)) = read(file(root, square).as_bytes(), None) else {
            panic!("{root}: asked")
        };
        assert_eq!(question.candidates[..2], [DrawingUnit::Millimetre, DrawingUnit::Pixel], "{root}");
        let told = read(file(root, square).as_bytes(), Some(DrawingUnit::Millimetre)).expect("a pattern");
        assert!((area(&told, 0) - 0.36).abs() < 1e-6, "{root}: {}", area(&told, 0));
    }
    let crooked = r#"width="800mm" height="500mm" viewBox="0 0 800 600""#;
    bad(&file(crooked, square), "different scales; its unit may be mm (the largest piece is 60.0 × 60.0 cm)");
    let old = format!(
        "xmlns:inkscape=\"http://www.inkscape.org/namespaces/inkscape\" inkscape:version=\"0.48.4\" {}",
        r#"width="800" height="800""#
    );
    bad(&file(&old, square), "its unit may be px90");
    bad(&file(r#"width="0mm" height="5mm""#, square), "the width \"0mm\" is no size");
    bad(&file(r#"width="1e30mm" height="5mm""#, square), "is no size");
    bad(&file(r#"viewBox="0 0 -5 5""#, square), "is no box");
}

#[test]
fn lines_are_told_by_what_lies_in_what() {
    let body = r#"<g id="front"><path d="M 0 0 H 300 V 400 H 0 Z M 10 10 V 390 H 290 V 10 Z M 100 100 H 150 V 150 Z"/>
        <path d="M 20 300 H 280"/></g><rect id="pocket" x="500" y="100" width="100" height="120"/>"#;
    let read = good(&file(MILLIMETRES, body));
    let pieces: Vec<_> = read.pattern.pieces.values().collect();
    assert_eq!((pieces[0].name.as_str(), pieces[1].name.as_str()), ("front", "pocket"));
    assert!((pieces[0].signed_area() - 0.28 * 0.38).abs() < 1e-6);
    assert_eq!((pieces[0].cut_line.len(), pieces[0].holes.len(), pieces[0].lines.len()), (4, 1, 1));
    assert_eq!(pieces[0].allowance, 0.01);
}

#[test]
fn arcs_and_references_are_resolved() {
    let body = r##"<defs><circle id="disc" r="100"/></defs><use href="#disc" x="200" y="300"/>
        <path d="M 400 200 h 200 a 100 100 0 0 1 -200 0 z"/>"##;
    let read = good(&file(MILLIMETRES, body));
    let kinds: Vec<usize> = read.pattern.pieces.values().map(|p| p.outline.len()).collect();
    assert_eq!(kinds, [2, 2], "half circles");
    assert!((area(&read, 0) - 0.01 * std::f64::consts::PI).abs() < 1e-4);
    assert!((area(&read, 1) - 0.005 * std::f64::consts::PI).abs() < 1e-4);
}

#[test]
fn bombs_are_refused() {
    let deep = "<g>".repeat(300) + &"</g>".repeat(300);
    bad(&file(MILLIMETRES, &deep), "nested more than 200 deep");
    let mut uses = "<rect id=\"a0\" width=\"9\" height=\"9\"/>".to_owned();
    for i in 1..20 {
        uses += &format!("<g id=\"a{i}\">{}</g>", format!("<use href=\"#a{}\"/>", i - 1).repeat(10));
    }
    bad(&file(MILLIMETRES, &uses), "with all references");
    bad(&file(MILLIMETRES, "<g id=\"a\"><use href=\"#a\"/></g>"), "without end");
    let chain: String =
        (0..1000).map(|i| format!("<g id=\"c{i}\"><use href=\"#c{}\"/></g>", i + 1)).collect();
    bad(&file(MILLIMETRES, &chain), "inside each other");
    let entity = "<!DOCTYPE svg [<!ENTITY a \"<g><g/></g>\">]>".to_owned() + &file(MILLIMETRES, "&a;");
    bad(&entity, "entities that hold elements");
}

#[test]
fn faults_of_paths_are_told() {
    let body = r#"<path id="sleeve" d="M 0 0 H 300 V 300 H 0 Z M 5 NaN L 7 7"/><path d="M 3 3"/>"#;
    let read = good(&file(MILLIMETRES, body));
    assert!(read.notes.iter().any(|n| n.starts_with("sleeve: its data has a fault")), "{:?}", read.notes);
    bad(&file(MILLIMETRES, "<path d=\"M NaN 0 L 1 1 Z\"/>"), "there is no closed line in it");
}

#[test]
fn a_full_piece_comes_back() {
    use crate::pattern::{InternalLine, Notch, Pattern, Piece};
    let p = |x: f64, y: f64| DVec2::new(x, y);
    let mut piece = Piece::polygon("Rücken & <Co>", &[p(0.0, 0.0), p(0.4, 0.0), p(0.42, 0.5), p(0.1, 0.55)]);
    piece.outline[1].shape = EdgeShape::Quadratic { control: p(0.35, 0.2) };
    piece.outline[2].shape = EdgeShape::Arc { radius: 0.3, large: false, sweep: false };
    piece.outline[3].shape = EdgeShape::Cubic { controls: [p(0.05, 0.4), p(-0.02, 0.2)] };
    piece.outline[2].smooth = true;
    piece.holes.push(
        [p(0.1, 0.1), p(0.15, 0.1), p(0.15, 0.2)].map(|start| Edge { start, ..Edge::default() }).to_vec(),
    );
    let edge = Edge { start: p(0.2, 0.1), ..Edge::default() };
    piece.lines.push(InternalLine {
        edges: vec![edge],
        end: p(0.2, 0.3),
        name: "pocket".to_owned(),
        ..InternalLine::default()
    });
    piece.notches = vec![Notch { edge: 1, at: 0.3 }, Notch { edge: 3, at: 0.7 }];
    piece.grainline = Some([p(0.25, 0.1), p(0.25, 0.4)]);
    piece.allowance = 0.01;
    let mut pattern = Pattern::default();
    let id = pattern.add_piece(piece);
    let written = write(&pattern);
    assert!(written.left_out.is_empty(), "{:?}", written.left_out);
    let again = good(std::str::from_utf8(&written.bytes).expect("text")).pattern;
    let (a, b) = (&pattern.pieces[&id], &again.pieces[&id]);
    assert_eq!((a.name.as_str(), a.outline.len()), (b.name.as_str(), b.outline.len()));
    let shift = a.outline[0].start - b.outline[0].start;
    for i in 0..a.edge_count() {
        let fractions = [0.0, 0.3, 0.6, 1.0];
        for (q, r) in a.edge_points(i, &fractions).into_iter().zip(b.edge_points(i, &fractions)) {
            assert!(q.distance(r + shift) < 1e-6, "edge {i}: {q} {r}");
        }
        assert_eq!(a.edge(i).smooth, b.edge(i).smooth, "edge {i}");
    }
    assert_eq!(b.lines[0].name, "pocket");
    for (m, n) in a.notches.iter().zip(&b.notches) {
        assert!(m.edge == n.edge && (m.at - n.at).abs() < 1e-5, "{m:?} {n:?}");
    }
    assert!(a.grainline.expect("grain")[1].distance(b.grainline.expect("grain")[1] + shift) < 1e-6);
    assert_eq!(b.allowance, 0.01);
}
