//! Helpers for drawing outlines edge by edge, and for sewing and laying out pieces.

use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};

use crate::geometry::ids::PieceId;
use crate::pattern::{Edge, EdgeRef, EdgeShape, Pattern, Piece, PlanePose, Seam, SpacePose, curve};

/// An outline under construction, counter-clockwise.
pub struct Outline {
    edges: Vec<Edge>,
    at: DVec2,
}

impl Outline {
    /// Starts at `start`.
    pub fn from(start: DVec2) -> Self {
        Self { edges: Vec::new(), at: start }
    }

    /// A straight edge called `label`.
    pub fn line(self, label: &str, to: DVec2) -> Self {
        self.edge(label, EdgeShape::Line, to)
    }

    /// A curved edge called `label`.
    pub fn curve(self, label: &str, first: DVec2, second: DVec2, to: DVec2) -> Self {
        self.edge(label, EdgeShape::Cubic { controls: [first, second] }, to)
    }

    fn edge(mut self, label: &str, shape: EdgeShape, to: DVec2) -> Self {
        self.edges.push(Edge { start: self.at, shape, label: Some(label.to_owned()), ..Edge::default() });
        self.at = to;
        self
    }

    /// A piece called `name`; the last edge must have come back to the start.
    pub fn piece(self, name: &str) -> Piece {
        debug_assert!(self.edges[0].start.distance(self.at) < 1e-9, "{name} is not closed");
        Piece { name: name.to_owned(), outline: self.edges, ..Piece::default() }
    }
}

/// `piece` mirrored in its own y axis, under another name. In labels, left and right are exchanged.
pub fn mirrored(piece: &Piece, name: &str) -> Piece {
    let mut outline = curve::mirrored(&piece.outline);
    for edge in &mut outline {
        edge.label = edge.label.as_deref().map(other_side);
    }
    Piece { name: name.to_owned(), outline, ..piece.clone() }
}

fn other_side(label: &str) -> String {
    if label.contains("left") { label.replace("left", "right") } else { label.replace("right", "left") }
}

/// The edge of `piece` called `label`. Panics when there is none: labels are written in code.
pub fn edge(pattern: &Pattern, piece: PieceId, label: &str) -> EdgeRef {
    let outline = &pattern.pieces[&piece].outline;
    let found = outline.iter().position(|e| e.label.as_deref() == Some(label));
    EdgeRef { piece, edge: found.unwrap_or_else(|| panic!("no edge {label} in {piece}")) }
}

/// Sews two edges, with both fronts on one side.
pub fn sew(pattern: &mut Pattern, a: (PieceId, &str), b: (PieceId, &str)) {
    let sides = [edge(pattern, a.0, a.1), edge(pattern, b.0, b.1)];
    pattern.add_seam(Seam::of_edges(sides, false));
}

/// Length of the edge of `piece` called `label`, metres.
pub fn edge_length(piece: &Piece, label: &str) -> f64 {
    let found = piece.outline.iter().position(|e| e.label.as_deref() == Some(label));
    found.map_or(0.0, |i| piece.edge_length(i))
}

/// Placement of a piece upright beside the body: its origin at `at`, its outer side rotated by `turn` radians from +z towards +x.
pub fn standing(at: DVec3, turn: f64) -> SpacePose {
    SpacePose::flat(at, DQuat::from_rotation_y(turn))
}

/// `piece` placed on the table with the lower left corner of its bounding box at `corner`.
pub fn laid(mut piece: Piece, corner: DVec2) -> Piece {
    let outline = piece.flattened(1e-3);
    let lower = outline.iter().copied().reduce(DVec2::min).unwrap_or_default();
    piece.pose = PlanePose { offset: corner - lower, rotation: 0.0, flipped: false };
    piece
}

/// Width and height of the bounding box of a piece's outline, metres.
pub fn extent(piece: &Piece) -> DVec2 {
    let outline = piece.flattened(1e-3);
    let lower = outline.iter().copied().reduce(DVec2::min).unwrap_or_default();
    let upper = outline.iter().copied().reduce(DVec2::max).unwrap_or_default();
    upper - lower
}

/// Lays pieces out in rows, left to right, 4 cm apart, rows from top to bottom; the top left corner is at the origin.
pub fn sheet(rows: Vec<Vec<Piece>>) -> Vec<Piece> {
    const GAP: f64 = 0.04;
    let mut top = 0.0;
    let mut all = Vec::new();
    for row in rows {
        let height = row.iter().map(|p| extent(p).y).fold(0.0, f64::max);
        let mut left = 0.0;
        for piece in row {
            let size = extent(&piece);
            all.push(laid(piece, DVec2::new(left, top - size.y)));
            left += size.x + GAP;
        }
        top -= height + GAP;
    }
    all
}

/// Seam allowance of the samples, metres.
const ALLOWANCE: f64 = 0.01;

/// Completes a pattern for cutting and editing: grainlines, allowances, seams that keep their length ratios.
pub fn finish(pattern: &mut Pattern) {
    for piece in pattern.pieces.values_mut() {
        let piece = Arc::make_mut(piece);
        let outline = piece.flattened(1e-3);
        let lower = outline.iter().copied().reduce(DVec2::min).unwrap_or_default();
        let upper = outline.iter().copied().reduce(DVec2::max).unwrap_or_default();
        let (middle, half) = ((lower + upper) / 2.0, (upper - lower) * 0.3);
        piece.grainline = Some([middle - half * DVec2::Y, middle + half * DVec2::Y]);
        piece.allowance = ALLOWANCE;
    }
    pattern.keep_ratios();
}
