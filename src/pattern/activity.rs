//! Which pieces draping and relaxing move.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::geometry::ids::PieceId;
use crate::pattern::Pattern;

/// What draping and relaxing do with a piece once it lies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Activity {
    /// They move it.
    #[default]
    Active,
    /// It stays where it is, its seams with others too; others lie on it and hang from it.
    Frozen,
    /// It stays where it is and counts for nothing: nothing touches it, its seams to active pieces do not hold, it is neither
    /// measured nor written.
    Deactivated,
}

impl Activity {
    /// Moved, as every piece is at first.
    pub fn is_active(&self) -> bool {
        *self == Self::Active
    }

    /// It counts for nothing.
    pub fn is_deactivated(&self) -> bool {
        *self == Self::Deactivated
    }
}

impl Pattern {
    /// Of the pieces that are not active.
    pub fn activities(&self) -> BTreeMap<PieceId, Activity> {
        let all = self.pieces.iter().map(|(&id, piece)| (id, piece.activity));
        all.filter(|(_, activity)| !activity.is_active()).collect()
    }
}
