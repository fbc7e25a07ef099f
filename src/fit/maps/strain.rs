//! Strain of triangles and seams.

use std::collections::BTreeMap;

use glam::{DMat2, DVec2, DVec3};
use rayon::prelude::*;

use crate::fit::maps::{MapKind, Worn, laid_corners};
use crate::geometry::ids::PieceId;
use crate::geometry::parallel::LEAST_SHARE;

/// A triangle whose area is less than this share of its longest side squared has no strain.
const FLAT: f64 = 1e-9;
/// Edges shorter than this (metres) have no strain.
const SHORTEST: f64 = 1e-9;

/// Images of the unit vectors along and across the grain under the deformation gradient of a triangle.
pub(super) type Images = [DVec3; 2];

/// Strain of each triangle with these `images`: warp, weft, shear or area. With F the deformation gradient from the flat plane to
/// space, and w and f unit vectors along and across the grain, these are |F w| - 1, |F f| - 1, a right angle minus the angle between
/// F w and F f, and |F w x F f| - 1.
pub(super) fn strain(kind: MapKind, images: &[Option<Images>]) -> Vec<f64> {
    let strain = |[warp, weft]: Images| match kind {
        MapKind::Warp => warp.length() - 1.0,
        MapKind::Weft => weft.length() - 1.0,
        MapKind::Shear => warp.dot(weft).atan2(warp.cross(weft).length()),
        _ => warp.cross(weft).length() - 1.0,
    };
    let each = images.par_iter().with_min_len(LEAST_SHARE);
    each.map(|images| images.map_or(f64::NAN, strain)).collect()
}

/// The images of each triangle; None where it is not laid or has no flat area.
pub(super) fn all_images(worn: Worn<'_>) -> Vec<Option<Images>> {
    let grain = grain(worn);
    let of_triangle = |t: usize| {
        let along = grain.get(&worn.garment.triangle_pieces[t]).copied().unwrap_or(DVec2::Y);
        laid_corners(worn, t).and_then(|corners| images(worn, t, corners, along))
    };
    (0..worn.garment.triangles.len()).into_par_iter().with_min_len(LEAST_SHARE).map(of_triangle).collect()
}

/// Warp direction of each piece in its plane, unit vector.
pub(super) fn grain(worn: Worn<'_>) -> BTreeMap<PieceId, DVec2> {
    worn.pattern.pieces.iter().map(|(&id, piece)| (id, piece.grain())).collect()
}

/// The images of triangle `t` with these corners; `along` is the direction of the grain in its flat plane.
fn images(worn: Worn<'_>, t: usize, [a, b, c]: [DVec3; 3], along: DVec2) -> Option<Images> {
    let (_, slopes) = flat(worn, t, along)?;
    Some(slopes.map(|slope| (b - a) * slope.y + (c - a) * slope.z))
}

/// Flat area of a triangle, m², and the gradients of its corners' linear shape functions along and across the grain, 1/m. None
/// where it has no area.
pub(super) fn flat(worn: Worn<'_>, t: usize, along: DVec2) -> Option<(f64, [DVec3; 2])> {
    let [p, q, r] = worn.garment.triangle_corners[t].map(|corner| worn.garment.corners[corner as usize].uv);
    let flat = DMat2::from_cols(q - p, r - p);
    let size = (q - p).length_squared().max((r - p).length_squared());
    if flat.determinant().abs() <= FLAT * size {
        return None;
    }
    let back = flat.inverse();
    let slopes = |way: DVec2| {
        let rise = back * way;
        DVec3::new(-(rise.x + rise.y), rise.x, rise.y)
    };
    Some((flat.determinant().abs() / 2.0, [slopes(along), slopes(along.perp())]))
}

/// Strain along seams, at their vertices: of the edges on both sides together. NaN off seams.
pub(super) fn seams(worn: Worn<'_>) -> Vec<f64> {
    let garment = worn.garment;
    let mut lengths = vec![[0.0; 2]; garment.vertex_count];
    let laid = |v: u32| worn.state.mapped.get(v as usize) == Some(&true);
    for pairs in garment.seam_pairs.iter().flat_map(|(_, pairs)| pairs.windows(2)) {
        let sides = [0, 1].map(|side| [pairs[0][side], pairs[1][side]].map(|c| garment.corners[c as usize]));
        // Two parts of one seam can follow each other in the list without touching.
        if sides.iter().any(|[a, b]| a.piece != b.piece || !laid(a.vertex) || !laid(b.vertex)) {
            continue;
        }
        let [a, b] = sides[0].map(|c| c.vertex);
        if !garment.adjacency.vertex_neighbours.of(a).contains(&b) {
            continue;
        }
        let flat = sides.iter().map(|[a, b]| a.uv.distance(b.uv)).sum::<f64>() / 2.0;
        let length = worn.state.positions[a as usize].distance(worn.state.positions[b as usize]);
        for v in [a, b] {
            let [sum, flats] = &mut lengths[v as usize];
            (*sum, *flats) = (*sum + length, *flats + flat);
        }
    }
    lengths
        .into_iter()
        .map(|[length, flat]| if flat > SHORTEST { length / flat - 1.0 } else { f64::NAN })
        .collect()
}
