//! Elastic: the edge of a tube shortens to its length, and cloth beside it gathers.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use glam::{DVec2, DVec3};
use toile::cloth::{Fabric, Garment, build};
use toile::drape::forces::bands::Bands;
use toile::drape::{Drape, Elastic, Method, Scene, Sheet, State};
use toile::pattern::{self, EdgeRef, Pattern, Piece, Seam, Trims};

use super::moves;

const WIDTH: f64 = 0.2;
const HEIGHT: f64 = 0.12;

/// Two pieces sewn into a tube, with elastic along the upper edges.
fn tube(ratio: f64) -> Garment {
    let corners = [(0.0, 0.0), (WIDTH, 0.0), (WIDTH, HEIGHT), (0.0, HEIGHT)].map(DVec2::from);
    let elastic = Some(pattern::Elastic { ratio, tension: 300.0 });
    let mut pattern = Pattern::default();
    let [a, b] = ["front", "back"].map(|name| {
        let mut piece = Piece::polygon(name, &corners);
        piece.outline[2].trims = Trims { elastic, ..Trims::default() };
        pattern.add_piece(piece)
    });
    for (edge, other) in [(1, 3), (3, 1)] {
        let sides = [EdgeRef { piece: a, edge }, EdgeRef { piece: b, edge: other }];
        pattern.add_seam(Seam::of_edges(sides, false));
    }
    build(&pattern, 0.01).0
}

/// The tube after `seconds` without weight, from a round cylinder.
fn rested(garment: &Garment, method: Method, seconds: f64) -> Vec<DVec3> {
    let sheet = Sheet::new(garment.vertex_count, garment.triangles.clone(), garment.rest.clone());
    let sheet = sheet.expect("a sheet");
    let cotton = Fabric::preset("cotton").expect("a preset");
    let mut elastic = Elastic::new(&sheet, cotton, 0.02);
    let ends = |corners: [u32; 2]| corners.map(|c| garment.corners[c as usize].vertex);
    let edges = garment.trims.elastics.iter().map(|e| (ends(e.corners), e.what.ratio, e.what.tension));
    elastic.bands = Bands::new(&sheet, edges);
    let mass = sheet.vertex_area.iter().map(|a| a * cotton.density_kg_per_m2).collect();
    let pinned = vec![false; sheet.len()];
    let first = garment.corners[0].piece;
    let mut x = vec![DVec3::ZERO; sheet.len()];
    for corner in &garment.corners {
        let along = if corner.piece == first { corner.uv.x } else { WIDTH + corner.uv.x };
        let (sin, cos) = (TAU * along / (2.0 * WIDTH)).sin_cos();
        let radius = 2.0 * WIDTH / TAU;
        x[corner.vertex as usize] = DVec3::new(radius * cos, corner.uv.y, -radius * sin);
    }
    let scene = Scene { sheet, elastic, mass, pinned, gravity: DVec3::ZERO, damping: 6.0, collider: None };
    let settings = moves::settings_without_contact(method, 1e-3);
    // Without weight small steps are as long as a step.
    let rate = if method == Method::Implicit { 60.0 } else { 1500.0 };
    let mut drape = Drape::new(scene, State::at_rest(x), settings, 1.0 / rate).expect("room");
    for _ in 0..(seconds * rate) as usize {
        drape.step(1.0 / rate).expect("it stays in place");
    }
    drape.state().positions.clone()
}

/// Length of the mesh edges at height `y` of the pattern: in space, and flat.
fn lengths(garment: &Garment, x: &[DVec3], y: f64) -> (f64, f64) {
    let at = |c: u32| garment.corners[c as usize];
    let mut sides = BTreeMap::new();
    for cs in &garment.triangle_corners {
        for k in 0..3 {
            let (a, b) = (at(cs[k]), at(cs[(k + 1) % 3]));
            if (a.uv.y - y).abs() < 1e-9 && (b.uv.y - y).abs() < 1e-9 {
                let long = x[a.vertex as usize].distance(x[b.vertex as usize]);
                sides.insert([a.vertex.min(b.vertex), a.vertex.max(b.vertex)], (long, a.uv.distance(b.uv)));
            }
        }
    }
    sides.values().fold((0.0, 0.0), |(l, f), (long, flat)| (l + long, f + flat))
}

#[test]
fn the_free_edge_of_a_tube_shortens_to_the_ratio_and_gathers_the_cloth_beside_it() {
    for (ratio, method) in [(0.85, Method::SmallSteps), (0.7, Method::SmallSteps), (0.85, Method::Implicit)] {
        let garment = tube(ratio);
        assert_eq!(garment.trims.elastics.len(), 40);
        let x = rested(&garment, method, 3.0);
        let (top, flat) = lengths(&garment, &x, HEIGHT);
        let (bottom, _) = lengths(&garment, &x, 0.0);
        assert!((flat - 2.0 * WIDTH).abs() < 1e-9);
        let reach = |low: f64, high: f64| {
            let rows = garment.corners.iter().filter(|c| c.uv.y > low && c.uv.y < high);
            let far: Vec<f64> = rows.map(|c| x[c.vertex as usize].with_y(0.0).length()).collect();
            let (least, most) = far.iter().fold((f64::MAX, 0.0f64), |(a, b), &r| (a.min(r), b.max(r)));
            (most - least) * 1000.0
        };
        let (near, far) = (reach(HEIGHT - 0.025, HEIGHT - 0.005), reach(-0.001, 0.01));
        println!("{method:?} {ratio}: edge {} hem {} waves {near}, hem {far} mm", top / flat, bottom / flat);
        assert!((top / flat / ratio - 1.0).abs() < 0.02, "{method:?}: {} of {ratio}", top / flat);
        assert!((bottom / flat - 1.0).abs() < 0.02, "{method:?}: the hem stays, {}", bottom / flat);
        assert!(near > 1.5, "{method:?}: the cloth beside it lies in waves of {near} mm");
    }
}
