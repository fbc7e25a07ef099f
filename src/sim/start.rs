//! Starts: ways to put a garment on its body, and the results of those that were tried.

use serde::{Deserialize, Serialize};

use crate::geometry::words::Words;

/// How a garment is put on the body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Start {
    /// Wrapped by the garment's own marks or, without any, by those suggested from the placement of its pieces; then draped.
    Marks,
    /// Sewn from the placement of its pieces, then draped.
    Placement,
}

impl Start {
    /// All starts, in the order in which they are tried, but where something turns over at a seam and the garment has no marks of
    /// its own: then the placement comes first.
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

/// Which starts are allowed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct StartChoice {
    /// Only this start; None: any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub only: Option<Start>,
    /// Whether only draped cloth is accepted.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub draped: bool,
}

/// The start that is being tried.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Trying {
    pub start: Start,
    /// Whether it is being draped.
    pub draped: bool,
    /// Its number among those that were begun, from 1.
    pub number: usize,
}

/// How a start uses the pose that the mannequin is built in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum AsBuilt {
    /// The mannequin was dressed in that pose.
    Dressed,
    /// The garment was carried from there to the pose that the body has.
    Carried,
}

/// Result of a start.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Tried {
    /// The start.
    pub start: Start,
    /// Whether it was judged after draping.
    pub draped: bool,
    /// Whether it was tried in a mesh a little finer than the garment's own, as the same starts had few faults before.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub finer: bool,
    /// What the pose that the mannequin is built in has to do with it; None: nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub as_built: Option<AsBuilt>,
    /// Faults, in words.
    pub faults: Vec<Words>,
    /// Number of places with faults.
    pub places: usize,
    /// Ticks it took. The ticks of a wrap are not counted again in the result after draping.
    pub ticks: u32,
}

impl Tried {
    /// Most places with faults that are a matter of chance, as cloth caught in a few folds is: of three garments of 216 that ended so,
    /// all had no fault in another mesh.
    pub const FEW: usize = 30;

    /// Whether its only fault is one of a few places.
    pub fn is_nearly_clean(&self) -> bool {
        self.faults.len() == 1 && (1..=Self::FEW).contains(&self.places)
    }
}

impl std::fmt::Display for Tried {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let draped = if self.draped && self.start == Start::Marks { ", draped" } else { "" };
        let finer = if self.finer { ", in a finer mesh" } else { "" };
        let as_built = match self.as_built {
            None => "",
            Some(AsBuilt::Dressed) => ", in the pose that the mannequin is built in",
            Some(AsBuilt::Carried) => ", carried from the pose that the mannequin is built in",
        };
        write!(f, "{}{draped}{finer}{as_built}", self.start)
    }
}

/// Results of all starts that were tried.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Started {
    /// Results in the order in which they were tried.
    pub tried: Vec<Tried>,
    /// Index in `tried` of the result that was taken: the first without a fault, else the one with the fewest faults.
    pub taken: usize,
}

impl Started {
    /// The result that was taken.
    pub fn taken(&self) -> &Tried {
        &self.tried[self.taken]
    }

    /// The first fault of the start that was taken when it was draped, where it was taken undraped because of that.
    pub fn draped_fault(&self) -> Option<&Words> {
        let taken = self.taken();
        let draped = |tried: &&Tried| tried.start == taken.start && tried.draped;
        let tried = self.tried.iter().rfind(draped).filter(|_| !taken.draped)?;
        tried.faults.first().filter(|_| taken.faults.is_empty())
    }
}
