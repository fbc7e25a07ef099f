//! Growth of sleeves and legs along their limbs.
//!
//! Cloth that continues the planes of the cloth before it leaves an armhole in the direction of the trunk's cloth there:
//! upward under the arm, outward on top. Guided along the limb inside the seam, it becomes a tube round the limb.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use crate::body::Surface;
use crate::body::measure::section;
use crate::cloth::{ClothState, Garment};
use crate::geometry::adjacency::NONE;
use crate::geometry::ids::PieceId;
use crate::geometry::polygon::{centroid, sides};
use crate::wrap::order::Order;

/// Directions of growth for each part. A part is connected within its tier: a sleeve, or both legs of trousers.
#[derive(Clone, Debug, Default)]
pub struct Limbs {
    /// For each vertex the part it belongs to.
    part: Vec<u32>,
    axes: BTreeMap<u32, Axis>,
}

/// Where on its limb a part has grown to: a point on the axis of the limb and the direction of growth.
#[derive(Clone, Copy, Debug)]
struct Axis {
    at: DVec3,
    /// Direction of growth, a unit vector away from the trunk.
    along: DVec3,
}

impl Limbs {
    /// The parts of `garment`, which grows in `order`.
    pub fn new(garment: &Garment, order: &Order) -> Self {
        let mut part_of: BTreeMap<PieceId, u32> =
            garment.pieces.iter().zip(0..).map(|(&(id, _), part)| (id, part)).collect();
        for (_, pairs) in &garment.seam_pairs {
            let Some(&[a, b]) = pairs.first() else { continue };
            let (a, b) = (garment.corners[a as usize].piece, garment.corners[b as usize].piece);
            if order.piece_tier.get(&a) == order.piece_tier.get(&b) {
                let (low, high) = (part_of[&a].min(part_of[&b]), part_of[&a].max(part_of[&b]));
                part_of.values_mut().filter(|part| **part == high).for_each(|part| *part = low);
            }
        }
        let mut part = vec![u32::MAX; garment.vertex_count];
        for (vs, piece) in garment.triangles.iter().zip(&garment.triangle_pieces) {
            let tier = order.piece_tier.get(piece).copied();
            for &v in vs.iter().filter(|&&v| order.tier[v as usize] == tier) {
                part[v as usize] = part_of[piece];
            }
        }
        Self { part, axes: BTreeMap::new() }
    }

    /// Finds, before a tier grows, the limbs that the seams from which it grows go round.
    pub fn begin(&mut self, garment: &Garment, surface: &Surface, state: &ClothState) {
        let laid = |t: usize| garment.triangles[t].iter().all(|&v| state.mapped[v as usize]);
        let mut rings: BTreeMap<u32, (DVec3, DVec3, f64)> = BTreeMap::new();
        for (t, vs) in garment.triangles.iter().enumerate().filter(|&(t, _)| laid(t)) {
            for k in 0..3 {
                let beyond = garment.adjacency.across[t][k];
                if beyond == NONE || laid(beyond as usize) {
                    continue;
                }
                let Some(&new) =
                    garment.triangles[beyond as usize].iter().find(|&&v| !state.mapped[v as usize])
                else {
                    continue;
                };
                let (a, b) = (state.positions[vs[k] as usize], state.positions[vs[(k + 1) % 3] as usize]);
                let ring = rings.entry(self.part[new as usize]).or_default();
                // Seen from outside, the border of the hole runs the opposite way to that of the cloth.
                ring.0 += b.cross(a);
                ring.1 += (a + b) * 0.5;
                ring.2 += 1.0;
            }
        }
        self.axes = rings
            .into_iter()
            .filter_map(|(part, (area, sum, count))| {
                let along = area.try_normalize()?;
                Some((part, Axis { at: limb_centre(surface, sum / count, along)?, along }))
            })
            .collect();
    }

    /// Moves the axes of all parts on by `step` metres along their limbs.
    pub fn advance(&mut self, surface: &Surface, step: f64) {
        for axis in self.axes.values_mut() {
            let ahead = axis.at + axis.along * step;
            let centre = limb_centre(surface, ahead, axis.along).unwrap_or(ahead);
            axis.along = (centre - axis.at).try_normalize().unwrap_or(axis.along);
            axis.at = centre;
        }
    }

    /// Direction of growth at `vertex`, a unit vector; None when its part goes round no limb.
    pub fn along(&self, vertex: u32) -> Option<DVec3> {
        self.axes.get(self.part.get(vertex as usize)?).map(|axis| axis.along)
    }
}

/// Centre of the part of the body's section through `at`, perpendicular to `along`, that encloses `at`; None when no part does.
fn limb_centre(surface: &Surface, at: DVec3, along: DVec3) -> Option<DVec3> {
    let (x, y) = along.any_orthonormal_pair();
    let flat = |p: &DVec3| DVec2::new((*p - at).dot(x), (*p - at).dot(y));
    section(&surface.mesh, at, along)
        .iter()
        .map(|points| points.iter().map(flat).collect::<Vec<DVec2>>())
        .filter(|points| holds_origin(points))
        .filter_map(|points| centroid(&points))
        .min_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))
        .map(|c| at + x * c.x + y * c.y)
}

fn holds_origin(points: &[DVec2]) -> bool {
    let crosses =
        |[a, b]: [DVec2; 2]| (a.y > 0.0) != (b.y > 0.0) && a.x - a.y * (b.x - a.x) / (b.y - a.y) > 0.0;
    sides(points).filter(|&side| crosses(side)).count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_of_a_section_is_that_of_its_area() {
        let square = [(-1.0, -1.0), (3.0, -1.0), (3.0, 1.0), (-1.0, 1.0)].map(DVec2::from);
        assert!(holds_origin(&square));
        assert!((centroid(&square).expect("an area") - DVec2::X).length() < 1e-12);
        assert!(!holds_origin(&square.map(|p| p + DVec2::X * 2.0)));
        assert_eq!(centroid(&[DVec2::ZERO; 3]), None);
    }
}
