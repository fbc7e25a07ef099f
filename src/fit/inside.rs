//! Which vertices of the cloth are inside the body, with few winding numbers.

use rayon::prelude::*;

use crate::body::Surface;
use crate::fit::laid::Laid;
use crate::geometry::disjoint_sets::DisjointSets;
use crate::geometry::parallel::LEAST_SHARE;
use crate::geometry::winding::Winding;

/// Signed distance of each of the used vertices of `laid` from the body, metres, negative inside by winding number. Cloth comes into a
/// body only through its surface, so vertices are on the same side that are joined by edges that it does not cut (`is_cut`
/// tells for each edge): one winding number tells for all of them. Where the nearest skin says otherwise, as beside an edge that was
/// missed by rounding, in an open body, or between parts of one that intersect each other, a vertex gets a winding number of its own.
pub(super) fn signed_distances(
    laid: &Laid,
    (surface, winding): (&Surface, &Winding<'_>),
    is_cut: &[bool],
) -> Vec<f64> {
    let mut sides = DisjointSets::new(laid.mesh.positions.len());
    for (&[a, b], _) in laid.edges.iter().zip(is_cut).filter(|(_, is_cut)| !**is_cut) {
        sides.join(a, b);
    }
    let roots: Vec<u32> = laid.used.iter().map(|&v| sides.root(v)).collect();
    let place = |v: u32| laid.mesh.positions[v as usize];
    let mut is_inside = vec![false; laid.mesh.positions.len()];
    for (&v, _) in laid.used.iter().zip(&roots).filter(|(v, root)| v == root) {
        is_inside[v as usize] = winding.contains(place(v));
    }
    let distance = |(&v, root): (&u32, &u32)| {
        let near = surface.nearest(place(v));
        let inside = is_inside[*root as usize];
        let is_sure = inside == (near.distance < 0.0);
        let inside = if is_sure { inside } else { winding.contains(place(v)) };
        let distance = near.point.distance(place(v));
        if inside { -distance } else { distance }
    };
    laid.used.par_iter().zip(&roots).with_min_len(LEAST_SHARE).map(distance).collect()
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::*;
    use crate::cloth::{ClothState, build};
    use crate::geometry::crossings::meetings;
    use crate::geometry::mesh::TriMesh;
    use crate::geometry::random::Random;
    use crate::geometry::shapes::icosphere;
    use crate::pattern::{Pattern, Piece};

    /// Balls of 10 cm at these places along x, metres.
    fn balls(at: &[f64]) -> Surface {
        let mut mesh = TriMesh::default();
        for &x in at {
            let first = mesh.positions.len() as u32;
            let ball = icosphere(0.1, 3);
            mesh.positions.extend(ball.positions.iter().map(|p| *p + DVec3::X * x));
            mesh.triangles.extend(ball.triangles.iter().map(|vs| vs.map(|v| v + first)));
        }
        Surface::new(mesh).expect("a body")
    }

    /// Cloth that runs through a body whose two parts intersect each other, and through one of which no cut is known.
    #[test]
    fn every_vertex_is_on_the_side_that_its_winding_number_says() {
        let corners = [[-0.2, -0.2], [0.2, -0.2], [0.2, 0.2], [-0.2, 0.2]].map(DVec2::from);
        let mut pattern = Pattern::default();
        pattern.add_piece(Piece::polygon("sheet", &corners));
        let (garment, _) = build(&pattern, 0.015);
        let mut random = Random::stream(3, 0);
        let mut inside = 0;
        for (surface, knows_cuts) in [(balls(&[-0.06, 0.06]), true), (balls(&[0.0]), false)] {
            let winding = surface.winding();
            for _ in 0..10 {
                let (tilt, height) = (random.between(-1.0, 1.0), random.between(-0.12, 0.12));
                let mut positions = vec![DVec3::ZERO; garment.vertex_count];
                for corner in &garment.corners {
                    let DVec2 { x, y } = corner.uv;
                    let wave = 0.02 * (40.0 * x).sin();
                    positions[corner.vertex as usize] = DVec3::new(x, height + tilt * y + wave, y);
                }
                let state = ClothState { mapped: vec![true; positions.len()], positions };
                let laid = Laid::new(&garment, &state);
                let through = meetings(&laid.mesh.positions, &laid.edges, &surface.mesh, winding.tree());
                let mut known = vec![false; laid.edges.len()];
                through.iter().filter(|_| knows_cuts).for_each(|&[e, _]| known[e as usize] = true);
                for (&v, signed) in
                    laid.used.iter().zip(signed_distances(&laid, (&surface, &winding), &known))
                {
                    let p = laid.mesh.positions[v as usize];
                    assert_eq!(signed < 0.0, winding.contains(p), "{p:?}");
                    assert!((signed.abs() - surface.nearest(p).point.distance(p)).abs() < 1e-15);
                    inside += usize::from(signed < 0.0);
                }
            }
        }
        assert!(inside > 500, "{inside} vertices inside");
    }
}
