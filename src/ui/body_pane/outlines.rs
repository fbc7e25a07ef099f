//! Edges and seams of the pattern on the dressed cloth.

use glam::DVec2;

use super::Seen;
use super::hand::cloth_at;
use crate::drag::Ray;
use crate::geometry::ids::PieceId;
use crate::pattern::edit::nearest_on_edge;
use crate::pattern::{EdgeRef, Pattern, Stretch};
use crate::ui::selection::Item;

/// Largest distance of the pointer from an edge of the cloth, metres on a body 1.5 m tall.
const NEAR_EDGE: f64 = 0.02;

/// The edge of the dressed cloth under a ray.
pub fn edge_under(seen: &Seen<'_>, ray: Ray) -> Option<Item> {
    // While the cloth moves no edge is picked.
    let hit = cloth_at(seen, ray).filter(|_| !seen.working)?;
    let piece = seen.document.pattern.pieces.get(&hit.place.piece)?;
    let edges = (0..piece.edge_count()).map(|edge| {
        let (_, distance) = nearest_on_edge(piece, edge, hit.place.at);
        (EdgeRef { piece: hit.place.piece, edge }, distance)
    });
    let (edge, distance) = edges.min_by(|a, b| a.1.total_cmp(&b.1))?;
    (distance <= NEAR_EDGE * seen.body.map_or(1.0, |b| b.scale())).then_some(Item::Edge(edge))
}

/// The polylines of edges and seams, each in its piece's own plane.
pub fn outlines(pattern: &Pattern, items: &[Item]) -> Vec<(PieceId, Vec<DVec2>)> {
    let at: Vec<f64> = (0..=48).map(|i| f64::from(i) / 48.0).collect();
    let line = |side: Stretch| {
        let piece = pattern.pieces.get(&side.piece)?;
        Some((side.piece, side.points(piece, &at)?))
    };
    let sides = |item: &Item| match item {
        Item::Edge(EdgeRef { piece, edge }) => vec![Stretch::edge(*piece, *edge)],
        Item::Seam(seam) => pattern.seams.get(seam).map(|s| s.sides.to_vec()).unwrap_or_default(),
        Item::Point(_) | Item::Piece(_) | Item::Line(_) | Item::LinePoint(_) => Vec::new(),
    };
    items.iter().flat_map(sides).filter_map(line).collect()
}
