//! Coarse to fine: a garment of many triangles is dressed in a coarser mesh, and its own mesh settles from there. Sewing and
//! draping take hundreds of ticks in any mesh, and each tick of a finer one needs more small steps.

use std::sync::Arc;

use crate::body::Surface;
use crate::cloth::{self, Carry, Skip};
use crate::fit::Moved;
use crate::geometry::words::Words;
use crate::sim::source::{DrapeSource, GarmentSource};
use crate::sim::start::{Start, StartChoice};
use crate::sim::world::{World, unlaid};

/// Largest number of triangles of a garment that is dressed in its own mesh from the start.
const MOST_TRIANGLES: f64 = 6000.0;
/// Number of triangles of the coarser mesh: enough to follow arms and necks.
const COARSE_TRIANGLES: f64 = 4000.0;

/// Edge length (metres) of the coarser mesh in which the garment of `source` is dressed first. None: in its own mesh.
pub(super) fn coarse_edge(source: &GarmentSource) -> Option<f64> {
    let area: f64 = source.pattern.pieces.values().map(|piece| piece.signed_area().abs()).sum();
    let count = area / (3.0f64.sqrt() / 4.0 * source.edge_length.powi(2));
    let is_large = count > MOST_TRIANGLES && source.relax.skips.allow(Skip::Fine);
    is_large.then(|| source.edge_length * (count / COARSE_TRIANGLES).sqrt())
}

impl World {
    /// Begins to sew a garment from the placement of its pieces; one of many triangles as the only start that is tried. The error is
    /// in words.
    pub(in crate::sim) fn sewn(
        source: Arc<GarmentSource>,
        body: Arc<Surface>,
        fabrics: Arc<DrapeSource>,
    ) -> Result<Self, Words> {
        let choice = StartChoice { only: Some(Start::Placement), draped: true };
        match coarse_edge(&source) {
            None => Self::placed(source, body, fabrics),
            Some(_) => Self::dressed(source, body.into(), fabrics, choice),
        }
    }

    /// This cloth carried to a mesh with edges of `edge_length` metres, where it is draped if it was draped before, else relaxed.
    pub(in crate::sim) fn refined(self, edge_length: f64, fabrics: Arc<DrapeSource>) -> Self {
        let (Some(source), Some(coarse)) = (&self.source, &self.garment) else { return self };
        let source = Arc::new(GarmentSource { edge_length, ..GarmentSource::clone(source) });
        let mut meshes = Arc::clone(&self.meshes);
        let (garment, _) = cloth::build_again(&source.pattern, edge_length, Arc::make_mut(&mut meshes));
        let garment = Arc::new(garment);
        let mut cloth = unlaid(&garment);
        Carry::new(coarse, &garment).places(&self.cloth, &mut cloth);
        let mut fine = Self {
            source: Some(source),
            body: self.body,
            garment: Some(garment),
            cloth: Arc::new(cloth),
            relaxing: self.relaxing,
            problems: self.problems,
            meshes,
            moved: self.moved,
            was_sewn: self.was_sewn,
            hung_at: self.hung_at,
            separated: self.separated,
            ..Self::default()
        };
        fine.part_active();
        match fine.moved {
            Moved::Draped => fine.drape_for(None, fabrics),
            Moved::Wrapped | Moved::Carried => fine.settle(),
        }
        fine.set_pins(&self.places);
        fine
    }
}
