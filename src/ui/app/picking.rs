//! The selection in the pattern: how it changes, and how commands change the selected items.

use std::sync::Arc;

use crate::geometry::ids::{PieceId, PinId};
use crate::pattern::Pattern;
use crate::pattern::edit::PatternEdit;
use crate::session::{Command, Document};
use crate::sim::ClothPlace;
use crate::ui::actions::Action;
use crate::ui::app::App;
use crate::ui::pattern_pane::{Fit, edits};
use crate::ui::selection::{Item, LineRef, Selection};

/// The selection, and the pattern it refers to.
#[derive(Debug, Default)]
pub struct Picks {
    /// The selected items.
    pub selection: Selection,
    /// The place that is marked by a ring, on the selected piece.
    pub spot: Option<ClothPlace>,
    of: Arc<Pattern>,
}

impl Picks {
    /// Items drawn emphasised: selected edges, lines and seams, and the edge or seam under the pointer.
    pub fn standing_out(&self, highlight: Option<Item>) -> Vec<Item> {
        let Selection { edges, lines, seams, .. } = &self.selection;
        let chosen = edges.iter().map(|&edge| Item::Edge(edge)).chain(seams.iter().map(|&id| Item::Seam(id)));
        let chosen = chosen.chain(lines.iter().map(|&line| Item::Line(line)));
        let near = highlight.filter(|item| matches!(item, Item::Edge(_) | Item::Seam(_)));
        chosen.chain(near).collect()
    }
}

impl App {
    /// Updates the selection after the pattern changed: items that no longer exist are removed.
    pub(in crate::ui) fn carry_selection(&mut self, document: &Document) {
        let old = std::mem::replace(&mut self.picks.of, Arc::clone(&document.pattern));
        self.picks.selection.carried(&old, &document.pattern);
        self.picks.selection.pins.retain(|&id| document.pins.iter().any(|pin| pin.id == id));
    }

    /// The item under the pointer, in either pane.
    pub fn highlight(&self) -> Option<Item> {
        let pattern = &self.picks.of;
        self.pattern_pane.under.or(self.scene_pane.under).filter(|item| item.is_in(pattern))
    }

    /// Selects these items, and no mark.
    pub(in crate::ui) fn pick(&mut self, selection: Selection) {
        if !selection.is_empty() {
            self.selected = None;
        }
        self.picks.selection = selection;
        self.picks.spot = None;
    }

    /// Applies `command` and selects the pieces, seams and internal lines that it adds; pieces out of view are brought into it.
    pub(in crate::ui) fn apply_and_select(&mut self, command: Command) {
        let is_edit = matches!(command, Command::EditPattern { .. });
        let drawn_on = drawn_on(&command);
        let before = Arc::clone(&self.session.document().pattern);
        self.apply(command);
        let after = &self.session.document().pattern;
        if !is_edit || Arc::ptr_eq(&before, after) {
            return;
        }
        let pieces = after.pieces.keys().filter(|id| !before.pieces.contains_key(id)).copied();
        let mut new = Selection::of_pieces(pieces);
        if new.is_empty() {
            new.seams.extend(after.seams.keys().filter(|id| !before.seams.contains_key(id)));
            let count = |of: &Pattern, id: &PieceId| of.pieces.get(id).map_or(0, |piece| piece.lines.len());
            let more = drawn_on.into_iter().filter(|id| count(after, id) > count(&before, id));
            new.lines.extend(more.map(|piece| LineRef { piece, line: count(after, &piece) - 1 }));
        } else {
            self.pattern_pane.show = Some(Fit::Added);
        }
        if !new.is_empty() {
            self.picks = Picks { selection: new, spot: None, of: Arc::clone(after) };
            self.selected = None;
        }
    }

    /// Applies `action` to the selection.
    pub(in crate::ui) fn change_pattern(&mut self, action: Action) {
        let pattern = Arc::clone(&self.session.document().pattern);
        if action == Action::AddBow {
            return self.ask_bow();
        }
        if action == Action::SelectAll {
            return self.pick(Selection::all(&pattern));
        }
        let pins: Vec<PinId> = self.picks.selection.pins.iter().copied().collect();
        if !pins.is_empty() {
            let all = &self.session.document().pins;
            let locked = !all.iter().all(|pin| pin.locked || !pins.contains(&pin.id));
            return match action {
                Action::Delete => self.apply(Command::DeletePins { pins }),
                Action::ToggleLock => self.apply(Command::LockPins { pins, locked }),
                _ => {}
            };
        }
        let edits = edits::edits(action, &pattern, &self.picks.selection);
        if !edits.is_empty() {
            self.apply_and_select(Command::EditPattern { edits, anew: false });
        }
    }
}

/// The pieces that `command` draws an internal line on.
fn drawn_on(command: &Command) -> Vec<PieceId> {
    let Command::EditPattern { edits, .. } = command else { return Vec::new() };
    let piece = |edit: &PatternEdit| match edit {
        PatternEdit::AddLine { piece, .. } => Some(*piece),
        _ => None,
    };
    edits.iter().filter_map(piece).collect()
}
