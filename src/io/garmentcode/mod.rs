//! Patterns as the JSON files of GarmentCode and of its predecessor, the Garment Pattern Generator.
//!
//! M. Korosteleva and S.-H. Lee, "Generating Datasets of 3D Garments with Sewing Patterns", 2021;
//! M. Korosteleva and O. Sorkine-Hornung, "GarmentCode: Programming Parametric Sewing Patterns", 2023.

mod read;
mod write;

pub use read::{GarmentCodeError, read};
pub use write::write;
