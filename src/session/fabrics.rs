//! Fabrics of the pieces of a document, by name.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::cloth::Fabric;
use crate::geometry::ids::PieceId;
use crate::pattern::Pattern;

/// Names of the fabrics of a garment.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Fabrics {
    /// Fabric of every piece without its own; None: [`Fabric::USUAL`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub all: Option<String>,
    /// Fabrics of single pieces.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub pieces: BTreeMap<PieceId, String>,
}

impl Fabrics {
    /// Whether no fabric was chosen.
    pub fn is_usual(&self) -> bool {
        *self == Self::default()
    }

    /// Name of the fabric of `piece`; None: of pieces without their own.
    pub fn name(&self, piece: Option<PieceId>) -> &str {
        let own = piece.and_then(|piece| self.pieces.get(&piece));
        own.or(self.all.as_ref()).map_or(Fabric::USUAL, |name| name)
    }

    /// Fabric of each piece of `pattern`.
    pub fn of(&self, pattern: &Pattern) -> BTreeMap<PieceId, Fabric> {
        let fabric = |&id: &PieceId| Some((id, Fabric::preset(self.name(Some(id)))?.clone()));
        pattern.pieces.keys().filter_map(fabric).collect()
    }
}
