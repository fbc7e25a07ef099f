//! The value of the map under the pointer.

use egui::accesskit::Role;
use egui::{Pos2, Rect, Sense, WidgetInfo};

use super::hand::cloth_at;
use super::{ScenePane, Seen};
use crate::ui::maps::probe_ui;

impl ScenePane {
    /// Determines the value and writes it beside the pointer.
    pub(super) fn probe(&mut self, ui: &egui::Ui, seen: &Seen<'_>, pane: Rect, hovered: Option<Pos2>) {
        self.value = None;
        let (Some(map), Some(at)) = (seen.map, hovered) else { return };
        let Some(hit) = cloth_at(seen, self.ray(pane, at)) else { return };
        self.value = map.value(hit.flat);
        let piece = seen.document.pattern.pieces.get(&hit.place.piece).map_or("", |piece| &piece.name);
        let words = probe_ui(ui, pane, at, map, self.value, piece, seen.palette);
        let spot = ui.interact(
            Rect::from_min_size(at, egui::Vec2::ZERO),
            ui.scope_id().with("value"),
            Sense::hover(),
        );
        spot.widget_info(|| WidgetInfo::labeled(Role::Label, true, words.clone()));
    }
}
