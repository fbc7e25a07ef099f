//! Coarse to fine: a garment of many triangles is put on in a coarser mesh, from which the fine one goes on. Pieces come together,
//! and cloth comes down, in hundreds of ticks whatever the mesh, and finer ones need more small steps in each.

use std::sync::Arc;

use crate::cloth::{self, Carry, Skip};
use crate::sim::source::{DrapeSource, GarmentSource};
use crate::sim::world::{World, unlaid};

/// Most triangles of a garment that is put on in its own mesh.
const MOST_TRIANGLES: f64 = 6000.0;
/// Triangles of the coarser mesh: it must follow arms and necks as the fine one does.
const COARSE_TRIANGLES: f64 = 4000.0;

/// The edge length, metres, of the mesh in which the garment of `source` is put on first; None: in its own.
pub(in crate::sim) fn coarse_edge(source: &GarmentSource) -> Option<f64> {
    let area: f64 = source.pattern.pieces.values().map(|piece| piece.signed_area().abs()).sum();
    let count = area / (3.0f64.sqrt() / 4.0 * source.edge_length.powi(2));
    let is_large = count > MOST_TRIANGLES && source.relax.skips.allow(Skip::Fine);
    is_large.then(|| source.edge_length * (count / COARSE_TRIANGLES).sqrt())
}

impl World {
    /// The same cloth in a mesh with edges of `edge_length` metres; it settles, or drapes where it was draped.
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
            was_draped: self.was_draped,
            was_sewn: self.was_sewn,
            separated: self.separated,
            ..Self::default()
        };
        fine.part_active();
        match fine.was_draped {
            true => fine.drape_for(None, fabrics),
            false => fine.settle(),
        }
        fine.set_pins(&self.places);
        fine
    }
}
