//! What the session hands over: a garment to build, what it is made of, places on it.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DVec2;
use serde::{Deserialize, Serialize};

use crate::cloth::Fabric;
use crate::geometry::ids::PieceId;
use crate::pattern::Pattern;
use crate::relax::RelaxSettings;
use crate::wrap::Marks;

/// What a garment is built from.
#[derive(Clone, Debug, PartialEq)]
pub struct GarmentSource {
    /// The flat pieces and their seams.
    pub pattern: Arc<Pattern>,
    /// Where they go.
    pub marks: Arc<Marks>,
    /// Target edge length of the triangles, metres.
    pub edge_length: f64,
    /// How the cloth relaxes.
    pub relax: RelaxSettings,
}

/// What the cloth is made of, and how much it may stretch.
#[derive(Clone, Debug, PartialEq)]
pub struct DrapeSource {
    /// Of every piece that has none of its own.
    pub fabric: Fabric,
    /// Of single pieces.
    pub of_pieces: BTreeMap<PieceId, Fabric>,
    /// Strain beyond which cloth is rigid, 1e-3..=0.2.
    pub strain: f64,
}

/// A point of the flat cloth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ClothPlace {
    /// The piece.
    pub piece: PieceId,
    /// In the piece's own plane, metres.
    pub at: DVec2,
}
