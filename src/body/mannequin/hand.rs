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

/// Rounding errors of distances, metres.
const SLACK: f64 = 1e-9;

/// The fingers of the left hand, in the arm's frame: length along the arm, outward, forward.
#[derive(Clone, Debug)]
pub struct Hand {
    fingers: [Finger; nominal::FINGERS.len()],
    starts_at: f64,
    /// Factor on the fillets.
    fine: f64,
}

/// A finger, in a ball.
#[derive(Clone, Debug)]
struct Finger {
    /// Its joints, and their radii.
    joints: [(DVec3, f64); 4],
    middle: DVec3,
    radius: f64,
}

impl Finger {
    fn new(joints: [(DVec3, f64); 4]) -> Self {
        let middle = joints.iter().map(|(p, _)| *p).sum::<DVec3>() / 4.0;
        let radius = joints.iter().map(|(p, radius)| p.distance(middle) + radius).fold(0.0, f64::max);
        Self { joints, middle, radius }
    }

    /// Signed distance at `p`, metres; `fine` is the factor on the fillets.
    fn distance(&self, p: DVec3, fine: f64) -> f64 {
        let bones = self.joints.windows(2).map(|w| tapered(p, w[0], w[1]));
        bones.fold(f64::INFINITY, |a, b| joined(a, b, KNUCKLE * fine))
    }

    /// What that is at least: a fillet is no deeper than a sixth of its width, and there are two.
    fn least(&self, p: DVec3, fine: f64) -> f64 {
        p.distance(self.middle) - self.radius - KNUCKLE * fine / 3.0
    }
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
        let fingers = nominal::FINGERS.map(|chain| {
            Finger::new(chain.map(|[s, u, v, radius]| {
                let bent = DVec3::new(0.0, beyond(&outward, s), beyond(&forward, s)) * k
                    + DVec3::new(0.0, u, v) * scale;
                (DVec3::new(figure.along_arm(s), bent.y, bent.z), radius * scale)
            }))
        });
        Self { fingers, starts_at: figure.along_arm(0.54), fine: figure.fine() }
    }

    /// Signed distance at `p` (in the arm's frame) to the arm with its fingers; `arm` is the distance to the arm alone.
    pub fn with(&self, arm: f64, p: DVec3) -> f64 {
        if p.x < self.starts_at {
            return arm;
        }
        let fine = self.fine;
        // Shapes that are farther apart than their fillet is wide are joined without it: a far finger changes nothing.
        let webs = self.fingers.len() as f64 * WEB * fine / 6.0;
        let least = self.fingers.each_ref().map(|finger| finger.least(p, fine));
        if least.into_iter().fold(f64::INFINITY, f64::min) - webs > arm + PALM * fine + SLACK {
            return arm;
        }
        let fingers = self.fingers.iter().zip(least).fold(f64::INFINITY, |d, (finger, least)| {
            let is_far = least > d + WEB * fine + SLACK;
            if is_far { d } else { joined(d, finger.distance(p, fine), WEB * fine) }
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::mannequin::Measurements;
    use crate::body::mannequin::figure::Factors;
    use crate::geometry::random::Random;

    /// The distance with nothing left out.
    fn plain(hand: &Hand, arm: f64, p: DVec3) -> f64 {
        let fingers = hand.fingers.iter();
        let all = fingers
            .fold(f64::INFINITY, |d, finger| joined(d, finger.distance(p, hand.fine), WEB * hand.fine));
        blended(arm, all, PALM * hand.fine)
    }

    #[test]
    fn far_fingers_are_left_out_without_a_trace() {
        let hand = Hand::new(&Figure::new(Factors::guess(&Measurements::default())));
        let mut random = Random::stream(9, 0);
        let mut plainly = 0;
        for _ in 0..20_000 {
            let mut between = |low: f64, high: f64| random.between(low, high);
            let p =
                DVec3::new(hand.starts_at + between(0.0, 0.3), between(-0.15, 0.15), between(-0.15, 0.15));
            let arm = between(-0.05, 0.15);
            assert_eq!(hand.with(arm, p), plain(&hand, arm, p), "{p} {arm}");
            plainly += usize::from(hand.with(arm, p) == arm);
        }
        assert!(plainly > 2000, "{plainly}");
    }
}
