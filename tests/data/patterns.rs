//! Patterns drawn by others.

use kurbo::ParamCurve;
use toile::io::garmentcode;
use toile::pattern::{Pattern, Piece};

fn read(name: &str) -> Option<Pattern> {
    let bytes = crate::bytes(&format!("patterns/{name}"))?;
    Some(garmentcode::read(&bytes).unwrap_or_else(|e| panic!("{name}: {e}")))
}

/// Panels, edges, stitches, area in square metres, stitches whose sides differ by more than 2 %, largest ratio.
fn check(name: &str, panels: usize, edges: usize, stitches: usize, area: f64, gathered: usize, ratio: f64) {
    let Some(pattern) = read(name) else { return };
    let pieces = || pattern.pieces.values();
    assert_eq!(pieces().count(), panels, "{name}");
    assert_eq!(pieces().map(|p| p.outline.len()).sum::<usize>(), edges, "{name}");
    assert_eq!(pattern.seams.len(), stitches, "{name}");
    let found = pieces().map(|p| p.signed_area().abs()).sum::<f64>();
    assert!((found / area - 1.0).abs() < 0.003, "{name}: {found} square metres");
    let ratios: Vec<f64> = pattern
        .seams
        .values()
        .map(|s| {
            let [a, b] = s.sides.map(|side| pattern.pieces[&side.piece].edge_length(side.edge));
            a.max(b) / a.min(b)
        })
        .collect();
    assert_eq!(ratios.iter().filter(|&&r| r > 1.02).count(), gathered, "{name}");
    let largest = ratios.iter().copied().fold(1.0, f64::max);
    assert!((largest - ratio).abs() < 0.006, "{name}: {largest}");
    check_sheet(name, &pattern);
}

/// No two boxes overlap, and every piece shows its front.
fn check_sheet(name: &str, pattern: &Pattern) {
    let boxes: Vec<_> = pattern.pieces.values().map(|p| sheet_box(p)).collect();
    for (i, (a_lo, a_hi)) in boxes.iter().enumerate() {
        for (b_lo, b_hi) in &boxes[..i] {
            assert!((a_lo.cmpge(*b_hi) | a_hi.cmple(*b_lo)).any(), "{name}: two pieces overlap");
        }
    }
    assert!(pattern.pieces.values().all(|p| p.pose.flipped == (p.signed_area() < 0.0)), "{name}");
}

fn sheet_box(piece: &Piece) -> (glam::DVec2, glam::DVec2) {
    let points = piece.flattened(1e-3).into_iter().map(|p| piece.pose.plane_from_piece(p));
    let lower = points.clone().reduce(glam::DVec2::min).expect("an outline");
    (lower, points.reduce(glam::DVec2::max).expect("an outline"))
}

#[test]
fn garmentcode_patterns_are_read_whole() {
    check("garmentcode/shirt_mean_specification.json", 8, 48, 18, 0.64, 0, 1.0);
    check("garmentcode/dress_pencil_specification.json", 6, 60, 23, 1.164, 11, 1.30);
    check("garmentcode/js_mean_all_specification.json", 12, 126, 57, 1.847, 6, 1.10);
    check("garmentcode/hoody_mean_specification.json", 6, 34, 12, 0.594, 0, 1.0);
    check("garmentcode/flare_skirt_specification.json", 4, 16, 6, 0.758, 2, 1.09);
    check("garmentcode/tee_mean_all_specification.json", 8, 44, 16, 0.575, 0, 1.0);
    check("garmentcode/pants_mean_all_specification.json", 6, 54, 24, 0.587, 2, 1.10);
    check("garmentcode/skirt2_mean_all_specification.json", 4, 16, 6, 0.484, 2, 1.30);
    check("garmentcode/circle_skirt_mean_all_specification.json", 4, 16, 6, 0.768, 1, 1.09);
    check("garmentcode/dress_fitted_circle_mean_all_specification.json", 6, 66, 28, 1.029, 14, 1.08);
    check("garmentcode/rand_1003_specification.json", 10, 74, 30, 1.439, 16, 1.62);
    check("garmentcode/rand_1000_specification.json", 4, 50, 16, 0.121, 4, 1.18);
}

#[test]
fn patterns_of_the_older_dialect_are_read_whole() {
    check("garment-pattern-generator/tee.json", 6, 33, 12, 0.578, 0, 1.0);
    check("garment-pattern-generator/skirt_4_panels.json", 4, 24, 8, 0.748, 0, 1.02);
    check("garment-pattern-generator/pants_straight_sides.json", 4, 20, 6, 0.646, 0, 1.0);
    check("garment-pattern-generator/jacket_hood.json", 9, 47, 18, 0.718, 0, 1.0);
}

#[test]
fn the_commented_template_is_read() {
    let Some(pattern) = read("garment-pattern-generator/template_spec_with_comments.jsonc") else { return };
    assert_eq!((pattern.pieces.len(), pattern.seams.len()), (2, 2));
}

/// Outlines and places of two patterns agree within 1e-9 m, and their seams join the same edges.
fn check_same(name: &str, a: &Pattern, b: &Pattern) {
    assert_eq!(a.pieces.len(), b.pieces.len(), "{name}");
    let near = |p: glam::DVec3, q: glam::DVec3| assert!(p.distance(q) < 1e-9, "{name}: {p} {q}");
    for (p, q) in a.pieces.values().zip(b.pieces.values()) {
        assert_eq!((&p.name, &p.label, p.outline.len()), (&q.name, &q.label, q.outline.len()), "{name}");
        for i in 0..p.outline.len() {
            assert_eq!(p.outline[i].label, q.outline[i].label, "{name}");
            // By their parameters: places by arc length are only to 1e-7.
            let points = |piece: &Piece| -> Vec<glam::DVec2> {
                let at = |s: &kurbo::PathSeg| [0.0, 0.25, 0.5, 0.75, 1.0].map(|t| s.eval(t));
                let points = piece.edge_segments(i).iter().flat_map(at).collect::<Vec<_>>();
                points.into_iter().map(|p| glam::DVec2::new(p.x, p.y)).collect()
            };
            for (at, again) in points(p).into_iter().zip(points(q)) {
                near(at.extend(0.0), again.extend(0.0));
                let place = |piece: &Piece, at: glam::DVec2| {
                    piece.placement.map_or(glam::DVec3::ZERO, |s| s.rotation * at.extend(0.0) + s.translation)
                };
                near(place(p, at), place(q, again));
            }
        }
    }
    let seams = |pattern: &Pattern| pattern.seams.values().copied().collect::<Vec<_>>();
    assert_eq!(seams(a), seams(b), "{name}");
}

#[test]
fn garmentcode_goes_out_and_in_again_unchanged() {
    let Some(data) = crate::data() else { return };
    let mut count = 0;
    for folder in ["garmentcode", "garment-pattern-generator"] {
        let files = std::fs::read_dir(data.join("patterns").join(folder)).expect("the folder");
        for file in files.map(|f| f.expect("an entry").file_name().to_string_lossy().into_owned()) {
            let name = format!("{folder}/{file}");
            if !file.contains(".json") || file.contains("_design") {
                continue;
            }
            let pattern = read(&name).expect("data");
            let written = garmentcode::write(&pattern);
            assert!(written.left_out.is_empty(), "{name}: {:?}", written.left_out);
            let again = garmentcode::read(&written.bytes).unwrap_or_else(|e| panic!("{name}: {e}"));
            check_same(&name, &pattern, &again);
            count += 1;
        }
    }
    assert_eq!(count, 17, "every pattern of the folders");
}

#[test]
fn a_design_file_is_no_pattern() {
    let Some(bytes) = crate::bytes("patterns/garmentcode/tee_mean_all_design.json") else { return };
    let error = garmentcode::read(&bytes).expect_err("no pattern").to_string();
    assert!(error.contains("no GarmentCode pattern"), "{error}");
}

/// Panels stand off the body with their fronts outward; the loops' directions and the rotations must agree on that.
#[test]
fn fronts_look_away_from_the_body() {
    for name in ["shirt_mean", "tee_mean_all", "skirt2_mean_all", "pants_mean_all", "dress_pencil"] {
        let Some(pattern) = read(&format!("garmentcode/{name}_specification.json")) else { return };
        for piece in pattern.pieces.values() {
            let pose = piece.placement.expect("a placement");
            let outer = pose.rotation * glam::DVec3::Z * piece.signed_area().signum();
            let points = piece.flattened(1e-3);
            let centre = points.iter().sum::<glam::DVec2>() / points.len() as f64;
            let centre = pose.rotation * centre.extend(0.0) + pose.translation;
            assert!(outer.z * centre.z > 0.0, "{name}, {}", piece.name);
        }
    }
}

/// Sewn edges of a placed garment lie near each other, end to end.
#[test]
fn stitched_edges_face_each_other() {
    let Some(pattern) = read("garmentcode/tee_mean_all_specification.json") else { return };
    for seam in pattern.seams.values() {
        let ends = seam.sides.map(|side| {
            let piece = &pattern.pieces[&side.piece];
            let pose = piece.placement.expect("a placement");
            let (a, b) = piece.edge_ends(side.edge);
            [a, b].map(|p| pose.rotation * p.extend(0.0) + pose.translation)
        });
        // The slivers at a shoulder are placed at any angle.
        if ends.iter().any(|[a, b]| a.distance(*b) < 0.03) {
            continue;
        }
        let along = (ends[0][1] - ends[0][0]).dot(ends[1][1] - ends[1][0]);
        let names = seam.sides.map(|side| &pattern.pieces[&side.piece].name);
        assert!(along < 0.0, "{names:?} {ends:?}");
    }
}
