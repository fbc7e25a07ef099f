use std::sync::Arc;

use glam::DVec3;

use super::*;
use crate::body::Skeleton;
use crate::body::mannequin::{self, Measurements};
use crate::body::measure::{Tape, girth};
use crate::geometry::mesh::TriMesh;

fn usual() -> Arc<Rig> {
    rig(&Measurements::default()).expect("the mannequin")
}

fn posed(pose: NamedPose) -> Posed {
    let rig = usual();
    rig.posed(&pose.pose(&rig.figure().skeleton)).expect("a pose")
}

#[test]
fn the_built_pose_is_the_built_body() {
    let rig = usual();
    let same = rig.posed(&Pose::default()).expect("a pose");
    let built = &rig.figure().mesh.positions;
    let floor = built.iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
    for (p, q) in built.iter().zip(&same.surface.mesh.positions) {
        assert!((*p - DVec3::Y * floor).distance(*q) < 1e-9, "{p} {q}");
    }
    assert_eq!(rig.figure().mesh, mannequin::default().mesh);
}

#[test]
fn every_pose_keeps_the_body_full_and_its_bones_long() {
    check_poses(&usual());
}

#[test]
fn poses_of_a_child_do_so_too() {
    let given = [("height", 1.10), ("bust", 0.58), ("waist", 0.55), ("hip", 0.61)];
    let child =
        Measurements::completed(|name| given.iter().find(|(known, _)| *known == name).map(|(_, x)| *x));
    check_poses(&rig(&child).expect("a child"));
}

fn check_poses(rig: &Rig) {
    let built = rig.figure();
    for pose in NamedPose::ALL {
        let posed = rig.posed(&pose.pose(&built.skeleton)).expect("a pose");
        let volume = posed.surface.mesh.volume() / built.mesh.volume();
        // Deep bends press the skin into itself at groin and knee.
        let bends = [NamedPose::Running, NamedPose::Sitting, NamedPose::KungFu].contains(&pose);
        let least = if bends { 0.90 } else { 0.97 };
        assert!((least..1.03).contains(&volume), "{pose:?}: {volume} of the volume");
        for side in ["left", "right"] {
            for (a, b) in [("shoulder", "elbow"), ("elbow", "wrist"), ("hip", "knee"), ("knee", "ankle")] {
                let length = |skeleton: &Skeleton| {
                    let at = |name: &str| skeleton.position(&format!("{name}_{side}")).expect("a joint");
                    at(a).distance(at(b))
                };
                let ratio = length(&posed.skeleton) / length(&built.skeleton);
                assert!((0.90..1.05).contains(&ratio), "{pose:?}: {a} to {b} {side} is {ratio} as long");
            }
        }
        let lowest = posed.surface.mesh.positions.iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
        assert!(lowest.abs() < 1e-9, "{pose:?} stands at {lowest}");
    }
}

#[test]
fn bent_elbows_and_knees_keep_their_girth() {
    let built = Arc::clone(usual().figure());
    for (pose, joint, before, beyond) in [
        (NamedPose::Running, "elbow_left", "shoulder_left", "wrist_left"),
        (NamedPose::Running, "knee_left", "hip_left", "ankle_left"),
        (NamedPose::Sitting, "knee_right", "hip_right", "ankle_right"),
    ] {
        let at = |skeleton: &Skeleton, name: &str| skeleton.position(name).expect("a joint");
        let round = |mesh: &TriMesh, skeleton: &Skeleton| {
            let [a, b, c] = [before, joint, beyond].map(|name| at(skeleton, name));
            let normal = ((b - a).normalize() + (c - b).normalize()).normalize();
            girth(mesh, &Tape { name: joint, origin: b, normal }).expect("a section")
        };
        let posed = posed(pose);
        let ratio = round(&posed.surface.mesh, &posed.skeleton) / round(&built.mesh, &built.skeleton);
        assert!((0.9..1.35).contains(&ratio), "{pose:?}: {joint} is {ratio} as far round");
    }
}

#[test]
fn both_sides_are_mirror_images_where_the_pose_is() {
    for pose in [NamedPose::T, NamedPose::Sitting, NamedPose::ArmsUp] {
        let skeleton = posed(pose).skeleton;
        for name in ["elbow", "wrist", "knee", "ankle"] {
            let at = |side: &str| skeleton.position(&format!("{name}_{side}")).expect("a joint");
            let [left, right] = [at("left"), at("right")];
            assert!((left - DVec3::new(-right.x, right.y, right.z)).length() < 2e-3, "{pose:?} {name}");
        }
    }
}

#[test]
fn joints_are_where_the_pose_says() {
    let at = |pose, name: &str| posed(pose).skeleton.position(name).expect("a joint");
    let arm = |pose| (at(pose, "elbow_left") - at(pose, "shoulder_left")).normalize();
    assert!(arm(NamedPose::T).x > 0.99, "{}", arm(NamedPose::T));
    assert!(arm(NamedPose::Standing).y < -0.96, "{}", arm(NamedPose::Standing));
    assert!(arm(NamedPose::ArmsUp).y > 0.90, "{}", arm(NamedPose::ArmsUp));
    let thigh = (at(NamedPose::Sitting, "knee_left") - at(NamedPose::Sitting, "hip_left")).normalize();
    assert!(thigh.z > 0.94, "{thigh}");
}

#[test]
fn half_way_is_half_the_turn_and_nonsense_is_named() {
    let skeleton = &usual().figure().skeleton.clone();
    let [a, t] = [NamedPose::A, NamedPose::T].map(|pose| pose.pose(skeleton));
    let half = a.towards(&t, 0.5);
    assert!((half.turns["shoulder_left"] * 2.0).distance(t.turns["shoulder_left"]) < 1e-12);
    assert_eq!(t.towards(&a, 1.0), a);
    assert_eq!(half.problem(), None);
    let mut odd = Pose::default();
    odd.turns.insert("tail".to_owned(), DVec3::X);
    assert!(odd.problem().expect("no such joint").contains("tail"));
    let mut far = Pose::default();
    far.turns.insert("neck".to_owned(), DVec3::X * 4.0);
    assert!(far.problem().expect("too far").contains("neck"));
}

#[test]
fn an_elbow_bent_by_a_right_angle_keeps_forearm_and_volume() {
    let rig = usual();
    let built = rig.figure();
    let anatomy = anatomy::Anatomy::new(&built.skeleton);
    let at = |skeleton: &Skeleton, name: &str| skeleton.position(name).expect("a joint");
    let forearm = |skeleton: &Skeleton| at(skeleton, "wrist_left") - at(skeleton, "elbow_left");
    // From ring to ring of its skin, where the bend does not reach.
    let along = forearm(&built.skeleton).normalize();
    let ring = |mesh: &TriMesh, from: f64| {
        let places = built.mesh.positions.iter().zip(&mesh.positions).filter_map(|(p, q)| {
            let beside = *p - at(&built.skeleton, "elbow_left");
            let is_here =
                (from..from + 0.02).contains(&beside.dot(along)) && beside.reject_from(along).length() < 0.07;
            is_here.then_some(*q)
        });
        let places: Vec<DVec3> = places.collect();
        places.iter().sum::<DVec3>() / places.len() as f64
    };
    let length = |mesh: &TriMesh| ring(mesh, 0.08).distance(ring(mesh, 0.20));
    let hand = |skeleton: &Skeleton| (at(skeleton, "knuckles_left") - at(skeleton, "wrist_left")).normalize();
    let bent = |degrees: f64| {
        let angle = format!("left_elbow={degrees}").parse().expect("an angle");
        let pose = anatomy.with(&Pose::default(), &[angle]).expect("a pose");
        rig.posed(&pose).expect("the mannequin bent")
    };
    for degrees in [45.0, 90.0] {
        let bent = bent(degrees);
        let volume = bent.surface.mesh.volume() / built.mesh.volume();
        assert!((volume - 1.0).abs() < 5e-3, "{degrees}: {volume} of the volume");
        let skin = length(&bent.surface.mesh) / length(&built.mesh);
        assert!((skin - 1.0).abs() < 0.005, "{degrees}: the forearm is {skin} as long");
        let bone = forearm(&bent.skeleton).length() / forearm(&built.skeleton).length();
        assert!((bone - 1.0).abs() < 0.05, "{degrees}: its bone is {bone} as long");
        let turn = anatomy.turn(anatomy::Limb::named("left_elbow").expect("it"), [degrees, 0.0, 0.0]);
        let turned = DQuat::from_scaled_axis(turn) * hand(&built.skeleton);
        assert!(turned.angle_between(hand(&bent.skeleton)).to_degrees() < 2.0, "{degrees}: the hand");
        let arm = arm_volume(&bent.surface.mesh, &built.mesh) / arm_volume(&built.mesh, &built.mesh);
        // The crook is pressed in.
        assert!((0.95..1.01).contains(&arm), "{degrees}: {arm} of the arm's volume");
    }
}

/// Of the left arm from the middle of the upper arm on, where `built` has it, closed there by a cone.
fn arm_volume(mesh: &TriMesh, built: &TriMesh) -> f64 {
    let from = |least: f64| move |t: &&[u32; 3]| t.iter().all(|&v| built.positions[v as usize].x > least);
    let [cut, beyond] = [0.30, 0.32];
    let ring: Vec<DVec3> = built
        .triangles
        .iter()
        .filter(|t| from(cut)(t) && !from(beyond)(t))
        .flat_map(|t| t.map(|v| mesh.positions[v as usize]))
        .collect();
    let middle = ring.iter().sum::<DVec3>() / ring.len() as f64;
    let cone = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| mesh.positions[v as usize] - middle);
        a.cross(b).dot(c) / 6.0
    };
    built.triangles.iter().filter(from(cut)).map(cone).sum()
}
