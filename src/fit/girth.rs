//! Girths of a garment: the length of the cloth round the body.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use crate::body::measure::{Tape, encloses_origin};
use crate::body::readings::Reading;
use crate::cloth::{ClothState, Garment};
use crate::fit::laid::Laid;

/// Distance between the centres of two cross-sections above which they are of two legs, metres.
const APART: f64 = 0.04;

/// Step by which a plane is lowered while sleeves run into the body of the garment in it, and how far at most, metres.
const LOWER: (f64, f64) = (0.005, 0.12);
/// Least slope of an arm, as a sine: one that is more level does not run through a level plane.
const SLOPE: f64 = 0.2;
/// How far above its upper girth an arm is still told from the trunk, along its axis, metres.
const ABOVE_UPPER: f64 = 0.05;

/// Girth of a garment in a cutting plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Girth {
    /// Length along the draped cloth, folds included, metres.
    pub worn: f64,
    /// Length of the same line in the flat pattern, metres.
    pub flat: f64,
}

/// Segment of the cutting line across a triangle, from one edge to the next.
struct Step {
    to: [u32; 2],
    from: DVec3,
    worn: f64,
    flat: f64,
}

/// Girth in the plane of `tape`: the shortest closed line of cloth round the tape's origin, which is the innermost layer, that
/// encloses none of the points `but` as well. None where no cloth goes all the way round.
pub fn girth(garment: &Garment, state: &ClothState, tape: &Tape, but: &[DVec3]) -> Option<Girth> {
    round(garment, &Laid::new(garment, state), tape, but)
}

fn round(garment: &Garment, laid: &Laid, tape: &Tape, but: &[DVec3]) -> Option<Girth> {
    let mut steps = steps(garment, laid, tape);
    let (x, y) = tape.normal.any_orthonormal_pair();
    let in_plane = |p: DVec3| DVec2::new((p - tape.origin).dot(x), (p - tape.origin).dot(y));
    let round_others = |points: &[DVec2]| {
        but.iter().any(|but| encloses_origin(&points.iter().map(|p| p - in_plane(*but)).collect::<Vec<_>>()))
    };
    let mut least: Option<Girth> = None;
    while let Some((&first, _)) = steps.first_key_value() {
        let (mut edge, mut round) = (first, Girth { worn: 0.0, flat: 0.0 });
        let mut points = Vec::new();
        while let Some(step) = steps.remove(&edge) {
            points.push(in_plane(step.from));
            round = Girth { worn: round.worn + step.worn, flat: round.flat + step.flat };
            edge = step.to;
        }
        let counts = edge == first && encloses_origin(&points) && !round_others(&points);
        if counts && least.is_none_or(|least| round.worn < least.worn) {
            least = Some(round);
        }
    }
    least
}

/// Girths at the tapes of `readings`, each with its index there, for those where cloth goes all the way round. For a leg, cloth
/// round both legs does not count. Where sleeves run into the cloth round the trunk, its girth is taken below the armholes.
pub fn girths(garment: &Garment, state: &ClothState, readings: &[Reading]) -> Vec<(usize, Girth)> {
    let laid = Laid::new(garment, state);
    let named = |name: &str| readings.iter().find(|reading| reading.name == name)?.tape.as_ref();
    let hip = named("hip");
    let arm = hip.zip(named("upper arm").zip(named("wrist")));
    let of = |tape: &Tape| {
        let beside = hip.map(|hip| DVec3 { x: 2.0 * hip.origin.x - tape.origin.x, ..tape.origin });
        match beside.filter(|_| tape.normal == DVec3::Y) {
            None => round(garment, &laid, tape, &[]),
            Some(beside) if beside.distance(tape.origin) > APART => round(garment, &laid, tape, &[beside]),
            Some(_) => below_sleeves(garment, &laid, tape, |y| {
                arm.map_or_else(Vec::new, |(hip, (upper, wrist))| arms_at(y, hip.origin.x, [upper, wrist]))
            }),
        }
    };
    let tapes = readings.iter().enumerate().filter_map(|(i, reading)| Some((i, reading.tape.as_ref()?)));
    tapes.filter_map(|(i, tape)| Some((i, of(tape)?))).collect()
}

/// Girth of the cloth round the trunk at `tape`, or below it where that cloth goes round an arm, too; `arms` gives the arms'
/// places in the plane at a height. Of cloth that goes round both everywhere, as a cape does, at the tape.
fn below_sleeves(
    garment: &Garment,
    laid: &Laid,
    tape: &Tape,
    arms: impl Fn(f64) -> Vec<DVec3>,
) -> Option<Girth> {
    let (step, most) = LOWER;
    let lower = |k: u32| Tape { origin: tape.origin - DVec3::Y * (f64::from(k) * step), ..tape.clone() };
    let whole = round(garment, laid, tape, &[])?;
    let mut steps = (0..=(most / step) as u32).map(lower);
    steps.find_map(|tape| round(garment, laid, &tape, &arms(tape.origin.y))).or(Some(whole))
}

/// Where the axes of both arms are at the height `y`, metres, in a figure whose middle is at x = `middle`: the left arm from
/// its tape at the top to that at the wrist. Empty where arms are level or elsewhere.
fn arms_at(y: f64, middle: f64, [upper, wrist]: [&Tape; 2]) -> Vec<DVec3> {
    if upper.normal.y.abs() < SLOPE {
        return Vec::new();
    }
    let along = (y - upper.origin.y) / upper.normal.y;
    let length = (wrist.origin - upper.origin).dot(upper.normal);
    if !(-ABOVE_UPPER..=length).contains(&along) {
        return Vec::new();
    }
    let left = upper.origin + upper.normal * along;
    vec![left, DVec3 { x: 2.0 * middle - left.x, ..left }]
}

/// Segments by the edge at which each begins. The front of cloth is outside, so at most one begins at an edge.
fn steps(garment: &Garment, laid: &Laid, tape: &Tape) -> BTreeMap<[u32; 2], Step> {
    let above = |v: u32| (laid.mesh.positions[v as usize] - tape.origin).dot(tape.normal);
    let mut steps = BTreeMap::new();
    for (vs, corners) in laid.mesh.triangles.iter().zip(&laid.corners) {
        let heights = vs.map(above);
        let side = |down: bool| {
            (0..3).find(|&k| (heights[k] >= 0.0) == down && (heights[(k + 1) % 3] >= 0.0) != down)
        };
        let (Some(i), Some(j)) = (side(true), side(false)) else { continue };
        let met = |k: usize| {
            let (a, b) = (k, (k + 1) % 3);
            let share = heights[a] / (heights[a] - heights[b]);
            let [p, q] = [a, b].map(|k| laid.mesh.positions[vs[k] as usize]);
            let [u, w] = [a, b].map(|k| garment.corners[corners[k] as usize].uv);
            (p.lerp(q, share), u.lerp(w, share), [vs[a].min(vs[b]), vs[a].max(vs[b])])
        };
        let ((from, flat_from, begins), (to, flat_to, ends)) = (met(i), met(j));
        let step = Step { to: ends, from, worn: from.distance(to), flat: flat_from.distance(flat_to) };
        steps.entry(begins).or_insert(step);
    }
    steps
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::maps::tests::tube;

    #[test]
    fn a_tube_is_as_long_round_as_its_sides_and_flat_as_it_was_cut() {
        let (n, radius, hoop) = (24, 0.08, 1.05);
        let wound = tube(n, radius, hoop, 1.0);
        let tape = |x: f64, y: f64| Tape { name: "tube", origin: DVec3::new(x, y, 0.0), normal: DVec3::Y };
        let around = |tape: &Tape, but: &[DVec3]| girth(&wound.garment, &wound.state, tape, but);
        let round = f64::from(n) * 2.0 * radius * (std::f64::consts::PI / f64::from(n)).sin();
        let found = around(&tape(0.01, 0.03), &[]).expect("cloth all round");
        assert!((found.worn - round).abs() < 1e-12, "{found:?}, {round} round");
        assert!((found.flat - round / hoop).abs() < 1e-12, "{found:?}, {} flat", round / hoop);
        // Beside it, above it, and round both legs there is no girth.
        assert_eq!(around(&tape(0.1, 0.03), &[]), None);
        assert_eq!(around(&tape(0.0, 1.0), &[]), None);
        assert_eq!(around(&tape(0.01, 0.03), &[DVec3::new(-0.03, 0.03, 0.0)]), None);
        assert!(around(&tape(0.01, 0.03), &[DVec3::new(-0.3, 0.03, 0.0)]).is_some());
    }

    #[test]
    fn cloth_that_is_open_goes_round_nothing() {
        let mut wound = tube(24, 0.08, 1.0, 1.0);
        wound.state.mapped[24] = false;
        let tape = Tape { name: "tube", origin: DVec3::Y * 0.025, normal: DVec3::Y };
        assert_eq!(girth(&wound.garment, &wound.state, &tape, &[]), None);
    }
}
