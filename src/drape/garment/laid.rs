//! The draped part of a garment as a net of springs.

use std::collections::BTreeMap;

use glam::DVec2;

use crate::cloth::{Fabric, Garment};
use crate::drape::sheet::Sheet;
use crate::drape::solver::net::Spring;

/// The vertices of the triangles `laid` in breadth-first order, so that neighbours are near in memory, and the inverse map: index
/// in that order by garment vertex, `u32::MAX` for the others.
pub(in crate::drape) fn ordered(garment: &Garment, laid: &[usize]) -> (Vec<u32>, Vec<u32>) {
    let mut is_laid = vec![false; garment.vertex_count];
    laid.iter().flat_map(|&t| garment.triangles[t]).for_each(|v| is_laid[v as usize] = true);
    let mut own = vec![u32::MAX; garment.vertex_count];
    let mut vertices: Vec<u32> = Vec::new();
    for start in 0..garment.vertex_count as u32 {
        if !is_laid[start as usize] || own[start as usize] != u32::MAX {
            continue;
        }
        own[start as usize] = vertices.len() as u32;
        vertices.push(start);
        let mut at = vertices.len() - 1;
        while at < vertices.len() {
            for &w in garment.adjacency.vertex_neighbours.of(vertices[at]) {
                if is_laid[w as usize] && own[w as usize] == u32::MAX {
                    own[w as usize] = vertices.len() as u32;
                    vertices.push(w);
                }
            }
            at += 1;
        }
    }
    (vertices, own)
}

/// Rest length of each edge by its sorted vertices, metres. Along a gathered seam it is the length of the shorter side: the
/// longer side has no extra vertices there, so it cannot fold between two of them.
pub(in crate::drape) fn shortest_sides(garment: &Garment) -> BTreeMap<[u32; 2], f64> {
    let mut sides = BTreeMap::new();
    for (vs, rest) in garment.triangles.iter().zip(&garment.rest) {
        for k in 0..3 {
            let l = (k + 1) % 3;
            let ends = [vs[k].min(vs[l]), vs[k].max(vs[l])];
            let length = rest[k].distance(rest[l]);
            sides.entry(ends).and_modify(|known: &mut f64| *known = known.min(length)).or_insert(length);
        }
    }
    sides
}

/// A spring along each edge: Young's modulus in its direction times its share of the area (Van Gelder 1998).
pub(in crate::drape) fn springs<'a>(
    sheet: &'a Sheet,
    fabrics: &'a [&Fabric],
    length: impl Fn([u32; 2]) -> Option<f64> + 'a,
) -> impl Iterator<Item = Spring> + 'a {
    let adjacency = &sheet.adjacency;
    adjacency.edges.iter().enumerate().map(move |(e, &ends)| {
        let length = length(ends).unwrap_or_else(|| sheet.rest_length(e));
        let beside = adjacency.edge_triangles.of(e as u32);
        let stiffness = |&t: &u32| {
            let t = t as usize;
            let k = adjacency.triangle_edges[t].iter().position(|&x| x == e as u32).unwrap_or(0);
            let along = (sheet.rest[t][(k + 1) % 3] - sheet.rest[t][k]).normalize_or_zero();
            modulus(fabrics[t], along) * sheet.areas[t]
        };
        let stiffness = beside.iter().map(stiffness).sum::<f64>() / (length * length);
        Spring { ends, length, stiffness }
    })
}

/// Young's modulus times thickness along `along` (x weft, y warp; unit) of an orthotropic sheet, N/m.
fn modulus(fabric: &Fabric, along: DVec2) -> f64 {
    let stretch = &fabric.stretch;
    let (w, f) = (along.y * along.y, along.x * along.x);
    let mixed = 1.0 / stretch.shear - 2.0 * stretch.poisson / (stretch.warp * stretch.weft).sqrt();
    1.0 / (w * w / stretch.warp + f * f / stretch.weft + w * f * mixed)
}
