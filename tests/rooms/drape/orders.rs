//! B24: what comes out does not hang on the triangles, and how fast it becomes exact.

use glam::{DVec2, DVec3};
use toile::cloth::Fabric;
use toile::drape::solver::settle::SettleSettings;

use super::meshes::{Flat, Kind, flat, scene, settled};

/// Green strain along a sheet that hangs by its own weight, `s` metres above its lower edge: the stretch λ at which a St.
/// Venant–Kirchhoff sheet carries what hangs below, Y λ (λ² - 1)/2 = σ g s.
fn stretch(load: f64) -> f64 {
    let mut s = 1.0 + load;
    for _ in 0..50 {
        s -= (s * (s * s - 1.0) / 2.0 - load) / ((3.0 * s * s - 1.0) / 2.0);
    }
    s
}

/// Errors of a hanging sheet 1 m high with `cells` along it and σ g L / Y = 0.1: of positions, metres, and of strain.
fn hanging(cells: u32) -> (f64, f64) {
    let load = 0.1;
    let strip = flat(Kind::Alternating, DVec2::new(4.0 / f64::from(cells), 1.0), [4, cells]);
    let held = strip.picked(|p| p.y > 1.0 - 1e-9);
    let scene = scene(&strip, &Fabric::isotropic(0.2 * 10.0 / load, 0.0, 0.0, 0.2), held);
    let x = settled(&scene, &[], &SettleSettings::default(), strip.placed(|p| p.extend(0.0)));
    // Where a point comes to hang: the stretch summed from the top down.
    let place = |y: f64| {
        let n = 200;
        let h = (1.0 - y) / f64::from(n);
        let sum: f64 = (0..n).map(|i| stretch(load * (y + h * (f64::from(i) + 0.5)))).sum();
        1.0 - sum * h
    };
    let off = strip.points.iter().zip(&x).map(|(p, x)| (x.y - place(p.y)).powi(2)).sum::<f64>();
    let strain = |t: usize| {
        let y = strip.triangles[t].iter().map(|&v| strip.points[v as usize].y).sum::<f64>() / 3.0;
        scene.elastic.membrane.strain(t, &x)[0] - (stretch(load * y).powi(2) - 1.0) / 2.0
    };
    let wrong = (0..strip.triangles.len()).map(|t| strain(t).powi(2)).sum::<f64>();
    ((off / x.len() as f64).sqrt(), (wrong / strip.triangles.len() as f64).sqrt())
}

#[test]
fn b24_a_hanging_sheet_converges_with_the_square_of_the_edge_and_its_strain_with_the_edge() {
    let (coarse, fine) = (hanging(10), hanging(20));
    let order = |coarse: f64, fine: f64| (coarse / fine).log2();
    assert!(order(coarse.0, fine.0) >= 1.8, "positions: {} m, then {} m", coarse.0, fine.0);
    assert!(order(coarse.1, fine.1) >= 1.0, "strain: {}, then {}", coarse.1, fine.1);
}

/// A square kerchief held by two corners somewhat closer than it is wide.
fn kerchief(kind: Kind, cells: u32) -> (Flat, Vec<DVec3>) {
    let side = 0.4;
    let cloth = flat(kind, DVec2::splat(side), [cells, cells]);
    let held = cloth.picked(|p| p.y > side - 1e-9 && (p.x < 1e-9 || p.x > side - 1e-9));
    let scene = scene(&cloth, &Fabric::isotropic(500.0, 0.3, 2e-4, 0.2), held);
    let start = cloth.placed(|p| {
        let belly = (std::f64::consts::PI * p.x / side).sin();
        DVec3::new(p.x * 0.9 + 0.05 * side, p.y - side, 0.35 * side * belly * (0.7 + 0.3 * p.y / side))
    });
    let x =
        settled(&scene, &[], &SettleSettings { most_iterations: 1500, ..SettleSettings::default() }, start);
    (cloth, x)
}

/// Where the point `p` of the flat cloth has come.
fn carried(cloth: &Flat, x: &[DVec3], p: DVec2) -> DVec3 {
    for vs in &cloth.triangles {
        let [a, b, c] = vs.map(|v| cloth.points[v as usize]);
        let whole = (b - a).perp_dot(c - a);
        let wb = (p - a).perp_dot(c - a) / whole;
        let wc = (b - a).perp_dot(p - a) / whole;
        if wb >= -1e-9 && wc >= -1e-9 && wb + wc <= 1.0 + 1e-9 {
            let [xa, xb, xc] = vs.map(|v| x[v as usize]);
            return xa * (1.0 - wb - wc) + xb * wb + xc * wc;
        }
    }
    panic!("{p} is on no triangle");
}

#[test]
fn b24_four_triangulations_of_a_kerchief_hang_alike() {
    let kinds = [Kind::Diagonal, Kind::Alternating, Kind::Equilateral, Kind::Jittered];
    let all = kinds.map(|kind| kerchief(kind, 16));
    let places: Vec<Vec<DVec3>> = all
        .iter()
        .map(|(cloth, x)| {
            let grid = (0..21 * 21).map(|k| DVec2::new(f64::from(k % 21), f64::from(k / 21)) * 0.02);
            grid.map(|p| carried(cloth, x, p)).collect()
        })
        .collect();
    let (low, high) =
        places[0].iter().fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(a, b), x| (a.min(*x), b.max(*x)));
    let size = (high - low).length();
    for (other, kind) in places.iter().zip(kinds).skip(1) {
        let sum: f64 = other.iter().zip(&places[0]).map(|(a, b)| a.distance_squared(*b)).sum();
        let apart = (sum / other.len() as f64).sqrt() / size;
        assert!(apart < 0.01, "{kind:?}: {apart} of the size");
    }
}
