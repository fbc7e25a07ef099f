//! The tool that moves, scales and turns graphics.

use std::f64::consts::FRAC_PI_2;

use egui::{CursorIcon, Stroke};
use glam::DVec2;

use super::PatternTool;
use crate::geometry::ids::GraphicId;
use crate::session::{Command, Graphic};
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::tr;
use crate::ui::pattern_pane::draw::Drawing;
use crate::ui::pattern_pane::input::Input;
use crate::ui::pattern_pane::table::{REACH, Table};
use crate::ui::preferences::units::degrees;
use crate::ui::scenery::pictures::image_from_piece;

/// Distance of the knob for turning from the upper edge, points.
const STALK: f64 = 22.0;
/// Step of turning with Shift, radians.
const TURN: f64 = std::f64::consts::PI / 12.0;

/// What a drag changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Change {
    Move,
    Scale,
    Turn,
}

/// A drag in progress.
#[derive(Clone, Copy, Debug)]
struct Held {
    id: GraphicId,
    change: Change,
    /// The graphic before.
    before: Graphic,
    /// Where it was taken, in the piece's plane.
    from: DVec2,
}

/// The tool Graphics.
#[derive(Debug, Default)]
pub struct Graphics {
    chosen: Option<GraphicId>,
    held: Option<Held>,
}

/// A graphic on the table: corners from the lower left one, counter-clockwise in the image, and the knob that turns it.
struct OnTable {
    corners: [DVec2; 4],
    knob: DVec2,
}

fn on_table(table: &Table<'_>, graphic: &Graphic) -> Option<OnTable> {
    let (piece, _) = table.piece(graphic.piece).filter(|(piece, _)| !piece.hidden)?;
    let to_piece = image_from_piece(&table.laid.document.artwork, graphic).inverse();
    let at = |u: f64, v: f64| piece.pose.plane_from_piece(to_piece.transform_point2(DVec2::new(u, v)));
    let corners = [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)];
    let up = (at(0.5, 1.0) - at(0.5, 0.5)).normalize_or(DVec2::Y);
    Some(OnTable { corners, knob: at(0.5, 1.0) + up * table.reach(STALK) })
}

/// A point of the table in the plane of the graphic's piece.
fn in_piece(table: &Table<'_>, graphic: &Graphic, p: DVec2) -> Option<DVec2> {
    Some(table.pattern().pieces.get(&graphic.piece)?.pose.piece_from_plane(p))
}

/// The topmost graphic at a point of the table.
fn graphic_at(table: &Table<'_>, p: DVec2) -> Option<(GraphicId, Graphic)> {
    let artwork = &table.laid.document.artwork;
    let found = artwork.graphics.iter().rev().find(|(_, graphic)| {
        let place =
            in_piece(table, graphic, p).map(|p| image_from_piece(artwork, graphic).transform_point2(p));
        let is_in = |place: DVec2| place.cmpge(DVec2::ZERO).all() && place.cmple(DVec2::ONE).all();
        table.is_free(graphic.piece) && place.is_some_and(is_in)
    });
    found.map(|(id, graphic)| (*id, *graphic))
}

impl Graphics {
    fn chosen(&self, table: &Table<'_>) -> Option<(GraphicId, Graphic)> {
        let id = self.chosen?;
        Some((id, *table.laid.document.artwork.graphics.get(&id)?))
    }

    /// What a drag that begins at `p` would take.
    fn taken(&self, table: &Table<'_>, p: DVec2) -> Option<(GraphicId, Graphic, Change)> {
        let handle = self.chosen(table).and_then(|(id, graphic)| {
            let place = on_table(table, &graphic)?;
            let near = |q: DVec2| q.distance(p) <= table.reach(REACH);
            let change = match () {
                () if near(place.knob) => Change::Turn,
                () if place.corners.into_iter().any(near) => Change::Scale,
                () => return None,
            };
            Some((id, graphic, change))
        });
        handle.or_else(|| graphic_at(table, p).map(|(id, graphic)| (id, graphic, Change::Move)))
    }
}

impl Held {
    /// The graphic when the pointer is at `p`, in the piece's plane. `steps`: angles in whole steps.
    fn at(&self, p: DVec2, steps: bool) -> Graphic {
        let before = self.before;
        match self.change {
            Change::Move => Graphic { at: before.at + p - self.from, ..before },
            Change::Scale => {
                let factor = p.distance(before.at) / self.from.distance(before.at).max(1e-6);
                Graphic { width_m: before.width_m * factor, ..before }.clamped()
            }
            Change::Turn => {
                let angle = (p - before.at).to_angle() - FRAC_PI_2;
                let angle = if steps { (angle / TURN).round() * TURN } else { angle };
                Graphic { angle, ..before }
            }
        }
    }
}

impl PatternTool for Graphics {
    fn step(&mut self, table: &Table<'_>, input: &Input, asks: &mut Asks) {
        for &at in &input.clicks {
            self.chosen = graphic_at(table, table.at(at)).map(|(id, _)| id);
            if table.laid.document.artwork.graphics.is_empty() {
                let words =
                    tr("There is no graphic yet: take an image under Images in the side panel, and place it");
                asks.push(Ask::Say(words.to_owned()));
            }
        }
        if let Some(at) = input.pressed {
            let p = table.at(at);
            self.held = self.taken(table, p).and_then(|(id, before, change)| {
                Some(Held { id, change, before, from: in_piece(table, &before, p)? })
            });
            self.chosen = self.held.map(|held| held.id);
        }
        if let (Some(held), Some(&at)) = (self.held, input.trail.last())
            && let Some(p) = in_piece(table, &held.before, table.at(at))
        {
            let graphic = held.at(p, input.held.shift);
            asks.push(Ask::Drag(Command::SetGraphic { id: held.id, graphic }));
        }
        if input.let_go && self.held.take().is_some() {
            asks.push(Ask::EndDrag);
        }
        let Some((id, graphic)) = self.chosen(table).filter(|_| self.held.is_none()) else { return };
        if input.nudge != DVec2::ZERO {
            let from = in_piece(table, &graphic, DVec2::ZERO).unwrap_or_default();
            let step = in_piece(table, &graphic, input.nudge).unwrap_or_default() - from;
            asks.push(Ask::Do(Command::SetGraphic {
                id,
                graphic: Graphic { at: graphic.at + step, ..graphic },
            }));
        }
        if input.backspace {
            self.chosen = None;
            asks.push(Ask::Do(Command::DeleteGraphic { id }));
        }
    }

    fn draw(&self, drawing: &Drawing<'_>, table: &Table<'_>, input: &Input) {
        let artwork = &table.laid.document.artwork;
        for (id, graphic) in &artwork.graphics {
            let Some(OnTable { corners: [a, b, c, d], knob }) = on_table(table, graphic) else { continue };
            let is_chosen = self.chosen == Some(*id);
            let ink = if is_chosen { drawing.palette.accent } else { drawing.palette.weak };
            drawing.polyline(&[a, b, c, d, a], Stroke::new(if is_chosen { 1.6 } else { 1.0 }, ink));
            if !is_chosen {
                continue;
            }
            drawing.polyline(&[c.midpoint(d), knob], Stroke::new(1.2, ink));
            drawing.knob(knob, true, self.held.is_some_and(|held| held.change == Change::Turn));
            [a, b, c, d].into_iter().for_each(|corner| drawing.knob(corner, false, false));
            if let (Some(held), Some(at)) = (self.held, input.hover) {
                let words = match held.change {
                    Change::Turn => format!("{}°", degrees(graphic.angle)),
                    Change::Scale => table.laid.unit.text(graphic.width_m),
                    Change::Move => table.laid.unit.point(graphic.at),
                };
                drawing.chip(at, &words);
            }
        }
    }

    fn is_busy(&self) -> bool {
        self.held.is_some()
    }

    fn is_dragging(&self) -> bool {
        self.held.is_some()
    }

    fn takes_numbers(&self) -> bool {
        false
    }

    fn give_up(&mut self, asks: &mut Asks) {
        if self.held.take().is_some() {
            asks.push(Ask::CancelDrag);
        }
    }

    fn cursor(&self, table: &Table<'_>, at: DVec2) -> CursorIcon {
        match self.held.map(|held| held.change).or_else(|| self.taken(table, at).map(|(.., change)| change)) {
            Some(Change::Move) => CursorIcon::Move,
            Some(Change::Scale) => CursorIcon::ResizeNwSe,
            Some(Change::Turn) => CursorIcon::Alias,
            None => CursorIcon::Default,
        }
    }

    fn hint(&self, _table: &Table<'_>) -> String {
        tr(
            "Drag a graphic · Its corners: scale · Its knob: turn, Shift: in steps · Arrows: move · Backspace: delete",
        )
        .to_owned()
    }
}
