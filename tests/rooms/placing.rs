//! Placements of files brought to another body.

use std::sync::Arc;

use glam::{DQuat, DVec3};
use toile::body::pose::rig;
use toile::body::{Measurements, NamedPose, Surface, Trunk, mannequin};
use toile::contact::Bone;
use toile::draft::{Design, Form, Kind, SIZES};
use toile::pattern::{CutPattern, EdgeRef, Pattern, Piece, Seam};
use toile::place::{Moved, Part, limbs, onto};
use toile::session::samples::Sample;
use toile::wrap::stand;

const OFFSET: f64 = 0.005;

/// The T-shirt with its body. Its sleeves are drawn for arms held level: they are brought to those of the mannequin.
fn tshirt() -> (Pattern, Surface, Vec<Bone>) {
    let figure = mannequin::default();
    let pattern = Arc::unwrap_or_clone(Sample::Tshirt.project(&figure).document.pattern);
    let surface = Surface::new(figure.mesh.clone()).expect("a body");
    let bones = figure.skeleton.six_segments();
    let change = onto(&pattern, &surface, &bones, OFFSET);
    (placed(&pattern, &change), surface, bones)
}

fn moved(pattern: &Pattern, turn: DQuat, by: DVec3) -> Pattern {
    let mut moved = pattern.clone();
    for piece in moved.pieces.values_mut() {
        let piece = Arc::make_mut(piece);
        piece.placement = piece.placement.map(|pose| pose.moved(turn, DVec3::ZERO, by));
    }
    moved
}

fn placed(pattern: &Pattern, change: &Moved) -> Pattern {
    let mut placed = pattern.clone();
    for (id, placement) in &change.placements {
        Arc::make_mut(placed.pieces.get_mut(id).expect("a piece")).placement = *placement;
    }
    placed
}

fn farthest(one: &Pattern, other: &Pattern) -> f64 {
    let apart = |(id, piece): (_, &Arc<Piece>)| {
        let [a, b] = [piece.placement.expect("a"), other.pieces[id].placement.expect("b")];
        piece.outline.iter().map(|e| a.at(e.start).distance(b.at(e.start))).fold(0.0, f64::max)
    };
    one.pieces.iter().map(apart).fold(0.0, f64::max)
}

#[test]
fn what_stands_where_it_belongs_stays_to_the_last_bit() {
    let (pattern, surface, bones) = tshirt();
    let change = onto(&pattern, &surface, &bones, OFFSET);
    assert_eq!((change.placements.len(), change.words.len()), (0, 0), "{:?}", change.words);
}

#[test]
fn a_file_with_another_origin_is_brought_to_the_body_and_stays_there() {
    let (pattern, surface, bones) = tshirt();
    for by in [DVec3::new(0.0, -1.1, 0.0), DVec3::new(0.0, 0.3, -0.6)] {
        let elsewhere = moved(&pattern, DQuat::IDENTITY, by);
        let change = onto(&elsewhere, &surface, &bones, OFFSET);
        let back = placed(&elsewhere, &change);
        assert!(farthest(&back, &pattern) < 0.08, "{:?}: {}", change.words, farthest(&back, &pattern));
        assert_eq!(onto(&back, &surface, &bones, OFFSET).placements, []);
    }
}

#[test]
fn pieces_go_to_a_body_that_stands_elsewhere() {
    let (pattern, surface, bones) = tshirt();
    let by = DVec3::new(0.4, 0.2, 1.0);
    let mut mesh = surface.mesh.clone();
    mesh.positions.iter_mut().for_each(|p| *p += by);
    let bones: Vec<Bone> = bones.iter().map(|bone| bone.map(|end| end + by)).collect();
    let change = onto(&pattern, &Surface::new(mesh).expect("a body"), &bones, OFFSET);
    let there = placed(&pattern, &change);
    let apart = farthest(&there, &moved(&pattern, DQuat::IDENTITY, by));
    assert!(apart < 0.08, "{:?}: {apart}", change.words);
}

#[test]
fn sleeves_turn_to_the_arms_of_another_pose() {
    let (pattern, _, _) = tshirt();
    let rig = rig(&Measurements::default()).expect("a rig");
    let pose = NamedPose::T.pose(&mannequin::default().skeleton);
    let posed = rig.posed(&pose).expect("a pose");
    let bones = posed.skeleton.six_segments();
    let change = onto(&pattern, &posed.surface, &bones, OFFSET);
    assert_eq!(change.words.len(), 2, "{:?}", change.words);
    let after = placed(&pattern, &change);
    for limb in limbs(&bones, 1.7) {
        let Part::Arm { left } = limb.part else { continue };
        let sleeve = after.pieces.values().find(|piece| {
            let at = piece.placement.expect("placed").translation.x;
            piece.name.contains("sleeve") && (at > 0.0) == left
        });
        let sleeve = sleeve.expect("a sleeve");
        let corners = sleeve.outline.iter().map(|e| sleeve.placement.expect("placed").at(e.start));
        let middle = corners.sum::<DVec3>() / sleeve.outline.len() as f64;
        let along = (middle - limb.bone[0]).dot(limb.along());
        let off = (middle - limb.bone[0] - limb.along() * along) * DVec3::new(1.0, 1.0, 0.0);
        assert!(off.length() < 0.08, "{} is {off} beside the arm", sleeve.name);
    }
}

#[test]
fn what_is_sewn_to_a_sleeve_alone_turns_with_it() {
    let (mut pattern, _, _) = tshirt();
    let at = |piece: &Piece| piece.placement.expect("placed").translation.x;
    let sleeve = pattern.pieces.iter().find(|(_, piece)| piece.name.contains("sleeve") && at(piece) > 0.0);
    let (sleeve, cloth) = sleeve.map(|(id, piece)| (*id, Arc::clone(piece))).expect("a left sleeve");
    let is_sewn = |edge: usize| {
        let sides = pattern.seams.values().flat_map(|seam| seam.sides);
        sides.into_iter().any(|side| side.piece == sleeve && side.edge == edge)
    };
    let hem = (0..cloth.edge_count()).find(|edge| !is_sewn(*edge)).expect("a hem");
    let (a, b) = cloth.edge_ends(hem);
    let out = (b - a).perp() * -0.3;
    let band = Piece { placement: cloth.placement, ..Piece::polygon("band", &[b, a, a + out, b + out]) };
    let band = pattern.add_piece(band);
    pattern.add_seam(Seam::of_edges(
        [(sleeve, hem), (band, 0)].map(|(piece, edge)| EdgeRef { piece, edge }),
        false,
    ));
    let posed = rig(&Measurements::default()).expect("a rig");
    let posed = posed.posed(&NamedPose::T.pose(&mannequin::default().skeleton)).expect("a pose");
    let change = onto(&pattern, &posed.surface, &posed.skeleton.six_segments(), OFFSET);
    let after = placed(&pattern, &change);
    let place = |id| after.pieces[&id].placement.expect("placed");
    assert_ne!(place(sleeve), cloth.placement.expect("placed"));
    assert_eq!(place(band), place(sleeve), "{:?}", change.words);
}

#[test]
fn what_is_cut_in_one_with_its_sleeves_is_raised_over_the_arms() {
    let measurements = SIZES[3].measurements();
    let figure = mannequin::mannequin(&measurements).expect("a body");
    let posed = rig(&measurements).expect("a rig").posed(&NamedPose::T.pose(&figure.skeleton));
    let posed = posed.expect("a pose");
    let (surface, trunk) = (&posed.surface, Trunk::new(&posed.surface.mesh).expect("a trunk"));
    let form = Form::new(&measurements, NamedPose::T).expect("a form");
    let pattern = Design::drawn(1, 3, &[Kind::Dolman]).drafted(&form);
    let short = |pattern: &Pattern| {
        let stand = stand(&CutPattern::new(pattern).0, surface, &trunk, OFFSET).expect("a stand");
        stand.short_of_arms
    };
    let lower = moved(&pattern, DQuat::IDENTITY, DVec3::Y * -0.03);
    assert!(short(&lower) > 0.02, "{}", short(&lower));
    let change = onto(&lower, surface, &posed.skeleton.six_segments(), OFFSET);
    let after = placed(&lower, &change);
    assert!(short(&after).abs() < 1e-9, "{} {:?}", short(&after), change.words);
    assert_eq!(onto(&after, surface, &posed.skeleton.six_segments(), OFFSET).words, [""; 0]);
}

#[test]
fn a_skirt_without_sleeves_only_goes_up_and_down() {
    let figure = mannequin::default();
    let surface = Surface::new(figure.mesh.clone()).expect("a body");
    let bones = figure.skeleton.six_segments();
    let pattern = Arc::unwrap_or_clone(Sample::Skirt.project(&figure).document.pattern);
    assert_eq!(onto(&pattern, &surface, &bones, OFFSET).placements, []);
    let low = moved(&pattern, DQuat::IDENTITY, DVec3::Y * -0.9);
    let change = onto(&low, &surface, &bones, OFFSET);
    let up: Vec<f64> = change
        .placements
        .iter()
        .map(|(id, pose)| {
            let moved =
                pose.expect("a place").translation - low.pieces[id].placement.expect("one").translation;
            assert_eq!((moved.x, moved.z), (0.0, 0.0));
            moved.y
        })
        .collect();
    assert!(up.len() == low.pieces.len() && up.iter().all(|y| (0.75..1.05).contains(y)), "{up:?}");
}

#[test]
fn nothing_is_asked_of_a_body_that_is_no_human() {
    let (pattern, _, _) = tshirt();
    let mesh = toile::geometry::mesh::TriMesh {
        positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
        triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
    };
    let surface = Surface::new(mesh).expect("a body");
    assert_eq!(onto(&pattern, &surface, &[], OFFSET), Moved::default());
}
