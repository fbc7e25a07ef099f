//! Publishes the items on the table to screen readers and tests.

use egui::accesskit::Role;
use egui::{Rect, Sense, WidgetInfo, vec2};
use glam::DVec2;

use super::draw_pieces::badge_place;
use super::table::Table;
use crate::pattern::{EdgeRef, Pattern, RulePoint, Seam};
use crate::ui::actions::Tool;
use crate::ui::language::say;
use crate::ui::selection::LineRef;
use crate::wrap::Marks;

/// Adds an accessibility node at each visible item: pieces, edges, seams, marks; points while they are edited.
pub fn publish(ui: &egui::Ui, table: &Table<'_>) {
    let unit = table.laid.unit;
    for (id, piece, shape) in table.seen() {
        let name = &piece.name;
        let middle = piece.pose.plane_from_piece(shape.middle);
        node(ui, table, ("piece", id.0), middle, || say!("Piece {name}", name));
        for (i, length) in shape.lengths.iter().enumerate() {
            let line = &shape.edges[i];
            let on = badge_place(line).unwrap_or_default();
            let on = if line.len() == 2 { line[0].midpoint(line[1]) } else { on };
            let words =
                || say!("{name}, edge {number}: {length}", name, number = i + 1, length = unit.text(*length));
            node(ui, table, ("edge", id.0, i), piece.pose.plane_from_piece(on), words);
        }
    }
    if table.laid.tool == Tool::Points {
        lines_and_points(ui, table);
    }
    for (id, ends) in table.threads.all().filter(|(_, ends)| ends.is_seen(table.pattern())) {
        let at = ends.on_table(table.pattern()).and_then(|[from, _]| badge_place(&from));
        if let (Some(at), Some(seam)) = (at, table.pattern().seams.get(&id)) {
            let words = || {
                let sides = seam_words(table.pattern(), seam);
                match ends.is_twisted {
                    true => say!("Seam: {sides}, twisted", sides),
                    false => say!("Seam: {sides}", sides),
                }
            };
            node(ui, table, ("seam", id.0), at, words);
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
            let points = table.line_shown(LineRef { piece: id, line });
            let on = points.and_then(badge_place).unwrap_or_default();
            let words = || say!("{name}, line {number}", name = piece.name, number = line + 1);
            node(ui, table, ("line", id.0, line), piece.pose.plane_from_piece(on), words);
        }
    }
    for (RulePoint { piece, line, point }, p) in table.points_shown().collect::<Vec<_>>() {
        let name = &table.pattern().pieces[&piece].name;
        let words = || match line {
            None => say!("{name}, point {number}", name, number = point + 1),
            Some(line) => {
                say!("{name}, line {line}, point {number}", name, line = line + 1, number = point + 1)
            }
        };
        node(ui, table, ("point", piece.0, line, point), p, words);
    }
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
            node(ui, table, ("mark", proposed, i), piece.pose.plane_from_piece(first), words);
        }
    }
}

fn node(ui: &egui::Ui, table: &Table<'_>, salt: impl egui::AsIdSalt, p: DVec2, words: impl Fn() -> String) {
    let at = table.screen(p);
    if table.pane.contains(at) {
        let rect = Rect::from_center_size(at, vec2(12.0, 12.0));
        let node = ui.interact(rect, ui.scope_id().with(salt), Sense::hover());
        node.widget_info(|| WidgetInfo::labeled(Role::Label, true, words()));
    }
}
