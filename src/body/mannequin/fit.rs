//! Finds the factors for which a figure has the wanted measurements.

use glam::{DVec2, DVec3};

use super::field::Field;
use super::figure::{Factors, Figure};
use super::landmarks;
use super::measurements::Measurements;
use crate::body::measure::{Tape, hull_perimeter, length, taut};

/// Number of directions in which a girth is sampled.
const RAYS: usize = 96;
/// Most rounds of measuring and correcting.
const ROUNDS: usize = 14;
/// Relative error at which a measurement needs no more correcting.
const CLOSE: f64 = 5e-4;

/// Relative loss of girth by triangulation, per squared angle (radians) that an edge spans; measured on finished meshes.
const CHORD_LOSS: f64 = 0.035;

/// Girth, metres, of the part of `field` that encloses the tape's origin; all of its section must be visible from there.
fn girth(field: &Field, tape: &Tape) -> f64 {
    let (x, y) = tape.normal.any_orthonormal_pair();
    let points = (0..RAYS)
        .map(|i| {
            let around = DVec2::from_angle(std::f64::consts::TAU * i as f64 / RAYS as f64);
            around * field.exit(tape.origin, x * around.x + y * around.y)
        })
        .collect();
    hull_perimeter(points)
}

/// Length of a tape over the outside of the points of `side`, each moved out by `exit` metres along x.
pub(super) fn side_tape(side: &[DVec3], exit: impl Fn(DVec3) -> f64) -> f64 {
    // Seen with the tape running down, outward is to its left.
    length(&taut(side.iter().map(|&p| DVec2::new(p.y, -(p.x + exit(p))))))
}

/// The measurements that the finished mesh will have, in the order of `Measurements::named`. Triangles with edges of
/// `edge(place)` metres cut across the skin's curves, which shortens girths a little.
fn readings(figure: &Figure, field: &Field, edge: impl Fn(&Figure, DVec3) -> f64) -> [f64; 16] {
    let tapes = landmarks::tapes(figure, field);
    let on_mesh = |tape: &Tape| {
        let smooth = girth(field, tape);
        let chord = edge(figure, tape.origin) * std::f64::consts::TAU / smooth;
        smooth * (1.0 - CHORD_LOSS * chord * chord)
    };
    let arm = landmarks::arm_line(figure, field);
    Measurements::default().named().map(|(name, _)| match name {
        "height" => figure.y(super::proportions::level::CROWN),
        "half across shoulder" => arm[0].x,
        "arm length" => arm[0].distance(arm[1]) + arm[1].distance(arm[2]),
        "waist to ankle" => side_tape(&landmarks::side_line(figure, field), |p| field.exit(p, DVec3::X)),
        girth => tapes.iter().find(|t| t.name == girth).map_or(1.0, on_mesh),
    })
}

/// Finds the factors for `m` by measuring and correcting. None when they do not converge.
pub fn factors(m: &Measurements, edge: impl Fn(&Figure, DVec3) -> f64) -> Option<Factors> {
    let targets = m.named().map(|(_, value)| value);
    let mut factors = Factors::guess(m);
    for _ in 0..ROUNDS {
        let figure = Figure::new(factors);
        let found = readings(&figure, &Field::new(&figure), &edge);
        let ratio = |i: usize| (targets[i] / found[i]).clamp(0.8, 1.25);
        if (0..16).all(|i| (ratio(i) - 1.0).abs() < CLOSE) {
            return Some(factors);
        }
        corrected(&mut factors, ratio);
    }
    None
}

/// Multiplies each factor by the ratio of wanted to actual value of its measurement.
fn corrected(factors: &mut Factors, ratio: impl Fn(usize) -> f64) {
    // Indices in `Measurements::named` of ankle, calf, knee, mid-thigh, upper thigh, hip, abdomen, waist, bust, neck.
    const GOVERNS: [usize; 10] = [14, 13, 12, 11, 10, 4, 3, 2, 1, 6];
    for (factor, i) in factors.girth.iter_mut().zip(GOVERNS) {
        *factor *= ratio(i);
    }
    factors.height *= ratio(0);
    factors.shoulder *= ratio(5);
    factors.arm_length *= ratio(7);
    factors.arm[0] *= ratio(8);
    factors.arm[1] *= ratio(9);
    factors.lower *= ratio(15);
}
