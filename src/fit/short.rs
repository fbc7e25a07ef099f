//! Seams that are closed only because the cloth beside them is stretched (paper B, "sewability").

use std::collections::BTreeMap;

use glam::{DMat2, DVec2};

use crate::cloth::{ClothState, FlatPiece, Garment};
use crate::geometry::ids::{PieceId, SeamId};

/// Stretch beside a seam below which the seam counts as fitting.
const FITS: f64 = 0.05;
/// Smallest missing length that is reported, metres: no tailor lets a seam out by less.
const LEAST: f64 = 5e-3;
/// Stretch below which the search for the missing length ends: nothing pulls there.
const SLACK: f64 = 0.01;
/// Distance between two samples of the stretch, metres.
const STEP: f64 = 0.005;
/// Largest distance from the seam at which the stretch is sampled, metres.
const FAR: f64 = 1.5;

/// A seam that is closed only under tension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShortSeam {
    /// Id of the seam.
    pub seam: SeamId,
    /// Largest stretch beside the seam: for each vertex, that of the edges round it which are longer than flat.
    pub stretch: f64,
    /// Missing length, metres: the elongation of the cloth perpendicular to the seam on both sides, up to where the cloth is
    /// slack, at the vertex where that is largest. It estimates how far the seam would open.
    pub missing: f64,
}

/// The seams that are closed only under tension, in the garment's order.
pub fn short_seams(garment: &Garment, state: &ClothState) -> Vec<ShortSeam> {
    let beside = stretch_round(garment, state);
    let mut pieces = BTreeMap::new();
    let mut found: Vec<ShortSeam> = Vec::new();
    // A seam along runs of several edges is sewn in parts, which follow each other.
    for (seam, pairs) in &garment.seam_pairs {
        for (i, pair) in pairs.iter().enumerate() {
            let stretch = beside.get(&garment.corners[pair[0] as usize].vertex).copied().unwrap_or(0.0);
            if stretch <= FITS {
                continue;
            }
            let missing =
                [0, 1].map(|side| longer_across(garment, state, (pairs, i, side), &mut pieces)).iter().sum();
            match found.last_mut().filter(|known| known.seam == *seam) {
                Some(known) => {
                    known.stretch = known.stretch.max(stretch);
                    known.missing = known.missing.max(missing);
                }
                None => found.push(ShortSeam { seam: *seam, stretch, missing }),
            }
        }
    }
    found.retain(|short| short.missing > LEAST);
    found
}

/// Stretch at each vertex on a seam: of the edges of the triangles round it that are longer than flat, together.
fn stretch_round(garment: &Garment, state: &ClothState) -> BTreeMap<u32, f64> {
    let on_seams = garment.seam_pairs.iter().flat_map(|(_, pairs)| pairs);
    // Sums of flat lengths and of elongations of those edges, metres.
    let mut sums: BTreeMap<u32, [f64; 2]> =
        on_seams.map(|pair| (garment.corners[pair[0] as usize].vertex, [0.0; 2])).collect();
    for (vs, corners) in garment.triangles.iter().zip(&garment.triangle_corners) {
        if !lies(state, vs) || !vs.iter().any(|v| sums.contains_key(v)) {
            continue;
        }
        let mut of_edges = [0.0; 2];
        for (k, j) in [(0, 1), (1, 2), (2, 0)] {
            let flat = |k: usize| garment.corners[corners[k] as usize].uv;
            let now = state.positions[vs[k] as usize].distance(state.positions[vs[j] as usize]);
            let length = flat(k).distance(flat(j));
            if now > length {
                of_edges = [of_edges[0] + length, of_edges[1] + now - length];
            }
        }
        for v in vs {
            if let Some(sum) = sums.get_mut(v) {
                *sum = [sum[0] + of_edges[0], sum[1] + of_edges[1]];
            }
        }
    }
    let stretch = |[length, longer]: [f64; 2]| if length > 0.0 { longer / length } else { 0.0 };
    sums.into_iter().map(|(v, sum)| (v, stretch(sum))).collect()
}

fn lies(state: &ClothState, vs: &[u32; 3]) -> bool {
    vs.iter().all(|&v| state.mapped.get(v as usize) == Some(&true))
}

/// Elongation of the cloth perpendicular to the seam, from corner `i` of its side `side` to where the cloth is slack, metres.
fn longer_across(
    garment: &Garment,
    state: &ClothState,
    (pairs, i, side): (&[[u32; 2]], usize, usize),
    pieces: &mut BTreeMap<PieceId, FlatPiece>,
) -> f64 {
    let corner = |i: usize| garment.corners[pairs[i][side] as usize];
    let here = corner(i);
    let beside = [i.saturating_sub(1), (i + 1).min(pairs.len() - 1)].map(corner);
    let ends = beside.map(|c| if c.piece == here.piece { c.uv } else { here.uv });
    let Some(along) = (ends[1] - ends[0]).try_normalize() else { return 0.0 };
    let piece = pieces.entry(here.piece).or_insert_with(|| FlatPiece::new(garment, here.piece));
    let stretch = |at: DVec2, way: DVec2| {
        let t = piece.inside(garment, at)?.triangle as usize;
        let vs = garment.triangles[t];
        lies(state, &vs).then(|| {
            let [p, q, r] = garment.triangle_corners[t].map(|c| garment.corners[c as usize].uv);
            let [a, b, c] = vs.map(|v| state.positions[v as usize]);
            let shares = DMat2::from_cols(q - p, r - p).inverse() * way;
            ((b - a) * shares.x + (c - a) * shares.y).length() - 1.0
        })
    };
    let across = |way: DVec2| -> f64 {
        let places = (0..(FAR / STEP) as u32).map(|k| here.uv + way * (STEP * (f64::from(k) + 0.5)));
        let stretches = places.map_while(|at| stretch(at, way));
        stretches.take_while(|stretch| *stretch > SLACK).map(|stretch| stretch * STEP).sum()
    };
    // One of the two directions leaves the piece at once.
    across(along.perp()).max(across(-along.perp()))
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::fit::maps::tests::{SIDE, sheets};

    fn short(place: impl Fn(DVec2) -> DVec3) -> Vec<ShortSeam> {
        let laid = sheets(0.03, place);
        short_seams(&laid.garment, &laid.state)
    }

    #[test]
    fn what_is_missing_is_what_the_cloth_across_is_longer() {
        assert_eq!(short(|p| p.extend(0.0)), []);
        assert_eq!(short(|p| (p * 1.02).extend(0.0)), []);
        let [found] = short(|p| (p * 1.1).extend(0.0))[..] else { panic!("one seam") };
        assert!((found.stretch - 0.1).abs() < 1e-9, "{found:?}");
        // Both sheets, but for what is less than a step.
        assert!((found.missing - 0.1 * 2.0 * SIDE).abs() < 0.1 * 2.0 * STEP, "{found:?}");
    }

    #[test]
    fn only_what_is_stretched_across_counts_as_far_as_it_is() {
        assert_eq!(short(|p| DVec3::new(p.x, p.y * 1.2, 0.0)), []);
        // Within 9 cm of the seam only.
        let near = |x: f64| x + 0.1 * (x - SIDE).clamp(-0.09, 0.09);
        let [found] = short(|p| DVec3::new(near(p.x), p.y, 0.0))[..] else { panic!("one seam") };
        assert!((found.missing - 0.1 * 0.18).abs() < 0.004, "{found:?}");
    }
}
