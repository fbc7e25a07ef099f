//! The menu button that chooses a map.

use egui::ComboBox;

use crate::fit::MapKind;
use crate::ui::actions::Action;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::actions::context::FrameContext;
use crate::ui::language::{say, tr};
use crate::ui::list::{Entries, list_ui};

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
        let shown = list_ui(ui, combo, |entries| fill(entries, now, asks));
        let words = say!("Map: {text}", text);
        let enabled = ui.is_enabled();
        shown.widget_info(|| {
            egui::WidgetInfo::labeled(egui::accesskit::Role::ComboBox, enabled, words.clone())
        });
        let tip = tr("Colour the cloth by its strain, its ease or its curves");
        shown.on_hover_text(tip).on_disabled_hover_text(why_not.unwrap_or_default());
    });
}

/// Adds all maps to the list.
fn fill(entries: &mut Entries<'_>, now: &FrameContext, asks: &mut Asks) {
    for kind in choices() {
        let action = Action::Map(kind);
        if entries.add(now.map == kind, tr(action.row().text)).clicked() {
            asks.push(Ask::Act(action));
        }
    }
}
