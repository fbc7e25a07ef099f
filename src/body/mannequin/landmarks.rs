//! Skeleton, landmarks and tapes of a figure.

use glam::DVec3;

use super::field::Field;
use super::figure::Figure;
use super::proportions::{self as nominal, level};
use crate::body::landmarks::Landmarks;
use crate::body::measure::Tape;
use crate::body::skeleton::Skeleton;

fn middle(marks: &mut Landmarks, name: &str, p: DVec3) {
    marks.add(name, DVec3::new(0.0, p.y, p.z));
}

fn pair(marks: &mut Landmarks, name: &str, p: DVec3) {
    marks.add(format!("{name}_left"), p);
    marks.add(format!("{name}_right"), DVec3::new(-p.x, p.y, p.z));
}

/// A point in the middle of the trunk at height `y` of the default figure.
fn trunk_middle(figure: &Figure, field: &Field, y: f64) -> DVec3 {
    let centre = field.leg_centre(figure.y(y));
    DVec3::new(0.0, centre.y, centre.z)
}

/// Tapes of all girths.
pub fn tapes(figure: &Figure, field: &Field) -> Vec<Tape> {
    let level_tape = |name, origin| Tape { name, origin, normal: DVec3::Y };
    let leg = |y: f64| field.leg_centre(figure.y(y));
    let arm = |name, s| Tape {
        name,
        origin: field.arm_centre(figure.along_arm(s)),
        normal: (field.arm_centre(figure.along_arm(s + 0.02)) - field.arm_centre(figure.along_arm(s - 0.02)))
            .normalize(),
    };
    vec![
        level_tape("ankle", leg(level::ANKLE)),
        level_tape("calf", leg(level::CALF)),
        level_tape("knee", leg(level::KNEE)),
        level_tape("mid-thigh", leg(level::MID_THIGH)),
        level_tape("upper thigh", leg(level::UPPER_THIGH)),
        level_tape("hip", trunk_middle(figure, field, level::HIP)),
        level_tape("abdomen", trunk_middle(figure, field, level::ABDOMEN)),
        level_tape("waist", trunk_middle(figure, field, level::WAIST)),
        level_tape("bust", trunk_middle(figure, field, level::BUST)),
        level_tape("neck", trunk_middle(figure, field, level::NECK)),
        arm("upper arm", nominal::UPPER_ARM_AT),
        arm("wrist", nominal::WRIST_AT),
    ]
}

/// The point where the ray from `origin` along `direction` (unit) leaves the skin.
fn skin(field: &Field, origin: DVec3, direction: DVec3) -> DVec3 {
    origin + direction * field.exit(origin, direction)
}

/// The left shoulder tip: the point of the skin outward of the joint, across the arm.
pub fn shoulder_tip(figure: &Figure, field: &Field) -> DVec3 {
    skin(field, figure.shoulder_joint(), figure.arm_outward())
}

/// The points of the arm length tape: shoulder tip, outside of the elbow, outside of the wrist.
pub fn arm_line(figure: &Figure, field: &Field) -> [DVec3; 3] {
    let outside = |s| skin(field, field.arm_centre(figure.along_arm(s)), figure.arm_outward());
    [shoulder_tip(figure, field), outside(nominal::ELBOW_AT), outside(nominal::WRIST_AT)]
}

/// Centre points of the left hip and leg from the waist down to the ankle bone; a tape down the side runs outside of them in x.
pub fn side_line(figure: &Figure, field: &Field) -> Vec<DVec3> {
    let (top, bottom) = (figure.y(level::WAIST), figure.y(level::ANKLE_BONE));
    (0..=100).map(|i| field.leg_centre(top + (bottom - top) * f64::from(i) / 100.0)).collect()
}

/// The landmarks of the figure.
pub fn landmarks(figure: &Figure, field: &Field) -> Landmarks {
    let mut marks = Landmarks::default();
    let levels = [
        ("neck", level::SHOULDER + 0.045),
        ("bust", level::BUST),
        ("underbust", level::BUST - 0.072),
        ("waist", level::WAIST),
        ("abdomen", level::ABDOMEN),
        ("hip", level::HIP),
    ];
    for (name, y) in levels {
        let centre = trunk_middle(figure, field, y);
        // The pit of the neck is lower than the nape.
        let drop = if name == "neck" { 0.022 * figure.small() } else { 0.0 };
        middle(&mut marks, &format!("{name}_front"), skin(field, centre - DVec3::Y * drop, DVec3::Z));
        middle(&mut marks, &format!("{name}_back"), skin(field, centre + DVec3::Y * drop, -DVec3::Z));
        pair(&mut marks, &format!("{name}_side"), skin(field, centre + DVec3::Y * drop * 0.7, DVec3::X));
    }
    let breast = figure.point(nominal::BREAST_CENTRE);
    let inside = DVec3::new(breast.x, figure.y(level::BUST), 0.0);
    pair(&mut marks, "bust_point", skin(field, inside, DVec3::Z));
    pair(&mut marks, "shoulder", shoulder_tip(figure, field));
    pair(&mut marks, "armpit", armpit(figure, field));
    let [_, elbow, wrist] = arm_line(figure, field);
    pair(&mut marks, "elbow", elbow);
    pair(&mut marks, "wrist", wrist);
    pair(&mut marks, "knee", skin(field, field.leg_centre(figure.y(level::KNEE)), DVec3::Z));
    pair(&mut marks, "ankle", skin(field, field.leg_centre(figure.y(level::ANKLE_BONE)), DVec3::X));
    let pelvis = trunk_middle(figure, field, level::HIP);
    middle(&mut marks, "crotch", skin(field, pelvis, -DVec3::Y));
    middle(&mut marks, "crown", DVec3::new(0.0, figure.y(level::CROWN), 0.0));
    middle(&mut marks, "chin", skin(field, DVec3::new(0.0, figure.y(level::CHIN + 0.02), 0.02), DVec3::Z));
    marks
}

/// The left armpit: the highest point between trunk and arm, in the frontal plane of the shoulder joint.
fn armpit(figure: &Figure, field: &Field) -> DVec3 {
    let joint = figure.shoulder_joint();
    for down in 0..150 {
        let y = joint.y - 0.002 * f64::from(down);
        for across in 0..80 {
            let p = DVec3::new(joint.x - 0.06 + 0.002 * f64::from(across), y, joint.z);
            if field.value(p) > 0.0 {
                // Points above the arm are not below it.
                if (p - joint).dot(figure.arm_outward()) < 0.0 {
                    return field.onto_skin(p, 4);
                }
                break;
            }
        }
    }
    joint
}

/// The skeleton in the built pose.
pub fn skeleton(figure: &Figure, field: &Field) -> Skeleton {
    let mut s = Skeleton::default();
    let middle = |y: f64| trunk_middle(figure, field, y);
    let pelvis = s.add("pelvis", None, middle(level::HIP + 0.02));
    let spine = s.add("spine", Some(pelvis), middle(level::WAIST));
    let chest = s.add("chest", Some(spine), middle(level::BUST + 0.02));
    let neck = s.add("neck", Some(chest), middle(level::SHOULDER + 0.05));
    let head = s.add("head", Some(neck), middle(level::CHIN + 0.035));
    s.add("crown", Some(head), DVec3::new(0.0, figure.y(level::CROWN), 0.0));
    for (side, sign) in [("left", 1.0), ("right", -1.0)] {
        let at = |p: DVec3| DVec3::new(p.x * sign, p.y, p.z);
        let named = |name: &str| format!("{name}_{side}");
        let arm = |along: f64| at(field.arm_centre(figure.along_arm(along)));
        let joint = figure.shoulder_joint();
        let collar = DVec3::new(0.25 * joint.x, joint.y, joint.z);
        let collar = s.add(named("collar"), Some(chest), at(collar));
        let shoulder = s.add(named("shoulder"), Some(collar), at(joint));
        let elbow = s.add(named("elbow"), Some(shoulder), arm(nominal::ELBOW_AT));
        let wrist = s.add(named("wrist"), Some(elbow), arm(nominal::WRIST_AT));
        s.add(named("knuckles"), Some(wrist), arm(0.65));
        let leg = |y: f64| at(field.leg_centre(figure.y(y)));
        let hip = s.add(
            named("hip"),
            Some(pelvis),
            at(DVec3::new(0.088 * figure.width(level::HIP), figure.y(0.895), 0.0)),
        );
        let knee = s.add(named("knee"), Some(hip), leg(level::KNEE));
        let ankle = s.add(named("ankle"), Some(knee), leg(level::ANKLE_BONE));
        let toes = leg(level::ANKLE_BONE) + DVec3::new(sign * 0.026, -0.052, 0.165) * figure.foot();
        s.add(named("toes"), Some(ankle), toes);
    }
    s
}
