//! B18: cloth that holds air.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::{DVec2, DVec3};
use toile::cloth::Fabric;
use toile::drape::solver::settle::SettleSettings;
use toile::drape::{Elastic, Scene, Sheet};
use toile::geometry::mesh::TriMesh;

use super::meshes::{near, settled};

/// A weightless scene of `sheet` with air inside.
fn blown(sheet: Sheet, fabric: &Fabric, compression: f64, pressure: f64) -> Scene {
    let mut elastic = Elastic::new(&sheet, fabric, compression);
    elastic.pressure = pressure;
    let mass = sheet.vertex_area.iter().map(|a| a * 0.2).collect();
    let pinned = vec![false; sheet.len()];
    Scene { sheet, elastic, mass, pinned, gravity: DVec3::ZERO, damping: 0.0, collider: None }
}

fn volume(sheet: &Sheet, x: &[DVec3]) -> f64 {
    let six = |vs: &[u32; 3]| {
        let [a, b, c] = vs.map(|v| x[v as usize]);
        a.dot(b.cross(c))
    };
    sheet.triangles.iter().map(six).sum::<f64>() / 6.0
}

/// Points of a surface of revolution about y: rings of a profile (radius, height) from pole to pole, and its triangles with
/// their front outside. The poles are single points.
fn revolved(profile: &[DVec2], sectors: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let inner = &profile[1..profile.len() - 1];
    let mut points = vec![DVec3::new(0.0, profile[0].y, 0.0)];
    for p in inner {
        let at = |k| TAU * f64::from(k) / f64::from(sectors);
        points.extend((0..sectors).map(|k| DVec3::new(p.x * at(k).sin(), p.y, p.x * at(k).cos())));
    }
    points.push(DVec3::new(0.0, profile[profile.len() - 1].y, 0.0));
    let last = points.len() as u32 - 1;
    let at = |ring: u32, k: u32| 1 + ring * sectors + k % sectors;
    let rings = inner.len() as u32;
    let mut triangles = Vec::new();
    for k in 0..sectors {
        triangles.extend([[0, at(0, k + 1), at(0, k)], [last, at(rings - 1, k), at(rings - 1, k + 1)]]);
        for ring in 0..rings - 1 {
            let [a, b, c, d] = [at(ring, k), at(ring, k + 1), at(ring + 1, k + 1), at(ring + 1, k)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    (points, triangles)
}

/// A triangle in its own plane, its first side along x.
fn laid([a, b, c]: [DVec3; 3]) -> [DVec2; 3] {
    let (u, w) = (b - a, c - a);
    let along = u.normalize();
    [DVec2::ZERO, DVec2::new(u.length(), 0.0), DVec2::new(w.dot(along), (w - along * w.dot(along)).length())]
}

/// How much wider a sphere of triangles of `stiffness` 1000 N/m becomes by `pressure` Pa.
fn sphere_grows(radius: f64, poisson: f64, pressure: f64) -> f64 {
    let TriMesh { positions: start, triangles } = crate::common::ball(radius, 24, 48);
    let rest = triangles.iter().map(|vs| laid(vs.map(|v| start[v as usize]))).collect();
    let sheet = Sheet::new(start.len(), triangles, rest).expect("a sheet");
    let scene = blown(sheet, &Fabric::isotropic(1000.0, poisson, 0.0, 0.2), 1.0, pressure);
    let settings = SettleSettings { scale: 0.1, residual: 1e-5, ..SettleSettings::default() };
    let x = settled(&scene, &[], &settings, start.clone());
    (volume(&scene.sheet, &x) / volume(&scene.sheet, &start)).cbrt() - 1.0
}

#[test]
fn b18_an_inflated_sphere_grows_as_the_linear_theory_says() {
    let (radius, poisson) = (0.1, 0.3);
    near("dR/R", sphere_grows(radius, poisson, 20.0), 20.0 * radius * (1.0 - poisson) / 2000.0, 5e-3);
}

/// Stress Y/(1 - ν) (λ² - 1)/2 both ways carries the pressure Y/(1 - ν) (λ² - 1)/(λ R): a St. Venant–Kirchhoff sphere, unlike a
/// neo-Hookean one, grows stiffer without a peak.
#[test]
fn b18_a_sphere_blown_up_by_a_third_holds_the_pressure_of_its_stretch() {
    let (radius, poisson, stretch) = (0.1, 0.3, 4.0 / 3.0);
    let pressure = 1000.0 / (1.0 - poisson) * (stretch * stretch - 1.0) / (stretch * radius);
    near("λ", 1.0 + sphere_grows(radius, poisson, pressure), stretch, 5e-3);
}

/// A capsule: half spheres at both ends of a cylinder four times as long as its radius.
#[test]
fn b18_an_inflated_cylinder_widens_as_the_linear_theory_says() {
    let (radius, stiffness, poisson, pressure) = (0.1, 1000.0, 0.3, 20.0);
    let (caps, rows, sectors) = (10, 20, 80);
    let mut profile: Vec<DVec2> = Vec::new();
    let cap = |k: u32| FRAC_PI_2 * f64::from(k) / f64::from(caps);
    profile.extend((0..=caps).map(|k| DVec2::new(cap(k).sin(), -2.0 - cap(k).cos()) * radius));
    profile.extend((1..rows).map(|k| DVec2::new(1.0, -2.0 + 4.0 * f64::from(k) / f64::from(rows)) * radius));
    profile.extend((0..=caps).rev().map(|k| DVec2::new(cap(k).sin(), 2.0 + cap(k).cos()) * radius));
    let (start, triangles) = revolved(&profile, sectors);
    let rest = triangles.iter().map(|vs| laid(vs.map(|v| start[v as usize]))).collect();
    let sheet = Sheet::new(start.len(), triangles, rest).expect("a sheet");
    assert!(volume(&sheet, &start) > 0.0);
    let scene = blown(sheet, &Fabric::isotropic(stiffness, poisson, 0.0, 0.2), 1.0, pressure);
    let settings =
        SettleSettings { scale: pressure * radius * radius, residual: 1e-6, ..SettleSettings::default() };
    let x = settled(&scene, &[], &settings, start.clone());
    let wide = |x: &[DVec3]| {
        let middle: Vec<f64> = start
            .iter()
            .zip(x)
            .filter(|(s, _)| s.y.abs() < 0.3 * radius)
            .map(|(_, x)| x.x.hypot(x.z))
            .collect();
        middle.iter().sum::<f64>() / middle.len() as f64
    };
    let exact = pressure * radius / stiffness * (1.0 - poisson / 2.0);
    near("hoop strain", wide(&x) / wide(&start) - 1.0, exact, 5e-3);
}

/// Two discs sewn at their rims, of foil that neither stretches nor resists wrinkling (Paulsen 1994). Wrinkles run along the
/// radii, as the warp does here.
#[test]
fn b18_a_mylar_balloon_has_its_size() {
    let (radius, rings, sectors) = (0.1, 14u32, 48u32);
    // From the middle of the lower disc over the rim to that of the upper, as if it were blown up somewhat.
    let (low, high) = (-f64::from(rings), f64::from(rings));
    let flat = |k: f64| DVec2::new(1.0 - k.abs() / high, k.signum() * 1e-9) * radius;
    let steps = || (0..=2 * rings).map(|k| low + f64::from(k));
    let (disc, triangles) = revolved(&steps().map(flat).collect::<Vec<_>>(), sectors);
    let rest = triangles
        .iter()
        .map(|vs| {
            let corners = vs.map(|v| disc[v as usize]);
            let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
            let warp = DVec2::new(middle.x, middle.z).normalize();
            corners.map(|c| {
                let p = DVec2::new(c.x, c.z);
                DVec2::new(warp.perp_dot(p), warp.dot(p))
            })
        })
        .collect();
    let sheet = Sheet::new(disc.len(), triangles, rest).expect("a sheet");
    let swollen = |k: f64| {
        let angle = FRAC_PI_2 * (1.0 - k.abs() / high);
        DVec2::new(0.8 * angle.sin(), k.signum() * 0.4 * angle.cos()) * radius
    };
    let (start, _) = revolved(&steps().map(swollen).collect::<Vec<_>>(), sectors);
    assert!(volume(&sheet, &start) > 0.0);
    let pressure = 20.0;
    let mut foil = Fabric::isotropic(2000.0, 0.0, 0.0, 0.2);
    // What is wrinkled does not resist shear either.
    foil.stretch.shear = 0.1;
    let scene = blown(sheet, &foil, 1e-4, pressure);
    let settings = SettleSettings {
        scale: pressure * radius * radius,
        residual: 1e-6,
        most_iterations: 1000,
        ..SettleSettings::default()
    };
    let x = settled(&scene, &[], &settings, start);
    let widest = x.iter().map(|x| x.x.hypot(x.z)).fold(0.0, f64::max);
    let (bottom, top) = x.iter().fold((0.0f64, 0.0f64), |(a, b), x| (a.min(x.y), b.max(x.y)));
    near("radius", widest / radius, 0.762760, 0.02);
    near("thickness", (top - bottom) / radius, 0.913893, 0.02);
    near("volume", volume(&scene.sheet, &x) / radius.powi(3), 1.218524, 0.02);
}
