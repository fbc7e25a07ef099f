//! Isotropic remeshing of the skin after Botsch and Kobbelt 2004 ("A Remeshing Approach to Multiresolution Modeling",
//! section 4): split long edges, collapse short ones, even out valences by flips, relax along the surface. Departures: the
//! wanted length varies over the figure, and vertices are projected on to the implicit skin rather than on to an older mesh.

use glam::DVec3;
use rayon::prelude::*;

use super::editing::Editing;
use super::field::Field;
use crate::geometry::mesh::TriMesh;

/// Number of rounds of split, collapse, flip, relax.
const ROUNDS: usize = 8;

/// Remeshes `half` (open at x = 0) to edges about `wanted(point)` metres long, its vertices on the skin of `field`.
pub fn remeshed(half: TriMesh, field: &Field, wanted: impl Fn(DVec3) -> f64 + Sync) -> TriMesh {
    let mut mesh = Editing::new(half.positions, half.triangles);
    for round in 0..ROUNDS {
        let target = |m: &Editing, e: [u32; 2]| {
            wanted((m.positions[e[0] as usize] + m.positions[e[1] as usize]) / 2.0)
        };
        if round == 0 {
            // The first mesh is far too fine: coarsen it before smoothing it.
            collapse_short(&mut mesh, &target);
            mesh = mesh.compacted();
        } else {
            split_long(&mut mesh, &target);
        }
        collapse_short(&mut mesh, &target);
        for edge in mesh.edges() {
            mesh.turn_for_valence(edge);
        }
        mesh = mesh.compacted();
        let last = round + 1 == ROUNDS;
        for _ in 0..if last { 4 } else { 2 } {
            relax(&mut mesh, field, if last { 2 } else { 1 });
        }
    }
    TriMesh { positions: mesh.positions, triangles: mesh.triangles }
}

fn split_long(mesh: &mut Editing, target: &impl Fn(&Editing, [u32; 2]) -> f64) {
    for edge in mesh.edges() {
        if mesh.length(edge) > 4.0 / 3.0 * target(mesh, edge) {
            mesh.split(edge);
        }
    }
}

fn collapse_short(mesh: &mut Editing, target: &impl Fn(&Editing, [u32; 2]) -> f64) {
    for edge in mesh.edges() {
        // Earlier collapses may have taken this edge away or made it longer.
        let alive = edge.iter().all(|&v| !mesh.around[v as usize].is_empty());
        if alive && !mesh.across(edge).is_empty() {
            let wanted = target(mesh, edge);
            if mesh.length(edge) < 0.8 * wanted {
                mesh.collapse(edge, 4.0 / 3.0 * wanted);
            }
        }
    }
}

/// Tangential relaxation: moves every vertex towards the mean of its neighbours along the surface, and back on to the skin.
fn relax(mesh: &mut Editing, field: &Field, steps: usize) {
    let normals = crate::geometry::mesh::vertex_normals(&mesh.positions, &mesh.triangles);
    let moved: Vec<DVec3> = (0..mesh.positions.len())
        .into_par_iter()
        .map(|v| {
            let p = mesh.positions[v];
            let mut near = mesh.neighbours(v as u32);
            if mesh.rim[v] {
                near.retain(|w| mesh.rim[*w as usize]);
            }
            let middle = near.iter().map(|&w| mesh.positions[w as usize]).sum::<DVec3>() / near.len() as f64;
            let step = middle - p;
            let mut p = field.onto_skin(p + (step - normals[v] * step.dot(normals[v])) * 0.8, steps);
            if mesh.rim[v] {
                p.x = 0.0;
            }
            p
        })
        .collect();
    mesh.positions = moved;
}

/// Joins `half` and its mirror image in x = 0.
pub fn mirrored(half: &TriMesh) -> TriMesh {
    let mut positions = half.positions.clone();
    let twin: Vec<u32> = half
        .positions
        .iter()
        .enumerate()
        .map(|(v, p)| {
            if p.x == 0.0 {
                return v as u32;
            }
            positions.push(DVec3::new(-p.x, p.y, p.z));
            positions.len() as u32 - 1
        })
        .collect();
    let mut triangles = half.triangles.clone();
    triangles.extend(half.triangles.iter().map(|&[a, b, c]| [a, c, b].map(|v| twin[v as usize])));
    TriMesh { positions, triangles }
}

/// Whether the mesh is a topological sphere: closed (every edge joins just two triangles, which run along it in
/// opposite directions) and without handles (its Euler characteristic is two).
pub fn is_ball(mesh: &TriMesh) -> bool {
    let directed = |flip: bool| {
        let mut edges: Vec<[u32; 2]> = mesh
            .triangles
            .iter()
            .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
            .map(|[a, b]| if flip { [b, a] } else { [a, b] })
            .collect();
        edges.sort_unstable();
        edges
    };
    let forward = directed(false);
    let simple = mesh.positions.len() == mesh.triangles.len() / 2 + 2;
    simple && forward.windows(2).all(|w| w[0] != w[1]) && forward == directed(true)
}
