//! Fingers and thumb, joined to the palm at the end of the arm.

use glam::DVec3;

use super::figure::Figure;
use super::proportions as nominal;
use super::smooth::blended;
use super::spline::Spline;

/// Fillet width between fingers and palm, metres.
const PALM: f64 = 0.011;
/// Fillet width between the bones of a finger, metres.
const KNUCKLE: f64 = 0.005;
/// Fillet width between two fingers, metres: small, so that they stay apart.
const WEB: f64 = 0.003;

/// The fingers of the left hand, in the arm's frame: length along the arm, outward, forward.
#[derive(Clone, Debug)]
pub struct Hand {
    joints: Vec<[(DVec3, f64); 4]>,
    starts_at: f64,
    /// Factor on the fillets.
    fine: f64,
}

impl Hand {
    /// The fingers of `figure`.
    pub fn new(figure: &Figure) -> Self {
        let bend = |column: usize| Spline::new(nominal::ARM.iter().map(|row| (row[0], row[column])));
        let (outward, forward) = (bend(1), bend(2));
        let k = figure.factors.arm_length;
        // Beyond the last section the arm's bend goes on in a straight line.
        let beyond = |spline: &Spline, s: f64| {
            let last = nominal::ARM[nominal::ARM.len() - 1][0];
            let slope = (spline.value(last) - spline.value(last - 0.03)) / 0.03;
            spline.value(s) + slope * (s - last).max(0.0)
        };
        let scale = figure.hand();
        let joints = nominal::FINGERS
            .iter()
            .map(|chain| {
                chain.map(|[s, u, v, radius]| {
                    let bent = DVec3::new(0.0, beyond(&outward, s), beyond(&forward, s)) * k
                        + DVec3::new(0.0, u, v) * scale;
                    (DVec3::new(figure.along_arm(s), bent.y, bent.z), radius * scale)
                })
            })
            .collect();
        Self { joints, starts_at: figure.along_arm(0.54), fine: figure.fine() }
    }

    /// Signed distance at `p` (in the arm's frame) to the arm with its fingers; `arm` is the distance to the arm alone.
    pub fn with(&self, arm: f64, p: DVec3) -> f64 {
        if p.x < self.starts_at {
            return arm;
        }
        let fine = self.fine;
        let fingers = self.joints.iter().fold(f64::INFINITY, |d, chain| {
            let bones = chain.windows(2).map(|w| tapered(p, w[0], w[1]));
            joined(d, bones.fold(f64::INFINITY, |a, b| joined(a, b, KNUCKLE * fine)), WEB * fine)
        });
        blended(arm, fingers, PALM * fine)
    }
}

/// `blended`, where an infinite `a` stands for an empty shape.
fn joined(a: f64, b: f64, k: f64) -> f64 {
    if a.is_finite() { blended(a, b, k) } else { b }
}

fn tapered(p: DVec3, (a, ra): (DVec3, f64), (b, rb): (DVec3, f64)) -> f64 {
    let ab = b - a;
    let t = ((p - a).dot(ab) / ab.length_squared()).clamp(0.0, 1.0);
    (p - a - ab * t).length() - (ra + (rb - ra) * t)
}
