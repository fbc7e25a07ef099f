//! The drawing of the pattern on the fit report, with the numbers of the seams.

use std::fmt::Write;

use glam::DVec2;
use maud::{Markup, html};

use crate::pattern::{Pattern, Piece};
use crate::ui::language::tr;

/// Flattening tolerance of curves, metres.
const TOLERANCE: f64 = 5e-4;
/// Height of the letters relative to the drawing's width: some 2.5 mm on A4.
const LETTERS: f64 = 0.0145;
/// Margin around the pieces, in heights of a letter.
const ROOM: f64 = 2.0;

/// SVG of every piece at its position in the pattern plane, with name, grainline and, at its edges, the numbers of its seams.
pub fn drawing(pattern: &Pattern) -> Markup {
    let shown = || pattern.pieces.values().filter(|piece| !piece.hidden);
    let corners: Vec<DVec2> = shown().flat_map(|piece| in_plane(piece, piece.flattened(TOLERANCE))).collect();
    let Some(&first) = corners.first() else { return html! {} };
    let (low, high) = corners.iter().fold((first, first), |(low, high), &p| (low.min(p), high.max(p)));
    let letters = LETTERS * (high.x - low.x).max(high.y - low.y).max(1e-3);
    let (low, high) = (low - DVec2::splat(ROOM * letters), high + DVec2::splat(ROOM * letters));
    // Converts to millimetres with y down.
    let at = |p: DVec2| DVec2::new(p.x - low.x, high.y - p.y) * 1e3;
    let size = (high - low) * 1e3;
    let letters = letters * 1e3;
    html! {
        svg.pattern viewBox=(format!("0 0 {:.0} {:.0}", size.x, size.y)) role="img" aria-label=(tr("The pattern"))
            font-size=(format!("{letters:.1}")) stroke-width=(format!("{:.2}", letters * 0.09)) {
            @for piece in shown() {
                path.piece d=(path(piece, at)) fill-rule="evenodd" {}
                @if let Some(grain) = piece.grainline {
                    @let [a, b] = grain.map(|p| at(piece.pose.plane_from_piece(p)));
                    line.grain x1=(mm(a.x)) y1=(mm(a.y)) x2=(mm(b.x)) y2=(mm(b.y)) {}
                }
                @let middle = at(middle(piece));
                text.name x=(mm(middle.x)) y=(mm(middle.y)) text-anchor="middle" { (piece.name) }
            }
            @for (id, seam) in &pattern.seams {
                @for p in seam.sides.iter().filter_map(|side| {
                    let piece = pattern.pieces.get(&side.piece).filter(|piece| !piece.hidden)?;
                    let middle = *side.points(piece, &[0.5])?.first()?;
                    Some(at(piece.pose.plane_from_piece(middle)))
                }) {
                    circle.seam cx=(mm(p.x)) cy=(mm(p.y)) r=(mm(letters * 0.85)) {}
                    text.seam x=(mm(p.x)) y=(mm(p.y + letters * 0.33)) text-anchor="middle" { (id.0) }
                }
            }
        }
    }
}

fn mm(length: f64) -> String {
    format!("{length:.1}")
}

fn in_plane(piece: &Piece, points: Vec<DVec2>) -> impl Iterator<Item = DVec2> {
    points.into_iter().map(|p| piece.pose.plane_from_piece(p))
}

/// SVG path of outline and holes.
fn path(piece: &Piece, at: impl Fn(DVec2) -> DVec2) -> String {
    let mut path = String::new();
    for edges in piece.loops() {
        for (i, p) in in_plane(piece, crate::pattern::piece::flattened_loop(edges, TOLERANCE)).enumerate() {
            let p = at(p);
            // Writing to a string cannot fail.
            write!(path, "{}{:.1} {:.1}", if i == 0 { "M" } else { "L" }, p.x, p.y).ok();
        }
        path.push('Z');
    }
    path
}

/// Centre of the piece's bounding box.
fn middle(piece: &Piece) -> DVec2 {
    let points: Vec<DVec2> = in_plane(piece, piece.flattened(TOLERANCE)).collect();
    let first = points.first().copied().unwrap_or_default();
    let (low, high) = points.iter().fold((first, first), |(low, high), &p| (low.min(p), high.max(p)));
    (low + high) / 2.0
}
