//! Bows: asks for one at the selected place, and adds it.

use glam::DVec2;

use crate::geometry::ids::MarkId;
use crate::geometry::polygon::centroid;
use crate::pattern::edit::PatternEdit;
use crate::pattern::{Bow, Piece, PiecePoint};
use crate::session::{Command, Document};
use crate::ui::app::App;
use crate::ui::language::tr;
use crate::ui::preferences::units::LengthUnit;
use crate::ui::selection::Selection;
use crate::ui::shell::dialogs::Dialog;

/// Distance of the place from a selected edge or point of an outline, metres.
const INSET: f64 = 0.02;

impl App {
    /// Asks for the measures of a bow at the selected place; at first they are those of the last one.
    pub(in crate::ui) fn ask_bow(&mut self) {
        let Some(at) = bow_place(self.session.document(), self.selected, &self.picks.selection) else {
            return self.messages.error(tr("No place for a bow is selected."));
        };
        let unit = match self.preferences.unit {
            LengthUnit::Inch => LengthUnit::Inch,
            LengthUnit::Cm | LengthUnit::Mm => LengthUnit::Mm,
        };
        self.dialog = Some(Dialog::Bow { at, bow: self.shell.bow.unwrap_or(Bow::USUAL), unit });
    }

    /// Adds a bow and selects its pieces.
    pub(in crate::ui) fn add_bow(&mut self, at: PiecePoint, bow: Bow) {
        self.shell.bow = Some(bow);
        self.apply_and_select(Command::EditPattern {
            edits: vec![PatternEdit::AddBow { at, bow }],
            anew: false,
        });
    }
}

/// The place that is selected: the middle of a mark on the cloth, a point, the middle of a line or an edge, or that of a piece. Places on
/// an outline are moved into the cloth.
fn bow_place(document: &Document, mark: Option<MarkId>, selection: &Selection) -> Option<PiecePoint> {
    if let Some(mark) = mark.and_then(|id| document.marks.cloth.iter().find(|mark| mark.id == id)) {
        return Some(PiecePoint { piece: mark.piece, at: *mark.points.get(mark.points.len() / 2)? });
    }
    let of = |id| document.pattern.pieces.get(&id);
    if let Some(point) = selection.all_points().next() {
        let piece = of(point.piece)?;
        let at = piece.place_of(&point)?;
        let at = if point.line.is_none() { moved_in(piece, at) } else { at };
        return Some(PiecePoint { piece: point.piece, at });
    }
    if let Some(line) = selection.lines.first() {
        let points = of(line.piece)?.lines.get(line.line)?.flattened(1e-4);
        return Some(PiecePoint { piece: line.piece, at: *points.get(points.len() / 2)? });
    }
    if let Some(edge) = selection.edges.first() {
        let piece = of(edge.piece)?;
        let at = *piece.edge_points(edge.edge, &[0.5]).first()?;
        return Some(PiecePoint { piece: edge.piece, at: moved_in(piece, at) });
    }
    let piece = *selection.pieces.first()?;
    Some(PiecePoint { piece, at: centroid(&of(piece)?.flattened(1e-3))? })
}

/// The place [`INSET`] from a place of the outline towards the middle of the piece, or that middle where it is nearer.
fn moved_in(piece: &Piece, at: DVec2) -> DVec2 {
    let way = centroid(&piece.flattened(1e-3)).map_or(DVec2::ZERO, |middle| middle - at);
    at + way.clamp_length_max(INSET)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::pattern::edit::PointRef;
    use crate::pattern::{EdgeRef, Pattern};
    use crate::ui::selection::Item;
    use crate::wrap::{ClothMark, ClothSide, Marks};

    #[test]
    fn a_bow_goes_to_the_selected_mark_or_into_the_selected_piece() {
        let corners = [(0.0, 0.0), (0.4, 0.0), (0.4, 0.2), (0.0, 0.2)].map(DVec2::from);
        let mut pattern = Pattern::default();
        let piece = pattern.add_piece(Piece::polygon("front", &corners));
        let mark = ClothMark {
            id: MarkId(7),
            piece,
            side: ClothSide::Front,
            points: vec![DVec2::new(0.1, 0.1), DVec2::new(0.15, 0.1), DVec2::new(0.2, 0.1)],
        };
        let marks = Marks { cloth: vec![mark], ..Marks::default() };
        let document = Document { pattern: Arc::new(pattern), marks: Arc::new(marks), ..Document::default() };
        let check = |mark: Option<MarkId>, selection: Selection, at: (f64, f64)| {
            let found = bow_place(&document, mark, &selection).expect("a place");
            assert!(found.at.distance(DVec2::from(at)) < 1e-9, "{found:?}");
        };
        check(Some(MarkId(7)), Selection::default(), (0.15, 0.1));
        check(None, Selection::of(Item::Piece(piece)), (0.2, 0.1));
        check(None, Selection::of(Item::Edge(EdgeRef { piece, edge: 2 })), (0.2, 0.18));
        let corner = bow_place(&document, None, &Selection::of(Item::Point(PointRef { piece, point: 0 })));
        assert!((corner.expect("a place").at.length() - INSET).abs() < 1e-9);
        assert_eq!(bow_place(&document, Some(MarkId(9)), &Selection::default()), None);
    }
}
