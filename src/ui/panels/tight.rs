//! The list of tight places; a click shows one in both panes.

use egui::Ui;

use crate::fit::TightPlace;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::{say, signed, tr, translated};
use crate::ui::panels::context::{PanelContext, problem_row};
use crate::ui::scenery::ring::flat;

/// Draws a row for each tight place.
pub fn tight_ui(ui: &mut Ui, told: &PanelContext<'_>, asks: &mut Asks) {
    for place in &*told.snapshot.tight {
        let shows = (Ask::ShowPlace(flat(place)), tr("Show it in both panes"));
        problem_row(ui, told.palette.warning, &words(place), Some(shows), asks);
    }
}

fn words(place: &TightPlace) -> String {
    let tight = &place.tight;
    let near = tight.landmark.as_ref().and_then(|landmark| translated(&landmark.replace('_', " ")));
    let place = match near {
        Some(near) => say!(
            "{piece} near {place}, {strain} %",
            piece = tight.piece,
            place = near,
            strain = signed(tight.strain * 100.0, 1)
        ),
        None => tight.to_string(),
    };
    match tight.strain < 0.0 {
        true => say!("Pressed: {place}", place),
        false => say!("Tight: {place}", place),
    }
}
