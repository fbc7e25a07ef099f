//! Sewing a garment together from the placement of its pieces.

use std::sync::Arc;

use glam::DVec3;

use crate::body::Surface;
use crate::cloth::{self, ClothState, Garment, Skips};
use crate::drape::garment::clear::cleared;
use crate::drape::garment::sewing::{Sewing, Stage};
use crate::drape::{DrapedSettings, Undrapable};
use crate::fit::{ShortSeam, short_seams};
use crate::geometry::ids::PieceId;
use crate::geometry::words::{Words, decimal, words};
use crate::pattern::naming;
use crate::pattern::triangulate::Meshes;
use crate::pattern::{Problem, ProblemKind};
use crate::place::{Turned, led};
use crate::sim::source::DrapeSource;
use crate::sim::source::GarmentSource;
use crate::sim::world::{World, unlaid};

/// A garment sewn in layers, the innermost first, each over those already worn (paper B, "multi-layer").
#[derive(Debug)]
pub struct Outfit {
    garment: Arc<Garment>,
    /// Placement of each flat corner, metres; None: not placed.
    places: Vec<Option<DVec3>>,
    fabrics: Arc<DrapeSource>,
}

impl Outfit {
    /// The lowest layer above `inner`, or of all, that has a placed piece.
    fn next(&self, inner: Option<u8>) -> Option<u8> {
        let placed = self.garment.corners.iter().zip(&self.places).filter(|(_, place)| place.is_some());
        let layers = placed.map(|(corner, _)| self.garment.layer(corner.piece));
        layers.filter(|&layer| inner.is_none_or(|inner| layer > inner)).min()
    }

    /// Whether a seam joins `layer` to one below it.
    fn is_sewn_on(&self, layer: u8) -> bool {
        let layer_of = |corner: u32| self.garment.layer(self.garment.corners[corner as usize].piece);
        let is_across = |pair: &[u32; 2]| {
            let [a, b] = pair.map(layer_of);
            a.max(b) == layer && a != b
        };
        self.garment.seam_pairs.iter().any(|(_, pairs)| pairs.iter().any(is_across))
    }

    /// Begins to sew `layer` over the laid part of `worn`.
    fn begun(
        &self,
        layer: u8,
        worn: &ClothState,
        body: &Arc<Surface>,
        skips: Skips,
    ) -> Result<(Sewing, ClothState), Undrapable> {
        let settings = DrapedSettings { strain: self.fabrics.strain, self_collision: true, skips };
        let of = (&self.fabrics.of_pieces, &self.fabrics.fabric);
        let now = |piece: PieceId| self.garment.layer(piece) == layer;
        let places = cleared(&self.garment, worn, &self.places, &now);
        let stage = Stage { places: &places, now: &now, worn };
        Sewing::new(Arc::clone(&self.garment), stage, Arc::clone(body), of, settings)
    }
}

/// The sewing of a layer in progress.
#[derive(Clone, Debug)]
pub struct Placed {
    sewing: Sewing,
    outfit: Arc<Outfit>,
    layer: u8,
}

impl Placed {
    /// Progress, 0..=1.
    pub fn progress(&self) -> f64 {
        self.sewing.progress()
    }

    /// Whether a tick is partly done.
    pub(super) fn is_mid_tick(&self) -> bool {
        self.sewing.is_mid_tick()
    }
}

impl World {
    /// A garment just built, with sewing from the placement of its pieces begun. Draping follows.
    pub fn placed(
        source: Arc<GarmentSource>,
        body: Arc<Surface>,
        fabrics: Arc<DrapeSource>,
    ) -> Result<Self, Words> {
        let mut meshes = Meshes::default();
        let (garment, mut problems) = cloth::build_again(&source.pattern, source.edge_length, &mut meshes);
        let garment = Arc::new(garment);
        let turned = Turned::new(&source.pattern);
        let place = |corner: &cloth::Corner| -> Option<DVec3> {
            let pose = source.pattern.pieces.get(&corner.piece)?.placement?;
            Some(turned.at(corner.piece, &pose, corner.uv))
        };
        let places: Vec<Option<DVec3>> = garment.corners.iter().map(place).collect();
        let places = led(&garment, &body, &places);
        for (id, name) in &garment.pieces {
            if source.pattern.pieces.get(id).is_some_and(|piece| piece.placement.is_none()) {
                let words = words!("it is not placed in space; it stays in the pattern");
                let place = words!("{name} ({id})", name, id);
                problems.push(Problem { kind: ProblemKind::Dressing, place, words });
            }
        }
        let outfit = Outfit { garment: Arc::clone(&garment), places, fabrics };
        let layer = outfit.next(None).ok_or_else(|| words!("none of its pieces is placed in space"))?;
        let (sewing, cloth) = outfit
            .begun(layer, &unlaid(&garment), &body, source.relax.skips)
            .map_err(|Undrapable(words)| words)?;
        Ok(Self {
            source: Some(source),
            body: Some(body),
            garment: Some(Arc::clone(sewing.garment())),
            cloth: Arc::new(cloth),
            sewing: Some(Arc::new(Placed { sewing, outfit: Arc::new(outfit), layer })),
            problems: Arc::new(problems),
            meshes: Arc::new(meshes),
            ..Self::default()
        })
    }

    /// Starts the sewing again with changed `source` and `body`; None while nothing is being sewn.
    pub(in crate::sim) fn placed_again(
        &self,
        source: Arc<GarmentSource>,
        body: Arc<Surface>,
    ) -> Option<Result<Self, Words>> {
        let fabrics = Arc::clone(&self.sewing.as_ref()?.outfit.fabrics);
        let places = Arc::clone(&self.places);
        Some(Self::placed(source, body, fabrics).map(|world| Self { places, ..world }))
    }

    /// Does a tick of sewing, or a part of one.
    pub(in crate::sim) fn sew(&mut self) {
        let Some(placed) = self.sewing.as_mut().map(Arc::make_mut) else { return };
        let ticked = placed.sewing.go_on(Arc::make_mut(&mut self.cloth));
        self.separated = self.separated.and(placed.sewing.take_separation());
        match ticked {
            Ok(false) => {}
            Ok(true) => self.finish_sewing(),
            Err(Undrapable(words)) => {
                self.sewing = None;
                self.tell(words!("garment"), words);
            }
        }
    }

    fn finish_sewing(&mut self) {
        let Some(placed) = self.sewing.take() else { return };
        let sewn = placed.sewing.merged(&self.cloth);
        let outfit = &placed.outfit;
        self.garment = Some(Arc::clone(&outfit.garment));
        self.cloth = Arc::new(ClothState::clone(&sewn.cloth));
        (self.was_sewn, self.seams_unseen) = (true, true);
        self.outer = outfit.next(Some(placed.layer)).map(|layer| (Arc::clone(outfit), layer));
        // Half a garment would slide off: what is sewn on to it comes before its weight does.
        if self.outer.as_ref().is_some_and(|(outfit, layer)| outfit.is_sewn_on(*layer)) {
            return self.sew_next_layer();
        }
        self.part_active();
        self.drape_for(None, Arc::clone(&outfit.fabrics));
        self.begin_moving(&sewn.velocities);
        self.set_pins(&Arc::clone(&self.places));
    }

    /// Once sewn cloth rests, reports seams that are too short for this body. Earlier, skin or folds may hold them open.
    pub(in crate::sim) fn tell_short_seams(&mut self) {
        let Some(garment) = self.garment.clone().filter(|_| std::mem::take(&mut self.seams_unseen)) else {
            return;
        };
        for ShortSeam { seam, stretch, missing } in short_seams(&garment, &self.cloth) {
            let words = words!(
                "it does not come together round this body: {mm} mm are missing; the cloth beside it is stretched by up to {percent} %",
                mm = decimal(missing * 1e3, 1),
                percent = decimal(stretch * 100.0, 1)
            );
            let pattern = self.source.as_ref().map(|source| &source.pattern);
            let place = pattern.map_or_else(|| seam.into(), |pattern| naming::seam_place(pattern, seam));
            self.tell(place, words);
        }
    }

    /// Once the cloth rests, begins to sew the next layer, if there is one.
    pub(in crate::sim) fn sew_next_layer(&mut self) {
        let Some((outfit, layer)) = self.outer.take() else { return };
        let (Some(body), Some(source)) = (&self.body, &self.source) else { return };
        match outfit.begun(layer, &self.cloth, body, source.relax.skips) {
            Ok((sewing, cloth)) => {
                (self.draping, self.splits) = (None, None);
                self.garment = Some(Arc::clone(sewing.garment()));
                self.cloth = Arc::new(cloth);
                self.sewing = Some(Arc::new(Placed { sewing, outfit, layer }));
            }
            Err(Undrapable(words)) => self.tell(words!("garment"), words),
        }
    }

    pub(in crate::sim) fn tell(&mut self, place: Words, words: Words) {
        let problem = Problem { kind: ProblemKind::Dressing, place, words };
        Arc::make_mut(&mut self.problems).push(problem);
    }
}
