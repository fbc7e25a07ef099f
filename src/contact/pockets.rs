//! Winding number test for parts of the cloth that have run into other parts: one trouser leg into the other, a
//! sleeve into the side, a fold through the layer behind.
//!
//! With its openings closed, cloth has winding number 1 about what it encloses. At a point of the cloth itself it is
//! between 0 and 1, depending on how sharply it is folded there. Where a part is inside another part it is larger by
//! 1, and where it has come out through another, smaller by 1. So the way out is known at any depth, which neither
//! nearby pairs nor contours that shrink (see [`intersections`](crate::contact::intersections)) can tell.

use std::collections::VecDeque;

use glam::DVec3;

use crate::cloth::Garment;
use crate::geometry::borders::border_loops;
use crate::geometry::mesh::TriMesh;
use crate::geometry::winding::Winding;

/// Tolerance of the winding number beyond its possible range. Chosen by trial: openings are closed by fans, and rounding adds to
/// that.
const CERTAIN: f64 = 0.03;

/// For each vertex 1 where its part of the cloth is inside other cloth, -1 where it has come out through other cloth,
/// 0 where all is well, or nothing is known. `mesh` holds the placed triangles of `garment`; `crossed` tells for each
/// edge of the garment whether it intersects other cloth of it.
pub fn pockets(garment: &Garment, mesh: &TriMesh, crossed: &[bool]) -> Vec<i8> {
    let part = parts(garment, mesh);
    let mut deep = vec![0; garment.vertex_count];
    let mut asked = vec![false; garment.vertex_count];
    let ends = |e: usize| garment.adjacency.edges[e];
    for first in 0..crossed.len() {
        let [a, _] = ends(first);
        if !crossed[first] || asked[a as usize] {
            continue;
        }
        let whole = part[a as usize];
        let closed = closed(mesh, |v| part[v as usize] == whole);
        let winding = Winding::new(&closed);
        let usual = usual(&winding, mesh, |v| part[v as usize] == whole);
        let own = (0..crossed.len()).filter(|&e| crossed[e] && part[ends(e)[0] as usize] == whole);
        let mut open: VecDeque<u32> = own.flat_map(ends).collect();
        while let Some(v) = open.pop_front() {
            if std::mem::replace(&mut asked[v as usize], true) {
                continue;
            }
            let winds = winding.at(mesh.positions[v as usize]) - usual;
            let more = i8::from(winds > 1.0 + CERTAIN) - i8::from(winds < -CERTAIN);
            if more != 0 {
                deep[v as usize] = more;
                open.extend(
                    garment.adjacency.vertex_neighbours.of(v).iter().filter(|&&w| part[w as usize] == whole),
                );
            }
        }
    }
    under(garment, mesh, crossed, &part, &mut deep);
    deep
}

/// Marks as -1 (to move outward) vertices of a higher layer that are inside what a lower layer encloses, openings included.
fn under(garment: &Garment, mesh: &TriMesh, crossed: &[bool], part: &[u32], deep: &mut [i8]) {
    if garment.layers.is_empty() {
        return;
    }
    let layers = layers(garment);
    let mut inner: Vec<u32> = part.iter().copied().filter(|&p| p != u32::MAX).collect();
    inner.sort_unstable();
    inner.dedup();
    for whole in inner {
        let layer = layers[whole as usize];
        let over = |v: u32| part[v as usize] != u32::MAX && layers[v as usize] > layer;
        let ends = garment.adjacency.edges.iter().zip(crossed).filter(|(_, crossed)| **crossed);
        let mut open: VecDeque<u32> = ends.flat_map(|(ends, _)| *ends).filter(|&v| over(v)).collect();
        if open.is_empty() {
            continue;
        }
        let closed = closed(mesh, |v| part[v as usize] == whole);
        let winding = Winding::new(&closed);
        if usual(&winding, mesh, |v| part[v as usize] == whole) != 0.0 {
            continue; // It is inside out.
        }
        let mut asked = vec![false; part.len()];
        while let Some(v) = open.pop_front() {
            if !std::mem::replace(&mut asked[v as usize], true)
                && winding.contains(mesh.positions[v as usize])
            {
                deep[v as usize] = -1;
                open.extend(garment.adjacency.vertex_neighbours.of(v).iter().filter(|&&w| over(w)));
            }
        }
    }
}

/// The layer of each vertex.
fn layers(garment: &Garment) -> Vec<u8> {
    let mut layers = vec![0; garment.vertex_count];
    for (vs, &piece) in garment.triangles.iter().zip(&garment.triangle_pieces) {
        vs.iter().for_each(|&v| layers[v as usize] = garment.layer(piece));
    }
    layers
}

/// The usual winding number just on one side of the cloth: the median over at most fifteen of its points,
/// rounded down: most of them are not in a pocket.
fn usual(winding: &Winding<'_>, mesh: &TriMesh, chosen: impl Fn(u32) -> bool) -> f64 {
    let own: Vec<u32> = (0..mesh.positions.len() as u32).filter(|&v| chosen(v)).collect();
    let count = own.len().min(15);
    let at = |k: usize| winding.at(mesh.positions[own[k * own.len() / count] as usize]).floor();
    let mut found: Vec<f64> = (0..count).map(at).collect();
    found.sort_by(f64::total_cmp);
    found.get(count / 2).copied().unwrap_or_default()
}

/// The triangles whose vertices are `chosen`, with a fan that closes each border.
fn closed(mesh: &TriMesh, chosen: impl Fn(u32) -> bool) -> TriMesh {
    let triangles = mesh.triangles.iter().copied().filter(|vs| chosen(vs[0])).collect();
    let mut closed = TriMesh { positions: mesh.positions.clone(), triangles };
    for border in border_loops(&closed) {
        let middle = closed.positions.len() as u32;
        let sum: DVec3 = border.iter().map(|&v| mesh.positions[v as usize]).sum();
        closed.positions.push(sum / border.len() as f64);
        let next = border.iter().cycle().skip(1);
        closed.triangles.extend(border.iter().zip(next).map(|(&a, &b)| [b, a, middle]));
    }
    closed
}

/// For each vertex the first vertex of its connected component; `u32::MAX` for vertices that are not placed.
fn parts(garment: &Garment, mesh: &TriMesh) -> Vec<u32> {
    let mut laid = vec![false; garment.vertex_count];
    mesh.triangles.iter().flatten().for_each(|&v| laid[v as usize] = true);
    let mut part = vec![u32::MAX; garment.vertex_count];
    for start in (0..garment.vertex_count as u32).filter(|&v| laid[v as usize]) {
        let mut open = vec![start];
        while let Some(v) = open.pop() {
            if part[v as usize] == u32::MAX && laid[v as usize] {
                part[v as usize] = start;
                open.extend(garment.adjacency.vertex_neighbours.of(v));
            }
        }
    }
    part
}
