//! Causes of strain: the pattern is smaller than the body, a seam joins unequal sides, or the simulation did not converge.

use std::collections::{BTreeMap, BTreeSet};

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::body::readings::Reading;
use crate::cloth::{ClothState, Garment};
use crate::fit::girth::girths;
use crate::fit::laid::Laid;
use crate::fit::on_body::BodyIndex;
use crate::fit::openings::Opening;
use crate::fit::shape::quantile;
use crate::geometry::words::{Words, decimal, words};

/// Strain above which the cause of an edge is determined.
pub const STRAINED: f64 = 0.02;
/// Relative difference in length above which the sides of a seam count as unequal.
const UNEQUAL: f64 = 0.01;
/// An edge counts as stretched round the body when the edges about it together are strained by at least this share of its own
/// strain. Round a tube only edges in the circumferential direction are stretched, those along the tube are not.
const TOGETHER: f64 = 0.25;
/// Distance from the skin below which cloth counts as pressed on to it, metres.
const ON_SKIN: f64 = 0.015;
/// Differences in girth between pattern and body up to this are not reported, metres.
const LEAST_SMALLER: f64 = 1e-3;

/// Edges strained for one cause.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Strained {
    /// Number of edges.
    pub edges: usize,
    /// Largest |l / l0 - 1| among them.
    pub max: f64,
}

impl Strained {
    fn add(&mut self, strain: f64) {
        self.edges += 1;
        self.max = self.max.max(strain.abs());
    }
}

/// Difference in girth above which it is told that the pattern is smaller than the body, metres.
const TOO_SMALL: f64 = 0.01;

/// A place where the pattern is smaller than the body.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Smaller {
    /// Name of the body measure: `waist`.
    pub place: String,
    /// Girth of the body, metres.
    pub body: f64,
    /// Girth of the pattern there, metres.
    pub pattern: f64,
}

impl Smaller {
    /// It in words.
    pub fn words(&self) -> Words {
        let [body, pattern] = [self.body, self.pattern].map(|metres| metres * 100.0);
        words!(
            "the pattern is {cm} cm smaller than the body round the {place} ({pattern} for {body} cm)",
            cm = decimal(body - pattern, 1),
            place = Words::listed(&*self.place),
            pattern = decimal(pattern, 1),
            body = decimal(body, 1)
        )
    }
}

/// Edges strained by more than [`STRAINED`], by cause.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Causes {
    /// On the skin and stretched together with the cloth about them: the piece is too small.
    pub fit: Strained,
    /// On a seam of two unequal sides, with a length between theirs.
    pub seam_ease: Strained,
    /// All others: the simulation did not come to rest there.
    pub unconverged: Strained,
    /// Places where the pattern is smaller than the body, the largest difference first. Filled only for a garment that has faults
    /// and [is tight](Self::is_tight) or has openings through which the body does not pass.
    pub smaller: Vec<Smaller>,
}

impl Causes {
    /// Whether more than a hundredth of the garment's `edges` are strained because the piece is too small.
    pub fn is_tight(&self, edges: usize) -> bool {
        self.fit.edges * 100 > edges
    }

    /// Where the pattern is so much smaller than the body that this is told.
    pub fn too_small(&self) -> Option<&Smaller> {
        self.smaller.first().filter(|smaller| smaller.body - smaller.pattern > TOO_SMALL)
    }
}

/// Determines the cause of each strained edge.
pub(super) fn causes(garment: &Garment, laid: &Laid, body: &BodyIndex<'_>, edges: &[Edge]) -> Causes {
    let sides = unequal_sides(garment);
    let mut about: BTreeMap<u32, [f64; 2]> = BTreeMap::new();
    for edge in edges {
        for v in edge.ends {
            let sum = about.entry(v).or_default();
            *sum = [sum[0] + edge.worn - edge.flat, sum[1] + edge.flat];
        }
    }
    let together = |v: u32| about.get(&v).map_or(0.0, |[longer, flat]| longer / flat);
    let on_skin = |v: u32| {
        let p = laid.mesh.positions[v as usize];
        body.surface().nearest(p).point.distance(p) < ON_SKIN
    };
    let mut causes = Causes::default();
    for edge in edges {
        let strain = edge.worn / edge.flat - 1.0;
        if strain.abs() <= STRAINED {
            continue;
        }
        let is_tight = || strain > 0.0 && edge.ends.iter().all(|&v| together(v) > TOGETHER * strain);
        let cause = if is_eased(edge, &sides) {
            &mut causes.seam_ease
        } else if is_tight() && edge.ends.iter().all(|&v| on_skin(v)) {
            &mut causes.fit
        } else {
            &mut causes.unconverged
        };
        cause.add(strain);
    }
    causes
}

/// 99th percentile of |l / l0 - 1|, without edges eased on a seam of unequal sides: there a gather is intended.
pub(super) fn uneased_p99(garment: &Garment, edges: &[Edge]) -> f64 {
    let sides = unequal_sides(garment);
    let uneased = edges.iter().filter(|edge| !is_eased(edge, &sides));
    let mut strains: Vec<f64> = uneased.map(|edge| (edge.worn / edge.flat - 1.0).abs()).collect();
    strains.sort_unstable_by(f64::total_cmp);
    quantile(&strains, 0.99)
}

/// Whether `edge` is on a seam of unequal sides and its length is between theirs. `sides` as [`unequal_sides`] returns them.
fn is_eased(edge: &Edge, sides: &BTreeMap<[u32; 2], [f64; 2]>) -> bool {
    let is_between =
        |[low, high]: &[f64; 2]| (low * (1.0 - STRAINED)..=high * (1.0 + STRAINED)).contains(&edge.worn);
    sides.get(&edge.ends).is_some_and(is_between)
}

/// An edge of the laid cloth: one between two triangles of a piece is listed once, one on a seam once for each side.
pub(super) struct Edge {
    ends: [u32; 2],
    flat: f64,
    worn: f64,
}

/// The edges of the laid cloth.
pub(super) fn edges(garment: &Garment, laid: &Laid) -> Vec<Edge> {
    let mut sides: Vec<[u32; 2]> = laid
        .corners
        .iter()
        .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]])
        .map(|[a, b]| [a.min(b), a.max(b)])
        .collect();
    sides.sort_unstable();
    sides.dedup();
    let edge = |corners: [u32; 2]| {
        let [a, b] = corners.map(|c| garment.corners[c as usize]);
        let [p, q] = [a, b].map(|corner| laid.mesh.positions[corner.vertex as usize]);
        let ends = [a.vertex.min(b.vertex), a.vertex.max(b.vertex)];
        Edge { ends, flat: a.uv.distance(b.uv), worn: p.distance(q) }
    };
    sides.into_iter().map(edge).filter(|edge| edge.flat > 0.0).collect()
}

/// Flat lengths (metres, shorter first) of the edges on seams with two unequal sides, by their sorted vertices.
fn unequal_sides(garment: &Garment) -> BTreeMap<[u32; 2], [f64; 2]> {
    let mut found = BTreeMap::new();
    for (_, pairs) in &garment.seam_pairs {
        for pair in pairs.windows(2) {
            let flat = [0, 1].map(|side| {
                let [a, b] = [0, 1].map(|k| garment.corners[pair[k][side] as usize]);
                (a.piece == b.piece).then(|| a.uv.distance(b.uv))
            });
            let [Some(one), Some(other)] = flat else { continue };
            let (low, high) = (one.min(other), one.max(other));
            if high > low * (1.0 + UNEQUAL) {
                let [a, b] = [0, 1].map(|k| garment.corners[pair[k][0] as usize].vertex);
                found.insert([a.min(b), a.max(b)], [low, high]);
            }
        }
    }
    found
}

/// The length of an edge on its flat piece, metres, by its vertices; on a seam that of the shorter side.
pub(super) fn flat_lengths(edges: &[Edge]) -> impl Fn([u32; 2]) -> f64 + use<> {
    let mut all: Vec<([u32; 2], f64)> = edges.iter().map(|e| (e.ends, e.flat)).collect();
    all.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    move |[a, b]| {
        let ends = [a.min(b), a.max(b)];
        all.get(all.partition_point(|(of, _)| *of < ends))
            .filter(|(of, _)| *of == ends)
            .map_or(0.0, |(_, l)| *l)
    }
}

/// Places where the girth of the pattern is smaller than that of the body, the largest difference first. The openings `missed` are
/// those through which the body does not pass.
pub(super) fn smaller(
    garment: &Garment,
    state: &ClothState,
    body: &BodyIndex<'_>,
    missed: &[Opening],
) -> Vec<Smaller> {
    let Some(readings) = body.surface().readings() else { return Vec::new() };
    let mut found: Vec<Smaller> = girths(garment, state, readings)
        .into_iter()
        .map(|(i, girth)| {
            let place = readings[i].name.to_owned();
            Smaller { place, body: readings[i].metres, pattern: girth.flat }
        })
        .chain(missed.iter().filter_map(|opening| narrow(opening, readings)))
        .filter(|smaller| smaller.body - smaller.pattern > LEAST_SMALLER)
        .collect();
    found.sort_by(|a, b| (b.body - b.pattern).total_cmp(&(a.body - a.pattern)));
    let mut places = BTreeSet::new();
    found.retain(|smaller| places.insert(smaller.place.clone()));
    found
}

/// The opening against the girth nearest to it, which is of a left limb: both sides are taken to be alike. None far from all of them,
/// or where it is too short to go round.
fn narrow(opening: &Opening, readings: &[Reading]) -> Option<Smaller> {
    let middle = readings.iter().find_map(|reading| reading.tape.as_ref()).map(|tape| tape.origin.x)?;
    let p = opening.middle;
    let left = DVec3::new(middle + (p.x - middle).abs(), p.y, p.z);
    let far =
        |reading: &Reading| reading.tape.as_ref().map_or(f64::INFINITY, |tape| tape.origin.distance(left));
    let nearest = readings.iter().min_by(|a, b| far(a).total_cmp(&far(b)))?;
    // Between two girths of a limb there may be a thinner place, and a hole in a seam is no sleeve.
    let goes_round = far(nearest) < 0.1 && opening.flat_length > nearest.metres / 2.0;
    goes_round.then(|| Smaller {
        place: nearest.name.to_owned(),
        body: nearest.metres,
        pattern: opening.flat_length,
    })
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::body::measure::Tape;
    use crate::cloth::build;
    use crate::fit::maps::tests::{Sheets, sheets, tube};
    use crate::pattern::{EdgeRef, Pattern, Piece, Seam};

    fn of(laid: &Sheets) -> Causes {
        let Sheets { garment, state, surface, .. } = laid;
        let laid = Laid::new(garment, state);
        causes(garment, &laid, &BodyIndex::new(surface), &edges(garment, &laid))
    }

    #[test]
    fn a_tube_that_is_too_narrow_does_not_fit() {
        let found = of(&tube(24, 0.08, 1.05, 1.0));
        assert!((found.fit.max - 0.05).abs() < 1e-9, "{found:?}");
        assert_eq!((found.seam_ease.edges, found.unconverged.edges), (0, 0), "{found:?}");
        assert_eq!(of(&tube(24, 0.08, 1.0, 1.0)), Causes::default());
    }

    #[test]
    fn one_edge_alone_or_far_from_the_skin_did_not_come_to_rest() {
        let far = of(&sheets(0.03, |p| DVec3::new(p.x * 1.04, p.y, 0.3)));
        assert!(far.unconverged.edges > 0 && far.fit.edges == 0, "{far:?}");
        let mut laid = tube(24, 0.08, 1.0, 1.0);
        laid.state.positions[60].y += 0.002;
        let found = of(&laid);
        assert!(found.unconverged.edges > 0 && found.fit.edges < found.unconverged.edges, "{found:?}");
    }

    #[test]
    fn what_lies_between_the_sides_of_a_gather_is_eased() {
        let mut pattern = Pattern::default();
        let short = pattern.add_piece(Piece::polygon("short", &square(0.30)));
        let long = pattern.add_piece(Piece::polygon("long", &square(0.33)));
        let sides = [EdgeRef { piece: short, edge: 1 }, EdgeRef { piece: long, edge: 3 }];
        pattern.add_seam(Seam::of_edges(sides, false));
        let (garment, _) = build(&pattern, 0.03);
        let mut laid = sheets(0.03, |p| p.extend(0.0));
        let place = |c: &crate::cloth::Corner| match c.piece == short {
            true => c.uv.extend(0.3),
            false => DVec3::new(0.3 + c.uv.x, c.uv.y * 0.3 / 0.33, 0.3),
        };
        laid.state.positions = vec![DVec3::ZERO; garment.vertex_count];
        laid.state.mapped = vec![true; garment.vertex_count];
        garment.corners.iter().for_each(|c| laid.state.positions[c.vertex as usize] = place(c));
        laid.garment = garment;
        let found = of(&laid);
        assert!((found.seam_ease.max - 0.1 / 1.1).abs() < 1e-6, "{found:?}");
        assert_eq!((found.seam_ease.edges, found.fit.edges), (11, 0), "{found:?}");
        // Pressed less and less away from the seam: its own edges, pressed the most, are left out.
        let taper = |c: &crate::cloth::Corner| match c.piece == short {
            true => place(c),
            false => {
                let pressed = 0.1 / 1.1 * (1.0 - c.uv.x / 0.3);
                DVec3::new(0.3 + c.uv.x, c.uv.y * (1.0 - pressed), 0.3)
            }
        };
        let Sheets { garment, state, .. } = &mut laid;
        garment.corners.iter().for_each(|c| state.positions[c.vertex as usize] = taper(c));
        let uneased = uneased_p99(garment, &edges(garment, &Laid::new(garment, state)));
        assert!((0.07..0.1 / 1.1 * 0.97).contains(&uneased), "{uneased}");
    }

    #[test]
    fn an_opening_is_held_against_the_limb_beside_it() {
        let girth = |name, metres, x| Reading {
            name,
            metres,
            tape: Some(Tape { name, origin: DVec3::new(x, 1.3, 0.0), normal: DVec3::X }),
            ..Reading::default()
        };
        let readings = [girth("bust", 0.9, 0.0), girth("upper arm", 0.31, 0.3)];
        let opening =
            |x| Opening { flat_length: 0.23, middle: DVec3::new(x, 1.32, 0.0), ..Opening::default() };
        for x in [-0.28, 0.28] {
            let found = narrow(&opening(x), &readings).expect("beside an arm");
            assert_eq!((&*found.place, found.body, found.pattern), ("upper arm", 0.31, 0.23));
        }
        assert_eq!(narrow(&opening(0.6), &readings), None, "far out");
        let hole = Opening { flat_length: 0.05, ..opening(0.28) };
        assert_eq!(narrow(&hole, &readings), None, "a hole in a seam");
    }

    fn square(height: f64) -> [DVec2; 4] {
        [(0.0, 0.0), (0.3, 0.0), (0.3, height), (0.0, height)].map(DVec2::from)
    }
}
