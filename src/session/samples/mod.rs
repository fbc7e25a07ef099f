//! Sample garments drafted for the mannequin, each with its marks: what a first-time user opens.
//!
//! Every sample is drafted from the mannequin's own measurements, so a sample can be drafted for another body, too.

mod draft;
mod dress;
mod form;
mod scarf;
mod skirt;
mod strokes;
mod trousers;
mod tshirt;

use std::sync::Arc;

use crate::body::Mannequin;
use crate::session::{BodyChoice, Document, Project};
use form::Form;

/// A sample garment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
}

impl Sample {
    /// All samples, in the order of the menu.
    pub const ALL: [Self; 5] = [Self::Tshirt, Self::Skirt, Self::Dress, Self::Trousers, Self::Scarf];

    /// Name for the user.
    pub fn name(self) -> &'static str {
        match self {
            Self::Tshirt => "T-shirt",
            Self::Skirt => "Skirt",
            Self::Dress => "Dress",
            Self::Trousers => "Trousers",
            Self::Scarf => "Scarf",
        }
    }

    /// Name of its file in `assets/samples`, without `.toile`.
    pub fn file_stem(self) -> &'static str {
        match self {
            Self::Tshirt => "tshirt",
            Self::Skirt => "skirt",
            Self::Dress => "dress",
            Self::Trousers => "trousers",
            Self::Scarf => "scarf",
        }
    }

    /// The sample drafted for `body`, with its marks.
    pub fn project(self, body: &Mannequin) -> Project {
        let form = Form::new(body);
        let (mut pattern, marks) = match self {
            Self::Tshirt => tshirt::tshirt(&form),
            Self::Skirt => skirt::skirt(&form),
            Self::Dress => dress::dress(&form),
            Self::Trousers => trousers::trousers(&form),
            Self::Scarf => scarf::scarf(&form),
        };
        draft::finish(&mut pattern);
        let mut document = Document {
            pattern: Arc::new(pattern),
            body: BodyChoice::Mannequin(body.measurements),
            ..Document::default()
        };
        document.take_marks(Arc::new(marks));
        Project { document, dressed: None }
    }
}
