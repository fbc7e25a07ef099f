//! Where the garment is tight: told in the side panel, shown in both panes by a click.

use egui::Ui;
use glam::{DVec2, DVec3};

use crate::fit::TightPlace;
use crate::geometry::ids::PieceId;
use crate::sim::ClothPlace;
use crate::ui::app::App;
use crate::ui::asks::{Ask, Asks};
use crate::ui::selection::Selection;
use crate::ui::side_panel::{Told, problem_row};

/// Radius of the ring round a place that is shown, metres on the flat cloth.
const RING: f64 = 0.025;
/// Corners of that.
const CORNERS: u32 = 40;

/// A row for each tight place.
pub fn tight_ui(ui: &mut Ui, told: &Told<'_>, asks: &mut Asks) {
    for place in &*told.snapshot.tight {
        let shows = (Ask::ShowPlace(flat(place)), "Show it in both panes");
        problem_row(ui, told.palette.warning, &words(place), Some(shows), asks);
    }
}

fn words(place: &TightPlace) -> String {
    let what = if place.tight.strain < 0.0 { "Pressed" } else { "Tight" };
    format!("{what}: {}", place.tight)
}

fn flat(place: &TightPlace) -> ClothPlace {
    ClothPlace { piece: place.piece, at: place.flat }
}

/// The line round a place, in its piece's own plane.
pub fn ring(place: ClothPlace) -> (PieceId, Vec<DVec2>) {
    let turn = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(CORNERS);
    (place.piece, (0..=CORNERS).map(|i| place.at + DVec2::from_angle(turn(i)) * RING).collect())
}

impl App {
    /// Selects the piece of a tight place, rings the place and turns the view to it.
    pub(super) fn show_place(&mut self, place: ClothPlace) {
        let session = self.shown();
        let found = session.snapshot().tight.iter().find(|tight| flat(tight) == place);
        let (Some(at), Some(surface)) = (found.map(|f| f.tight.at), session.surface().cloned()) else {
            return;
        };
        self.pick(Selection::of_pieces([place.piece]));
        self.picks.spot = Some(place);
        self.show_cloth = true;
        self.scene_pane.show(&[DVec3::from_array(at)], &surface);
    }

    /// The tight place that is shown, while the cloth lies as it did then.
    pub fn spot(&self) -> Option<ClothPlace> {
        let tight = &self.shown().snapshot().tight;
        self.picks.spot.filter(|spot| tight.iter().any(|place| flat(place) == *spot))
    }
}
