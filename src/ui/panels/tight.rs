//! The list of tight places; a click shows one in both panes.

use egui::Ui;

use crate::fit::TightPlace;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::panels::context::{PanelContext, problem_row};
use crate::ui::scenery::ring::flat;

/// Draws a row for each tight place.
pub fn tight_ui(ui: &mut Ui, told: &PanelContext<'_>, asks: &mut Asks) {
    for place in &*told.snapshot.tight {
        let shows = (Ask::ShowPlace(flat(place)), "Show it in both panes");
        problem_row(ui, told.palette.warning, &words(place), Some(shows), asks);
    }
}

fn words(place: &TightPlace) -> String {
    let what = if place.tight.strain < 0.0 { "Pressed" } else { "Tight" };
    format!("{what}: {}", place.tight)
}
