//! The contents of the fit report, measured on the garment.

use crate::body::readings::Reading;
use crate::fit::maps::PieceStats;
use crate::fit::{self, BodyIndex, Girth, Map, MapKind, MapReader, Report, SeamFit, Tight};
use crate::pattern::Problem;
use crate::session::body::readings_of;
use crate::session::{Outfit, Session};
use crate::sim;

/// The maps of the report, in its order.
pub const MAPS: [MapKind; 5] =
    [MapKind::Warp, MapKind::Weft, MapKind::Ease, MapKind::MeanCurvature, MapKind::Pressure];

/// The contents of the report without its pictures.
#[derive(Debug)]
pub struct Facts {
    /// Name of the project.
    pub name: String,
    /// Description of the body.
    pub body: String,
    /// The garment and the body it is on.
    pub outfit: Outfit,
    /// Measurements of the garment.
    pub report: Report,
    /// Faults of the dressed garment, and problems found while building and sewing it; empty when all is well.
    pub problems: Vec<Problem>,
    /// The tightest place.
    pub tight: Option<Tight>,
    /// Body measurements; empty if the body is not a standing human.
    pub readings: Vec<Reading>,
    /// Girths of the garment at the girths of the body, each with its index in `readings`.
    pub girths: Vec<(usize, Girth)>,
    /// The fit of each seam, in id order.
    pub seams: Vec<SeamFit>,
    /// The maps, in the order of [`MAPS`].
    pub maps: Vec<MapFacts>,
    /// Strain of the pieces in warp, weft and shear, each in id order.
    pub strains: [Vec<PieceStats>; 3],
}

/// A map and the range of its colours.
#[derive(Debug)]
pub struct MapFacts {
    /// The map.
    pub map: Map,
    /// Values at the ends of the colour bar, in the map's own unit.
    pub range: [f64; 2],
}

impl Facts {
    /// Measures the garment of `session`; None while there is no cloth on the body.
    pub fn of(session: &Session, name: &str) -> Option<Self> {
        let snapshot = session.snapshot();
        let outfit = Outfit::of(snapshot, &session.document().fabrics)?;
        let Outfit { source, garment, state, body, .. } = &outfit;
        let index = BodyIndex::new(body);
        let report = fit::measure(&source.pattern, garment, state, &index);
        let faults = sim::faults(&report, source, garment, state, &index, snapshot.lies());
        let tight = fit::tightest(&report, garment, state, || body.landmarks());
        let readings = readings_of(&session.document().body, &body.mesh).unwrap_or_default();
        let reader = MapReader::new(outfit.worn());
        let (maps, strains) = (
            MAPS.map(|kind| MapFacts::from(reader.map(kind))),
            [MapKind::Warp, MapKind::Weft, MapKind::Shear].map(|kind| reader.map(kind).pieces(garment)),
        );
        Some(Self {
            name: name.to_owned(),
            body: session.document().body.name().to_owned(),
            problems: faults
                .into_iter()
                .map(|fault| fault.problem)
                .chain(snapshot.problems.iter().filter(|p| !p.kind.is_note()).cloned())
                .collect(),
            tight,
            girths: fit::girths(garment, state, &readings),
            seams: SeamFit::all(&source.pattern, garment, state),
            maps: maps.into(),
            strains,
            report,
            readings,
            outfit,
        })
    }
}

impl From<Map> for MapFacts {
    fn from(map: Map) -> Self {
        Self { range: map.range(), map }
    }
}
