//! Flattened outlines and fills of pieces, cached until a piece changes.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DVec2;

use crate::geometry::ids::PieceId;
use crate::geometry::polygon::{is_inside, sides, signed_area};
use crate::io::allowance_line;
use crate::pattern::piece::flattened_loop;
use crate::pattern::{Pattern, Piece, curve};

/// Flattening tolerance, metres.
const TOLERANCE: f64 = 4e-4;

/// The flattened shape of a piece, in its own plane.
#[derive(Clone, Debug)]
pub struct PieceShape {
    piece: Arc<Piece>,
    /// A number that changes whenever the outline changes.
    pub version: u64,
    /// The outline as a closed polyline.
    pub outline: Vec<DVec2>,
    /// The holes as closed polylines.
    pub holes: Vec<Vec<DVec2>>,
    /// A polyline for each edge, from its start to its end.
    pub edges: Vec<Vec<DVec2>>,
    /// Arc length of each edge, metres.
    pub lengths: Vec<f64>,
    /// A polyline for each internal line.
    pub lines: Vec<Vec<DVec2>>,
    /// Position of each notch, and the direction into the cloth.
    pub notches: Vec<(DVec2, DVec2)>,
    /// The cut line as a closed polyline; empty without allowance.
    pub cut: Vec<DVec2>,
    /// The interior as trapezoids, four corners each.
    pub fill: Vec<[DVec2; 4]>,
    /// A position for the name, on the cloth.
    pub middle: DVec2,
    /// Bounding box: lower and upper corner.
    pub bounds: [DVec2; 2],
    /// Whether the outline runs counter-clockwise seen from the front.
    pub drawn_from_front: bool,
}

impl PieceShape {
    fn new(piece: &Arc<Piece>, version: u64) -> Self {
        let outline = piece.flattened(TOLERANCE);
        let holes: Vec<Vec<DVec2>> = piece.holes.iter().map(|hole| flattened_loop(hole, TOLERANCE)).collect();
        let fill = trapezoids(std::iter::once(&outline).chain(&holes));
        let drawn_from_front = signed_area(&outline) >= 0.0;
        let edges: Vec<Vec<DVec2>> = (0..piece.edge_count()).map(|i| flat_edge(piece, i)).collect();
        let bound = |start, pick: fn(DVec2, DVec2) -> DVec2| outline.iter().copied().fold(start, pick);
        Self {
            piece: Arc::clone(piece),
            version,
            middle: middle(&fill),
            bounds: [bound(DVec2::INFINITY, DVec2::min), bound(DVec2::NEG_INFINITY, DVec2::max)],
            lengths: (0..piece.edge_count()).map(|i| piece.edge_length(i)).collect(),
            lines: piece.lines.iter().map(|line| line.flattened(TOLERANCE)).collect(),
            notches: notches(piece),
            cut: cut_line(piece),
            drawn_from_front,
            edges,
            fill,
            outline,
            holes,
        }
    }

    /// Whether `p`, in the piece's own plane, is on the cloth.
    pub fn contains(&self, p: DVec2) -> bool {
        let lines = std::iter::once(&self.outline).chain(&self.holes);
        is_inside(lines.flat_map(|line| sides(line)), p)
    }

    /// The four corners of the bounding box.
    pub fn corners(&self) -> [DVec2; 4] {
        let [a, b] = self.bounds;
        [a, DVec2::new(b.x, a.y), b, DVec2::new(a.x, b.y)]
    }
}

fn flat_edge(piece: &Piece, i: usize) -> Vec<DVec2> {
    let (a, b) = piece.edge_ends(i);
    let mut points = Vec::new();
    curve::flatten(a, piece.edge(i).shape, b, TOLERANCE, &mut points);
    points.push(b);
    points
}

fn notches(piece: &Piece) -> Vec<(DVec2, DVec2)> {
    let place = |edge: usize, at: f64| {
        let near = [at - 1e-3, at, at + 1e-3].map(|f| f.clamp(0.0, 1.0));
        let p = piece.edge_points(edge, &near);
        let along = (p[2] - p[0]).normalize_or_zero();
        // Cloth is on the left of a line that runs counter-clockwise around it.
        (p[1], along.perp() * if cloth_is_left(piece, edge) { 1.0 } else { -1.0 })
    };
    let known = piece.notches.iter().filter(|n| n.edge < piece.edge_count());
    known.map(|n| place(n.edge, n.at)).collect()
}

/// Whether the cloth is on the left of an edge, in its own direction.
pub fn cloth_is_left(piece: &Piece, edge: usize) -> bool {
    let (line, _) = piece.loop_of(edge);
    let turns_left = signed_area(&flattened_loop(piece.loop_edges(line), TOLERANCE * 10.0)) >= 0.0;
    turns_left == (line == 0)
}

/// The cut line of a piece: the one from a file, or the edge of its allowance; empty without allowance.
fn cut_line(piece: &Piece) -> Vec<DVec2> {
    match &piece.cut_line[..] {
        [] if piece.allowance <= 0.0 => Vec::new(),
        [] => allowance_line(piece, TOLERANCE),
        line => flattened_loop(line, TOLERANCE),
    }
}

/// Cache of the shapes of the pattern that was drawn last.
#[derive(Clone, Debug, Default)]
pub struct Shapes {
    shapes: BTreeMap<PieceId, PieceShape>,
    made: u64,
}

impl Shapes {
    /// Updates the shapes of pieces that changed.
    pub fn update(&mut self, pattern: &Pattern) {
        self.shapes.retain(|id, shape| {
            pattern
                .pieces
                .get(id)
                .is_some_and(|p| Arc::ptr_eq(p, &shape.piece) || same_outline(p, &shape.piece))
        });
        for (&id, piece) in &pattern.pieces {
            self.shapes.entry(id).or_insert_with(|| {
                self.made += 1;
                PieceShape::new(piece, self.made)
            });
        }
    }

    /// The shape of a piece.
    pub fn of(&self, id: PieceId) -> Option<&PieceShape> {
        self.shapes.get(&id)
    }

    /// The topmost piece at a point of the table, and the point in its own plane.
    pub fn at(&self, pattern: &Pattern, table: DVec2) -> Option<(PieceId, DVec2)> {
        self.all_at(pattern, table).next()
    }

    /// All pieces at a point of the table, topmost first, and the point in the plane of each.
    pub fn all_at(&self, pattern: &Pattern, table: DVec2) -> impl Iterator<Item = (PieceId, DVec2)> {
        pattern.pieces.iter().rev().filter_map(move |(&id, piece)| {
            if piece.hidden {
                return None;
            }
            let p = piece.pose.piece_from_plane(table);
            self.of(id)?.contains(p).then_some((id, p))
        })
    }
}

/// Whether two versions of a piece have the same shape; position and name do not matter.
fn same_outline(a: &Piece, b: &Piece) -> bool {
    a.outline == b.outline
        && a.holes == b.holes
        && a.lines == b.lines
        && a.notches == b.notches
        && a.allowance == b.allowance
        && a.cut_line == b.cut_line
}

/// The interior by the even-odd rule, divided into slabs at every corner. Outlines that cross themselves are filled correctly up
/// to the height of a slab.
pub fn trapezoids<'a>(lines: impl Iterator<Item = &'a Vec<DVec2>>) -> Vec<[DVec2; 4]> {
    let all: Vec<[DVec2; 2]> = lines.flat_map(|line| sides(line)).collect();
    let mut heights: Vec<f64> = all.iter().map(|[a, _]| a.y).filter(|y| y.is_finite()).collect();
    heights.sort_by(f64::total_cmp);
    heights.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    let mut out = Vec::new();
    for slab in heights.windows(2) {
        let (low, high) = (slab[0], slab[1]);
        let y = (low + high) / 2.0;
        let mut sides: Vec<[DVec2; 2]> =
            all.iter().copied().filter(|[a, b]| (a.y > y) != (b.y > y)).collect();
        let x_at = |[a, b]: [DVec2; 2], y: f64| a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
        sides.sort_by(|&s, &t| x_at(s, y).total_cmp(&x_at(t, y)));
        for pair in sides.chunks_exact(2) {
            let corner = |side, y| DVec2::new(x_at(side, y), y);
            out.push([
                corner(pair[0], low),
                corner(pair[1], low),
                corner(pair[1], high),
                corner(pair[0], high),
            ]);
        }
    }
    out
}

/// The centre of the widest trapezoid near half the height, so that a name there is on cloth.
pub fn middle(fill: &[[DVec2; 4]]) -> DVec2 {
    let mut total = 0.0;
    let mut weighted = DVec2::ZERO;
    for t in fill {
        let area = ((t[1].x - t[0].x) + (t[2].x - t[3].x)) / 2.0 * (t[3].y - t[0].y);
        total += area;
        weighted += area * (t[0] + t[1] + t[2] + t[3]) / 4.0;
    }
    let centre = if total > 0.0 { weighted / total } else { DVec2::ZERO };
    let inside = |t: &[DVec2; 4]| t[0].y <= centre.y && centre.y <= t[3].y;
    let width = |t: &[DVec2; 4]| t[1].x - t[0].x;
    match fill.iter().filter(|t| inside(t)).max_by(|a, b| width(a).total_cmp(&width(b))) {
        Some(t) => DVec2::new(centre.x.clamp(t[0].x.min(t[3].x), t[1].x.max(t[2].x)), centre.y),
        None => centre,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pattern_of(points: &[[f64; 2]]) -> (Pattern, PieceId) {
        let mut pattern = Pattern::default();
        let points: Vec<DVec2> = points.iter().map(|&p| DVec2::from(p)).collect();
        let id = pattern.add_piece(Piece::polygon("p", &points));
        (pattern, id)
    }

    #[test]
    fn the_fill_has_the_area_of_the_piece() {
        // An L: not convex.
        let (pattern, id) =
            pattern_of(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]]);
        let mut shapes = Shapes::default();
        shapes.update(&pattern);
        let shape = shapes.of(id).expect("a shape");
        let filled: f64 = shape
            .fill
            .iter()
            .map(|t| ((t[1].x - t[0].x) + (t[2].x - t[3].x)) / 2.0 * (t[3].y - t[0].y))
            .sum();
        assert!((filled - 3.0).abs() < 1e-9, "{filled}");
        assert!(shape.contains(shape.middle));
        assert!(shape.contains(DVec2::new(0.5, 1.5)) && !shape.contains(DVec2::new(1.5, 1.5)));
        assert!(shape.drawn_from_front);
    }

    #[test]
    fn the_piece_under_the_pointer_is_found_in_its_pose() {
        let (mut pattern, id) = pattern_of(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
        let piece = Arc::make_mut(pattern.pieces.get_mut(&id).expect("the piece"));
        piece.pose.offset = DVec2::new(5.0, 0.0);
        piece.pose.flipped = true;
        let mut shapes = Shapes::default();
        shapes.update(&pattern);
        let (found, p) = shapes.at(&pattern, DVec2::new(4.8, 0.1)).expect("a hit");
        assert_eq!(found, id);
        assert!((p - DVec2::new(0.2, 0.1)).length() < 1e-12);
        assert!(shapes.at(&pattern, DVec2::new(5.2, 0.1)).is_none());
    }
}
