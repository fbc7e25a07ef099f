//! Layers of cloth that run into each other.

use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};
use toile::body::{Surface, mannequin};
use toile::cloth::{ClothState, build};
use toile::contact::layers::parting;
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
    let (ways, places) = parting(&garment, &state);
    assert!(places > 0);
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
        piece.placement = Some(SpacePose { translation, rotation });
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
