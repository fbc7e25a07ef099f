//! The view of the table: the visible part of the pattern plane.

use egui::{Pos2, Rect, Vec2, pos2};
use glam::DVec2;

use crate::pattern::Pattern;

/// Largest scale, screen points per metre.
const CLOSEST: f64 = 20_000.0;
/// Smallest scale, screen points per metre.
const FARTHEST: f64 = 20.0;

/// Room between what is framed and the border of the pane, points.
const ROOM: f32 = 28.0;

/// The mapping from table to screen; y points up on the table and down on the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TableView {
    /// The point of the table in the centre of the pane, metres.
    pub centre: DVec2,
    /// Scale, screen points per metre.
    pub scale: f64,
}

impl Default for TableView {
    fn default() -> Self {
        Self { centre: DVec2::ZERO, scale: 400.0 }
    }
}

impl TableView {
    /// Position on the screen of a point of the table.
    pub fn screen_from_table(&self, pane: Rect, p: DVec2) -> Pos2 {
        let d = (p - self.centre) * self.scale;
        pane.center() + Vec2::new(d.x as f32, -d.y as f32)
    }

    /// The point of the table under a point of the screen.
    pub fn table_from_screen(&self, pane: Rect, p: Pos2) -> DVec2 {
        let d = p - pane.center();
        self.centre + DVec2::new(f64::from(d.x), -f64::from(d.y)) / self.scale
    }

    /// Moves the view with the pointer, by screen points.
    pub fn pan(&mut self, by: Vec2) {
        self.centre -= DVec2::new(f64::from(by.x), -f64::from(by.y)) / self.scale;
    }

    /// Zooms by `factor`; the point of the table under `at` stays there.
    pub fn zoom(&mut self, pane: Rect, at: Pos2, factor: f64) {
        let fixed = self.table_from_screen(pane, at);
        self.scale = (self.scale * factor).clamp(FARTHEST, CLOSEST);
        self.centre += fixed - self.table_from_screen(pane, at);
    }

    /// Frames the whole pattern.
    pub fn fit(&mut self, pane: Rect, pattern: &Pattern) {
        let (lower, upper) = bounds(pattern).unwrap_or((DVec2::splat(-0.5), DVec2::splat(0.5)));
        self.fit_box(pane, [lower, upper]);
    }

    /// Frames everything between two corners of the table.
    pub fn fit_box(&mut self, pane: Rect, [lower, upper]: [DVec2; 2]) {
        let size = (upper - lower).max(DVec2::splat(0.05));
        let room = pane.shrink(ROOM).size().max(Vec2::splat(20.0));
        self.scale = (f64::from(room.x) / size.x).min(f64::from(room.y) / size.y).clamp(FARTHEST, CLOSEST);
        self.centre = (lower + upper) / 2.0;
    }

    /// Brings everything between two corners of the table into view: by the shortest way at the present scale where there is room, else
    /// by framing it with what is seen already.
    pub fn reveal(&mut self, pane: Rect, [lower, upper]: [DVec2; 2]) {
        let (from, to) = self.seen(pane.shrink(ROOM));
        if (upper - lower).cmple(to - from).all() {
            self.centre += (upper - to).max(DVec2::ZERO) + (lower - from).min(DVec2::ZERO);
        } else {
            self.fit_box(pane, [lower.min(from), upper.max(to)]);
        }
    }

    /// Shows the pattern at true size on a screen with this many points per metre.
    pub fn true_size(&mut self, points_per_metre: f64) {
        self.scale = points_per_metre.clamp(FARTHEST, CLOSEST);
    }

    /// The visible part of the table: lower and upper corner.
    pub fn seen(&self, pane: Rect) -> (DVec2, DVec2) {
        (
            self.table_from_screen(pane, pos2(pane.left(), pane.bottom())),
            self.table_from_screen(pane, pos2(pane.right(), pane.top())),
        )
    }
}

fn bounds(pattern: &Pattern) -> Option<(DVec2, DVec2)> {
    pattern
        .pieces
        .values()
        .filter(|piece| !piece.hidden)
        .flat_map(|piece| {
            let pose = piece.pose;
            piece.flattened(2e-3).into_iter().map(move |p| pose.plane_from_piece(p))
        })
        .map(|p| (p, p))
        .reduce(|(a, b), (c, d)| (a.min(c), b.max(d)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::Piece;

    const PANE: Rect = Rect { min: Pos2 { x: 10.0, y: 20.0 }, max: Pos2 { x: 410.0, y: 320.0 } };

    #[test]
    fn screen_and_table_are_inverse_and_zoom_keeps_the_pointer() {
        let mut view = TableView { centre: DVec2::new(0.3, -0.2), scale: 250.0 };
        let at = pos2(77.0, 222.0);
        let p = view.table_from_screen(PANE, at);
        assert!((view.screen_from_table(PANE, p) - at).length() < 1e-3);
        view.zoom(PANE, at, 1.7);
        assert!((view.table_from_screen(PANE, at) - p).length() < 1e-9);
        view.pan(Vec2::new(5.0, -3.0));
        assert!((view.screen_from_table(PANE, p) - (at + Vec2::new(5.0, -3.0))).length() < 1e-3);
    }

    #[test]
    fn what_is_revealed_is_in_view_and_the_scale_stays_where_there_is_room() {
        let start = TableView { centre: DVec2::ZERO, scale: 400.0 };
        let check = |lower: (f64, f64), upper: (f64, f64), keeps_scale: bool| {
            let (bounds, mut view) = ([lower, upper].map(DVec2::from), start);
            view.reveal(PANE, bounds);
            assert!(bounds.iter().all(|&p| PANE.contains(view.screen_from_table(PANE, p))), "{view:?}");
            assert_eq!(view.scale == start.scale, keeps_scale, "{view:?}");
            view
        };
        assert_eq!(check((-0.1, -0.1), (0.1, 0.1), true), start, "it is in view already");
        assert_eq!(check((0.6, 0.0), (0.9, 0.2), true).centre.y, 0.0, "moved along one axis alone");
        let far = check((5.0, 0.0), (7.0, 1.0), false);
        assert!(PANE.contains(far.screen_from_table(PANE, DVec2::ZERO)), "what was seen stays in view");
    }

    #[test]
    fn fitting_shows_every_piece() {
        let mut pattern = Pattern::default();
        let corners = [DVec2::new(1.0, 2.0), DVec2::new(4.0, 2.0), DVec2::new(2.0, 3.0)];
        pattern.add_piece(Piece::polygon("p", &corners));
        let mut view = TableView::default();
        view.fit(PANE, &pattern);
        assert!(corners.iter().all(|&p| PANE.contains(view.screen_from_table(PANE, p))));
    }
}
