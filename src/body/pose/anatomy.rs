//! Anatomical angles of the mannequin's joints, and their ranges.
//!
//! Angles count from the neutral zero position: upright, arms hanging, palms inward, feet forward. Ranges are those of
//! the American Academy of Orthopaedic Surgeons (1965, "Joint Motion: Method of Measuring and Recording"); neck and back
//! have two joints here, each with half of the range. Of the 180° that an arm can be raised the shoulder has 150° and the
//! collar the rest: its ranges are those of the sternoclavicular joint (Magee 2014, "Orthopedic Physical Assessment").

use glam::{DMat3, DQuat, DVec3};

use crate::body::pose::regions::JOINTS;
use crate::body::pose::{Pose, hanging, shortest};
use crate::body::skeleton::Skeleton;
use crate::geometry::words::{Words, within_quotes, words};

/// Cosine of the abduction below which two axes count as parallel (gimbal lock).
const LOCKED: f64 = 1e-9;
/// Rounding error of an angle read off a rotation, degrees, allowed beyond a joint's range.
const READ_ERROR: f64 = 1e-6;

/// An anatomical axis of a joint. The same angle on the other side of the body is the mirrored rotation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Axis {
    /// The axis from side to side: bends forward.
    Flexion,
    /// The axis from front to back: moves away from the middle.
    Abduction,
    /// The axis along the limb: rotates it.
    Twist,
}

impl Axis {
    /// All axes, in the order of a joint's angles.
    pub const ALL: [Self; 3] = [Self::Flexion, Self::Abduction, Self::Twist];

    /// Name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Flexion => "flexion",
            Self::Abduction => "abduction",
            Self::Twist => "twist",
        }
    }
}

/// A movement of a joint about one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Movement {
    /// The axis.
    pub axis: Axis,
    /// Name of the movement at this joint, in positive and in negative direction.
    pub title: &'static str,
    /// Smallest and largest angle, degrees.
    pub range: [f64; 2],
}

/// Name of a joint without its side, and its movements.
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

/// A joint that can be turned, on one side of the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limb {
    /// Name of the joint in the skeleton and in a [`Pose`].
    pub joint: &'static str,
    /// The movements that the joint has, in the order of [`Axis::ALL`].
    pub movements: &'static [Movement],
}

impl Limb {
    /// All joints that can be turned, parents first.
    pub fn all() -> impl Iterator<Item = Self> {
        JOINTS.iter().filter_map(|(joint, _)| {
            let (_, movements) = PARTS.iter().find(|(part, _)| *part == split(joint).0)?;
            Some(Self { joint, movements })
        })
    }

    /// The joint with this name: "left_elbow", "elbow_left", "left-elbow", or "spine".
    pub fn named(name: &str) -> Option<Self> {
        let name = name.trim().to_lowercase().replace(['-', ' '], "_");
        Self::all().find(|limb| limb.joint == name || limb.name() == name)
    }

    /// Name on the command line: the side first.
    pub fn name(self) -> String {
        match split(self.joint) {
            (part, Some(side)) => format!("{side}_{part}"),
            (part, None) => part.to_owned(),
        }
    }

    /// Name for people.
    pub fn title(self) -> String {
        let words = self.name().replace('_', " ");
        words[..1].to_uppercase() + &words[1..]
    }

    /// The same joint on the other side; None for joints in the middle.
    pub fn other_side(self) -> Option<Self> {
        let (part, side) = split(self.joint);
        let other = if side? == "left" { "right" } else { "left" };
        Self::all().find(|limb| split(limb.joint) == (part, Some(other)))
    }

    /// The movement about `axis`, if the joint has it.
    pub fn movement(self, axis: Axis) -> Option<Movement> {
        self.movements.iter().copied().find(|movement| movement.axis == axis)
    }

    /// Describes what is wrong with an angle, if anything. Joint and axis have their names on the command line.
    fn problem(self, axis: Axis, degrees: f64) -> Option<Words> {
        let (joint, axis_name) = (self.name(), axis.name());
        let Some(Movement { range: [least, largest], .. }) = self.movement(axis) else {
            let known: Vec<&str> = self.movements.iter().map(|m| m.axis.name()).collect();
            let names = known.join(", ");
            return Some(words!("{joint} has no {axis}; it has {names}", joint, axis = axis_name, names));
        };
        let is_in = (least - READ_ERROR..=largest + READ_ERROR).contains(&degrees);
        (!is_in).then(|| {
            words!(
                "{joint}: {axis} {degrees}° is out of its range, {least}° to {largest}°",
                joint,
                axis = axis_name,
                degrees,
                least,
                largest
            )
        })
    }
}

/// Splits the name of a joint into part and side: "elbow" and "left" for "elbow_left".
fn split(joint: &str) -> (&str, Option<&str>) {
    match joint.rsplit_once('_') {
        Some((part, side)) => (part, Some(side)),
        None => (joint, None),
    }
}

/// An angle of one joint about one axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointAngle {
    /// The joint.
    pub limb: Limb,
    /// The axis.
    pub axis: Axis,
    /// Angle from the neutral zero position, degrees, within the joint's range.
    pub degrees: f64,
}

impl JointAngle {
    /// An angle of the joint called `name`, which may end in an axis ("right_hip.abduction"); without it the joint's
    /// first movement is meant.
    ///
    /// # Errors
    /// In words: there is no such joint or axis, or the angle is out of the joint's range.
    pub fn new(name: &str, degrees: f64) -> Result<Self, Words> {
        let (joint, axis) = name.split_once('.').map_or((name, None), |(joint, axis)| (joint, Some(axis)));
        let limb = Limb::named(joint).ok_or_else(|| {
            let known: Vec<String> = Limb::all().map(Limb::name).collect();
            words!(
                "the mannequin has no joint called \"{name}\" that turns; there are {names}",
                name = within_quotes(joint),
                names = known.join(", ")
            )
        })?;
        let axis = match axis {
            None => limb.movements[0].axis,
            Some(text) => Axis::ALL.into_iter().find(|axis| axis.name() == text.trim()).ok_or_else(|| {
                words!(
                    "{joint}: there is no axis \"{axis}\"; there are {names}",
                    joint = limb.name(),
                    axis = within_quotes(text),
                    names = Axis::ALL.map(Axis::name).join(", ")
                )
            })?,
        };
        limb.problem(axis, degrees).map_or(Ok(Self { limb, axis, degrees }), Err)
    }
}

impl std::str::FromStr for JointAngle {
    type Err = String;

    /// Parses "left_elbow=60" or "right_hip.abduction=20".
    fn from_str(text: &str) -> Result<Self, String> {
        let (name, degrees) = text
            .split_once('=')
            .ok_or_else(|| format!("{text:?} is not JOINT=DEGREES or JOINT.AXIS=DEGREES"))?;
        let number = degrees.trim().trim_end_matches('°').parse();
        let degrees = number.map_err(|_| format!("{degrees:?} is no number of degrees"))?;
        Self::new(name, degrees).map_err(String::from)
    }
}

/// Converts between anatomical angles and the rotations of a pose, for one skeleton.
#[derive(Clone, Copy, Debug)]
pub struct Anatomy {
    /// Angle between the left arm as built and straight down, radians.
    hanging: f64,
}

/// Orthogonal unit axes of a joint on the left side, and its abduction as built, radians.
struct Axes {
    axes: [DVec3; 3],
    built: f64,
}

impl Anatomy {
    /// For the mannequin with this `skeleton`.
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

    /// The rotation vector, as in a [`Pose`], that gives `limb` these angles (degrees, in the order of
    /// [`Axis::ALL`]): first twist, then abduction, then flexion.
    pub fn turn(&self, limb: Limb, degrees: [f64; 3]) -> DVec3 {
        let (part, side) = split(limb.joint);
        let Axes { axes, built } = self.axes(part);
        let [flexed, abducted, twisted] =
            [0, 1, 2].map(|k| DQuat::from_axis_angle(axes[k], degrees[k].to_radians()));
        let turn = flexed * abducted * twisted * DQuat::from_axis_angle(axes[1], -built);
        on_side(shortest(turn).to_scaled_axis(), side)
    }

    /// The angles of `limb` in `pose`, degrees, in the order of [`Axis::ALL`]; the twist is within -90..=90. In
    /// gimbal lock, where flexion and twist have the same axis, all of it is given as flexion.
    pub fn angles(&self, pose: &Pose, limb: Limb) -> [f64; 3] {
        let (part, side) = split(limb.joint);
        let Axes { axes, built } = self.axes(part);
        let turn = pose.turns.get(limb.joint).copied().unwrap_or_default();
        let turn = DQuat::from_scaled_axis(on_side(turn, side)) * DQuat::from_axis_angle(axes[1], built);
        let frame = DMat3::from_cols(axes[0], axes[1], axes[2]);
        // In the joint's frame R = Rx(flexion) Ry(abduction) Rz(twist). In a left-handed frame angles change sign.
        let r = frame.transpose() * DMat3::from_quat(turn) * frame;
        let cos = r.col(0).x.hypot(r.col(1).x);
        let own = match cos < LOCKED {
            true => [r.col(1).z.atan2(r.col(1).y), r.col(2).x.atan2(cos), 0.0],
            false => {
                // Of the two solutions take the one with less twist.
                let sign = if r.col(0).x < 0.0 { -1.0 } else { 1.0 };
                [
                    (-r.col(2).y * sign).atan2(r.col(2).z * sign),
                    r.col(2).x.atan2(cos * sign),
                    (-r.col(1).x * sign).atan2(r.col(0).x * sign),
                ]
            }
        };
        // Round, so that a joint that is not turned reads 0°, and not -0°.
        own.map(|angle| (angle * frame.determinant()).to_degrees())
            .map(|degrees| (degrees * 1e9).round() / 1e9 + 0.0)
    }

    /// Sets the angles of `limb` in `pose`, degrees, in the order of [`Axis::ALL`].
    pub fn set(&self, pose: &mut Pose, limb: Limb, degrees: [f64; 3]) {
        pose.set(limb.joint, self.turn(limb, degrees));
    }

    /// `pose` with these angles set and all others unchanged.
    ///
    /// # Errors
    /// In words, which name the joint that cannot be turned like that.
    pub fn with(&self, pose: &Pose, angles: &[JointAngle]) -> Result<Pose, Words> {
        let mut pose = pose.clone();
        for &JointAngle { limb, axis, degrees } in angles {
            let mut all = self.angles(&pose, limb);
            all[axis as usize] = degrees;
            self.set(&mut pose, limb, all);
        }
        pose.problem().map_or(Ok(pose), Err)
    }
}

/// Mirrors a rotation vector between left and right, if `side` is right.
fn on_side(turn: DVec3, side: Option<&str>) -> DVec3 {
    if side == Some("right") { DVec3::new(turn.x, -turn.y, -turn.z) } else { turn }
}

/// `pose` with the right side set to the mirror image of the left; joints in the middle stay.
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
