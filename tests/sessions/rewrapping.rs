//! Wrapping dressed cloth again by new marks, as far as pins let it.

use glam::{DVec2, DVec3};
use toile::geometry::ids::PieceId;
use toile::session::replay::Replay;
use toile::session::{Command, Session};
use toile::wrap::{ClothSide, Phase};

use crate::common::{cloth_hash, line_on_ball, run, session};

const LEFT: PieceId = PieceId(1);
const RIGHT: PieceId = PieceId(2);

/// Dressed, with a second pair of marks that brings the free side of the right patch higher up.
fn marked_again() -> Session {
    let mut s = session();
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(&mut s, 2000);
    let points = vec![DVec2::new(0.10, 0.15), DVec2::new(0.22, 0.15)];
    s.apply_alone(Command::AddClothMark { piece: RIGHT, side: ClothSide::Front, points }).expect("painted");
    let points = line_on_ball(0.75, 0.35, 0.06).into_iter().map(|p| p + DVec3::X * 0.25);
    let on_ball = points.map(|p| p.normalize() * 0.75).collect();
    s.apply_alone(Command::AddBodyMark { points: on_ball }).expect("painted");
    s
}

fn place(s: &Session, piece: PieceId, at: DVec2) -> DVec3 {
    let snapshot = s.snapshot();
    let garment = snapshot.garment.as_ref().expect("a garment");
    let near = garment.corners.iter().filter(|c| c.piece == piece);
    let corner = near.min_by(|a, b| a.uv.distance(at).total_cmp(&b.uv.distance(at))).expect("a corner");
    snapshot.cloth.positions[corner.vertex as usize]
}

const MARKED: DVec2 = DVec2::new(0.16, 0.15);
const FAR: DVec2 = DVec2::new(0.02, 0.02);

#[test]
fn without_pins_all_cloth_follows_the_new_marks() {
    let mut s = marked_again();
    let before = place(&s, RIGHT, MARKED);
    s.apply_alone(Command::Rewrap { pairs: vec![2] }).expect("rewrapped");
    run(&mut s, 3000);
    assert_eq!(s.snapshot().phase, Some(Phase::AtRest));
    assert!(s.snapshot().cloth.mapped.iter().all(|&m| m));
    assert!(place(&s, RIGHT, MARKED).y > before.y + 0.05, "{} to {}", before, place(&s, RIGHT, MARKED));
}

#[test]
fn beyond_a_pin_cloth_stays() {
    let mut s = marked_again();
    let (marked, far) = (place(&s, RIGHT, MARKED), place(&s, LEFT, FAR));
    s.apply_alone(Command::AddPin { piece: LEFT, at: DVec2::new(0.2, 0.15) }).expect("pinned");
    s.update();
    let pin = s.snapshot().pinned[0].expect("on the cloth") as usize;
    let pinned = s.snapshot().cloth.positions[pin];
    s.apply_alone(Command::Rewrap { pairs: vec![2] }).expect("rewrapped");
    while s.snapshot().phase == Some(Phase::Growing) {
        assert_eq!(place(&s, LEFT, FAR), far, "cloth beyond the pin moved while the rest grew");
        run(&mut s, 1);
    }
    run(&mut s, 3000);
    assert_eq!(s.snapshot().cloth.positions[pin], pinned);
    assert!(place(&s, RIGHT, MARKED).distance(marked) > 0.03);
    assert!(s.snapshot().cloth.mapped.iter().all(|&m| m));
}

#[test]
fn after_a_change_of_the_pattern_pins_still_hold_a_rewrap() {
    let mut s = marked_again();
    s.apply_alone(Command::AddPin { piece: LEFT, at: DVec2::new(0.2, 0.15) }).expect("pinned");
    s.update();
    let far = place(&s, LEFT, DVec2::ZERO);
    let mut outline = s.document().pattern.pieces[&RIGHT].outline.clone();
    outline[1].start.x += 0.03;
    outline[2].start.x += 0.03;
    s.apply_alone(Command::SetOutline { piece: RIGHT, outline }).expect("redrawn");
    s.apply_alone(Command::Rewrap { pairs: vec![2] }).expect("rewrapped");
    let pin = s.snapshot().pinned[0].expect("still on the cloth") as usize;
    let pinned = s.snapshot().cloth.positions[pin];
    while s.snapshot().phase == Some(Phase::Growing) {
        assert_eq!(place(&s, LEFT, DVec2::ZERO), far, "cloth beyond the pin moved while the rest grew");
        run(&mut s, 1);
    }
    run(&mut s, 3000);
    assert_eq!(s.snapshot().phase, Some(Phase::AtRest));
    assert_eq!(s.snapshot().cloth.positions[pin], pinned);
    assert!(s.snapshot().cloth.mapped.iter().all(|&m| m), "the new cloth lies, too");
    let recording = toile::session::recording::Recording::parse(&s.recording()).expect("a recording");
    Replay::new(recording).run().expect("the same hashes");
}

#[test]
fn a_rewrap_is_cancelled_undone_and_replayed() {
    let mut s = marked_again();
    let before = cloth_hash(&mut s);
    s.apply_alone(Command::Rewrap { pairs: Vec::new() }).expect("rewrapped");
    run(&mut s, 3);
    assert_ne!(cloth_hash(&mut s), before);
    s.apply_alone(Command::CancelWrap).expect("cancelled");
    assert_eq!(cloth_hash(&mut s), before);
    s.apply_alone(Command::Rewrap { pairs: vec![2] }).expect("rewrapped");
    run(&mut s, 50);
    let after = cloth_hash(&mut s);
    s.apply_alone(Command::Undo).expect("undone");
    assert_eq!(cloth_hash(&mut s), before);
    s.apply_alone(Command::Redo).expect("redone");
    assert_eq!(cloth_hash(&mut s), after);
    let recording = toile::session::recording::Recording::parse(&s.recording()).expect("a recording");
    Replay::new(recording).run().expect("the same hashes");
}

#[test]
fn a_rewrap_needs_pairs_that_are_there() {
    let mut s = marked_again();
    for pairs in [vec![0], vec![3]] {
        s.apply_alone(Command::Rewrap { pairs }).expect_err("no such pair");
    }
    s.apply_alone(Command::ClearMarks).expect("cleared");
    s.apply_alone(Command::Rewrap { pairs: Vec::new() }).expect_err("no pair");
}
