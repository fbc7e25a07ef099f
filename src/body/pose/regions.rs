//! Regions of the skin: which part of it is below each joint in the skeleton.

use glam::DVec3;

use crate::body::skeleton::Skeleton;

/// Joints that can be turned, parents first, each with the distance over which its rotation is blended on both sides
/// of it, metres on a figure of default height.
pub const JOINTS: [(&str, f64); 18] = [
    ("spine", 0.060),
    ("chest", 0.060),
    ("neck", 0.024),
    ("head", 0.024),
    ("collar_left", 0.040),
    ("collar_right", 0.040),
    ("shoulder_left", 0.034),
    ("shoulder_right", 0.034),
    ("elbow_left", 0.024),
    ("elbow_right", 0.024),
    ("wrist_left", 0.014),
    ("wrist_right", 0.014),
    ("hip_left", 0.042),
    ("hip_right", 0.042),
    ("knee_left", 0.030),
    ("knee_right", 0.030),
    ("ankle_left", 0.020),
    ("ankle_right", 0.020),
];

/// Radius of an arm or a thigh about its bone, metres on a figure of default height. Points belong to the bone to
/// which their distance, divided by the radius, is smallest.
const ARM: f64 = 0.045;
/// Radius of the trunk about its bones, metres on a figure of default height; see [`ARM`].
const TRUNK: f64 = 0.135;

/// The skeleton's division of space into regions.
pub struct Regions<'a> {
    skeleton: &'a Skeleton,
}

impl<'a> Regions<'a> {
    /// Regions of `skeleton`. None when a joint is missing.
    pub fn new(skeleton: &'a Skeleton) -> Option<Self> {
        let whole = JOINTS.iter().all(|(name, _)| skeleton.index(name).is_some());
        whole.then_some(Self { skeleton })
    }

    fn joint(&self, name: &str) -> DVec3 {
        self.skeleton.position(name).unwrap_or_default()
    }

    /// Whether a point of the skin is below the joint called `name`, so that it moves with it.
    pub fn is_below(&self, name: &str, p: DVec3) -> bool {
        let (part, sign) = match name.rsplit_once('_') {
            Some((part, "left")) => (part, 1.0),
            Some((part, "right")) => (part, -1.0),
            _ => (name, 1.0),
        };
        // The sides are mirror images: decide for the left one.
        let p = DVec3::new(p.x * sign, p.y, p.z);
        match part {
            "spine" | "chest" => self.is_arm(p) || self.is_arm(mirrored(p)) || p.y > self.joint(part).y,
            "neck" | "head" => self.is_above(part, p),
            "collar" => !self.is_above("neck", p) && (self.is_arm(p) || self.is_beyond("collar", p)),
            "shoulder" => self.is_arm(p) && self.is_beyond("shoulder", p),
            "elbow" | "wrist" => self.is_arm(p) && self.is_beyond(part, p),
            "hip" | "knee" | "ankle" => p.x > 0.0 && !self.is_arm(p) && self.is_beyond(part, p),
            _ => false,
        }
    }

    /// Whether a point is above a joint of the neck and not on an arm.
    fn is_above(&self, part: &str, p: DVec3) -> bool {
        // The throat is lower than the nape: slope the plane.
        let (joint, slope) = (self.joint(part), if part == "neck" { 0.45 } else { 0.2 });
        !self.is_arm(p) && p.x.abs() < 0.16 && (p - joint).dot(DVec3::new(0.0, 1.0, slope)) > 0.0
    }

    /// Whether a point is on the far side of a plane through a joint of the left side.
    fn is_beyond(&self, part: &str, p: DVec3) -> bool {
        let at = |name: &str| self.joint(&format!("{name}_left"));
        let along = |from: &str, to: &str| (at(to) - at(from)).normalize_or_zero();
        let normal = match part {
            "collar" => DVec3::new(0.75, 0.66, 0.0),
            "shoulder" => along("shoulder", "elbow") + DVec3::X * 0.5,
            "elbow" => along("shoulder", "elbow") + along("elbow", "wrist"),
            "wrist" => along("elbow", "wrist"),
            // The plane rises from the crotch to the side, and from the fold below the seat to the groin.
            "hip" => DVec3::new(0.55, -0.75, 0.35),
            "knee" => along("hip", "knee") + along("knee", "ankle"),
            _ => DVec3::NEG_Y,
        };
        (p - at(part)).dot(normal) > 0.0
    }

    /// Whether a point is nearer to the left arm than to trunk and thigh, measured in radii of each.
    fn is_arm(&self, p: DVec3) -> bool {
        let at = |name: &str| self.joint(name);
        let bones =
            [("shoulder_left", "elbow_left"), ("elbow_left", "wrist_left"), ("wrist_left", "knuckles_left")];
        let arm = bones.map(|(a, b)| to_segment(p, at(a), at(b), b == "knuckles_left"));
        let trunk = [("pelvis", "spine"), ("spine", "chest"), ("chest", "neck")];
        let trunk = trunk.map(|(a, b)| to_segment(p, at(a), at(b), false));
        let legs = to_segment(p, at("hip_left"), at("knee_left"), false);
        let least = |all: &[f64]| all.iter().copied().fold(f64::INFINITY, f64::min);
        least(&arm) / ARM < (least(&trunk) / TRUNK).min(legs / ARM)
    }
}

fn mirrored(p: DVec3) -> DVec3 {
    DVec3::new(-p.x, p.y, p.z)
}

/// Distance of `p` from a segment, which extends to infinity beyond `b` when `is_last`.
fn to_segment(p: DVec3, a: DVec3, b: DVec3, is_last: bool) -> f64 {
    let side = b - a;
    let t = (p - a).dot(side) / side.length_squared().max(1e-18);
    p.distance(a + side * t.clamp(0.0, if is_last { f64::INFINITY } else { 1.0 }))
}
