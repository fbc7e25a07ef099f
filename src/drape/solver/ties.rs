//! Constraints of small steps that hold points of the cloth together: sewing springs, and fastened buttons.

use glam::DVec3;

/// Largest speed at which sewing springs, buttons and elastic draw cloth together, m/s: a gap that cloth and body hold open against
/// that stays open.
pub const THREAD_SPEED: f64 = 2.0;

/// Sewing spring: a distance constraint between two vertices that only pulls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SewingSpring {
    /// The vertices.
    pub ends: [u32; 2],
    /// Length beyond which it pulls, metres.
    pub length: f64,
    /// Waypoint over which it runs, metres; None: straight.
    pub over: Option<DVec3>,
}

impl SewingSpring {
    /// Projects the spring in a small step of `small` seconds if its ends are at most `within` metres apart. `inverse_mass` in
    /// 1/kg.
    pub fn draw(&self, x: &mut [DVec3], inverse_mass: &[f64], within: f64, small: f64) {
        let [a, b] = self.ends.map(|v| v as usize);
        let (from_a, from_b, distance) = match self.over {
            Some(place) => (place - x[a], place - x[b], place.distance(x[a]) + place.distance(x[b])),
            None => (x[b] - x[a], x[a] - x[b], x[a].distance(x[b])),
        };
        let (long, [wa, wb]) = (distance - self.length, [a, b].map(|v| inverse_mass[v]));
        if long > 0.0 && distance <= within && wa + wb > 0.0 {
            let pull = long.min(THREAD_SPEED * small) / (wa + wb);
            x[a] += from_a.normalize_or_zero() * (pull * wa);
            x[b] += from_b.normalize_or_zero() * (pull * wb);
        }
    }
}

/// Height above the button from which a buttonhole comes down on it, as a share of its distance: cloth that overlaps comes to lie
/// over the other, and the edges do not butt.
const STEEP: f64 = 0.7;
/// Largest such height, metres: cloth laps over buttons by less.
const HIGHEST: f64 = 0.04;

/// A fastened button: a constraint that draws two points of the cloth together, the buttonhole from the front of the button's cloth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fastened {
    /// The button and its hole: the three vertices of a triangle each, with weights that sum to one.
    pub ends: [[(u32, f64); 3]; 2],
    /// Length beyond which it pulls, metres.
    pub length: f64,
}

impl Fastened {
    /// Distance of the two points with the cloth at `x`, metres.
    pub fn gap(&self, x: &[DVec3]) -> f64 {
        let [a, b] = self.ends.map(|end| point(&end, x));
        a.distance(b)
    }

    /// Projects the constraint in a small step of `small` seconds; `inverse_mass` in 1/kg.
    pub fn draw(&self, x: &mut [DVec3], inverse_mass: &[f64], small: f64) {
        let [button, hole] = self.ends.map(|end| point(&end, x));
        let over = button.distance(hole) - self.length;
        let yields: f64 =
            self.ends.iter().flatten().map(|&(v, share)| inverse_mass[v as usize] * share * share).sum();
        if over <= 0.0 || yields <= 0.0 {
            return;
        }
        let [p, q, r] = self.ends[0].map(|(v, _)| x[v as usize]);
        let front = (q - p).cross(r - p).normalize_or_zero();
        let apart = hole - (button + front * (over * STEEP).min(HIGHEST));
        let (way, far) = (apart.normalize_or_zero(), apart.length());
        let long = over.min(far).min(THREAD_SPEED * small);
        for (end, sign) in self.ends.iter().zip([1.0, -1.0]) {
            for &(v, share) in end {
                x[v as usize] += way * (sign * long / yields * inverse_mass[v as usize] * share);
            }
        }
    }
}

fn point(end: &[(u32, f64); 3], x: &[DVec3]) -> DVec3 {
    end.iter().map(|&(v, share)| x[v as usize] * share).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_button_draws_two_points_together_and_keeps_momentum() {
        let ends = [[(0, 0.5), (1, 0.3), (2, 0.2)], [(3, 0.1), (4, 0.1), (5, 0.8)]];
        let tie = Fastened { ends, length: 0.001 };
        let mass = [1.0, 2.0, 3.0, 1.0, 2.0, 4.0];
        let inverse: Vec<f64> = mass.iter().map(|m| 1.0 / m).collect();
        let mut x: Vec<DVec3> =
            (0..6).map(|v| DVec3::new(f64::from(v % 3), f64::from(v / 3), 0.1) * 0.02).collect();
        let sum = |x: &[DVec3]| x.iter().zip(mass).map(|(x, m)| *x * m).sum::<DVec3>();
        let before = sum(&x);
        for _ in 0..3 {
            tie.draw(&mut x, &inverse, 0.1);
        }
        assert!((tie.gap(&x) - 0.001).abs() < 1e-12, "{}", tie.gap(&x));
        assert!(sum(&x).distance(before) < 1e-12);
        let rest = x.clone();
        tie.draw(&mut x, &inverse, 0.1);
        assert!(x.iter().zip(&rest).all(|(a, b)| a.distance(*b) < 1e-12), "it only pulls");
    }
}
