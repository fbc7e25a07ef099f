//! Picking in the body pane: what is under a point of the screen.

use egui::{Pos2, Rect, Response};
use glam::DVec3;

use super::{ScenePane, Seen, size_of, within};
use crate::drag::Ray;
use crate::geometry::ids::MarkId;
use crate::render::Projection;

/// Largest distance of a click from a mark, points.
pub(super) const REACH: f32 = 12.0;

impl ScenePane {
    /// The point of the body under a point of the screen.
    pub(super) fn pick(&self, seen: &Seen<'_>, pane: Rect, at: Pos2) -> Option<DVec3> {
        let ray = self.camera.ray(within(pane, at), size_of(pane));
        let hit = seen.body?.ray(ray.origin.as_dvec3(), ray.direction.as_dvec3())?;
        Some(hit.point)
    }

    /// The farthest point of the body behind a point of the screen, where the skin faces away.
    pub(super) fn pick_far(&self, seen: &Seen<'_>, pane: Rect, at: Pos2) -> Option<DVec3> {
        let ray = self.camera.ray(within(pane, at), size_of(pane));
        let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3().normalize_or_zero());
        let body = seen.body?;
        let (lower, upper) = body.bounds();
        let beyond = ((lower + upper) / 2.0).distance(origin) + (upper - lower).length();
        Some(body.ray(origin + direction * beyond, -direction)?.point)
    }

    /// The points that a stroke at a point of the screen paints: on the near side, with the laser also on the far side.
    pub(super) fn hits(&self, seen: &Seen<'_>, pane: Rect, at: Pos2) -> [Option<DVec3>; 2] {
        let near = self.pick(seen, pane, at);
        [near, near.filter(|_| seen.laser).and_then(|_| self.pick_far(seen, pane, at))]
    }

    pub(super) fn mark_under(&self, seen: &Seen<'_>, pane: Rect, response: &Response) -> Option<MarkId> {
        self.mark_at(seen, pane, response.hover_pos().filter(|_| self.drag.is_none())?)
    }

    /// The visible mark on the body near a point of the screen.
    pub(super) fn mark_at(&self, seen: &Seen<'_>, pane: Rect, at: Pos2) -> Option<MarkId> {
        let (at, size) = (within(pane, at), size_of(pane));
        let distance = |points: &[DVec3]| {
            points
                .iter()
                .filter_map(|p| self.camera.project(p.as_vec3(), size).map(|q| (q.pixel.distance(at), *p)))
                .min_by(|a, b| a.0.total_cmp(&b.0))
        };
        seen.document
            .marks
            .body
            .iter()
            .filter_map(|mark| Some((mark.id, distance(&mark.points)?)))
            .filter(|(_, (d, p))| *d <= REACH && self.is_in_sight(seen, *p))
            .min_by(|a, b| a.1.0.total_cmp(&b.1.0))
            .map(|(id, _)| id)
    }

    /// Position on the screen of a point of the scene.
    pub fn place_of(&self, point: DVec3, pane: Rect) -> Option<Pos2> {
        let place = self.camera.project(point.as_vec3(), size_of(pane))?;
        Some(pane.min + egui::vec2(place.pixel.x, place.pixel.y))
    }

    /// Size of a point of the screen at the depth of `at`, metres; None behind the eye.
    pub(super) fn metres_per_point(&self, at: DVec3, pane: Rect) -> Option<f64> {
        let (size, right) = (size_of(pane), self.camera.rotation * glam::Vec3::X);
        let here = self.camera.project(at.as_vec3(), size)?;
        let beside = self.camera.project(at.as_vec3() + right * 0.1, size)?;
        Some(0.1 / f64::from((beside.pixel - here.pixel).length().max(1e-3)))
    }

    /// Whether a point is not hidden by the body.
    pub fn is_in_sight(&self, seen: &Seen<'_>, point: DVec3) -> bool {
        let eye = match self.camera.projection {
            Projection::Perspective => self.camera.eye(),
            Projection::Orthographic => {
                point.as_vec3() + self.camera.towards_eye() * self.camera.bounds.1 * 4.0
            }
        };
        let (eye, away) = (eye.as_dvec3(), (point - eye.as_dvec3()).length());
        if seen.look.xray {
            return true;
        }
        seen.body
            .and_then(|b| b.ray(eye, point - eye))
            .is_none_or(|hit| hit.distance > away - 0.01 * seen.body.map_or(1.0, |b| b.scale()))
    }

    pub(super) fn ray(&self, pane: Rect, at: Pos2) -> Ray {
        let ray = self.camera.ray(within(pane, at), size_of(pane));
        Ray { origin: ray.origin.as_dvec3(), direction: ray.direction.as_dvec3() }
    }
}
