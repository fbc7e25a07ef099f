//! The dress form that a garment is drafted for: measurements and heights of the mannequin, and the position of its arms.

use glam::{DVec2, DVec3};

use crate::body::measure::{length, taut};
use crate::body::pose::rig;
use crate::body::{Landmarks, Mannequin, MannequinError, Measurements, NamedPose, Surface, mannequin};

/// Spacing of points on measuring tapes, metres.
const STEP: f64 = 0.01;
/// Distance of measuring tapes from the skin, metres.
const OFF_SKIN: f64 = 0.004;
/// Slope of a shoulder seam as a share of the shoulder's slope: less steep, to leave room for its roundness.
const SLOPE_EASE: f64 = 0.85;
/// Largest distance of the neck end of a shoulder seam from the middle, as a share of half the shoulder width.
const MOST_NECK: f64 = 0.64;

/// The mannequin in a size and pose, as a pattern cutter sees it. In metres; heights are above the ground.
#[derive(Debug)]
pub struct Form {
    /// Measurements of the mannequin.
    pub measurements: Measurements,
    /// Height of the bust line.
    pub bust: f64,
    /// Height of the natural waist.
    pub waist: f64,
    /// Height of the fullest part of the hip.
    pub hip: f64,
    /// Height of the crotch.
    pub crotch: f64,
    /// Height of the knee.
    pub knee: f64,
    /// Height of the ankle bone.
    pub ankle: f64,
    /// Left armpit, with the arms in the A pose.
    pub armpit: DVec3,
    /// Left shoulder tip, with the arms in the A pose.
    pub shoulder: DVec3,
    /// The fullest point of the left breast.
    pub bust_point: DVec3,
    /// z of the skin in front and at the back at the bust line.
    pub depth: [f64; 2],
    /// z of the skin in front and at the back at the hip.
    pub hip_depth: [f64; 2],
    /// Height of the crown.
    pub crown: f64,
    /// Height of the chin.
    chin: f64,
    /// The left arm in the pose.
    pub arm: Arm,
    surface: Surface,
}

/// The left arm in the pose that the garment is placed for.
#[derive(Clone, Copy, Debug)]
pub struct Arm {
    /// Centre of the upper arm at the shoulder, metres.
    pub joint: DVec3,
    /// Centre of the wrist, metres.
    pub wrist: DVec3,
    /// Shoulder tip on the skin, metres.
    pub tip: DVec3,
    /// The armpit, metres.
    pub armpit: DVec3,
}

impl Arm {
    /// Angle of the arm below the horizontal as seen from the front, radians.
    pub fn fall(&self) -> f64 {
        let along = self.wrist - self.joint;
        (-along.y).atan2(along.x)
    }
}

/// Shoulder seam of a bodice, drawn at the left of the body with the bust line at y = 0, metres.
#[derive(Clone, Copy, Debug)]
pub struct Yoke {
    /// Neck end of the seam, in front and at the back.
    pub neck: [DVec2; 2],
    /// Shoulder end of the seam, in front and at the back.
    pub tip: [DVec2; 2],
}

impl Form {
    /// The mannequin with `measurements`, its arms as in `pose`. The error tells which measurement no mannequin has.
    pub fn new(measurements: &Measurements, pose: NamedPose) -> Result<Self, MannequinError> {
        let figure = mannequin::mannequin(measurements)?;
        let Some(mut form) = Self::of(&figure) else { return Err(MannequinError::Unreachable) };
        if pose != NamedPose::A {
            let posed = rig(measurements)?.posed(&pose.pose(&figure.skeleton));
            let posed = posed.ok_or(MannequinError::Unreachable)?;
            form.arm = arm(&posed.landmarks, |name| posed.skeleton.position(name))
                .ok_or(MannequinError::Unreachable)?;
        }
        Ok(form)
    }

    /// The form of `figure` in the pose it is built in. None where the mannequin lacks a landmark, which does not happen.
    pub fn of(figure: &Mannequin) -> Option<Self> {
        let mark = |name: &str| figure.landmarks.get(name);
        let z = |name: &str| mark(name).map(|p| p.z);
        Some(Self {
            measurements: figure.measurements,
            bust: mark("bust_front")?.y,
            waist: mark("waist_front")?.y,
            hip: mark("hip_front")?.y,
            crotch: mark("crotch")?.y,
            knee: mark("knee_left")?.y,
            ankle: mark("ankle_left")?.y,
            armpit: mark("armpit_left")?,
            shoulder: mark("shoulder_left")?,
            bust_point: mark("bust_point_left")?,
            depth: [z("bust_front")?, z("bust_back")?],
            hip_depth: [z("hip_front")?, z("hip_back")?],
            crown: mark("crown")?.y,
            chin: mark("chin")?.y,
            arm: arm(&figure.landmarks, |name| figure.skeleton.position(name))?,
            surface: Surface::new(figure.mesh.clone())?,
        })
    }

    /// Distance from the middle to the neck end of a shoulder seam, metres: `width` on the default figure, scaled by the
    /// shoulders or the neck of this one, whichever ratio is larger; some of the shoulder is left.
    pub fn neck_width(&self, width: f64) -> f64 {
        let (own, usual) = (&self.measurements, Measurements::default());
        let shoulders = own.half_across_shoulder / usual.half_across_shoulder;
        (width * shoulders.max(own.neck / usual.neck)).min(MOST_NECK * own.half_across_shoulder)
    }

    /// The top of the shoulder at `x`, metres.
    pub fn shoulder_at(&self, x: f64) -> DVec3 {
        let below = |y: f64| {
            let hit = self.surface.ray(DVec3::new(x, y, self.shoulder.z), DVec3::NEG_Y);
            hit.map_or(self.shoulder, |hit| hit.point)
        };
        let top = below(1.0e3);
        // A child's head is over its shoulders.
        if top.y > self.chin { below(self.chin) } else { top }
    }

    /// The point of the skin at `x`, `y`, in front (`side` 1) or behind (-1).
    fn skin(&self, x: f64, y: f64, side: f64) -> Option<DVec3> {
        // A ray just along an edge of the plane of symmetry may slip through.
        let hit = self.surface.ray(DVec3::new(x + 3e-4, y, side), DVec3::new(0.0, 0.0, -side))?;
        Some(hit.point.with_x(x))
    }

    /// Length of a tape from the top of the shoulder at `x` down to the bust line, in front (`side` 1) or behind (-1), metres.
    fn drop(&self, x: f64, side: f64) -> f64 {
        let (top, low) = (self.shoulder_at(x), self.bust);
        let lifted = |p: DVec3| DVec2::new(side * p.z, p.y) + DVec2::new(OFF_SKIN, OFF_SKIN / 2.0);
        let steps = ((top.y - low) / STEP).ceil().max(1.0);
        let at = |i: usize| self.skin(x, low + (top.y - low) * i as f64 / steps, side).map(lifted);
        // Seen with the front to the right, the body is to the left of a tape that runs up its front.
        length(&taut((0..steps as usize).filter_map(at).chain([lifted(top)])))
    }

    /// A shoulder seam whose neck end is `neck_width` metres from the middle, and which is `short` metres shorter than the
    /// shoulder.
    pub fn yoke(&self, neck_width: f64, short: f64) -> Yoke {
        let neck = self.shoulder_at(neck_width);
        let tip = self.shoulder;
        let seam = neck.distance(tip) - short;
        let slope = SLOPE_EASE * ((neck.y - tip.y) / (tip.x - neck.x).max(0.02)).atan();
        let rises = [1.0, -1.0].map(|side| self.drop(neck_width, side));
        let neck = rises.map(|rise| DVec2::new(neck_width, rise));
        Yoke { neck, tip: neck.map(|neck| neck + DVec2::new(slope.cos(), -slope.sin()) * seam) }
    }
}

fn arm(marks: &Landmarks, joint: impl Fn(&str) -> Option<DVec3>) -> Option<Arm> {
    Some(Arm {
        joint: joint("shoulder_left")?,
        wrist: joint("wrist_left")?,
        tip: marks.get("shoulder_left")?,
        armpit: marks.get("armpit_left")?,
    })
}
