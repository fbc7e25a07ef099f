//! The page of preferences: look of the window, and keyboard shortcuts.

use std::sync::Arc;

use egui::{ComboBox, DragValue, Event, Id, Key, KeyboardShortcut, Modal, RichText, ScrollArea, TextEdit};

use crate::ui::actions::Action;
use crate::ui::actions::keymap::{Keymap, pressed};
use crate::ui::actions::rows::all;
use crate::ui::look::scheme::Theme;
use crate::ui::look::signs::{Sign, sign_button};
use crate::ui::look::theme::Palette;
use crate::ui::pointer::mouse::Mouse;
use crate::ui::preferences::units::LengthUnit;
use crate::ui::preferences::{Copies, Preferences, Scale, Screen};

/// Length of the bar that a ruler is held against, metres.
const RULER: f64 = 0.05;

/// State of the page.
#[derive(Debug, Default)]
pub struct PreferencesPage {
    keys: bool,
    /// Filter of the list of shortcuts.
    filter: String,
    /// The action whose new shortcut is being pressed.
    waiting: Option<Action>,
    /// A new shortcut that other actions have already: action, keys, and the other actions.
    taken: Option<(Action, KeyboardShortcut, Vec<Action>)>,
}

impl PreferencesPage {
    /// Draws the page; choices are written to `preferences`. False when it is to be closed.
    pub fn ui(&mut self, ctx: &egui::Context, preferences: &mut Preferences, palette: &Palette) -> bool {
        let waited = self.waiting.is_some();
        self.catch_key(ctx, preferences);
        let height = (ctx.content_rect().height() - 200.0).clamp(160.0, 420.0);
        let shown = Modal::new(Id::unique("preferences")).show(ctx, |ui| {
            ui.set_width((ctx.content_rect().width() - 80.0).min(560.0));
            ui.heading("Preferences");
            ui.horizontal(|ui| {
                for (keys, name) in [(false, "General"), (true, "Keys")] {
                    if ui.selectable_label(self.keys == keys, name).clicked() {
                        (self.keys, self.waiting, self.taken) = (keys, None, None);
                    }
                }
            });
            ui.separator();
            if self.keys {
                self.keys_ui(ui, preferences, palette, height);
            } else {
                general_ui(ui, preferences, palette, height);
            }
            ui.separator();
            ui.horizontal(|ui| {
                let done = ui.button("Done").clicked();
                if ui.button("Reset this page").clicked() {
                    let keymap = Arc::clone(&preferences.keymap);
                    *preferences = if self.keys {
                        Preferences { keymap: Arc::default(), ..preferences.clone() }
                    } else {
                        Preferences { keymap, ..Preferences::default() }
                    };
                }
                done
            })
            .inner
        });
        !(shown.inner || (shown.should_close() && !waited))
    }

    fn catch_key(&mut self, ctx: &egui::Context, preferences: &mut Preferences) {
        let Some(action) = self.waiting else { return };
        let key = ctx.input_mut(|i| {
            let at =
                i.events.iter().position(|e| matches!(e, Event::Key { pressed: true, repeat: false, .. }));
            at.map(|at| i.events.remove(at))
        });
        let Some(Event::Key { key, modifiers, .. }) = key else { return };
        self.waiting = None;
        if key == Key::Escape {
            return;
        }
        let keys = pressed(key, modifiers);
        let others = preferences.keymap.others(action, keys);
        if others.is_empty() {
            Arc::make_mut(&mut preferences.keymap).bind(action, keys);
        } else {
            self.taken = Some((action, keys, others));
        }
    }

    fn keys_ui(&mut self, ui: &mut egui::Ui, preferences: &mut Preferences, palette: &Palette, height: f32) {
        let field = TextEdit::singleline(&mut self.filter).hint_text("Find an action").desired_width(220.0);
        let field = ui.add(field);
        field.widget_info(|| {
            egui::WidgetInfo::labeled(egui::accesskit::Role::SearchInput, true, "Find an action")
        });
        self.conflict_ui(ui, preferences, palette);
        let filter = self.filter.to_lowercase();
        let wanted = |action: &Action| {
            let entry = action.row();
            format!("{} {}", action.row().menu, entry.text).to_lowercase().contains(&filter)
        };
        ScrollArea::vertical().max_height(height - 40.0).auto_shrink([false, false]).show(ui, |ui| {
            egui::Grid::new("own keys").num_columns(3).striped(true).spacing([16.0, 4.0]).show(ui, |ui| {
                for action in all().filter(wanted) {
                    self.key_row(ui, action, &mut preferences.keymap, palette);
                    ui.end_row();
                }
            });
        });
    }

    fn key_row(&mut self, ui: &mut egui::Ui, action: Action, keymap: &mut Arc<Keymap>, palette: &Palette) {
        let entry = action.row();
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 0.0;
            ui.label(RichText::new(format!("{} › ", action.row().menu)).color(palette.weak));
            ui.label(entry.text).on_hover_text(entry.tip);
        });
        let keys: Vec<String> = keymap.keys(action).iter().map(|k| ui.ctx().format_shortcut(k)).collect();
        let shown = match (&self.waiting, keys.is_empty()) {
            (Some(of), _) if *of == action => "Press a key, or Esc".to_owned(),
            (_, true) => "none".to_owned(),
            _ => keys.join(", "),
        };
        let button = ui.add(egui::Button::new(shown.as_str()).min_size(egui::vec2(150.0, 0.0)));
        button.widget_info(|| {
            egui::WidgetInfo::labeled(
                egui::accesskit::Role::Button,
                true,
                format!("Key of {}: {shown}", entry.text),
            )
        });
        if button.clicked() {
            (self.waiting, self.taken) = (Some(action), None);
            button.surrender_focus();
        }
        ui.horizontal(|ui| {
            if !keys.is_empty() {
                let name = format!("Take the key of {} away", entry.text);
                if sign_button(ui, Sign::Cross, true, &name, "No key") {
                    Arc::make_mut(keymap).unbind(action);
                }
            }
            if keymap.is_own(action) && ui.small_button("as usual").clicked() {
                Arc::make_mut(keymap).reset(action);
            }
        });
    }

    /// Asks what to do with a shortcut that other actions have.
    fn conflict_ui(&mut self, ui: &mut egui::Ui, preferences: &mut Preferences, palette: &Palette) {
        let Some((action, keys, others)) = &self.taken else { return };
        let names: Vec<&str> = others.iter().map(|other| other.row().text).collect();
        let (key, action, keys) = (ui.ctx().format_shortcut(keys), *action, *keys);
        ui.horizontal_wrapped(|ui| {
            ui.label(
                RichText::new(format!("{key} is the key of {} already.", names.join(", ")))
                    .color(palette.warning),
            );
            let give = ui.button(format!("Use it for {}", action.row().text)).clicked();
            if give {
                Arc::make_mut(&mut preferences.keymap).bind(action, keys);
            }
            if ui.button("Leave it").clicked() || give {
                self.taken = None;
            }
        });
    }
}

/// Names a combo box and its choice for screen readers and tests.
fn combo_name(response: &egui::Response, name: &str, chosen: &str) {
    let words = format!("{name}: {chosen}");
    response.widget_info(|| egui::WidgetInfo::labeled(egui::accesskit::Role::ComboBox, true, words.clone()));
}

/// Points of this window per metre of `screen`.
pub(in crate::ui) fn points_per_metre(ctx: &egui::Context, screen: Screen) -> f64 {
    screen.points_per_metre(ctx.native_pixels_per_point().unwrap_or(1.0), ctx.pixels_per_point())
}

/// Draws a bar whose length the user adjusts to the length written on it, so that *True size* is correct.
fn screen_ui(ui: &mut egui::Ui, screen: &mut Screen, palette: &Palette) {
    ui.vertical(|ui| {
        let native = ui.ctx().native_pixels_per_point().unwrap_or(1.0);
        let mut pixels = screen.pixels_per_inch(native);
        ui.horizontal(|ui| {
            let value = DragValue::new(&mut pixels)
                .range(Screen::PIXELS)
                .speed(0.2)
                .max_decimals(1)
                .suffix(" pixels an inch");
            let value = ui.add(value);
            value.widget_info(|| {
                egui::WidgetInfo::labeled(
                    egui::accesskit::Role::SpinButton,
                    true,
                    "Pixels an inch of the screen",
                )
            });
            if value.changed() {
                *screen = Screen(Some(pixels));
            }
            if screen.0.is_some() && ui.small_button("as usual").clicked() {
                *screen = Screen::default();
            }
        });
        let length = (points_per_metre(ui.ctx(), *screen) * RULER) as f32;
        let (rect, _) = ui.allocate_exact_size(egui::vec2(length, 14.0), egui::Sense::hover());
        let line = egui::Stroke::new(1.5, ui.visuals().text_color());
        ui.painter().hline(rect.x_range(), rect.center().y, line);
        for i in 0..=5 {
            let x = egui::lerp(rect.x_range(), i as f32 / 5.0);
            let half = if i % 5 == 0 { 6.0 } else { 3.5 };
            ui.painter().vline(x, rect.center().y - half..=rect.center().y + half, line);
        }
        let tip = "Hold a ruler here: the bar is 5 cm long. Then a pattern at 1:1 is as large as cloth.";
        ui.label(RichText::new(tip).color(palette.weak).size(12.0));
    });
}

fn general_ui(ui: &mut egui::Ui, preferences: &mut Preferences, palette: &Palette, height: f32) {
    ScrollArea::vertical().max_height(height).show(ui, |ui| {
        egui::Grid::new("general").num_columns(2).spacing([24.0, 12.0]).show(ui, |ui| {
            ui.label("Colours");
            ui.horizontal(|ui| {
                for theme in Theme::ALL {
                    ui.selectable_value(&mut preferences.theme, theme, theme.name());
                }
            });
            ui.end_row();
            ui.label("Size of everything");
            let words = |percent: u16| format!("{percent} %");
            let combo = ComboBox::from_id_salt("scale").selected_text(words(preferences.scale.0));
            let shown = combo.show_ui(ui, |ui| {
                for percent in Scale::ALL {
                    ui.selectable_value(&mut preferences.scale, Scale(percent), words(percent));
                }
            });
            combo_name(&shown.response, "Size of everything", &words(preferences.scale.0));
            ui.end_row();
            ui.label("Lengths in");
            ui.horizontal(|ui| {
                for unit in LengthUnit::ALL {
                    ui.selectable_value(&mut preferences.unit, unit, unit.name());
                }
            });
            ui.end_row();
            ui.label("Fineness of the screen");
            screen_ui(ui, &mut preferences.screen, palette);
            ui.end_row();
            ui.label("Mouse");
            ui.vertical(|ui| {
                for mouse in Mouse::ALL {
                    ui.radio_value(&mut preferences.mouse, mouse, mouse.name()).on_hover_text(mouse.tip());
                }
            });
            ui.end_row();
            ui.label("Copies of unsaved work");
            let words = |seconds: u16| match seconds {
                0..60 => format!("every {seconds} seconds"),
                60 => "every minute".to_owned(),
                _ => format!("every {} minutes", seconds / 60),
            };
            let combo = ComboBox::from_id_salt("copies").selected_text(words(preferences.copies.0));
            let shown = combo.show_ui(ui, |ui| {
                for seconds in Copies::ALL {
                    ui.selectable_value(&mut preferences.copies, Copies(seconds), words(seconds));
                }
            });
            combo_name(&shown.response, "Copies of unsaved work", &words(preferences.copies.0));
            ui.end_row();
            ui.label("Large garments");
            ui.checkbox(&mut preferences.card.0, "Drape on the graphics card").on_hover_text(
                "Where there is one. As accurate as on the processor, but not the same in every last digit on every \
                 machine: recordings then tell no hashes of the cloth.",
            );
            ui.end_row();
        });
        ui.add_space(6.0);
        let tip =
            "Every command is written down at once besides: after a crash no more than the last is lost.";
        ui.label(RichText::new(tip).color(palette.weak).size(12.0));
    });
}
