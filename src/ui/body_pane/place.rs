//! The placement tool: dots at arrangement points to place pieces at, and handles to move and turn them.

use std::collections::BTreeSet;
use std::sync::Arc;

use egui::accesskit::Role;
use egui::{Color32, Pos2, Rect, Sense, Shape, Stroke, WidgetInfo};
use glam::{DVec2, DVec3};

use super::handles::{Handle, Handles, Held, done, hold};
use super::{Drag, ScenePane, Seen};
use crate::drag::Ray;
use crate::geometry::ids::PieceId;
use crate::pattern::edit::PatternEdit;
use crate::pattern::{Pattern, Piece, SpacePose};
use crate::place::{Part, Point, stood_at};
use crate::session::Command;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::body_pane::standing::Standing;
use crate::ui::language::{say, tr};
use crate::ui::selection::{Item, Selection};

/// Radius of a dot, points.
const DOT: f32 = 4.5;
/// Distance from a dot within which a click on the body means it, points.
const REACH: f32 = 48.0;
/// Smallest cosine between the skin's normal and the view direction at which a dot is shown; it includes dots on the outline of a
/// limb.
const FACES: f64 = -0.1;

/// Arrangement points and placed pieces that the pane shows.
#[derive(Clone, Copy, Debug)]
pub struct Places<'a> {
    /// Arrangement points of the body.
    pub points: &'a [Point],
    /// The placed pieces.
    pub standing: &'a Standing,
    /// The selected pieces.
    pub selected: &'a BTreeSet<PieceId>,
}

/// A drag of placed pieces.
#[derive(Clone, Debug)]
pub(super) struct Stood {
    handle: Handle,
    centre: DVec3,
    held: Held,
    /// Poses of the dragged pieces when the drag began.
    poses: Vec<(PieceId, SpacePose)>,
}

impl ScenePane {
    /// Draws dots, handles and outlines over the picture; a click on a dot places the selected pieces there.
    pub(super) fn places_ui(&mut self, ui: &mut egui::Ui, seen: &Seen<'_>, pane: Rect, asks: &mut Asks) {
        let Some(places) = seen.places else { return };
        let painter = ui.painter_at(pane);
        let pattern = &seen.document.pattern;
        for id in places.selected {
            if let Some((piece, pose)) = standing(pattern, *id) {
                let outline = piece.flattened(2e-3);
                let line: Option<Vec<Pos2>> =
                    outline.iter().map(|&p| self.place_of(pose.at(p), pane)).collect();
                let stroke = Stroke::new(2.0, seen.palette.accent);
                painter.extend(line.map(|line| Shape::closed_line(line, stroke)));
            }
        }
        let hovered = ui.input(|i| i.pointer.hover_pos());
        if let Some(handles) = self.handles(seen, pane) {
            let hot = match &self.drag {
                Some(Drag::Stand(stood)) => Some(stood.handle),
                _ => hovered.and_then(|at| handles.under(at)),
            };
            handles.draw(&painter, hot, seen.palette.halo);
        }
        if matches!(self.drag, Some(Drag::Stand(_) | Drag::View(..))) {
            return;
        }
        for (k, point) in places.points.iter().enumerate() {
            let Some(at) = self.dot(seen, pane, point) else { continue };
            let rect = Rect::from_center_size(at, egui::Vec2::splat(DOT * 3.0));
            let dot = ui.interact(rect, ui.scope_id().with(("arrangement point", k)), Sense::click());
            let name = shown_name(point);
            let words = say!("Arrangement point: {name}", name);
            dot.widget_info(|| WidgetInfo::labeled(Role::Button, true, &words));
            let hot = dot.hovered() || dot.has_focus();
            let fill = if hot { seen.palette.accent } else { Color32::from_rgb(0x3d, 0x7d, 0xd8) };
            painter.circle(at, DOT + if hot { 1.5 } else { 0.0 }, fill, Stroke::new(1.5, seen.palette.halo));
            if dot.clicked() {
                asks.push(stand_at(seen, &places, point));
            }
            dot.on_hover_text(name).on_hover_cursor(egui::CursorIcon::PointingHand);
        }
    }

    /// Where the dot of `point` is shown; None where it is out of sight.
    fn dot(&self, seen: &Seen<'_>, pane: Rect, point: &Point) -> Option<Pos2> {
        let eye = self.camera.eye().as_dvec3();
        let faces = (eye - point.at).normalize_or_zero().dot(point.out) > FACES;
        let at = self.place_of(point.at, pane).filter(|at| faces && pane.contains(*at))?;
        self.is_in_sight(seen, point.at + point.out * (0.02 * seen.body?.scale())).then_some(at)
    }

    /// What a click on the body beside all dots asks for while pieces are selected: the nearest dot within reach, or words.
    fn click_beside(&self, seen: &Seen<'_>, places: &Places<'_>, pane: Rect, click: Pos2) -> Ask {
        let all = places.points.iter();
        let dots = all.filter_map(|point| Some((self.dot(seen, pane, point)?.distance(click), point)));
        let nearest = dots.filter(|dot| dot.0 <= REACH).min_by(|a, b| a.0.total_cmp(&b.0));
        match nearest {
            Some((_, point)) => stand_at(seen, places, point),
            None => Ask::Say(tr("Click a dot on the body to place what is selected there").to_owned()),
        }
    }

    /// The handles around the selected pieces that are placed.
    fn handles(&self, seen: &Seen<'_>, pane: Rect) -> Option<Handles> {
        let centre = centre(&seen.document.pattern, seen.places?.selected)?;
        let metres = self.metres_per_point(centre, pane)?;
        Some(Handles::new(centre, metres, |p| self.place_of(p, pane)))
    }

    /// A click that hit no dot: selects the piece there, with `add` in addition to the selection. On the body it means the nearest
    /// dot while pieces are selected.
    pub(super) fn click_standing(&self, seen: &Seen<'_>, pane: Rect, at: Pos2, add: bool, asks: &mut Asks) {
        let Some(places) = seen.places else { return };
        if self.handles(seen, pane).is_some_and(|handles| handles.under(at).is_some()) {
            return;
        }
        let ray = self.ray(pane, at);
        let under = standing_under(seen, &places, ray).map(|hit| hit.0);
        let is_on_body = || seen.body.and_then(|body| body.ray(ray.origin, ray.direction)).is_some();
        if under.is_none() && !add && !places.selected.is_empty() && is_on_body() {
            return asks.push(self.click_beside(seen, &places, pane, at));
        }
        asks.push(Ask::Pick(match under {
            Some(piece) if add => {
                let mut chosen = Selection::of_pieces(places.selected.iter().copied());
                chosen.toggle(Item::Piece(piece));
                chosen
            }
            Some(piece) => Selection::of(Item::Piece(piece)),
            None if add => return,
            None => Selection::default(),
        }));
    }

    /// Begins to drag a handle or a piece; false where there is none.
    pub(super) fn take_standing(&mut self, seen: &Seen<'_>, pane: Rect, at: Pos2, asks: &mut Asks) -> bool {
        let Some(places) = seen.places else { return false };
        let (pattern, ray) = (&seen.document.pattern, self.ray(pane, at));
        let eye = self.camera.towards_eye().as_dvec3();
        let handle = self.handles(seen, pane).and_then(|handles| handles.under(at));
        let (handle, centre, chosen) = match (handle, standing_under(seen, &places, ray)) {
            (Some(handle), _) => {
                (handle, centre(pattern, places.selected), places.selected.iter().copied().collect())
            }
            (None, Some((piece, point))) => {
                let chosen: BTreeSet<PieceId> = if places.selected.contains(&piece) {
                    places.selected.clone()
                } else {
                    asks.push(Ask::Pick(Selection::of(Item::Piece(piece))));
                    BTreeSet::from([piece])
                };
                (Handle::Piece, Some(point), chosen)
            }
            (None, None) => return false,
        };
        let Some(centre) = centre else { return false };
        let Some(held) = hold(handle, centre, eye, ray) else { return false };
        let poses = chosen.into_iter().filter_map(|id| Some((id, standing(pattern, id)?.1))).collect();
        self.drag = Some(Drag::Stand(Stood { handle, centre, held, poses }));
        true
    }

    /// Moves what is dragged to the pointer.
    pub(super) fn stand_on(&self, pane: Rect, at: Pos2, steps: bool) -> Option<Ask> {
        let Some(Drag::Stand(stood)) = &self.drag else { return None };
        let eye = self.camera.towards_eye().as_dvec3();
        let held = hold(stood.handle, stood.centre, eye, self.ray(pane, at))?;
        let (turn, by) = done(stood.handle, stood.held, held, steps);
        let placements = stood.poses.iter().map(|(id, pose)| (*id, Some(pose.moved(turn, stood.centre, by))));
        let edits = vec![PatternEdit::PlaceInSpace { placements: placements.collect() }];
        Some(Ask::Drag(Command::EditPattern { edits, anew: true }))
    }
}

fn standing(pattern: &Pattern, id: PieceId) -> Option<(&Arc<Piece>, SpacePose)> {
    let piece = pattern.pieces.get(&id)?;
    Some((piece, piece.placement?))
}

/// The placed piece that a ray hits before the body, and the point where.
fn standing_under(seen: &Seen<'_>, places: &Places<'_>, ray: Ray) -> Option<(PieceId, DVec3)> {
    let (piece, at, far) = places.standing.under(ray)?;
    let skin = seen.body.and_then(|body| body.ray(ray.origin, ray.direction));
    let is_hidden = skin.is_some_and(|hit| hit.point.distance(ray.origin) < far);
    (!is_hidden || seen.look.xray).then_some((piece, at))
}

/// The centre of those pieces of `selected` that are placed.
fn centre(pattern: &Pattern, selected: &BTreeSet<PieceId>) -> Option<DVec3> {
    let middle = |id: &PieceId| {
        let (piece, pose) = standing(pattern, *id)?;
        let outline = piece.flattened(2e-3);
        let (low, high) =
            outline.iter().fold((DVec2::MAX, DVec2::MIN), |(low, high), p| (low.min(*p), high.max(*p)));
        Some(pose.at((low + high) / 2.0))
    };
    let all: Vec<DVec3> = selected.iter().filter_map(middle).collect();
    (!all.is_empty()).then(|| all.iter().sum::<DVec3>() / all.len() as f64)
}

/// Places the selected pieces at a point, and unselected twins at the mirrored point on the other side of the body.
fn stand_at(seen: &Seen<'_>, places: &Places<'_>, point: &Point) -> Ask {
    let (pattern, Some(body)) = (&seen.document.pattern, seen.body) else {
        return Ask::Say(tr("There is no body to stand pieces at").to_owned());
    };
    if places.selected.is_empty() {
        return Ask::Say(
            tr("Select a piece first, on the table or where it stands; then click a dot").to_owned(),
        );
    }
    let opposite = other_side(&point.name);
    let opposite = places.points.iter().find(|other| Some(&other.name) == opposite.as_ref());
    let mut placements: Vec<(PieceId, Option<SpacePose>)> = Vec::new();
    for &id in places.selected {
        let Some(piece) = pattern.pieces.get(&id) else { continue };
        placements.push((id, Some(stood_at(piece, point, body))));
        let twin = piece.twin.filter(|twin| !places.selected.contains(twin));
        if let (Some(twin), Some(opposite)) = (twin, opposite)
            && let Some(piece) = pattern.pieces.get(&twin)
        {
            placements.push((twin, Some(stood_at(piece, opposite, body))));
        }
    }
    Ask::Do(Command::EditPattern { edits: vec![PatternEdit::PlaceInSpace { placements }], anew: false })
}

/// The name of a point as it is shown.
fn shown_name(point: &Point) -> String {
    let Some((place, side)) = point.name.rsplit_once(", ") else { return point.name.clone() };
    let place = match (point.part, place.rsplit_once(", ")) {
        (Part::Other(number), Some((_, height))) => {
            say!("bone {number}, {height}", number, height = tr(height))
        }
        _ => limb_name(place).to_owned(),
    };
    format!("{place}, {}", tr(side))
}

fn limb_name(place: &str) -> &str {
    match place {
        "left upper arm" => tr("left upper arm"),
        "right upper arm" => tr("right upper arm"),
        "left forearm" => tr("left forearm"),
        "right forearm" => tr("right forearm"),
        "left thigh" => tr("left thigh"),
        "right thigh" => tr("right thigh"),
        "left shin" => tr("left shin"),
        "right shin" => tr("right shin"),
        other => tr(other),
    }
}

/// The name of the mirrored point on the other side of the body; None for points in the middle.
fn other_side(name: &str) -> Option<String> {
    let (left, right) = (name.contains("left"), name.contains("right"));
    match (left, right) {
        (true, false) => Some(name.replace("left", "right")),
        (false, true) => Some(name.replace("right", "left")),
        _ => None,
    }
}
