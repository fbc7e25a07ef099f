//! The body pane: the body and the cloth on it, turned and painted with the pointer.

mod graphics;
mod hand;
mod outlines;

use std::sync::Arc;

use egui::accesskit::Role;
use egui::{
    Align2, Color32, CursorIcon, Event, FontId, Key as Button, PointerButton, Pos2, Rect, Response, Sense,
    WidgetInfo,
};
use glam::{DVec2, DVec3, UVec2, Vec2, Vec3};

use crate::body::Surface;
use crate::cloth::{ClothState, Garment};
use crate::drag::Ray;
use crate::geometry::ids::MarkId;
use crate::render::{Camera, Look, Projection, View};
use crate::session::{Command, Document};
use crate::ui::actions::{Action, Tool, VIEWS};
use crate::ui::asks::{Ask, Asks, in_one_step};
use crate::ui::clicks::clicks;
use crate::ui::mouse::{Deed, Mouse};
use crate::ui::scene::{Scenery, Shown};
use crate::ui::selection::Item;
use crate::ui::stroke;
use crate::ui::theme::Palette;
use crate::wrap::Marks;
pub use graphics::{Graphics, Key};
use hand::{Reach, begun, cloth_at, next_in_row, pins};
use outlines::{edge_under, outlines};

/// Radians the view turns for each point the pointer moves.
const TURN: f32 = 0.0085;
/// Logarithm of the zoom for each point the pointer moves.
const ZOOM: f32 = 0.008;
/// How near to a mark a click counts, points on the screen.
const REACH: f32 = 12.0;
/// What is shown by itself has so much room round it, metres on a body 1.5 m large.
const ROOM: f64 = 0.18;
/// Pictures drawn by a processor shrink by this much while things move.
const DRAFT: f32 = 0.7;

/// What the pane shows.
#[derive(Clone, Copy)]
pub struct Seen<'a> {
    /// The document.
    pub document: &'a Document,
    /// Its body.
    pub body: Option<&'a Arc<Surface>>,
    /// The garment on it.
    pub cloth: Option<(&'a Arc<Garment>, &'a Arc<ClothState>)>,
    /// The vertex of the garment under each pin of the document.
    pub pinned: &'a Arc<Vec<Option<u32>>>,
    /// How much of the drag under way reaches each vertex.
    pub dragged: Option<&'a Arc<Vec<f32>>>,
    /// Whether cloth is still being laid.
    pub growing: bool,
    /// Whether the cloth is moving.
    pub working: bool,
    /// What the left button does.
    pub tool: Tool,
    /// What all buttons do.
    pub mouse: Mouse,
    /// Strokes go through to the far side of the body.
    pub laser: bool,
    /// The mark that stands out.
    pub selected: Option<MarkId>,
    /// What of the pattern stands out: what is selected, and what the pointer is over in either pane.
    pub stand_out: &'a [Item],
    /// Marks proposed and not accepted yet.
    pub ghosts: Option<&'a Arc<Marks>>,
    /// Colours and light.
    pub look: Look,
    /// Colours of the interface.
    pub palette: &'a Palette,
}

/// The camera, the drag under way and the last picture.
#[derive(Debug, Default)]
pub struct ScenePane {
    /// From where the body is seen.
    pub camera: Camera,
    /// Show everything from here in the next frame.
    pub frame: Option<Option<View>>,
    /// Turn like a ball, not upright.
    pub free_turning: bool,
    /// Whether the pointer was over the pane in the last frame.
    pub hovered: bool,
    /// Where it was on the screen in the last frame.
    pub area: Option<Rect>,
    /// The widget, for the keyboard.
    pub id: Option<egui::Id>,
    /// What of the pattern was under the pointer in the last frame.
    pub under: Option<Item>,
    /// The renderer; none without a graphics adapter.
    pub graphics: Option<Graphics>,
    scenery: Scenery,
    drag: Option<Drag>,
    reach: Reach,
    /// Where the pointer of the drag was last followed to.
    followed: Option<Pos2>,
    framed_body: Option<Arc<Surface>>,
    moving: bool,
}

/// Between two places of the pointer the skin is looked for at this distance, logical pixels.
const FOLLOW_STEP: f32 = 4.0;
/// A leap of the pointer is followed in no more steps than these.
const MOST_FOLLOW_STEPS: f32 = 500.0;

#[derive(Debug)]
enum Drag {
    /// A stroke on the body, and with the laser the one on its far side.
    Paint([Vec<DVec3>; 2]),
    /// The view is moved, with this button.
    View(Deed, PointerButton),
    /// Cloth is in the hand, held with this button.
    Cloth(PointerButton),
    /// A row of pins, the last of which is here.
    Row(DVec3),
    /// Given up; the button is still down.
    Over,
}

impl ScenePane {
    /// A pane that draws with egui's device; without one it stays empty.
    pub fn new(device: Option<egui_wgpu::RenderState>) -> Self {
        Self { graphics: device.map(Graphics::new), ..Self::default() }
    }

    /// Draws the pane and listens to the pointer.
    pub fn ui(&mut self, ui: &mut egui::Ui, seen: &Seen<'_>, asks: &mut Asks) {
        let pane = ui.available_rect_before_wrap();
        let response = ui.allocate_rect(pane, Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, "Body pane"));
        self.hovered = response.contains_pointer();
        (self.area, self.id) = (Some(pane), Some(response.id));
        self.frame_if_asked(seen, pane);
        self.move_view(ui, seen, pane, &response);
        let near = self.mark_under(seen, pane, &response);
        self.listen(ui, seen, pane, &response, asks);
        self.set_cursor(ui, seen, near, pane, &response);
        let reach = self.reach_under(seen, pane, &response);
        let hovered = response.hover_pos().filter(|_| self.drag.is_none());
        self.under = hovered.and_then(|at| edge_under(seen, self.ray(pane, at)));
        self.draw(ui, &Seen { dragged: seen.dragged.or(reach.as_ref()), ..*seen }, near, pane);
        publish_marks(ui, &seen.document.marks, "Mark", pane, &self.camera);
        if let Some(ghosts) = seen.ghosts {
            publish_marks(ui, ghosts, "Proposed mark", pane, &self.camera);
        }
        view_buttons(ui, pane, seen.palette, asks);
    }

    /// What is shown changes to `body`, and is to be seen as the camera stands.
    pub fn keep_view(&mut self, body: Option<Arc<Surface>>) {
        (self.framed_body, self.frame) = (body, None);
    }

    /// Turns to `points` on `body` and comes near enough to see them well.
    pub fn show(&mut self, points: &[DVec3], body: &Surface) {
        let out: DVec3 = points.iter().map(|&p| body.nearest(p).normal).sum();
        if DVec2::new(out.x, out.z).length() > 0.2 * points.len() as f64 {
            self.camera.look(View::Angles { yaw: out.x.atan2(out.z).to_degrees() as f32, pitch: 10.0 });
        }
        let room = ROOM * body.scale();
        let around = |p: &DVec3| [-1.0, 1.0].map(|s| (*p + DVec3::splat(s * room)).as_vec3());
        let around: Vec<Vec3> = points.iter().flat_map(around).collect();
        let aspect = self.area.map_or(1.0, |pane| pane.width() / pane.height().max(1.0));
        self.camera.frame_points(&around, aspect);
    }

    /// The stroke under way on the near side.
    pub fn stroke(&self) -> &[DVec3] {
        self.strokes().map_or(&[], |[near, _]| near)
    }

    /// The strokes under way on the near and the far side.
    fn strokes(&self) -> Option<&[Vec<DVec3>; 2]> {
        match &self.drag {
            Some(Drag::Paint(strokes)) => Some(strokes),
            _ => None,
        }
    }

    fn frame_if_asked(&mut self, seen: &Seen<'_>, pane: Rect) {
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
            let points: Vec<Vec3> =
                body.mesh.positions.iter().chain(on_body(seen)).map(|p| p.as_vec3()).collect();
            self.camera.frame_points(&points, pane.width() / pane.height().max(1.0));
        }
    }

    fn move_view(&mut self, ui: &egui::Ui, seen: &Seen<'_>, pane: Rect, response: &Response) {
        let before = self.camera;
        let size = size_of(pane);
        let moved = response.drag_delta();
        match self.drag {
            _ if !response.dragged() => {}
            Some(Drag::View(Deed::Pan, _)) => self.camera.pan(Vec2::new(moved.x, moved.y), size),
            Some(Drag::View(Deed::Zoom, _)) => {
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

    /// The point of the body under a point of the screen.
    fn pick(&self, seen: &Seen<'_>, pane: Rect, at: Pos2) -> Option<DVec3> {
        let ray = self.camera.ray(within(pane, at), size_of(pane));
        let hit = seen.body?.ray(ray.origin.as_dvec3(), ray.direction.as_dvec3())?;
        Some(hit.point)
    }

    /// The point of the body furthest behind a point of the screen, where the skin looks away.
    fn pick_far(&self, seen: &Seen<'_>, pane: Rect, at: Pos2) -> Option<DVec3> {
        let ray = self.camera.ray(within(pane, at), size_of(pane));
        let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3().normalize_or_zero());
        let body = seen.body?;
        let (lower, upper) = body.bounds();
        let beyond = ((lower + upper) / 2.0).distance(origin) + (upper - lower).length();
        Some(body.ray(origin + direction * beyond, -direction)?.point)
    }

    /// Where a stroke at a point of the screen lies: on the near side, with the laser on the far side, too.
    fn hits(&self, seen: &Seen<'_>, pane: Rect, at: Pos2) -> [Option<DVec3>; 2] {
        let near = self.pick(seen, pane, at);
        [near, near.filter(|_| seen.laser).and_then(|_| self.pick_far(seen, pane, at))]
    }

    fn mark_under(&self, seen: &Seen<'_>, pane: Rect, response: &Response) -> Option<MarkId> {
        self.mark_at(seen, pane, response.hover_pos().filter(|_| self.drag.is_none())?)
    }

    /// The mark on the body within reach of a point of the screen that is not behind the body.
    fn mark_at(&self, seen: &Seen<'_>, pane: Rect, at: Pos2) -> Option<MarkId> {
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

    fn is_in_sight(&self, seen: &Seen<'_>, point: DVec3) -> bool {
        let eye = match self.camera.projection {
            Projection::Perspective => self.camera.eye(),
            Projection::Orthographic => {
                point.as_vec3() + self.camera.towards_eye() * self.camera.bounds.1 * 4.0
            }
        };
        let (eye, away) = (eye.as_dvec3(), (point - eye.as_dvec3()).length());
        seen.body
            .and_then(|b| b.ray(eye, point - eye))
            .is_none_or(|hit| hit.distance > away - 0.01 * seen.body.map_or(1.0, |b| b.scale()))
    }

    fn listen(&mut self, ui: &egui::Ui, seen: &Seen<'_>, pane: Rect, response: &Response, asks: &mut Asks) {
        let erasing = seen.tool == Tool::Erase || ui.input(|i| i.modifiers.command);
        let held = ui.input(|i| i.modifiers);
        let of_tool = seen.mouse.deed(PointerButton::Primary, held) == Some(Deed::Tool);
        for at in clicks(ui, response, PointerButton::Primary).into_iter().filter(|_| of_tool) {
            self.click(seen, pane, at, erasing, asks);
        }
        for button in [PointerButton::Primary, PointerButton::Secondary, PointerButton::Middle] {
            if response.drag_started_by(button) {
                self.begin(ui, seen, pane, (button, seen.mouse.deed(button, held)), erasing, asks);
            }
        }
        if matches!(self.drag, Some(Drag::Cloth(_) | Drag::Row(_))) {
            self.go_on_by_hand(ui, seen, pane, asks);
        } else if let Some(Drag::View(_, button)) = self.drag {
            if ui.input(|i| !i.pointer.button_down(button) || is_lost(i)) {
                self.drag = None;
            }
        } else if self.drag.is_some() {
            self.go_on(ui, seen, pane);
            let lost = ui.input(is_lost);
            if ui.input(|i| i.key_pressed(Button::Escape)) {
                self.drag = Some(Drag::Over);
            } else if !ui.input(|i| i.pointer.primary_down()) || lost {
                in_one_step(self.finish(seen), asks);
            }
        }
    }

    fn begin(
        &mut self,
        ui: &egui::Ui,
        seen: &Seen<'_>,
        pane: Rect,
        (button, deed): (PointerButton, Option<Deed>),
        erasing: bool,
        asks: &mut Asks,
    ) {
        let by_hand = match deed {
            Some(Deed::Tool) => return self.start_drag(ui, seen, pane, erasing, asks),
            Some(Deed::HandOrTurn) => true,
            Some(Deed::Hand) => matches!(seen.tool, Tool::Drag(_) | Tool::Pin),
            _ => false,
        };
        if by_hand && self.take_cloth(ui, seen, pane, button, asks) {
            return;
        }
        self.drag = match deed {
            Some(Deed::Hand) | None => None,
            Some(Deed::HandOrTurn) => Some(Drag::View(Deed::Turn, button)),
            Some(deed) => Some(Drag::View(deed, button)),
        };
    }

    fn click(&self, seen: &Seen<'_>, pane: Rect, at: Pos2, erasing: bool, asks: &mut Asks) {
        let near = self.mark_at(seen, pane, at);
        match (near, seen.tool) {
            (Some(mark), _) if erasing => asks.push(Ask::Do(Command::DeleteMark { mark })),
            (Some(_), Tool::Mark | Tool::Move) => asks.push(Ask::Select(near)),
            (None, Tool::Move) => asks.push(Ask::Select(None)),
            (None, Tool::Mark) if !erasing => {
                // Paper A: the left button paints on the body and pins cloth.
                let pin = self.pin_or_pull(seen, pane, at).filter(|_| seen.mouse == Mouse::Paper);
                if let Some(pin) = pin {
                    return asks.push(pin);
                }
                let dots = self.hits(seen, pane, at).map(|hit| hit.into_iter().collect());
                in_one_step(painted(seen, dots), asks);
            }
            (_, Tool::Pin) => asks.extend(self.pin_or_pull(seen, pane, at)),
            _ => {}
        }
    }

    fn ray(&self, pane: Rect, at: Pos2) -> Ray {
        let ray = self.camera.ray(within(pane, at), size_of(pane));
        Ray { origin: ray.origin.as_dvec3(), direction: ray.direction.as_dvec3() }
    }

    /// A click with the pin tool: pulls the pin out that is there, or sticks one in.
    fn pin_or_pull(&self, seen: &Seen<'_>, pane: Rect, at: Pos2) -> Option<Ask> {
        let hit = cloth_at(seen, self.ray(pane, at))?;
        let away = |p: DVec3| {
            self.camera.project(p.as_vec3(), size_of(pane)).map(|q| q.pixel.distance(within(pane, at)))
        };
        let near = pins(seen)
            .into_iter()
            .filter_map(|(id, place)| Some((id, away(place)?)))
            .filter(|&(_, away)| away <= REACH)
            .min_by(|a, b| a.1.total_cmp(&b.1));
        Some(Ask::Do(match near {
            Some((pin, _)) => Command::DeletePin { pin },
            None => Command::AddPin { piece: hit.place.piece, at: hit.place.at },
        }))
    }

    /// Takes cloth in the hand or begins a row of pins; false when there is no cloth under the pointer.
    fn take_cloth(
        &mut self,
        ui: &egui::Ui,
        seen: &Seen<'_>,
        pane: Rect,
        button: PointerButton,
        asks: &mut Asks,
    ) -> bool {
        let origin = ui.input(|i| i.pointer.press_origin());
        let hit = origin.filter(|_| !seen.growing).and_then(|at| cloth_at(seen, self.ray(pane, at)));
        let Some(hit) = hit else { return false };
        let row = seen.tool == Tool::Pin && button == PointerButton::Primary;
        let tool = if row || matches!(seen.tool, Tool::Drag(_)) { seen.tool } else { Tool::default() };
        asks.push(begun(&Seen { tool, ..*seen }, &hit));
        self.drag = Some(if row { Drag::Row(hit.point) } else { Drag::Cloth(button) });
        true
    }

    fn go_on_by_hand(&mut self, ui: &egui::Ui, seen: &Seen<'_>, pane: Rect, asks: &mut Asks) {
        let at = ui.input(|i| i.pointer.latest_pos());
        let moved = ui.input(|i| i.pointer.delta() != egui::Vec2::ZERO);
        match (&mut self.drag, at) {
            (Some(Drag::Cloth(_)), Some(at)) if moved => {
                asks.push(Ask::Drag(Command::DragTo { ray: self.ray(pane, at) }));
            }
            (Some(Drag::Row(last)), Some(at)) => {
                let last = *last;
                if let Some(hit) = cloth_at(seen, self.ray(pane, at))
                    && let Some(ask) = next_in_row(seen, last, &hit)
                {
                    asks.push(ask);
                    self.drag = Some(Drag::Row(hit.point));
                }
            }
            _ => {}
        }
        let button = match self.drag {
            Some(Drag::Cloth(button)) => button,
            _ => PointerButton::Primary,
        };
        if ui.input(|i| i.key_pressed(Button::Escape)) {
            asks.push(Ask::CancelDrag);
            self.drag = Some(Drag::Over);
        } else if ui.input(|i| !i.pointer.button_down(button) || is_lost(i)) {
            if matches!(self.drag, Some(Drag::Cloth(_))) {
                asks.push(Ask::Drag(Command::Release));
            }
            asks.push(Ask::EndDrag);
            self.drag = None;
        }
    }

    fn start_drag(&mut self, ui: &egui::Ui, seen: &Seen<'_>, pane: Rect, erasing: bool, asks: &mut Asks) {
        if matches!(seen.tool, Tool::Drag(_) | Tool::Pin)
            && self.take_cloth(ui, seen, pane, PointerButton::Primary, asks)
        {
            return;
        }
        let origin = ui.input(|i| i.pointer.press_origin());
        let [near, far] = origin.map_or([None; 2], |at| self.hits(seen, pane, at));
        self.followed = origin;
        self.drag = Some(match near {
            Some(point) if seen.tool == Tool::Mark && !erasing => {
                Drag::Paint([vec![point], far.into_iter().collect()])
            }
            _ => Drag::View(Deed::Turn, PointerButton::Primary),
        });
    }

    /// Follows the pointer through every place it was in since the last frame, and between them: a fast hand leaves few.
    fn go_on(&mut self, ui: &egui::Ui, seen: &Seen<'_>, pane: Rect) {
        if !matches!(self.drag, Some(Drag::Paint(_))) {
            return;
        }
        let trail: Vec<Pos2> = ui.input(|i| {
            let moved = i.events.iter().filter_map(|e| match e {
                Event::PointerMoved(p) => Some(*p),
                _ => None,
            });
            moved.collect()
        });
        // A jump from one limb to another is no stroke along the body.
        let leap = 0.12 * seen.body.map_or(1.0, |b| b.scale());
        let mut hits: Vec<[Option<DVec3>; 2]> = Vec::new();
        for at in trail {
            let from = self.followed.replace(at).unwrap_or(at);
            let steps = (from.distance(at) / FOLLOW_STEP).ceil().clamp(1.0, MOST_FOLLOW_STEPS);
            let places = (1..=steps as u32).map(|i| from.lerp(at, i as f32 / steps));
            hits.extend(places.map(|place| self.hits(seen, pane, place)));
        }
        if let Some(Drag::Paint(strokes)) = &mut self.drag {
            for hit in hits {
                for (points, hit) in strokes.iter_mut().zip(hit) {
                    let step = |hit: &DVec3| points.last().map_or(0.0, |l| l.distance(*hit));
                    points.extend(hit.filter(|hit| step(hit) > 5e-4 && step(hit) < leap));
                }
            }
        }
    }

    fn finish(&mut self, seen: &Seen<'_>) -> Vec<Command> {
        match self.drag.take() {
            Some(Drag::Paint(strokes)) => painted(seen, strokes.map(|points| stroke::finished(&points))),
            _ => Vec::new(),
        }
    }

    fn set_cursor(
        &self,
        ui: &egui::Ui,
        seen: &Seen<'_>,
        near: Option<MarkId>,
        pane: Rect,
        response: &Response,
    ) {
        let Some(at) = response.hover_pos() else { return };
        let erasing = seen.tool == Tool::Erase || ui.input(|i| i.modifiers.command);
        ui.ctx().set_cursor_icon(match &self.drag {
            Some(Drag::View(..) | Drag::Cloth(_)) => CursorIcon::Grabbing,
            Some(Drag::Paint(_)) => CursorIcon::Crosshair,
            _ if response.dragged() => CursorIcon::Grabbing,
            _ if erasing && near.is_some() => CursorIcon::PointingHand,
            _ if matches!(seen.tool, Tool::Drag(_) | Tool::Pin)
                && cloth_at(seen, self.ray(pane, at)).is_some() =>
            {
                if seen.tool == Tool::Pin {
                    CursorIcon::PointingHand
                } else {
                    CursorIcon::Grab
                }
            }
            _ if seen.tool == Tool::Mark && !erasing && self.pick(seen, pane, at).is_some() => {
                CursorIcon::Crosshair
            }
            _ => CursorIcon::Default,
        });
    }

    fn draw(&mut self, ui: &egui::Ui, seen: &Seen<'_>, near: Option<MarkId>, pane: Rect) {
        let painter = ui.painter_at(pane);
        let [stroke, far_stroke] = self.strokes().cloned().unwrap_or_default();
        let Some(graphics) = &mut self.graphics else {
            let words = "No graphics adapter: the body cannot be shown.";
            painter.text(
                pane.center(),
                Align2::CENTER_CENTER,
                words,
                FontId::proportional(14.0),
                seen.palette.weak,
            );
            return;
        };
        let draft = graphics.is_slow() && (self.moving || seen.working || !stroke.is_empty());
        let scale = ui.ctx().pixels_per_point() * if draft { DRAFT } else { 1.0 };
        let pixels = (pane.size() * scale).round();
        let key = Key {
            camera: self.camera,
            look: Look {
                pixels_per_point: scale,
                occlusion: if draft { 0.0 } else { seen.look.occlusion },
                ..seen.look
            },
            size: UVec2::new(pixels.x.max(1.0) as u32, pixels.y.max(1.0) as u32),
            body: seen.body.cloned(),
            cloth: seen.cloth.map(|(_, state)| Arc::clone(state)),
            marks: Some(Arc::clone(&seen.document.marks)),
            stroke: stroke.len() + far_stroke.len(),
            near,
            pinned: Some(Arc::clone(seen.pinned)),
            dragged: seen.dragged.cloned(),
            selected: seen.selected,
            ghosts: seen.ghosts.cloned(),
            stand_out: if seen.cloth.is_some() { seen.stand_out.to_vec() } else { Vec::new() },
        };
        let outlines = outlines(&seen.document.pattern, &key.stand_out);
        let shown = Shown {
            body: seen.body,
            cloth: seen.cloth,
            marks: Some(&seen.document.marks),
            stroke: &stroke,
            far_stroke: &far_stroke,
            near,
            pinned: seen.pinned,
            dragged: seen.dragged,
            selected: seen.selected,
            ghosts: seen.ghosts.map(|g| &**g),
            outlines: &outlines,
        };
        match graphics.picture(key, || self.scenery.scene(&shown)) {
            Ok(texture) => {
                let whole = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
                painter.image(texture, pane, whole, Color32::WHITE);
            }
            Err(error) => {
                let font = FontId::proportional(14.0);
                painter.text(
                    pane.center(),
                    Align2::CENTER_CENTER,
                    error.to_string(),
                    font,
                    seen.palette.error,
                );
            }
        }
        if draft {
            // The finished picture follows as soon as nothing moves.
            ui.ctx().request_repaint_after(std::time::Duration::from_millis(120));
        }
    }
}

/// Whether the release of a button would not be seen.
fn is_lost(input: &egui::InputState) -> bool {
    input.events.contains(&Event::WindowFocused(false)) || input.events.contains(&Event::PointerGone)
}

/// What the pointer does here, for the status bar.
pub fn hint(tool: Tool, mouse: Mouse, laser: bool, dressed: bool, next: usize) -> String {
    let view = mouse.view_hint();
    match tool {
        Tool::Mark if laser => {
            let far = next + 1;
            format!(
                "Drag: paint mark {next} on the near side and {far} on the far side · L: only the near · {view}"
            )
        }
        Tool::Mark => {
            let click =
                if dressed && mouse == Mouse::Paper { "pin the cloth" } else { "a dot, or select a mark" };
            format!("Drag on the body: paint mark {next} · Click: {click} · Ctrl+click: erase · {view}")
        }
        Tool::Erase => format!("Click a mark: take it away · {view}"),
        Tool::Pin => format!("Click: pin the cloth, or pull the pin out · Drag: a row of pins · {view}"),
        Tool::Drag(_) => format!("Drag the cloth · Esc: put it back · {view}"),
        _ => format!("Drag: turn · {view}"),
    }
}

/// The commands that paint `strokes`, laid back on the skin after smoothing. Empty ones are left out.
fn painted(seen: &Seen<'_>, strokes: [Vec<DVec3>; 2]) -> Vec<Command> {
    let on_skin = |p: DVec3| seen.body.map_or(p, |b| b.nearest(p).point);
    let strokes = strokes.into_iter().filter(|points| !points.is_empty());
    strokes.map(|points| Command::AddBodyMark { points: points.into_iter().map(on_skin).collect() }).collect()
}

/// Points of the cloth that lie on the body.
fn on_body<'a>(seen: &Seen<'a>) -> impl Iterator<Item = &'a DVec3> + use<'a> {
    let state = seen.cloth.map(|(_, state)| state);
    state.into_iter().flat_map(|s| s.positions.iter().zip(&s.mapped).filter(|(_, m)| **m).map(|(p, _)| p))
}

fn everything(seen: &Seen<'_>, body: &Surface) -> (Vec3, Vec3) {
    let (lower, upper) =
        on_body(seen).fold(body.bounds(), |(lower, upper), p| (lower.min(*p), upper.max(*p)));
    (lower.as_vec3(), upper.as_vec3())
}

fn size_of(pane: Rect) -> Vec2 {
    Vec2::new(pane.width().max(1.0), pane.height().max(1.0))
}

fn within(pane: Rect, at: Pos2) -> Vec2 {
    Vec2::new(at.x - pane.left(), at.y - pane.top())
}

/// Small buttons over the lower right corner, where they hide only floor.
fn view_buttons(ui: &mut egui::Ui, pane: Rect, palette: &Palette, asks: &mut Asks) {
    let area = Rect::from_min_max(
        Pos2::new(pane.left() + 8.0, pane.bottom() - 34.0),
        Pos2::new(pane.right() - 8.0, pane.bottom() - 8.0),
    );
    let layout = egui::Layout::right_to_left(egui::Align::Center);
    ui.scope_builder(egui::UiBuilder::new().max_rect(area).layout(layout), |ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let all = std::iter::once(Action::FrameAll).chain(VIEWS[..5].iter().rev().map(|&v| Action::Look(v)));
        for action in all {
            let entry = action.entry();
            let button =
                egui::Button::new(egui::RichText::new(entry.text).size(12.5)).fill(palette.overlay).small();
            if ui.add(button).on_hover_text(entry.tip).clicked() {
                asks.push(Ask::Act(action));
            }
        }
    });
}

/// Tells screen readers and tests where each mark is.
fn publish_marks(ui: &egui::Ui, marks: &Marks, what: &str, pane: Rect, camera: &Camera) {
    for (i, mark) in marks.body.iter().enumerate() {
        let place = mark.points.first().and_then(|p| camera.project(p.as_vec3(), size_of(pane)));
        if let Some(place) = place {
            let at = pane.min + egui::vec2(place.pixel.x, place.pixel.y);
            let rect = Rect::from_center_size(at, egui::vec2(12.0, 12.0));
            let node = ui.interact(rect, ui.scope_id().with((what, "on the body", i)), Sense::hover());
            node.widget_info(|| {
                WidgetInfo::labeled(Role::Label, true, format!("{what} {} on the body", i + 1))
            });
        }
    }
}
