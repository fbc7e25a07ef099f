//! Detection of garments that slid off: a strap slipped, nothing held a waistband.

use crate::cloth::{ClothState, Garment};
use crate::fit::measured::groups;
use crate::pattern::Pattern;

/// Drop of the highest point of sewn pieces, compared with their placement, above which they count as fallen, metres.
const FALLEN: f64 = 0.2;

/// A group of sewn pieces that has slid down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fallen {
    /// Index, in the garment's list, of the piece that was placed highest.
    pub piece: usize,
    /// How far its highest point has dropped, metres.
    pub by: f64,
}

/// The groups of pieces that have fallen, for a garment sewn from the placement in `pattern`.
pub fn fallen(pattern: &Pattern, garment: &Garment, state: &ClothState) -> Vec<Fallen> {
    let groups = groups(pattern);
    let mut roots: Vec<_> = groups.values().copied().collect();
    roots.sort_unstable();
    roots.dedup();
    let of_group = |root| {
        let (mut placed, mut lies) = ((f64::MIN, None), f64::MIN);
        for corner in garment.corners.iter().filter(|c| groups.get(&c.piece) == Some(&root)) {
            let pose = pattern.pieces.get(&corner.piece)?.placement?;
            let v = corner.vertex as usize;
            if !state.mapped.get(v).is_some_and(|mapped| *mapped) {
                return None;
            }
            let height = pose.at(corner.uv).y;
            if height > placed.0 {
                placed = (height, garment.pieces.iter().position(|(id, _)| *id == corner.piece));
            }
            lies = lies.max(state.positions[v].y);
        }
        let by = placed.0 - lies;
        placed.1.filter(|_| by > FALLEN).map(|piece| Fallen { piece, by })
    };
    roots.into_iter().filter_map(of_group).collect()
}
