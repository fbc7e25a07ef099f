//! The document: all of the user's own data. Cheap to clone.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::contact::Bone;
use crate::geometry::ids::{MarkId, PinId};
use crate::pattern::Pattern;
use crate::relax::RelaxSettings;
use crate::session::animations::{Animations, Moment};
use crate::session::artwork::Artwork;
use crate::session::body_choice::BodyChoice;
use crate::session::dyes::{Colourway, Dyes};
use crate::session::fabrics::Fabrics;
use crate::sim::ClothPlace;
use crate::wrap::Marks;

/// Pattern, body, strokes and settings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Document {
    /// The flat pieces and their seams.
    pub pattern: Arc<Pattern>,
    /// The body that the cloth is put on.
    pub body: BodyChoice,
    /// Strokes on cloth and body.
    pub marks: Arc<Marks>,
    /// Counter of mark ids: the last one given.
    pub last_mark: u32,
    /// Pushpins in the dressed cloth, in the order they were set.
    #[serde(default, skip_serializing_if = "is_empty")]
    pub pins: Arc<Vec<Pin>>,
    /// Counter of pin ids: the last one given.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub last_pin: u32,
    /// The pose from a file that the body can be moved towards.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub aim: Option<Arc<Aim>>,
    /// Animations from a file that the body can go through.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub animations: Option<Arc<Animations>>,
    /// The moment of the animations that the body is in. None: another pose, or at rest.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub moment: Option<Moment>,
    /// Bones drawn in the body, which cloth cannot be pulled across. None: the body's own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub bones: Option<Arc<Vec<Bone>>>,
    /// Fabrics of the pieces.
    #[serde(default, skip_serializing_if = "Fabrics::is_usual")]
    pub fabrics: Fabrics,
    /// Colours and prints of the pieces.
    #[serde(default, skip_serializing_if = "Dyes::is_plain")]
    pub dyes: Dyes,
    /// Named sets of fabrics, colours and prints.
    #[serde(default, skip_serializing_if = "is_none_kept")]
    pub colourways: Arc<Vec<Colourway>>,
    /// Images, and graphics on pieces.
    #[serde(default, skip_serializing_if = "has_no_images")]
    pub artwork: Arc<Artwork>,
    /// Mesh size, relaxation and draping.
    pub settings: Settings,
}

/// A target pose of the body, and the pose it starts from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Aim {
    /// The body when the target was chosen.
    pub from: BodyChoice,
    /// The body in the target pose, with the same triangles.
    pub to: BodyChoice,
}

/// A pushpin: the cloth under it keeps its position on the body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pin {
    /// Its id.
    pub id: PinId,
    /// The point of the flat cloth that it holds.
    #[serde(flatten)]
    pub place: ClothPlace,
    /// Whether it is locked: it can be neither moved nor removed.
    #[serde(default, skip_serializing_if = "is_false")]
    pub locked: bool,
}

fn is_empty(pins: &Arc<Vec<Pin>>) -> bool {
    pins.is_empty()
}

fn is_none_kept(colourways: &Arc<Vec<Colourway>>) -> bool {
    colourways.is_empty()
}

fn has_no_images(artwork: &Arc<Artwork>) -> bool {
    artwork.is_empty()
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
            dyes: Dyes::default(),
            colourways: Arc::default(),
            artwork: Arc::default(),
            settings: Settings::default(),
        }
    }
}

impl Document {
    /// A new mark id.
    pub fn fresh_mark(&mut self) -> MarkId {
        self.last_mark += 1;
        MarkId(self.last_mark)
    }

    /// The points of the cloth that pins hold, for the simulation.
    pub fn pinned_places(&self) -> Arc<Vec<ClothPlace>> {
        Arc::new(self.pins.iter().map(|pin| pin.place).collect())
    }

    /// Removes all pins, when the cloth comes off.
    pub fn drop_pins(&mut self) {
        self.pins = Arc::default();
    }

    /// Replaces all strokes; the counter stays at or above their ids.
    pub fn take_marks(&mut self, marks: Arc<Marks>) {
        self.last_mark = self.last_mark.max(marks.ids().max().unwrap_or_default().0);
        self.marks = marks;
    }
}

/// Edge lengths that the triangles of cloth may be given, metres.
pub const EDGE_LENGTHS: std::ops::RangeInclusive<f64> = 0.002..=0.2;

/// Settings of mesh size, relaxation and draping.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Settings {
    /// Target edge length of the cloth's triangles, metres; one of [`EDGE_LENGTHS`].
    pub edge_length: f64,
    /// Settings of relaxation.
    pub relax: RelaxSettings,
    /// Strain beyond which draped cloth is rigid, 0.001..=0.2.
    #[serde(skip_serializing_if = "is_usual_strain")]
    pub strain: f64,
}

/// Default strain of draped cloth: one percent, as in paper B.
const USUAL_STRAIN: f64 = 0.01;

fn is_usual_strain(strain: &f64) -> bool {
    *strain == USUAL_STRAIN
}

impl Default for Settings {
    fn default() -> Self {
        Self { edge_length: 0.02, relax: RelaxSettings::default(), strain: USUAL_STRAIN }
    }
}
