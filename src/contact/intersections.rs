//! Self-intersections of cloth, where two layers have run a little way into one another: between the legs, in
//! armpits, in folds; and directions that resolve them.

use glam::DVec3;

use crate::cloth::{ClothState, Garment};
use crate::contact::pockets::pockets;
use crate::geometry::crossings::self_crossings;
use crate::geometry::mesh::TriMesh;

/// The self-intersections of a garment.
#[derive(Clone, Debug)]
pub struct Intersections {
    /// Mesh of the triangles that are placed.
    pub mesh: TriMesh,
    /// Pairs of an edge of the garment and the triangle of `mesh` that it intersects.
    pub places: Vec<[u32; 2]>,
}

impl Intersections {
    /// Finds the self-intersections of `garment`.
    pub fn new(garment: &Garment, state: &ClothState) -> Self {
        let laid = |vs: &[u32]| vs.iter().all(|&v| state.mapped[v as usize]);
        let triangles = garment.triangles.iter().copied().filter(|vs| laid(vs)).collect();
        let mesh = TriMesh { positions: state.positions.clone(), triangles };
        let numbers: Vec<u32> =
            (0u32..).zip(&garment.adjacency.edges).filter(|(_, e)| laid(*e)).map(|(e, _)| e).collect();
        let edges: Vec<[u32; 2]> = numbers.iter().map(|&e| garment.adjacency.edges[e as usize]).collect();
        let mut places = self_crossings(&mesh, &edges, &mesh.tree());
        places.iter_mut().for_each(|place| place[0] = numbers[place[0] as usize]);
        Self { mesh, places }
    }

    /// For each vertex the direction in which to move it so that layers separate: at most of length 1, zero where
    /// there is nothing to do.
    ///
    /// It shortens the intersection contours (Volino and Magnenat-Thalmann, Resolving surface collisions through
    /// intersection contour minimization, 2006). That needs no memory of which layer came from where: contours end at
    /// borders or are closed, and shrink from there.
    pub fn ways(&self, garment: &Garment, state: &ClothState) -> Vec<DVec3> {
        let mut ways = vec![DVec3::ZERO; state.positions.len()];
        let at = |v: u32| state.positions[v as usize];
        for &[e, t] in &self.places {
            let [a, b] = garment.adjacency.edges[e as usize];
            let along = (at(b) - at(a)).normalize_or_zero();
            let normal = {
                let [p, q, r] = self.mesh.corners(t as usize);
                (q - p).cross(r - p).normalize_or_zero()
            };
            let mut way = DVec3::ZERO;
            for &beside in garment.adjacency.edge_triangles.of(e) {
                let vs = garment.triangles[beside as usize];
                if !vs.iter().all(|&v| state.mapped[v as usize]) {
                    continue;
                }
                let third = vs.iter().copied().find(|v| *v != a && *v != b).unwrap_or(a);
                let inward = at(third) - at(a);
                let inward = inward - along * inward.dot(along);
                // Along the intersection of the two triangles, into the triangle beside the edge.
                let line = normal.cross(along.cross(inward)).normalize_or_zero();
                let line = if line.dot(inward) < 0.0 { -line } else { line };
                // The sine of the angle between edge and triangle. The way out of a triangle that it hardly meets would be long.
                let slope = along.dot(normal);
                let slope = slope.abs().max(0.1).copysign(slope);
                way += line - normal * (2.0 * line.dot(along) / slope);
            }
            let way = way.clamp_length_max(1.0);
            [a, b].iter().for_each(|&v| ways[v as usize] += way);
            self.mesh.triangles[t as usize].iter().for_each(|&v| ways[v as usize] -= way);
        }
        ways.iter_mut().for_each(|way| *way = way.clamp_length_max(1.0));
        ways
    }

    /// Directions as from [`Intersections::ways`], but whole parts of the cloth on the wrong side of other cloth move
    /// out along their normals and take the vertices round them along. Also returns whether there are such parts.
    pub fn ways_out(&self, garment: &Garment, state: &ClothState) -> (Vec<DVec3>, bool) {
        let mut ways = self.ways(garment, state);
        if self.places.is_empty() {
            return (ways, false);
        }
        let mut crossed = vec![false; garment.adjacency.edges.len()];
        self.places.iter().for_each(|place| crossed[place[0] as usize] = true);
        let deep = pockets(garment, &self.mesh, &crossed);
        for (way, (&more, normal)) in ways.iter_mut().zip(deep.iter().zip(self.mesh.vertex_normals())) {
            if more != 0 {
                *way = normal * -f64::from(more);
            }
        }
        let mut drawn: Vec<bool> = deep.iter().map(|&more| more != 0).collect();
        let any = drawn.contains(&true);
        // The rings of vertices round the deep ones take over the direction of the ring before, each less.
        for share in [0.9, 0.7, 0.4] {
            draw_along(garment, &mut ways, &mut drawn, share);
        }
        (ways, any)
    }
}

/// Vertices beside those that are `drawn` take over the mean of their directions times `share`, and are `drawn` then.
fn draw_along(garment: &Garment, ways: &mut [DVec3], drawn: &mut [bool], share: f64) {
    let mut more = Vec::new();
    for v in (0..ways.len()).filter(|&v| !drawn[v]) {
        let beside = garment.adjacency.vertex_neighbours.of(v as u32).iter().map(|&w| w as usize);
        let (sum, count) =
            beside.filter(|&w| drawn[w]).fold((DVec3::ZERO, 0), |(sum, count), w| (sum + ways[w], count + 1));
        if count > 0 {
            more.push((v, sum * (share / f64::from(count))));
        }
    }
    for (v, way) in more {
        (ways[v], drawn[v]) = (way, true);
    }
}
