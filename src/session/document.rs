//! The document: all that is the user's own. Cheap to copy.

use std::collections::BTreeMap;
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::cloth::Fabric;
use crate::contact::Bone;
use crate::geometry::ids::{MarkId, PieceId, PinId};
use crate::pattern::Pattern;
use crate::relax::RelaxSettings;
use crate::session::animations::{Animations, Moment};
use crate::session::body_choice::BodyChoice;
use crate::sim::ClothPlace;
use crate::wrap::Marks;

/// Pattern, body, strokes and settings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Document {
    /// The flat pieces and their seams.
    pub pattern: Arc<Pattern>,
    /// What the cloth is put on.
    pub body: BodyChoice,
    /// Strokes on cloth and body.
    pub marks: Arc<Marks>,
    /// The last number given to a mark.
    pub last_mark: u32,
    /// Pushpins in the dressed cloth, in the order they were set.
    #[serde(default, skip_serializing_if = "is_empty")]
    pub pins: Arc<Vec<Pin>>,
    /// The last number given to a pin.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub last_pin: u32,
    /// The pose from a file that the body is led to.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub aim: Option<Arc<Aim>>,
    /// The animations of a file that the body can go through.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub animations: Option<Arc<Animations>>,
    /// Where in them the body is. None: elsewhere, or at rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub moment: Option<Moment>,
    /// Bones drawn in the body, which cloth cannot be pulled across. None: the body's own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bones: Option<Arc<Vec<Bone>>>,
    /// What the cloth is made of.
    #[serde(default, skip_serializing_if = "Fabrics::is_usual")]
    pub fabrics: Fabrics,
    /// Mesh size and relaxation.
    pub settings: Settings,
}

/// From one pose of a body to another.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Aim {
    /// As it was when the other was chosen.
    pub from: BodyChoice,
    /// The same triangles in the other pose.
    pub to: BodyChoice,
}

/// Names of fabrics.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Fabrics {
    /// Of every piece that has none of its own; None: [`Fabric::USUAL`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub all: Option<String>,
    /// Of single pieces.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub pieces: BTreeMap<PieceId, String>,
}

impl Fabrics {
    /// Nothing was chosen.
    pub fn is_usual(&self) -> bool {
        *self == Self::default()
    }

    /// The name of what `piece` (None: all others) is made of.
    pub fn name(&self, piece: Option<PieceId>) -> &str {
        let own = piece.and_then(|piece| self.pieces.get(&piece));
        own.or(self.all.as_ref()).map_or(Fabric::USUAL, |name| name)
    }

    /// What each piece of `pattern` is made of.
    pub fn of(&self, pattern: &Pattern) -> BTreeMap<PieceId, Fabric> {
        let fabric = |&id: &PieceId| Some((id, Fabric::preset(self.name(Some(id)))?.clone()));
        pattern.pieces.keys().filter_map(fabric).collect()
    }
}

/// A pushpin: the cloth under it stays where it is on the body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pin {
    /// Its id.
    pub id: PinId,
    /// Where it is stuck in.
    #[serde(flatten)]
    pub place: ClothPlace,
    /// Stays until it is unlocked.
    #[serde(default, skip_serializing_if = "is_false")]
    pub locked: bool,
}

fn is_empty(pins: &Arc<Vec<Pin>>) -> bool {
    pins.is_empty()
}

pub(super) fn is_false(flag: &bool) -> bool {
    !flag
}

fn is_zero(number: &u32) -> bool {
    *number == 0
}

impl Default for Document {
    fn default() -> Self {
        Self {
            pattern: Arc::new(Pattern::default()),
            body: BodyChoice::default(),
            marks: Arc::new(Marks::default()),
            last_mark: 0,
            pins: Arc::default(),
            last_pin: 0,
            aim: None,
            animations: None,
            moment: None,
            bones: None,
            fabrics: Fabrics::default(),
            settings: Settings::default(),
        }
    }
}

impl Document {
    /// An id no stroke has had.
    pub fn fresh_mark(&mut self) -> MarkId {
        self.last_mark += 1;
        MarkId(self.last_mark)
    }

    /// Where the pins are stuck in, for the simulation.
    pub fn pinned_places(&self) -> Arc<Vec<ClothPlace>> {
        Arc::new(self.pins.iter().map(|pin| pin.place).collect())
    }

    /// The cloth comes off: nothing is left to pin.
    pub fn drop_pins(&mut self) {
        self.pins = Arc::default();
    }

    /// Replaces all strokes; the counter stays ahead of their ids.
    pub fn take_marks(&mut self, marks: Arc<Marks>) {
        self.last_mark = self.last_mark.max(marks.ids().max().unwrap_or_default().0);
        self.marks = marks;
    }
}

/// Mesh size and relaxation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    /// Target edge length of the cloth's triangles, metres, 0.002..=0.2.
    pub edge_length: f64,
    /// How the cloth relaxes.
    pub relax: RelaxSettings,
    /// Strain beyond which draped cloth is rigid, 0.001..=0.2.
    #[serde(skip_serializing_if = "is_usual_strain")]
    pub strain: f64,
}

/// One percent, as in paper B.
const USUAL_STRAIN: f64 = 0.01;

fn is_usual_strain(strain: &f64) -> bool {
    *strain == USUAL_STRAIN
}

impl Default for Settings {
    fn default() -> Self {
        Self { edge_length: 0.02, relax: RelaxSettings::default(), strain: USUAL_STRAIN }
    }
}
