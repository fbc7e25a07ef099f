//! How the seam allowance goes round a corner of an outline.

use serde::{Deserialize, Serialize};

/// One of the two edges that meet at a corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// The edge that ends at the corner.
    Before,
    /// The edge that starts there.
    After,
}

/// The shape of the seam allowance at a corner. At a corner that turns inwards it is always a mitre.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum AllowanceCorner {
    /// Both allowances run on until they meet. A very sharp corner is cut off.
    #[default]
    Mitre,
    /// The allowance of this edge ends at right angles to it, at the corner, and that of the other edge runs on to there. At a
    /// right or sharper angle, where it cannot, both end so and are joined by a straight line.
    Square(Side),
    /// The allowance of this edge (a hem) is the mirror image of the piece beside the other edge, so that it fits when it is
    /// turned up.
    TurnedUp(Side),
}

impl Side {
    fn other(self) -> Self {
        match self {
            Self::Before => Self::After,
            Self::After => Self::Before,
        }
    }
}

impl AllowanceCorner {
    /// All shapes, in the order of menus.
    pub const ALL: [Self; 5] = [
        Self::Mitre,
        Self::Square(Side::Before),
        Self::Square(Side::After),
        Self::TurnedUp(Side::Before),
        Self::TurnedUp(Side::After),
    ];

    /// Whether it is a mitre, as where nothing is chosen.
    pub fn is_mitre(&self) -> bool {
        *self == Self::Mitre
    }

    /// The same shape where the outline runs the other way round.
    pub fn reversed(self) -> Self {
        match self {
            Self::Mitre => Self::Mitre,
            Self::Square(side) => Self::Square(side.other()),
            Self::TurnedUp(side) => Self::TurnedUp(side.other()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::Edge;

    #[test]
    fn files_without_corners_are_read_and_written_as_before() {
        let old = r#"{"start":[0.0,0.0],"shape":"line"}"#;
        let mut edge: Edge = serde_json::from_str(old).expect("an edge");
        assert!(edge.corner.is_mitre());
        assert_eq!(serde_json::to_string(&edge).expect("text"), old);
        for corner in AllowanceCorner::ALL {
            edge.corner = corner;
            let text = serde_json::to_string(&edge).expect("text");
            assert_eq!(serde_json::from_str::<Edge>(&text).expect("an edge"), edge);
            assert_eq!(corner.reversed().reversed(), corner);
        }
    }
}
