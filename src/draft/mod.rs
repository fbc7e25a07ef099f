//! A corpus of our own garments: designs drawn at random from a seed and drafted to the mannequin's measurements, with every
//! piece placed round the body in its pose.
//!
//! `design` holds the choices, `form` the measurements; there is a file for each part of a garment, and `corpus` lists the
//! garments. Pieces are drawn as seen from the front, with the wearer's left at +x; those behind the body are reversed when they
//! are placed. The same seed gives the same bits.

mod band;
mod bodice;
mod cape;
mod collar;
mod corpus;
mod design;
mod dolman;
mod dungarees;
mod form;
mod garment;
mod hood;
mod neckline;
mod one_shoulder;
mod path;
mod pleats;
mod sizes;
mod skirt;
mod sleeve;
mod trousers;
mod turn_up;

pub use bodice::{Bodice, Hem, Opening};
pub use cape::{Cape, cape};
pub use collar::{Collar, Fall};
pub use corpus::{Case, Corpus, Shard};
pub use design::{Bottom, Design, Kind, Top, Upper, Waist};
pub use dolman::Dolman;
pub use dungarees::{Dungarees, dungarees};
pub use form::Form;
pub use hood::Hood;
pub use neckline::{Neckline, Shape as NecklineShape};
pub use pleats::{Pleats, pleated_skirt};
pub use sizes::{ADULTS, BodySize, CHILDREN, SIZE_TABLES, SIZES, SizeTable};
pub use skirt::{Shape, Skirt};
pub use sleeve::Sleeve;
pub use trousers::Trousers;
