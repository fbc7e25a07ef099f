//! The view of the body: turning, moving, zooming, framing.

use std::sync::Arc;

use egui::{Rect, Response};
use glam::{DVec3, Vec2, Vec3};

use super::facing::facing;
use super::{Drag, ScenePane, Seen, size_of, within};
use crate::body::Surface;
use crate::render::View;
use crate::ui::pointer::mouse::PointerAction;

/// Rotation of the view per point of pointer motion, radians.
const TURN: f32 = 0.0085;
/// Logarithm of the zoom factor per point of pointer motion.
const ZOOM: f32 = 0.008;
/// Space around points that are framed by themselves, metres on a body 1.5 m tall.
const ROOM: f64 = 0.18;

impl ScenePane {
    /// Notes that `body` is shown next, for which the camera is to stay as it is.
    pub fn keep_view(&mut self, body: Option<Arc<Surface>>) {
        (self.framed_body, self.frame) = (body, None);
    }

    /// Turns the view to `points` on `body` and frames them with some space around.
    pub fn show(&mut self, points: &[DVec3], body: &Surface) {
        if let Some((yaw, pitch)) = facing(points, body) {
            self.camera.look(View::Angles { yaw: yaw as f32, pitch: pitch as f32 });
        }
        self.come_near(points, body);
    }

    /// Frames `points` on `body` with some space around, without turning.
    pub fn come_near(&mut self, points: &[DVec3], body: &Surface) {
        let room = ROOM * body.scale();
        let around = |p: &DVec3| [-1.0, 1.0].map(|s| (*p + DVec3::splat(s * room)).as_vec3());
        let around: Vec<Vec3> = points.iter().flat_map(around).collect();
        let aspect = self.area.map_or(1.0, |pane| pane.width() / pane.height().max(1.0));
        self.camera.frame_points(&around, aspect);
    }

    pub(super) fn frame_if_asked(&mut self, seen: &Seen<'_>, pane: Rect) {
        let Some(body) = seen.body else { return };
        if !self.framed_body.as_ref().is_some_and(|b| Arc::ptr_eq(b, body)) {
            let first = self.framed_body.is_none();
            self.framed_body = Some(Arc::clone(body));
            self.frame = self.frame.or(Some(first.then_some(View::Front)));
        }
        let (lower, upper) = everything(seen, body);
        self.camera.set_bounds(lower, upper);
        if let Some(view) = self.frame.take() {
            if let Some(view) = view {
                self.camera.look(view);
            }
            let here = body.mesh.positions.iter().chain(on_body(seen)).map(|p| p.as_vec3());
            let points: Vec<Vec3> = here.chain(beside(seen)).collect();
            self.camera.frame_points(&points, pane.width() / pane.height().max(1.0));
        }
    }

    pub(super) fn move_view(&mut self, ui: &egui::Ui, seen: &Seen<'_>, pane: Rect, response: &Response) {
        let before = self.camera;
        let size = size_of(pane);
        let moved = response.drag_delta();
        match self.drag {
            _ if !response.dragged() => {}
            Some(Drag::View(PointerAction::Pan, _)) => self.camera.pan(Vec2::new(moved.x, moved.y), size),
            Some(Drag::View(PointerAction::Zoom, _)) => {
                self.camera.zoom((moved.y * ZOOM).exp(), self.camera.pivot);
            }
            Some(Drag::View(..)) => self.turn(response, pane),
            _ => {}
        }
        if let Some(at) = response.hover_pos() {
            let (wheel, pinch) = ui.input(|i| (i.smooth_scroll_delta().y, i.zoom_delta()));
            let factor = (-wheel * 0.0025).exp() / pinch;
            if (factor - 1.0).abs() > 1e-5 {
                let target = match self.pick(seen, pane, at) {
                    Some(hit) => hit.as_vec3(),
                    None => self.camera.point_on_pivot_plane(within(pane, at), size),
                };
                self.camera.zoom(factor, target);
            }
        }
        self.moving = self.camera != before;
    }

    fn turn(&mut self, response: &Response, pane: Rect) {
        let moved = response.drag_delta();
        if self.free_turning {
            if let Some(at) = response.interact_pointer_pos() {
                self.camera.trackball(within(pane, at - moved), within(pane, at), size_of(pane));
            }
        } else {
            self.camera.orbit(Vec2::new(moved.x, moved.y) * TURN);
        }
    }
}

/// Positions of the cloth's vertices that are placed on the body.
fn on_body<'a>(seen: &Seen<'a>) -> impl Iterator<Item = &'a DVec3> + use<'a> {
    let state = seen.cloth.map(|(_, state)| state);
    state.into_iter().flat_map(|s| s.positions.iter().zip(&s.mapped).filter(|(_, m)| **m).map(|(p, _)| p))
}

fn everything(seen: &Seen<'_>, body: &Surface) -> (Vec3, Vec3) {
    let bounds = body.bounds();
    let points = on_body(seen).map(|p| p.as_vec3()).chain(beside(seen));
    points.fold((bounds.0.as_vec3(), bounds.1.as_vec3()), |(lower, upper), p| (lower.min(p), upper.max(p)))
}

/// Points of the body and the garment shown beside.
fn beside<'a>(seen: &Seen<'a>) -> impl Iterator<Item = Vec3> + use<'a> {
    seen.beside.into_iter().flat_map(|meshes| meshes.iter().flat_map(|mesh| mesh.positions.iter().copied()))
}
