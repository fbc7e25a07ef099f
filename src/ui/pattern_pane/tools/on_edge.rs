//! The tools that put darts and notches on edges.

use egui::{CursorIcon, Stroke};
use glam::DVec2;

use super::{PatternTool, done};
use crate::pattern::edit::PatternEdit;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::{say, tr};
use crate::ui::pattern_pane::draw::Drawing;
use crate::ui::pattern_pane::input::Input;
use crate::ui::pattern_pane::shapes::cloth_is_left;
use crate::ui::pattern_pane::table::{OnEdge, REACH, Table};
use crate::ui::preferences::units::Typed;
use crate::ui::selection::Item;

/// The tools Dart and Notch.
#[derive(Debug)]
pub struct OnEdgeTool {
    is_dart: bool,
    /// The place on an edge under the pointer.
    near: Option<OnEdge>,
    /// A dart being dragged into the cloth: its place, and its depth in metres.
    pulled: Option<(OnEdge, f64)>,
}

impl OnEdgeTool {
    /// The tool that cuts darts.
    pub fn dart() -> Self {
        Self { is_dart: true, near: None, pulled: None }
    }

    /// The tool that cuts notches.
    pub fn notch() -> Self {
        Self { is_dart: false, ..Self::dart() }
    }

    fn put(&self, table: &Table<'_>, on: OnEdge, depth: f64, asks: &mut Asks) {
        let OnEdge { edge, at, .. } = on;
        if !table.is_free(edge.piece) {
            return asks.push(Ask::Say(tr("This piece is locked.").to_owned()));
        }
        let piece = &table.pattern().pieces[&edge.piece];
        if self.is_dart {
            let width = table.options.dart_width;
            return asks.push(done(vec![PatternEdit::AddDart { edge, at, width, depth }]));
        }
        let length = table.piece(edge.piece).map_or(1.0, |(_, shape)| shape.lengths[edge.edge]);
        let reach = table.reach(REACH) / length.max(1e-9);
        let there = piece.notches.iter().position(|n| n.edge == edge.edge && (n.at - at).abs() < reach);
        asks.push(done(vec![match there {
            Some(notch) => PatternEdit::DeleteNotch { piece: edge.piece, notch },
            None => PatternEdit::AddNotch { edge, at },
        }]));
    }

    /// The place on an edge at `p`; it snaps to the middle of the edge.
    fn place(&self, table: &Table<'_>, p: DVec2, input: &Input) -> Option<OnEdge> {
        let mut on = table.edge_near(p, 14.0)?;
        let (piece, shape) = table.piece(on.edge.piece)?;
        let off = (on.at - 0.5).abs() * shape.lengths[on.edge.edge];
        if table.laid.snapping && !input.held.alt && !input.held.command && off <= table.reach(REACH) {
            on.at = 0.5;
        }
        on.place = piece.pose.plane_from_piece(piece.edge_points(on.edge.edge, &[on.at])[0]);
        Some(on)
    }
}

/// Direction into the cloth at a place on an edge, on the table.
fn into_cloth(table: &Table<'_>, on: OnEdge) -> Option<DVec2> {
    let piece = table.pattern().pieces.get(&on.edge.piece)?;
    let near = [on.at - 1e-3, on.at + 1e-3].map(|f| f.clamp(0.0, 1.0));
    let ends = piece.edge_points(on.edge.edge, &near);
    let along = (ends[1] - ends[0]).normalize_or_zero();
    let way = along.perp() * if cloth_is_left(piece, on.edge.edge) { 1.0 } else { -1.0 };
    Some(piece.pose.plane_from_piece(ends[0] + way) - piece.pose.plane_from_piece(ends[0]))
}

impl PatternTool for OnEdgeTool {
    fn step(&mut self, table: &Table<'_>, input: &Input, asks: &mut Asks) {
        for &at in &input.clicks {
            match self.place(table, table.at(at), input) {
                Some(on) => self.put(table, on, table.options.dart_depth, asks),
                None => asks.push(Ask::Say(tr("Click an edge of a piece.").to_owned())),
            }
        }
        if let Some(at) = input.pressed.filter(|_| self.is_dart) {
            self.pulled = self.place(table, table.at(at), input).map(|on| (on, 0.0));
        }
        if let (Some((on, depth)), Some(&at)) = (&mut self.pulled, input.trail.last())
            && let Some(way) = into_cloth(table, *on)
        {
            *depth = (table.at(at) - on.place).dot(way).max(0.0);
        }
        if input.let_go
            && let Some((on, depth)) = self.pulled.take()
            && depth > 1e-3
        {
            self.put(table, on, depth, asks);
        }
        self.near = input.hover.and_then(|at| self.place(table, table.at(at), input));
    }

    fn draw(&self, drawing: &Drawing<'_>, table: &Table<'_>, input: &Input) {
        let Some((on, depth)) = self.pulled.or(self.near.map(|on| (on, table.options.dart_depth))) else {
            return;
        };
        let Some((piece, shape)) = table.piece(on.edge.piece) else { return };
        let (ink, unit) = (drawing.palette.accent, table.laid.unit);
        let length = shape.lengths[on.edge.edge];
        let mut words = format!("{} | {}", unit.number(on.at * length), unit.text((1.0 - on.at) * length));
        if let (true, Some(way)) = (self.is_dart, into_cloth(table, on)) {
            let half = table.options.dart_width / 2.0 / length.max(1e-9);
            let ends = [on.at - half, on.at + half].map(|f| f.clamp(0.0, 1.0));
            let ends = piece.edge_points(on.edge.edge, &ends);
            let legs = [ends[0], ends[1]].map(|p| piece.pose.plane_from_piece(p));
            drawing.polyline(&[legs[0], on.place + way * depth, legs[1]], Stroke::new(2.0, ink));
            words = say!("{places}   {depth} deep", places = words, depth = unit.text(depth));
        }
        drawing.painter.circle_filled(drawing.place(on.place), 4.0, ink);
        drawing.chip(input.hover.unwrap_or(drawing.pane.center()), &words);
    }

    fn is_busy(&self) -> bool {
        self.pulled.is_some()
    }

    fn is_dragging(&self) -> bool {
        self.pulled.is_some()
    }

    fn give_up(&mut self, _asks: &mut Asks) {
        self.pulled = None;
    }

    fn takes_numbers(&self) -> bool {
        self.near.is_some() || self.pulled.is_some()
    }

    fn typed(&mut self, table: &Table<'_>, typed: Typed, asks: &mut Asks) -> Result<(), String> {
        let Some(mut on) = self.pulled.map(|(on, _)| on).or(self.near) else {
            return Err(tr("point at an edge first").to_owned());
        };
        let Typed::Length(far) = typed else { return Err(tr("type one length").to_owned()) };
        let length = table.piece(on.edge.piece).map_or(1.0, |(_, shape)| shape.lengths[on.edge.edge]);
        if self.pulled.take().is_some() {
            self.put(table, on, far, asks);
        } else if (0.0..=length).contains(&far) {
            on.at = far / length;
            self.put(table, on, table.options.dart_depth, asks);
        } else {
            return Err(tr("the edge is not so long").to_owned());
        }
        Ok(())
    }

    fn under(&self, table: &Table<'_>, p: DVec2) -> Option<Item> {
        table.edge_near(p, 14.0).map(|on| Item::Edge(on.edge))
    }

    fn cursor(&self, _table: &Table<'_>, _at: DVec2) -> CursorIcon {
        CursorIcon::Crosshair
    }

    fn hint(&self, _table: &Table<'_>) -> String {
        match (self.is_dart, self.pulled.is_some()) {
            (true, true) => tr("Let go at the tip · Type how deep · Esc: give up"),
            (true, false) => tr("Drag from an edge into the cloth: a dart · Click: one as deep as Depth says · Type how far along the edge"),
            _ => tr("Click an edge: a notch; a notch: take it away · Type how far along the edge"),
        }
        .to_owned()
    }
}
