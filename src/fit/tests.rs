use glam::{DVec2, DVec3};

use super::*;
use crate::body::Surface;
use crate::body::closest::closest_on_triangle;
use crate::cloth::FlatPiece;
use crate::fit::on_body::{NEAR, WRONG_SIDE};
use crate::fit::{
    Causes, Moved, Smaller, Tight, fallen, fallen_from, faults, tight_places, tightest, tops, verdict,
};
use crate::geometry::mesh::TriMesh;
use crate::pattern::{Button, EdgeRef, Piece, PiecePoint, Seam};

/// A closed cylinder about y of radius `r` from `low` to `high`, `n` facets round, with caps.
fn cylinder(r: f64, low: f64, high: f64, n: u32, rows: u32) -> TriMesh {
    let mut mesh = TriMesh::default();
    for row in 0..=rows {
        let y = low + (high - low) * f64::from(row) / f64::from(rows);
        for k in 0..n {
            let a = f64::from(k) / f64::from(n) * std::f64::consts::TAU;
            mesh.positions.push(DVec3::new(r * a.sin(), y, r * a.cos()));
        }
    }
    for row in 0..rows {
        for k in 0..n {
            let (a, b) = (row * n + k, row * n + (k + 1) % n);
            mesh.triangles.extend([[a, b, b + n], [a, b + n, a + n]]);
        }
    }
    let (bottom, top) = (mesh.positions.len() as u32, mesh.positions.len() as u32 + 1);
    mesh.positions.extend([DVec3::new(0.0, low, 0.0), DVec3::new(0.0, high, 0.0)]);
    for k in 0..n {
        let next = (k + 1) % n;
        mesh.triangles.extend([[bottom, next, k], [top, rows * n + k, rows * n + next]]);
    }
    mesh
}

/// A sleeve of two sheets, sewn along both sides, round the axis.
struct Sleeve {
    pattern: Pattern,
    garment: Garment,
    state: ClothState,
}

const WIDTH: f64 = 0.40;
const HEIGHT: f64 = 0.30;

/// Each sheet covers half of a circle of radius `r`; `place` moves the points then.
fn sleeve(r: f64, place: impl Fn(DVec3) -> DVec3) -> Sleeve {
    let sheet = [DVec2::ZERO, DVec2::X * WIDTH, DVec2::new(WIDTH, HEIGHT), DVec2::Y * HEIGHT];
    let mut pattern = Pattern::default();
    let [front, back] = ["front", "back"].map(|name| pattern.add_piece(Piece::polygon(name, &sheet)));
    let mut sew = |a, b| {
        let sides = [EdgeRef { piece: front, edge: a }, EdgeRef { piece: back, edge: b }];
        pattern.add_seam(Seam::of_edges(sides, false));
    };
    sew(1, 3);
    sew(3, 1);
    let (garment, problems) = crate::cloth::build(&pattern, 0.02);
    assert!(problems.is_empty(), "{problems:?}");
    let mut positions = vec![DVec3::ZERO; garment.vertex_count];
    for c in &garment.corners {
        let half = if c.piece == front { 0.0 } else { std::f64::consts::PI };
        let angle = half + c.uv.x / WIDTH * std::f64::consts::PI;
        let round = DVec3::new(r * angle.sin(), 0.5 + c.uv.y, r * angle.cos());
        positions[c.vertex as usize] = place(round);
    }
    let mapped = vec![true; garment.vertex_count];
    Sleeve { pattern, garment, state: ClothState { positions, mapped } }
}

fn report(sleeve: &Sleeve, body: TriMesh) -> Report {
    let surface = Surface::new(body).expect("a body");
    measure(&sleeve.pattern, &sleeve.garment, &sleeve.state, &BodyIndex::new(&surface))
}

fn words(report: &Report) -> String {
    verdict(report).iter().map(|p| format!("{}: {}\n", p.place, p.words)).collect()
}

/// The radius at which the sheets close round without strain.
fn exact_radius() -> f64 {
    WIDTH / std::f64::consts::PI
}

#[test]
fn a_sleeve_that_fits_has_no_faults() {
    let r = exact_radius();
    let report = report(&sleeve(r, |p| p), cylinder(r - 0.01, 0.2, 1.2, 48, 20));
    assert_eq!(words(&report), "");
    // Chords of a circle are shorter than its arcs, by a part in 24 times the square of the angle.
    let chord = (0.03 / r).powi(2) / 24.0;
    assert!(report.strain.max < 1.1 * chord, "{:?}", report.strain);
    assert_eq!((report.seams.closed, report.seams.open), (2, 0));
    assert_eq!((report.pieces_in_space, report.pieces_expected), (1, 1));
    assert_eq!(report.faces_near_body, report.triangles);
    assert!((report.clearance.median - 0.01).abs() < 5e-4, "{:?}", report.clearance);
    let [low, high] = &report.openings[..] else { panic!("{:?}", report.openings) };
    assert!(low.body_through && high.body_through);
    assert!((low.length - 2.0 * WIDTH).abs() < 1e-3 && (low.height - high.height).abs() > HEIGHT - 1e-9);
}

#[test]
fn an_open_seam_is_named() {
    let r = exact_radius();
    let mut sleeve = sleeve(r, |p| p);
    let (id, seam) = sleeve.pattern.seams.iter().next().map(|(id, seam)| (*id, *seam)).expect("a seam");
    sleeve.garment.seam_pairs.retain(|(known, _)| *known != id);
    let [a, b] = seam.sides.map(|side| sleeve.pattern.pieces[&side.piece].name.clone());
    let words = words(&report(&sleeve, cylinder(r - 0.01, 0.2, 1.2, 48, 20)));
    assert!(words.starts_with(&format!("seams: 1 of 2 seams are open: {id} ({a} and {b})\n")), "{words}");
}

#[test]
fn strain_is_that_of_the_circumference() {
    let r = exact_radius();
    let report = report(&sleeve(r * 1.1, |p| p), cylinder(r, 0.2, 1.2, 48, 20));
    assert!((report.strain.max - 0.1).abs() < 2e-3, "{:?}", report.strain);
    for piece in &report.pieces {
        assert!((piece.area_change - 0.1).abs() < 2e-3);
        let perimeter = 2.0 * WIDTH * 0.1 / (2.0 * (WIDTH + HEIGHT));
        assert!((piece.perimeter_change - perimeter).abs() < 2e-3);
    }
}

#[test]
fn cloth_stretched_to_more_than_its_double_is_torn() {
    let r = exact_radius();
    let whole = report(&sleeve(r, |p| p), cylinder(r - 0.01, 0.2, 1.2, 48, 20));
    assert_eq!(whole.strain.doubled, 0);
    let torn = |p: DVec3| if p.y > 0.7 { p + DVec3::Y * 0.2 } else { p };
    let report = report(&sleeve(r, torn), cylinder(r - 0.01, 0.2, 1.2, 48, 20));
    assert!(report.strain.doubled > 10 && words(&report).contains("would have torn"), "{}", words(&report));
}

#[test]
fn cloth_inside_the_body_is_found() {
    let r = exact_radius();
    let report = report(&sleeve(r, |p| p), cylinder(r + 0.02, 0.2, 1.2, 64, 20));
    assert_eq!(report.penetration.vertices, report.vertices);
    assert_eq!(report.penetration.faces, report.triangles);
    assert!((report.penetration.max_depth - 0.02).abs() < 1e-3, "{:?}", report.penetration);
    assert_eq!((report.edges_through_body, report.body_edges_through_garment), (0, 0));
    assert!(words(&report).contains("are inside the body, up to 2"), "{}", words(&report));
}

#[test]
fn a_sleeve_beside_its_arm_is_found() {
    let r = exact_radius();
    let report = report(&sleeve(r, |p| p + DVec3::X * 0.3), cylinder(0.05, 0.2, 1.2, 48, 20));
    assert!(report.openings.iter().all(|o| !o.body_through));
    assert_eq!(words(&report).matches("does not pass through it").count(), 2, "{}", words(&report));
}

#[test]
fn a_sleeve_turned_inside_out_is_found() {
    let r = exact_radius();
    let report = report(&sleeve(r, |p| p * DVec3::new(-1.0, 1.0, 1.0)), cylinder(r - 0.01, 0.2, 1.2, 48, 20));
    assert_eq!(report.flipped_faces, report.triangles);
    assert_eq!((report.faces_in_folds, report.faces_between), (0, 0));
    assert!(words(&report).contains("wrong side out"));
    assert!(!faults(&report, Moved::Draped).is_empty(), "however it came to be so");
}

/// The side of a loose bodice beside an arm shows the arm its outer side, and the trunk its inner one.
#[test]
fn loose_cloth_between_two_limbs_is_told_from_cloth_inside_out() {
    let r = exact_radius();
    let mut body = cylinder(0.05, 0.2, 1.2, 48, 20);
    let (other, first) = (cylinder(0.03, 0.2, 1.2, 48, 20), body.positions.len() as u32);
    body.positions.extend(other.positions.iter().map(|p| *p + DVec3::X * (r + 0.04)));
    body.triangles.extend(other.triangles.iter().map(|t| t.map(|v| v + first)));
    let report = report(&sleeve(r, |p| p), body);
    assert!(report.flipped_faces > 10, "{}", report.flipped_faces);
    assert_eq!((report.faces_in_folds, report.faces_between), (0, report.flipped_faces));
    assert!(faults(&report, Moved::Draped).iter().all(|(fault, _)| !fault.words.contains("wrong side out")));
}

/// A skirt shows its outer side to the hand beside it, however far the legs are from its inner side.
#[test]
fn cloth_beside_a_hand_is_told_from_cloth_inside_out() {
    let r = exact_radius();
    let beside_hand = |map: fn(DVec3) -> DVec3| {
        let mut body = cylinder(r - 0.01, 0.2, 1.2, 48, 20);
        let (hand, first) = (cylinder(0.02, 0.6, 0.75, 24, 6), body.positions.len() as u32);
        body.positions.extend(hand.positions.iter().map(|p| *p + DVec3::X * (r + 0.023)));
        body.triangles.extend(hand.triangles.iter().map(|t| t.map(|v| v + first)));
        report(&sleeve(r, map), body)
    };
    let smooth = beside_hand(|p| p);
    assert!(smooth.flipped_faces > 10, "{}", smooth.flipped_faces);
    assert_eq!((smooth.faces_beside, smooth.wrong_side_out(Moved::Wrapped)), (smooth.flipped_faces, 0));
    // Turned over where nothing is beside it: there are creases round that.
    let turned = beside_hand(|p| {
        let is_turned = p.x < 0.0 && p.y > 0.6 && p.y < 0.7 && p.z.abs() < 0.05;
        if is_turned { p * DVec3::new(1.0, 1.0, -1.0) } else { p }
    });
    let left = turned.wrong_side_out(Moved::Wrapped);
    assert!(turned.faces_beside == smooth.faces_beside && left > 10, "{} {left}", turned.faces_beside);
}

#[test]
fn what_lies_much_lower_than_it_was_placed_has_fallen_down() {
    let placed = |by: f64, placed: bool| {
        let Sleeve { mut pattern, garment, state } = sleeve(0.1, |p| p - DVec3::Y * by);
        for piece in pattern.pieces.values_mut().filter(|_| placed) {
            let rotation = glam::DQuat::IDENTITY;
            let translation = DVec3::new(0.0, 0.5, 0.2);
            std::sync::Arc::make_mut(piece).placement =
                Some(crate::pattern::SpacePose::flat(translation, rotation));
        }
        fallen(&pattern, &garment, &state)
    };
    assert_eq!(
        (placed(0.1, true), placed(-0.5, true), placed(0.5, false)),
        (Vec::new(), Vec::new(), Vec::new())
    );
    let [found] = placed(0.3, true)[..] else { panic!("two sheets that are sewn fall together") };
    assert!((found.by - 0.3).abs() < 1e-9 && found.piece < 2, "{found:?}");
}

#[test]
fn what_lies_much_lower_than_its_tops_were_has_fallen_down() {
    let Sleeve { pattern, garment, state } = sleeve(0.1, |p| p);
    let tops = tops(&garment, &state);
    assert_eq!(tops.len(), 2);
    assert!(tops.iter().all(|top| (top - 0.5 - HEIGHT).abs() < 1e-9), "{tops:?}");
    let after = |by: f64| fallen_from(&tops, &pattern, &garment, &sleeve(0.1, |p| p - DVec3::Y * by).state);
    assert_eq!((after(0.1), after(-0.5)), (Vec::new(), Vec::new()));
    let [found] = after(0.3)[..] else { panic!("two sheets that are sewn fall together") };
    assert!((found.by - 0.3).abs() < 1e-9 && found.piece < 2, "{found:?}");
}

#[test]
fn draped_cloth_that_touches_the_body_nowhere_has_fallen_off_it() {
    let report = report(&sleeve(exact_radius(), |p| p - DVec3::Y * 5.0), cylinder(0.05, 0.2, 1.2, 48, 20));
    let told = |draped: bool| {
        faults(&report, if draped { Moved::Draped } else { Moved::Wrapped })
            .iter()
            .any(|(fault, _)| fault.words.contains("touches the body nowhere"))
    };
    assert_eq!((told(true), told(false)), (true, false));
}

#[test]
fn a_fold_all_round_is_told_from_cloth_inside_out() {
    let r = exact_radius();
    // Up, down again for 4 cm a little farther out, and up again still farther out; the crease lies across the triangles, too.
    let folded = |at: f64| {
        move |p: DVec3| {
            let (up, out) = match p.y - 0.5 {
                h if h < at => (h, 0.0),
                h if h < at + 0.04 => (2.0 * at - h, 0.004),
                h => (h - 0.08, 0.008),
            };
            DVec3::new(p.x * (r + out) / r, 0.5 + up, p.z * (r + out) / r)
        }
    };
    let at = |at| report(&sleeve(r, folded(at)), cylinder(r - 0.004, 0.2, 1.2, 96, 40));
    for across in [0.14, 0.143, 0.146, 0.149, 0.152] {
        let report = at(across);
        assert!(report.flipped_faces > 50, "{}", report.flipped_faces);
        assert_eq!(report.faces_in_folds, report.flipped_faces, "crease at {across}");
    }
    let report = at(0.14);
    let tells = |moved| {
        let found = faults(&report, moved);
        found.iter().any(|(problem, _)| problem.words.contains("wrong side out"))
    };
    assert!(tells(Moved::Wrapped), "a wrap should not fold");
    assert!(!tells(Moved::Carried) && !tells(Moved::Draped));
}

#[test]
fn a_body_thicker_than_a_sleeve_in_part_cuts_it() {
    let r = exact_radius();
    let body = cylinder(r - 0.01, 0.2, 0.65, 48, 9);
    let report = report(&sleeve(r, |p| DVec3::new(p.x + 0.02, p.y, p.z)), body);
    assert!(report.edges_through_body > 0 && report.body_edges_through_garment > 0);
    assert!(words(&report).contains("cut through each other"));
    assert_eq!(report.cuts_at_body_overlaps, 0);
}

#[test]
fn where_parts_of_the_body_pass_through_each_other_that_is_told() {
    let r = exact_radius();
    let mut body = cylinder(r - 0.03, 0.2, 0.65, 48, 9);
    let count = body.positions.len() as u32;
    let other = cylinder(r - 0.03, 0.3, 0.5, 48, 9);
    body.positions.extend(other.positions.iter().map(|p| *p + DVec3::X * r));
    body.triangles.extend(other.triangles.iter().map(|t| t.map(|v| v + count)));
    let report = report(&sleeve(r, |p| p), body);
    assert!(report.cuts_at_body_overlaps > 0);
    assert!(words(&report).contains("parts of the body pass through each other"));
}

#[test]
fn cloth_that_passes_through_itself_is_found() {
    let r = exact_radius();
    let press = |p: DVec3| DVec3::new(p.x, p.y, p.z * if p.y > 0.7 { -1.0 } else { 1.0 });
    let report = report(&sleeve(r, press), cylinder(0.02, 0.2, 0.3, 12, 2));
    assert!(report.self_crossings > 0);
    assert!(words(&report).contains("passes through itself"));
}

#[test]
fn what_is_not_on_the_body_is_named() {
    let r = exact_radius();
    let mut sleeve = sleeve(r, |p| p);
    let back = sleeve.garment.pieces[1].0;
    let front_vertices: Vec<u32> =
        sleeve.garment.corners.iter().filter(|c| c.piece != back).map(|c| c.vertex).collect();
    for c in &sleeve.garment.corners {
        if !front_vertices.contains(&c.vertex) {
            sleeve.state.mapped[c.vertex as usize] = false;
            sleeve.state.positions[c.vertex as usize] = DVec3::NAN;
        }
    }
    let report = report(&sleeve, cylinder(r - 0.01, 0.2, 1.2, 48, 20));
    assert!(
        words(&report).starts_with("piece back: it still lies in the pattern plane"),
        "{}",
        words(&report)
    );
    assert!(report.strain.max.is_finite());
}

#[test]
fn an_unsewn_seam_is_open() {
    let r = exact_radius();
    let mut sleeve = sleeve(r, |p| p);
    let seam = sleeve.garment.seam_pairs.pop().expect("a seam");
    let report = report(&sleeve, cylinder(r - 0.01, 0.2, 1.2, 48, 20));
    assert_eq!((report.seams.closed, report.seams.open), (1, 1), "{seam:?}");
    assert!(words(&report).contains("1 of 2 seams are open"));
}

/// A sleeve with all faults at once: squeezed, shifted into the body, crumpled so that it crosses itself.
fn faulty_sleeve() -> Sleeve {
    sleeve(exact_radius() * 1.04, |p| {
        let crumple = if p.y > 0.68 { 0.05 * (60.0 * p.y).sin() } else { 0.0 };
        let folded = DVec3::new(p.x * 1.06 + 0.012 + crumple, p.y + crumple * (40.0 * p.x).cos(), p.z * 0.95);
        // Nothing may touch exactly, or the last digit would decide.
        let wave = DVec3::new((31.0 * p.y).sin(), (23.0 * p.z + 1.0).sin(), (29.0 * p.x + 2.0).sin()) * 0.002;
        let turned = p.x.abs() < 0.03 && p.z > 0.0;
        wave + if turned { folded * DVec3::new(-0.93, 1.0, 1.0) } else { folded }
    })
}

fn faulty_body() -> TriMesh {
    cylinder(exact_radius() - 0.004, 0.2, 0.7, 40, 11)
}

/// How many faces lie wrong side out when, of facets equally near, the kindest is taken, and when the harshest is: over
/// an edge of the body all points are equally near to two.
fn wrong_side_bounds(sleeve: &Sleeve, body: TriMesh) -> (usize, usize) {
    let surface = Surface::new(body).expect("a body");
    let (mut least, mut most) = (0, 0);
    for vs in &sleeve.garment.triangles {
        let [a, b, c] = vs.map(|v| sleeve.state.positions[v as usize]);
        let centre = (a + b + c) / 3.0;
        let Some(near) = surface.nearest_within(centre, NEAR) else { continue };
        let normal = (b - a).cross(c - a).normalize();
        let tied = (0..surface.mesh.triangles.len()).filter(|&t| {
            let [a, b, c] = surface.mesh.corners(t);
            let point = closest_on_triangle(centre, a, b, c).0;
            ((point - centre).length() - near.distance.abs()).abs() < 1e-12
        });
        let wrong: Vec<bool> = tied.map(|t| normal.dot(surface.face_normals[t]) < WRONG_SIDE).collect();
        least += usize::from(wrong.iter().all(|&w| w));
        most += usize::from(wrong.iter().any(|&w| w));
    }
    (least, most)
}

/// The expected figures are those of a program of our own that shares no code with this one: numpy, scipy's k-d tree
/// and libigl's winding numbers and distances, run on this garment and body as OBJ files.
#[test]
fn figures_agree_with_an_independent_judge() {
    let found = report(&faulty_sleeve(), faulty_body());
    let near = |ours: f64, theirs: f64| assert!((ours / theirs - 1.0).abs() < 1e-5, "{ours} is not {theirs}");
    near(found.strain.max, 6.591288519772981);
    near(found.strain.p99, 3.357161766496022);
    near(found.strain.p95, 1.9218885271161636);
    near(found.strain.rms, 0.8600799558003759);
    near(found.strain.median, 0.04560080029644997);
    near(found.strain.stretch_p99, 3.357161766496022);
    near(found.strain.compress_p99, 0.22548415171529212);
    near(found.pieces[0].area_change, 0.7055418798987054);
    near(found.pieces[1].perimeter_change, 0.46602891812309033);
    near(found.penetration.max_depth, 0.01800280199999993);
    near(found.clearance.median, 0.01673037827195145);
    near(found.clearance.p95, 0.09900549085835297);
    assert_eq!((found.strain.edges, found.vertices, found.triangles), (2050, 700, 1320));
    assert_eq!((found.vertices_shared_by_pieces, found.pieces_in_space, found.degenerate_faces), (32, 1, 0));
    assert_eq!((found.folded_edges, found.interior_edges, found.self_crossings), (106, 1940, 93));
    assert_eq!((found.penetration.vertices, found.penetration.faces), (42, 136));
    assert_eq!((found.edges_through_body, found.body_edges_through_garment), (163, 127));
    assert_eq!(found.faces_near_body, 727);
    let (least, most) = wrong_side_bounds(&faulty_sleeve(), faulty_body());
    assert!(least <= 51 && 51 <= most && most - least < 8, "{least} to {most}");
    assert!(least <= found.flipped_faces && found.flipped_faces <= most, "{}", found.flipped_faces);
    let [upper, lower] = &found.openings[..] else { panic!("{:?}", found.openings) };
    near(upper.length, 1.0993395540989692);
    near(upper.height, 0.8024929602249999);
    near(lower.length, 0.9172592530494994);
    assert!(!upper.body_through && lower.body_through);
}

/// A sleeve that is stretched upwards, most in the middle of each sheet: by these shares.
fn tight(front: f64, back: f64) -> Vec<String> {
    let r = WIDTH / std::f64::consts::PI;
    let lifted = |p: DVec3| {
        let share = if p.x > 0.0 { front } else { back } * p.x.abs() / r;
        DVec3::new(p.x, 0.5 + (p.y - 0.5) * (1.0 + share), p.z)
    };
    let sleeve = sleeve(r, lifted);
    let report = report(&sleeve, cylinder(0.1, 0.0, 1.5, 24, 30));
    let places = tight_places(&report, &sleeve.garment, &sleeve.state, || None);
    let most = tightest(&report, &sleeve.garment, &sleeve.state, || None);
    assert_eq!(places.first().map(|place| &place.tight), most.as_ref());
    for place in &places {
        let flat = FlatPiece::new(&sleeve.garment, place.piece).inside(&sleeve.garment, place.flat);
        let there = flat.and_then(|flat| flat.point(&sleeve.garment, &sleeve.state)).expect("on the piece");
        assert!(there.distance(DVec3::from_array(place.tight.at)) < 1e-9, "{place:?}");
        assert!(place.tight.strain > 0.1, "{place:?}");
    }
    places.into_iter().map(|place| place.tight.piece).collect()
}

#[test]
fn tight_pieces_are_told_the_tightest_first() {
    assert!(tight(0.0, 0.01).is_empty(), "it fits");
    assert_eq!(tight(0.3, 0.0), ["front"]);
    assert_eq!(tight(0.2995, 0.3), ["back", "front"]);
}

#[test]
fn sides_of_limbs_are_told_in_words() {
    let at = |landmark: &str| {
        let landmark = Some(landmark.to_owned());
        Tight { piece: "back".to_owned(), at: [0.0; 3], landmark, strain: 0.095 }.to_string()
    };
    assert_eq!(at("upper_arm_right_high_x"), "back near upper arm right, inside, +9.5 %");
    assert_eq!(at("thigh_left_high_x"), "back near thigh left, outside, +9.5 %");
    assert_eq!(at("waist_front"), "back near waist front, +9.5 %");
}

#[test]
fn what_is_not_dressed_and_too_small_is_told_by_how_much() {
    let smaller = |by: f64| Smaller { place: "waist".to_owned(), body: 0.72, pattern: 0.72 - by };
    let told = |self_crossings: usize, by: f64| {
        let strain_causes = Causes { smaller: vec![smaller(by)], ..Causes::default() };
        words(&Report { triangles: 1, self_crossings, strain_causes, ..Report::default() })
    };
    let words = "the pattern is 4.0 cm smaller than the body round the waist (68.0 for 72.0 cm)";
    assert!(told(3, 0.04).ends_with(&format!("in 3 places; {words}\n")), "{}", told(3, 0.04));
    assert!(!told(3, 0.005).contains("smaller"));
    assert_eq!(told(0, 0.04), "");
}

#[test]
fn only_what_is_tacked_to_something_else_is_applied() {
    let corners = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
    let mut pattern = Pattern::default();
    let [a, b, c] = ["a", "b", "c"].map(|name| pattern.add_piece(Piece::polygon(name, &corners)));
    let side = |piece, edge| EdgeRef { piece, edge };
    pattern.add_seam(Seam::of_edges([side(a, 1), side(b, 3)], false));
    let at = |piece| PiecePoint { piece, at: DVec2::splat(0.5) };
    // Sewn to each other they are one part, and a button is no tack.
    pattern.add_button(Button::tack(at(a), at(b)));
    pattern.add_button(Button { tack: false, ..Button::tack(at(a), at(c)) });
    assert!(applied(&pattern).is_empty());
    let tack = pattern.add_button(Button::tack(at(b), at(c)));
    assert_eq!(applied(&pattern), [c].into());
    pattern.buttons.get_mut(&tack).expect("the tack").open = true;
    assert!(applied(&pattern).is_empty(), "unfastened it holds nothing");
}
