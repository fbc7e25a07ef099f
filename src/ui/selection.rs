//! The selection and the hovered item of the pattern. Both panes show them; they are not part of the document.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::geometry::ids::{PieceId, PinId, SeamId};
use crate::pattern::edit::{LinePoint, PointRef};
use crate::pattern::{EdgeRef, Pattern, RulePoint};
use crate::ui::language::counted;

/// A reference to an internal line of a piece, by its index from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct LineRef {
    /// The piece.
    pub piece: PieceId,
    /// Index of the line.
    pub line: usize,
}

/// The selection. Kinds of items may be mixed; each tool uses those of its kind.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Selection {
    /// Whole pieces.
    pub pieces: BTreeSet<PieceId>,
    /// Points of outlines and holes.
    pub points: BTreeSet<PointRef>,
    /// Edges of outlines and holes.
    pub edges: BTreeSet<EdgeRef>,
    /// Lines drawn inside pieces.
    pub lines: BTreeSet<LineRef>,
    /// Points of lines drawn inside pieces.
    pub line_points: BTreeSet<LinePoint>,
    /// Seams.
    pub seams: BTreeSet<SeamId>,
    /// Pins in the dressed cloth. Pins and items of the pattern are never selected together.
    pub pins: BTreeSet<PinId>,
}

/// An item of the pattern.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Item {
    Piece(PieceId),
    Point(PointRef),
    Edge(EdgeRef),
    Line(LineRef),
    LinePoint(LinePoint),
    Seam(SeamId),
}

impl From<RulePoint> for Item {
    fn from(RulePoint { piece, line, point }: RulePoint) -> Self {
        match line {
            None => Self::Point(PointRef { piece, point }),
            Some(line) => Self::LinePoint(LinePoint { piece, line, point }),
        }
    }
}

impl Item {
    /// Whether `pattern` contains the item.
    pub fn is_in(self, pattern: &Pattern) -> bool {
        let edge = |piece: PieceId, i: usize| pattern.pieces.get(&piece).is_some_and(|p| i < p.edge_count());
        match self {
            Self::Piece(piece) => pattern.pieces.contains_key(&piece),
            Self::Point(PointRef { piece, point }) => edge(piece, point),
            Self::Edge(EdgeRef { piece, edge: i }) => edge(piece, i),
            Self::Line(LineRef { piece, line }) => {
                pattern.pieces.get(&piece).is_some_and(|p| line < p.lines.len())
            }
            Self::LinePoint(at) => {
                pattern.pieces.get(&at.piece).is_some_and(|piece| piece.place_of(&at.into()).is_some())
            }
            Self::Seam(seam) => pattern.seams.contains_key(&seam),
        }
    }
}

impl Selection {
    /// A selection of a single item.
    pub fn of(item: Item) -> Self {
        let mut selection = Self::default();
        selection.toggle(item);
        selection
    }

    /// A selection of these pieces.
    pub fn of_pieces(pieces: impl IntoIterator<Item = PieceId>) -> Self {
        Self { pieces: pieces.into_iter().collect(), ..Self::default() }
    }

    /// Whether nothing is selected.
    pub fn is_empty(&self) -> bool {
        let Self { pieces, points, edges, lines, line_points, seams, pins } = self;
        let outlines = pieces.is_empty() && points.is_empty() && edges.is_empty();
        outlines && lines.is_empty() && line_points.is_empty() && seams.is_empty() && pins.is_empty()
    }

    /// The selected item of the pattern, if it is the only one.
    pub fn only(&self) -> Option<Item> {
        let Self { pieces, points, edges, lines, line_points, seams, pins: _ } = self;
        let pieces = pieces.iter().map(|&id| Item::Piece(id));
        let points = points.iter().map(|&id| Item::Point(id));
        let edges = edges.iter().map(|&id| Item::Edge(id));
        let lines = lines.iter().map(|&id| Item::Line(id));
        let line_points = line_points.iter().map(|&id| Item::LinePoint(id));
        let seams = seams.iter().map(|&id| Item::Seam(id));
        let mut all = pieces.chain(points).chain(edges).chain(lines).chain(line_points).chain(seams);
        all.next().filter(|_| all.next().is_none())
    }

    /// Whether `item` is selected.
    pub fn has(&self, item: Item) -> bool {
        match item {
            Item::Piece(id) => self.pieces.contains(&id),
            Item::Point(id) => self.points.contains(&id),
            Item::Edge(id) => self.edges.contains(&id),
            Item::Line(id) => self.lines.contains(&id),
            Item::LinePoint(id) => self.line_points.contains(&id),
            Item::Seam(id) => self.seams.contains(&id),
        }
    }

    /// Adds `item` to the selection, or removes it.
    pub fn toggle(&mut self, item: Item) {
        fn flip<T: Ord>(set: &mut BTreeSet<T>, x: T) {
            if !set.remove(&x) {
                set.insert(x);
            }
        }
        match item {
            Item::Piece(id) => flip(&mut self.pieces, id),
            Item::Point(id) => flip(&mut self.points, id),
            Item::Edge(id) => flip(&mut self.edges, id),
            Item::Line(id) => flip(&mut self.lines, id),
            Item::LinePoint(id) => flip(&mut self.line_points, id),
            Item::Seam(id) => flip(&mut self.seams, id),
        }
    }

    /// The selection after a click on `item`: the item alone, or with `add` (Shift) the item added or removed.
    pub fn clicked(&self, item: Option<Item>, add: bool) -> Self {
        match item {
            None if add => self.clone(),
            None => Self::default(),
            Some(item) if add => {
                let mut new = Self { pins: BTreeSet::new(), ..self.clone() };
                new.toggle(item);
                new
            }
            Some(item) => Self::of(item),
        }
    }

    /// The selection after a click on a pin: the pin alone, or with `add` (Shift) the pin added or removed.
    pub fn clicked_pin(&self, pin: PinId, add: bool) -> Self {
        let mut pins = if add { self.pins.clone() } else { BTreeSet::new() };
        if !pins.remove(&pin) {
            pins.insert(pin);
        }
        Self { pins, ..Self::default() }
    }

    /// Selected pieces, and the pieces of selected points, edges, lines and points of lines.
    pub fn pieces_touched(&self) -> BTreeSet<PieceId> {
        let points = self.points.iter().map(|p| p.piece);
        let edges = self.edges.iter().map(|e| e.piece);
        let lines = self.lines.iter().map(|l| l.piece);
        let lines = lines.chain(self.line_points.iter().map(|p| p.piece));
        self.pieces.iter().copied().chain(points).chain(edges).chain(lines).collect()
    }

    /// Selected points of closed and of internal lines.
    pub fn all_points(&self) -> impl Iterator<Item = RulePoint> {
        let closed = self.points.iter().map(|&point| point.into());
        closed.chain(self.line_points.iter().map(|&point| point.into()))
    }

    /// Internal lines that are selected or have a selected point.
    pub fn lines_touched(&self) -> BTreeSet<LineRef> {
        let of_points = self.line_points.iter().map(|&LinePoint { piece, line, .. }| LineRef { piece, line });
        self.lines.iter().copied().chain(of_points).collect()
    }

    /// A selection of everything visible.
    pub fn all(pattern: &Pattern) -> Self {
        Self::of_pieces(pattern.pieces.iter().filter(|(_, p)| !p.hidden).map(|(&id, _)| id))
    }

    /// Updates the selection when `old` becomes `new`: items that no longer exist are removed, also points and edges of pieces
    /// whose edges were renumbered.
    pub fn carried(&mut self, old: &Arc<Pattern>, new: &Arc<Pattern>) {
        if Arc::ptr_eq(old, new) {
            return;
        }
        let edges = |pattern: &Pattern, id: &PieceId| pattern.pieces.get(id).map(|p| p.edge_count());
        let same = |id: &PieceId| edges(old, id) == edges(new, id);
        self.pieces.retain(|id| Item::Piece(*id).is_in(new));
        self.points.retain(|p| same(&p.piece) && Item::Point(*p).is_in(new));
        self.edges.retain(|e| same(&e.piece) && Item::Edge(*e).is_in(new));
        let lines = |pattern: &Pattern, id: &PieceId| pattern.pieces.get(id).map(|p| p.lines.len());
        let same_lines = |id: &PieceId| lines(old, id) == lines(new, id);
        self.lines.retain(|l| same_lines(&l.piece) && Item::Line(*l).is_in(new));
        let inside = |pattern: &Pattern, at: &LinePoint| {
            pattern.pieces.get(&at.piece)?.lines.get(at.line).map(|line| line.edges.len())
        };
        self.line_points.retain(|at| {
            same_lines(&at.piece) && inside(old, at) == inside(new, at) && Item::LinePoint(*at).is_in(new)
        });
        self.seams.retain(|id| Item::Seam(*id).is_in(new));
    }

    /// The selection in words, for the status bar and screen readers.
    pub fn words(&self) -> String {
        let Self { pieces, points, edges, lines, line_points, seams, pins } = self;
        let points = points.len() + line_points.len();
        let parts = [
            (pieces.len(), counted(pieces.len(), "1 piece", "{n} pieces")),
            (edges.len(), counted(edges.len(), "1 edge", "{n} edges")),
            (points, counted(points, "1 point", "{n} points")),
            (lines.len(), counted(lines.len(), "1 line", "{n} lines")),
            (seams.len(), counted(seams.len(), "1 seam", "{n} seams")),
            (pins.len(), counted(pins.len(), "1 pin", "{n} pins")),
        ];
        let is_there = parts.into_iter().filter(|(n, _)| *n > 0);
        is_there.map(|(_, words)| words).collect::<Vec<_>>().join(", ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::Piece;
    use glam::DVec2;

    #[test]
    fn clicks_select_and_shift_adds_and_takes_away() {
        let [a, b] = [1, 2].map(|i| Item::Piece(PieceId(i)));
        let one = Selection::default().clicked(Some(a), false);
        let both = one.clicked(Some(b), true);
        assert!(both.has(a) && both.has(b));
        assert_eq!(both.words(), "2 pieces");
        assert_eq!(both.clicked(Some(b), true), one);
        assert_eq!(both.clicked(None, true), both);
        assert!(both.clicked(None, false).is_empty());
    }

    #[test]
    fn pins_are_selected_for_themselves() {
        let piece = Selection::of(Item::Piece(PieceId(1)));
        let one = piece.clicked_pin(PinId(3), true);
        assert_eq!(one.words(), "1 pin");
        let two = one.clicked_pin(PinId(4), true);
        assert_eq!(two.words(), "2 pins");
        assert_eq!(two.clicked_pin(PinId(4), true), one);
        assert_eq!(two.clicked_pin(PinId(4), false).words(), "1 pin");
        assert_eq!(two.clicked(Some(Item::Piece(PieceId(1))), true), piece);
    }

    #[test]
    fn what_is_gone_or_numbered_anew_is_not_selected() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(DVec2::from);
        let mut pattern = Pattern::default();
        let ids = [(); 2].map(|()| pattern.add_piece(Piece::polygon("p", &square)));
        let old = Arc::new(pattern.clone());
        pattern.pieces.remove(&ids[0]);
        Arc::make_mut(pattern.pieces.get_mut(&ids[1]).expect("a piece")).outline.pop();
        let mut selection = Selection::of_pieces(ids);
        selection.edges.insert(EdgeRef { piece: ids[1], edge: 0 });
        selection.carried(&old, &Arc::new(pattern));
        assert_eq!(selection, Selection::of_pieces([ids[1]]));
    }

    #[test]
    fn points_of_lines_are_selected_until_their_line_is_another() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(DVec2::from);
        let edges = vec![crate::pattern::Edge { start: DVec2::splat(0.2), ..Default::default() }];
        let line = crate::pattern::InternalLine { edges, end: DVec2::splat(0.8), ..Default::default() };
        let mut pattern = Pattern::default();
        let piece = pattern.add_piece(Piece { lines: vec![line], ..Piece::polygon("p", &square) });
        let at = |point| RulePoint { piece, line: Some(0), point };
        let mut selection = Selection::of(at(1).into());
        assert_eq!((selection.words(), selection.is_empty()), ("1 point".to_owned(), false));
        assert_eq!(selection.all_points().collect::<Vec<_>>(), [at(1)]);
        assert_eq!(selection.lines_touched(), [LineRef { piece, line: 0 }].into());
        assert_eq!(selection.pieces_touched(), [piece].into());
        assert!(Item::from(at(1)).is_in(&pattern) && !Item::from(at(2)).is_in(&pattern));
        let old = Arc::new(pattern.clone());
        let mut change = |of: fn(&mut Piece)| {
            of(Arc::make_mut(pattern.pieces.get_mut(&piece).expect("the piece")));
            selection.carried(&old, &Arc::new(pattern.clone()));
            selection.is_empty()
        };
        assert!(!change(|piece| piece.lines[0].end = DVec2::ONE), "it only moved");
        assert!(change(|piece| piece.lines.clear()));
    }
}
