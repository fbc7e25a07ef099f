//! Measurements of a garment: strain, intersections, openings, the report, maps.

mod beside;
mod causes;
mod compare;
pub mod exact;
mod fallen;
pub mod fastenings;
mod girth;
mod inside;
mod laid;
pub mod maps;
mod measured;
mod on_body;
mod openings;
mod report;
mod seams;
mod shape;
mod short;
mod spots;
mod tight;
mod verdict;

pub use causes::{Causes, STRAINED, Smaller, Strained};
pub use compare::{Change, Matching, Unlike};
pub use fallen::{Fallen, fallen, fallen_from, tops};
pub use girth::{Girth, girth, girths};
pub use maps::{Map, MapKind, MapReader, Worn};
pub use measured::measure;
pub use on_body::{BodyIndex, Clearance, Penetration};
pub use openings::Opening;
pub use report::{Moved, Report, Seams};
pub use seams::SeamFit;
pub use shape::{PieceChange, Strain};
pub use short::{ShortSeam, short_seams};
pub use spots::Spot;
pub use tight::{Tight, TightPlace, tight_places, tightest};
pub use verdict::{faults, verdict};
