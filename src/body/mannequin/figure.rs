//! The default proportions, stretched to one set of measurements.

use glam::DVec3;

use super::childhood::Childhood;
use super::measurements::Measurements;
use super::proportions::{self as nominal, level};
use super::spline::Spline;

/// Scale factors on the default proportions, one for each measured place. `fit` finds them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factors {
    /// Factors on the thickness at ankle, calf, knee, mid-thigh, upper thigh, hip, abdomen, waist, bust, neck.
    pub girth: [f64; 10],
    /// Factor on half the distance between the shoulder joints.
    pub shoulder: f64,
    /// Factors on the thickness of upper arm and wrist.
    pub arm: [f64; 2],
    /// Factor on the length of the arm.
    pub arm_length: f64,
    /// Factor on heights up to the waist.
    pub lower: f64,
    /// Factor on the total height.
    pub height: f64,
    /// What is a child's. It follows from the height wanted, and is not corrected.
    pub child: Childhood,
}

/// Height of a small child's shoulder tips as a share of the way from waist to chin.
const SMALL_SHOULDER: f64 = 0.80;
/// Factor on the gap between a small child's legs.
const SMALL_GAP: f64 = 0.8;

/// Heights on the default figure at which the entries of `Factors::girth` apply, metres.
pub const GIRTH_LEVELS: [f64; 10] = [
    level::ANKLE,
    level::CALF,
    level::KNEE,
    level::MID_THIGH,
    level::UPPER_THIGH,
    level::HIP,
    level::ABDOMEN,
    level::WAIST,
    level::BUST,
    level::NECK,
];

impl Factors {
    /// First guess of the factors: measurements divided by the default ones.
    pub fn guess(m: &Measurements) -> Self {
        let u = Measurements::default();
        Self {
            girth: [
                m.ankle / u.ankle,
                m.calf / u.calf,
                m.knee / u.knee,
                m.mid_thigh / u.mid_thigh,
                m.upper_thigh / u.upper_thigh,
                m.hip / u.hip,
                m.abdomen / u.abdomen,
                m.waist / u.waist,
                m.bust / u.bust,
                m.neck / u.neck,
            ],
            shoulder: m.half_across_shoulder / u.half_across_shoulder,
            arm: [m.upper_arm / u.upper_arm, m.wrist / u.wrist],
            arm_length: m.arm_length / u.arm_length,
            lower: m.waist_to_ankle / u.waist_to_ankle,
            height: m.height / u.height,
            child: Childhood::of(m.height),
        }
    }

    /// What grows with the square root of a girth's factor, in proportion to the height.
    fn fuller(&self, factor: f64) -> f64 {
        (factor * self.height).sqrt()
    }
}

/// A figure: maps points of the default proportions to the body with the wanted measurements.
#[derive(Clone, Debug)]
pub struct Figure {
    /// The factors it was built from.
    pub factors: Factors,
    width: Spline,
    depth: Spline,
    height: Spline,
}

impl Figure {
    /// The figure with these factors.
    pub fn new(factors: Factors) -> Self {
        let g = factors.girth;
        // A fuller bust grows forward more than sideways, where the arms are.
        let stretched = |bust: f64, shoulder: f64| {
            let mut knots: Vec<(f64, f64)> = GIRTH_LEVELS.into_iter().zip(g).collect();
            knots[8].1 = bust;
            knots.insert(9, (level::SHOULDER - 0.02, shoulder));
            knots.insert(0, (0.0, g[0]));
            knots.push((level::CROWN, g[9]));
            Spline::new(knots.into_iter())
        };
        let child = factors.child;
        let total = factors.height;
        let crown = level::CROWN * total;
        let waist = level::WAIST * factors.lower;
        // Above the waist heights stretch evenly; the head keeps the scale of the whole body, or is a child's.
        let chin = crown - (level::CROWN - level::CHIN) * (total * child.head);
        let shoulder =
            waist + (chin - waist) * (level::SHOULDER - level::WAIST) / (level::CHIN - level::WAIST);
        // A child's neck is short.
        let shoulder = child.mixed(shoulder, waist + SMALL_SHOULDER * (chin - waist));
        let heights = [
            (0.0, 0.0),
            (0.5 * level::WAIST, 0.5 * waist),
            (level::WAIST, waist),
            (level::SHOULDER, shoulder),
            (level::CHIN, chin),
            (level::CROWN, crown),
        ];
        Self {
            factors,
            width: stretched(child.mixed(g[8].powf(0.6), g[8]), factors.shoulder),
            depth: stretched(
                child.mixed(g[8].powf(1.4), g[8]),
                child.mixed(g[8].sqrt(), factors.fuller(g[8])),
            ),
            height: Spline::new(heights.into_iter()),
        }
    }

    /// Height above the floor, metres, of what is at height `y` on the default figure.
    pub fn y(&self, y: f64) -> f64 {
        self.height.value(y)
    }

    /// Factor on widths (x) at height `y` of the default figure.
    pub fn width(&self, y: f64) -> f64 {
        self.width.value(y)
    }

    /// Factor on depths (z) at height `y` of the default figure.
    pub fn depth(&self, y: f64) -> f64 {
        self.depth.value(y)
    }

    /// The image of a point on or near the trunk or a leg of the default figure.
    pub fn point(&self, p: [f64; 3]) -> DVec3 {
        DVec3::new(p[0] * self.width(p[1]), self.y(p[1]), p[2] * self.depth(p[1]))
    }

    /// Centre of the left shoulder joint.
    pub fn shoulder_joint(&self) -> DVec3 {
        let [x, y, z] = nominal::SHOULDER_JOINT;
        DVec3::new(x * self.factors.shoulder, self.y(y), z * self.depth(y))
    }

    /// Scale factor of what is as large as the whole body.
    pub fn small(&self) -> f64 {
        self.factors.height
    }

    /// Scale factor of the head.
    pub fn head(&self) -> f64 {
        self.small() * self.factors.child.head
    }

    /// Scale factor of the hands.
    pub fn hand(&self) -> f64 {
        self.small() * self.factors.child.hand
    }

    /// Scale factor of the feet.
    pub fn foot(&self) -> f64 {
        self.small() * self.factors.child.foot
    }

    /// Scale factor of roundings and modelling, which grown figures of all sizes have alike.
    pub fn fine(&self) -> f64 {
        self.factors.child.mixed(1.0, self.small())
    }

    /// Factor on the gap between the legs.
    pub fn gap(&self) -> f64 {
        self.factors.child.mixed(1.0, SMALL_GAP)
    }

    /// Angle between the arms and straight down, radians: wider where arms and bust are fuller, so that they stay apart.
    fn arm_angle(&self) -> f64 {
        let child = self.factors.child;
        let fuller = |factor: f64| (child.mixed(factor, factor / self.small()) - 1.1).clamp(0.0, 0.5);
        nominal::ARM_ANGLE + 0.4 * fuller(self.factors.girth[8]) + 0.4 * fuller(self.factors.arm[0])
    }

    /// Direction along the left arm, a unit vector.
    pub fn arm_direction(&self) -> DVec3 {
        DVec3::new(self.arm_angle().sin(), -self.arm_angle().cos(), 0.0)
    }

    /// Direction across the left arm, outward and up, a unit vector.
    pub fn arm_outward(&self) -> DVec3 {
        DVec3::new(self.arm_angle().cos(), self.arm_angle().sin(), 0.0)
    }

    /// Distance from the shoulder joint along the arm, metres, of what is at `s` on the default figure.
    pub fn along_arm(&self, s: f64) -> f64 {
        // Beyond the wrist the hand keeps the scale of the whole body.
        let wrist = nominal::WRIST_AT;
        if s <= wrist {
            s * self.factors.arm_length
        } else {
            wrist * self.factors.arm_length + (s - wrist) * self.hand()
        }
    }

    /// Factor on the arm's thickness at `s` metres along the arm of the default figure.
    pub fn arm_thickness(&self, s: f64) -> f64 {
        let [upper, wrist] = self.factors.arm;
        let top = self.factors.child.mixed(upper.sqrt(), self.factors.fuller(upper));
        let knots = [
            (0.0, top),
            (nominal::UPPER_ARM_AT, upper),
            (nominal::WRIST_AT, wrist),
            (0.60, 0.5 * (wrist + self.hand())),
            (0.68, self.hand()),
        ];
        let i = knots.partition_point(|k| k.0 <= s).clamp(1, knots.len() - 1);
        let ((x0, y0), (x1, y1)) = (knots[i - 1], knots[i]);
        y0 + (y1 - y0) * ((s - x0) / (x1 - x0)).clamp(0.0, 1.0)
    }
}
