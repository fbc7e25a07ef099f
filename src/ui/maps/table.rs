//! The statistics of the map, piece by piece.

use egui::RichText;

use super::ShownMap;
use crate::fit::maps::{MapStats, PieceStats};
use crate::ui::language::{number, tr};
use crate::ui::look::theme::Palette;

const HEADINGS: [&str; 8] = ["Piece", "Vertices", "Least", "1 %", "Median", "Mean", "99 %", "Most"];

/// Draws the table with a heading that names the map and its unit.
pub fn table_ui(ui: &mut egui::Ui, map: Option<&ShownMap>, palette: &Palette) {
    let Some(map) = map else {
        ui.label(RichText::new(tr("No map is shown: choose one in View › Map")).color(palette.weak));
        return;
    };
    let (unit, _) = map.kind().unit();
    ui.label(RichText::new(format!("{}, {unit}", map.heading())).strong());
    egui::Grid::new("map by pieces").num_columns(HEADINGS.len()).spacing([18.0, 4.0]).striped(true).show(
        ui,
        |ui| {
            for heading in HEADINGS {
                ui.label(RichText::new(tr(heading)).color(palette.weak).size(12.0));
            }
            ui.end_row();
            for cells in rows(map, tr("All"), number) {
                for (i, cell) in cells.iter().enumerate() {
                    let text = if i == 0 { RichText::new(cell) } else { RichText::new(cell).monospace() };
                    ui.label(text);
                }
                ui.end_row();
            }
        },
    );
}

/// The table as tab-separated text with a line of headings, in English.
pub fn text(map: &ShownMap) -> String {
    let (unit, _) = map.kind().unit();
    let head = HEADINGS.join("\t");
    let lines: Vec<String> =
        rows(map, "All", |v, digits| format!("{v:.digits$}")).map(|cells| cells.join("\t")).collect();
    format!("{}, {unit}\n{head}\n{}\n", map.title(), lines.join("\n"))
}

/// The cells of every row, the whole garment first, which is called `all`. `write` writes a value with so many decimals.
fn rows<'a>(
    map: &'a ShownMap,
    all: &'a str,
    write: fn(f64, usize) -> String,
) -> impl Iterator<Item = [String; 8]> {
    let ((_, times), digits) = (map.kind().unit(), map.kind().digits());
    let whole = (all, &map.stats);
    let pieces = map.pieces().iter().map(|PieceStats { piece, stats }| (piece.as_str(), stats));
    std::iter::once(whole).chain(pieces).map(move |(name, stats)| {
        let MapStats { count, min, p01, median, mean, p99, max } = *stats;
        let value = |v: f64| if count == 0 { "–".to_owned() } else { write(v * times + 0.0, digits) };
        let figures = [min, p01, median, mean, p99, max].map(value);
        let [min, p01, median, mean, p99, max] = figures;
        [name.to_owned(), count.to_string(), min, p01, median, mean, p99, max]
    })
}
