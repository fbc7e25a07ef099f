//! The small text field that opens when a digit is typed while drawing or dragging.

use egui::{Area, Event, Frame, Key, Pos2, RichText, TextEdit, Vec2};

use super::{Laid, begins_number};
use crate::ui::language::tr;
use crate::ui::preferences::units::{Typed, typed};

/// The open field.
#[derive(Debug)]
pub struct Entry {
    text: String,
    at: Pos2,
    /// Whether it was opened in this frame.
    is_new: bool,
    wrong: Option<String>,
}

impl Entry {
    /// Opens a field at `at` if a number was begun in this frame, with what was typed.
    pub fn opened(ui: &egui::Ui, at: Pos2) -> Option<Self> {
        let text: String = ui.input_mut(|i| {
            let first = i.events.iter().position(|e| begins_number(e).is_some())?;
            let typed = |e: &Event| match e {
                Event::Text(text) => Some(text.clone()),
                _ => None,
            };
            let text = i.events[first..].iter().filter_map(typed).collect();
            i.events.retain(|e| !matches!(e, Event::Text(_)));
            Some(text)
        })?;
        Some(Self { text, at, is_new: true, wrong: None })
    }

    /// Draws the field. `take` receives the text when Enter is pressed. False when the field is to be closed.
    pub fn ui(
        &mut self,
        ui: &egui::Ui,
        laid: &Laid<'_>,
        take: impl FnOnce(Typed) -> Result<(), String>,
    ) -> bool {
        let id = ui.scope_id().with("numbers");
        let area = Area::new(id.with("area")).fixed_pos(self.at + Vec2::new(16.0, -34.0));
        let shown = area.order(egui::Order::Foreground).show(ui.ctx(), |ui| {
            Frame::popup(ui.style())
                .inner_margin(4)
                .show(ui, |ui| {
                    ui.horizontal(|ui| {
                        let field = TextEdit::singleline(&mut self.text).id(id).desired_width(92.0);
                        let field = ui.add(field);
                        let name = ui.label(RichText::new(laid.unit.sign()).color(laid.palette.weak));
                        let words = tr("Length, or x,y");
                        field.widget_info(|| {
                            egui::WidgetInfo::labeled(egui::accesskit::Role::TextInput, true, words)
                        });
                        field.labelled_by(name.id)
                    })
                    .inner
                })
                .inner
        });
        let field = shown.inner;
        if std::mem::take(&mut self.is_new) {
            field.request_focus();
            let mut state = TextEdit::load_state(ui.ctx(), id).unwrap_or_default();
            let end = egui::text::CCursor::new(self.text.chars().count());
            state.cursor.set_char_range(Some(egui::text::CCursorRange::one(end)));
            state.store(ui.ctx(), id);
            ui.ctx().request_repaint();
            return true;
        }
        if let Some(why) = &self.wrong {
            field.show_tooltip_text(RichText::new(why).color(laid.palette.error));
        }
        let (enter, escape) = ui.input(|i| (i.key_pressed(Key::Enter), i.key_pressed(Key::Escape)));
        if escape {
            return false;
        }
        if enter {
            self.wrong = typed(&self.text, laid.unit).and_then(take).err();
            if self.wrong.is_some() {
                field.request_focus();
            }
            return self.wrong.is_some();
        }
        !field.lost_focus()
    }
}
