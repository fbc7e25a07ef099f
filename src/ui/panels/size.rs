//! The choice of a size from a table.

use std::path::Path;

use egui::{ComboBox, RichText};

use crate::body::Measurements;
use crate::draft::SIZE_TABLES;
use crate::io::sizes::{self, Size};
use crate::session::{BodyChoice, Command};
use crate::ui::actions::Action;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::{said, tr};
use crate::ui::list::{Entries, list_ui};
use crate::ui::panels::context::PanelContext;

/// Width of the list, points.
const WIDTH: f32 = 140.0;

/// A table of sizes to choose from.
#[derive(Debug, Default)]
pub struct SizePanel {
    /// Name of the table's file, and its sizes.
    table: Option<(String, Vec<Size>)>,
}

impl SizePanel {
    /// Reads the sizes in `bytes`, from the file `path`. The error is a message.
    pub fn take(&mut self, path: &Path, bytes: &[u8]) -> Result<(), String> {
        let sizes =
            sizes::read(bytes).map_err(|why| format!("{}: {}", path.display(), said(&why.words())))?;
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        self.table = Some((name, sizes));
        Ok(())
    }

    /// Draws the button that opens a table, and the list of its sizes; sizes that no mannequin can have are disabled.
    pub fn ui(&self, ui: &mut egui::Ui, told: &PanelContext<'_>, asks: &mut Asks) {
        let enabled = !told.now.wrapping && !told.now.demo;
        ui.add_enabled_ui(enabled, |ui| {
            if ui.button(tr("From a table of sizes…")).on_hover_text(tr(Action::Sizes.row().tip)).clicked()
            {
                asks.push(Ask::Act(Action::Sizes));
            }
            ui.menu_button(tr("Usual sizes"), |ui| usual_ui(ui, &told.document.body, asks));
            let Some((name, sizes)) = &self.table else { return };
            ui.label(RichText::new(name).color(told.palette.weak).size(12.5));
            let body = &told.document.body;
            let is_taken = |size: &Size| body.measurements() == Some(size.measurements);
            let taken = sizes.iter().find(|size| is_taken(size));
            let taken = taken.map_or(tr("none of these"), |size| &size.name);
            let combo = ComboBox::from_label(tr("Size")).selected_text(taken).width(WIDTH);
            list_ui(ui, combo, |entries| {
                for size in sizes {
                    add_size(entries, size, is_taken(size), body, asks);
                }
            });
        });
        ui.add_space(4.0);
    }
}

fn add_size(entries: &mut Entries<'_>, size: &Size, is_taken: bool, body: &BodyChoice, asks: &mut Asks) {
    let checked = size.measurements.check();
    let button = entries.add_enabled(checked.is_ok(), is_taken, &size.name);
    match checked {
        Ok(()) => {
            let words = tr("The mannequin is built to this size; marks and garment go along");
            if button.on_hover_text(words).clicked() && !is_taken {
                asks.push(built_to(size.measurements, body));
            }
        }
        Err(why) => _ = button.on_disabled_hover_text(said(&why.words())),
    }
}

/// The tables of sizes that are built in.
fn usual_ui(ui: &mut egui::Ui, body: &BodyChoice, asks: &mut Asks) {
    for table in SIZE_TABLES {
        ui.menu_button(tr(table.title), |ui| {
            for size in table.sizes {
                let measurements = size.measurements();
                let is_taken = body.measurements() == Some(measurements);
                let words = tr("The mannequin is built to this size; marks and garment go along");
                let clicked =
                    ui.selectable_label(is_taken, size.name.to_uppercase()).on_hover_text(words).clicked();
                if clicked {
                    ui.close();
                }
                if clicked && !is_taken {
                    asks.push(built_to(measurements, body));
                }
            }
        });
    }
}

fn built_to(measurements: Measurements, body: &BodyChoice) -> Ask {
    Ask::Do(match body.measurements() {
        Some(_) => Command::ChangeSize { measurements },
        None => Command::SetBody { body: BodyChoice::Mannequin(measurements), animations: None },
    })
}
