use super::*;
use crate::body::mannequin;
use crate::body::pose::NamedPose;

fn skeleton() -> Skeleton {
    mannequin::default().skeleton.clone()
}

fn limb(name: &str) -> Limb {
    Limb::named(name).expect("a joint")
}

#[test]
fn angles_come_back_at_every_joint_within_its_range() {
    let anatomy = Anatomy::new(&skeleton());
    for limb in Limb::all() {
        let ends = Axis::ALL.map(|axis| limb.movement(axis).map_or([0.0; 2], |m| m.range));
        for shares in [[0.1, 0.2, 0.3], [0.9, 0.6, 0.8], [0.5, 0.5, 0.5], [0.2, 0.9, 0.6], [1.0, 0.3, 0.0]] {
            let given = [0, 1, 2].map(|k| ends[k][0] + (ends[k][1] - ends[k][0]) * shares[k]);
            let mut pose = Pose::default();
            anatomy.set(&mut pose, limb, given);
            let found = anatomy.angles(&pose, limb);
            let worst = (0..3).map(|k| (found[k] - given[k]).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-6, "{}: {given:?} came back as {found:?}", limb.name());
        }
    }
}

#[test]
fn arms_level_are_abducted_by_a_right_angle_and_nothing_more_is_flexion() {
    let anatomy = Anatomy::new(&skeleton());
    let mut pose = Pose::default();
    anatomy.set(&mut pose, limb("left_shoulder"), [0.0, 90.0, 0.0]);
    let [flexion, abduction, twist] = anatomy.angles(&pose, limb("left_shoulder"));
    assert!((abduction - 90.0).abs() < 1e-6 && flexion.abs() < 1e-6 && twist == 0.0);
    let arm = skeleton();
    let along = arm.position("elbow_left").expect("it") - arm.position("shoulder_left").expect("it");
    let level = pose.turn("shoulder_left") * DVec3::new(along.x, along.y, 0.0).normalize();
    assert!(level.distance(DVec3::X) < 1e-9, "{level}");
}

#[test]
fn every_joint_turns_the_way_its_movements_are_called() {
    let anatomy = Anatomy::new(&skeleton());
    let down = DVec3::NEG_Y;
    let moved = |name: &str, degrees: [f64; 3], from: DVec3| {
        DQuat::from_scaled_axis(anatomy.turn(limb(name), degrees)) * from
    };
    assert!(moved("left_hip", [30.0, 0.0, 0.0], down).z > 0.4, "the leg goes forth");
    assert!(moved("left_hip", [0.0, 30.0, 0.0], down).x > 0.4, "the left leg goes to the left");
    assert!(moved("right_hip", [0.0, 30.0, 0.0], down).x < -0.4, "the right one to the right");
    assert!(moved("left_hip", [0.0, 0.0, 30.0], DVec3::Z).x < -0.4, "the left toes go inward");
    assert!(moved("right_hip", [0.0, 0.0, 30.0], DVec3::Z).x > 0.4, "and the right ones");
    assert!(moved("left_knee", [30.0, 0.0, 0.0], down).z < -0.4, "the shin goes back");
    assert!(moved("left_ankle", [20.0, 0.0, 0.0], DVec3::Z).y > 0.3, "the toes go up");
    assert!(moved("left_ankle", [0.0, 15.0, 0.0], DVec3::X).y > 0.2, "the outer edge goes up");
    assert!(moved("spine", [30.0, 0.0, 0.0], DVec3::Y).z > 0.4, "forward");
    assert!(moved("spine", [0.0, 17.0, 0.0], DVec3::Y).x > 0.2, "to the left");
    assert!(moved("head", [0.0, 0.0, 30.0], DVec3::Z).x > 0.4, "the face to the left");
    assert!(moved("left_collar", [15.0, 0.0, 0.0], DVec3::X).z > 0.2, "forward");
    assert!(moved("left_collar", [0.0, 30.0, 0.0], DVec3::X).y > 0.4, "up");
    let arm = skeleton();
    let at = |name: &str| arm.position(name).expect("a joint");
    let along = (at("elbow_left") - at("shoulder_left")).normalize();
    assert!(moved("left_elbow", [90.0, 0.0, 0.0], along).z > 0.99, "the forearm goes forth");
    assert!(moved("left_elbow", [0.0, 0.0, 60.0], DVec3::Z).x < -0.4, "the thumb goes inward");
    assert!(moved("left_wrist", [60.0, 0.0, 0.0], along).x < along.x, "the palm goes to the body");
    assert!(moved("left_wrist", [0.0, 20.0, 0.0], along).z > 0.3, "towards the thumb");
}

#[test]
fn named_poses_are_within_the_ranges() {
    let skeleton = skeleton();
    let anatomy = Anatomy::new(&skeleton);
    for named in NamedPose::ALL {
        let pose = named.pose(&skeleton);
        for limb in Limb::all() {
            let angles = anatomy.angles(&pose, limb);
            for axis in Axis::ALL {
                let degrees = angles[axis as usize];
                let problem = limb.problem(axis, degrees).filter(|_| degrees.abs() > READ_ERROR);
                assert_eq!(problem, None, "{named:?}");
            }
        }
    }
}

#[test]
fn what_is_typed_is_read_or_refused_in_words() {
    let read = |text: &str| text.parse::<JointAngle>();
    let elbow = read("left_elbow=60").expect("an angle");
    assert_eq!((elbow.limb.joint, elbow.axis, elbow.degrees), ("elbow_left", Axis::Flexion, 60.0));
    let hip = read("hip-right.abduction = 20°").expect("an angle");
    assert_eq!((hip.limb.joint, hip.axis, hip.degrees), ("hip_right", Axis::Abduction, 20.0));
    for (text, words) in [
        ("left_elbow", "JOINT=DEGREES"),
        ("left_elbow=far", "\"far\""),
        ("left_elbow=NaN", "out of its range"),
        ("left_elbow=160", "0° to 150°"),
        ("tail=10", "left_elbow"),
        ("left_elbow.abduction=5", "has no abduction; it has flexion, twist"),
        ("left_elbow.sideways=5", "sideways"),
    ] {
        let why = read(text).expect_err(text);
        assert!(why.contains(words), "{text}: {why}");
    }
}

#[test]
fn a_set_joint_leaves_the_others_and_the_right_side_mirrors_the_left() {
    let skeleton = skeleton();
    let anatomy = Anatomy::new(&skeleton);
    let running = NamedPose::Running.pose(&skeleton);
    let angle = |text: &str| text.parse::<JointAngle>().expect("an angle");
    let both = [angle("left_knee=100"), angle("left_hip.twist=20")];
    let pose = anatomy.with(&running, &both).expect("a pose");
    assert_eq!(pose.turns["hip_right"], running.turns["hip_right"]);
    assert!((anatomy.angles(&pose, limb("left_knee"))[0] - 100.0).abs() < 1e-6);
    let [before, after] = [&running, &pose].map(|pose| anatomy.angles(pose, limb("left_hip")));
    assert!((before[0] - after[0]).abs() < 1e-6 && (after[2] - 20.0).abs() < 1e-6);
    let mirrored = mirrored_to_the_right(&pose);
    for of_left in Limb::all().filter(|limb| limb.joint.ends_with("_left")) {
        let other = of_left.other_side().expect("two sides");
        let [left, right] = [of_left, other].map(|limb| anatomy.angles(&mirrored, limb));
        assert!((0..3).all(|k| (left[k] - right[k]).abs() < 1e-6), "{}", of_left.name());
    }
    assert_eq!(mirrored.turns["chest"], pose.turns["chest"]);
}
