//! Short messages over the panes. Errors, and what is wrong with a result, stay until they are closed.

use std::time::{Duration, Instant};

use egui::{Align2, Area, Color32, Frame, Id, Order, Stroke};

use crate::ui::language::{say, tr, unbroken};
use crate::ui::look::theme::Palette;

/// Time that a message which does not stay is shown.
const SHOWN: Duration = Duration::from_secs(6);
/// Largest number of messages shown at once; older ones are removed.
const MOST: usize = 4;

/// Largest number of messages in the log.
const MOST_LOGGED: usize = 500;

/// A message being shown.
#[derive(Debug)]
struct Message {
    words: String,
    kind: Kind,
    since: Instant,
}

/// How a message is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// For a while.
    Note,
    /// Until it is closed, or the next of its kind comes.
    Result,
    /// Until it is closed.
    Error,
}

/// A message in the log.
#[derive(Debug)]
struct LogEntry {
    words: String,
    is_error: bool,
    /// Time since the first message.
    after: Duration,
}

/// The shown messages, oldest first, and the log.
#[derive(Debug, Default)]
pub struct Messages {
    all: Vec<Message>,
    /// The log of all messages.
    log: Vec<LogEntry>,
    begun: Option<Instant>,
}

impl Messages {
    /// Shows a message.
    pub fn tell(&mut self, words: impl Into<String>) {
        self.push(words.into(), Kind::Note);
    }

    /// Shows what is wrong with what was made, in place of what was said so before.
    pub fn tell_result(&mut self, words: impl Into<String>) {
        self.forget_result();
        self.push(words.into(), Kind::Result);
    }

    /// Removes what [`Self::tell_result`] shows.
    pub fn forget_result(&mut self) {
        self.all.retain(|m| m.kind != Kind::Result);
    }

    /// Shows an error.
    pub fn error(&mut self, words: impl Into<String>) {
        self.push(words.into(), Kind::Error);
    }

    fn push(&mut self, words: String, kind: Kind) {
        self.all.retain(|m| m.words != words);
        if self.all.len() >= MOST {
            // The oldest message that does not stay is removed.
            let oldest = self.all.iter().position(|m| m.kind == Kind::Note).unwrap_or(0);
            self.all.remove(oldest);
        }
        let after = self.begun.get_or_insert_with(Instant::now).elapsed();
        if self.log.len() >= MOST_LOGGED {
            self.log.remove(0);
        }
        self.log.push(LogEntry { words: words.clone(), is_error: kind == Kind::Error, after });
        self.all.push(Message { words, kind, since: Instant::now() });
    }

    /// Draws the messages in the lower left corner, above `above`.
    pub fn ui(&mut self, ctx: &egui::Context, palette: &Palette, above: f32) {
        self.forget_old(Instant::now());
        let Some(next) = self.all.iter().filter(|m| m.kind == Kind::Note).map(|m| m.since).min() else {
            return self.show(ctx, palette, above);
        };
        ctx.request_repaint_after(SHOWN.saturating_sub(next.elapsed()) + Duration::from_millis(20));
        self.show(ctx, palette, above);
    }

    fn forget_old(&mut self, now: Instant) {
        self.all.retain(|m| m.kind != Kind::Note || now.duration_since(m.since) < SHOWN);
    }

    /// The log as text, a line for each message.
    pub fn text(&self) -> String {
        self.log.iter().map(|told| format!("{}\n", told.line())).collect()
    }

    /// Draws the log, each message with a button that copies it.
    pub fn log_ui(&self, ui: &mut egui::Ui, palette: &Palette) {
        if self.log.is_empty() {
            ui.label(egui::RichText::new(tr("Nothing was told yet")).color(palette.weak));
        }
        for told in &self.log {
            ui.horizontal_top(|ui| {
                if ui.small_button(tr("Copy")).clicked() {
                    ui.ctx().copy_text(told.words.clone());
                }
                let text = egui::RichText::new(told.line());
                let text = if told.is_error { text.color(palette.error) } else { text };
                ui.add(egui::Label::new(text).wrap().selectable(true));
            });
        }
    }

    fn show(&mut self, ctx: &egui::Context, palette: &Palette, above: f32) {
        if self.all.is_empty() {
            return;
        }
        let mut closed = None;
        Area::new(Id::unique("messages"))
            .order(Order::Foreground)
            .anchor(Align2::LEFT_BOTTOM, [14.0, -above - 12.0])
            .show(ctx, |ui| {
                ui.set_max_width(460.0);
                for (i, message) in self.all.iter().enumerate() {
                    if message_ui(ui, message, palette) {
                        closed = Some(i);
                    }
                }
            });
        if let Some(i) = closed {
            self.all.remove(i);
        }
    }
}

impl LogEntry {
    fn line(&self) -> String {
        let seconds = self.after.as_secs();
        let told =
            if self.is_error { say!("Error: {words}", words = self.words) } else { self.words.clone() };
        format!("{:02}:{:02}  {told}", seconds / 60, seconds % 60)
    }
}

fn message_ui(ui: &mut egui::Ui, message: &Message, palette: &Palette) -> bool {
    let is_error = message.kind == Kind::Error;
    let edge = if is_error { palette.error } else { palette.accent };
    Frame::popup(ui.style())
        .stroke(Stroke::new(1.0, edge))
        .shadow(egui::Shadow { offset: [0, 2], blur: 10, spread: 0, color: Color32::from_black_alpha(40) })
        .show(ui, |ui| {
            ui.horizontal_top(|ui| {
                let close = ui.small_button("×").on_hover_text(tr("Close this message"));
                let text = egui::RichText::new(unbroken(&message.words));
                let label = egui::Label::new(if is_error { text.color(edge) } else { text }).wrap();
                let words = &message.words;
                ui.add(label).widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, words));
                close.clicked()
            })
            .inner
        })
        .inner
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_wrong_with_a_result_stays_until_the_next() {
        let mut messages = Messages::default();
        let shown = |messages: &Messages| messages.all.iter().map(|m| m.words.clone()).collect::<Vec<_>>();
        messages.tell("a note");
        messages.tell_result("it slid down");
        messages.error("no room");
        messages.forget_old(Instant::now() + SHOWN);
        assert_eq!(shown(&messages), ["it slid down", "no room"]);
        messages.tell_result("it crosses itself");
        assert_eq!(shown(&messages), ["no room", "it crosses itself"]);
        messages.forget_result();
        assert_eq!(shown(&messages), ["no room"]);
    }
}
