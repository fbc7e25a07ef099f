//! A document in another size of its pattern.

use std::sync::Arc;

use crate::geometry::words::Words;
use crate::pattern::Problem;
use crate::pattern::grading::{Graded, graded};
use crate::session::document::Document;

/// Takes the pattern of `document` in the size called `size`; strokes and graphics on the pieces go along, pins go. The base
/// size changes nothing. Returns what cannot be cut in that size, in words.
///
/// # Errors
/// The pattern has no such size, in words; the document is as it was.
pub fn grade(document: &mut Document, size: &str) -> Result<Vec<Problem>, Words> {
    graded(&document.pattern, size).map(|graded| take(document, graded))
}

/// Takes `graded`, which is the pattern of `document` in one of its sizes, like [`grade`].
pub fn take(document: &mut Document, graded: Graded) -> Vec<Problem> {
    if graded.moved.is_empty() && graded.pattern == *document.pattern {
        return graded.problems;
    }
    let field = |piece| graded.moved.get(&piece);
    if document.marks.cloth.iter().any(|mark| field(mark.piece).is_some()) {
        for mark in &mut Arc::make_mut(&mut document.marks).cloth {
            if let Some(field) = field(mark.piece) {
                mark.points.iter_mut().for_each(|p| *p = field.moved(*p));
            }
        }
    }
    if document.artwork.graphics.values().any(|graphic| field(graphic.piece).is_some()) {
        for graphic in Arc::make_mut(&mut document.artwork).graphics.values_mut() {
            if let Some(field) = field(graphic.piece) {
                graphic.at = field.moved(graphic.at);
                *graphic = graphic.clamped();
            }
        }
    }
    document.drop_pins();
    document.pattern = Arc::new(graded.pattern);
    graded.problems
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::ids::{ImageId, PieceId};
    use crate::pattern::grading::READY_SIZES;
    use crate::pattern::{GradeRule, Pattern, Piece};
    use crate::session::artwork::Graphic;
    use crate::wrap::{ClothMark, ClothSide};
    use glam::DVec2;

    fn document() -> Document {
        let corners = [(0.0, 0.0), (0.4, 0.0), (0.4, 0.4), (0.0, 0.4)].map(DVec2::from);
        let mut piece = Piece::polygon("front", &corners);
        for point in [1, 2] {
            piece.outline[point].rule = Some(GradeRule::even(DVec2::X * 0.02, 6, 2));
        }
        let mut pattern = Pattern { sizes: READY_SIZES[0].run(), ..Pattern::default() };
        pattern.add_piece(piece);
        let mut document = Document { pattern: Arc::new(pattern), ..Document::default() };
        let id = document.fresh_mark();
        let points = vec![DVec2::new(0.2, 0.1), DVec2::new(0.4, 0.1)];
        let mark = ClothMark { id, piece: PieceId(1), side: ClothSide::default(), points };
        Arc::make_mut(&mut document.marks).cloth.push(mark);
        document
    }

    #[test]
    fn strokes_and_graphics_go_along() {
        let mut document = document();
        let graphic = Graphic {
            piece: PieceId(1),
            image: ImageId(1),
            at: DVec2::splat(0.1),
            width_m: 0.05,
            angle: 0.0,
            on_twin: false,
        };
        let id = crate::geometry::ids::GraphicId(2);
        Arc::make_mut(&mut document.artwork).graphics.insert(id, graphic);
        assert_eq!(grade(&mut document, "XL").expect("a size"), []);
        let near = |p: DVec2, x: f64, y: f64| assert!(p.distance(DVec2::new(x, y)) < 1e-12, "{p}");
        near(document.marks.cloth[0].points[0], 0.22, 0.1);
        near(document.marks.cloth[0].points[1], 0.44, 0.1);
        near(document.artwork.graphics[&id].at, 0.11, 0.1);
        assert_eq!(document.pattern.sizes.base_name(), "XL");
        grade(&mut document, "M").expect("back again");
        near(document.marks.cloth[0].points[0], 0.2, 0.1);
        near(document.pattern.pieces[&PieceId(1)].edge(1).start, 0.4, 0.0);
    }

    #[test]
    fn the_base_size_and_unknown_ones_change_nothing() {
        let mut same = document();
        grade(&mut same, "M").expect("the base");
        assert!(grade(&mut same, "46").expect_err("none").contains("XS, S, M"));
        assert_eq!(same, document());
    }
}
