//! A corpus of garments of our own: designs drawn at random from a seed, drafted to the mannequin's measurements, every
//! piece standing round the body in its pose.
//!
//! `design` says what is chosen, `form` what is measured; there is a file for each part of a garment, and `corpus` counts
//! the garments. Pieces are drawn as seen from the front, the wearer's left at +x; those that stand behind the body are
//! turned round when they are placed. The same seed gives the same bits.

mod band;
mod bodice;
mod collar;
mod corpus;
mod design;
mod dolman;
mod form;
mod garment;
mod hood;
mod neckline;
mod one_shoulder;
mod path;
mod random;
mod sizes;
mod skirt;
mod sleeve;
mod trousers;

pub use corpus::{Case, Corpus, Shard};
pub use design::{Design, Kind};
pub use form::Form;
pub use random::Random;
pub use sizes::{BodySize, SIZES, table};
