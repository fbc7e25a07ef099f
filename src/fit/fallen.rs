//! Detection of garments that slid off: a strap slipped, nothing held a waistband.

use crate::cloth::{ClothState, Corner, Garment};
use crate::fit::measured::groups;
use crate::geometry::ids::PieceId;
use crate::pattern::Pattern;

/// Drop of the highest point of sewn pieces, compared with their placement, above which they count as fallen, metres.
const FALLEN: f64 = 0.2;

/// A group of sewn pieces that has slid down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fallen {
    /// Index, in the garment's list, of the piece that was highest.
    pub piece: usize,
    /// How far its highest point has dropped, metres.
    pub by: f64,
}

/// The groups of pieces that have fallen, for a garment sewn from the placement in `pattern`.
pub fn fallen(pattern: &Pattern, garment: &Garment, state: &ClothState) -> Vec<Fallen> {
    let placed = |corner: &Corner, _| Some(pattern.pieces.get(&corner.piece)?.placement?.at(corner.uv).y);
    lower_than(pattern, garment, state, placed)
}

/// The groups of pieces that have fallen since their highest points were at these heights, metres, one for each piece of `garment`.
pub fn fallen_from(tops: &[f64], pattern: &Pattern, garment: &Garment, state: &ClothState) -> Vec<Fallen> {
    lower_than(pattern, garment, state, |_, piece| tops.get(piece).copied())
}

/// Height of the highest point of each piece of `garment`, metres; that of a piece that is not laid is negative infinity.
pub fn tops(garment: &Garment, state: &ClothState) -> Vec<f64> {
    let of_piece = |(id, _): &(PieceId, String)| {
        let own = garment.corners.iter().filter(|c| c.piece == *id && state.mapped[c.vertex as usize]);
        own.map(|c| state.positions[c.vertex as usize].y).fold(f64::NEG_INFINITY, f64::max)
    };
    garment.pieces.iter().map(of_piece).collect()
}

/// The groups whose highest points are much lower than the highest before: `height` gives that of a corner, or of the piece of that
/// index.
fn lower_than(
    pattern: &Pattern,
    garment: &Garment,
    state: &ClothState,
    height: impl Fn(&Corner, usize) -> Option<f64>,
) -> Vec<Fallen> {
    let groups = groups(pattern);
    let mut roots: Vec<_> = groups.values().copied().collect();
    roots.sort_unstable();
    roots.dedup();
    let of_group = |root| {
        let (mut before, mut lies) = ((f64::MIN, None), f64::MIN);
        for corner in garment.corners.iter().filter(|c| groups.get(&c.piece) == Some(&root)) {
            let piece = garment.pieces.iter().position(|(id, _)| *id == corner.piece)?;
            let v = corner.vertex as usize;
            if !state.mapped.get(v).is_some_and(|mapped| *mapped) {
                return None;
            }
            let height = height(corner, piece)?;
            if height > before.0 {
                before = (height, Some(piece));
            }
            lies = lies.max(state.positions[v].y);
        }
        let by = before.0 - lies;
        before.1.filter(|_| by > FALLEN).map(|piece| Fallen { piece, by })
    };
    roots.into_iter().filter_map(of_group).collect()
}
