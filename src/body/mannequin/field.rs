//! The mannequin as one smooth implicit function of space: negative inside, zero on the skin, near it about the
//! signed distance.

use glam::DVec3;

use super::figure::Figure;
use super::hand::Hand;
use super::loft::{Loft, Section};
use super::proportions::{self as nominal, Swelling, level};
use super::smooth::{blended, cut};

/// Rounding of the crease where the two halves meet, metres.
const CLEFT: f64 = 0.011;
/// Depth by which a small child's breasts are sunk into its trunk, metres: none are seen.
const SUNK: f64 = 0.12;
/// Factors on the widths of a small child's head, from chin to brow: its cheeks are full.
const SMALL_CHEEKS: [f64; 9] = [1.04, 1.08, 1.11, 1.10, 1.08, 1.05, 1.03, 1.01, 1.0];
/// Height of a small child's features over that of a grown face's.
const SMALL_FACE: f64 = 0.7;
/// Height of a small child's features above its chin over that of a grown face's: its forehead is high.
const SMALL_FACE_AT: f64 = 0.88;
/// Height of what models a small child's trunk and limbs over that of a grown figure's: both are rounder.
const SMALL_MODELLING: f64 = 0.6;

/// The implicit function of a figure's skin. Symmetric in x.
#[derive(Clone, Debug)]
pub struct Field {
    trunk: Loft,
    arm: Loft,
    hand: Hand,
    foot: Loft,
    head: Loft,
    modelling: Vec<Swelling>,
    face: Vec<Swelling>,
    joint: DVec3,
    along: DVec3,
    outward: DVec3,
    breast_centre: DVec3,
    breast_axes: [f64; 4],
    foot_origin: DVec3,
    chin: f64,
    small: f64,
    head_size: f64,
    foot_size: f64,
    /// Factor on roundings.
    fine: f64,
    /// Depth by which the breasts are sunk into the trunk, metres.
    flat: f64,
    /// Distance from the middle from which on there can be an arm, metres.
    arm_from: f64,
}

impl Field {
    /// Builds the function for `figure`.
    pub fn new(figure: &Figure) -> Self {
        let (wide, deep) = (figure.width(level::BUST), figure.depth(level::BUST));
        let [x, up, down, z] = nominal::BREAST_AXES;
        let child = figure.factors.child;
        let [foot_x, foot_z] = nominal::FOOT_ORIGIN;
        Self {
            trunk: trunk(figure),
            arm: arm(figure),
            hand: Hand::new(figure),
            foot: foot(),
            head: head(figure),
            modelling: nominal::MODELLING.iter().map(|s| carried(s, figure)).collect(),
            face: nominal::FACE.iter().map(|s| of_face(s, figure)).collect(),
            joint: figure.shoulder_joint(),
            along: figure.arm_direction(),
            outward: figure.arm_outward(),
            breast_centre: figure.point(nominal::BREAST_CENTRE),
            breast_axes: [x * wide, up * wide, down * wide, z * deep],
            foot_origin: DVec3::new(
                foot_x + 0.032 * (figure.factors.girth[0] - 1.0) - 0.075 * (1.0 - figure.gap()),
                0.0,
                child.mixed(foot_z, foot_z * figure.foot()),
            ),
            chin: figure.y(level::CHIN),
            small: figure.small(),
            head_size: figure.head(),
            foot_size: figure.foot(),
            fine: figure.fine(),
            flat: child.mixed(0.0, SUNK),
            arm_from: child.mixed(0.06, 0.06 * figure.small()),
        }
    }

    /// Approximate signed distance to the skin, metres.
    pub fn value(&self, p: DVec3) -> f64 {
        let p = DVec3::new(p.x.abs(), p.y, p.z);
        let mut d = self.trunk.distance(p.y, p.x.hypot(CLEFT * self.fine), p.z);
        if p.y > self.chin - 0.60 * self.small {
            d = blended(d, self.breast(p) + self.flat, 0.075 * self.fine);
        }
        if p.x > self.arm_from {
            d = blended(d, self.arm(p), 0.046 * self.fine);
        }
        if p.y < 0.20 {
            d = blended(d, self.foot(p), 0.035 * self.fine);
        }
        let q = DVec3::new(p.x, p.y - self.chin, p.z) / self.head_size + DVec3::new(0.0, level::CHIN, 0.0);
        if q.y > level::CHIN - 0.08 {
            let head = self.head.distance(q.y, q.x, q.z) - swellings(&self.face, q);
            d = blended(d, head * self.head_size, 0.030 * self.fine);
        }
        d - swellings(&self.modelling, p)
    }

    /// Value and gradient at `p`, both from the same four samples round it.
    fn value_and_gradient(&self, p: DVec3) -> (f64, DVec3) {
        const H: f64 = 2e-4;
        const CORNERS: [DVec3; 4] = [
            DVec3::new(1.0, -1.0, -1.0),
            DVec3::new(-1.0, -1.0, 1.0),
            DVec3::new(-1.0, 1.0, -1.0),
            DVec3::new(1.0, 1.0, 1.0),
        ];
        let samples = CORNERS.map(|c| self.value(p + c * H));
        let gradient = CORNERS.iter().zip(samples).map(|(&c, f)| c * f).sum::<DVec3>() / (4.0 * H);
        (samples.iter().sum::<f64>() / 4.0, gradient)
    }

    /// Projects `p`, which must be near the skin, on to it in `steps` Newton steps along the gradient.
    pub fn onto_skin(&self, p: DVec3, steps: usize) -> DVec3 {
        (0..steps).fold(p, |p, _| {
            let (value, gradient) = self.value_and_gradient(p);
            let step = gradient * (value / gradient.length_squared().max(0.05));
            p - step.clamp_length_max(0.01)
        })
    }

    /// Distance, metres, at which the ray from `origin` (inside) along the unit `direction` first leaves the skin.
    pub fn exit(&self, origin: DVec3, direction: DVec3) -> f64 {
        let at = |t: f64| self.value(origin + direction * t);
        let mut t = 0.0;
        let mut d = at(t);
        while d < 0.0 && t < 1.0 {
            t += (-0.7 * d).max(0.002);
            d = at(t);
        }
        let (mut low, mut high) = ((t - 0.2).max(0.0), t);
        // The last step was at most 0.7 of a distance or 2 mm: bisect over it.
        for _ in 0..24 {
            let middle = (low + high) / 2.0;
            if at(middle) < 0.0 { low = middle } else { high = middle }
        }
        (low + high) / 2.0
    }

    /// Centre of the left leg at height `y`, or above the crotch of the left half of the trunk.
    pub fn leg_centre(&self, y: f64) -> DVec3 {
        let [x, z] = self.trunk.centre(y);
        DVec3::new(x, y, z)
    }

    /// Centre of the left arm `s` metres from the shoulder joint.
    pub fn arm_centre(&self, s: f64) -> DVec3 {
        let [outward, forward] = self.arm.centre(s);
        self.joint + self.along * s + self.outward * outward + DVec3::Z * forward
    }

    fn breast(&self, p: DVec3) -> f64 {
        let d = p - self.breast_centre;
        let [x, up, down, z] = self.breast_axes;
        let y = if d.y > 0.0 { up } else { down };
        ellipsoid(d, DVec3::new(x, y, z))
    }

    fn arm(&self, p: DVec3) -> f64 {
        let q = p - self.joint;
        let local = DVec3::new(q.dot(self.along), q.dot(self.outward), q.z);
        let arm = self.arm.distance(local.x, local.y, local.z);
        self.hand.with(arm, local)
    }

    fn foot(&self, p: DVec3) -> f64 {
        let q = (p - self.foot_origin) / self.foot_size;
        let (sin, cos) = nominal::FOOT_TURN.sin_cos();
        let (s, u) = (q.z * cos + q.x * sin, q.x * cos - q.z * sin);
        // The sole is cut flat a little above the lowest point of the sections.
        cut(self.foot.distance(s, u, q.y), -q.y, 0.008) * self.foot_size
    }
}

/// First-order approximation of the signed distance to an ellipsoid about the origin.
fn ellipsoid(p: DVec3, axes: DVec3) -> f64 {
    let k0 = (p / axes).length();
    let k1 = (p / (axes * axes)).length();
    if k1 < 1e-9 { -axes.min_element() } else { k0 * (k0 - 1.0) / k1 }
}

fn swellings(all: &[Swelling], p: DVec3) -> f64 {
    all.iter()
        .map(|s| {
            let q = ((p - DVec3::from(s.centre)) / DVec3::from(s.reach)).length_squared();
            if q > 12.0 { 0.0 } else { s.height * (-q).exp() }
        })
        .sum()
}

/// A feature of the face: flatter and lower down on a child's.
fn of_face(s: &Swelling, figure: &Figure) -> Swelling {
    let child = figure.factors.child;
    let [x, y, z] = s.centre;
    let low = level::CHIN + SMALL_FACE_AT * (y - level::CHIN);
    Swelling { centre: [x, child.mixed(y, low), z], height: s.height * child.mixed(1.0, SMALL_FACE), ..*s }
}

fn carried(s: &Swelling, figure: &Figure) -> Swelling {
    let fine = figure.fine();
    let height = s.height * fine * figure.factors.child.mixed(1.0, SMALL_MODELLING);
    Swelling { centre: figure.point(s.centre).into(), reach: s.reach.map(|r| r * fine), height }
}

fn trunk(figure: &Figure) -> Loft {
    let sections: Vec<Section> = nominal::TRUNK
        .iter()
        .map(|&[y, inner, outer, centre, z, front, back, exponent]| {
            let (width, depth) = (figure.width(y), figure.depth(y));
            // The gap between the legs stays: thicker legs are further out.
            let new_inner = if inner > 0.0 { inner * figure.gap() } else { inner * width };
            let new_centre = new_inner + (centre - inner) * width;
            Section {
                at: figure.y(y),
                centre: [new_centre, z * depth],
                u: [(centre - inner) * width, (outer - centre) * width],
                v: [back * depth, front * depth],
                exponent,
            }
        })
        .collect();
    Loft::new(&sections, [0.02, 0.05].map(|cap| cap * figure.fine()))
}

fn arm(figure: &Figure) -> Loft {
    let f = &figure.factors;
    let sections: Vec<Section> = nominal::ARM
        .iter()
        .map(|&[s, outward, forward, inner, outer, back, front, exponent]| {
            let k = figure.arm_thickness(s);
            Section {
                at: figure.along_arm(s),
                centre: [outward * f.arm_length, forward * f.arm_length],
                u: [inner * k, outer * k],
                v: [back * k, front * k],
                exponent,
            }
        })
        .collect();
    Loft::new(&sections, [0.045, 0.010].map(|cap| cap * figure.fine()))
}

fn foot() -> Loft {
    let sections: Vec<Section> = nominal::FOOT
        .iter()
        .map(|&[s, centre, inner, outer, widest, top, exponent]| Section {
            at: s,
            centre: [centre, widest],
            u: [inner, outer],
            v: [widest + 0.006, top - widest],
            exponent,
        })
        .collect();
    Loft::new(&sections, [0.030, 0.042])
}

fn head(figure: &Figure) -> Loft {
    let sections: Vec<Section> = nominal::HEAD
        .iter()
        .zip(SMALL_CHEEKS)
        .map(|(&[y, half_width, z, front, back, exponent], cheeks)| Section {
            at: y,
            centre: [0.0, z],
            u: [half_width * figure.factors.child.mixed(1.0, cheeks); 2],
            v: [back, front],
            exponent,
        })
        .collect();
    Loft::new(&sections, [0.022, level::CROWN - nominal::HEAD[nominal::HEAD.len() - 1][0]])
}
