//! Layers of cloth that run into each other.

use glam::DVec3;
use toile::cloth::{ClothState, build};
use toile::contact::layers::parting;
use toile::geometry::ids::PieceId;
use toile::pattern::{Pattern, Piece};

/// Two sheets of 20 cm a finger apart, but for a bump of each that sticks through the other, outer or inner sides facing.
fn check(apart: f64) {
    let mut pattern = Pattern::default();
    let square = [[0.0, 0.0], [0.2, 0.0], [0.2, 0.2], [0.0, 0.2]].map(glam::DVec2::from);
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
