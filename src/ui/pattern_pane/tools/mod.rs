//! The tools of the pattern pane: one state machine for each, in a file of its own.

mod grade;
mod grain;
mod graphic;
mod marks;
mod on_edge;
mod pen;
mod points;
mod select;
mod sew;
mod shape;
mod walk;

use egui::CursorIcon;
use glam::DVec2;

use super::draw::Drawing;
use super::input::Input;
use super::table::Table;
use crate::geometry::ids::PieceId;
use crate::pattern::edit::PatternEdit;
use crate::pattern::{Edge, Pattern, Piece, PlanePose};
use crate::session::Command;
use crate::ui::actions::Tool;
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::language::tr;
use crate::ui::preferences::units::Typed;
use crate::ui::selection::Item;

/// A tool. It reads the table and makes requests; it keeps only the state of what is in progress.
pub trait PatternTool: std::fmt::Debug {
    /// Handles the input of a frame.
    fn step(&mut self, table: &Table<'_>, input: &Input, asks: &mut Asks);

    /// Draws what is in progress.
    fn draw(&self, _drawing: &Drawing<'_>, _table: &Table<'_>, _input: &Input) {}

    /// Whether something is in progress that Esc cancels.
    fn is_busy(&self) -> bool {
        false
    }

    /// Cancels what is in progress.
    fn give_up(&mut self, _asks: &mut Asks) {}

    /// Whether the tool is following a drag.
    fn is_dragging(&self) -> bool {
        false
    }

    /// Whether the tool accepts typed numbers now.
    fn takes_numbers(&self) -> bool {
        self.is_busy()
    }

    /// Takes typed numbers. The error is a message.
    fn typed(&mut self, _table: &Table<'_>, _typed: Typed, _asks: &mut Asks) -> Result<(), String> {
        Err(tr("nothing here can be typed").to_owned())
    }

    /// Whether the tool draws at free positions, for which the keyboard has a cursor.
    fn draws(&self) -> bool {
        false
    }

    /// The item that a click at `p` would be about.
    fn under(&self, table: &Table<'_>, p: DVec2) -> Option<Item> {
        table.piece_at(p).map(|(piece, _)| Item::Piece(piece))
    }

    /// The cursor at a point of the table.
    fn cursor(&self, _table: &Table<'_>, _at: DVec2) -> CursorIcon {
        CursorIcon::Default
    }

    /// The mark being painted: its piece, and its points in the piece's plane.
    fn stroke(&self) -> Option<(PieceId, &[DVec2])> {
        None
    }

    /// The item that was selected last by keys, while it is.
    fn selected_by_keys(&self, _table: &Table<'_>) -> Option<Item> {
        None
    }

    /// The hint for the status bar while the pane has the keyboard and not the pointer; None: that of the pointer.
    fn hint_by_keys(&self) -> Option<&'static str> {
        None
    }

    /// The hint for the status bar.
    fn hint(&self, table: &Table<'_>) -> String;
}

/// A new handler for a tool.
pub fn handler(tool: Tool) -> Box<dyn PatternTool> {
    match tool {
        Tool::Mark => Box::new(marks::Marks::painting()),
        Tool::Erase => Box::new(marks::Marks::erasing()),
        Tool::Move | Tool::Place => Box::<select::Select>::default(),
        Tool::Drag(_) | Tool::Pin | Tool::ClothLine | Tool::Bone => Box::new(select::Select::idle()),
        Tool::Points => Box::<points::Points>::default(),
        Tool::Pen => Box::new(pen::Pen::new(pen::Makes::Piece)),
        Tool::Line => Box::new(pen::Pen::new(pen::Makes::Line)),
        Tool::Hole => Box::new(pen::Pen::new(pen::Makes::Hole)),
        Tool::Cut => Box::new(pen::Pen::new(pen::Makes::Cut)),
        Tool::Rectangle => Box::new(shape::Shape::rectangle()),
        Tool::Ellipse => Box::new(shape::Shape::ellipse()),
        Tool::Dart => Box::new(on_edge::OnEdgeTool::dart()),
        Tool::Notch => Box::new(on_edge::OnEdgeTool::notch()),
        Tool::Grain => Box::<grain::Grain>::default(),
        Tool::Graphic => Box::<graphic::Graphics>::default(),
        Tool::Sew => Box::<sew::Sew>::default(),
    }
}

/// A request for edits as an undo step of their own.
fn done(edits: Vec<PatternEdit>) -> Ask {
    Ask::Do(Command::EditPattern { edits, anew: false })
}

/// A request for edits to the state at the beginning of the drag.
fn dragged(edits: Vec<PatternEdit>) -> Ask {
    Ask::Drag(Command::EditPattern { edits, anew: true })
}

/// A closed line on the table, converted to the plane of a piece at `pose`.
fn in_piece(edges: &[Edge], pose: &PlanePose) -> Vec<Edge> {
    let own = |p: DVec2| pose.piece_from_plane(p);
    let edge = |edge: &Edge| Edge {
        start: own(edge.start),
        shape: edge.shape.mapped(pose.flipped, own),
        smooth: edge.smooth,
        trims: edge.trims,
        ..Edge::default()
    };
    edges.iter().map(edge).collect()
}

/// A new piece with this closed line on the table as outline, its front up.
fn new_piece(pattern: &Pattern, edges: &[Edge]) -> Piece {
    let starts = edges.iter().map(|edge| edge.start);
    let [lower, upper] =
        starts.fold([DVec2::INFINITY, DVec2::NEG_INFINITY], |[a, b], p| [a.min(p), b.max(p)]);
    let pose = PlanePose { offset: (lower + upper) / 2.0, ..PlanePose::default() };
    let mut piece =
        Piece { name: free_name(pattern), outline: in_piece(edges, &pose), pose, ..Piece::default() };
    if piece.signed_area() < 0.0 {
        piece.outline = turned_round(&piece.outline);
    }
    piece
}

fn free_name(pattern: &Pattern) -> String {
    let names = (1..).map(|i| format!("Piece {i}"));
    names.into_iter().find(|name| pattern.piece_named(name).is_none()).unwrap_or_default()
}

/// The closed line in the opposite direction.
fn turned_round(edges: &[Edge]) -> Vec<Edge> {
    let n = edges.len();
    let edge = |i: usize| Edge {
        start: edges[(n - i) % n].start,
        shape: edges[n - 1 - i].shape.reversed(),
        smooth: edges[(n - i) % n].smooth,
        corner: edges[(n - i) % n].corner.reversed(),
        rule: edges[(n - i) % n].rule.clone(),
        ..edges[n - 1 - i].clone()
    };
    (0..n).map(edge).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::EdgeShape;

    #[test]
    fn what_is_drawn_clockwise_lies_front_up_all_the_same() {
        let corner = |x: f64, y: f64, shape| Edge { start: DVec2::new(x, y), shape, ..Edge::default() };
        let bend = EdgeShape::Quadratic { control: DVec2::new(1.5, 0.5) };
        let edges = [
            corner(0.0, 0.0, EdgeShape::Line),
            corner(0.0, 1.0, EdgeShape::Line),
            corner(1.0, 1.0, bend),
            corner(1.0, 0.0, EdgeShape::Line),
        ];
        let piece = new_piece(&Pattern::default(), &edges);
        assert_eq!(piece.name, "Piece 1");
        assert!((piece.signed_area() - (1.0 + 1.0 / 6.0)).abs() < 1e-3, "{}", piece.signed_area());
        let placed: Vec<DVec2> = piece.outline.iter().map(|e| piece.pose.plane_from_piece(e.start)).collect();
        assert_eq!(placed, [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(DVec2::from));
        assert_eq!(piece.outline[1].shape, EdgeShape::Quadratic { control: DVec2::new(1.0, 0.0) });
    }
}
