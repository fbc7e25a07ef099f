use std::f64::consts::FRAC_PI_2;

use super::*;
use crate::body::mannequin::{self, Measurements};
use crate::body::pose::rig;

fn skeleton() -> Skeleton {
    mannequin::default().skeleton.clone()
}

/// The mannequin's own skeleton as a clip, its joints called by `name`, at rest in one frame.
fn clip_of(skeleton: &Skeleton, name: impl Fn(&str) -> String) -> Clip {
    let rotations = [Channel::Rotation(2), Channel::Rotation(0), Channel::Rotation(1)];
    let joints = skeleton.joints.iter().map(|joint| {
        let from = joint.parent.map_or(DVec3::ZERO, |p| skeleton.joints[p].position);
        let moves = [0, 1, 2].map(Channel::Position);
        let channels = match joint.parent {
            None => moves.into_iter().chain(rotations).collect(),
            Some(_) => rotations.to_vec(),
        };
        let offset = joint.position - from;
        ClipJoint { name: name(&joint.name), parent: joint.parent, offset, channels, ends: Vec::new() }
    });
    let joints: Vec<ClipJoint> = joints.collect();
    let mut clip = Clip { joints, seconds_per_frame: 1.0 / 30.0, values: Vec::new() };
    clip.values = vec![0.0; clip.channels()];
    clip.values[..3].copy_from_slice(&clip.joints[0].offset.to_array());
    clip
}

/// The place in a frame of the three rotations of a joint (z, x, y).
fn rotations_of(clip: &Clip, name: &str) -> usize {
    let i = clip.joints.iter().position(|joint| joint.name == name).expect("a joint");
    let before: usize = clip.joints[..i].iter().map(|joint| joint.channels.len()).sum();
    before + clip.joints[i].channels.len() - 3
}

#[test]
fn a_joint_that_turns_by_a_right_angle_turns_that_joint_by_it() {
    let skeleton = skeleton();
    for (joint, axis, at) in [("elbow_left", DVec3::Z, 0), ("knee_right", DVec3::X, 1), ("neck", DVec3::Y, 2)]
    {
        let mut clip = clip_of(&skeleton, str::to_owned);
        let place = rotations_of(&clip, joint) + at;
        clip.values[place] = 90.0;
        let retarget = Retarget::new(&clip, &skeleton).expect("a mannequin");
        let (pose, placement) = retarget.frame(&clip, 0, 0);
        assert_eq!(retarget.unmoved, [""; 0]);
        for (name, turn) in &pose.turns {
            let expected = if name == joint { axis * FRAC_PI_2 } else { DVec3::ZERO };
            assert!(turn.distance(expected) < 1e-7, "{joint}: {name} turns by {turn}");
        }
        assert!(placement.turn.to_scaled_axis().length() < 1e-9);
    }
}

#[test]
fn arms_that_rest_level_are_laid_along_the_mannequins() {
    let skeleton = skeleton();
    let mut level = skeleton.clone();
    for side in ["left", "right"] {
        let at = |name: &str| level.index(&format!("{name}_{side}")).expect("a joint");
        let chain = ["shoulder", "elbow", "wrist", "knuckles"].map(at);
        let sign = if side == "left" { 1.0 } else { -1.0 };
        let mut lengths = [0.0; 4];
        for k in 1..4 {
            lengths[k] = level.joints[chain[k]].position.distance(level.joints[chain[k - 1]].position);
        }
        for k in 1..4 {
            level.joints[chain[k]].position =
                level.joints[chain[k - 1]].position + DVec3::X * sign * lengths[k];
        }
    }
    let clip = clip_of(&level, str::to_owned);
    let (pose, _) = Retarget::new(&clip, &skeleton).expect("a mannequin").frame(&clip, 0, 0);
    let rig = rig(&Measurements::default()).expect("the mannequin");
    let posed = rig.posed(&pose).expect("a pose");
    let at = |name: &str| posed.skeleton.position(name).expect("a joint");
    for (side, way) in [("left", DVec3::X), ("right", DVec3::NEG_X)] {
        for (from, to) in [("shoulder", "elbow"), ("elbow", "wrist")] {
            let along = at(&format!("{to}_{side}")) - at(&format!("{from}_{side}"));
            assert!(along.normalize().dot(way) > 0.995, "{from} {side} lies along {}", along.normalize());
        }
    }
}

#[test]
fn the_pelvis_keeps_its_path_by_the_length_of_the_legs() {
    let skeleton = skeleton();
    // In centimetres, twice as large as the mannequin.
    let mut large = skeleton.clone();
    large.joints.iter_mut().for_each(|joint| joint.position *= 200.0);
    let mut clip = clip_of(&large, str::to_owned);
    let rest = clip.values.clone();
    clip.values.extend(&rest);
    let second = rest.len();
    clip.values[second] += 100.0;
    clip.values[second + 1] -= 20.0;
    clip.values[second + 5] = 90.0;
    let retarget = Retarget::new(&clip, &skeleton).expect("a mannequin");
    let (_, begin) = retarget.frame(&clip, 0, 0);
    let (pose, end) = retarget.frame(&clip, 0, 1);
    assert!(end.shift.distance(begin.shift + DVec3::new(0.5, -0.1, 0.0)) < 1e-9, "{end:?}");
    assert!(end.turn.angle_between(DQuat::from_rotation_y(FRAC_PI_2)) < 1e-9);
    assert!(pose.turns.values().all(|turn| turn.length() < 1e-7), "the whole turns, no joint");
    let rig = rig(&Measurements::default()).expect("the mannequin");
    let [one, other] = [begin, end].map(|place| rig.placed(&pose, &place).expect("a body"));
    let pelvis = skeleton.position("pelvis").expect("it") + begin.shift;
    for (p, q) in one.mesh.positions.iter().zip(&other.mesh.positions) {
        let turned = DQuat::from_rotation_y(FRAC_PI_2) * (*p - pelvis) + pelvis + DVec3::new(0.5, -0.1, 0.0);
        assert!(turned.distance(*q) < 1e-6, "{turned} {q}");
    }
}

#[test]
fn a_spine_that_is_counted_down_is_the_right_way_up() {
    let skeleton = skeleton();
    let name = |name: &str| match name {
        "spine" => "spine03".to_owned(),
        "chest" => "spine01".to_owned(),
        other => other.to_owned(),
    };
    let mut clip = clip_of(&skeleton, name);
    let place = rotations_of(&clip, "spine01");
    clip.values[place] = 10.0;
    let (pose, _) = Retarget::new(&clip, &skeleton).expect("a mannequin").frame(&clip, 0, 0);
    assert!(pose.turns["chest"].distance(DVec3::Z * 10_f64.to_radians()) < 1e-7, "{pose:?}");
}

#[test]
fn what_means_nothing_is_listed() {
    let skeleton = skeleton();
    let clip = clip_of(&skeleton, |name| if name == "head" { "antenna".to_owned() } else { name.to_owned() });
    let retarget = Retarget::new(&clip, &skeleton).expect("a mannequin");
    assert_eq!(retarget.unmoved, ["head"]);
    assert!(retarget.unused.contains(&"antenna".to_owned()) && !retarget.unused.contains(&"neck".to_owned()));
    let clip = clip_of(&skeleton, |name| format!("bone {}", name.len()));
    assert!(Retarget::new(&clip, &skeleton).expect_err("nothing known").contains("bone"));
}

#[test]
fn a_motion_with_z_up_is_the_same_motion() {
    let skeleton = skeleton();
    let mut clip = clip_of(&skeleton, str::to_owned);
    // Any angles and places, no two alike.
    let values = (0..2 * clip.channels()).map(|i| (i * 37 % 101) as f64 - 50.0);
    clip.values = values.collect();
    clip.joints[3].ends.push(DVec3::new(0.1, -0.2, 0.3));
    assert_eq!(clip.likely_up(), UpAxis::Y);
    let mut same = clip.clone();
    same.set_upright(UpAxis::Y);
    assert_eq!(same, clip);
    // Three quarters of a turn back: y becomes z, and z becomes -y.
    let mut lying = clip.clone();
    (0..3).for_each(|_| lying.set_upright(UpAxis::Z));
    assert_eq!(lying.joints[0].offset.z, clip.joints[0].offset.y);
    assert_eq!(
        lying.joints[0].channels[1..4],
        [Channel::Position(2), Channel::Position(1), Channel::Rotation(1)]
    );
    assert_eq!((lying.values[1], lying.values[2]), (clip.values[1], -clip.values[2]));
    assert_eq!(lying.likely_up(), UpAxis::Z);
    let turn = DQuat::from_rotation_x(FRAC_PI_2);
    for frame in 0..2 {
        for ((there, at), (lain, lain_at)) in clip.places(frame).into_iter().zip(lying.places(frame)) {
            assert!(
                lain_at.distance(turn * at) < 1e-9
                    && lain.angle_between(turn * there * turn.inverse()) < 1e-7
            );
        }
    }
    lying.set_upright(UpAxis::Z);
    assert_eq!(lying, clip);
}
