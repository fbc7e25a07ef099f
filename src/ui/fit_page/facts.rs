//! What the page tells, read off the garment.

use crate::body::landmarks;
use crate::body::readings::Reading;
use crate::fit::maps::PieceStats;
use crate::fit::{self, BodyIndex, Girth, Map, MapKind, MapReader, Report, SeamFit};
use crate::pattern::Problem;
use crate::session::body::readings_of;
use crate::session::{Outfit, Session};
use crate::sim;

/// Maps of the page, in its order.
pub const MAPS: [MapKind; 5] =
    [MapKind::Warp, MapKind::Weft, MapKind::Ease, MapKind::MeanCurvature, MapKind::Pressure];

/// Everything on the page but its pictures.
#[derive(Debug)]
pub struct Facts {
    /// Of the project.
    pub name: String,
    /// Of the body.
    pub body: String,
    /// The garment and the body it lies on.
    pub outfit: Outfit,
    /// Its figures.
    pub report: Report,
    /// Why it is not a dressed garment, and what building and sewing found; empty when all is well.
    pub problems: Vec<Problem>,
    /// Where it is tightest, in words.
    pub tight: Option<String>,
    /// What the tape reads on the body; empty of what is no standing human.
    pub readings: Vec<Reading>,
    /// Round the garment where the body's girths were taken, by their place in `readings`.
    pub girths: Vec<(usize, Girth)>,
    /// Seams in id order.
    pub seams: Vec<SeamFit>,
    /// Each of [`MAPS`].
    pub maps: Vec<MapFacts>,
    /// Of warp, weft and shear, by piece in id order.
    pub strains: [Vec<PieceStats>; 3],
}

/// A map.
#[derive(Debug)]
pub struct MapFacts {
    /// The map.
    pub map: Map,
    /// What its colours span, in its own unit.
    pub range: [f64; 2],
}

impl Facts {
    /// None while there is no cloth on the body.
    pub fn of(session: &Session, name: &str) -> Option<Self> {
        let snapshot = session.snapshot();
        let outfit = Outfit::of(snapshot, &session.document().fabrics)?;
        let Outfit { source, garment, state, body, .. } = &outfit;
        let index = BodyIndex::new(body);
        let report = fit::measure(&source.pattern, garment, state, &index);
        let faults = sim::faults(&report, source, garment, state, &index, snapshot.lies());
        let tight = fit::tightest(&report, garment, state, || landmarks::found(&body.mesh));
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
            tight: tight.map(|tight| tight.to_string()),
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
