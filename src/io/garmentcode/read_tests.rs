use super::*;

/// Two squares of 20 cm; the second is drawn clockwise.
fn file(first_edges: &str, stitches: &str) -> String {
    format!(
        r#"{{"properties": {{"units_in_meter": 100, "curvature_coords": "relative"}},
        "pattern": {{"panels": {{
          "front": {{"vertices": [[0,0],[20,0],[20,20],[0,20]], "edges": [{first_edges}],
            "translation": [-10, 100, 20], "rotation": [0, 0, 0]}},
          "back": {{"vertices": [[0,0],[0,20],[20,20],[20,0]], "label": "body",
            "edges": [{{"endpoints": [0,1], "label": "side"}}, {{"endpoints": [1,2]}}, {{"endpoints": [2,3]}},
                      {{"endpoints": [3,0]}}],
            "translation": [-10, 100, -20], "rotation": [0, 0, 0]}}}},
          "stitches": [{stitches}]}}}}"#
    )
}

const SQUARE: &str =
    r#"{"endpoints": [0,1]}, {"endpoints": [1,2]}, {"endpoints": [2,3]}, {"endpoints": [3,0]}"#;
const STITCH: &str = r#"[{"panel": "front", "edge": 1}, {"panel": "back", "edge": 2}]"#;

fn good(first_edges: &str) -> Piece {
    let pattern = read(file(first_edges, STITCH).as_bytes()).expect(first_edges);
    let id = pattern.piece_named("front").expect("front");
    (*pattern.pieces[&id]).clone()
}

fn bad(first_edges: &str, stitches: &str, expected: &str) {
    let error = read(file(first_edges, stitches).as_bytes()).expect_err(expected).to_string();
    assert!(error.contains(expected), "expected {expected:?}, got {error:?}");
}

#[test]
fn a_small_pattern_is_read() {
    let pattern = read(file(SQUARE, STITCH).as_bytes()).expect("a pattern");
    let [front, back] = ["front", "back"].map(|n| pattern.piece_named(n).expect(n));
    assert!((pattern.pieces[&front].signed_area() - 0.04).abs() < 1e-12);
    // The mirrored panel keeps the direction of the file and is seen from its front.
    assert!((pattern.pieces[&back].signed_area() + 0.04).abs() < 1e-12);
    assert!(pattern.pieces[&back].pose.flipped && !pattern.pieces[&front].pose.flipped);
    assert_eq!(pattern.pieces[&back].label.as_deref(), Some("body"));
    assert_eq!(pattern.pieces[&back].outline[0].label.as_deref(), Some("side"));
    let seam = pattern.seams.values().next().expect("a seam");
    assert_eq!(
        seam.sides.map(|s| s.whole_edge()),
        [Some(EdgeRef { piece: front, edge: 1 }), Some(EdgeRef { piece: back, edge: 2 })]
    );
    assert!(!seam.same_direction);
}

#[test]
fn the_two_dialects_of_a_quadratic_agree() {
    let (_, rest) = SQUARE.split_once(", ").expect("four edges");
    let old = good(&format!(r#"{{"endpoints": [0,1], "curvature": [0.5, 0.2]}}, {rest}"#));
    let new = good(&format!(
        r#"{{"endpoints": [0,1], "curvature": {{"type": "quadratic", "params": [[0.5, 0.2]]}}}}, {rest}"#
    ));
    assert_eq!(old, new);
    let EdgeShape::Quadratic { control } = old.outline[0].shape else { panic!("{:?}", old.outline[0]) };
    assert!((control - DVec2::new(0.1, 0.04)).length() < 1e-12);
}

#[test]
fn an_arc_to_the_right_bulges_out_of_a_counter_clockwise_outline() {
    let edges = SQUARE.replacen(
        r#""endpoints": [0,1]"#,
        r#""endpoints": [0,1], "curvature": {"type": "circle", "params": [10, 0, 1]}"#,
        1,
    );
    let half_disc = std::f64::consts::PI * 0.1 * 0.1 / 2.0;
    assert!((good(&edges).signed_area() - 0.04 - half_disc).abs() < 1e-4);
}

#[test]
fn rotations_are_about_x_first_then_y_then_z() {
    let text = file(SQUARE, "").replacen("[0, 0, 0]", "[90, 90, 90]", 1);
    let pattern = read(text.as_bytes()).expect("a pattern");
    let id = pattern.piece_named("front").expect("front");
    let pose = pattern.pieces[&id].placement.expect("a placement");
    // y becomes z by the quarter turn about x, x by that about y, y by that about z.
    assert!((pose.rotation * DVec3::Y - DVec3::Y).length() < 1e-12);
    assert!((pose.rotation * DVec3::X - DVec3::NEG_Z).length() < 1e-12);
    assert!((pose.translation - DVec3::new(-0.1, 1.0, 0.2)).length() < 1e-12);
}

#[test]
fn a_lapel_is_sewn_start_to_start() {
    let stitch = STITCH.replacen("]", r#", "right_wrong"]"#, 1);
    let pattern = read(file(SQUARE, &stitch).as_bytes()).expect("a pattern");
    assert!(pattern.seams.values().all(|s| s.same_direction));
}

#[test]
fn faults_are_named_with_their_place() {
    bad(
        r#"{"endpoints": [0,1]}, {"endpoints": [1,0]}"#,
        "",
        "/pattern/panels/front/edges: a panel needs at least 3",
    );
    bad(
        &SQUARE.replace("[1,2]", "[1,7]"),
        "",
        "/pattern/panels/front/edges/1/endpoints/1: index 7 is out of range 0..=3",
    );
    bad(&SQUARE.replace("[1,2]", "[1,-1]"), "", "index -1 is out of range");
    bad(&SQUARE.replace("[1,2]", "[1,1.5]"), "", "index 1.5 is out of range");
    bad(&SQUARE.replace("[1,2]", "[1,3]"), "", "/pattern/panels/front/edges/1: the edge ends at vertex 3");
    let closing = format!(r#"{SQUARE}, {{"endpoints": [0,0]}}"#);
    bad(&closing, "", "/pattern/panels/front/edges/4: the edge has no length");
    bad(SQUARE, &STITCH.replace("back", "bakc"), "/pattern/stitches/0/1/panel: there is no panel \"bakc\"");
    bad(SQUARE, &STITCH.replace("2}", "4}"), "/pattern/stitches/0/1/edge: index 4 is out of range 0..=3");
    bad(SQUARE, &format!("{STITCH}, {STITCH}"), "/pattern/stitches/1/0: this edge is sewn twice");
    bad(SQUARE, r#"[{"panel": "front", "edge": 1}]"#, "/pattern/stitches/0: a stitch joins 2 edges");
    let arc = r#""endpoints": [1,2], "curvature": {"type": "circle", "params": [9, 0, 1]}"#;
    bad(&SQUARE.replace(r#""endpoints": [1,2]"#, arc), "", "curvature/params/0: an arc of radius");
    let spline = arc.replace("circle", "spline");
    bad(&SQUARE.replace(r#""endpoints": [1,2]"#, &spline), "", "\"spline\" is none of");
}

#[test]
fn every_truncation_is_an_error() {
    let text = file(SQUARE, STITCH);
    for end in 0..text.len() {
        assert!(read(&text.as_bytes()[..end]).is_err(), "truncated at byte {end}");
    }
}

#[test]
fn units_are_never_guessed() {
    let text = file(SQUARE, STITCH);
    let none =
        read(text.replace("\"units_in_meter\": 100,", "").as_bytes()).expect_err("no units").to_string();
    assert!(none.contains("units_in_meter"), "{none}");
    assert!(read(text.replace("100,", "0,").as_bytes()).is_err());
    let far = read(text.replace("[20,20]", "[20,20000]").as_bytes()).expect_err("far").to_string();
    assert!(far.contains("/pattern/panels/front/vertices/2/1: 200 m is beyond 100 m"), "{far}");
}
