//! Sleeves and legs: tubes that grow round limbs.
//!
//! Cloth that continues the planes of the cloth before it leaves an armhole in the direction of the trunk's cloth there: upward under
//! the arm, outward on top. Its flaps may then miss the arm. Laid along the limb inside the seam, it is a tube round it from the start.

use std::collections::BTreeMap;

use glam::DVec3;

use crate::body::Surface;
use crate::cloth::{ClothState, Garment};
use crate::geometry::adjacency::NONE;
use crate::geometry::ids::PieceId;
use crate::wrap::order::Order;
use crate::wrap::tube::Tube;

/// The tubes of a garment. A tube is connected within its tier, such as a sleeve.
#[derive(Clone, Debug, Default)]
pub struct Limbs {
    /// For each triangle the part it belongs to: one within its tier.
    part: Vec<u32>,
    /// Where the vertices of tubes go, metres.
    places: BTreeMap<u32, DVec3>,
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
        let of = |piece: &PieceId| part_of.get(piece).copied().unwrap_or(u32::MAX);
        Self { part: garment.triangle_pieces.iter().map(of).collect(), places: BTreeMap::new() }
    }

    /// Finds, before a tier grows in `order`, where the tubes go that grow from seams round limbs, at least `offset` metres off the skin.
    pub fn begin(
        &mut self,
        garment: &Garment,
        surface: &Surface,
        state: &ClothState,
        order: &Order,
        offset: f64,
    ) {
        let laid = |t: usize| garment.triangles[t].iter().all(|&v| state.mapped[v as usize]);
        let mut rings: BTreeMap<u32, Vec<[u32; 2]>> = BTreeMap::new();
        for (t, vs) in garment.triangles.iter().enumerate().filter(|&(t, _)| laid(t)) {
            for (k, &beyond) in garment.adjacency.across[t].iter().enumerate() {
                if beyond != NONE && !laid(beyond as usize) {
                    // Seen from the tube, its border runs the opposite way to that of the laid cloth.
                    rings.entry(self.part[beyond as usize]).or_default().push([vs[(k + 1) % 3], vs[k]]);
                }
            }
        }
        self.places.clear();
        for (part, ring) in rings {
            let of_part = |&t: &u32| self.part[t as usize] == part && !laid(t as usize);
            let triangles = (0..garment.triangles.len() as u32).filter(of_part).collect();
            let Some(tube) = Tube::new(garment, triangles, &ring) else { continue };
            self.places.extend(tube.places(surface, state, &order.distance, offset).into_iter().flatten());
        }
    }

    /// Where `vertex` goes, if it belongs to a tube, metres.
    pub fn place(&self, vertex: u32) -> Option<DVec3> {
        self.places.get(&vertex).copied()
    }
}
