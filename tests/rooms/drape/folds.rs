//! Fold lines: creases come to rest at their angle, pleats hold, and nothing crosses.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DVec2, DVec3};
use toile::body::Surface;
use toile::cloth::{ClothState, Fabric, Garment, Skips, build};
use toile::drape::forces::folds::Folds;
use toile::drape::{Drape, DrapedGarment, DrapedSettings, Elastic, Method, Scene, State};
use toile::geometry::crossings::self_crossings;
use toile::geometry::mesh::TriMesh;
use toile::geometry::shapes::cylinder;
use toile::pattern::{Edge, Fold, InternalLine, Pattern, Piece, Trims};

use super::meshes::{Flat, Kind, flat, scene};
use super::moves;

const METHODS: [Method; 2] = [Method::SmallSteps, Method::Implicit];

/// A strip 0.1 m long with a crease of `angle` across its middle, without gravity.
fn creased(kind: Kind, angle: f64) -> (Flat, Scene) {
    let strip = flat(kind, DVec2::new(0.1, 0.04), [12, 4]);
    let fabric = Fabric::preset("cotton").expect("a preset");
    let mut scene = scene(&strip, fabric, vec![false; strip.points.len()]);
    (scene.gravity, scene.damping) = (DVec3::ZERO, 4.0);
    let middle: Vec<u32> = (0..strip.points.len() as u32)
        .filter(|&v| (strip.points[v as usize].x - 0.05).abs() < 1e-9)
        .collect();
    let edges: Vec<[u32; 2]> = middle.windows(2).map(|w| [w[0], w[1]]).collect();
    scene.sheet = scene.sheet.creased(edges.iter().copied());
    scene.elastic = Elastic::new(&scene.sheet, fabric, 1.0);
    let edges = edges.into_iter().map(|ends| (ends, angle, Fold::PRESSED));
    scene.elastic.folds = Folds::new(&scene.sheet, edges);
    assert_eq!(scene.elastic.folds.hinges().len(), middle.len() - 1);
    (strip, scene)
}

/// Angle between the normals of the two ends of a strip, with the sign of a fold, in radians.
fn folded(strip: &Flat, scene: &Scene, x: &[DVec3]) -> f64 {
    let normal = |near: &dyn Fn(f64) -> bool| -> DVec3 {
        let sum = strip.triangles.iter().filter(|vs| vs.iter().all(|&v| near(strip.points[v as usize].x)));
        sum.map(|&[a, b, c]| {
            let [a, b, c] = [a, b, c].map(|v| x[v as usize]);
            (b - a).cross(c - a)
        })
        .sum::<DVec3>()
        .normalize()
    };
    let (left, right) = (normal(&|at| at < 0.026), normal(&|at| at > 0.074));
    let sign = scene.elastic.folds.hinges()[0].angle_at(x).expect("an angle").signum();
    left.angle_between(right) * sign
}

#[test]
fn a_single_crease_comes_to_rest_at_its_angle() {
    // Meshes with edges across the middle.
    let kinds = [Kind::Diagonal, Kind::Alternating, Kind::Crossed];
    for (kind, method) in kinds.into_iter().flat_map(|kind| METHODS.map(|method| (kind, method))) {
        for degrees in [30.0f64, -90.0, 150.0] {
            let (strip, scene) = creased(kind, degrees.to_radians());
            let settings = moves::settings_without_contact(method, 1e-4);
            let state = State::at_rest(strip.placed(|p| p.extend(0.0)));
            // Without weight small steps are as long as a step.
            let (h, steps) = if method == Method::Implicit { (1.0 / 60.0, 180) } else { (1.0 / 900.0, 2700) };
            let mut drape = Drape::new(scene, state, settings, h).expect("room");
            for _ in 0..steps {
                drape.step(h).expect("it stays in place");
            }
            let found = folded(&strip, &drape.scene, &drape.state().positions).to_degrees();
            let words = format!("{kind:?} by {method:?}: {found}° is not {degrees}°");
            assert!((found - degrees).abs() < 0.01 * degrees.abs(), "{words}");
            for hinge in drape.scene.elastic.folds.hinges() {
                let angle = hinge.angle_at(&drape.state().positions).expect("an angle").to_degrees();
                assert!((angle - degrees).abs() < 0.01 * degrees.abs(), "hinge of {words}: {angle}");
            }
        }
    }
}

fn fold_line(from: (f64, f64), to: (f64, f64), degrees: f64) -> InternalLine {
    let trims = Trims::from(Fold::pressed(degrees.to_radians()));
    let edges = vec![Edge { start: from.into(), trims, ..Edge::default() }];
    InternalLine { edges, end: to.into(), ..InternalLine::default() }
}

/// A rectangle 0.4 × 0.3 m with these lines.
fn panel(lines: Vec<InternalLine>) -> Pattern {
    let corners = [(0.0, 0.0), (0.4, 0.0), (0.4, 0.3), (0.0, 0.3)].map(DVec2::from);
    let mut pattern = Pattern::default();
    pattern.add_piece(Piece { lines, ..Piece::polygon("panel", &corners) });
    pattern
}

/// The garment of `pattern` where `place` lays it, hung by its upper edge far from any body.
pub fn hanging(
    pattern: &Pattern,
    place: impl Fn(DVec2) -> DVec3,
) -> (Arc<Garment>, ClothState, DrapedGarment) {
    let (garment, problems) = build(pattern, 0.02);
    assert!(problems.is_empty(), "{problems:?}");
    let garment = Arc::new(garment);
    let mut cloth = ClothState {
        positions: vec![DVec3::ZERO; garment.vertex_count],
        mapped: vec![true; garment.vertex_count],
    };
    let mut pins = Vec::new();
    for corner in &garment.corners {
        cloth.positions[corner.vertex as usize] = place(corner.uv);
        if corner.uv.y > 0.3 - 1e-9 {
            pins.push(corner.vertex);
        }
    }
    let mut body = cylinder(0.05, 0.1, 12, 2);
    body.positions.iter_mut().for_each(|p| p.y -= 3.0);
    let body = Arc::new(Surface::new(body).expect("a body"));
    let settings = DrapedSettings { strain: 0.01, self_collision: true, skips: Skips::default() };
    let cotton = Fabric::preset("cotton").expect("a preset");
    let fabrics = BTreeMap::new();
    let worn = DrapedGarment::new(Arc::clone(&garment), &cloth, body, (&fabrics, cotton), &pins, settings)
        .expect("it can be draped");
    (garment, cloth, worn)
}

/// The same once it rests.
fn hung(pattern: &Pattern, place: impl Fn(DVec2) -> DVec3) -> (Arc<Garment>, ClothState, DrapedGarment) {
    let (garment, mut cloth, mut worn) = hanging(pattern, place);
    while !worn.progress().at_rest {
        worn.tick(&mut cloth).expect("it stays in place");
    }
    (garment, cloth, worn)
}

/// Angles of the creases of a hung garment, degrees.
fn angles(garment: &Garment, cloth: &ClothState) -> Vec<f64> {
    let sheet =
        toile::drape::Sheet::new(garment.vertex_count, garment.triangles.clone(), garment.rest.clone());
    let ends = |corners: [u32; 2]| corners.map(|c| garment.corners[c as usize].vertex);
    let edges = garment.trims.folds.iter().map(|f| (ends(f.corners), f.what.angle, f.what.strength));
    let folds = Folds::new(&sheet.expect("a sheet"), edges);
    assert_eq!(folds.hinges().len(), garment.trims.folds.len(), "every link is an edge of the mesh");
    folds.hinges().iter().map(|h| h.angle_at(&cloth.positions).expect("an angle").to_degrees()).collect()
}

/// Mean angle of both creases of a knife pleat of this strength in its lower third, degrees, away from its band.
fn pleat(strength: f64) -> f64 {
    let line = |x: f64, degrees: f64| {
        let mut line = fold_line((x, 0.0), (x, 0.3), degrees);
        line.edges[0].trims = Trims::from(Fold { angle: degrees.to_radians(), strength });
        line
    };
    // As a band holds it: the cloth between the lines is turned back by 120°.
    let laid = |p: DVec2| match p.x {
        x if x <= 0.15 => DVec3::new(x, p.y, 0.0),
        x if x <= 0.21 => DVec3::new(0.15 - (x - 0.15) / 2.0, p.y, (x - 0.15) * 0.75f64.sqrt()),
        x => DVec3::new(x - 0.09, p.y, 0.06 * 0.75f64.sqrt()),
    };
    let (garment, cloth, worn) = hung(&panel(vec![line(0.15, 180.0), line(0.21, -180.0)]), laid);
    assert!(worn.progress().ticks < 1200, "it rests: {:?}", worn.progress());
    let mesh = TriMesh { positions: cloth.positions.clone(), triangles: garment.triangles.clone() };
    assert_eq!(self_crossings(&mesh, &garment.adjacency.edges, &mesh.tree()).len(), 0);
    let angles = angles(&garment, &cloth);
    assert_eq!(angles.len(), 30);
    let low = |f: &[u32; 2]| f.iter().all(|&c| garment.corners[c as usize].uv.y < 0.11);
    let folds = garment.trims.folds.iter().zip(&angles).filter(|(f, _)| low(&f.corners));
    let along: Vec<f64> = folds.map(|(f, angle)| angle * f.what.angle.signum()).collect();
    along.iter().sum::<f64>() / along.len() as f64
}

#[test]
fn a_knife_pleat_holds_under_gravity_and_nothing_crosses() {
    let (pressed, limp) = (pleat(Fold::PRESSED), pleat(1e-5));
    println!("pressed {pressed}°, limp {limp}°");
    assert!(pressed > 165.0, "{pressed}°");
    assert!(limp < 140.0, "not pressed it stays as it is held: {limp}°");
}

#[test]
fn lines_that_cross_end_inside_or_bend_are_followed_by_edges() {
    let bent = InternalLine {
        edges: vec![Edge {
            start: DVec2::new(0.05, 0.0),
            shape: toile::pattern::EdgeShape::Quadratic { control: DVec2::new(0.1, 0.2) },
            trims: Trims::from(Fold::pressed(1.0)),
            ..Edge::default()
        }],
        end: DVec2::new(0.35, 0.12),
        ..InternalLine::default()
    };
    let lines =
        vec![fold_line((0.0, 0.113), (0.4, 0.107), 40.0), fold_line((0.233, -0.05), (0.2, 0.3), 40.0), bent];
    let lengths: Vec<f64> =
        lines.iter().map(|line| line.flattened(1e-5).windows(2).map(|w| w[0].distance(w[1])).sum()).collect();
    let (garment, problems) = build(&panel(lines), 0.02);
    assert!(problems.is_empty(), "{problems:?}");
    let long = |[a, b]: [u32; 2]| garment.corners[a as usize].uv.distance(garment.corners[b as usize].uv);
    let found: f64 = garment.trims.folds.iter().map(|f| long(f.corners)).sum();
    // Of the second line the part outside the piece is left out, and some millimetres at the edge of the piece.
    let exact: f64 = lengths.iter().sum::<f64>() - 0.05;
    assert!((found / exact - 1.0).abs() < 0.03, "{found} m of {exact} m");
    let flat = ClothState {
        positions: garment.corners.iter().map(|c| c.uv.extend(0.0)).collect(),
        mapped: Vec::new(),
    };
    assert!(angles(&garment, &flat).iter().all(|angle| angle.abs() < 1e-9));
    let area = |r: &[DVec2; 3]| (r[1] - r[0]).perp_dot(r[2] - r[0]) / 2.0;
    let whole: f64 = garment.rest.iter().map(area).sum();
    assert!((whole - 0.12).abs() < 1e-12, "{whole} m²");
    let smallest = garment.rest.iter().flat_map(|r| {
        [0, 1, 2].map(|k| (r[(k + 1) % 3] - r[k]).angle_to(r[(k + 2) % 3] - r[k]).abs().to_degrees())
    });
    let smallest = smallest.fold(f64::MAX, f64::min);
    assert!(smallest > 5.0, "smallest angle {smallest}°");
}

#[test]
fn straight_slanting_edges_get_no_faces_without_an_area() {
    // An edge of the skirt's side, split into points that rounding takes off its line.
    let corners = [(-0.31, -0.58), (0.31, -0.58), (0.21065, 0.012), (-0.21065, 0.012)].map(DVec2::from);
    for edge_length in [0.02, 0.013, 0.01, 0.007] {
        let mut pattern = Pattern::default();
        let lines = vec![fold_line((-0.05, -0.5), (-0.04, -0.15), 40.0)];
        pattern.add_piece(Piece { lines, ..Piece::polygon("skirt", &corners) });
        let (garment, problems) = build(&pattern, edge_length);
        assert!(problems.is_empty(), "{problems:?}");
        let area = |r: &[DVec2; 3]| (r[1] - r[0]).perp_dot(r[2] - r[0]) / 2.0;
        let least = garment.rest.iter().map(area).fold(f64::MAX, f64::min);
        assert!(least > 0.05 * edge_length * edge_length, "{edge_length}: {least}");
    }
}

#[test]
fn a_line_that_ends_on_a_sewn_edge_gives_both_sides_a_point() {
    let mut pattern = panel(vec![fold_line((0.137, 0.0), (0.137, 0.3), 180.0)]);
    let top = pattern.pieces.keys().next().copied().expect("a piece");
    let corners = [(0.0, -0.3), (0.4, -0.3), (0.4, 0.0), (0.0, 0.0)].map(DVec2::from);
    let below = pattern.add_piece(Piece::polygon("below", &corners));
    let side = |piece, edge| toile::pattern::EdgeRef { piece, edge };
    pattern.add_seam(toile::pattern::Seam::of_edges([side(top, 0), side(below, 2)], false));
    let (garment, problems) = build(&pattern, 0.02);
    assert!(problems.is_empty(), "{problems:?}");
    let (_, pairs) = &garment.seam_pairs[0];
    let at = |c: u32| garment.corners[c as usize].uv;
    for &[a, b] in pairs {
        assert!((at(a).x - at(b).x).abs() < 1e-9, "{} is sewn to {}", at(a), at(b));
    }
    assert!(pairs.iter().any(|&[a, _]| (at(a).x - 0.137).abs() < 1e-9), "the line ends on a point");
    let ends = garment.trims.folds.iter().flat_map(|f| f.corners).filter(|&c| at(c).y.abs() < 1e-12);
    assert_eq!(ends.count(), 1);
}
