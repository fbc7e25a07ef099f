//! Edges, seams and internal lines of the pattern on the dressed cloth.

use glam::DVec2;

use super::Seen;
use super::hand::cloth_at;
use crate::drag::Ray;
use crate::geometry::ids::PieceId;
use crate::geometry::polygon::{is_inside, sides};
use crate::pattern::edit::nearest_on_edge;
use crate::pattern::piece::flattened_loop;
use crate::pattern::{EdgeRef, Pattern, Piece, Stretch};
use crate::ui::selection::{Item, LineRef};

/// Largest distance of the pointer from an edge of the cloth, metres on a body 1.5 m tall.
const NEAR_EDGE: f64 = 0.02;
/// Largest distance between the points of a line that lies on the cloth, metres.
const STEP: f64 = 0.005;
/// Largest number of points added between two points of a line.
const MOST_BETWEEN: f64 = 1000.0;
/// Largest distance of a polyline from the curve that it stands for, metres.
const TOLERANCE: f64 = 5e-4;

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

/// The polylines of edges, seams and internal lines, each in its piece's own plane.
pub fn outlines(pattern: &Pattern, items: &[Item]) -> Vec<(PieceId, Vec<DVec2>)> {
    let at: Vec<f64> = (0..=48).map(|i| f64::from(i) / 48.0).collect();
    let stretch = |side: Stretch| {
        let piece = pattern.pieces.get(&side.piece)?;
        Some((side.piece, side.points(piece, &at)?))
    };
    let inside = |LineRef { piece: id, line }: LineRef| {
        let piece = pattern.pieces.get(&id)?;
        Some((id, on_cloth(piece, &piece.lines.get(line)?.flattened(TOLERANCE))))
    };
    let found = |item: &Item| match item {
        Item::Edge(EdgeRef { piece, edge }) => vec![stretch(Stretch::edge(*piece, *edge))],
        Item::Seam(seam) => {
            let sides = pattern.seams.get(seam).map(|seam| seam.sides.map(stretch).to_vec());
            sides.unwrap_or_default()
        }
        Item::Line(line) => vec![inside(*line)],
        Item::Point(_) | Item::Piece(_) | Item::LinePoint(_) => Vec::new(),
    };
    items.iter().flat_map(found).flatten().collect()
}

/// A polyline in the plane of `piece` with further points between its own, so that it lies on bent cloth. Of these only such as
/// are on the piece: across a gap in it the line is straight in space.
pub fn on_cloth(piece: &Piece, points: &[DVec2]) -> Vec<DVec2> {
    let outline = std::iter::once(piece.flattened(TOLERANCE));
    let border: Vec<Vec<DVec2>> =
        outline.chain(piece.holes.iter().map(|hole| flattened_loop(hole, TOLERANCE))).collect();
    let is_on = |p: &DVec2| is_inside(border.iter().flat_map(|line| sides(line)), *p);
    let mut found = Vec::new();
    for ends in points.windows(2) {
        let (from, to) = (ends[0], ends[1]);
        let count = (from.distance(to) / STEP).ceil().clamp(1.0, MOST_BETWEEN) as u32;
        let between = (1..count).map(|i| from.lerp(to, f64::from(i) / f64::from(count)));
        found.push(from);
        found.extend(between.filter(is_on));
    }
    found.extend(points.last());
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::{Edge, InternalLine};

    /// A "U": the gap between its arms is 0.2 m wide.
    fn u() -> Piece {
        let corners = [(0.0, 0.0), (0.4, 0.0), (0.4, 0.4), (0.3, 0.4), (0.3, 0.1), (0.1, 0.1), (0.1, 0.4)];
        let corners: Vec<DVec2> = corners.into_iter().chain([(0.0, 0.4)]).map(DVec2::from).collect();
        Piece::polygon("U", &corners)
    }

    #[test]
    fn a_line_has_points_all_along_but_none_in_a_gap_of_its_piece() {
        let ends = [DVec2::new(0.05, 0.3), DVec2::new(0.35, 0.3)];
        let found = on_cloth(&u(), &ends);
        assert_eq!([found[0], found[found.len() - 1]], ends);
        assert!(found.iter().all(|p| p.x < 0.1 + 1e-9 || p.x > 0.3 - 1e-9), "{found:?}");
        let steps: Vec<f64> = found.windows(2).map(|w| w[0].distance(w[1])).collect();
        let wide = steps.iter().filter(|step| **step > STEP + 1e-9).count();
        assert_eq!((wide, steps.len() > 15), (1, true), "{steps:?}");
        assert_eq!(on_cloth(&u(), &ends[..1]), ends[..1]);
        assert_eq!(on_cloth(&u(), &[]), []);
    }

    #[test]
    fn selected_lines_are_shown_and_those_that_are_gone_are_not() {
        let edges = vec![Edge { start: DVec2::new(0.05, 0.05), ..Edge::default() }];
        let line = InternalLine { edges, end: DVec2::new(0.35, 0.05), ..InternalLine::default() };
        let mut pattern = Pattern::default();
        let piece = pattern.add_piece(Piece { lines: vec![line], ..u() });
        let shown = |line| outlines(&pattern, &[Item::Line(LineRef { piece, line })]);
        let found = shown(0);
        assert_eq!((found.len(), found[0].0), (1, piece));
        let length: f64 = found[0].1.windows(2).map(|w| w[0].distance(w[1])).sum();
        assert!((length - 0.3).abs() < 1e-9, "{length}");
        assert_eq!(shown(1), []);
    }
}
