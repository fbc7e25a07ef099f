//! The state that the sections of the side panel show.

use std::sync::Arc;

use crate::body::Surface;
use crate::pattern::Problem;
use crate::session::Document;
use crate::sim::{Fault, Snapshot};
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::actions::context::FrameContext;
use crate::ui::language::unbroken;
use crate::ui::look::theme::Palette;
use crate::ui::pattern_pane::nests::{Nests, SizeView};
use crate::ui::selection::Selection;

/// The state that the side panel shows.
#[derive(Clone, Copy)]
pub struct PanelContext<'a> {
    /// The document.
    pub document: &'a Document,
    /// Its body.
    pub surface: Option<&'a Arc<Surface>>,
    /// The cloth.
    pub snapshot: &'a Snapshot,
    /// The selection in the pattern.
    pub selection: &'a Selection,
    /// Problems of building and sewing the garment.
    pub problems: &'a [Problem],
    /// Faults of the cloth in its present state.
    pub verdict: &'a [Fault],
    /// Marks without a place on the body.
    pub lost: &'a [Problem],
    /// State of the app in this frame.
    pub now: &'a FrameContext,
    /// Which sizes of the pattern are shown.
    pub sizes: SizeView,
    /// The pattern in all its sizes.
    pub nests: &'a Nests,
    /// Colours of the interface.
    pub palette: &'a Palette,
}

/// Draws a problem; a click on it makes the request that shows its place, if there is one.
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
        let label = egui::Label::new(unbroken(words)).wrap();
        let label = if shows.is_some() { label.sense(egui::Sense::click()) } else { label };
        let row = ui.add(label);
        row.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, words));
        let Some((ask, tip)) = shows else { return };
        if row.on_hover_text(tip).on_hover_cursor(egui::CursorIcon::PointingHand).clicked() {
            asks.push(ask);
        }
    });
}
