//! Simple bodies with known exact answers, for benches and tests.

use std::collections::BTreeMap;
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

/// A sphere of `radius` metres about the origin: an icosahedron whose triangles are split in four `cuts` times.
pub fn icosphere(radius: f64, cuts: u32) -> TriMesh {
    let golden = (1.0 + 5f64.sqrt()) / 2.0;
    let mut positions: Vec<DVec3> = Vec::new();
    for (a, b) in [(1.0, golden), (-1.0, golden), (1.0, -golden), (-1.0, -golden)] {
        positions.extend([DVec3::new(a, b, 0.0), DVec3::new(0.0, a, b), DVec3::new(b, 0.0, a)]);
    }
    // Three corners at the least distance from each other form a triangle; its front is outside.
    let near = |a: usize, b: usize| positions[a].distance_squared(positions[b]) < 4.1;
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    for (a, b, c) in (0..12).flat_map(|a| (a + 1..12).flat_map(move |b| (b + 1..12).map(move |c| (a, b, c))))
    {
        if near(a, b) && near(b, c) && near(c, a) {
            let outside = positions[a].dot(positions[b].cross(positions[c])) > 0.0;
            let corners = if outside { [a, b, c] } else { [a, c, b] };
            triangles.push(corners.map(|v| v as u32));
        }
    }
    for _ in 0..cuts {
        let mut middles: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                positions.push((positions[a as usize] + positions[b as usize]) / 2.0);
                positions.len() as u32 - 1
            })
        };
        let cut = |[a, b, c]: [u32; 3]| {
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        triangles = triangles.into_iter().flat_map(cut).collect();
    }
    positions.iter_mut().for_each(|x| *x = x.normalize() * radius);
    TriMesh { positions, triangles }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_icosphere_is_a_closed_ball() {
        let ball = icosphere(0.3, 3);
        assert_eq!((ball.triangles.len(), ball.positions.len()), (1280, 642));
        let whole = 2.0 / 3.0 * TAU * 0.3f64.powi(3);
        assert!((ball.volume() / whole - 1.0).abs() < 0.01, "{} of {whole}", ball.volume());
    }
}
