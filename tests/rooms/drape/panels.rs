//! B25: paper B's hanging cloth of 17 × 17 points keeps its size.

use glam::{DVec2, DVec3};
use toile::cloth::Fabric;
use toile::drape::{Drape, Method, State};

use super::meshes::{Kind, flat, scene};
use super::moves::settings;

/// The most its area changes while it swings, and how much its border and p99 of its edges do where it has come after two seconds.
/// (At the lowest point of its first swings springs let the border stretch by 1.2 %.)
fn hanging(method: Method) -> (f64, f64, f64) {
    let side = 0.5;
    let cloth = flat(Kind::Diagonal, DVec2::splat(side), [16, 16]);
    let corners = cloth.picked(|p| p.y > side - 1e-9 && (p.x < 1e-9 || p.x > side - 1e-9));
    let cotton = Fabric::preset(Fabric::USUAL).expect("cotton");
    let scene = scene(&cloth, cotton, corners);
    let mut settings = settings(method);
    settings.stiffness = (cotton.stretch.warp * cotton.stretch.weft).sqrt();
    settings.accuracy = 1e-4;
    // Of 1 % half is the solver's, half the cloth's own.
    settings.strain = 0.005;
    let h = 1.0 / 60.0;
    let start = State::at_rest(cloth.placed(|p| DVec3::new(p.x, 0.0, side - p.y)));
    let mut drape = Drape::new(scene, start, settings, h).expect("room");
    let (mut area, mut border) = (0.0f64, 0.0);
    for _ in 0..120 {
        drape.step(h).expect("a step");
        let (sheet, x) = (&drape.scene.sheet, &drape.state().positions);
        let at = |v: u32| x[v as usize];
        let now: f64 = sheet
            .triangles
            .iter()
            .map(|&[a, b, c]| (at(b) - at(a)).cross(at(c) - at(a)).length() / 2.0)
            .sum();
        area = area.max((now / (side * side) - 1.0).abs());
        let edges = sheet.adjacency.edges.iter().enumerate();
        let outer = edges.filter(|(e, _)| sheet.adjacency.edge_triangles.of(*e as u32).len() == 1);
        let round: f64 = outer.map(|(_, &[a, b])| at(a).distance(at(b))).sum();
        border = (round / (4.0 * side) - 1.0).abs();
    }
    let (sheet, x) = (&drape.scene.sheet, &drape.state().positions);
    let strain = |(e, &[a, b]): (usize, &[u32; 2])| {
        (x[a as usize].distance(x[b as usize]) / sheet.rest_length(e) - 1.0).abs()
    };
    let mut strains: Vec<f64> = sheet.adjacency.edges.iter().enumerate().map(strain).collect();
    strains.sort_by(f64::total_cmp);
    (area, border, strains[strains.len() * 99 / 100])
}

#[test]
fn b25_a_hanging_cloth_keeps_its_area_and_its_border() {
    for method in [Method::Implicit, Method::SmallSteps] {
        let (area, border, p99) = hanging(method);
        assert!(area <= 0.0144, "{method:?}: area {area}");
        assert!(border <= 0.0087, "{method:?}: border {border}");
        assert!(p99 <= 0.01, "{method:?}: p99 strain {p99}");
    }
}
