//! A tube on a cylinder: what it should be is known exactly.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use crate::cloth::{ClothState, Garment};
use crate::fit::exact::{excess, quantile, residual, strains};
use crate::geometry::ids::MarkId;
use crate::geometry::mesh::TriMesh;
use crate::geometry::shapes;
use crate::pattern::{EdgeRef, Pattern, Piece, Seam};
use crate::wrap::{BodyMark, ClothMark, ClothSide, Marks};

/// Of the cylinder, metres.
pub const RADIUS: f64 = 0.15;
/// The tube lies so far above it, metres.
pub const OFFSET: f64 = 0.004;
/// Of the cylinder; it stands on y = 0.
const BODY_HEIGHT: f64 = 1.0;
/// Of the tube.
const HEIGHT: f64 = 0.5;
/// Its lower edge on the cylinder.
const LOW: f64 = 0.25;
/// Flat sides of the cylinder: their chords are 2e-5 shorter than their arcs.
const SIDES: u32 = 512;
/// Rows of them.
const ROWS: u32 = 20;
/// Points of a stroke less one.
const STROKE: u32 = 20;

/// A front and a back sewn into a tube.
pub struct Tube {
    pub pattern: Pattern,
    pub marks: Marks,
    /// Of each of its two pieces, metres.
    width: f64,
}

impl Tube {
    /// `loose` times as long round as the cylinder it lies on.
    pub fn new(loose: f64) -> Self {
        let width = loose * PI * (RADIUS + OFFSET);
        let corners = [(0.0, 0.0), (width, 0.0), (width, HEIGHT), (0.0, HEIGHT)].map(DVec2::from);
        let mut pattern = Pattern::default();
        let [front, back] = ["front", "back"].map(|name| pattern.add_piece(Piece::polygon(name, &corners)));
        for (edge, other) in [(1, 3), (3, 1)] {
            let sides = [EdgeRef { piece: front, edge }, EdgeRef { piece: back, edge: other }];
            pattern.add_seam(Seam::of_edges(sides, false));
        }
        let mut marks = Marks::default();
        let heights = || (0..=STROKE).map(|k| HEIGHT * (0.05 + 0.9 * f64::from(k) / f64::from(STROKE)));
        for (i, (piece, z)) in [(front, RADIUS), (back, -RADIUS)].into_iter().enumerate() {
            let id = MarkId(1 + 2 * i as u32);
            let points = heights().map(|y| DVec2::new(width / 2.0, y)).collect();
            marks.cloth.push(ClothMark { id, piece, side: ClothSide::Front, points });
            let points = heights().map(|y| DVec3::new(0.0, LOW + y, z)).collect();
            marks.body.push(BodyMark { id: MarkId(id.0 + 1), points });
        }
        Self { pattern, marks, width }
    }

    /// The tube laid round the cylinder that it fits without strain.
    pub fn exact(&self, garment: &Garment) -> ClothState {
        let radius = self.width / PI;
        let mut state = ClothState {
            positions: vec![DVec3::ZERO; garment.vertex_count],
            mapped: vec![true; garment.vertex_count],
        };
        let front = garment.pieces.first().map(|(id, _)| *id);
        for corner in &garment.corners {
            let start = if Some(corner.piece) == front { 0.0 } else { PI };
            let angle = start + (corner.uv.x / self.width - 0.5) * PI;
            state.positions[corner.vertex as usize] =
                DVec3::new(radius * angle.sin(), LOW + corner.uv.y, radius * angle.cos());
        }
        state
    }
}

/// What the tubes are put on.
pub fn cylinder() -> TriMesh {
    shapes::cylinder(RADIUS, BODY_HEIGHT, SIDES, ROWS)
}

/// How far `state` is from the exact one.
#[derive(Clone, Copy, Debug)]
pub struct Errors {
    /// p99 of |l / l0 - 1| over the edges.
    pub strain: f64,
    /// The same of the exact state: its edges are chords.
    pub chords: f64,
    /// p99 of what edges are strained beyond that: one between its chord's strain and none is slack, not wrong.
    pub excess: f64,
    /// The farthest vertex from where it should be, but for a turn about the axis and a shift along it; metres.
    pub position: f64,
}

impl Errors {
    /// Of `state` against `exact`.
    pub fn new(garment: &Garment, state: &ClothState, exact: &ClothState) -> Self {
        let p99 = |strains: &[f64]| quantile(strains, 0.99);
        Self {
            strain: p99(&strains(garment, state)),
            chords: p99(&strains(garment, exact)),
            excess: p99(&excess(garment, state, exact)),
            position: residual(exact, state),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::Surface;
    use crate::cloth::build;

    #[test]
    fn the_exact_tube_has_the_strain_of_its_chords() {
        let tube = Tube::new(1.0);
        let (garment, problems) = build(&tube.pattern, 0.03);
        assert!(problems.is_empty(), "{problems:?}");
        let exact = tube.exact(&garment);
        let errors = Errors::new(&garment, &exact, &exact);
        assert_eq!((errors.excess, errors.position), (0.0, 0.0));
        // -s^2 / (24 R^2) of an edge s that runs level.
        let longest = 0.045f64;
        assert!(errors.chords > 0.0 && errors.chords < longest.powi(2) / (24.0 * RADIUS.powi(2)));
        let body = Surface::new(cylinder()).expect("a body");
        assert!(exact.positions.iter().all(|&p| (body.nearest(p).distance - OFFSET).abs() < 1e-5));
    }
}
