//! Layers of cloth that run into each other.

use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};
use toile::body::{Surface, mannequin};
use toile::cloth::{ClothState, build};
use toile::contact::Intersections;
use toile::fit::{BodyIndex, measure, verdict};
use toile::geometry::ids::PieceId;
use toile::pattern::{Edge, EdgeRef, EdgeShape, Pattern, Piece, Seam, SpacePose};
use toile::relax::RelaxSettings;
use toile::wrap::{Dressing, Phase, stretches, suggested};

/// Two sheets of 20 cm a finger apart, but for a bump of each that sticks through the other, outer or inner sides facing.
fn check(apart: f64) {
    let mut pattern = Pattern::default();
    let square = [[0.0, 0.0], [0.2, 0.0], [0.2, 0.2], [0.0, 0.2]].map(DVec2::from);
    for name in ["one", "other"] {
        pattern.add_piece(Piece::polygon(name, &square));
    }
    let (garment, _) = build(&pattern, 0.02);
    let mut state = ClothState {
        positions: vec![DVec3::ZERO; garment.vertex_count],
        mapped: vec![true; garment.vertex_count],
    };
    for corner in &garment.corners {
        let bump = |x: f64| (-((corner.uv.x - x).powi(2) + (corner.uv.y - 0.1).powi(2)) / 0.0004).exp();
        let height = apart * (1.3 * bump(0.1) - 0.5);
        state.positions[corner.vertex as usize] = if corner.piece == PieceId(1) {
            DVec3::new(corner.uv.x, corner.uv.y, height)
        } else {
            DVec3::new(0.2 - corner.uv.x, corner.uv.y, -height)
        };
    }
    let met = Intersections::new(&garment, &state);
    assert!(!met.places.is_empty());
    let ways = met.ways(&garment, &state);
    let sent: Vec<f64> = garment
        .corners
        .iter()
        .map(|c| ways[c.vertex as usize].z * apart * if c.piece == PieceId(1) { -1.0 } else { 1.0 })
        .collect();
    assert!(sent.iter().any(|&way| way > 0.0) && sent.iter().all(|&way| way >= 0.0), "{sent:?}");
}

#[test]
fn layers_with_outer_sides_facing_part() {
    check(0.01);
}

#[test]
fn layers_with_inner_sides_facing_part() {
    check(-0.01);
}

/// A tube whose front is pushed through its back by 5 cm: what has come out there is sent back, all of it, and nothing else.
#[test]
fn what_is_deep_on_the_wrong_side_knows_its_way_out() {
    let (round, high) = (0.6, 0.3);
    let mut pattern = Pattern::default();
    let corners = [[0.0, 0.0], [round, 0.0], [round, high], [0.0, high]].map(DVec2::from);
    let piece = pattern.add_piece(Piece::polygon("tube", &corners));
    pattern.add_seam(Seam::of_edges([1, 3].map(|edge| EdgeRef { piece, edge }), false));
    let (garment, _) = build(&pattern, 0.01);
    for inside_out in [1.0, -1.0] {
        let mut state = ClothState {
            positions: vec![DVec3::ZERO; garment.vertex_count],
            mapped: vec![true; garment.vertex_count],
        };
        for corner in &garment.corners {
            let turn = (corner.uv.x / round - 0.5) * std::f64::consts::TAU;
            let radius = round / std::f64::consts::TAU;
            let from = DVec2::new(corner.uv.x - round / 2.0, corner.uv.y - high / 2.0).length();
            let dent = (2.0 * radius + 0.05) * (-(from / 0.04).powi(4)).exp();
            let at = DVec3::new(radius * turn.sin(), corner.uv.y, radius * turn.cos() - dent);
            state.positions[corner.vertex as usize] = DVec3::new(at.x * inside_out, at.y, at.z);
        }
        let met = Intersections::new(&garment, &state);
        assert!(!met.places.is_empty());
        let (ways, any) = met.ways_out(&garment, &state);
        assert!(any);
        let back = -round / std::f64::consts::TAU;
        let farthest =
            (0..garment.vertex_count).min_by(|&a, &b| state.positions[a].z.total_cmp(&state.positions[b].z));
        let farthest = farthest.expect("a vertex");
        assert!(state.positions[farthest].z < back - 0.04);
        assert!(ways[farthest].z > 0.9, "{}", ways[farthest]);
        assert_eq!(met.ways(&garment, &state)[farthest], DVec3::ZERO, "it is far from where layers meet");
        let far = |v: usize| (state.positions[v].y - high / 2.0).abs() > 0.09;
        assert!((0..garment.vertex_count).filter(|&v| far(v)).all(|v| ways[v] == DVec3::ZERO));
    }
}

/// A tube worn over another is pushed into it by 3 cm at its front: what is in there is sent out, and nothing of the inner one.
#[test]
fn what_is_worn_over_comes_out_of_what_lies_under() {
    let high = 0.3;
    let mut pattern = Pattern::default();
    for (name, round, layer) in [("inner", 0.6, 0), ("outer", 0.63, 1)] {
        let corners = [[0.0, 0.0], [round, 0.0], [round, high], [0.0, high]].map(DVec2::from);
        let piece = pattern.add_piece(Piece { layer, ..Piece::polygon(name, &corners) });
        pattern.add_seam(Seam::of_edges([1, 3].map(|edge| EdgeRef { piece, edge }), false));
    }
    let (garment, _) = build(&pattern, 0.01);
    let mut state = ClothState {
        positions: vec![DVec3::ZERO; garment.vertex_count],
        mapped: vec![true; garment.vertex_count],
    };
    let mut over = vec![false; garment.vertex_count];
    for corner in &garment.corners {
        let is_over = garment.layer(corner.piece) == 1;
        let round = if is_over { 0.63 } else { 0.6 };
        let turn = (corner.uv.x / round - 0.5) * std::f64::consts::TAU;
        let from = DVec2::new(corner.uv.x - round / 2.0, corner.uv.y - high / 2.0).length();
        let dent = if is_over { 0.03 * (-(from / 0.04).powi(4)).exp() } else { 0.0 };
        let radius = round / std::f64::consts::TAU - dent;
        let v = corner.vertex as usize;
        state.positions[v] = DVec3::new(radius * turn.sin(), corner.uv.y, radius * turn.cos());
        over[v] = is_over;
    }
    let met = Intersections::new(&garment, &state);
    assert!(!met.places.is_empty());
    let (ways, any) = met.ways_out(&garment, &state);
    assert!(any);
    let radius = |v: usize| state.positions[v].x.hypot(state.positions[v].z);
    // Not where the wall of the dent is steep, that has no clear way.
    let deep = |v: &usize| over[*v] && radius(*v) < 0.6 / std::f64::consts::TAU - 0.02;
    assert!((0..over.len()).filter(deep).count() > 10);
    for v in (0..over.len()).filter(deep) {
        assert!(ways[v].z > 0.7, "{} at {}", ways[v], state.positions[v]);
        assert_eq!(met.ways(&garment, &state)[v], DVec3::ZERO, "it is far from where layers meet");
    }
    let behind = |v: usize| state.positions[v].z < 0.0;
    assert!((0..over.len()).filter(|&v| behind(v)).all(|v| ways[v] == DVec3::ZERO));
}

/// Front and back of a skirt that is a whole ring of cloth, `waist` and `length` metres.
fn ring_skirt(waist: f64, length: f64) -> Pattern {
    let inner = waist / std::f64::consts::TAU;
    let outer = inner + length;
    let mut pattern = Pattern::default();
    let mut add = |name: &str, front: bool| {
        let edge = |x: f64, y: f64, shape: EdgeShape| Edge {
            start: DVec2::new(x, y),
            shape,
            label: None,
            ..Edge::default()
        };
        let arc = |radius: f64, sweep: bool| EdgeShape::Arc { radius, large: false, sweep };
        let mut piece = Piece::polygon(name, &[]);
        piece.outline = vec![
            edge(-outer, 0.0, arc(outer, true)),
            edge(0.0, -outer, arc(outer, true)),
            edge(outer, 0.0, EdgeShape::Line),
            edge(inner, 0.0, arc(inner, false)),
            edge(0.0, -inner, arc(inner, false)),
            edge(-inner, 0.0, EdgeShape::Line),
        ];
        let side = if front { 0.0 } else { std::f64::consts::PI };
        let rotation = DQuat::from_rotation_y(side);
        let translation = rotation * DVec3::new(0.0, 1.1, 0.2);
        piece.placement = Some(SpacePose::flat(translation, rotation));
        pattern.add_piece(piece)
    };
    let (front, back) = (add("skirt front", true), add("skirt back", false));
    for (edge, other) in [(2, 5), (5, 2)] {
        let sides = [EdgeRef { piece: front, edge }, EdgeRef { piece: back, edge: other }];
        pattern.add_seam(Seam::of_edges(sides, false));
    }
    pattern
}

fn mannequins_surface() -> Arc<Surface> {
    Arc::new(Surface::new(mannequin::default().mesh.clone()).expect("a body"))
}

#[test]
fn strokes_round_the_waist_end_where_a_flared_skirt_is_sewn() {
    let (body, offset) = (mannequins_surface(), RelaxSettings::default().offset);
    let marks = suggested(&ring_skirt(0.74, 0.5), &body, offset);
    for pair in stretches(&marks, &body, offset) {
        assert!(pair.stretch().abs() < 0.2, "{pair:?}");
    }
    assert_eq!(marks.cloth.len(), 4);
}

#[test]
fn a_skirt_with_deep_folds_is_not_left_crossing_itself() {
    let (body, pattern, edge) = (mannequins_surface(), ring_skirt(0.74, 0.5), 0.025);
    let settings = RelaxSettings::default();
    let marks = suggested(&pattern, &body, settings.offset);
    let garment = Arc::new(build(&pattern, edge).0);
    let (dressing, mut state, problems) = Dressing::new(garment.clone(), body.clone(), &marks, settings);
    assert!(problems.is_empty(), "{problems:?}");
    let mut dressing = dressing.expect("a dressing");
    while dressing.step(&mut state) != Phase::AtRest {}
    assert_eq!(verdict(&measure(&pattern, &garment, &state, &BodyIndex::new(&body))), []);
}
