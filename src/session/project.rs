//! Content of a project file; `project_file` reads and writes the file.

use std::sync::Arc;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::cloth::ClothState;
use crate::fit::Moved;
use crate::geometry::words::{Words, words};
use crate::pattern::Pattern;
use crate::relax::RelaxSettings;
use crate::session::document::{Document, Settings, is_false};
use crate::sim::GarmentSource;
use crate::wrap::Marks;

/// A document and, if there is any, the cloth on its body.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Project {
    /// The document.
    pub document: Document,
    /// The cloth on the body.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dressed: Option<Dressed>,
}

/// Cloth on the body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(from = "DressedData", into = "DressedData")]
pub struct Dressed {
    /// What the garment was built from; the pattern may have been edited since.
    pub source: Arc<GarmentSource>,
    /// Positions of the cloth.
    pub cloth: Arc<ClothState>,
    /// How it came there, which tells whether folds are a fault. Wrapped in files that say nothing.
    pub moved: Moved,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct DressedData {
    pattern: Arc<Pattern>,
    marks: Arc<Marks>,
    edge_length: f64,
    relax: RelaxSettings,
    positions: Vec<DVec3>,
    mapped: Vec<bool>,
    #[serde(default, skip_serializing_if = "is_false")]
    was_draped: bool,
    #[serde(default, skip_serializing_if = "is_false")]
    was_carried: bool,
}

impl From<Dressed> for DressedData {
    fn from(dressed: Dressed) -> Self {
        let GarmentSource { pattern, marks, edge_length, relax } = Arc::unwrap_or_clone(dressed.source);
        let ClothState { positions, mapped } = Arc::unwrap_or_clone(dressed.cloth);
        let [was_draped, was_carried] = [Moved::Draped, Moved::Carried].map(|moved| dressed.moved == moved);
        Self { pattern, marks, edge_length, relax, positions, mapped, was_draped, was_carried }
    }
}

impl From<DressedData> for Dressed {
    fn from(data: DressedData) -> Self {
        let DressedData { pattern, marks, edge_length, relax, positions, mapped, was_draped, was_carried } =
            data;
        Self {
            source: Arc::new(GarmentSource { pattern, marks, edge_length, relax }),
            cloth: Arc::new(ClothState { positions, mapped }),
            moved: match (was_draped, was_carried) {
                (true, _) => Moved::Draped,
                (false, true) => Moved::Carried,
                (false, false) => Moved::Wrapped,
            },
        }
    }
}

impl Project {
    /// The first thing in it that no command would accept, in words; for files from outside.
    pub fn problem(&self) -> Option<Words> {
        crate::session::edit::document_problem(&self.document).or_else(|| self.dressed.as_ref()?.problem())
    }
}

impl Dressed {
    fn problem(&self) -> Option<Words> {
        let ClothState { positions, mapped } = &*self.cloth;
        if positions.len() != mapped.len() {
            return Some(words!("the dressed cloth has places and flags of different number"));
        }
        if !positions.iter().all(|&p| crate::session::edit::is_place(p)) {
            return Some(words!("a vertex of the dressed cloth is not a finite point near the origin"));
        }
        let GarmentSource { pattern, marks, edge_length, relax } = &*self.source;
        let settings = Settings { edge_length: *edge_length, relax: *relax, ..Settings::default() };
        let problem = crate::session::edit::source_problem(pattern, marks, &settings);
        problem.map(|words| words!("what the dressed cloth was cut from: {words}", words))
    }
}
