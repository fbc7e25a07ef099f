//! Publishes the items on the table to screen readers and tests.

use egui::accesskit::{Live, Role};
use egui::{Rect, Sense, WidgetInfo, vec2};
use glam::DVec2;

use super::draw_pieces::badge_place;
use super::table::Table;
use crate::geometry::ids::PieceId;
use crate::pattern::edit::{LinePoint, PointRef};
use crate::pattern::{EdgeRef, Pattern, Seam};
use crate::ui::actions::Tool;
use crate::ui::language::say;
use crate::ui::selection::{Item, LineRef};
use crate::wrap::Marks;

/// Adds an accessibility node at each visible item: pieces, edges, seams, marks; points while they are edited.
pub fn publish(ui: &egui::Ui, table: &Table<'_>) {
    for (id, piece, shape) in table.seen() {
        let middle = piece.pose.plane_from_piece(shape.middle);
        item_node(ui, table, ("piece", id.0), middle, Item::Piece(id));
        for (i, line) in shape.edges.iter().enumerate() {
            let on = badge_place(line).unwrap_or_default();
            let on = if line.len() == 2 { line[0].midpoint(line[1]) } else { on };
            let item = Item::Edge(EdgeRef { piece: id, edge: i });
            item_node(ui, table, ("edge", id.0, i), piece.pose.plane_from_piece(on), item);
        }
    }
    if table.laid.tool == Tool::Points {
        lines_and_points(ui, table);
    }
    for (id, ends) in table.threads.all().filter(|(_, ends)| ends.is_seen(table.pattern())) {
        let at = ends.on_table(table.pattern()).and_then(|[from, _]| badge_place(&from));
        if let Some(at) = at {
            item_node(ui, table, ("seam", id.0), at, Item::Seam(id));
        }
    }
    marks(ui, table, &table.laid.document.marks, false);
    if let Some(ghosts) = table.laid.ghosts {
        marks(ui, table, ghosts, true);
    }
}

/// Internal lines and the points of all lines, where they are in the shown size.
fn lines_and_points(ui: &egui::Ui, table: &Table<'_>) {
    for (id, piece, _) in table.seen() {
        for line in 0..piece.lines.len() {
            let line = LineRef { piece: id, line };
            let on = table.line_shown(line).and_then(badge_place).unwrap_or_default();
            let salt = ("line", id.0, line.line);
            item_node(ui, table, salt, piece.pose.plane_from_piece(on), Item::Line(line));
        }
    }
    for (at, p) in table.points_shown().collect::<Vec<_>>() {
        item_node(ui, table, ("point", at.piece.0, at.line, at.point), p, at.into());
    }
}

/// Tells screen readers that `item` was selected.
pub fn announce(ui: &egui::Ui, table: &Table<'_>, item: Item) {
    let Some(item) = words_of(table, item) else { return };
    let place = Rect::from_min_size(table.pane.min, vec2(1.0, 1.0));
    let node = ui.interact(place, ui.scope_id().with("selected"), Sense::hover());
    node.widget_info(|| WidgetInfo::labeled(Role::Status, true, say!("{item} (selected)", item)));
    ui.ctx().accesskit_node_builder(node.id, |builder| builder.set_live(Live::Polite));
}

/// An item in words; None where there is none.
fn words_of(table: &Table<'_>, item: Item) -> Option<String> {
    let name = |piece: PieceId| table.pattern().pieces.get(&piece).map(|piece| &piece.name);
    Some(match item {
        Item::Piece(piece) => say!("Piece {name}", name = name(piece)?),
        Item::Point(PointRef { piece, point }) => {
            say!("{name}, point {number}", name = name(piece)?, number = point + 1)
        }
        Item::LinePoint(LinePoint { piece, line, point }) => say!(
            "{name}, line {line}, point {number}",
            name = name(piece)?,
            line = line + 1,
            number = point + 1
        ),
        Item::Line(LineRef { piece, line }) => {
            say!("{name}, line {number}", name = name(piece)?, number = line + 1)
        }
        Item::Edge(EdgeRef { piece, edge }) => {
            let length = table.laid.unit.text(*table.piece(piece)?.1.lengths.get(edge)?);
            say!("{name}, edge {number}: {length}", name = name(piece)?, number = edge + 1, length)
        }
        Item::Seam(id) => {
            let sides = seam_words(table.pattern(), table.pattern().seams.get(&id)?);
            match table.threads.of(id).is_some_and(|ends| ends.is_twisted) {
                true => say!("Seam: {sides}, twisted", sides),
                false => say!("Seam: {sides}", sides),
            }
        }
    })
}

/// The two sides of a seam, in words.
pub fn seam_words(pattern: &Pattern, seam: &Seam) -> String {
    let side = |k: usize| {
        let EdgeRef { piece, edge } = seam.sides[k].first_edge();
        let name = pattern.pieces.get(&piece).map_or("?", |piece| &piece.name);
        say!("{name} edge {number}", name, number = edge + 1)
    };
    format!("{} – {}", side(0), side(1))
}

fn marks(ui: &egui::Ui, table: &Table<'_>, marks: &Marks, proposed: bool) {
    for (i, mark) in marks.cloth.iter().enumerate() {
        let piece = table.pattern().pieces.get(&mark.piece).filter(|piece| !piece.hidden);
        if let (Some(piece), Some(&first)) = (piece, mark.points.first()) {
            let words = || match proposed {
                true => say!("Proposed mark {number} on the cloth", number = i + 1),
                false => say!("Mark {number} on the cloth", number = i + 1),
            };
            let is_selected = !proposed && table.laid.selected == Some(mark.id);
            let at = piece.pose.plane_from_piece(first);
            node(ui, table, ("mark", proposed, i), at, is_selected, words);
        }
    }
}

fn item_node(ui: &egui::Ui, table: &Table<'_>, salt: impl egui::AsIdSalt, p: DVec2, item: Item) {
    let is_selected = table.laid.selection.has(item);
    node(ui, table, salt, p, is_selected, || words_of(table, item).unwrap_or_default());
}

fn node(
    ui: &egui::Ui,
    table: &Table<'_>,
    salt: impl egui::AsIdSalt,
    p: DVec2,
    is_selected: bool,
    words: impl Fn() -> String,
) {
    let at = table.screen(p);
    if table.pane.contains(at) {
        let rect = Rect::from_center_size(at, vec2(12.0, 12.0));
        let node = ui.interact(rect, ui.scope_id().with(salt), Sense::hover());
        node.widget_info(|| WidgetInfo {
            selected: is_selected.then_some(true),
            ..WidgetInfo::labeled(Role::Label, true, words())
        });
    }
}
