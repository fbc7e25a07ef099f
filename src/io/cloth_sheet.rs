//! The cloth that a marker is drawn on: what its file shows besides the pieces.

use std::collections::BTreeMap;

use glam::DVec2;

use crate::geometry::ids::PieceId;

/// A length of cloth in the pattern plane, from the origin along x (the warp) and across it along y.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ClothSheet {
    /// Length and width, metres.
    pub size: DVec2,
    /// What is written below it, a line each.
    pub words: Vec<String>,
    /// The size that each piece is cut in, where it has one.
    pub sizes: BTreeMap<PieceId, String>,
}

impl ClothSheet {
    /// The corners in order round it.
    pub fn corners(&self) -> [DVec2; 4] {
        let DVec2 { x, y } = self.size;
        [DVec2::ZERO, DVec2::new(x, 0.0), self.size, DVec2::new(0.0, y)]
    }
}
