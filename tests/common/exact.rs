//! Garments with exact answers, for the suites.

use glam::{DVec2, DVec3};
use toile::body::Surface;
use toile::cloth::{ClothState, Garment};
pub use toile::fit::exact::{quantile, strains};
use toile::geometry::ids::MarkId;
pub use toile::geometry::shapes::cylinder;
use toile::pattern::{EdgeRef, Pattern, Piece, Seam};
use toile::wrap::{BodyMark, ClothMark, ClothSide, Marks};

/// Two rectangles of `width` × `height` metres sewn into a tube: the first is the front.
pub fn tube(width: f64, height: f64) -> Pattern {
    let mut pattern = Pattern::default();
    let rectangle = |name: &str| {
        Piece::polygon(
            name,
            &[DVec2::ZERO, DVec2::new(width, 0.0), DVec2::new(width, height), DVec2::new(0.0, height)],
        )
    };
    let front = pattern.add_piece(rectangle("front"));
    let back = pattern.add_piece(rectangle("back"));
    for (a, b) in [(1, 3), (3, 1)] {
        pattern.add_seam(Seam::of_edges(
            [EdgeRef { piece: front, edge: a }, EdgeRef { piece: back, edge: b }],
            false,
        ));
    }
    pattern
}

/// Vertical strokes down the middle of both pieces of a [`tube`], at the front (+z) and back of a cylinder.
pub fn tube_marks(pattern: &Pattern, width: f64, height: f64, radius: f64, low: f64) -> Marks {
    let mut marks = Marks::default();
    for (i, (&piece, z)) in pattern.pieces.keys().zip([radius, -radius]).enumerate() {
        let steps = 20;
        let flat = (0..=steps)
            .map(|k| DVec2::new(width / 2.0 + 1e-4, height * (0.05 + 0.9 * f64::from(k) / f64::from(steps))));
        let solid = (0..=steps)
            .map(|k| DVec3::new(0.0, low + height * (0.05 + 0.9 * f64::from(k) / f64::from(steps)), z));
        marks.cloth.push(ClothMark {
            id: MarkId(10 + i as u32),
            piece,
            side: ClothSide::Front,
            points: flat.collect(),
        });
        marks.body.push(BodyMark { id: MarkId(20 + i as u32), points: solid.collect() });
    }
    marks
}

/// Height of the lowest vertex above the skin, metres.
pub fn lowest(surface: &Surface, state: &ClothState) -> f64 {
    state.positions.iter().map(|&p| surface.nearest(p).distance).fold(f64::INFINITY, f64::min)
}

/// A [`tube`] laid exactly on a cylinder of `radius` metres (its own, not the body's), as much stretched round it as that
/// takes, with its lower edge at `low`.
pub fn rolled(garment: &Garment, width: f64, radius: f64, low: f64) -> ClothState {
    let mut state = ClothState {
        positions: vec![DVec3::ZERO; garment.vertex_count],
        mapped: vec![true; garment.vertex_count],
    };
    let front = garment.pieces[0].0;
    for corner in &garment.corners {
        let start = if corner.piece == front { 0.0 } else { std::f64::consts::PI };
        let angle = start + (corner.uv.x / width - 0.5) * std::f64::consts::PI;
        state.positions[corner.vertex as usize] =
            DVec3::new(radius * angle.sin(), low + corner.uv.y, radius * angle.cos());
    }
    state
}
