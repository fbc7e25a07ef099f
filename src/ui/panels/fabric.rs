//! The section of fabrics and draping.

use egui::{ComboBox, RichText};

use crate::cloth::Fabric;
use crate::geometry::ids::PieceId;
use crate::session::Command;
use crate::ui::actions::Action;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::panels::context::PanelContext;

/// Width of the lists, points.
const WIDTH: f32 = 112.0;

/// Draws a list of fabrics for the garment and one for each piece.
pub fn fabric_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, asks: &mut Asks) {
    list(ui, told, None, "All pieces", asks);
    for (&id, piece) in &told.document.pattern.pieces {
        list(ui, told, Some(id), &piece.name, asks);
    }
    ui.add_space(2.0);
    let step = Action::StepDrape;
    let why_not = told.now.why_not(step);
    let button = egui::Button::new(step.row().text).small();
    let response = ui.add_enabled(why_not.is_none(), button).on_hover_text(step.row().tip);
    if response.on_disabled_hover_text(why_not.unwrap_or_default()).clicked() {
        asks.push(Ask::Act(step));
    }
}

fn list(ui: &mut egui::Ui, told: &PanelContext<'_>, piece: Option<PieceId>, name: &str, asks: &mut Asks) {
    let fabrics = &told.document.fabrics;
    let own = match piece {
        None => Some(fabrics.name(None)),
        Some(piece) => fabrics.pieces.get(&piece).map(String::as_str),
    };
    let shown = own.map_or(RichText::new("as all").color(told.palette.weak), RichText::new);
    let combo = ComboBox::from_label(name).selected_text(shown).width(WIDTH);
    combo.show_ui(ui, |ui| {
        let mut set = |fabric: Option<&str>| {
            asks.push(Ask::Do(Command::SetFabric { piece, fabric: fabric.map(str::to_owned) }));
        };
        if piece.is_some() && ui.selectable_label(own.is_none(), "as all").clicked() {
            set(None);
        }
        for fabric in Fabric::presets() {
            let row = ui.selectable_label(own == Some(&fabric.name), &fabric.name);
            if row.on_hover_text(figures(fabric)).clicked() {
                set(Some(&fabric.name));
            }
        }
    });
}

/// Density, stretch and bending stiffness, for people.
fn figures(fabric: &Fabric) -> String {
    let grams = fabric.density_kg_per_m2 * 1000.0;
    let bending = fabric.bending.warp.max(fabric.bending.weft) * 1e6;
    let (warp, weft) = (fabric.stretch.warp, fabric.stretch.weft);
    format!("{grams:.0} g/m², stretch {warp:.0} × {weft:.0} N/m, bending {bending:.0} µN·m")
}
