//! Buttons and zips of a dressed garment: which are open, and which do not close.

use serde::{Deserialize, Serialize};

use crate::cloth::{ClothState, Garment};
use crate::pattern::Pattern;

/// Distance above which the two places of a fastened button count as apart, metres: more than two layers of thick cloth.
const APART: f64 = 0.004;

/// Count of the fastenings of a garment.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Fastenings {
    /// Buttons and zips.
    pub count: usize,
    /// Those that are unfastened, all or in part.
    pub open: usize,
    /// Fastened buttons whose two places are more than 4 mm apart.
    pub apart: usize,
    /// Largest distance of the two places of a fastened button, metres; 0 without one.
    pub max_gap: f64,
}

impl Fastenings {
    /// Whether the garment has none.
    pub fn is_none(&self) -> bool {
        self.count == 0
    }

    /// Fastenings that are not closed, by choice or not.
    pub fn not_closed(&self) -> usize {
        self.open + self.apart
    }
}

/// The fastenings of `pattern` on the body.
pub(super) fn fastenings(pattern: &Pattern, garment: &Garment, state: &ClothState) -> Fastenings {
    let zips: Vec<bool> =
        pattern.seams.values().filter_map(|s| Some(s.zip?.closed() != Some([0.0, 1.0]))).collect();
    let open_buttons = pattern.buttons.values().filter(|button| button.open).count();
    let mut found = Fastenings {
        count: pattern.buttons.len() + zips.len(),
        open: open_buttons + zips.iter().filter(|open| **open).count(),
        ..Fastenings::default()
    };
    for [one, other] in &garment.trims.buttons {
        if let (Some(one), Some(other)) = (one.place(garment, state), other.place(garment, state)) {
            let gap = one.distance(other);
            found.max_gap = found.max_gap.max(gap);
            found.apart += usize::from(gap > APART);
        }
    }
    found
}
