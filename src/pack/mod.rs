//! The tech pack: what a garment maker needs to know, as a document of A4 pages.
//!
//! | file | holds |
//! | --- | --- |
//! | `facts` | the contents, measured on pattern and dressed garment, for people and programs |
//! | `cloths` | the cloths that the pieces are cut from, colourways, and how much of each is needed |
//! | `seams` | which edges are sewn to which, their lengths and ease |
//! | `alike` | pieces that are cut alike, or as mirror images |
//! | `trims` | buttons, zips, elastic, folds, stitches, hems, piping and graphics |
//! | `sizes` | pieces and seams measured in every size |
//! | `words` | texts, numbers and names as they are written in the language that is shown |
//! | `flow` | headings, words and tables that flow from page to page |
//! | `shape` | a piece as it is drawn: seen from its front |
//! | `drawing` | pieces drawn to scale |
//! | `write` | the pages |
//!
//! The contents are English, for programs; the pages are in the language that is shown. Lengths are metres in the contents, millimetres on the pages.

mod alike;
mod cloths;
mod drawing;
mod facts;
mod flow;
mod seams;
mod shape;
mod sizes;
mod trims;
mod words;
mod write;

pub use cloths::{Cloth, Colourway, Taken, Wish};
pub use facts::{Pack, PieceRow, Source};
pub use seams::{SeamRow, SideRow};
pub use sizes::SizeRow;
pub use trims::{Supply, TrimRow};
pub use words::no_adapter;
pub use write::{Picture, Pictures, write};
