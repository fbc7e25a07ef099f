//! Snapping: the pointer is drawn to points, edges, guides and the grid near it.

use egui::Modifiers;
use glam::DVec2;

use super::table::{Guide, Table};
use crate::pattern::EdgeRef;
use crate::pattern::edit::PointRef;

/// Snapping distances, points: to points, middles of edges, edges, guides.
const PULL: [f64; 4] = [10.0, 9.0, 7.0, 6.0];
/// Smallest grid step to which free places are rounded, points. It is too short to be noticed, and gives round measurements.
const FINEST_STEP: f64 = 3.0;

/// A place after snapping, and what it snapped to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Snapped {
    /// Position on the table, metres.
    pub place: DVec2,
    /// What the place snapped to; None if it is where the pointer is.
    pub by: Option<Snap>,
}

/// What a place can snap to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Snap {
    Point,
    Middle,
    Edge(EdgeRef, f64),
    Guide,
    Grid,
    Angle,
}

impl Snap {
    /// The name shown beside the pointer.
    pub fn name(self) -> &'static str {
        match self {
            Self::Point => "point",
            Self::Middle => "middle",
            Self::Edge(..) => "edge",
            Self::Guide => "guide",
            Self::Grid => "grid",
            Self::Angle => "angle",
        }
    }
}

impl Table<'_> {
    /// The place that `p` snaps to. Shift restricts it to multiples of 45 degrees around `from`; Alt and Ctrl switch snapping
    /// off. Points for which `moves` is true, and edges at them, are ignored.
    pub fn snapped(
        &self,
        p: DVec2,
        from: Option<DVec2>,
        held: Modifiers,
        moves: impl Fn(PointRef) -> bool,
    ) -> Snapped {
        if let Some(from) = from.filter(|_| held.shift) {
            return Snapped { place: on_eighth(from, p), by: Some(Snap::Angle) };
        }
        if !self.laid.snapping || held.alt || held.command {
            return Snapped { place: p, by: None };
        }
        let found = self.by_points(p, &moves).or_else(|| self.by_edges(p, &moves));
        found.unwrap_or_else(|| self.by_lines(p))
    }

    fn by_points(&self, p: DVec2, moves: &impl Fn(PointRef) -> bool) -> Option<Snapped> {
        let reach = self.reach(PULL[0]);
        let near = self.points().filter(|(point, q)| q.distance(p) <= reach && !moves(*point));
        let nearest = near.min_by(|a, b| a.1.distance(p).total_cmp(&b.1.distance(p)));
        nearest.map(|(_, place)| Snapped { place, by: Some(Snap::Point) })
    }

    fn by_edges(&self, p: DVec2, moves: &impl Fn(PointRef) -> bool) -> Option<Snapped> {
        let hit = self.edge_near(p, PULL[1])?;
        let piece = self.pattern().pieces.get(&hit.edge.piece)?;
        let ends = [hit.edge.edge, piece.next_edge(hit.edge.edge)];
        if ends.iter().any(|&point| moves(PointRef { piece: hit.edge.piece, point })) {
            return None;
        }
        let middle = piece.pose.plane_from_piece(piece.edge_points(hit.edge.edge, &[0.5])[0]);
        if middle.distance(p) <= self.reach(PULL[1]) {
            return Some(Snapped { place: middle, by: Some(Snap::Middle) });
        }
        let on_curve = piece.pose.plane_from_piece(piece.edge_points(hit.edge.edge, &[hit.at])[0]);
        let near = hit.distance <= self.reach(PULL[2]);
        near.then_some(Snapped { place: on_curve, by: Some(Snap::Edge(hit.edge, hit.at)) })
    }

    /// Snaps to guides and the grid, x and y independently.
    fn by_lines(&self, p: DVec2) -> Snapped {
        let (mut place, mut by) = (self.rounded(p), Some(Snap::Grid));
        for guide in self.guides {
            let (line, own) = match guide {
                Guide::Upright(x) => (*x, &mut place.x),
                Guide::Level(y) => (*y, &mut place.y),
            };
            if (line - *own).abs() <= self.reach(PULL[3] + FINEST_STEP / 2.0) {
                (*own, by) = (line, Some(Snap::Guide));
            }
        }
        Snapped { place, by }
    }

    /// `p` rounded to the grid, with the finest step that is distinguishable at this scale.
    pub fn rounded(&self, p: DVec2) -> DVec2 {
        let steps = self.laid.unit.steps();
        let fine = steps.iter().find(|&&step| step * self.view.scale >= FINEST_STEP);
        let step = *fine.unwrap_or(&steps[steps.len() - 1]);
        (p / step).round() * step
    }
}

/// `p` projected to the nearest of the eight rays from `from`.
pub fn on_eighth(from: DVec2, p: DVec2) -> DVec2 {
    let eighth = std::f64::consts::FRAC_PI_4;
    let turn = ((p - from).to_angle() / eighth).round() * eighth;
    let ray = DVec2::from_angle(turn);
    from + ray * (p - from).dot(ray)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn with_shift_lines_run_in_eighths_of_a_turn() {
        let p = on_eighth(DVec2::ONE, DVec2::new(3.0, 1.2));
        assert!((p - DVec2::new(3.0, 1.0)).length() < 1e-12, "{p}");
        let p = on_eighth(DVec2::ZERO, DVec2::new(1.0, 1.2));
        assert!((p - DVec2::splat(1.1)).length() < 1e-12, "{p}");
    }
}
