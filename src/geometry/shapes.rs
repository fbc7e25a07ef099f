//! Plain bodies whose answers are known exactly, for benches and tests.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::geometry::mesh::TriMesh;

/// A closed cylinder about y of `radius` and `height` metres, standing on y = 0, with flat lids.
pub fn cylinder(radius: f64, height: f64, round: u32, rows: u32) -> TriMesh {
    let mut mesh = TriMesh::default();
    for row in 0..=rows {
        for i in 0..round {
            let (sin, cos) = (f64::from(i) / f64::from(round) * TAU).sin_cos();
            let y = height * f64::from(row) / f64::from(rows);
            mesh.positions.push(DVec3::new(radius * sin, y, radius * cos));
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
        let (j, top) = ((i + 1) % round, rows * round);
        mesh.triangles.extend([[bottom, j, i], [bottom + 1, top + i, top + j]]);
    }
    mesh
}
