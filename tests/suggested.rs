//! Marks suggested from where pieces are placed.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};
use toile::body::{Surface, mannequin};
use toile::pattern::{EdgeRef, Pattern, Piece, Seam, SpacePose};
use toile::relax::RelaxSettings;
use toile::wrap::{stretches, suggested};

/// A skirt of four panels round the mannequin, the sides among them, each so wide, metres.
fn skirt(width: f64) -> Pattern {
    let corners = [(0.0, 0.0), (width, 0.0), (width, 0.5), (0.0, 0.5)].map(DVec2::from);
    let mut pattern = Pattern::default();
    let pieces = ["front", "left", "back", "right"].map(|name| {
        let piece = Piece::polygon(name, &corners);
        pattern.add_piece(piece)
    });
    for (i, &id) in pieces.iter().enumerate() {
        let rotation = DQuat::from_rotation_y(FRAC_PI_2 * i as f64);
        let translation = rotation * DVec3::new(-width / 2.0, 0.55, 0.25);
        let piece = Arc::make_mut(pattern.pieces.get_mut(&id).expect("a piece"));
        piece.placement = Some(SpacePose::flat(translation, rotation));
        let next = pieces[(i + 1) % 4];
        let sides = [EdgeRef { piece: id, edge: 1 }, EdgeRef { piece: next, edge: 3 }];
        pattern.add_seam(Seam::of_edges(sides, false));
    }
    pattern
}

#[test]
fn a_ring_leaves_room_for_the_panels_at_its_sides() {
    let surface = Surface::new(mannequin::default().mesh.clone()).expect("a body");
    let offset = RelaxSettings::default().offset * surface.scale();
    let marks = suggested(&skirt(0.22), &surface, offset);
    assert_eq!(marks.pairs().count(), 4, "each half of front and back");
    for pair in stretches(&marks, &surface, offset) {
        assert!(pair.stretch().abs() < 0.08, "mark {}: {:+.3}", pair.number, pair.stretch());
    }
}
