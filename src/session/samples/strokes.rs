//! Builder of numbered pairs of strokes.

use glam::{DVec2, DVec3};

use crate::geometry::ids::{MarkId, PieceId};
use crate::wrap::{BodyMark, ClothMark, ClothSide, Marks};

/// Pairs added so far; ids count up from one.
#[derive(Default)]
pub struct Strokes {
    marks: Marks,
}

impl Strokes {
    /// Adds a pair: a straight stroke on the front of `piece` from `from` to `to`, and its partner on the body.
    pub fn pair(&mut self, piece: PieceId, from: DVec2, to: DVec2, body: Vec<DVec3>) {
        let count = ((to - from).length() / 0.02).ceil().max(1.0) as usize;
        let points = (0..=count).map(|i| from.lerp(to, i as f64 / count as f64)).collect();
        let number = self.marks.cloth.len() as u32;
        let ids = [MarkId(2 * number + 1), MarkId(2 * number + 2)];
        self.marks.cloth.push(ClothMark { id: ids[0], piece, side: ClothSide::Front, points });
        self.marks.body.push(BodyMark { id: ids[1], points: body });
    }

    /// All pairs.
    pub fn finish(self) -> Marks {
        self.marks
    }
}
