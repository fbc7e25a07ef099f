//! B19: Cusick's test. A round specimen of 30 cm lies on a disc of 18 cm, held by a second; its drape coefficient is the share of
//! the ring outside the disc that its shadow still covers. There is no exact answer: meshes are held against a finer one.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};
use toile::cloth::Fabric;
use toile::drape::solver::settle::SettleSettings;

use super::meshes::{Flat, scene, settled};

const DISC: f64 = 0.09;
const SPECIMEN: f64 = 0.15;

/// The ring outside the disc and two rows of what lies on it, in rings of triangles of about `edge`. What is held first bends for
/// half a row on either side: the disc ends midway between two.
fn ring(edge: f64) -> Flat {
    let rows = ((SPECIMEN - DISC) / edge).ceil() as u32;
    let step = (SPECIMEN - DISC) / (f64::from(rows) - 0.5);
    let sectors = (TAU * (DISC + SPECIMEN) / 2.0 / edge).round() as u32;
    let mut points = Vec::new();
    for row in 0..=rows + 1 {
        let radius = DISC + step * (f64::from(row) - 1.5);
        for k in 0..sectors {
            let angle = TAU * (f64::from(k) + 0.5 * f64::from(row % 2)) / f64::from(sectors);
            points.push(DVec2::from_angle(angle) * radius);
        }
    }
    let mut triangles = Vec::new();
    for row in 0..=rows {
        for k in 0..sectors {
            let at = |row: u32, k: u32| row * sectors + k % sectors;
            let (a, b, c, d) = (at(row, k), at(row, k + 1), at(row + 1, k + 1), at(row + 1, k));
            // Odd rows are half a sector ahead.
            triangles.extend(if row % 2 == 0 { [[a, d, b], [b, d, c]] } else { [[a, c, b], [a, d, c]] });
        }
    }
    Flat { points, triangles }
}

/// A specimen of `fabric` (0.15 kg/m²) at rest; it begins sagged a little, with so many ripples.
fn at_rest(bending: f64, edge: f64, ripples: u32) -> (Flat, Vec<DVec3>) {
    let specimen = ring(edge);
    let held = specimen.picked(|p| p.length() < DISC + edge);
    let scene = scene(&specimen, &Fabric::isotropic(2000.0, 0.3, bending, 0.15), held);
    let start = |p: DVec2| {
        let out = (p.length() - DISC - edge).max(0.0) / (SPECIMEN - DISC);
        DVec3::new(p.x, out * (0.015 * (f64::from(ripples) * p.to_angle()).cos() - 0.02), p.y)
    };
    let settings = SettleSettings { residual: 1e-6, most_iterations: 2000, ..SettleSettings::default() };
    let x = settled(&scene, &[], &settings, specimen.placed(start));
    (specimen, x)
}

fn on_rim(specimen: &Flat) -> impl Iterator<Item = usize> {
    (0..specimen.points.len()).filter(|&v| specimen.points[v].length() > SPECIMEN - 1e-9)
}

/// Drape coefficient, and the number of folds.
fn draped(bending: f64, edge: f64) -> (f64, usize) {
    let (specimen, x) = at_rest(bending, edge, 4);
    let shadow: Vec<DVec2> = on_rim(&specimen).map(|v| DVec2::new(x[v].x, x[v].z)).collect();
    let whole: Vec<DVec2> = on_rim(&specimen).map(|v| specimen.points[v]).collect();
    (covered(&shadow) / covered(&whole), folds(&on_rim(&specimen).map(|v| x[v].y).collect::<Vec<_>>()))
}

/// What the shadow of this rim covers outside the disc, which may run back over itself in folds; m² / π.
fn covered(rim: &[DVec2]) -> f64 {
    const RAYS: usize = 1440;
    let mut reach = vec![DISC; RAYS];
    for (a, b) in rim.iter().zip(rim.iter().cycle().skip(1)) {
        for k in 0..50 {
            let p = a.lerp(*b, f64::from(k) / 50.0);
            let ray = (p.to_angle().rem_euclid(TAU) / TAU * RAYS as f64) as usize % RAYS;
            reach[ray] = reach[ray].max(p.length());
        }
    }
    reach.iter().map(|r| r * r - DISC * DISC).sum::<f64>() / RAYS as f64
}

/// The number of waves with the greatest amplitude round the rim.
fn folds(heights: &[f64]) -> usize {
    let amplitude = |n: usize| {
        let turn = |k: usize| DVec2::from_angle(TAU * (n * k) as f64 / heights.len() as f64);
        heights.iter().enumerate().map(|(k, y)| turn(k) * *y).sum::<DVec2>().length()
    };
    (1..12).max_by(|&a, &b| amplitude(a).total_cmp(&amplitude(b))).unwrap_or(0)
}

#[test]
fn b19_the_drape_coefficient_does_not_hang_on_the_mesh() {
    let ((coarse, few), (fine, many)) = (draped(5e-5, 0.0105), draped(5e-5, 0.0075));
    assert!((coarse - fine).abs() < 0.02, "{coarse} and {fine}");
    assert_eq!((few, many), (4, 4), "folds");
}

#[test]
fn b19_what_is_rigid_covers_all_and_what_is_limp_little() {
    let [rigid, usual, limp] = [0.1, 2e-5, 1e-7].map(|bending| draped(bending, 0.0105).0);
    assert!((rigid - 1.0).abs() < 1e-3, "{rigid}");
    assert!(limp > 0.0 && limp < 0.6 * usual && usual < 0.8, "{usual}, {limp}");
}

/// The rim of a stiff specimen sinks by 3.50753e-3 q b⁴/D, as the sum of q r⁴/64 D, 1, r², ln r and r² ln r does that is clamped at
/// 0.6 b and free at b (ν = 0.3): the mesh comes there with the square of its edge.
#[test]
fn b24_a_stiff_specimen_sinks_as_a_plate_does() {
    let exact = 3.50753e-3 * 0.15 * 10.0 * SPECIMEN.powi(4) / 0.1;
    let error = |edge: f64| {
        let (specimen, x) = at_rest(0.1, edge, 0);
        let (sum, count) = on_rim(&specimen).fold((0.0, 0.0), |(s, n), v| (s - x[v].y, n + 1.0));
        (sum / count / exact - 1.0).abs()
    };
    // Six and twelve rows; the first is half a row in.
    let (coarse, fine) = (error(0.01), error(0.005));
    let order = (coarse / fine).ln() / (11.5f64 / 5.5).ln();
    assert!(fine < 0.01 && order > 1.8, "{coarse}, then {fine}: order {order}");
}
