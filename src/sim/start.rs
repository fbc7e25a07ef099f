//! Ways to put a garment on its body, and what came of those that were tried.

use serde::{Deserialize, Serialize};

/// How cloth without marks of its own comes on to the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Start {
    /// Wrapped by the garment's own marks or, without any, by those suggested from the placement of its pieces; then draped.
    Marks,
    /// Sewn from where its pieces are placed, which drapes it.
    Placement,
}

impl Start {
    /// In the order in which they are tried.
    pub const ALL: [Self; 2] = [Self::Marks, Self::Placement];
}

impl std::fmt::Display for Start {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Marks => "marks",
            Self::Placement => "placement",
        })
    }
}

impl std::str::FromStr for Start {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "marks" => Ok(Self::Marks),
            "placement" => Ok(Self::Placement),
            _ => Err(format!("there is no start {text:?}: it is marks or placement")),
        }
    }
}

/// Which starts may be taken.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct StartChoice {
    /// Only this one; none: any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub only: Option<Start>,
    /// Only cloth that was draped will do.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub draped: bool,
}

/// What came of a start.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Tried {
    /// Which.
    pub start: Start,
    /// Judged after draping.
    pub draped: bool,
    /// What was wrong with it, in words.
    pub faults: Vec<String>,
    /// In how many places.
    pub places: usize,
    /// Ticks it took; those of the same marks before they were draped count there only.
    pub ticks: u32,
}

impl std::fmt::Display for Tried {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let draped = if self.draped && self.start == Start::Marks { ", draped" } else { "" };
        write!(f, "{}{draped}", self.start)
    }
}

/// What came of all starts that were tried.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Started {
    /// In the order they were tried.
    pub tried: Vec<Tried>,
    /// The index of the one whose cloth lies on the body: the first without a fault, else the one with the fewest.
    pub taken: usize,
}

impl Started {
    /// The one whose cloth lies on the body.
    pub fn taken(&self) -> &Tried {
        &self.tried[self.taken]
    }
}
