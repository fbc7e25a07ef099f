//! The section of pins: select, lock, remove.

use egui::accesskit::Role;
use egui::{Align, Button, Layout, RichText, WidgetInfo};

use crate::geometry::ids::PinId;
use crate::session::{Command, Pin};
use crate::ui::actions::Action;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::{say, tr};
use crate::ui::panels::context::PanelContext;
use crate::ui::pointer::mouse::held;

/// The name of a pin.
pub fn named(pin: PinId) -> String {
    say!("Pin {n}", n = pin.0)
}

/// Draws the list.
pub fn pins_ui(ui: &mut egui::Ui, told: &PanelContext<'_>, asks: &mut Asks) {
    for pin in told.document.pins.iter() {
        ui.horizontal(|ui| pin_row(ui, told, pin, asks));
    }
    ui.add_space(2.0);
    ui.horizontal(|ui| {
        for action in [Action::ToggleLock, Action::ClearPins] {
            let why_not = told.now.why_not(action).or_else(|| {
                let none = action == Action::ToggleLock && told.selection.pins.is_empty();
                none.then_some(tr("No pin is selected"))
            });
            let text = tr(action.row().text);
            let button = ui.add_enabled(why_not.is_none(), Button::new(text).small());
            let button = button.on_hover_text(tr(action.row().tip));
            let button = button.on_disabled_hover_text(why_not.unwrap_or_default());
            if button.clicked() {
                asks.push(Ask::Act(action));
            }
        }
    });
}

fn pin_row(ui: &mut egui::Ui, told: &PanelContext<'_>, pin: &Pin, asks: &mut Asks) {
    let name = named(pin.id);
    let is_selected = told.selection.pins.contains(&pin.id);
    let piece = told.document.pattern.pieces.get(&pin.place.piece).map_or("", |piece| &piece.name);
    let add = held(ui).shift || held(ui).command;
    ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
        let close = ui.add_enabled(!pin.locked, Button::new("×").small());
        let close = close.on_hover_text(tr("Pull it out")).on_disabled_hover_text(tr("It is locked"));
        close.widget_info(|| {
            WidgetInfo::labeled(Role::Button, !pin.locked, say!("Pull {pin} out", pin = name))
        });
        if close.clicked() {
            asks.push(Ask::Do(Command::DeletePin { pin: pin.id }));
        }
        let mut locked = pin.locked;
        let lock = ui.toggle_value(&mut locked, RichText::new(tr("Lock")).size(12.0));
        lock.widget_info(|| WidgetInfo::selected(Role::Switch, true, pin.locked, say!("Lock {name}", name)));
        if lock.on_hover_text(tr("Keep it from being moved and pulled out")).changed() {
            asks.push(Ask::Do(Command::LockPins { pins: vec![pin.id], locked }));
        }
        ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
            let row = ui.add(Button::selectable(is_selected, format!("{name} · {piece}")).truncate());
            row.widget_info(|| {
                WidgetInfo::selected(Role::Button, true, is_selected, say!("Select {name}", name))
            });
            if row.on_hover_text(tr("Shift: several")).clicked() {
                asks.push(Ask::Pick(told.selection.clicked_pin(pin.id, add)));
            }
        });
    });
}
