//! All that moves or decides how things move: what a checkpoint keeps. Copying it copies pointers.

use std::sync::Arc;

use crate::body::Surface;
use crate::cloth::{self, ClothState, Counters, Garment};
use crate::pattern::Problem;
use crate::relax::RelaxSettings;
use crate::sim::hash::cloth_hash;
use crate::sim::protocol::GarmentSource;
use crate::wrap::{Dressing, Phase, coarser};

/// The state of the simulation.
#[derive(Clone, Debug)]
pub struct World {
    /// What the garment was built from.
    pub source: Option<Arc<GarmentSource>>,
    /// What it is put on.
    pub body: Option<Arc<Surface>>,
    /// The garment.
    pub garment: Option<Arc<Garment>>,
    /// Where it is. Shared with snapshots and checkpoints until it moves.
    pub cloth: Arc<ClothState>,
    /// The wrap under way, or at rest. None for cloth that was adopted and not touched since.
    pub dressing: Option<Arc<Dressing>>,
    /// False while paused.
    pub relaxing: bool,
    /// What building and wrapping found wrong.
    pub problems: Arc<Vec<Problem>>,
}

impl Default for World {
    fn default() -> Self {
        Self {
            source: None,
            body: None,
            garment: None,
            cloth: Arc::default(),
            dressing: None,
            relaxing: true,
            problems: Arc::default(),
        }
    }
}

impl World {
    /// A garment just built and pasted to its marks.
    pub fn wrapped(source: Arc<GarmentSource>, body: Arc<Surface>) -> Self {
        let (garment, mut problems) = cloth::build(&source.pattern, source.edge_length);
        let garment = Arc::new(garment);
        let coarser = coarser(&source.pattern, &garment, source.edge_length, body.scale());
        let (dressing, cloth, more) = Dressing::coarse_to_fine(
            &coarser,
            Arc::clone(&garment),
            Arc::clone(&body),
            &source.marks,
            source.relax,
        );
        problems.extend(more);
        Self {
            source: Some(source),
            body: Some(body),
            garment: Some(garment),
            cloth: Arc::new(cloth),
            dressing: dressing.map(Arc::new),
            relaxing: true,
            problems: Arc::new(problems),
        }
    }

    /// Cloth that was dressed before. The error is in words.
    pub fn adopted(
        source: Arc<GarmentSource>,
        body: Arc<Surface>,
        cloth: Arc<ClothState>,
    ) -> Result<Self, String> {
        let (garment, problems) = cloth::build(&source.pattern, source.edge_length);
        let count = garment.vertex_count;
        if cloth.positions.len() != count || cloth.mapped.len() != count {
            return Err(format!(
                "the dressed cloth has {} vertices, the pattern it belongs to gives {count}",
                cloth.positions.len()
            ));
        }
        Ok(Self {
            source: Some(source),
            body: Some(body),
            garment: Some(Arc::new(garment)),
            cloth,
            dressing: None,
            relaxing: true,
            problems: Arc::new(problems),
        })
    }

    /// Relaxes differently from now on; cloth at rest wakes.
    pub fn set_relax(&mut self, relax: RelaxSettings) {
        if let Some(source) = &mut self.source {
            Arc::make_mut(source).relax = relax;
        }
        if self.dressing.is_none() {
            self.dressing = self.resumed(relax);
        }
        if let Some(dressing) = &mut self.dressing {
            Arc::make_mut(dressing).set_settings(relax);
        }
    }

    fn resumed(&self, relax: RelaxSettings) -> Option<Arc<Dressing>> {
        let (garment, body) = (self.garment.clone()?, self.body.clone()?);
        Dressing::resumed(garment, body, relax, &self.cloth).map(Arc::new)
    }

    /// Work done by the dressing under way or at rest.
    pub fn work(&self) -> Counters {
        self.dressing.as_ref().map(|d| d.counters()).unwrap_or_default()
    }

    /// One tick of work.
    pub fn step(&mut self) {
        if let Some(dressing) = &mut self.dressing {
            Arc::make_mut(dressing).step(Arc::make_mut(&mut self.cloth));
        }
    }

    /// How far the dressing has come; None without a garment.
    pub fn phase(&self) -> Option<Phase> {
        self.garment.as_ref()?;
        Some(self.dressing.as_ref().map_or(Phase::AtRest, |d| d.phase()))
    }

    /// 0..=1 over growing and settling.
    pub fn progress(&self) -> f64 {
        self.dressing.as_ref().map_or(1.0, |d| d.progress())
    }

    /// Whether a tick would change nothing.
    pub fn is_at_rest(&self) -> bool {
        !self.relaxing || self.dressing.as_ref().is_none_or(|d| d.phase() == Phase::AtRest)
    }

    /// Hash of what moves.
    pub fn hash(&self) -> u64 {
        cloth_hash(&self.cloth, self.phase(), self.relaxing)
    }

    /// The first mapped vertex that is not a finite point.
    pub fn not_finite(&self) -> Option<usize> {
        let cloth = &self.cloth;
        cloth.positions.iter().zip(&cloth.mapped).position(|(p, &mapped)| mapped && !p.is_finite())
    }

    /// About how much memory this keeps that `other` does not, bytes.
    pub fn bytes_beside(&self, other: Option<&World>) -> usize {
        /// Position, flag and what a dressing keeps per vertex: most of it the factored matrix.
        const PER_VERTEX: usize = 1000;
        /// Corners, rest shape and neighbours per triangle.
        const PER_TRIANGLE: usize = 250;
        const ALWAYS: usize = 256;
        let cloth_shared = other.is_some_and(|o| Arc::ptr_eq(&o.cloth, &self.cloth));
        let cloth = if cloth_shared { 0 } else { self.cloth.positions.len() * PER_VERTEX };
        let garment = match (&self.garment, other.and_then(|o| o.garment.as_ref())) {
            (Some(a), Some(b)) if Arc::ptr_eq(a, b) => 0,
            (Some(a), _) => a.triangles.len() * PER_TRIANGLE,
            (None, _) => 0,
        };
        ALWAYS + cloth + garment
    }
}
