//! Measurements of each seam: its sides, gather, stretch and gap.

use serde::Serialize;

use crate::cloth::{ClothState, Garment};
use crate::fit::measured::{CLOSED, widest_gap};
use crate::geometry::ids::SeamId;
use crate::pattern::{Pattern, Seam};

/// A seam of a dressed garment. Lengths in metres.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SeamFit {
    /// Id of the seam.
    pub seam: SeamId,
    /// Piece and first edge (from 1) of each side.
    pub sides: [(String, usize); 2],
    /// Length of each side in the pattern; None for a side that does not exist.
    pub flat: [Option<f64>; 2],
    /// Length on the body; None where the seam is not laid.
    pub worn: Option<f64>,
    /// Largest distance between two points sewn together; None where the seam could not be sewn.
    pub gap: Option<f64>,
}

impl SeamFit {
    /// Every seam of `pattern`, in id order.
    pub fn all(pattern: &Pattern, garment: &Garment, state: &ClothState) -> Vec<Self> {
        pattern.seams.iter().map(|(&id, seam)| Self::of(id, seam, pattern, garment, state)).collect()
    }

    fn of(id: SeamId, seam: &Seam, pattern: &Pattern, garment: &Garment, state: &ClothState) -> Self {
        let piece = |k: usize| pattern.pieces.get(&seam.sides[k].piece);
        // A seam along runs of several edges is sewn in parts.
        let parts = || garment.seam_pairs.iter().filter(|(of, _)| *of == id).map(|(_, pairs)| pairs);
        let sum = |total: f64, part: Option<f64>| Some(total + part?);
        let widest = |most: f64, gap: Option<f64>| Some(most.max(gap?));
        let is_sewn = parts().next().is_some();
        let all = |value: Option<f64>| value.filter(|_| is_sewn);
        Self {
            seam: id,
            sides: [0, 1].map(|k| {
                (piece(k).map_or_else(String::new, |piece| piece.name.clone()), seam.sides[k].edge + 1)
            }),
            flat: [0, 1].map(|k| seam.sides[k].length(piece(k)?)),
            worn: all(parts().map(|pairs| length(garment, state, pairs)).try_fold(0.0, sum)),
            gap: all(parts().map(|pairs| widest_gap(garment, state, pairs)).try_fold(0.0, widest)),
        }
    }

    /// Gather ratio: flat length of the longer side over that of the shorter.
    pub fn gather(&self) -> Option<f64> {
        let [a, b] = self.flat;
        Some(a?.max(b?) / a?.min(b?)).filter(|ratio| ratio.is_finite())
    }

    /// Strain along the seam: its length on the body over the shorter flat side, to which the longer is gathered, minus one.
    pub fn stretch(&self) -> Option<f64> {
        let [a, b] = self.flat;
        Some(self.worn? / a?.min(b?) - 1.0).filter(|stretch| stretch.is_finite())
    }

    /// Whether the sides are nowhere more than 0.1 mm apart.
    pub fn is_closed(&self) -> bool {
        self.gap.is_some_and(|gap| gap <= CLOSED)
    }
}

/// Length of the seam in space along the first of its sides, metres; None where a point has no position.
fn length(garment: &Garment, state: &ClothState, pairs: &[[u32; 2]]) -> Option<f64> {
    pairs.windows(2).try_fold(0.0, |length, pair| {
        let [a, b] = [pair[0][0], pair[1][0]].map(|c| garment.corners[c as usize].vertex as usize);
        let lie = [a, b].iter().all(|&v| state.mapped.get(v) == Some(&true));
        let step = state.positions.get(a)?.distance(*state.positions.get(b)?);
        (lie && step.is_finite()).then_some(length + step)
    })
}

#[cfg(test)]
mod tests {
    use glam::{DVec2, DVec3};

    use super::*;
    use crate::fit::maps::tests::{SIDE, sheets};
    use crate::pattern::{EdgeRef, Seam};

    #[test]
    fn a_seam_has_its_lengths_and_its_stretch() {
        let laid = sheets(0.03, |p| DVec3::new(p.x, p.y * 1.02, 0.0));
        let [seam] = &SeamFit::all(&laid.pattern, &laid.garment, &laid.state)[..] else { panic!("one seam") };
        assert_eq!(seam.sides, [("left".to_owned(), 2), ("right".to_owned(), 4)]);
        assert!(seam.flat.iter().all(|flat| flat.is_some_and(|flat| (flat - SIDE).abs() < 1e-9)), "{seam:?}");
        assert!((seam.worn.expect("laid") - 1.02 * SIDE).abs() < 1e-9, "{seam:?}");
        assert!(
            (seam.stretch().expect("laid") - 0.02).abs() < 1e-8 && seam.gather() == Some(1.0),
            "{seam:?}"
        );
        assert!(seam.is_closed());
    }

    #[test]
    fn what_cannot_be_sewn_is_told_too() {
        let mut laid = sheets(0.05, |p: DVec2| p.extend(0.0));
        let left = *laid.pattern.pieces.keys().next().expect("a piece");
        let sides = [EdgeRef { piece: left, edge: 0 }, EdgeRef { piece: left, edge: 9 }];
        laid.pattern.add_seam(Seam::of_edges(sides, false));
        let seams = SeamFit::all(&laid.pattern, &laid.garment, &laid.state);
        assert_eq!(seams.len(), 2);
        assert!(
            !seams[1].is_closed() && seams[1].gap.is_none() && seams[1].flat[1].is_none(),
            "{:?}",
            seams[1]
        );
    }
}
