//! The tool that draws the grainline.

use egui::{CursorIcon, Stroke};
use glam::DVec2;

use super::{PatternTool, done};
use crate::geometry::ids::PieceId;
use crate::pattern::edit::PatternEdit;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::tr;
use crate::ui::pattern_pane::draw::Drawing;
use crate::ui::pattern_pane::input::Input;
use crate::ui::pattern_pane::table::Table;
use crate::ui::preferences::units::degrees;

/// The tool Grainline.
#[derive(Debug, Default)]
pub struct Grain {
    /// The piece, and tail and head of the arrow being drawn, on the table.
    drawn: Option<(PieceId, [DVec2; 2])>,
}

impl PatternTool for Grain {
    fn step(&mut self, table: &Table<'_>, input: &Input, asks: &mut Asks) {
        for &at in &input.clicks {
            let p = table.at(at);
            let Some((piece, _)) = table.piece_at(p).filter(|(id, _)| table.is_free(*id)) else {
                asks.push(Ask::Say(tr("Drag along the warp, on a piece that is not locked.").to_owned()));
                continue;
            };
            let found = &table.pattern().pieces[&piece];
            // A click adds a vertical arrow a third as long as the piece, or removes the existing one.
            let grainline = found.grainline.is_none().then(|| {
                let height = table.bounds([piece].into_iter()).map_or(0.1, |[a, b]| b.y - a.y);
                let half = DVec2::Y * (height / 6.0);
                [p - half, p + half].map(|q| found.pose.piece_from_plane(q))
            });
            asks.push(done(vec![PatternEdit::SetGrainline { piece, grainline }]));
        }
        if let Some(at) = input.pressed {
            let p = table.at(at);
            let piece = table.piece_at(p).filter(|(id, _)| table.is_free(*id));
            self.drawn = piece.map(|(id, _)| (id, [p, p]));
        }
        if let (Some((_, [tail, head])), Some(&at)) = (&mut self.drawn, input.trail.last()) {
            *head = table.snapped(table.at(at), Some(*tail), input.held, |_| false).place;
        }
        if input.let_go
            && let Some((piece, ends)) = self.drawn.take()
            && ends[0].distance(ends[1]) > 0.005
        {
            let pose = table.pattern().pieces[&piece].pose;
            let grainline = Some(ends.map(|p| pose.piece_from_plane(p)));
            asks.push(done(vec![PatternEdit::SetGrainline { piece, grainline }]));
        }
    }

    fn draw(&self, drawing: &Drawing<'_>, table: &Table<'_>, input: &Input) {
        if let Some((_, [tail, head])) = self.drawn {
            drawing.polyline(&[tail, head], Stroke::new(2.0, drawing.palette.accent));
            let turn = degrees((head - tail).to_angle());
            let words = format!("{}  {turn}°", table.laid.unit.text(tail.distance(head)));
            drawing.chip(input.hover.unwrap_or(drawing.pane.center()), &words);
        }
    }

    fn is_busy(&self) -> bool {
        self.drawn.is_some()
    }

    fn is_dragging(&self) -> bool {
        self.drawn.is_some()
    }

    fn takes_numbers(&self) -> bool {
        false
    }

    fn give_up(&mut self, _asks: &mut Asks) {
        self.drawn = None;
    }

    fn cursor(&self, _table: &Table<'_>, _at: DVec2) -> CursorIcon {
        CursorIcon::Crosshair
    }

    fn hint(&self, _table: &Table<'_>) -> String {
        tr("Drag on a piece along the warp, from tail to head · Shift: 45° · Click: upright, or none")
            .to_owned()
    }
}
