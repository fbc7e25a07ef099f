//! Sewing a garment together from where its pieces were placed.

use std::sync::Arc;

use glam::DVec3;

use crate::body::Surface;
use crate::cloth::{self, ClothState, Garment};
use crate::drape::sewing::Sewing;
use crate::drape::{Undrapable, WornSettings};
use crate::pattern::triangulate::Meshes;
use crate::pattern::{Problem, ProblemKind};
use crate::sim::draped::DrapeSource;
use crate::sim::protocol::GarmentSource;
use crate::sim::world::World;

/// Pieces on their way to one another.
#[derive(Clone, Debug)]
pub struct Placed {
    sewing: Sewing,
    garment: Arc<Garment>,
    pub(super) fabrics: Arc<DrapeSource>,
}

impl Placed {
    /// 0..=1.
    pub fn progress(&self) -> f64 {
        self.sewing.progress()
    }
}

impl World {
    /// A garment just built, its pieces where they were placed. Draping follows the sewing.
    pub fn placed(
        source: Arc<GarmentSource>,
        body: Arc<Surface>,
        fabrics: Arc<DrapeSource>,
    ) -> Result<Self, String> {
        let mut meshes = Meshes::default();
        let (garment, mut problems) = cloth::build_again(&source.pattern, source.edge_length, &mut meshes);
        let garment = Arc::new(garment);
        let place = |corner: &cloth::Corner| -> Option<DVec3> {
            let pose = source.pattern.pieces.get(&corner.piece)?.placement?;
            Some(pose.rotation * corner.uv.extend(0.0) + pose.translation)
        };
        let places: Vec<Option<DVec3>> = garment.corners.iter().map(place).collect();
        for (id, name) in &garment.pieces {
            if source.pattern.pieces.get(id).is_some_and(|piece| piece.placement.is_none()) {
                let words = "it is not placed in space; it stays in the pattern".to_owned();
                let place = format!("{name} ({id})");
                problems.push(Problem { kind: ProblemKind::Dressing, place, words });
            }
        }
        let settings =
            WornSettings { strain: fabrics.strain, self_collision: true, skips: source.relax.skips };
        let of = (&fabrics.of_pieces, &fabrics.fabric);
        let (sewing, cloth) = Sewing::new(Arc::clone(&garment), &places, Arc::clone(&body), of, settings)
            .map_err(|Undrapable(words)| words)?;
        Ok(Self {
            source: Some(source),
            body: Some(body),
            garment: Some(Arc::clone(sewing.garment())),
            cloth: Arc::new(cloth),
            sewing: Some(Arc::new(Placed { sewing, garment, fabrics })),
            problems: Arc::new(problems),
            meshes: Arc::new(meshes),
            ..Self::default()
        })
    }

    /// The same again, of what has changed meanwhile.
    pub(super) fn placed_again(
        &self,
        source: Arc<GarmentSource>,
        body: Arc<Surface>,
    ) -> Option<Result<Self, String>> {
        let fabrics = Arc::clone(&self.sewing.as_ref()?.fabrics);
        let places = Arc::clone(&self.places);
        Some(Self::placed(source, body, fabrics).map(|world| Self { places, ..world }))
    }

    /// A tick of sewing.
    pub(super) fn sew(&mut self) {
        let Some(placed) = self.sewing.as_mut().map(Arc::make_mut) else { return };
        match placed.sewing.tick(Arc::make_mut(&mut self.cloth)) {
            Ok(false) => {}
            Ok(true) => self.finish_sewing(),
            Err(Undrapable(words)) => {
                self.sewing = None;
                self.tell("garment".to_owned(), words);
            }
        }
    }

    fn finish_sewing(&mut self) {
        let Some(placed) = self.sewing.take() else { return };
        let sewn = placed.sewing.merged(&self.cloth);
        self.garment = Some(Arc::clone(&placed.garment));
        self.cloth = Arc::new(ClothState::clone(&sewn.cloth));
        for (seam, gap) in sewn.open {
            let words = format!(
                "it does not come together round this body: {:.1} mm are missing; it was pulled shut",
                gap * 1e3
            );
            self.tell(seam.to_string(), words);
        }
        self.drape_for(None, Arc::clone(&placed.fabrics));
        self.begin_moving(&sewn.velocities);
        self.set_pins(&Arc::clone(&self.places));
    }

    pub(super) fn tell(&mut self, place: String, words: String) {
        let problem = Problem { kind: ProblemKind::Dressing, place, words };
        Arc::make_mut(&mut self.problems).push(problem);
    }
}
