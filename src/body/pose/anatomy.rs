//! The joints of the mannequin about their own axes, and how far people turn them.
//!
//! Angles count from the neutral zero position: upright, arms hanging, palms inward, feet forward. Ranges are those of the
//! American Academy of Orthopaedic Surgeons (1965, "Joint Motion: Method of Measuring and Recording"); neck and back have two
//! joints here, each with half of theirs. Of the 180° that an arm is raised the shoulder has 150° and the collar the rest: its
//! ranges are those of the sternoclavicular joint (Magee 2014, "Orthopedic Physical Assessment").

use glam::{DMat3, DQuat, DVec3};

use crate::body::pose::regions::JOINTS;
use crate::body::pose::{Pose, hanging, shortest};
use crate::body::skeleton::Skeleton;

/// A cosine less than this is none: two of the axes lie along each other.
const LOCKED: f64 = 1e-9;
/// An angle read off a turn has so much of an error, degrees.
const READ_ERROR: f64 = 1e-6;

/// About what a joint turns. On both sides of the body the same angle is the mirrored turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Axis {
    /// From side to side: bends forth.
    Flexion,
    /// From front to back: leads away from the middle.
    Abduction,
    /// Along the limb.
    Twist,
}

impl Axis {
    /// All, in the order in which a joint's angles stand.
    pub const ALL: [Self; 3] = [Self::Flexion, Self::Abduction, Self::Twist];

    /// As on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Flexion => "flexion",
            Self::Abduction => "abduction",
            Self::Twist => "twist",
        }
    }
}

/// One way in which a joint turns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Movement {
    /// About what.
    pub axis: Axis,
    /// What it is called at this joint, above and below zero.
    pub title: &'static str,
    /// The least and the largest angle, degrees.
    pub range: [f64; 2],
}

/// Of a joint, without its side, its movements.
type Part = (&'static str, &'static [Movement]);

const fn movement(axis: Axis, title: &'static str, least: f64, largest: f64) -> Movement {
    Movement { axis, title, range: [least, largest] }
}

use Axis::{Abduction, Flexion, Twist};

const PARTS: [Part; 11] = [
    ("spine", &BACK),
    ("chest", &BACK),
    ("neck", &NECK),
    ("head", &NECK),
    (
        "collar",
        &[
            movement(Flexion, "Protraction / retraction", -15.0, 15.0),
            movement(Abduction, "Elevation / depression", -10.0, 45.0),
        ],
    ),
    (
        "shoulder",
        &[
            movement(Flexion, "Flexion / extension", -60.0, 150.0),
            movement(Abduction, "Abduction / adduction", -10.0, 150.0),
            movement(Twist, "Inward / outward rotation", -90.0, 70.0),
        ],
    ),
    (
        "elbow",
        &[movement(Flexion, "Flexion", 0.0, 150.0), movement(Twist, "Pronation / supination", -80.0, 80.0)],
    ),
    (
        "wrist",
        &[
            movement(Flexion, "Flexion / extension", -70.0, 80.0),
            movement(Abduction, "Towards thumb / little finger", -30.0, 20.0),
        ],
    ),
    (
        "hip",
        &[
            movement(Flexion, "Flexion / extension", -30.0, 120.0),
            movement(Abduction, "Abduction / adduction", -30.0, 45.0),
            movement(Twist, "Inward / outward rotation", -45.0, 45.0),
        ],
    ),
    ("knee", &[movement(Flexion, "Flexion", 0.0, 135.0)]),
    (
        "ankle",
        &[
            movement(Flexion, "Toes up / down", -50.0, 20.0),
            movement(Abduction, "Eversion / inversion", -35.0, 15.0),
        ],
    ),
];

const BACK: [Movement; 3] = [
    movement(Flexion, "Forward / backward", -12.5, 40.0),
    movement(Abduction, "To the left / right", -17.5, 17.5),
    movement(Twist, "Turned to the left / right", -22.5, 22.5),
];

const NECK: [Movement; 3] = [
    movement(Flexion, "Forward / backward", -22.5, 22.5),
    movement(Abduction, "To the left / right", -22.5, 22.5),
    movement(Twist, "Turned to the left / right", -30.0, 30.0),
];

/// A joint that turns, on one side of the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limb {
    /// As in the skeleton and in a [`Pose`].
    pub joint: &'static str,
    /// In what ways it turns, those that it has, in the order of [`Axis::ALL`].
    pub movements: &'static [Movement],
}

impl Limb {
    /// All joints that turn, parents first.
    pub fn all() -> impl Iterator<Item = Self> {
        JOINTS.iter().filter_map(|(joint, _)| {
            let (_, movements) = PARTS.iter().find(|(part, _)| *part == split(joint).0)?;
            Some(Self { joint, movements })
        })
    }

    /// The joint that `name` means: "left_elbow", "elbow_left" or "left-elbow"; "spine".
    pub fn named(name: &str) -> Option<Self> {
        let name = name.trim().to_lowercase().replace(['-', ' '], "_");
        Self::all().find(|limb| limb.joint == name || limb.name() == name)
    }

    /// As on the command line: the side first.
    pub fn name(self) -> String {
        match split(self.joint) {
            (part, Some(side)) => format!("{side}_{part}"),
            (part, None) => part.to_owned(),
        }
    }

    /// For people.
    pub fn title(self) -> String {
        let words = self.name().replace('_', " ");
        words[..1].to_uppercase() + &words[1..]
    }

    /// The same joint of the other side.
    pub fn other_side(self) -> Option<Self> {
        let (part, side) = split(self.joint);
        let other = if side? == "left" { "right" } else { "left" };
        Self::all().find(|limb| split(limb.joint) == (part, Some(other)))
    }

    /// The movement about `axis`.
    pub fn movement(self, axis: Axis) -> Option<Movement> {
        self.movements.iter().copied().find(|movement| movement.axis == axis)
    }

    /// What is wrong with an angle, in words.
    fn problem(self, axis: Axis, degrees: f64) -> Option<String> {
        let (title, axis_name) = (self.name(), axis.name());
        let Some(Movement { range: [least, largest], .. }) = self.movement(axis) else {
            let known: Vec<&str> = self.movements.iter().map(|m| m.axis.name()).collect();
            return Some(format!("{title} has no {axis_name}; it has {}", known.join(", ")));
        };
        let is_in = (least - READ_ERROR..=largest + READ_ERROR).contains(&degrees);
        let words = || format!("{title}: {axis_name} {degrees}° is out of its range, {least}° to {largest}°");
        (!is_in).then(words)
    }
}

/// "elbow", "left" of "elbow_left".
fn split(joint: &str) -> (&str, Option<&str>) {
    match joint.rsplit_once('_') {
        Some((part, side)) => (part, Some(side)),
        None => (joint, None),
    }
}

/// One joint turned about one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointAngle {
    /// Which joint.
    pub limb: Limb,
    /// About what.
    pub axis: Axis,
    /// By how much from the neutral zero position, within the joint's range.
    pub degrees: f64,
}

impl JointAngle {
    /// The joint called `name`, perhaps with an axis behind a point ("right_hip.abduction"); without one, that in which it
    /// turns first. The error says what is wrong, in words.
    pub fn new(name: &str, degrees: f64) -> Result<Self, String> {
        let (joint, axis) = name.split_once('.').map_or((name, None), |(joint, axis)| (joint, Some(axis)));
        let limb = Limb::named(joint).ok_or_else(|| {
            let known: Vec<String> = Limb::all().map(Limb::name).collect();
            format!("the mannequin has no joint called {joint:?} that turns; there are {}", known.join(", "))
        })?;
        let axis = match axis {
            None => limb.movements[0].axis,
            Some(text) => Axis::ALL.into_iter().find(|axis| axis.name() == text.trim()).ok_or_else(|| {
                let known = Axis::ALL.map(Axis::name).join(", ");
                format!("{}: there is no axis {text:?}; there are {known}", limb.name())
            })?,
        };
        limb.problem(axis, degrees).map_or(Ok(Self { limb, axis, degrees }), Err)
    }
}

impl std::str::FromStr for JointAngle {
    type Err = String;

    /// "left_elbow=60", "right_hip.abduction=20".
    fn from_str(text: &str) -> Result<Self, String> {
        let (name, degrees) = text
            .split_once('=')
            .ok_or_else(|| format!("{text:?} is not JOINT=DEGREES or JOINT.AXIS=DEGREES"))?;
        let number = degrees.trim().trim_end_matches('°').parse();
        Self::new(name, number.map_err(|_| format!("{degrees:?} is no number of degrees"))?)
    }
}

/// Turns the joints of one skeleton about their own axes.
#[derive(Clone, Copy, Debug)]
pub struct Anatomy {
    /// Of the left arm as it was built, from straight down, radians.
    hanging: f64,
}

/// A joint's axes, unit and across each other, of its left side, and how far it is abducted as built, radians.
struct Axes {
    axes: [DVec3; 3],
    built: f64,
}

impl Anatomy {
    /// For the mannequin of `skeleton`.
    pub fn new(skeleton: &Skeleton) -> Self {
        Self { hanging: hanging(skeleton) }
    }

    fn axes(&self, part: &str) -> Axes {
        let (sin, cos) = self.hanging.sin_cos();
        let (along, outward) = (DVec3::new(sin, -cos, 0.0), DVec3::new(cos, sin, 0.0));
        let axes = match part {
            "spine" | "chest" | "neck" | "head" => [DVec3::X, DVec3::NEG_Z, DVec3::Y],
            "collar" => [DVec3::NEG_Y, DVec3::Z, DVec3::X],
            "elbow" => [-outward, DVec3::Z, along],
            "wrist" => [DVec3::NEG_Z, -outward, along],
            "knee" => [DVec3::X, DVec3::Z, DVec3::NEG_Y],
            "shoulder" | "hip" | "ankle" => [DVec3::NEG_X, DVec3::Z, DVec3::NEG_Y],
            _ => DMat3::IDENTITY.to_cols_array_2d().map(DVec3::from_array),
        };
        Axes { axes, built: if part == "shoulder" { self.hanging } else { 0.0 } }
    }

    /// The turn, a rotation vector as in a [`Pose`], that gives `limb` these angles (degrees, in the order of
    /// [`Axis::ALL`]): twisted, then abducted, then flexed.
    pub fn turn(&self, limb: Limb, degrees: [f64; 3]) -> DVec3 {
        let (part, side) = split(limb.joint);
        let Axes { axes, built } = self.axes(part);
        let [flexed, abducted, twisted] =
            [0, 1, 2].map(|k| DQuat::from_axis_angle(axes[k], degrees[k].to_radians()));
        let turn = flexed * abducted * twisted * DQuat::from_axis_angle(axes[1], -built);
        on_side(shortest(turn).to_scaled_axis(), side)
    }

    /// The angles of `limb` in `pose`, degrees, in the order of [`Axis::ALL`]; the twist within -90..=90. Where flexion and
    /// twist are about the same axis, all of it is flexion.
    pub fn angles(&self, pose: &Pose, limb: Limb) -> [f64; 3] {
        let (part, side) = split(limb.joint);
        let Axes { axes, built } = self.axes(part);
        let turn = pose.turns.get(limb.joint).copied().unwrap_or_default();
        let turn = DQuat::from_scaled_axis(on_side(turn, side)) * DQuat::from_axis_angle(axes[1], built);
        let frame = DMat3::from_cols(axes[0], axes[1], axes[2]);
        // In its own frame: R = Rx(flexion) Ry(abduction) Rz(twist). A left-handed frame turns the other way.
        let r = frame.transpose() * DMat3::from_quat(turn) * frame;
        let cos = r.col(0).x.hypot(r.col(1).x);
        let own = match cos < LOCKED {
            true => [r.col(1).z.atan2(r.col(1).y), r.col(2).x.atan2(cos), 0.0],
            false => {
                // Of both solutions the one that is twisted less.
                let sign = if r.col(0).x < 0.0 { -1.0 } else { 1.0 };
                [
                    (-r.col(2).y * sign).atan2(r.col(2).z * sign),
                    r.col(2).x.atan2(cos * sign),
                    (-r.col(1).x * sign).atan2(r.col(0).x * sign),
                ]
            }
        };
        // Less what rounding adds: a joint that is not turned reads 0°, and not -0°.
        own.map(|angle| (angle * frame.determinant()).to_degrees())
            .map(|degrees| (degrees * 1e9).round() / 1e9 + 0.0)
    }

    /// Gives `limb` these angles in `pose`.
    pub fn set(&self, pose: &mut Pose, limb: Limb, degrees: [f64; 3]) {
        pose.set(limb.joint, self.turn(limb, degrees));
    }

    /// `pose` with these joints turned, and all others as they are. The error says which cannot be.
    pub fn with(&self, pose: &Pose, angles: &[JointAngle]) -> Result<Pose, String> {
        let mut pose = pose.clone();
        for &JointAngle { limb, axis, degrees } in angles {
            let mut all = self.angles(&pose, limb);
            all[axis as usize] = degrees;
            self.set(&mut pose, limb, all);
        }
        pose.problem().map_or(Ok(pose), Err)
    }
}

/// A turn of the left side on `side`, or back: the mirror image.
fn on_side(turn: DVec3, side: Option<&str>) -> DVec3 {
    if side == Some("right") { DVec3::new(turn.x, -turn.y, -turn.z) } else { turn }
}

/// `pose` with the right side as the left, mirrored; what is in the middle stays.
pub fn mirrored_to_the_right(pose: &Pose) -> Pose {
    let mut mirrored = pose.clone();
    for limb in Limb::all().filter(|limb| split(limb.joint).1 == Some("left")) {
        let turn = pose.turns.get(limb.joint).copied().unwrap_or_default();
        if let Some(other) = limb.other_side() {
            mirrored.set(other.joint, on_side(turn, Some("right")));
        }
    }
    mirrored
}

#[cfg(test)]
#[path = "anatomy_tests.rs"]
mod tests;
