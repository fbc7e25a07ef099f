//! The tools that paint and erase marks on pieces.

use egui::CursorIcon;
use glam::DVec2;

use super::PatternTool;
use crate::geometry::ids::PieceId;
use crate::session::Command;
use crate::ui::actions::asks::{Ask, Asks, in_one_step};
use crate::ui::language::{say, tr};
use crate::ui::pattern_pane::draw::{Drawing, MarkLook};
use crate::ui::pattern_pane::draw_pieces::front_is_seen;
use crate::ui::pattern_pane::input::Input;
use crate::ui::pattern_pane::table::Table;
use crate::ui::pointer::stroke;
use crate::ui::preferences::units::Typed;
use crate::wrap::ClothSide;

/// A stroke on a piece, in the piece's own plane.
type Stroke = (PieceId, Vec<DVec2>);

/// The tools Mark and Erase.
#[derive(Debug)]
pub struct Marks {
    erases: bool,
    /// Strokes in progress: that on the topmost piece first, with the laser followed by those on pieces below.
    strokes: Option<Vec<Stroke>>,
    /// Corners of a stroke drawn by keys, on the table; it is straight between them.
    corners: Vec<DVec2>,
}

/// Sampling distance of a stroke drawn by keys, metres.
const FOLLOW_STEP: f64 = 0.002;

impl Marks {
    /// The tool that paints.
    pub fn painting() -> Self {
        Self { erases: false, strokes: None, corners: Vec::new() }
    }

    /// The tool that erases.
    pub fn erasing() -> Self {
        Self { erases: true, strokes: None, corners: Vec::new() }
    }

    fn click(&self, table: &Table<'_>, p: DVec2, erasing: bool, asks: &mut Asks) {
        match table.mark_at(p) {
            Some(mark) if erasing => asks.push(Ask::Do(Command::DeleteMark { mark })),
            Some(mark) if !self.erases => asks.push(Ask::Select(Some(mark))),
            None if !erasing => dot(table, p, asks),
            _ => {}
        }
    }

    fn add_corner(&mut self, table: &Table<'_>, p: DVec2, asks: &mut Asks) {
        if self.corners.is_empty() && table.piece_at(p).is_none() {
            asks.push(Ask::Say(tr("Marks are painted on the pieces: begin on one of them.").to_owned()));
        } else if self.corners.last() != Some(&p) {
            self.corners.push(p);
        }
    }

    fn paint_corners(&mut self, table: &Table<'_>, asks: &mut Asks) {
        let corners = std::mem::take(&mut self.corners);
        let Some((piece, first)) = corners.first().and_then(|&p| table.piece_at(p)) else { return };
        let mut strokes = vec![(piece, vec![first])];
        go_through(&mut strokes, table, corners[0]);
        for w in corners.windows(2) {
            let steps = (w[0].distance(w[1]) / FOLLOW_STEP).ceil().max(1.0);
            for i in 1..=steps as u32 {
                go_through(&mut strokes, table, w[0].lerp(w[1], f64::from(i) / steps));
            }
        }
        paint(table, strokes, asks);
    }
}

impl PatternTool for Marks {
    fn step(&mut self, table: &Table<'_>, input: &Input, asks: &mut Asks) {
        let erasing = self.erases || input.held.command;
        for &at in &input.clicks {
            match input.by_keys && !erasing {
                true => self.add_corner(table, table.at(at), asks),
                false => self.click(table, table.at(at), erasing, asks),
            }
        }
        if input.backspace {
            self.corners.pop();
        }
        if input.enter && !self.corners.is_empty() {
            self.paint_corners(table, asks);
        }
        if let Some(at) = input.pressed.filter(|_| !erasing)
            && let Some((piece, p)) = table.piece_at(table.at(at))
        {
            let mut strokes = vec![(piece, vec![p])];
            go_through(&mut strokes, table, table.at(at));
            self.strokes = Some(strokes);
        }
        if let Some(strokes) = &mut self.strokes {
            for &at in &input.trail {
                go_through(strokes, table, table.at(at));
            }
        }
        if input.let_go
            && let Some(strokes) = self.strokes.take()
        {
            paint(table, strokes, asks);
        }
    }

    fn draw(&self, drawing: &Drawing<'_>, table: &Table<'_>, input: &Input) {
        if !self.corners.is_empty() {
            let next = input.hover.map(|at| table.at(at));
            let line: Vec<DVec2> = self.corners.iter().copied().chain(next).collect();
            drawing.polyline(&line, egui::Stroke::new(2.0, drawing.palette.accent));
            self.corners.iter().for_each(|&corner| drawing.knob(corner, false, false));
        }
        if let Some((id, points)) = self.stroke()
            && let Some(piece) = table.pattern().pieces.get(&id)
        {
            let points: Vec<DVec2> = points.iter().map(|&p| piece.pose.plane_from_piece(p)).collect();
            let marks = &table.laid.document.marks;
            let number = marks.cloth.len() + 1;
            let paired = number <= marks.body.len();
            drawing.mark(&points, number, MarkLook { paired, ..MarkLook::default() });
        }
    }

    fn is_busy(&self) -> bool {
        self.strokes.is_some() || !self.corners.is_empty()
    }

    fn is_dragging(&self) -> bool {
        self.strokes.is_some()
    }

    fn draws(&self) -> bool {
        true
    }

    fn takes_numbers(&self) -> bool {
        !self.corners.is_empty()
    }

    fn typed(&mut self, table: &Table<'_>, typed: Typed, asks: &mut Asks) -> Result<(), String> {
        let none = || tr("the first corner is set with the arrow keys and Space");
        let last = *self.corners.last().ok_or_else(none)?;
        let at = match typed {
            Typed::At(p) => p,
            Typed::By(by) => last + by,
            Typed::Length(_) => return Err(tr("the next corner needs both: 30,40 or @0,12").to_owned()),
        };
        self.add_corner(table, at, asks);
        Ok(())
    }

    fn give_up(&mut self, _asks: &mut Asks) {
        self.strokes = None;
        self.corners.clear();
    }

    fn stroke(&self) -> Option<(PieceId, &[DVec2])> {
        self.strokes.as_ref()?.first().map(|(piece, points)| (*piece, &points[..]))
    }

    fn cursor(&self, table: &Table<'_>, at: DVec2) -> CursorIcon {
        let on_mark = table.mark_at(at).is_some();
        match (self.erases, on_mark) {
            (true, true) => CursorIcon::PointingHand,
            (false, _) if self.is_busy() || table.piece_at(at).is_some() => CursorIcon::Crosshair,
            _ => CursorIcon::Default,
        }
    }

    fn hint(&self, table: &Table<'_>) -> String {
        let next = table.laid.document.marks.cloth.len() + 1;
        if !self.corners.is_empty() {
            return say!(
                "Arrows and Space: the next corner · Enter: paint mark {next} · Backspace: one corner back · Esc: give up",
                next
            );
        }
        match (self.erases, table.laid.laser) {
            (true, _) => tr("Click a mark: take it away").to_owned(),
            (_, true) => {
                say!("Drag: paint marks {next}… on every piece that lies here · L: only the topmost", next)
            }
            _ => say!(
                "Drag: paint mark {next} on the cloth · Click: a dot, or select a mark · Ctrl+click: erase",
                next
            ),
        }
    }
}

fn paint(table: &Table<'_>, mut strokes: Vec<Stroke>, asks: &mut Asks) {
    for (_, points) in &mut strokes {
        *points = stroke::finished(points);
    }
    in_one_step(painted(table, strokes), asks);
}

fn dot(table: &Table<'_>, p: DVec2, asks: &mut Asks) {
    let hit = table.shapes.all_at(table.pattern(), p).take(if table.laid.laser { usize::MAX } else { 1 });
    let dots: Vec<Stroke> = hit.map(|(piece, p)| (piece, vec![p])).collect();
    match dots.is_empty() {
        false => in_one_step(painted(table, dots), asks),
        true if table.pattern().pieces.is_empty() => {}
        true => asks.push(Ask::Say(tr("Marks are painted on the pieces: press on one of them.").to_owned())),
    }
}

/// Continues the strokes to a point of the table. Outside of the first piece nothing is painted. With the laser each piece below
/// gets its own stroke once the pointer is over it.
fn go_through(strokes: &mut Vec<Stroke>, table: &Table<'_>, p: DVec2) {
    let Some(&(first, _)) = strokes.first() else { return };
    let below = table.shapes.all_at(table.pattern(), p).skip_while(|(piece, _)| *piece != first);
    for (piece, p) in below.take(if table.laid.laser { usize::MAX } else { 1 }) {
        match strokes.iter_mut().find(|(painted, _)| *painted == piece) {
            Some((_, points)) if points.last().is_none_or(|l| l.distance(p) > 1e-4) => points.push(p),
            Some(_) => {}
            None => strokes.push((piece, vec![p])),
        }
    }
}

/// The commands that paint `strokes`. The first is painted on the visible side. The others are painted on the front of their
/// pieces even where their back is visible, since nobody wants to turn half a garment inside out.
fn painted(table: &Table<'_>, strokes: Vec<Stroke>) -> Vec<Command> {
    let command = |(i, (piece, points)): (usize, Stroke)| {
        let (found, shape) = table.piece(piece)?;
        let front = front_is_seen(found, shape) || i > 0;
        let side = if front { ClothSide::Front } else { ClothSide::Back };
        Some(Command::AddClothMark { piece, side, points })
    };
    strokes.into_iter().enumerate().filter_map(command).collect()
}
