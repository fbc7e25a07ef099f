//! Buttons and zips: sewn on along two selected lines, listed, fastened and unfastened.

use egui::RichText;
use glam::DVec2;

use crate::geometry::ids::{ButtonId, SeamId};
use crate::pattern::edit::{PatternEdit, TrimLine};
use crate::pattern::{Button, EdgeRef, Pattern, Piece, PiecePoint, Seam, Stretch, Zip, curve};
use crate::session::Command;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::{say, tr, unbroken};
use crate::ui::look::signs::{Sign, sign_button};
use crate::ui::panels::colours::colour_menu;
use crate::ui::panels::context::PanelContext;
use crate::ui::panels::fields::{length_field, number_field};
use crate::ui::pattern_pane::seam_words;

/// Number of buttons that are sewn on at first.
const USUAL_COUNT: usize = 5;
/// Most buttons that are sewn on at once.
const MOST_AT_ONCE: f64 = 100.0;
/// Distance of buttons from the edge that they are sewn on along, metres.
const INSET: f64 = 0.012;

fn dragged(edit: PatternEdit) -> Command {
    Command::EditPattern { edits: vec![edit], anew: true }
}

fn ask(edit: PatternEdit) -> Ask {
    Ask::Do(Command::EditPattern { edits: vec![edit], anew: false })
}

/// Draws the zip of a seam.
pub fn zip_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, id: SeamId, seam: &Seam, asks: &mut Asks) {
    let set = |zip: Option<Zip>| ask(PatternEdit::SetZip { seam: id, zip });
    let mut on = seam.zip.is_some();
    let tip = tr("A seam that can be opened from one end");
    if ui.checkbox(&mut on, tr("Zip")).on_hover_text(tip).changed() {
        asks.push(set(on.then_some(Zip::CLOSED)));
    }
    let Some(zip) = seam.zip else { return };
    ui.horizontal(|ui| {
        let label = ui.label(RichText::new(tr("Open, %")).color(told.palette.weak).size(12.5));
        let label = label.on_hover_text(tr("Share of its length that is open: 0 closed, 100 wide open"));
        if let Some(new) = number_field(ui, "zip open", &label, zip.open * 100.0) {
            asks.push(set(Some(Zip { open: (new / 100.0).clamp(0.0, 1.0), ..zip })));
        }
        let text = if zip.open > 0.0 { tr("Close") } else { tr("Open") };
        if ui.small_button(text).clicked() {
            let open = if zip.open > 0.0 { 0.0 } else { 1.0 };
            asks.push(set(Some(Zip { open, ..zip })));
        }
        if ui.small_button(tr("Other end")).on_hover_text(tr("Open it from its other end")).clicked() {
            asks.push(set(Some(Zip { from_end: !zip.from_end, ..zip })));
        }
    });
    ui.horizontal(|ui| {
        ui.label(RichText::new(tr("Teeth")).color(told.palette.weak).size(12.5));
        colour_menu(ui, tr("Teeth of the zip"), zip.colour, asks, |colour| {
            dragged(PatternEdit::SetZip { seam: id, zip: Some(Zip { colour, ..zip }) })
        });
    });
}

/// Draws what buttons two selected lines together; nothing unless two are selected.
pub fn buttons_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, lines: &[TrimLine], asks: &mut Asks) {
    let [one, other] = lines else { return };
    let id = ui.scope_id().with("button count");
    let mut count: usize = ui.data(|d| d.get_temp(id)).unwrap_or(USUAL_COUNT);
    ui.horizontal(|ui| {
        let label = ui.label(RichText::new(tr("Buttons")).color(told.palette.weak).size(12.5));
        if let Some(new) = number_field(ui, "buttons", &label, count as f64) {
            count = new.clamp(1.0, MOST_AT_ONCE) as usize;
        }
        let tip = tr("Evenly along both lines: buttons on the first, buttonholes on the second");
        if ui.button(tr("Sew on")).on_hover_text(tip).clicked() {
            let buttons = buttons_along(&told.document.pattern, *one, *other, count);
            asks.push(ask(PatternEdit::AddButtons { buttons }));
        }
    });
    ui.data_mut(|d| d.insert_temp(id, count));
}

/// Draws the list of fastenings.
pub fn fastenings_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, asks: &mut Asks) {
    let pattern = &*told.document.pattern;
    let all: Vec<ButtonId> = pattern.buttons.keys().copied().collect();
    if !all.is_empty() {
        ui.horizontal(|ui| {
            for (text, fastened) in [("Fasten all", true), ("Unfasten all", false)] {
                if ui.small_button(tr(text)).clicked() {
                    asks.push(ask(PatternEdit::Fasten { buttons: all.clone(), fastened }));
                }
            }
        });
    }
    for (&id, button) in &pattern.buttons {
        button_ui(ui, told, id, button, asks);
    }
    for (id, seam) in pattern.seams.iter().filter(|(_, seam)| seam.zip.is_some()) {
        let words = seam_words(pattern, seam);
        let open = seam.zip.map_or(0.0, |zip| zip.open);
        let percent = format!("{:.0}", open * 100.0);
        let words = say!("Zip, {seam}: {percent} % open", seam = words, percent);
        let label = ui.label(RichText::new(unbroken(&words)).size(12.5));
        label.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, &words));
        ui.push_id(id, |ui| zip_ui(ui, told, *id, seam, asks));
    }
}

fn button_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, id: ButtonId, button: &Button, asks: &mut Asks) {
    let name = |point: &PiecePoint| {
        told.document.pattern.pieces.get(&point.piece).map_or("", |piece| &piece.name).to_owned()
    };
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let mut fastened = !button.open;
        if ui.checkbox(&mut fastened, "").on_hover_text(tr("Fastened")).changed() {
            asks.push(ask(PatternEdit::Fasten { buttons: vec![id], fastened }));
        }
        let words = say!("Take off button {n}", n = id.0);
        if sign_button(ui, Sign::Cross, true, &words, tr("Take the button off")) {
            asks.push(ask(PatternEdit::DeleteButtons { buttons: vec![id] }));
        }
        if button.tack {
            let (piece, other) = (name(&button.button), name(&button.hole));
            ui.label(RichText::new(say!("tack {n}, {piece} to {other}", n = id.0, piece, other)).size(12.5));
            return;
        }
        colour_menu(ui, &say!("Colour of button {n}", n = id.0), button.colour, asks, |colour| {
            dragged(PatternEdit::SetButton { id, button: Button { colour, ..*button } })
        });
        let (piece, other) = (name(&button.button), name(&button.hole));
        let words = say!("button {n}, {piece} to {other}", n = id.0, piece, other);
        let label = ui.label(RichText::new(words).size(12.5));
        if let Some(new) = length_field(ui, ("diameter", id), &label, button.diameter, told.now.unit) {
            let range = crate::pattern::fastenings::BUTTON_DIAMETERS;
            let diameter = new.clamp(*range.start(), *range.end());
            asks.push(ask(PatternEdit::SetButton { id, button: Button { diameter, ..*button } }));
        }
    });
}

/// `count` buttons along `one`, with their buttonholes along `other`; both from their upper end on the table.
fn buttons_along(pattern: &Pattern, one: TrimLine, other: TrimLine, count: usize) -> Vec<Button> {
    let (Some(on), Some(holes)) = (places(pattern, one, count), places(pattern, other, count)) else {
        return Vec::new();
    };
    let button = |(button, hole)| Button {
        button,
        hole,
        diameter: Button::SHIRT,
        colour: Button::PEARL,
        open: false,
        tack: false,
    };
    on.into_iter().zip(holes).map(button).collect()
}

/// `count` places along a line, [`INSET`] from an edge, from its upper end.
fn places(pattern: &Pattern, line: TrimLine, count: usize) -> Option<Vec<PiecePoint>> {
    let piece = pattern.pieces.get(&line.piece())?;
    let shares: Vec<f64> = (0..count).map(|i| (i as f64 + 0.5) / count as f64).collect();
    let mut points = match line {
        TrimLine::Edge(edge) => inset(piece, edge, &shares)?,
        TrimLine::Line { line, .. } => {
            let line = piece.lines.get(line)?;
            along(&line.flattened(1e-4), &shares)
        }
    };
    let height = |p: &DVec2| piece.pose.plane_from_piece(*p).y;
    if points.first().map(height) < points.last().map(height) {
        points.reverse();
    }
    Some(points.into_iter().map(|at| PiecePoint { piece: line.piece(), at }).collect())
}

/// Points at `shares` of an edge, moved into the cloth.
fn inset(piece: &Piece, edge: EdgeRef, shares: &[f64]) -> Option<Vec<DVec2>> {
    let stretch = Stretch::edge(edge.piece, edge.edge);
    let points = stretch.points(piece, shares)?;
    let (a, b) = piece.edge_ends(edge.edge);
    let way = (b - a).normalize_or_zero().perp() * INSET;
    let outline = piece.flattened(1e-4);
    let is_in = |p: DVec2| crate::geometry::polygon::contains(&outline, p);
    let moved = |p: DVec2| if is_in(p + way) { p + way } else { p - way };
    Some(points.into_iter().map(moved).collect())
}

/// Points at `shares` of the length of a polyline.
fn along(points: &[DVec2], shares: &[f64]) -> Vec<DVec2> {
    let sides: Vec<f64> = points.windows(2).map(|w| w[0].distance(w[1])).collect();
    let total: f64 = sides.iter().sum();
    let at = |share: &f64| {
        let mut left = share * total;
        for (w, side) in points.windows(2).zip(&sides) {
            if left <= *side {
                return curve::points(w[0], crate::pattern::EdgeShape::Line, w[1], &[left / side.max(1e-12)])
                    [0];
            }
            left -= side;
        }
        points[points.len() - 1]
    };
    shares.iter().map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn buttons_are_evenly_along_both_edges_from_the_top() {
        let corners = [(0.0, 0.0), (0.2, 0.0), (0.2, 0.5), (0.0, 0.5)].map(DVec2::from);
        let mut pattern = Pattern::default();
        let [left, right] = ["left", "right"].map(|name| pattern.add_piece(Piece::polygon(name, &corners)));
        let edge = |piece, edge| TrimLine::Edge(EdgeRef { piece, edge });
        let buttons = buttons_along(&pattern, edge(left, 1), edge(right, 3), 5);
        assert_eq!(buttons.len(), 5);
        for (i, button) in buttons.iter().enumerate() {
            let y = 0.45 - 0.1 * i as f64;
            assert!(button.button.at.distance(DVec2::new(0.2 - INSET, y)) < 1e-6, "{button:?}");
            assert!(button.hole.at.distance(DVec2::new(INSET, y)) < 1e-6, "{button:?}");
            assert_eq!(button.pieces(), [left, right]);
        }
    }
}
