//! The section of the side panel that tells what the tape reads on the body.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};

use egui::{Grid, Label, RichText};

use crate::body::Surface;
use crate::body::readings::{Reading, readings};
use crate::ui::side_panel::Told;

/// Measures of the body, taken beside the window as soon as they are looked at.
#[derive(Debug, Default)]
pub struct TapePanel {
    of: Option<Arc<Surface>>,
    coming: Option<Receiver<Option<Vec<Reading>>>>,
    read: Option<Vec<Reading>>,
}

impl TapePanel {
    /// Draws the section.
    pub fn ui(&mut self, ui: &mut egui::Ui, told: &Told<'_>) {
        let Some(surface) = told.surface else { return };
        if !self.of.as_ref().is_some_and(|of| Arc::ptr_eq(of, surface)) {
            self.begin(ui.ctx().clone(), surface);
        }
        if let Some(read) = self.coming.as_ref().and_then(|coming| coming.try_recv().ok()) {
            (self.read, self.coming) = (read, None);
        }
        let weak = |words: &str| Label::new(RichText::new(words).color(told.palette.weak)).wrap();
        match (&self.read, &self.coming) {
            (Some(read), _) => {
                Grid::new("tape").num_columns(2).striped(true).spacing([12.0, 2.0]).show(ui, |ui| {
                    for Reading { name, metres, height, .. } in read {
                        let label = ui.label(*name);
                        // Tapes are read to the millimetre.
                        let text = |metres: f64| told.now.unit.text((metres * 1e3).round() / 1e3);
                        if let Some(height) = height {
                            let at = text(*height);
                            label.on_hover_text(format!("{at} above the floor"));
                        }
                        ui.label(text(*metres));
                        ui.end_row();
                    }
                });
            }
            (None, Some(_)) => _ = ui.add(weak("Measuring…")),
            (None, None) => _ = ui.add(weak("It does not look like a standing human.")),
        }
    }

    fn begin(&mut self, ctx: egui::Context, surface: &Arc<Surface>) {
        let (send, coming) = channel();
        let body = Arc::clone(surface);
        let work = move || {
            // Nobody waits any longer where the window has gone or the body is another.
            send.send(readings(&body.mesh)).ok();
            ctx.request_repaint();
        };
        let begun = std::thread::Builder::new().name("tape".to_owned()).spawn(work).is_ok();
        (self.of, self.coming, self.read) = (Some(Arc::clone(surface)), begun.then_some(coming), None);
    }
}
