//! Shows a tight place in both panes.

use glam::DVec3;

use crate::sim::ClothPlace;
use crate::ui::app::App;
use crate::ui::scenery::ring::flat;
use crate::ui::selection::Selection;

impl App {
    /// Selects the piece of a tight place, marks the place by a ring and turns the view to it.
    pub(in crate::ui) fn show_place(&mut self, place: ClothPlace) {
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

    /// The tight place that is shown; None once the cloth has moved.
    pub fn spot(&self) -> Option<ClothPlace> {
        let tight = &self.shown().snapshot().tight;
        self.picks.spot.filter(|spot| tight.iter().any(|place| flat(place) == *spot))
    }
}
