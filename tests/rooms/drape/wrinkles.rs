//! Wrinkles: cloth comes to rest in their profile, outwards and inwards, and keeps it under its own weight.

use glam::{DVec2, DVec3};
use toile::cloth::{Fabric, Garment, build};
use toile::drape::forces::folds::Folds;
use toile::drape::solver::newton::Newton;
use toile::drape::solver::settle::{SettleSettings, settle};
use toile::drape::{Contacts, Drape, Elastic, Method, Scene, Sheet, State};
use toile::pattern::{Edge, InternalLine, Pattern, Piece, Trims, Wrinkle};

use super::folds::hanging;
use super::moves;

fn wrinkled(from: (f64, f64), to: (f64, f64), wrinkle: Wrinkle) -> InternalLine {
    let trims = Trims { wrinkle: Some(wrinkle), ..Trims::default() };
    let edges = vec![Edge { start: from.into(), trims, ..Edge::default() }];
    InternalLine { edges, end: to.into(), ..InternalLine::default() }
}

fn panel(size: DVec2, line: InternalLine) -> Pattern {
    let corners = [DVec2::ZERO, DVec2::new(size.x, 0.0), size, DVec2::new(0.0, size.y)];
    let mut pattern = Pattern::default();
    pattern.add_piece(Piece { lines: vec![line], ..Piece::polygon("panel", &corners) });
    pattern
}

/// A strip 0.16 m long with a wrinkle across its middle, held flat by its left end, without gravity: where its vertices are in the
/// flat, and the scene.
fn strip(wrinkle: Wrinkle) -> (Vec<DVec2>, Scene) {
    let line = wrinkled((0.08, 0.0), (0.08, 0.06), wrinkle);
    let (garment, problems) = build(&panel(DVec2::new(0.16, 0.06), line), 0.02);
    assert!(problems.is_empty(), "{problems:?}");
    let mut places = vec![DVec2::ZERO; garment.vertex_count];
    garment.corners.iter().for_each(|corner| places[corner.vertex as usize] = corner.uv);
    let fabric = Fabric::preset("cotton").expect("a preset");
    let own = (fabric.bending.warp * fabric.bending.weft).sqrt();
    let ends = |corners: [u32; 2]| corners.map(|c| garment.corners[c as usize].vertex);
    let bends = garment.trims.wrinkles.iter();
    let edges: Vec<([u32; 2], f64, f64)> =
        bends.map(|bend| (ends(bend.corners), bend.what.angle, bend.what.strength(own))).collect();
    assert!(edges.len() > 50, "{}", edges.len());
    let sheet = Sheet::new(garment.vertex_count, garment.triangles.clone(), garment.rest.clone());
    let sheet = sheet.expect("a sheet").creased(edges.iter().map(|(ends, ..)| *ends));
    let mut elastic = Elastic::new(&sheet, fabric, 1.0);
    elastic.folds = Folds::new(&sheet, edges);
    assert_eq!(elastic.folds.hinges().len(), garment.trims.wrinkles.len(), "all are inner edges");
    let mass = sheet.vertex_area.iter().map(|area| area * fabric.density_kg_per_m2).collect();
    let pinned = places.iter().map(|p| p.x < 0.03).collect();
    let (gravity, damping) = (DVec3::ZERO, 4.0);
    (places, Scene { sheet, elastic, mass, pinned, gravity, damping, collider: None })
}

/// Asserts that the cloth of a [`strip`] at `x` is in the profile of its wrinkle.
fn is_risen(words: &str, wrinkle: Wrinkle, places: &[DVec2], x: &[DVec3]) {
    let crest: Vec<f64> =
        places.iter().zip(x).filter(|(p, _)| (p.x - 0.08).abs() < 1e-9).map(|(_, x)| x.z).collect();
    assert!(crest.len() >= 5, "{crest:?}");
    for height in crest {
        let off = (height - wrinkle.height).abs() / wrinkle.height.abs();
        assert!(off < 0.05, "{words}: {height} m is not {} m", wrinkle.height);
    }
    for (p, x) in places.iter().zip(x) {
        let [_, height] = wrinkle.risen((p.x - 0.08).abs());
        let off = (x.z - height).abs() / wrinkle.height.abs();
        assert!(off < 0.08, "{words}: at {p} it is at {} m, not at {height} m", x.z);
    }
}

const WRINKLES: [Wrinkle; 2] =
    [Wrinkle { width: 0.06, height: 0.003 }, Wrinkle { width: 0.06, height: -0.003 }];

#[test]
fn bending_alone_brings_cloth_into_the_profile_in_equilibrium() {
    for wrinkle in WRINKLES {
        let (places, scene) = strip(wrinkle);
        let mut newton = Newton::new(&scene.sheet, &scene.elastic).expect("room");
        let mut x: Vec<DVec3> = places.iter().map(|p| p.extend(0.0)).collect();
        let mut contacts = Contacts::new(x.len(), 0.0, 0.0);
        let settings = SettleSettings { residual: 1e-6, scale: 1e-2, ..SettleSettings::default() };
        let solved = settle(&scene, &mut newton, &mut contacts, &[], &settings, &mut x);
        assert!(solved.converged, "{solved:?}");
        is_risen("in equilibrium", wrinkle, &places, &x);
    }
}

#[test]
fn bending_alone_brings_cloth_into_the_profile_in_steps() {
    for (wrinkle, method) in
        WRINKLES.into_iter().flat_map(|wrinkle| [(wrinkle, Method::SmallSteps), (wrinkle, Method::Implicit)])
    {
        let (places, scene) = strip(wrinkle);
        let settings = moves::settings_without_contact(method, 1e-4);
        let state = State::at_rest(places.iter().map(|p| p.extend(0.0)).collect());
        // Without weight small steps are as long as a step.
        let (h, steps) = if method == Method::Implicit { (1.0 / 60.0, 180) } else { (1.0 / 900.0, 2700) };
        let mut drape = Drape::new(scene, state, settings, h).expect("room");
        for _ in 0..steps {
            drape.step(h).expect("it stays in place");
        }
        is_risen(&format!("by {method:?}"), wrinkle, &places, &drape.state().positions);
    }
}

/// How high the crest is over its feet, up to 6 cm from `at`, on a panel of cotton 0.4 × 0.3 m that hangs by its upper edge with this
/// wrinkle, as a share of the height of its profile. `way` is that of its line, which goes through the middle.
fn hung(wrinkle: Wrinkle, way: DVec2, at: DVec2) -> f64 {
    let middle = DVec2::new(0.2, 0.15);
    let half = if way.x > 0.0 { 0.2 } else { 0.15 };
    let line = wrinkled((middle - way * half).into(), (middle + way * half).into(), wrinkle);
    let (garment, mut cloth, mut worn) =
        hanging(&panel(DVec2::new(0.4, 0.3), line), |p| DVec3::new(p.x, p.y, 0.0));
    while !worn.progress().at_rest {
        worn.tick(&mut cloth).expect("it stays in place");
    }
    let across = way.perp();
    let mean = |garment: &Garment, near: &dyn Fn(DVec2) -> bool| {
        let found = garment.corners.iter().filter(|corner| near(corner.uv - at));
        let z: Vec<f64> = found.map(|corner| cloth.positions[corner.vertex as usize].z).collect();
        assert!(z.len() >= 3, "{}", z.len());
        z.iter().sum::<f64>() / z.len() as f64
    };
    let crest = mean(&garment, &|p| p.dot(across).abs() < 1e-6 && p.dot(way).abs() < 0.06);
    let half = wrinkle.width / 2.0;
    let foot = |side: f64| {
        let is_foot = |p: DVec2| (p.dot(across) * side - half).abs() < 0.004 && p.dot(way).abs() < 0.06;
        mean(&garment, &is_foot)
    };
    let share = (crest - (foot(1.0) + foot(-1.0)) / 2.0) / wrinkle.risen(0.0)[1];
    println!("{wrinkle:?} along {way}: {share} of its height");
    share
}

#[test]
fn a_wrinkle_stays_under_the_weight_of_the_cloth() {
    for height in [0.008, -0.008] {
        let wrinkle = Wrinkle { width: 0.04, height };
        let [middle, low] = [0.15, 0.06].map(|y| DVec2::new(0.2, y));
        let (upright, level) = (hung(wrinkle, DVec2::Y, low), hung(wrinkle, DVec2::X, middle));
        // The edge that is held keeps the cloth below it wide, and a ridge needs it narrower.
        assert!((0.6..1.1).contains(&upright), "{upright} of its height");
        // The cloth below it pulls at it.
        assert!((0.6..1.1).contains(&level), "{level} of its height");
    }
}
