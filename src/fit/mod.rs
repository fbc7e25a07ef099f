//! What is read off a garment: strain, crossings, openings, the report.

pub mod exact;
mod laid;
mod on_body;
mod openings;
mod report;
mod shape;
mod spots;
mod tight;
mod verdict;

pub use on_body::BodyIndex;
pub use openings::Opening;
pub use report::{Clearance, Penetration, PieceChange, Report, Seams, Strain, measure};
pub use spots::Spot;
pub use tight::{Tight, tightest};
pub use verdict::{faults, verdict};
