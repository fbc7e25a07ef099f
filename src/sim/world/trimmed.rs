//! Trims of dressed cloth: what changes them alone leaves the mesh, and the cloth where it is.

use std::sync::Arc;

use crate::cloth::Garment;
use crate::pattern::triangulate::Meshes;
use crate::pattern::{Problem, Trims};
use crate::sim::source::{ClothPlace, GarmentSource};
use crate::sim::world::World;

/// A garment just built from an edited pattern.
pub(in crate::sim) struct Built {
    pub source: Arc<GarmentSource>,
    pub garment: Arc<Garment>,
    pub problems: Vec<Problem>,
    pub meshes: Arc<Meshes>,
}

impl World {
    /// The dressed cloth with the trims of `built`; draping goes on with them. None where more than trims changed.
    pub(in crate::sim) fn retrimmed(&self, built: &Built, places: &Arc<Vec<ClothPlace>>) -> Option<Self> {
        let old = self.garment.as_ref().filter(|_| self.sewing.is_none())?;
        let new = &built.garment;
        let is_same_mesh = old.triangles == new.triangles && old.corners == new.corners;
        if old.trims == new.trims || !is_same_mesh {
            return None;
        }
        let mut world = Self {
            source: Some(Arc::clone(&built.source)),
            garment: Some(Arc::clone(new)),
            problems: Arc::new(built.problems.clone()),
            meshes: Arc::clone(&built.meshes),
            ..self.clone()
        };
        world.set_pins(places);
        world.drape_anew();
        Some(world)
    }

    /// Where physics moved the cloth, and zips were opened or lines folded since `before`: lets it go on. False otherwise.
    pub(in crate::sim) fn worked_as_draped(&mut self, before: &Self) -> bool {
        let worked = |world: &Self| -> (Vec<Option<[f64; 2]>>, Vec<Trims>) {
            let Some(pattern) = world.source.as_ref().map(|source| &source.pattern) else {
                return Default::default();
            };
            let zips = pattern.seams.values().filter_map(|seam| seam.zip);
            let lines = pattern.pieces.values().flat_map(|piece| {
                piece.loops().flatten().chain(piece.lines.iter().flat_map(|line| &line.edges))
            });
            let trims = lines.map(|edge| edge.trims.physical()).filter(|trims| !trims.is_none());
            (zips.map(|zip| zip.closed()).collect(), trims.collect())
        };
        let is_worked = before.is_draped() && worked(self) != worked(before);
        if is_worked {
            self.drape_like(before);
        }
        is_worked
    }
}
