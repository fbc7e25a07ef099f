//! Input from the session: the garment to build, its fabrics, and points on it.

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
    /// The marks that say where it goes on the body.
    pub marks: Arc<Marks>,
    /// Target edge length of the triangles, metres.
    pub edge_length: f64,
    /// Settings of relaxation.
    pub relax: RelaxSettings,
}

/// Fabrics and strain limit of draping.
#[derive(Clone, Debug, PartialEq)]
pub struct DrapeSource {
    /// Fabric of every piece without its own.
    pub fabric: Fabric,
    /// Fabrics of single pieces.
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
