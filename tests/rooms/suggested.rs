//! Marks suggested from where pieces are placed.

use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};
use toile::body::pose::rig;
use toile::body::{NamedPose, Surface, Trunk, mannequin};
use toile::draft::{Design, Form, Kind, SIZES};
use toile::pattern::{CutPattern, EdgeRef, Pattern, Piece, Seam, SpacePose};
use toile::relax::RelaxSettings;
use toile::wrap::{BodyMark, ClothMark, are_suggested, stand, stretches, suggested};

/// Of the cloth above the skin, metres.
const OFFSET: f64 = 0.005;

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
    assert!(are_suggested(&marks, &skirt(0.22)));
    assert!(!are_suggested(&marks.only(&[2]), &skirt(0.22)), "others have other numbers");
    assert!(!are_suggested(&toile::wrap::Marks::default(), &skirt(0.22)));
    for pair in stretches(&marks, &surface, offset) {
        assert!(pair.stretch().abs() < 0.08, "mark {}: {:+.3}", pair.number, pair.stretch());
    }
}

/// A design of the corpus for the middle size in `pose`, and that body.
fn drafted(kind: Kind, number: u32, pose: NamedPose) -> (Pattern, Arc<Surface>) {
    let measurements = SIZES[2].measurements();
    let form = Form::new(&measurements, pose).expect("a form");
    let figure = mannequin::mannequin(&measurements).expect("a body");
    let posed = rig(&measurements).expect("a rig").posed(&pose.pose(&figure.skeleton)).expect("a pose");
    (Design::drawn(1, number, &[kind]).drafted(&form), posed.surface)
}

#[test]
fn what_has_raglan_sleeves_hangs_from_the_shoulders() {
    for pose in [NamedPose::A, NamedPose::T] {
        let (pattern, surface) = drafted(Kind::Raglan, 3, pose);
        let trunk = Trunk::new(&surface.mesh).expect("a trunk");
        let stand = stand(&CutPattern::new(&pattern).0, &surface, &trunk, OFFSET).expect("a stand");
        assert!(stand.hangs && (stand.body - stand.placed).abs() < 0.05, "{stand:?}");
        let marks = suggested(&pattern, &surface, OFFSET);
        let armpit = trunk.armpit.expect("arms");
        let highest = marks.body.iter().flat_map(|mark| &mark.points).map(|p| p.y).fold(0.0, f64::max);
        assert!(highest > armpit, "strokes reach {highest} m, the armpit is at {armpit}");
        let lowest = |mark: &BodyMark| mark.points.iter().map(|p| p.y).fold(f64::MAX, f64::min);
        let rings = marks.body.iter().filter(|mark| (lowest(mark) - armpit).abs() < 0.1).count();
        assert!(rings >= 4, "{rings} strokes of a ring under the arms");
    }
}

#[test]
fn sleeves_cut_in_one_with_the_rest_get_strokes_along_the_arms() {
    for pose in [NamedPose::A, NamedPose::T] {
        let (pattern, surface) = drafted(Kind::Dolman, 3, pose);
        let marks = suggested(&pattern, &surface, OFFSET);
        let reach = |mark: &BodyMark| mark.points.iter().map(|p| p.x.abs()).fold(0.0, f64::max);
        let along: Vec<_> = marks.pairs().filter(|(_, body)| reach(body) > 0.25).collect();
        assert_eq!(along.len(), 4, "front and back, left and right");
        for pair in stretches(&marks, &surface, OFFSET).iter().rev().take(4) {
            assert!(pair.stretch().abs() < 0.03, "mark {}: {:+.3}", pair.number, pair.stretch());
        }
        // The ring ends at the sides: what hangs lower of the sleeves is no part of it.
        let widest = |mark: &ClothMark| mark.points.iter().map(|p| p.x.abs()).fold(0.0, f64::max);
        let within = marks.cloth.iter().filter(|mark| widest(mark) < 0.32).count();
        assert_eq!(within, marks.cloth.len() - 4);
    }
}
