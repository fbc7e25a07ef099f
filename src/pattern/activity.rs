//! Activity of pieces: which ones draping and relaxing move.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::geometry::ids::PieceId;
use crate::pattern::Pattern;

/// What draping and relaxing do with a piece that is on the body.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Activity {
    /// The piece is moved.
    #[default]
    Active,
    /// The piece and its seams stay in place; other pieces rest on it and hang from it.
    Frozen,
    /// The piece stays in place and is ignored: nothing touches it, its seams to active pieces do not hold, and it is
    /// neither measured nor written.
    Deactivated,
}

impl Activity {
    /// Whether the piece is moved; every piece is at first.
    pub fn is_active(&self) -> bool {
        *self == Self::Active
    }

    /// Whether the piece is ignored.
    pub fn is_deactivated(&self) -> bool {
        *self == Self::Deactivated
    }
}

impl Pattern {
    /// The activity of each piece that is not active.
    pub fn activities(&self) -> BTreeMap<PieceId, Activity> {
        let all = self.pieces.iter().map(|(&id, piece)| (id, piece.activity));
        all.filter(|(_, activity)| !activity.is_active()).collect()
    }
}
