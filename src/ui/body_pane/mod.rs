//! The body pane: shows the body and the cloth on it; the pointer turns the view, paints and drags.

mod bones;
mod cloth_line;
mod cube;
mod drawing;
mod facing;
pub(in crate::ui) mod ghosts;
mod graphics;
mod hand;
mod handles;
mod hint;
mod keys;
mod outlines;
mod overlay;
pub(in crate::ui) mod pair_lines;
pub(in crate::ui) mod pick;
mod place;
pub(in crate::ui) mod placing;
mod probe;
mod sight;
pub(in crate::ui) mod standing;
mod view;

use std::collections::BTreeSet;
use std::sync::Arc;

use egui::accesskit::Role;
use egui::{CursorIcon, Event, Key as Button, PointerButton, Pos2, Rect, Response, Sense, WidgetInfo};
use glam::{DVec3, Vec2};

use crate::body::Surface;
use crate::cloth::{ClothState, Garment};
use crate::contact::Bone;
use crate::geometry::ids::{MarkId, PinId};
use crate::render::{Camera, Look, Mesh, View};
use crate::session::{Command, Document};
use crate::sim::ClothPlace;
use crate::ui::actions::Tool;
use crate::ui::actions::asks::{Ask, Asks, in_one_step};
use crate::ui::language::tr;
use crate::ui::look::theme::Palette;
use crate::ui::maps::ShownMap;
use crate::ui::pointer::clicks::clicks;
use crate::ui::pointer::mouse::{Mouse, PointerAction, held};
use crate::ui::pointer::stroke;
use crate::ui::preferences::units::LengthUnit;
use crate::ui::scenery::body_look::BodyLook;
use crate::ui::scenery::scene::Scenery;
use crate::ui::selection::Item;
use crate::wrap::Marks;
use cloth_line::ClothLine;
use cube::view_cube;
pub use graphics::{Graphics, Key};
use hand::{Reach, cloth_at};
pub use hint::hint;
use keys::ByKeys;
use outlines::edge_under;
use overlay::{publish_marks, view_buttons};
pub use place::Places;
use place::Stood;

/// The state that the pane shows.
#[derive(Clone, Copy)]
pub struct Seen<'a> {
    /// The document.
    pub document: &'a Document,
    /// Its body.
    pub body: Option<&'a Arc<Surface>>,
    /// The garment, and its positions on the body.
    pub cloth: Option<(&'a Arc<Garment>, &'a Arc<ClothState>)>,
    /// The garment including its deactivated pieces, and their positions.
    pub whole: Option<(&'a Arc<Garment>, &'a Arc<ClothState>)>,
    /// The vertex of the garment under each pin of the document.
    pub pinned: &'a Arc<Vec<Option<u32>>>,
    /// Fraction of the motion of the drag in progress that reaches each vertex.
    pub dragged: Option<&'a Arc<Vec<f32>>>,
    /// The map that the cloth is coloured by; None: its own colours.
    pub map: Option<&'a ShownMap>,
    /// Meshes of another garment on its body, beside this one.
    pub beside: Option<&'a Arc<Vec<Arc<Mesh>>>>,
    /// Whether a wrap is still growing cloth.
    pub growing: bool,
    /// Whether the cloth is moving.
    pub working: bool,
    /// The chosen tool, which the left button uses.
    pub tool: Tool,
    /// The mapping of mouse buttons.
    pub mouse: Mouse,
    /// Unit in which lengths are shown.
    pub unit: LengthUnit,
    /// Whether the pointer snaps to points and edges of pieces.
    pub snapping: bool,
    /// Laser mode: strokes go through to the far side of the body.
    pub laser: bool,
    /// The emphasised mark.
    pub selected: Option<MarkId>,
    /// Bones of the body, while they are edited.
    pub bones: &'a [Bone],
    /// Arrangement points and placed pieces, which are shown instead of the cloth while pieces are placed.
    pub places: Option<Places<'a>>,
    /// Selected pins.
    pub selected_pins: &'a BTreeSet<PinId>,
    /// Emphasised items of the pattern: selected ones, and the one under the pointer in either pane.
    pub stand_out: &'a [Item],
    /// The place marked by a ring.
    pub spot: Option<ClothPlace>,
    /// Proposed marks that are not accepted yet.
    pub ghosts: Option<&'a Arc<Marks>>,
    /// Colours, light and display options.
    pub look: Look,
    /// How the body is shown.
    pub body_look: BodyLook,
    /// Whether seams are drawn as lines alone, without stitches.
    pub plain_seams: bool,
    /// Colours of the interface.
    pub palette: &'a Palette,
}

/// State of the pane: camera, drag in progress and last picture.
#[derive(Debug, Default)]
pub struct ScenePane {
    /// The camera.
    pub camera: Camera,
    /// Frame everything in the next frame, from this view or (inner None) from the present one.
    pub frame: Option<Option<View>>,
    /// Whether the view turns by trackball instead of turntable.
    pub free_turning: bool,
    /// Whether the pointer was over the pane in the last frame.
    pub hovered: bool,
    /// Area of the pane on the screen in the last frame.
    pub area: Option<Rect>,
    /// Area of its small buttons in the last frame.
    pub buttons: Option<Rect>,
    /// Id of the pane's widget, for the keyboard focus.
    pub id: Option<egui::Id>,
    /// Item of the pattern under the pointer in the last frame.
    pub under: Option<Item>,
    /// Value of the map under the pointer in the last frame.
    pub value: Option<f64>,
    /// The renderer; None without a graphics adapter.
    pub graphics: Option<Graphics>,
    scenery: Scenery,
    drag: Option<Drag>,
    by_keys: ByKeys,
    reach: Reach,
    line: ClothLine,
    /// Position of the pointer up to which the stroke is painted.
    followed: Option<Pos2>,
    framed_body: Option<Arc<Surface>>,
    moving: bool,
}

/// Distance at which the skin is sampled between two positions of the pointer, logical pixels.
const FOLLOW_STEP: f32 = 4.0;
/// Largest number of samples between two positions of the pointer.
const MOST_FOLLOW_STEPS: f32 = 500.0;

#[derive(Debug)]
enum Drag {
    /// A stroke on the body, and with the laser the one on the far side.
    Paint([Vec<DVec3>; 2]),
    /// Moves the view, with this button.
    View(PointerAction, PointerButton),
    /// Drags cloth, with this button.
    Cloth(PointerButton),
    /// Adds a row of pins, the last of which is here.
    Row(DVec3),
    /// Moves a pin.
    Pin(PinId),
    /// Draws a bone, from end to end.
    Bone([DVec3; 2]),
    /// Moves placed pieces.
    Stand(Stood),
    /// The drag was cancelled; the button is still down.
    Over,
}

impl ScenePane {
    /// A pane that draws with egui's device; without one it stays empty.
    pub fn new(device: Option<egui_wgpu::RenderState>) -> Self {
        Self { graphics: device.map(Graphics::new), ..Self::default() }
    }

    /// This pane, with its view, drawn by another device.
    pub fn drawn_by(self, device: Option<egui_wgpu::RenderState>) -> Self {
        Self { graphics: device.map(Graphics::new), drag: None, ..self }
    }

    /// Draws the pane and handles the pointer.
    pub fn ui(&mut self, ui: &mut egui::Ui, seen: &Seen<'_>, asks: &mut Asks) {
        let pane = ui.available_rect_before_wrap();
        let response = ui.allocate_rect(pane, Sense::click_and_drag());
        response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, tr("Body pane")));
        self.hovered = response.contains_pointer();
        (self.area, self.id) = (Some(pane), Some(response.id));
        self.frame_if_asked(seen, pane);
        self.move_view(ui, seen, pane, &response);
        let near = self.mark_under(seen, pane, &response);
        self.listen(ui, seen, pane, &response, asks);
        self.listen_for_line(ui, seen, &response, asks);
        self.listen_to_keys(ui, seen, pane, &response, asks);
        self.aim_line(ui, seen, pane, &response);
        self.set_cursor(ui, seen, near, pane, &response);
        let reach = self.reach_under(seen, pane, &response);
        let hovered = response.hover_pos().filter(|_| self.drag.is_none());
        self.under = hovered.and_then(|at| edge_under(seen, self.ray(pane, at)));
        self.draw(ui, &Seen { dragged: seen.dragged.or(reach.as_ref()), ..*seen }, near, pane);
        self.probe(ui, seen, pane, hovered);
        self.places_ui(ui, seen, pane, asks);
        self.by_keys.draw(&ui.painter_at(pane), pane, response.has_focus(), seen.palette);
        publish_marks(ui, &seen.document.marks, false, pane, &self.camera);
        if let Some(ghosts) = seen.ghosts {
            publish_marks(ui, ghosts, true, pane, &self.camera);
        }
        self.publish_pins(ui, seen, pane);
        self.line_ui(ui, seen, pane);
        view_cube(ui, pane, &self.camera, seen.palette, asks);
        self.buttons = Some(view_buttons(ui, pane, seen, asks));
    }

    /// The stroke in progress on the near side.
    pub fn stroke(&self) -> &[DVec3] {
        self.strokes().map_or(&[], |[near, _]| near)
    }

    /// The strokes in progress on the near and the far side.
    fn strokes(&self) -> Option<&[Vec<DVec3>; 2]> {
        match &self.drag {
            Some(Drag::Paint(strokes)) => Some(strokes),
            _ => self.by_keys.strokes(),
        }
    }

    fn listen(&mut self, ui: &egui::Ui, seen: &Seen<'_>, pane: Rect, response: &Response, asks: &mut Asks) {
        let held = held(ui);
        let erasing = seen.tool == Tool::Erase || held.command;
        let of_tool = seen.mouse.deed(PointerButton::Primary, held) == Some(PointerAction::Tool);
        for at in clicks(ui, response, PointerButton::Primary).into_iter().filter(|_| of_tool) {
            if seen.tool == Tool::ClothLine {
                response.request_focus();
                self.click_line(seen, pane, at, (held, response.double_clicked()), asks);
            } else {
                self.click(seen, pane, at, [erasing, held.shift], asks);
            }
        }
        for button in [PointerButton::Primary, PointerButton::Secondary, PointerButton::Middle] {
            if response.drag_started_by(button) {
                self.begin(ui, seen, pane, (button, seen.mouse.deed(button, held)), erasing, asks);
            }
        }
        if matches!(self.drag, Some(Drag::Cloth(_) | Drag::Row(_) | Drag::Pin(_) | Drag::Stand(_))) {
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
                match self.drag {
                    Some(Drag::Bone(bone)) => {
                        self.drag = None;
                        self.end_bone(seen, bone, asks);
                    }
                    _ => in_one_step(self.finish(seen), asks),
                }
            }
        }
    }

    fn begin(
        &mut self,
        ui: &egui::Ui,
        seen: &Seen<'_>,
        pane: Rect,
        (button, deed): (PointerButton, Option<PointerAction>),
        erasing: bool,
        asks: &mut Asks,
    ) {
        let by_hand = match deed {
            Some(PointerAction::Tool) => return self.start_drag(ui, seen, pane, erasing, asks),
            Some(PointerAction::HandOrTurn) => true,
            Some(PointerAction::Hand) => matches!(seen.tool, Tool::Drag(_) | Tool::Pin),
            _ => false,
        };
        if by_hand && self.take_cloth(ui, seen, pane, button, asks) {
            return;
        }
        self.drag = match deed {
            Some(PointerAction::Hand) | None => None,
            Some(PointerAction::HandOrTurn) => Some(Drag::View(PointerAction::Turn, button)),
            Some(deed) => Some(Drag::View(deed, button)),
        };
    }

    fn click(&self, seen: &Seen<'_>, pane: Rect, at: Pos2, [erasing, add]: [bool; 2], asks: &mut Asks) {
        if seen.tool == Tool::Place {
            return self.click_standing(seen, pane, at, add || erasing, asks);
        }
        let near = self.mark_at(seen, pane, at);
        if let Some(pin) = self.picked_pin(seen, pane, at, add) {
            return asks.push(pin);
        }
        match (near, seen.tool) {
            (Some(mark), _) if erasing => asks.push(Ask::Do(Command::DeleteMark { mark })),
            (Some(_), Tool::Mark | Tool::Move) => asks.push(Ask::Select(near)),
            (None, Tool::Move) => asks.push(Ask::Select(None)),
            (None, Tool::Mark) if !erasing => {
                // In paper A's mapping the left button paints on the body and pins cloth.
                let pin = self.pin_or_pull(seen, pane, at).filter(|_| seen.mouse == Mouse::Paper);
                if let Some(pin) = pin {
                    return asks.push(pin);
                }
                let dots = self.hits(seen, pane, at).map(|hit| hit.into_iter().collect());
                in_one_step(painted(seen, dots), asks);
            }
            (_, Tool::Bone) if erasing => asks.extend(self.delete_bone(seen, pane, at)),
            (_, Tool::Pin) => asks.extend(self.pin_or_pull(seen, pane, at)),
            _ => {}
        }
    }

    fn start_drag(&mut self, ui: &egui::Ui, seen: &Seen<'_>, pane: Rect, erasing: bool, asks: &mut Asks) {
        if matches!(seen.tool, Tool::Drag(_) | Tool::Pin)
            && self.take_cloth(ui, seen, pane, PointerButton::Primary, asks)
        {
            return;
        }
        let origin = ui.input(|i| i.pointer.press_origin());
        if seen.tool == Tool::Place && origin.is_some_and(|at| self.take_standing(seen, pane, at, asks)) {
            return;
        }
        let bone = origin.filter(|_| seen.tool == Tool::Bone && !erasing);
        if let Some(end) = bone.and_then(|at| self.within_body(seen, pane, at)) {
            self.drag = Some(Drag::Bone([end; 2]));
            return;
        }
        let [near, far] = origin.map_or([None; 2], |at| self.hits(seen, pane, at));
        self.followed = origin;
        self.drag = Some(match near {
            Some(point) if seen.tool == Tool::Mark && !erasing => {
                Drag::Paint([vec![point], far.into_iter().collect()])
            }
            _ => Drag::View(PointerAction::Turn, PointerButton::Primary),
        });
    }

    /// Continues the drag through every position of the pointer since the last frame and, for strokes, between them: a fast
    /// motion gives few positions.
    fn go_on(&mut self, ui: &egui::Ui, seen: &Seen<'_>, pane: Rect) {
        if matches!(self.drag, Some(Drag::Bone(_))) {
            return self.draw_bone(seen, pane, ui.input(|i| i.pointer.latest_pos()));
        }
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
        // A jump from one limb to another is not part of a stroke along the body.
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
        let erasing = seen.tool == Tool::Erase || held(ui).command;
        ui.ctx().set_cursor_icon(match &self.drag {
            Some(Drag::View(..) | Drag::Cloth(_) | Drag::Pin(_) | Drag::Stand(_)) => CursorIcon::Grabbing,
            Some(Drag::Paint(_) | Drag::Bone(_)) => CursorIcon::Crosshair,
            _ if response.dragged() => CursorIcon::Grabbing,
            _ if seen.tool == Tool::ClothLine => self.line_cursor(),
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
            _ if matches!(seen.tool, Tool::Mark | Tool::Bone)
                && !erasing
                && self.pick(seen, pane, at).is_some() =>
            {
                CursorIcon::Crosshair
            }
            _ => CursorIcon::Default,
        });
    }
}

/// Whether the release of a button may be missed, since the window lost the focus or the pointer.
fn is_lost(input: &egui::InputState) -> bool {
    input.events.contains(&Event::WindowFocused(false)) || input.events.contains(&Event::PointerGone)
}

/// Commands that paint `strokes`, projected back to the skin after smoothing; empty strokes are left out.
fn painted(seen: &Seen<'_>, strokes: [Vec<DVec3>; 2]) -> Vec<Command> {
    let on_skin = |p: DVec3| seen.body.map_or(p, |b| b.nearest(p).point);
    let strokes = strokes.into_iter().filter(|points| !points.is_empty());
    strokes.map(|points| Command::AddBodyMark { points: points.into_iter().map(on_skin).collect() }).collect()
}

fn size_of(pane: Rect) -> Vec2 {
    Vec2::new(pane.width().max(1.0), pane.height().max(1.0))
}

fn within(pane: Rect, at: Pos2) -> Vec2 {
    Vec2::new(at.x - pane.left(), at.y - pane.top())
}
