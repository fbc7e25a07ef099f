//! The tools that draw rectangles and ellipses: drag from corner to corner, click both corners, or type the size.

use egui::{CursorIcon, Stroke};
use glam::DVec2;

use super::{PatternTool, done, new_piece};
use crate::pattern::edit::PatternEdit;
use crate::pattern::{Edge, EdgeShape};
use crate::ui::actions::asks::Asks;
use crate::ui::language::tr;
use crate::ui::pattern_pane::draw::Drawing;
use crate::ui::pattern_pane::input::Input;
use crate::ui::pattern_pane::snap::Snapped;
use crate::ui::pattern_pane::table::Table;
use crate::ui::preferences::units::Typed;
use crate::ui::selection::Item;

/// Smallest side, metres; a smaller shape was drawn by accident.
const LEAST: f64 = 0.002;
/// Length of the control arms of a cubic that approximates a quarter circle, relative to the radius.
const KAPPA: f64 = 0.552_284_75;

/// The tool that draws rectangles or ellipses.
#[derive(Debug)]
pub struct Shape {
    is_ellipse: bool,
    /// The first corner.
    from: Option<DVec2>,
    /// Whether the button is still down since the first corner.
    dragging: bool,
    /// Position of the opposite corner.
    next: Option<Snapped>,
}

impl Shape {
    /// The tool that draws rectangles.
    pub fn rectangle() -> Self {
        Self { is_ellipse: false, from: None, dragging: false, next: None }
    }

    /// The tool that draws ellipses.
    pub fn ellipse() -> Self {
        Self { is_ellipse: true, ..Self::rectangle() }
    }

    fn make(&mut self, table: &Table<'_>, to: DVec2, asks: &mut Asks) {
        let Some(from) = self.from else { return };
        if (to - from).abs().min_element() < LEAST {
            return;
        }
        let piece = new_piece(table.pattern(), &self.edges(from, to));
        asks.push(done(vec![PatternEdit::AddPiece { piece: piece.into() }]));
        (self.from, self.dragging) = (None, false);
    }

    fn edges(&self, from: DVec2, to: DVec2) -> Vec<Edge> {
        let (a, b) = (from.min(to), from.max(to));
        if !self.is_ellipse {
            let corners = [a, DVec2::new(b.x, a.y), b, DVec2::new(a.x, b.y)];
            return corners.map(|start| Edge { start, ..Edge::default() }).to_vec();
        }
        let (middle, half) = ((a + b) / 2.0, (b - a) / 2.0);
        let ways = [DVec2::X, DVec2::Y, -DVec2::X, -DVec2::Y];
        let place = |way: DVec2| middle + half * way;
        let is_circle = (half.x - half.y).abs() < 1e-9;
        let edge = |i: usize| {
            let (p, q) = (ways[i], ways[(i + 1) % 4]);
            let shape = if is_circle {
                EdgeShape::Arc { radius: half.x, large: false, sweep: true }
            } else {
                EdgeShape::Cubic { controls: [place(p + q * KAPPA), place(q + p * KAPPA)] }
            };
            Edge { start: place(p), shape, smooth: true, ..Edge::default() }
        };
        (0..4).map(edge).collect()
    }

    /// The opposite corner; with Shift the shape is as wide as it is high.
    fn other(&self, table: &Table<'_>, p: DVec2, input: &Input) -> Snapped {
        let found = table.snapped(p, None, egui::Modifiers { shift: false, ..input.held }, |_| false);
        match self.from.filter(|_| input.held.shift) {
            Some(from) => {
                let size = found.place - from;
                let side = size.abs().max_element();
                Snapped {
                    place: from + DVec2::new(side.copysign(size.x), side.copysign(size.y)),
                    by: found.by,
                }
            }
            None => found,
        }
    }
}

impl PatternTool for Shape {
    fn step(&mut self, table: &Table<'_>, input: &Input, asks: &mut Asks) {
        for &at in &input.clicks {
            let place = self.other(table, table.at(at), input).place;
            match self.from {
                None => self.from = Some(place),
                Some(_) => self.make(table, place, asks),
            }
        }
        if let Some(at) = input.pressed {
            self.from = self.from.or(Some(self.other(table, table.at(at), input).place));
            self.dragging = true;
        }
        self.next = input.hover.map(|at| self.other(table, table.at(at), input));
        if (input.let_go && self.dragging) || (input.enter && self.from.is_some()) {
            self.dragging = false;
            if let Some(next) = self.next {
                self.make(table, next.place, asks);
            }
        }
    }

    fn draw(&self, drawing: &Drawing<'_>, table: &Table<'_>, input: &Input) {
        let Some(next) = self.next else { return };
        let Some(from) = self.from else { return drawing.snapped(&next) };
        let mut outline = crate::pattern::piece::flattened_loop(&self.edges(from, next.place), 5e-4);
        outline.extend(outline.first().copied());
        drawing.polyline(&outline, Stroke::new(2.0, drawing.palette.accent));
        drawing.snapped(&next);
        let (size, unit) = ((next.place - from).abs(), table.laid.unit);
        let words = format!("{} × {}", unit.number(size.x), unit.text(size.y));
        drawing.chip(input.hover.unwrap_or(drawing.pane.center()), &words);
    }

    fn is_busy(&self) -> bool {
        self.from.is_some()
    }

    fn is_dragging(&self) -> bool {
        self.dragging
    }

    fn give_up(&mut self, _asks: &mut Asks) {
        (self.from, self.dragging) = (None, false);
    }

    fn takes_numbers(&self) -> bool {
        true
    }

    fn typed(&mut self, table: &Table<'_>, typed: Typed, asks: &mut Asks) -> Result<(), String> {
        let size = match (typed, self.from) {
            (Typed::At(p), None) => {
                self.from = Some(p);
                return Ok(());
            }
            (_, None) => return Err(tr("the first corner needs both: 30,40").to_owned()),
            (Typed::At(size) | Typed::By(size), Some(_)) => size,
            (Typed::Length(side), Some(_)) => DVec2::splat(side),
        };
        if size.abs().min_element() < LEAST {
            return Err(tr("that is too small").to_owned());
        }
        let from = self.from.unwrap_or_default();
        // A typed size has no signs; the shape grows in the direction of the pointer.
        let way = self.next.map_or(DVec2::ONE, |next| next.place - from);
        let signed = |size: f64, way: f64| if way < 0.0 { -size } else { size };
        self.make(table, from + DVec2::new(signed(size.x, way.x), signed(size.y, way.y)), asks);
        Ok(())
    }

    fn draws(&self) -> bool {
        true
    }

    fn under(&self, _table: &Table<'_>, _p: DVec2) -> Option<Item> {
        None
    }

    fn cursor(&self, _table: &Table<'_>, _at: DVec2) -> CursorIcon {
        CursorIcon::Crosshair
    }

    fn hint(&self, _table: &Table<'_>) -> String {
        match (self.from.is_some(), self.is_ellipse) {
            (false, true) => tr("Drag: an ellipse · Click: its first corner · Type a place: 30,40"),
            (false, false) => tr("Drag: a rectangle · Click: its first corner · Type a place: 30,40"),
            (true, true) => {
                tr("Click: the other corner · Type its size: 40,60 · Shift: circle · Esc: give up")
            }
            (true, false) => {
                tr("Click: the other corner · Type its size: 40,60 · Shift: square · Esc: give up")
            }
        }
        .to_owned()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::Pattern;

    #[test]
    fn circles_are_round_and_ellipses_smooth() {
        let circle = Shape::ellipse().edges(DVec2::ZERO, DVec2::ONE);
        let piece = new_piece(&Pattern::default(), &circle);
        assert!((piece.edge_length(0) - std::f64::consts::FRAC_PI_4).abs() < 1e-6);
        let ellipse = Shape::ellipse().edges(DVec2::new(2.0, 1.0), DVec2::ZERO);
        let piece = new_piece(&Pattern::default(), &ellipse);
        assert!((piece.signed_area() - std::f64::consts::PI / 2.0).abs() < 1e-3, "{}", piece.signed_area());
        assert!(piece.outline.iter().all(|edge| edge.smooth));
    }
}
