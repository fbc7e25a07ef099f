//! What a garment is drafted to: measurements and heights read off the mannequin, and how its arms are held.

use glam::{DVec2, DVec3};

use crate::body::measure::{length, taut};
use crate::body::pose::rig;
use crate::body::{Landmarks, Mannequin, MannequinError, Measurements, NamedPose, Surface, mannequin};

/// Spacing of points on tapes, metres.
const STEP: f64 = 0.01;
/// Cloth keeps this far from the skin, metres.
const OFF_SKIN: f64 = 0.004;
/// Shoulder seams fall by this share of how steeply the shoulder does: room for its roundness.
const SLOPE_EASE: f64 = 0.85;
/// Necklines are no wider than this share of the shoulders.
const MOST_NECK: f64 = 0.64;

/// The mannequin in a size and pose, as a pattern cutter sees it. Metres; heights above the ground.
#[derive(Debug)]
pub struct Form {
    /// What it is built to.
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
    /// Left armpit, arms half up.
    pub armpit: DVec3,
    /// Left shoulder tip, arms half up.
    pub shoulder: DVec3,
    /// From the middle of the front of the trunk out to the fullest part of the left breast.
    pub bust_point: DVec3,
    /// Skin of the front and back at the bust line.
    pub depth: [f64; 2],
    /// Skin of the front and back at the hip.
    pub hip_depth: [f64; 2],
    /// Height of the crown.
    pub crown: f64,
    /// How the left arm is held.
    pub arm: Arm,
    surface: Surface,
}

/// The left arm in the pose that the garment is placed for.
#[derive(Clone, Copy, Debug)]
pub struct Arm {
    /// Middle of the upper arm at the shoulder, metres.
    pub joint: DVec3,
    /// Middle of the wrist, metres.
    pub wrist: DVec3,
    /// Shoulder tip on the skin, metres.
    pub tip: DVec3,
    /// The armpit, metres.
    pub armpit: DVec3,
}

impl Arm {
    /// How far it falls below the level, radians, as seen from the front.
    pub fn fall(&self) -> f64 {
        let along = self.wrist - self.joint;
        (-along.y).atan2(along.x)
    }
}

/// Shoulder seam of a bodice, drawn at the left of the body with the bust line at y = 0, metres.
#[derive(Clone, Copy, Debug)]
pub struct Yoke {
    /// Where it meets the neckline, in front and behind.
    pub neck: [DVec2; 2],
    /// Its other end.
    pub tip: [DVec2; 2],
}

impl Form {
    /// The mannequin with `measurements`, its arms as in `pose`. The error says which of them no mannequin has.
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

    /// None where the mannequin lacks a point, which it does not.
    fn of(figure: &Mannequin) -> Option<Self> {
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
            arm: arm(&figure.landmarks, |name| figure.skeleton.position(name))?,
            surface: Surface::new(figure.mesh.clone())?,
        })
    }

    /// From the middle to the neck end of a shoulder seam: `width` metres of the default figure, in proportion to the shoulders
    /// or the neck of this one, whichever is larger; some of the shoulder is left.
    pub fn neck_width(&self, width: f64) -> f64 {
        let (own, usual) = (&self.measurements, Measurements::default());
        let shoulders = own.half_across_shoulder / usual.half_across_shoulder;
        (width * shoulders.max(own.neck / usual.neck)).min(MOST_NECK * own.half_across_shoulder)
    }

    /// The top of the shoulder at `x`, metres.
    pub fn shoulder_at(&self, x: f64) -> DVec3 {
        let above = DVec3::new(x, 1.0e3, self.shoulder.z);
        self.surface.ray(above, DVec3::NEG_Y).map_or(self.shoulder, |hit| hit.point)
    }

    /// The skin at `x`, `y`: in front (`side` 1) or behind (-1).
    fn skin(&self, x: f64, y: f64, side: f64) -> Option<DVec3> {
        // A ray just along an edge of the plane of symmetry may slip through.
        let hit = self.surface.ray(DVec3::new(x + 3e-4, y, side), DVec3::new(0.0, 0.0, -side))?;
        Some(hit.point.with_x(x))
    }

    /// Length of a tape from the top of the shoulder at `x` down to the bust line, in front (`side` 1) or behind (-1).
    fn drop(&self, x: f64, side: f64) -> f64 {
        let (top, low) = (self.shoulder_at(x), self.bust);
        let lifted = |p: DVec3| DVec2::new(side * p.z, p.y) + DVec2::new(OFF_SKIN, OFF_SKIN / 2.0);
        let steps = ((top.y - low) / STEP).ceil().max(1.0);
        let at = |i: usize| self.skin(x, low + (top.y - low) * i as f64 / steps, side).map(lifted);
        // The body lies to the left of a tape that runs up its front seen with the front to the right.
        length(&taut((0..steps as usize).filter_map(at).chain([lifted(top)])))
    }

    /// A shoulder seam whose neck end lies `neck_width` metres from the middle, `short` metres shorter than the shoulder.
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
