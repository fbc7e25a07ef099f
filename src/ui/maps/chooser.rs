//! The menu button that chooses a map.

use egui::{ComboBox, Id};

use crate::fit::MapKind;
use crate::ui::actions::Action;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::actions::context::FrameContext;
use crate::ui::language::{say, tr};
use crate::ui::maps::list_keys::list_keys;

/// All choices: no map, and every map.
pub fn choices() -> impl Iterator<Item = Option<MapKind>> {
    std::iter::once(None).chain(MapKind::ALL.into_iter().map(Some))
}

/// Draws the button.
pub fn chooser_ui(ui: &mut egui::Ui, now: &FrameContext, asks: &mut Asks) {
    let text = now.map.map_or(tr("No map"), |kind| tr(kind.short()));
    let why_not = now.why_not(Action::Map(Some(MapKind::Ease)));
    ui.add_enabled_ui(why_not.is_none() || now.map.is_some(), |ui| {
        let combo = ComboBox::from_id_salt("map").selected_text(text).width(112.0).height(320.0);
        let shown = combo.show_ui(ui, |ui| list_ui(ui, now, asks));
        let words = say!("Map: {text}", text);
        let enabled = ui.is_enabled();
        shown.response.widget_info(|| {
            egui::WidgetInfo::labeled(egui::accesskit::Role::ComboBox, enabled, words.clone())
        });
        let tip = tr("Colour the cloth by its strain, its ease or its curves");
        shown.response.on_hover_text(tip).on_disabled_hover_text(why_not.unwrap_or_default());
    });
}

/// Draws the list.
fn list_ui(ui: &mut egui::Ui, now: &FrameContext, asks: &mut Asks) {
    let mut entries = Vec::new();
    for kind in choices() {
        let action = Action::Map(kind);
        let text = tr(action.row().text);
        let entry = ui.selectable_label(now.map == kind, text);
        if entry.clicked() {
            asks.push(Ask::Act(action));
            // Only the mouse closes it by itself.
            ui.close();
        }
        entries.push((entry, text));
    }
    let present = choices().position(|kind| kind == now.map).unwrap_or(0);
    list_keys(ui, Id::unique("keys of the list of maps"), &entries, present);
}
