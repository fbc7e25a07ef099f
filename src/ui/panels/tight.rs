//! The list of tight places; a click shows one in both panes.

use egui::Ui;

use crate::fit::TightPlace;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::fit_page::words::tight_words;
use crate::ui::language::{say, tr};
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
    let (tight, place) = (&place.tight, tight_words(&place.tight));
    match tight.strain < 0.0 {
        true => say!("Pressed: {place}", place),
        false => say!("Tight: {place}", place),
    }
}
