//! A tube on a cylinder, for which the exact solution is known.

use std::f64::consts::PI;

use glam::{DVec2, DVec3};

use crate::cloth::{ClothState, Garment};
use crate::fit::exact::{excess, quantile, residual, strains};
use crate::geometry::ids::MarkId;
use crate::geometry::mesh::TriMesh;
use crate::geometry::shapes;
use crate::pattern::{EdgeRef, Pattern, Piece, Seam};
use crate::wrap::{BodyMark, ClothMark, ClothSide, Marks};

/// Radius of the cylinder, metres.
pub const RADIUS: f64 = 0.15;
/// Offset of the tube from the cylinder, metres.
pub const OFFSET: f64 = 0.004;
/// Height of the cylinder, metres; its base is at y = 0.
const BODY_HEIGHT: f64 = 1.0;
/// Height of the tube, metres.
const HEIGHT: f64 = 0.5;
/// Height of the tube's lower edge on the cylinder, metres.
const LOW: f64 = 0.25;
/// Number of flat sides of the cylinder; their middles are nearer to its axis than the radius by a fraction of 2e-5.
const SIDES: u32 = 512;
/// Number of rows of sides along the cylinder's height.
const ROWS: u32 = 20;
/// Number of segments of a mark's stroke.
const STROKE: u32 = 20;

/// A front and a back piece sewn into a tube, with marks.
pub struct Tube {
    pub pattern: Pattern,
    pub marks: Marks,
    /// Width of each of the two pieces, metres.
    width: f64,
}

impl Tube {
    /// A tube whose circumference is `loose` times that of the cylinder at the offset.
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

    /// The exact solution: the tube as a round cylinder without strain, with its radius given by the width of its pieces.
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

/// The cylinder that the tubes are put on.
pub fn cylinder() -> TriMesh {
    shapes::cylinder(RADIUS, BODY_HEIGHT, SIDES, ROWS)
}

/// Errors of a state of the tube compared with the exact solution.
#[derive(Clone, Copy, Debug)]
pub struct Errors {
    /// 99th percentile of the edges' strain |l / l0 - 1|.
    pub strain: f64,
    /// 99th percentile of the same strain in the exact solution, where edges are chords of the cylinder.
    pub chords: f64,
    /// 99th percentile of the strain in excess of the exact solution's. An edge whose strain is between that of its chord and
    /// zero is slack and has no excess.
    pub excess: f64,
    /// Largest distance of a vertex from the exact solution, up to a rotation about the axis and a shift along it, metres.
    pub position: f64,
}

impl Errors {
    /// The errors of `state` compared with `exact`.
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
