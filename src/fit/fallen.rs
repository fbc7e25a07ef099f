//! Garments that did not stay where they were put on: a strap slipped off, nothing held a waistband.

use crate::cloth::{ClothState, Garment};
use crate::fit::measured::groups;
use crate::pattern::Pattern;

/// Cloth whose uppermost point lies so much lower than that of its pieces as they were placed has fallen down, metres.
const FALLEN: f64 = 0.2;

/// Pieces that are sewn together and lie lower than they were placed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fallen {
    /// The uppermost of them as placed, by its number in the garment's list.
    pub piece: usize,
    /// By how much, metres.
    pub by: f64,
}

/// What has fallen down of a garment that was sewn from where `pattern` places its pieces.
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
