use lopdf::content::Content;
use lopdf::{Document as Pdf, Object};

use super::*;
use crate::pattern::{Notch, Piece};

fn pattern() -> Pattern {
    let p = |x: f64, y: f64| DVec2::new(x, y);
    let mut piece = Piece::polygon("Rücken", &[p(0.0, 0.0), p(0.45, 0.0), p(0.45, 0.6), p(0.0, 0.55)]);
    piece.allowance = 0.01;
    piece.notches.push(Notch { edge: 1, at: 0.5 });
    piece.grainline = Some([p(0.2, 0.1), p(0.2, 0.4)]);
    let mut pattern = Pattern::default();
    pattern.add_piece(piece);
    pattern
}

/// The closed lines of four corners on a page, in millimetres of the page.
fn rectangles(pdf: &Pdf, page: lopdf::ObjectId) -> Vec<[DVec2; 4]> {
    let content = Content::decode(&pdf.get_page_content(page)).expect("operations");
    let number = |o: &Object| f64::from(o.as_float().expect("a number"));
    let mut matrix = [1.0, 0.0, 0.0, 1.0, 0.0, 0.0];
    let mut saved = Vec::new();
    let (mut points, mut found) = (Vec::new(), Vec::new());
    for operation in content.operations {
        let n: Vec<f64> = match operation.operator.as_str() {
            "cm" | "m" | "l" | "re" => operation.operands.iter().map(number).collect(),
            _ => Vec::new(),
        };
        let at = |x: f64, y: f64, m: [f64; 6]| {
            DVec2::new(m[0] * x + m[2] * y + m[4], m[1] * x + m[3] * y + m[5]) / POINTS
        };
        match operation.operator.as_str() {
            "q" => saved.push(matrix),
            "Q" => matrix = saved.pop().expect("a saved state"),
            "cm" => {
                let m = matrix;
                let along = |x: f64, y: f64| [m[0] * x + m[2] * y, m[1] * x + m[3] * y];
                let ([a, b], [c, d], [e, f]) = (along(n[0], n[1]), along(n[2], n[3]), along(n[4], n[5]));
                matrix = [a, b, c, d, e + m[4], f + m[5]];
            }
            "m" => points = vec![at(n[0], n[1], matrix)],
            "l" => points.push(at(n[0], n[1], matrix)),
            "re" => found.push(
                [(0.0, 0.0), (n[2], 0.0), (n[2], n[3]), (0.0, n[3])]
                    .map(|(x, y)| at(n[0] + x, n[1] + y, matrix)),
            ),
            "h" | "s" | "b" => {
                // Some writers repeat the first point.
                if points.len() == 5 {
                    points.pop();
                }
                found.extend(<[DVec2; 4]>::try_from(points.clone()).ok());
            }
            _ => {}
        }
    }
    found
}

/// Sides of the squares of about 50 mm, millimetres.
fn squares(bytes: &[u8]) -> Vec<f64> {
    let pdf = Pdf::load_mem(bytes).expect("a PDF");
    let pages = pdf.get_pages();
    let all = pages.values().flat_map(|&page| rectangles(&pdf, page));
    all.flat_map(|r| {
        let sides: Vec<f64> = (0..4).map(|i| r[i].distance(r[(i + 1) % 4])).collect();
        let is_square = sides.iter().all(|s| (s - 50.0).abs() < 2.0);
        if is_square { sides } else { Vec::new() }
    })
    .collect()
}

#[test]
fn the_test_square_measures_fifty_millimetres() {
    for paper in Paper::ALL {
        let written = write(&pattern(), "shirt", paper).expect("a PDF");
        let sides = squares(&written.bytes);
        assert_eq!(sides.len(), 4, "{paper}: one square");
        assert!(sides.iter().all(|s| (s - 50.0).abs() < 0.05), "{paper}: {sides:?}");
    }
}

/// 470 × 620 mm: three columns and three rows of A4, and the overview.
#[test]
fn pages_have_their_size_and_number() {
    let sizes = |paper: Paper| {
        let written = write(&pattern(), "shirt", paper).expect("a PDF");
        assert!(written.left_out.is_empty(), "{:?}", written.left_out);
        let pdf = Pdf::load_mem(&written.bytes).expect("a PDF");
        let pages: Vec<[f64; 2]> = pdf
            .get_pages()
            .values()
            .map(|&page| {
                let dictionary = pdf.get_dictionary(page).expect("a page");
                let corners = dictionary.get(b"MediaBox").and_then(Object::as_array).expect("its box");
                [2, 3].map(|i| f64::from(corners[i].as_float().expect("a number")) / POINTS)
            })
            .collect();
        pages
    };
    let a4 = sizes(Paper::A4);
    assert_eq!(a4.len(), 10);
    assert!(a4.iter().all(|[w, h]| (w - 210.0).abs() < 0.01 && (h - 297.0).abs() < 0.01), "{a4:?}");
    let letter = sizes(Paper::Letter);
    assert!((letter[0][0] - 215.9).abs() < 0.01 && (letter[0][1] - 279.4).abs() < 0.01);
    let one = sizes(Paper::One);
    assert_eq!(one.len(), 1);
    assert!((one[0][0] - (470.0 + 2.0 + 20.0)).abs() < 1.0, "{one:?}");
}

#[test]
fn what_cannot_be_printed_is_refused() {
    assert_eq!(write(&Pattern::default(), "", Paper::A4), Err(PdfError::Empty));
    let mut huge = Pattern::default();
    huge.add_piece(Piece::polygon("huge", &[DVec2::ZERO, DVec2::X * 40.0, DVec2::ONE * 40.0]));
    assert!(matches!(write(&huge, "", Paper::One), Err(PdfError::TooLarge { .. })));
    assert!(matches!(write(&huge, "", Paper::A4), Err(PdfError::TooManyPages(_))));
}
