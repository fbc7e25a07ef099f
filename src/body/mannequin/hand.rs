//! Fingers and thumb, grown out of the palm that ends the arm.

use glam::DVec3;

use super::field::blended;
use super::figure::Figure;
use super::proportions as nominal;
use super::spline::Spline;

/// Fillets between a finger and the palm, and between two fingers, metres.
const KNUCKLE: f64 = 0.011;

/// The fingers of the left hand, in the arm's frame: length along the arm, outward, forward.
#[derive(Clone, Debug)]
pub struct Hand {
    joints: Vec<[(DVec3, f64); 4]>,
    starts_at: f64,
}

impl Hand {
    /// For `figure`.
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
        let scale = figure.small();
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
        Self { joints, starts_at: figure.along_arm(0.54) }
    }

    /// The arm's distance `arm` at `p` (arm's frame), with the fingers joined to it.
    pub fn with(&self, arm: f64, p: DVec3) -> f64 {
        if p.x < self.starts_at {
            return arm;
        }
        self.joints.iter().fold(arm, |d, chain| {
            let finger = chain
                .windows(2)
                .map(|w| tapered(p, w[0], w[1]))
                .fold(f64::INFINITY, |a, b| if a.is_finite() { blended(a, b, 0.005) } else { b });
            blended(d, finger, KNUCKLE * reach_of_web(p.x - self.starts_at))
        })
    }
}

/// The fillet shrinks towards the finger tips, so that neighbouring fingers stay apart.
fn reach_of_web(s: f64) -> f64 {
    (1.0 - (s - 0.09) / 0.05).clamp(0.25, 1.0)
}

fn tapered(p: DVec3, (a, ra): (DVec3, f64), (b, rb): (DVec3, f64)) -> f64 {
    let ab = b - a;
    let t = ((p - a).dot(ab) / ab.length_squared()).clamp(0.0, 1.0);
    (p - a - ab * t).length() - (ra + (rb - ra) * t)
}
