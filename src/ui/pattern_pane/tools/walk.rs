//! Items of the pattern selected by keys alone: one after the other, kind by kind, and several together.

use super::select::next;
use crate::geometry::ids::PieceId;
use crate::pattern::edit::PointRef;
use crate::pattern::{EdgeRef, Pattern};
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::pattern_pane::input::Input;
use crate::ui::pattern_pane::table::Table;
use crate::ui::selection::{Item, LineRef, Selection};

/// A kind of items.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Point,
    Edge,
    Line,
    Seam,
}

impl Kind {
    /// All kinds, in the order of Page down.
    const ALL: [Self; 4] = [Self::Point, Self::Edge, Self::Line, Self::Seam];

    fn of(item: Item) -> Option<Self> {
        match item {
            Item::Point(_) | Item::LinePoint(_) => Some(Self::Point),
            Item::Edge(_) => Some(Self::Edge),
            Item::Line(_) => Some(Self::Line),
            Item::Seam(_) => Some(Self::Seam),
            Item::Piece(_) => None,
        }
    }

    /// The items of this kind that can be selected in the shown size: outside the base size no edges, which cannot be moved there.
    fn items(self, table: &Table<'_>) -> Vec<Item> {
        match self {
            Self::Point => table.points_shown().map(|(point, _)| point.into()).collect(),
            Self::Edge if table.size().is_some() => Vec::new(),
            Self::Edge => {
                let of_piece = |piece, count| (0..count).map(move |edge| Item::Edge(EdgeRef { piece, edge }));
                table.seen().flat_map(|(id, piece, _)| of_piece(id, piece.edge_count())).collect()
            }
            Self::Line => {
                let of_piece = |piece, count| (0..count).map(move |line| Item::Line(LineRef { piece, line }));
                table.seen().flat_map(|(id, piece, _)| of_piece(id, piece.lines.len())).collect()
            }
            Self::Seam => {
                let seen = table.threads.all().filter(|(_, ends)| ends.is_seen(table.pattern()));
                seen.map(|(id, _)| Item::Seam(id)).collect()
            }
        }
    }
}

/// The items that were selected by keys.
#[derive(Debug, Default)]
pub struct Walk {
    /// The item that was selected last.
    at: Option<Item>,
    /// Items that stay selected beside it.
    kept: Selection,
}

impl Walk {
    /// Handles the keys of a frame: Tab selects the next item of a kind, Page down the nearest of the next kind, Space keeps what is
    /// selected while others are, or no longer.
    pub fn step(&mut self, table: &Table<'_>, input: &Input, asks: &mut Asks) {
        if (input.next, input.next_kind, input.keeps) == (0, 0, false) {
            return;
        }
        let selection = table.laid.selection;
        if self.shown(selection).is_none() {
            *self = Self { at: last(selection), kept: Selection::default() };
        }
        if let Some(at) = self.at.filter(|_| input.keeps) {
            self.kept.toggle(at);
        }
        let kind = self.at.and_then(Kind::of).unwrap_or(Kind::Point);
        let to = match input.next_kind {
            0 if input.next == 0 => self.at,
            0 => next(&kind.items(table), self.at, input.next),
            step => self.of_next_kind(table, kind, step),
        };
        if to.is_some() {
            self.at = to;
            asks.push(Ask::Pick(self.selected()));
        }
    }

    /// The item that was selected last, if `selection` is still what was selected by keys.
    pub fn shown(&self, selection: &Selection) -> Option<Item> {
        self.at.filter(|_| self.selected() == *selection)
    }

    fn selected(&self) -> Selection {
        let mut selected = self.kept.clone();
        if let Some(at) = self.at.filter(|&at| !selected.has(at)) {
            selected.toggle(at);
        }
        selected
    }

    /// The item nearest to the present one of the next kind that has any, or of the previous one (`step` negative).
    fn of_next_kind(&self, table: &Table<'_>, kind: Kind, step: i32) -> Option<Item> {
        let count = Kind::ALL.len() as i32;
        let kinds = (1..count).map(|i| (kind as i32 + i * step.signum()).rem_euclid(count));
        let all = kinds.map(|i| Kind::ALL[i as usize].items(table)).find(|all| !all.is_empty())?;
        let pieces = self.at.map(|at| pieces_of(table.pattern(), at)).unwrap_or_default();
        let on_piece =
            |item: &Item| pieces_of(table.pattern(), *item).iter().any(|piece| pieces.contains(piece));
        let twin = self.at.and_then(twin).filter(|twin| all.contains(twin));
        twin.or_else(|| all.iter().copied().find(on_piece)).or_else(|| all.first().copied())
    }
}

/// The edge that begins at a point, and the point at which an edge begins.
fn twin(item: Item) -> Option<Item> {
    match item {
        Item::Point(PointRef { piece, point }) => Some(Item::Edge(EdgeRef { piece, edge: point })),
        Item::Edge(EdgeRef { piece, edge }) => Some(Item::Point(PointRef { piece, point: edge })),
        _ => None,
    }
}

/// The pieces that an item is on.
fn pieces_of(pattern: &Pattern, item: Item) -> Vec<PieceId> {
    match item {
        Item::Seam(id) => {
            pattern.seams.get(&id).map(|seam| seam.sides.map(|side| side.piece).to_vec()).unwrap_or_default()
        }
        item => Selection::of(item).pieces_touched().into_iter().collect(),
    }
}

/// The last item of a selection.
fn last(selection: &Selection) -> Option<Item> {
    let point = selection.all_points().last().map(Item::from);
    let edge = || selection.edges.last().map(|&edge| Item::Edge(edge));
    let line = || selection.lines.last().map(|&line| Item::Line(line));
    let seam = || selection.seams.last().map(|&seam| Item::Seam(seam));
    point.or_else(edge).or_else(line).or_else(seam)
}
