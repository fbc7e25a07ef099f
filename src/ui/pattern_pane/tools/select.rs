//! The tool Move: selects pieces and seams, and moves, scales and rotates pieces by handles.

use std::collections::BTreeSet;

use egui::{CursorIcon, Pos2, Rect, Stroke, Vec2};
use glam::DVec2;

use super::{PatternTool, done, dragged};
use crate::geometry::ids::PieceId;
use crate::pattern::PlanePose;
use crate::pattern::edit::{PatternEdit, PointRef};
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::tr;
use crate::ui::pattern_pane::draw::Drawing;
use crate::ui::pattern_pane::input::Input;
use crate::ui::pattern_pane::snap::{Snap, Snapped, on_eighth};
use crate::ui::pattern_pane::table::Table;
use crate::ui::preferences::units::{Typed, degrees};
use crate::ui::selection::{Item, Selection};

/// Distance from the selection's box to the handle that rotates it, points.
const STALK: f32 = 24.0;
/// Largest distance of a press from a handle, points.
const GRIP: f32 = 8.0;
/// Positions of the box's handles relative to its centre, in halves of its size.
const HANDLES: [[f64; 2]; 8] =
    [[-1.0, -1.0], [0.0, -1.0], [1.0, -1.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [-1.0, 1.0], [-1.0, 0.0]];

/// The tool Move. While cloth is dragged or pinned in the body pane it only selects.
#[derive(Debug, Default)]
pub struct Select {
    drag: Option<Drag>,
    only_selects: bool,
}

#[derive(Debug)]
enum Drag {
    /// Selects the pieces that a box touches.
    Box { from: DVec2, to: DVec2, add: bool },
    /// Moves pieces: their old poses, and the point where they are held.
    Move { held: DVec2, poses: Vec<(PieceId, PlanePose)>, by: DVec2, snapped: Option<Snapped> },
    /// Scales pieces: the handle, and their old bounding box.
    Scale { handle: DVec2, frame: [DVec2; 2], pieces: Vec<PieceId>, factor: DVec2 },
    /// Rotates pieces: the centre, the starting angle, and their old poses.
    Turn { about: DVec2, from: f64, poses: Vec<(PieceId, PlanePose)>, by: f64 },
}

/// A handle of the box around the selection.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Handle {
    Scale(DVec2),
    Turn,
}

impl Select {
    /// A tool that only selects.
    pub fn idle() -> Self {
        Self { drag: None, only_selects: true }
    }

    fn click(&self, table: &Table<'_>, input: &Input, at: Pos2, asks: &mut Asks) {
        let p = table.at(at);
        if let Some(mark) = table.mark_at(p).filter(|_| !self.only_selects) {
            return asks.push(Ask::Select(Some(mark)));
        }
        let item = self.under(table, p);
        if item.is_none() && !self.only_selects {
            asks.push(Ask::Select(None));
        }
        asks.push(Ask::Pick(table.laid.selection.clicked(item, input.held.shift)));
    }

    fn press(&mut self, table: &Table<'_>, input: &Input, at: Pos2, asks: &mut Asks) {
        let p = table.at(at);
        if let Some(handle) = handle_at(table, at) {
            return self.take_handle(table, handle, p);
        }
        let Some((piece, _)) = table.piece_at(p) else {
            self.drag = Some(Drag::Box { from: p, to: p, add: input.held.shift });
            return;
        };
        let mut selection = table.laid.selection.clone();
        if !selection.pieces.contains(&piece) {
            selection = selection.clicked(Some(Item::Piece(piece)), input.held.shift);
            asks.push(Ask::Pick(selection.clone()));
        }
        let poses = poses(table, &selection.pieces);
        if poses.is_empty() {
            asks.push(Ask::Say(tr("This piece is locked.").to_owned()));
        } else {
            self.drag = Some(Drag::Move { held: p, poses, by: DVec2::ZERO, snapped: None });
        }
    }

    fn take_handle(&mut self, table: &Table<'_>, handle: Handle, p: DVec2) {
        let Some(frame) = frame(table) else { return };
        let pieces = &table.laid.selection.pieces;
        self.drag = Some(match handle {
            Handle::Scale(handle) => {
                let pieces = pieces.iter().copied().filter(|&id| table.is_free(id)).collect();
                Drag::Scale { handle, frame, pieces, factor: DVec2::ONE }
            }
            Handle::Turn => {
                let about = (frame[0] + frame[1]) / 2.0;
                Drag::Turn { about, from: (p - about).to_angle(), poses: poses(table, pieces), by: 0.0 }
            }
        });
    }

    fn follow(&mut self, table: &Table<'_>, input: &Input, at: Pos2, asks: &mut Asks) {
        let p = table.at(at);
        match &mut self.drag {
            Some(Drag::Box { to, .. }) => *to = p,
            Some(Drag::Move { held, poses, by, snapped }) => {
                let moving: BTreeSet<PieceId> = poses.iter().map(|(id, _)| *id).collect();
                (*by, *snapped) = snapped_move(table, input, &moving, p - *held, *by);
                asks.push(dragged(vec![moved(poses, *by)]));
            }
            Some(Drag::Scale { handle, frame, pieces, factor }) => {
                let p = table.snapped(p, None, egui::Modifiers { shift: false, ..input.held }, |point| {
                    pieces.contains(&point.piece)
                });
                *factor = factor_of(*frame, *handle, p.place, input.held.shift);
                asks.push(dragged(vec![scaled(*frame, *handle, pieces, *factor)]));
            }
            Some(Drag::Turn { about, from, poses, by }) => {
                let mut turn = (p - *about).to_angle() - *from;
                if input.held.shift {
                    let step = 15_f64.to_radians();
                    turn = (turn / step).round() * step;
                }
                *by = turn;
                asks.push(dragged(vec![turned(poses, *about, turn)]));
            }
            None => {}
        }
    }

    fn finish(&mut self, table: &Table<'_>, asks: &mut Asks) {
        match self.drag.take() {
            Some(Drag::Box { from, to, add }) => asks.push(Ask::Pick(boxed(table, from, to, add))),
            Some(_) => asks.push(Ask::EndDrag),
            None => {}
        }
    }
}

impl PatternTool for Select {
    fn step(&mut self, table: &Table<'_>, input: &Input, asks: &mut Asks) {
        for &at in &input.clicks {
            self.click(table, input, at, asks);
        }
        if self.only_selects {
            return;
        }
        if input.double
            && let Some(at) = input.hover
            && let Some((piece, _)) = table.piece_at(table.at(at)).filter(|(piece, _)| table.is_free(*piece))
        {
            asks.push(done(vec![turned_over(table, piece)]));
        }
        if let Some(at) = input.pressed {
            self.press(table, input, at, asks);
        }
        if let Some(&at) = input.trail.last() {
            self.follow(table, input, at, asks);
        }
        if input.let_go {
            self.finish(table, asks);
        }
        if input.nudge != DVec2::ZERO && self.drag.is_none() {
            let poses = poses(table, &table.laid.selection.pieces);
            if !poses.is_empty() {
                asks.push(done(vec![moved(&poses, input.nudge)]));
            }
        }
        if input.next != 0 {
            let all: Vec<Item> = table.seen().map(|(id, ..)| Item::Piece(id)).collect();
            let chosen = table.laid.selection.pieces.last().map(|&id| Item::Piece(id));
            asks.extend(next(&all, chosen, input.next).map(|item| Ask::Pick(Selection::of(item))));
        }
    }

    fn draw(&self, drawing: &Drawing<'_>, table: &Table<'_>, input: &Input) {
        if !self.only_selects && !matches!(self.drag, Some(Drag::Box { .. })) {
            draw_frame(drawing, table);
        }
        let at = input.hover.unwrap_or(drawing.pane.center());
        let unit = table.laid.unit;
        match &self.drag {
            Some(Drag::Box { from, to, .. }) => {
                let area = Rect::from_two_pos(drawing.place(*from), drawing.place(*to));
                let ink = drawing.palette.accent;
                drawing.painter.rect(
                    area,
                    0.0,
                    ink.gamma_multiply(0.12),
                    Stroke::new(1.0, ink),
                    egui::StrokeKind::Inside,
                );
            }
            Some(Drag::Move { by, snapped, .. }) => {
                if let Some(snapped) = snapped {
                    drawing.snapped(snapped);
                }
                drawing.chip(at, &unit.point(*by));
            }
            Some(Drag::Scale { factor, frame, .. }) => {
                let size = (frame[1] - frame[0]) * *factor;
                drawing.chip(at, &format!("{} × {}", unit.number(size.x), unit.text(size.y)));
            }
            Some(Drag::Turn { by, .. }) => drawing.chip(at, &format!("{}°", degrees(*by))),
            None => {}
        }
    }

    fn is_busy(&self) -> bool {
        self.drag.is_some()
    }

    fn is_dragging(&self) -> bool {
        self.drag.is_some()
    }

    fn takes_numbers(&self) -> bool {
        matches!(self.drag, Some(Drag::Move { .. } | Drag::Scale { .. } | Drag::Turn { .. }))
    }

    fn typed(&mut self, table: &Table<'_>, typed: Typed, asks: &mut Asks) -> Result<(), String> {
        let edit = match (&self.drag, typed) {
            (Some(Drag::Move { poses, by, .. }), Typed::Length(far)) => {
                moved(poses, by.normalize_or(DVec2::X) * far)
            }
            (Some(Drag::Move { poses, .. }), Typed::At(by) | Typed::By(by)) => moved(poses, by),
            (Some(Drag::Scale { handle, frame, pieces, .. }), Typed::At(size) | Typed::By(size)) => {
                let old = (frame[1] - frame[0]).max(DVec2::splat(1e-6));
                scaled(*frame, *handle, pieces, (size / old).max(DVec2::splat(1e-3)))
            }
            (Some(Drag::Scale { handle, frame, pieces, .. }), Typed::Length(width)) => {
                let factor = (width / (frame[1].x - frame[0].x).max(1e-6)).max(1e-3);
                scaled(*frame, *handle, pieces, DVec2::splat(factor))
            }
            (Some(Drag::Turn { about, poses, .. }), Typed::Length(turn)) => {
                // A number typed without a unit is in degrees.
                turned(poses, *about, (turn / table.laid.unit.metres()).to_radians())
            }
            _ => return Err(tr("type how far: 10, or 10,5").to_owned()),
        };
        asks.extend([dragged(vec![edit]), Ask::EndDrag]);
        self.drag = None;
        Ok(())
    }

    fn give_up(&mut self, asks: &mut Asks) {
        if !matches!(self.drag.take(), None | Some(Drag::Box { .. })) {
            asks.push(Ask::CancelDrag);
        }
    }

    fn under(&self, table: &Table<'_>, p: DVec2) -> Option<Item> {
        let piece = || table.piece_at(p).map(|(piece, _)| Item::Piece(piece));
        let sewn = table.sewn_edge_at(p).map(Item::Seam);
        sewn.or_else(piece).or_else(|| table.thread_at(p).map(Item::Seam))
    }

    fn cursor(&self, table: &Table<'_>, at: DVec2) -> CursorIcon {
        match (&self.drag, handle_at(table, table.screen(at))) {
            (Some(Drag::Move { .. } | Drag::Turn { .. }), _) => CursorIcon::Grabbing,
            _ if self.only_selects => CursorIcon::Default,
            (_, Some(Handle::Turn)) => CursorIcon::Grab,
            (_, Some(Handle::Scale(handle))) => match (handle.x, handle.y) {
                (0.0, _) => CursorIcon::ResizeVertical,
                (_, 0.0) => CursorIcon::ResizeHorizontal,
                (x, y) if x * y > 0.0 => CursorIcon::ResizeNeSw,
                _ => CursorIcon::ResizeNwSe,
            },
            _ if table.piece_at(at).is_some() => CursorIcon::Grab,
            _ => CursorIcon::Default,
        }
    }

    fn hint(&self, _table: &Table<'_>) -> String {
        match &self.drag {
            _ if self.only_selects => tr("The cloth is dragged and pinned on the body · Click: select a piece"),
            Some(Drag::Move { .. }) => tr("Type how far (10 or 10,5) · Alt: do not snap · Esc: put it back"),
            Some(Drag::Scale { .. }) => tr("Type the size (40,60) · Shift: keep the proportions · Esc: put it back"),
            Some(Drag::Turn { .. }) => tr("Type degrees · Shift: steps of 15° · Esc: put it back"),
            Some(Drag::Box { .. }) => tr("Everything the box touches is selected"),
            None => {
                tr("Click: select, Shift adds · Drag a piece: move it · Drag beside: select by a box · Double-click: turn it over · Arrows: nudge")
            }
        }
        .to_owned()
    }
}

/// The item after (`step` 1) or before (-1) `chosen` in `all`.
pub fn next(all: &[Item], chosen: Option<Item>, step: i32) -> Option<Item> {
    let count = all.len() as i32;
    let now = chosen.and_then(|item| all.iter().position(|&i| i == item));
    let to = match now {
        Some(i) => (i as i32 + step).rem_euclid(count.max(1)),
        None if step > 0 => 0,
        None => count - 1,
    };
    all.get(usize::try_from(to).ok()?).copied()
}

fn poses(table: &Table<'_>, pieces: &BTreeSet<PieceId>) -> Vec<(PieceId, PlanePose)> {
    let free = pieces.iter().filter(|id| table.is_free(**id));
    free.filter_map(|&id| Some((id, table.pattern().pieces.get(&id)?.pose))).collect()
}

fn moved(poses: &[(PieceId, PlanePose)], by: DVec2) -> PatternEdit {
    let pose = |&(id, pose): &(PieceId, PlanePose)| (id, PlanePose { offset: pose.offset + by, ..pose });
    PatternEdit::Place { poses: poses.iter().map(pose).collect() }
}

/// The edit that rotates pieces about a point of the table.
pub fn turned(poses: &[(PieceId, PlanePose)], about: DVec2, by: f64) -> PatternEdit {
    let turn = DVec2::from_angle(by);
    let pose = |&(id, pose): &(PieceId, PlanePose)| {
        let offset = about + turn.rotate(pose.offset - about);
        (id, PlanePose { offset, rotation: pose.rotation + by, ..pose })
    };
    PatternEdit::Place { poses: poses.iter().map(pose).collect() }
}

fn scaled([lower, upper]: [DVec2; 2], handle: DVec2, pieces: &[PieceId], factor: DVec2) -> PatternEdit {
    let about = (lower + upper) / 2.0 - handle * (upper - lower) / 2.0;
    PatternEdit::Scale { pieces: pieces.to_vec(), about, factor }
}

fn factor_of([lower, upper]: [DVec2; 2], handle: DVec2, p: DVec2, alike: bool) -> DVec2 {
    let (middle, half) = ((lower + upper) / 2.0, (upper - lower) / 2.0);
    let fixed = middle - handle * half;
    let way = |handle: f64, p: f64, fixed: f64, half: f64| match handle {
        0.0 => 1.0,
        _ => ((p - fixed) * handle / (2.0 * half).max(1e-6)).max(1e-3),
    };
    let factor = DVec2::new(way(handle.x, p.x, fixed.x, half.x), way(handle.y, p.y, fixed.y, half.y));
    match (alike, handle.x, handle.y) {
        (false, ..) => factor,
        (true, 0.0, _) => DVec2::splat(factor.y),
        (true, _, 0.0) => DVec2::splat(factor.x),
        _ => DVec2::splat(factor.max_element()),
    }
}

/// The edit that flips a piece about the vertical line through its middle.
pub fn turned_over(table: &Table<'_>, id: PieceId) -> PatternEdit {
    let poses = table.piece(id).map(|(piece, shape)| {
        let middle = piece.pose.plane_from_piece(shape.middle);
        let turned =
            PlanePose { offset: DVec2::ZERO, rotation: -piece.pose.rotation, flipped: !piece.pose.flipped };
        let offset = middle - turned.plane_from_piece(shape.middle);
        (id, PlanePose { offset, ..turned })
    });
    PatternEdit::Place { poses: poses.into_iter().collect() }
}

/// The displacement of pieces for a pointer motion `by`: the best snap of any of their points decides. `before` is their present
/// displacement from where they were.
fn snapped_move(
    table: &Table<'_>,
    input: &Input,
    moving: &BTreeSet<PieceId>,
    by: DVec2,
    before: DVec2,
) -> (DVec2, Option<Snapped>) {
    if input.held.shift {
        let by = on_eighth(DVec2::ZERO, by);
        return (by, None);
    }
    let moves = |point: PointRef| moving.contains(&point.piece);
    let own = table.points().filter(|(point, _)| moves(*point)).map(|(_, p)| p - before);
    let drawn_on = own.filter_map(|start| {
        let snapped = table.snapped(start + by, None, input.held, moves);
        let rank = match snapped.by? {
            Snap::Point => 0,
            Snap::Middle | Snap::Guide => 1,
            Snap::Edge(..) => 2,
            Snap::Grid | Snap::Angle => return None,
        };
        Some((rank, snapped.place.distance(start + by), snapped, snapped.place - start))
    });
    let best = drawn_on.min_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    let is_free = !table.laid.snapping || input.held.alt || input.held.command;
    let round = if is_free { by } else { table.rounded(by) };
    best.map_or((round, None), |(_, _, snapped, by)| (by, Some(snapped)))
}

/// The selection of a box; with `add` the old selection is kept.
fn boxed(table: &Table<'_>, from: DVec2, to: DVec2, add: bool) -> Selection {
    let (lower, upper) = (from.min(to), from.max(to));
    let inside = |p: DVec2| p.cmpge(lower).all() && p.cmple(upper).all();
    let touched = table
        .seen()
        .filter(|(_, piece, shape)| shape.outline.iter().any(|&p| inside(piece.pose.plane_from_piece(p))));
    let mut selection = if add { table.laid.selection.clone() } else { Selection::default() };
    selection.pieces.extend(touched.map(|(id, ..)| id));
    selection
}

/// Bounding box of the selected pieces that may be changed.
fn frame(table: &Table<'_>) -> Option<[DVec2; 2]> {
    let pieces = table.laid.selection.pieces.iter().copied().filter(|&id| table.is_free(id));
    table.bounds(pieces)
}

/// Positions of the handles on the screen.
fn handles(table: &Table<'_>) -> Vec<(Handle, Pos2)> {
    let Some([lower, upper]) = frame(table) else { return Vec::new() };
    let area = Rect::from_two_pos(table.screen(lower), table.screen(upper)).expand(7.0);
    let place = |[x, y]: [f64; 2]| {
        area.center() + Vec2::new(x as f32 * area.width() / 2.0, -y as f32 * area.height() / 2.0)
    };
    let mut all: Vec<(Handle, Pos2)> =
        HANDLES.iter().map(|&h| (Handle::Scale(DVec2::from(h)), place(h))).collect();
    all.push((Handle::Turn, place([0.0, 1.0]) - Vec2::new(0.0, STALK)));
    all
}

fn handle_at(table: &Table<'_>, at: Pos2) -> Option<Handle> {
    let near = handles(table).into_iter().filter(|(_, place)| place.distance(at) <= GRIP);
    near.min_by(|a, b| a.1.distance(at).total_cmp(&b.1.distance(at))).map(|(handle, _)| handle)
}

fn draw_frame(drawing: &Drawing<'_>, table: &Table<'_>) {
    let all = handles(table);
    let corners: Vec<Pos2> = all.iter().filter(|(h, _)| *h != Handle::Turn).map(|(_, p)| *p).collect();
    if corners.is_empty() {
        return;
    }
    let stroke = Stroke::new(1.0, drawing.palette.accent.gamma_multiply(0.8));
    drawing.painter.add(egui::Shape::closed_line(corners.clone(), stroke));
    for (handle, at) in all {
        let p = table.at(at);
        if handle == Handle::Turn {
            drawing.painter.line_segment([at, corners[5]], stroke);
        }
        drawing.knob(p, handle == Handle::Turn, false);
    }
}
