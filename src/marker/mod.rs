//! Marker making: the pieces of one or more garments laid out on a width of cloth, to be cut.
//!
//! | file | holds |
//! | --- | --- |
//! | `order` | what is to be cut, on which cloth, and what may be turned |
//! | `cut` | the single pieces of cloth that an order asks for, each with its cutting line |
//! | `layout` | the marker: those pieces placed by `nest` |
//! | `finished` | a marker with its report: what window and command line show and write |
//! | `report` | length, yield, consumption and the piece list, for people and programs |
//! | `write` | the files to cut from |
//! | `nest` | outlines laid out on a strip; it knows nothing of cloth |
//!
//! On a marker x runs along the warp and y across it. Every piece shows its front; its grainline is kept along the warp.

mod cut;
mod finished;
mod layout;
pub mod nest;
mod order;
mod report;
mod write;

pub use finished::FinishedMarker;
pub use layout::{Marker, Placed, make};
pub use order::{MOST_PIECES, MarkerError, Order, WIDEST, garments};
pub use report::{MarkerReport, PieceRow};
pub use write::MarkerFormat;
