//! *Help › Manual*: topics on the left, one of them on the right.

use egui::{Grid, Id, Label, Modal, RichText, ScrollArea, text::LayoutJob};

use crate::manual::{Block, Topic, parts, topics_in};
use crate::ui::language::{self, tr};
use crate::ui::look::theme::Palette;

/// Largest width of the text, points.
const WIDTH: f32 = 820.0;
/// Width of the list of topics, points.
const LIST: f32 = 190.0;

/// The open manual, and its chosen topic.
#[derive(Debug, Default)]
pub struct ManualPage {
    topic: usize,
}

impl ManualPage {
    /// Draws the manual. False when it is to be closed.
    pub fn ui(&mut self, ctx: &egui::Context, palette: &Palette) -> bool {
        let room = ctx.content_rect().size();
        let height = (room.y - 200.0).max(160.0);
        let topics = topics_in(language::code());
        let shown = Modal::new(Id::unique("manual")).show(ctx, |ui| {
            ui.set_width((room.x - 80.0).min(WIDTH));
            ui.heading(tr("Manual"));
            ui.separator();
            ui.horizontal_top(|ui| {
                ui.set_height(height);
                ui.vertical(|ui| {
                    ui.set_width(LIST);
                    for (i, topic) in topics.iter().enumerate() {
                        if ui.selectable_label(self.topic == i, topic.title()).clicked() {
                            self.topic = i;
                        }
                    }
                });
                ui.separator();
                ui.vertical(|ui| {
                    // Each topic keeps its own scroll position and begins at its top.
                    let scroll = ScrollArea::vertical().id_salt(self.topic).max_height(height);
                    scroll.auto_shrink(false).show(ui, |ui| topic_ui(ui, &topics[self.topic], palette));
                });
            });
            ui.separator();
            ui.button(tr("Close")).clicked()
        });
        !(shown.inner || shown.should_close())
    }
}

fn topic_ui(ui: &mut egui::Ui, topic: &Topic, palette: &Palette) {
    ui.spacing_mut().item_spacing.y = 7.0;
    for (i, block) in topic.blocks().iter().enumerate() {
        match block {
            Block::Heading(1, words) => {
                ui.heading(words);
            }
            Block::Heading(_, words) => {
                ui.add_space(6.0);
                ui.label(RichText::new(words).strong().size(15.0));
            }
            Block::Words(words) => {
                ui.add(Label::new(emphasised(ui, words)).wrap());
            }
            Block::Item(sign, words) => {
                ui.horizontal_top(|ui| {
                    ui.label(RichText::new(sign).color(palette.weak));
                    ui.add(Label::new(emphasised(ui, words)).wrap());
                });
            }
            Block::Command(words) => {
                ui.label(RichText::new(words).monospace());
            }
            Block::Table(rows) => table_ui(ui, i, rows),
        }
    }
}

fn table_ui(ui: &mut egui::Ui, number: usize, rows: &[Vec<String>]) {
    let columns = rows.iter().map(Vec::len).max().unwrap_or(1);
    let width = (ui.available_width() - 24.0) / columns as f32;
    let grid = Grid::new(("table", number)).num_columns(columns).striped(true).max_col_width(width);
    grid.spacing([12.0, 6.0]).show(ui, |ui| {
        for (i, row) in rows.iter().enumerate() {
            for cell in row {
                let text = if i == 0 { RichText::new(cell).strong().into() } else { emphasised(ui, cell) };
                ui.add(Label::new(text).wrap());
            }
            ui.end_row();
        }
    });
}

/// Text with menu entries and typed text emphasised.
fn emphasised(ui: &egui::Ui, words: &str) -> egui::WidgetText {
    let mut job = LayoutJob::default();
    for (stands_out, part) in parts(words) {
        let text = RichText::new(part);
        let text = if stands_out { text.strong() } else { text };
        text.append_to(&mut job, ui.style(), egui::FontSelection::Default, egui::Align::BOTTOM);
    }
    job.into()
}
