//! Bodies and garments with exact answers, for the suites.
#![allow(dead_code, reason = "each suite uses its own part")]

use glam::{DVec2, DVec3};
use toile::body::Surface;
use toile::cloth::{ClothState, Garment};
use toile::geometry::ids::MarkId;
use toile::geometry::mesh::TriMesh;
use toile::pattern::{EdgeRef, Pattern, Piece, Seam};
use toile::wrap::{BodyMark, ClothMark, ClothSide, Marks};

/// A closed cylinder about y of `radius` and `height` metres, standing on y = 0, with flat lids.
pub fn cylinder(radius: f64, height: f64, round: u32, rows: u32) -> TriMesh {
    let mut mesh = TriMesh::default();
    for row in 0..=rows {
        for i in 0..round {
            let a = f64::from(i) / f64::from(round) * std::f64::consts::TAU;
            let y = height * f64::from(row) / f64::from(rows);
            mesh.positions.push(DVec3::new(radius * a.sin(), y, radius * a.cos()));
        }
    }
    for row in 0..rows {
        for i in 0..round {
            let (a, b) = (row * round + i, row * round + (i + 1) % round);
            mesh.triangles.extend([[a, b, b + round], [a, b + round, a + round]]);
        }
    }
    let bottom = mesh.positions.len() as u32;
    mesh.positions.extend([DVec3::ZERO, DVec3::Y * height]);
    for i in 0..round {
        let j = (i + 1) % round;
        mesh.triangles.push([bottom, j, i]);
        let top = rows * round;
        mesh.triangles.push([bottom + 1, top + i, top + j]);
    }
    mesh
}

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
        pattern.add_seam(Seam {
            sides: [EdgeRef { piece: front, edge: a }, EdgeRef { piece: back, edge: b }],
            same_direction: false,
        });
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

/// Strain l / l0 - 1 of every edge of every triangle.
pub fn strains(garment: &Garment, state: &ClothState) -> Vec<f64> {
    let mut strains = Vec::new();
    for (vs, rest) in garment.triangles.iter().zip(&garment.rest) {
        for k in 0..3 {
            let j = (k + 1) % 3;
            let length = (state.positions[vs[j] as usize] - state.positions[vs[k] as usize]).length();
            strains.push(length / (rest[j] - rest[k]).length() - 1.0);
        }
    }
    strains
}

/// The `q`-quantile of absolute values.
pub fn quantile(values: &[f64], q: f64) -> f64 {
    let mut sorted: Vec<f64> = values.iter().map(|v| v.abs()).collect();
    sorted.sort_by(f64::total_cmp);
    sorted[((sorted.len() - 1) as f64 * q).round() as usize]
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
