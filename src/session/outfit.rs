//! Dressed cloth with everything needed for measurements and maps.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::body::Surface;
use crate::cloth::{ClothState, Fabric, Garment};
use crate::fit::Worn;
use crate::geometry::ids::PieceId;
use crate::session::fabrics::Fabrics;
use crate::sim::{GarmentSource, Snapshot};

/// A dressed garment as it is drawn and measured.
#[derive(Clone, Debug)]
pub struct Outfit {
    /// What the garment was built from.
    pub source: Arc<GarmentSource>,
    /// The cloth.
    pub garment: Arc<Garment>,
    /// Positions of the cloth.
    pub state: Arc<ClothState>,
    /// Garment and cloth including deactivated pieces, where there are some: they are shown, but not measured.
    pub whole: Option<(Arc<Garment>, Arc<ClothState>)>,
    /// The body.
    pub body: Arc<Surface>,
    /// Fabric of each piece.
    pub fabrics: BTreeMap<PieceId, Fabric>,
}

impl Outfit {
    /// The outfit of `snapshot` with these `fabrics`. None while there is no cloth on the body.
    pub fn of(snapshot: &Snapshot, fabrics: &Fabrics) -> Option<Self> {
        let (garment, state) = snapshot.drawn().filter(|_| snapshot.is_dressed())?;
        let (source, body) = (snapshot.source.as_ref()?, snapshot.body.as_ref()?);
        let sleeps = source.pattern.pieces.values().any(|piece| piece.activity.is_deactivated());
        let whole = snapshot.garment.as_ref().filter(|_| sleeps);
        Some(Self {
            whole: whole.map(|garment| (Arc::clone(garment), Arc::clone(&snapshot.cloth))),
            source: Arc::clone(source),
            garment: Arc::clone(garment),
            state: Arc::clone(state),
            body: Arc::clone(body),
            fabrics: fabrics.of(&source.pattern),
        })
    }

    /// The input of maps.
    pub fn worn(&self) -> Worn<'_> {
        Worn {
            pattern: &self.source.pattern,
            garment: &self.garment,
            state: &self.state,
            surface: &self.body,
            fabrics: &self.fabrics,
            offset: self.source.relax.offset * self.body.scale(),
        }
    }

    /// Whether this is the very same cloth on the same body, by identity: then all that can be read off it is equal.
    pub fn is(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.source, &other.source)
            && Arc::ptr_eq(&self.garment, &other.garment)
            && Arc::ptr_eq(&self.state, &other.state)
            && Arc::ptr_eq(&self.body, &other.body)
            && self.fabrics == other.fabrics
    }
}
