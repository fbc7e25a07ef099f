//! Short messages over the panes. Errors stay until they are closed.

use std::time::{Duration, Instant};

use egui::{Align2, Area, Color32, Frame, Id, Order, Stroke};

use crate::ui::language::{say, tr, unbroken};
use crate::ui::look::theme::Palette;

/// Time that a message which is no error is shown.
const SHOWN: Duration = Duration::from_secs(6);
/// Largest number of messages shown at once; older ones are removed.
const MOST: usize = 4;

/// Largest number of messages in the log.
const MOST_LOGGED: usize = 500;

/// A message being shown.
#[derive(Debug)]
struct Message {
    words: String,
    is_error: bool,
    since: Instant,
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
        self.push(words.into(), false);
    }

    /// Shows an error.
    pub fn error(&mut self, words: impl Into<String>) {
        self.push(words.into(), true);
    }

    fn push(&mut self, words: String, is_error: bool) {
        self.all.retain(|m| m.words != words);
        if self.all.len() >= MOST {
            // The oldest message that is no error is removed; errors stay until they are read.
            let oldest = self.all.iter().position(|m| !m.is_error).unwrap_or(0);
            self.all.remove(oldest);
        }
        let after = self.begun.get_or_insert_with(Instant::now).elapsed();
        if self.log.len() >= MOST_LOGGED {
            self.log.remove(0);
        }
        self.log.push(LogEntry { words: words.clone(), is_error, after });
        self.all.push(Message { words, is_error, since: Instant::now() });
    }

    /// Draws the messages in the lower left corner, above `above`.
    pub fn ui(&mut self, ctx: &egui::Context, palette: &Palette, above: f32) {
        self.all.retain(|m| m.is_error || m.since.elapsed() < SHOWN);
        let Some(next) = self.all.iter().filter(|m| !m.is_error).map(|m| m.since).min() else {
            return self.show(ctx, palette, above);
        };
        ctx.request_repaint_after(SHOWN.saturating_sub(next.elapsed()) + Duration::from_millis(20));
        self.show(ctx, palette, above);
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
    let edge = if message.is_error { palette.error } else { palette.accent };
    Frame::popup(ui.style())
        .stroke(Stroke::new(1.0, edge))
        .shadow(egui::Shadow { offset: [0, 2], blur: 10, spread: 0, color: Color32::from_black_alpha(40) })
        .show(ui, |ui| {
            ui.horizontal_top(|ui| {
                let close = ui.small_button("×").on_hover_text(tr("Close this message"));
                let text = egui::RichText::new(unbroken(&message.words));
                let label = egui::Label::new(if message.is_error { text.color(edge) } else { text }).wrap();
                let words = &message.words;
                ui.add(label).widget_info(|| egui::WidgetInfo::labeled(egui::Role::Label, true, words));
                close.clicked()
            })
            .inner
        })
        .inner
}
