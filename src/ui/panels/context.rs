//! What the sections of the side panel read.

use std::sync::Arc;

use crate::body::Surface;
use crate::pattern::Problem;
use crate::session::Document;
use crate::sim::{Fault, Snapshot};
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::actions::context::FrameContext;
use crate::ui::look::theme::Palette;
use crate::ui::selection::Selection;

/// What the side panel shows.
#[derive(Clone, Copy)]
pub struct PanelContext<'a> {
    /// The document.
    pub document: &'a Document,
    /// Its body.
    pub surface: Option<&'a Arc<Surface>>,
    /// The cloth.
    pub snapshot: &'a Snapshot,
    /// What is selected of the pattern.
    pub selection: &'a Selection,
    /// What is wrong with the garment.
    pub problems: &'a [Problem],
    /// What is wrong with the cloth as it lies.
    pub verdict: &'a [Fault],
    /// Marks that found no place on the body.
    pub lost: &'a [Problem],
    /// How things stand.
    pub now: &'a FrameContext,
    /// Colours.
    pub palette: &'a Palette,
}

/// A click on it asks for what `shows` it, if anything does; with a tip.
pub fn problem_row(
    ui: &mut egui::Ui,
    ink: egui::Color32,
    words: &str,
    shows: Option<(Ask, &str)>,
    asks: &mut Asks,
) {
    ui.horizontal_top(|ui| {
        let (sign, _) = ui.allocate_exact_size(egui::vec2(12.0, 16.0), egui::Sense::hover());
        ui.painter().circle_filled(sign.center(), 4.0, ink);
        let Some((ask, tip)) = shows else {
            ui.add(egui::Label::new(words).wrap());
            return;
        };
        let row = ui.add(egui::Label::new(words).wrap().sense(egui::Sense::click()));
        if row.on_hover_text(tip).on_hover_cursor(egui::CursorIcon::PointingHand).clicked() {
            asks.push(ask);
        }
    });
}
