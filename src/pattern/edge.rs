//! One edge of a closed line: a straight line, an arc or a Bézier curve.

use glam::DVec2;
use serde::{Deserialize, Serialize};

use crate::pattern::Trims;
use crate::pattern::corner::AllowanceCorner;
use crate::pattern::grading::rule::GradeRule;

/// Accuracy to which arc lengths are computed, metres.
pub const ARC_LENGTH_ACCURACY: f64 = 1e-7;

/// The shape of one outline edge between its end points. Control points are absolute, in the piece's own plane, metres.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum EdgeShape {
    /// Straight line.
    #[default]
    Line,
    /// Circular arc: `radius` > 0 metres, flags as in SVG but with y up (`sweep` true runs counter-clockwise).
    Arc { radius: f64, large: bool, sweep: bool },
    /// Quadratic Bézier.
    Quadratic { control: DVec2 },
    /// Cubic Bézier.
    Cubic { controls: [DVec2; 2] },
}

/// One edge of a closed line: from its own start point to the start point of the next edge.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Edge {
    /// Where the edge starts, metres in the piece's own plane.
    pub start: DVec2,
    /// The curve between the edge's start and end.
    pub shape: EdgeShape,
    /// Whether the line is smooth at the start point: when an editor turns one of its two tangents, the other follows.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub smooth: bool,
    /// How the seam allowance goes round the start point.
    #[serde(default, skip_serializing_if = "AllowanceCorner::is_mitre")]
    pub corner: AllowanceCorner,
    /// A name from the source file ("left_collar"), if any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub label: Option<String>,
    /// How the start point moves from size to size. None: it stays, or follows its neighbours
    /// ([`graded`](crate::pattern::grading::graded)).
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rule: Option<GradeRule>,
    /// What is worked along the edge.
    #[serde(default, skip_serializing_if = "Trims::is_none")]
    pub trims: Trims,
}
