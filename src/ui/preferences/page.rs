//! The page of preferences: look of the window, and keyboard shortcuts.

use std::sync::Arc;

use egui::{ComboBox, Event, Id, Key, KeyboardShortcut, Modal, RichText, ScrollArea, TextEdit};

use crate::ui::actions::Action;
use crate::ui::actions::keymap::{Keymap, pressed};
use crate::ui::actions::rows::all;
use crate::ui::language::choice::{Language, Languages};
use crate::ui::language::fields::drag_value;
use crate::ui::language::keys::shortcut_text;
use crate::ui::language::{counted, say, tr};
use crate::ui::list::list_ui;
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
    pub fn ui(
        &mut self,
        ctx: &egui::Context,
        preferences: &mut Preferences,
        languages: &Languages,
        palette: &Palette,
    ) -> bool {
        let waited = self.waiting.is_some();
        self.catch_key(ctx, preferences);
        let height = (ctx.content_rect().height() - 200.0).clamp(160.0, 420.0);
        let shown = Modal::new(Id::unique("preferences")).show(ctx, |ui| {
            ui.set_width((ctx.content_rect().width() - 80.0).min(560.0));
            ui.heading(tr("Preferences"));
            ui.horizontal(|ui| {
                for (keys, name) in [(false, tr("General")), (true, tr("Keys"))] {
                    if ui.selectable_label(self.keys == keys, name).clicked() {
                        (self.keys, self.waiting, self.taken) = (keys, None, None);
                    }
                }
            });
            ui.separator();
            if self.keys {
                self.keys_ui(ui, preferences, palette, height);
            } else {
                general_ui(ui, preferences, languages, palette, height);
            }
            ui.separator();
            ui.horizontal(|ui| {
                let done = ui.button(tr("Done")).clicked();
                if ui.button(tr("Reset this page")).clicked() {
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
        let field = TextEdit::singleline(&mut self.filter).hint_text(tr("Find an action"));
        let field = ui.add(field.desired_width(220.0));
        field.widget_info(|| {
            egui::WidgetInfo::labeled(egui::accesskit::Role::SearchInput, true, tr("Find an action"))
        });
        self.conflict_ui(ui, preferences, palette);
        let filter = self.filter.to_lowercase();
        let wanted = |action: &Action| {
            let row = action.row();
            let shown = format!("{} {}", row.place(), row.label());
            let english = format!("{} {}", row.menu, row.text);
            [shown, english].iter().any(|text| text.to_lowercase().contains(&filter))
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
            ui.label(RichText::new(format!("{} › ", entry.place())).color(palette.weak));
            ui.label(entry.label()).on_hover_text(tr(entry.tip));
        });
        let keys: Vec<String> = keymap.keys(action).iter().map(|k| shortcut_text(ui.ctx(), k)).collect();
        let shown = match (&self.waiting, keys.is_empty()) {
            (Some(of), _) if *of == action => tr("Press a key, or Esc").to_owned(),
            (_, true) => tr("none").to_owned(),
            _ => keys.join(", "),
        };
        let button = ui.add(egui::Button::new(shown.as_str()).min_size(egui::vec2(150.0, 0.0)));
        button.widget_info(|| {
            egui::WidgetInfo::labeled(
                egui::accesskit::Role::Button,
                true,
                say!("Key of {action}: {shown}", action = entry.label(), shown),
            )
        });
        if button.clicked() {
            (self.waiting, self.taken) = (Some(action), None);
            button.surrender_focus();
        }
        ui.horizontal(|ui| {
            if !keys.is_empty() {
                let name = say!("Take the key of {action} away", action = entry.label());
                if sign_button(ui, Sign::Cross, true, &name, tr("No key")) {
                    Arc::make_mut(keymap).unbind(action);
                }
            }
            if keymap.is_own(action) && ui.small_button(tr("as usual")).clicked() {
                Arc::make_mut(keymap).reset(action);
            }
        });
    }

    /// Asks what to do with a shortcut that other actions have.
    fn conflict_ui(&mut self, ui: &mut egui::Ui, preferences: &mut Preferences, palette: &Palette) {
        let Some((action, keys, others)) = &self.taken else { return };
        let names: Vec<&str> = others.iter().map(|other| other.row().label()).collect();
        let (key, action, keys) = (shortcut_text(ui.ctx(), keys), *action, *keys);
        ui.horizontal_wrapped(|ui| {
            let words = say!("{key} is the key of {actions} already.", key, actions = names.join(", "));
            ui.label(RichText::new(words).color(palette.warning));
            let give = ui.button(say!("Use it for {action}", action = action.row().label())).clicked();
            if give {
                Arc::make_mut(&mut preferences.keymap).bind(action, keys);
            }
            if ui.button(tr("Leave it")).clicked() || give {
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
            let value = drag_value(&mut pixels)
                .range(Screen::PIXELS)
                .speed(0.2)
                .max_decimals(1)
                .suffix(tr(" pixels an inch"));
            let value = ui.add(value);
            value.widget_info(|| {
                egui::WidgetInfo::labeled(
                    egui::accesskit::Role::SpinButton,
                    true,
                    tr("Pixels an inch of the screen"),
                )
            });
            if value.changed() {
                *screen = Screen(Some(pixels));
            }
            if screen.0.is_some() && ui.small_button(tr("as usual")).clicked() {
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
        let tip = tr("Hold a ruler here: the bar is 5 cm long. Then a pattern at 1:1 is as large as cloth.");
        ui.label(RichText::new(tip).color(palette.weak).size(12.0));
    });
}

/// The choice of the language, each by its own name.
fn language_ui(ui: &mut egui::Ui, chosen: &mut Language, languages: &Languages) {
    let all = languages.all();
    let name = |code: &str| all.iter().find(|(known, _)| *known == code).map(|(_, name)| (*name).to_owned());
    let system = tr("As the system");
    let shown = chosen.0.as_deref().map_or(system.to_owned(), |code| name(code).unwrap_or(code.to_owned()));
    let combo = ComboBox::from_id_salt("language").selected_text(&shown);
    let combo = list_ui(ui, combo, |entries| {
        entries.add_value(&mut chosen.0, None, system);
        for (code, name) in &all {
            entries.add_value(&mut chosen.0, Some((*code).to_owned()), *name);
        }
    });
    combo_name(&combo, tr("Language"), &shown);
}

fn general_ui(
    ui: &mut egui::Ui,
    preferences: &mut Preferences,
    languages: &Languages,
    palette: &Palette,
    height: f32,
) {
    ScrollArea::vertical().max_height(height).show(ui, |ui| {
        egui::Grid::new("general").num_columns(2).spacing([24.0, 12.0]).show(ui, |ui| {
            ui.label(tr("Language"));
            language_ui(ui, &mut preferences.language, languages);
            ui.end_row();
            ui.label(tr("Colours"));
            ui.horizontal(|ui| {
                for theme in Theme::ALL {
                    ui.selectable_value(&mut preferences.theme, theme, tr(theme.name()));
                }
            });
            ui.end_row();
            ui.label(tr("Size of everything"));
            let words = |percent: u16| format!("{percent} %");
            let combo = ComboBox::from_id_salt("scale").selected_text(words(preferences.scale.0));
            let shown = list_ui(ui, combo, |entries| {
                for percent in Scale::ALL {
                    entries.add_value(&mut preferences.scale, Scale(percent), words(percent));
                }
            });
            combo_name(&shown, tr("Size of everything"), &words(preferences.scale.0));
            ui.end_row();
            ui.label(tr("Lengths in"));
            ui.horizontal(|ui| {
                for unit in LengthUnit::ALL {
                    ui.selectable_value(&mut preferences.unit, unit, tr(unit.name()));
                }
            });
            ui.end_row();
            ui.label(tr("Fineness of the screen"));
            screen_ui(ui, &mut preferences.screen, palette);
            ui.end_row();
            ui.label(tr("Mouse"));
            ui.vertical(|ui| {
                for mouse in Mouse::ALL {
                    let choice = ui.radio_value(&mut preferences.mouse, mouse, tr(mouse.name()));
                    choice.on_hover_text(tr(mouse.tip()));
                }
            });
            ui.end_row();
            ui.label(tr("Copies of unsaved work"));
            let words = |seconds: u16| match seconds {
                0..60 => say!("every {seconds} seconds", seconds),
                _ => counted(usize::from(seconds / 60), "every minute", "every {n} minutes"),
            };
            let combo = ComboBox::from_id_salt("copies").selected_text(words(preferences.copies.0));
            let shown = list_ui(ui, combo, |entries| {
                for seconds in Copies::ALL {
                    entries.add_value(&mut preferences.copies, Copies(seconds), words(seconds));
                }
            });
            combo_name(&shown, tr("Copies of unsaved work"), &words(preferences.copies.0));
            ui.end_row();
            ui.label(tr("Large garments"));
            ui.checkbox(&mut preferences.card.0, tr("Drape on the graphics card")).on_hover_text(tr(
                "Where there is one. As accurate as on the processor, but not the same in every last digit on every \
                 machine: recordings then tell no hashes of the cloth.",
            ));
            ui.end_row();
        });
        ui.add_space(6.0);
        let tip =
            tr("Every command is written down at once besides: after a crash no more than the last is lost.");
        ui.label(RichText::new(tip).color(palette.weak).size(12.0));
    });
}
