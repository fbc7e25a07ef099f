//! Sample garments drafted for the mannequin, with marks or placed round it: what a first-time user opens.
//!
//! Every sample but the creature's cloak is drafted from the mannequin's own measurements, so a sample can be drafted for another body,
//! too.

mod bow;
mod creature;
mod draft;
mod dress;
mod form;
mod gallery;
mod scarf;
mod skirt;
mod strokes;
mod trousers;
mod tshirt;

use std::sync::Arc;

use crate::body::{Mannequin, Measurements, mannequin};
use crate::draft::CHILDREN;
use crate::geometry::names;
use crate::pattern::Pattern;
use crate::session::{BodyChoice, Document, Project};
use crate::wrap::Marks;
use form::Form;

pub use creature::seal;

/// Size of the child that children's samples are made for.
const CHILD: &str = "116";

/// A sample garment.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Sample {
    /// Front, back, two sleeves.
    Tshirt,
    /// Front and back with darts on a waistband.
    Skirt,
    /// A darted bodice on a flared skirt.
    Dress,
    /// Two fronts, two backs, a waistband.
    Trousers,
    /// One strip round the neck.
    Scarf,
    /// A blouse with a collar and cuffs.
    Blouse,
    /// A roomy top with a hood.
    Hoodie,
    /// A top with raglan sleeves.
    Raglan,
    /// A wide top with its sleeves in one piece.
    Kimono,
    /// A long warm top with a funnel collar.
    Tunic,
    /// A fitted bodice on a long skirt with godets.
    Gown,
    /// A bodice on wide trousers.
    Jumpsuit,
    /// Narrow trousers of knitted cloth.
    Leggings,
    /// Short trousers.
    Shorts,
    /// A skirt cut from a full circle.
    CircleSkirt,
    /// A skirt gathered into its waistband.
    GatheredSkirt,
    /// A skirt of three tiers.
    TieredSkirt,
    /// A child's bodice with puff sleeves on a gathered skirt.
    ChildDress,
    /// Trousers with a bib and straps.
    Dungarees,
    /// A long coat that is buttoned in front.
    Coat,
    /// A shirt with a collar that turns over.
    Shirt,
    /// A shirt with short sleeves and a collar in one piece.
    CampShirt,
    /// Short trousers with turn-ups.
    TurnUps,
    /// A skirt of knife pleats.
    PleatedSkirt,
    /// A gathered skirt with a bow at its waistband.
    BowSkirt,
    /// A cape, closed at the throat.
    Cape,
    /// A cloak for a seal.
    CreatureCloak,
}

impl Sample {
    /// All samples, in the order of the menu.
    pub const ALL: [Self; 27] = [
        Self::Tshirt,
        Self::Skirt,
        Self::Dress,
        Self::Trousers,
        Self::Scarf,
        Self::Blouse,
        Self::Hoodie,
        Self::Raglan,
        Self::Kimono,
        Self::Tunic,
        Self::Gown,
        Self::Jumpsuit,
        Self::Leggings,
        Self::Shorts,
        Self::CircleSkirt,
        Self::GatheredSkirt,
        Self::TieredSkirt,
        Self::ChildDress,
        Self::Dungarees,
        Self::Coat,
        Self::Shirt,
        Self::CampShirt,
        Self::TurnUps,
        Self::PleatedSkirt,
        Self::BowSkirt,
        Self::Cape,
        Self::CreatureCloak,
    ];

    /// Those with marks, to be wrapped; the others have their pieces placed round the body, to be dressed.
    pub const MARKED: [Self; 5] = [Self::Tshirt, Self::Skirt, Self::Dress, Self::Trousers, Self::Scarf];

    /// Name for the user.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tshirt => "T-shirt",
            Self::Skirt => "Skirt",
            Self::Dress => "Dress",
            Self::Trousers => "Trousers",
            Self::Scarf => "Scarf",
            Self::Blouse => "Blouse",
            Self::Hoodie => "Hoodie",
            Self::Raglan => "Raglan shirt",
            Self::Kimono => "Kimono top",
            Self::Tunic => "Tunic",
            Self::Gown => "Gown",
            Self::Jumpsuit => "Jumpsuit",
            Self::Leggings => "Leggings",
            Self::Shorts => "Shorts",
            Self::CircleSkirt => "Circle skirt",
            Self::GatheredSkirt => "Gathered skirt",
            Self::TieredSkirt => "Tiered skirt",
            Self::ChildDress => "Child's dress",
            Self::Dungarees => "Dungarees",
            Self::Coat => "Coat",
            Self::Shirt => "Shirt",
            Self::CampShirt => "Camp shirt",
            Self::TurnUps => "Turn-up shorts",
            Self::PleatedSkirt => "Pleated skirt",
            Self::BowSkirt => "Skirt with a bow",
            Self::Cape => "Cape",
            Self::CreatureCloak => "Creature's cloak",
        }
    }

    /// The sample that is called `typed`, as [`names::found`] finds names.
    pub fn named(typed: &str) -> Option<Self> {
        names::found(Self::ALL.map(Self::file_stem), typed).map(|i| Self::ALL[i])
    }

    /// Name of its file in `assets/samples`, without `.toile`.
    pub fn file_stem(self) -> &'static str {
        match self {
            Self::Tshirt => "tshirt",
            Self::Skirt => "skirt",
            Self::Dress => "dress",
            Self::Trousers => "trousers",
            Self::Scarf => "scarf",
            Self::Blouse => "blouse",
            Self::Hoodie => "hoodie",
            Self::Raglan => "raglan",
            Self::Kimono => "kimono",
            Self::Tunic => "tunic",
            Self::Gown => "gown",
            Self::Jumpsuit => "jumpsuit",
            Self::Leggings => "leggings",
            Self::Shorts => "shorts",
            Self::CircleSkirt => "circle-skirt",
            Self::GatheredSkirt => "gathered-skirt",
            Self::TieredSkirt => "tiered-skirt",
            Self::ChildDress => "child-dress",
            Self::Dungarees => "dungarees",
            Self::Coat => "coat",
            Self::Shirt => "shirt",
            Self::CampShirt => "camp-shirt",
            Self::TurnUps => "turn-ups",
            Self::PleatedSkirt => "pleated-skirt",
            Self::BowSkirt => "bow-skirt",
            Self::Cape => "cape",
            Self::CreatureCloak => "creature-cloak",
        }
    }

    /// Measurements of the mannequin that it is made for: the default one, or a child of 116 cm. The creature's cloak is made for none.
    pub fn measurements(self) -> Measurements {
        let child = CHILDREN.into_iter().find(|size| size.name == CHILD);
        match (self, child) {
            (Self::ChildDress, Some(size)) => size.measurements(),
            _ => Measurements::default(),
        }
    }

    /// The sample on the body that it is made for.
    pub fn usual(self) -> Project {
        let body = mannequin::mannequin(&self.measurements()).unwrap_or_else(|_| mannequin::default());
        self.project(&body)
    }

    /// The sample drafted for `body`, with its marks or placed round the body; the creature's cloak comes with the creature. Panics
    /// where the measurements are those of no mannequin: this one has been built.
    pub fn project(self, body: &Mannequin) -> Project {
        let document = match self.cut() {
            Cut::Marked(drafted) => marked(drafted, body),
            Cut::Placed(garment) => gallery::document(&garment(), body),
            Cut::Bowed => bow::skirt(body),
            Cut::Creature(document) => document(),
        };
        Project { document, dressed: None }
    }

    fn cut(self) -> Cut {
        match self {
            Self::Tshirt => Cut::Marked(tshirt::tshirt),
            Self::Skirt => Cut::Marked(skirt::skirt),
            Self::Dress => Cut::Marked(dress::dress),
            Self::Trousers => Cut::Marked(trousers::trousers),
            Self::Scarf => Cut::Marked(scarf::scarf),
            Self::Blouse => Cut::Placed(gallery::blouse),
            Self::Hoodie => Cut::Placed(gallery::hoodie),
            Self::Raglan => Cut::Placed(gallery::raglan),
            Self::Kimono => Cut::Placed(gallery::kimono),
            Self::Tunic => Cut::Placed(gallery::tunic),
            Self::Gown => Cut::Placed(gallery::gown),
            Self::Jumpsuit => Cut::Placed(gallery::jumpsuit),
            Self::Leggings => Cut::Placed(gallery::leggings),
            Self::Shorts => Cut::Placed(gallery::shorts),
            Self::CircleSkirt => Cut::Placed(gallery::circle_skirt),
            Self::GatheredSkirt => Cut::Placed(gallery::gathered_skirt),
            Self::TieredSkirt => Cut::Placed(gallery::tiered_skirt),
            Self::ChildDress => Cut::Placed(gallery::child_dress),
            Self::Dungarees => Cut::Placed(gallery::dungarees),
            Self::Coat => Cut::Placed(gallery::coat),
            Self::Shirt => Cut::Placed(gallery::shirt),
            Self::CampShirt => Cut::Placed(gallery::camp_shirt),
            Self::TurnUps => Cut::Placed(gallery::turn_ups),
            Self::PleatedSkirt => Cut::Placed(gallery::pleated_skirt),
            Self::BowSkirt => Cut::Bowed,
            Self::Cape => Cut::Placed(gallery::cape),
            Self::CreatureCloak => Cut::Creature(creature::cloak),
        }
    }
}

/// How a sample is drafted.
enum Cut {
    Marked(fn(&Form) -> (Pattern, Marks)),
    Placed(fn() -> gallery::Garment),
    /// Placed, with a bow.
    Bowed,
    /// On a body of its own.
    Creature(fn() -> Document),
}

fn marked(drafted: fn(&Form) -> (Pattern, Marks), body: &Mannequin) -> Document {
    let (mut pattern, marks) = drafted(&Form::new(body));
    draft::finish(&mut pattern);
    let mut document = Document {
        pattern: Arc::new(pattern),
        body: BodyChoice::Mannequin(body.measurements),
        ..Document::default()
    };
    document.take_marks(Arc::new(marks));
    document
}
