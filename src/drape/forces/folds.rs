//! Fold lines: hinges along edges with an angle at rest, ½ k (θ - θ₀)².
//!
//! Across a crease the cloth has no other bending: the sheet is cut there ([`Sheet::creased`]), so that at rest without loads a
//! hinge has exactly its angle. Gradients of the angle after Bridson et al. 2003.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec3};

use crate::drape::sheet::Sheet;

/// Damping of hinges in small steps, as stiffness-proportional damping, s: the swing of a pressed flap dies after a few tenths of
/// a second.
const DAMPING: f64 = 0.05;
/// Largest speed at which a hinge is turned in small steps, rad/s. Chosen by trial; it bounds the push at a fold that is far from
/// its angle.
const FASTEST: f64 = 15.0;

/// An edge between two triangles that is turned to an angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hinge {
    /// Start and end of the edge, in the direction in which its first triangle traverses it; the corner of that triangle opposite
    /// to the edge; that of the other triangle.
    pub vertices: [u32; 4],
    /// Angle at rest, radians, -π..=π; positive where the fronts of the two triangles turn towards each other.
    pub angle: f64,
    /// Moment per radian, N·m.
    pub stiffness: f64,
}

/// The hinges of a sheet.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Folds {
    hinges: Vec<Hinge>,
}

impl Folds {
    /// Hinges along edges of `sheet`, each given by its ends, its angle (radians) and its strength (N, moment per length and
    /// radian). Edges that are not between two triangles of the sheet are left out; of several at one edge the first counts.
    pub fn new(sheet: &Sheet, edges: impl IntoIterator<Item = ([u32; 2], f64, f64)>) -> Self {
        let mut hinges: Vec<Hinge> = Vec::new();
        let mut known = std::collections::BTreeSet::new();
        for (ends, angle, strength) in edges {
            let Some(e) = sheet.edge_between(ends) else { continue };
            if let Some(vertices) = sheet.adjacency.hinge(&sheet.triangles, e).filter(|_| known.insert(e)) {
                let stiffness = strength * sheet.rest_length(e as usize);
                hinges.push(Hinge { vertices, angle, stiffness });
            }
        }
        Self { hinges }
    }

    /// Those that are nearer to their angle than to flat with the cloth at `x`.
    pub fn folded(mut self, x: &[DVec3]) -> Self {
        let is_folded = |hinge: &Hinge| {
            let now = hinge.angle_at(x).unwrap_or(0.0);
            hinge.off(now).abs() < now.abs()
        };
        self.hinges.retain(is_folded);
        self
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.hinges.is_empty()
    }

    /// The hinges.
    pub fn hinges(&self) -> &[Hinge] {
        &self.hinges
    }

    /// Adds the gradient, N, and gives the energy, J.
    pub fn add_gradient(&self, x: &[DVec3], gradient: &mut [DVec3]) -> f64 {
        let mut energy = 0.0;
        for hinge in &self.hinges {
            let Some((angle, slopes)) = hinge.turned(x) else { continue };
            let off = hinge.off(angle);
            energy += hinge.stiffness * off * off / 2.0;
            for (&v, slope) in hinge.vertices.iter().zip(slopes) {
                gradient[v as usize] += slope * (hinge.stiffness * off);
            }
        }
        energy
    }

    /// Hessian blocks of two vertices, N/m, the first not less than the second; without the curvature of the angle, so that they are
    /// positive semidefinite.
    pub fn hessian(&self, x: &[DVec3], mut block: impl FnMut([u32; 2], DMat3)) {
        for hinge in &self.hinges {
            let Some((_, slopes)) = hinge.turned(x) else { continue };
            for (&i, a) in hinge.vertices.iter().zip(slopes) {
                for (&j, b) in hinge.vertices.iter().zip(slopes).filter(|&(&j, _)| j <= i) {
                    let b = b * hinge.stiffness;
                    block([i, j], DMat3::from_cols(a * b.x, a * b.y, a * b.z));
                }
            }
        }
    }

    /// Pairs of vertices with a block in the Hessian.
    pub fn pairs(&self) -> impl Iterator<Item = [u32; 2]> {
        let of = |hinge: &Hinge| {
            let [a, b, c, d] = hinge.vertices;
            [[a, b], [a, c], [a, d], [b, c], [b, d], [c, d]]
        };
        self.hinges.iter().flat_map(of)
    }

    /// Projects every hinge towards its angle in a small step of `small` seconds (XPBD), from the positions `before` it: once in
    /// order and once in reverse, each time with half of stiffness and damping. Damping in one order alone is not symmetric, and
    /// drives explicit bending near its limit of stability: a strip went on swinging by ten degrees. `inverse_mass` in 1/kg.
    pub fn project(&self, x: &mut [DVec3], before: &[DVec3], inverse_mass: &[f64], small: f64) {
        for hinge in self.hinges.iter().chain(self.hinges.iter().rev()) {
            let Some((angle, slopes)) = hinge.turned(x) else { continue };
            let off = hinge.off(angle);
            let (mut give, mut turning) = (0.0, 0.0);
            for (&v, slope) in hinge.vertices.iter().zip(slopes) {
                give += inverse_mass[v as usize] * slope.length_squared();
                turning += slope.dot(x[v as usize] - before[v as usize]);
            }
            let softness = 2.0 / (hinge.stiffness * small * small);
            let lag = DAMPING / small;
            // Against damping a moment turns at a speed: to limit the push itself would leave kicks of the bending undamped.
            let off = off.clamp(-FASTEST * DAMPING, FASTEST * DAMPING);
            let push = -(off + lag * turning) / ((1.0 + lag) * give + softness);
            for (&v, slope) in hinge.vertices.iter().zip(slopes) {
                x[v as usize] += slope * (push * inverse_mass[v as usize]);
            }
        }
    }
}

impl Hinge {
    /// The angle with the cloth at `x`, radians, -π..=π; None where a triangle has no area.
    pub fn angle_at(&self, x: &[DVec3]) -> Option<f64> {
        self.turned(x).map(|(angle, _)| angle)
    }

    /// How far `angle` is from rest, radians. Across π only where that is much nearer: cloth that is folded double may be a little
    /// past it.
    fn off(&self, angle: f64) -> f64 {
        let off = angle - self.angle;
        match off.abs() > 1.5 * PI {
            true => off - TAU.copysign(off),
            false => off,
        }
    }

    /// The angle and its gradient in each of the four vertices, 1/m.
    fn turned(&self, x: &[DVec3]) -> Option<(f64, [DVec3; 4])> {
        let [a, b, c, d] = self.vertices.map(|v| x[v as usize]);
        let edge = b - a;
        let squared = edge.length_squared();
        let (first, second) = (edge.cross(c - a), (d - a).cross(edge));
        let (one, other) = (first.length_squared(), second.length_squared());
        // A triangle with less area has no normal.
        let least = 1e-12 * squared * squared;
        if one <= least || other <= least || squared == 0.0 {
            return None;
        }
        let length = squared.sqrt();
        let angle = second.cross(first).dot(edge / length).atan2(first.dot(second));
        let (at_c, at_d) = (first * (length / one), second * (length / other));
        let (s, t) = ((c - a).dot(edge) / squared, (d - a).dot(edge) / squared);
        let at_a = -(at_c * (1.0 - s) + at_d * (1.0 - t));
        Some((angle, [at_a, -(at_c * s + at_d * t), at_c, at_d]))
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;

    fn two() -> Sheet {
        let p = [(0.0, 0.0), (0.0, 0.02), (-0.02, 0.012), (0.017, 0.005)].map(DVec2::from);
        let triangles = vec![[0, 1, 2], [1, 0, 3]];
        let rest = triangles.iter().map(|vs| vs.map(|v: u32| p[v as usize])).collect();
        Sheet::new(4, triangles, rest).expect("a sheet")
    }

    fn raised(angle: f64) -> Vec<DVec3> {
        let up = 0.017 * angle.sin();
        vec![
            DVec3::ZERO,
            DVec3::Y * 0.02,
            DVec3::new(-0.02, 0.012, 0.0),
            DVec3::new(0.017 * angle.cos(), 0.005, up),
        ]
    }

    #[test]
    fn an_angle_is_positive_towards_the_front_and_its_gradient_is_that_of_differences() {
        let folds = Folds::new(&two(), [([1, 0], 0.4, 0.02)]);
        for angle in [-3.0f64, -1.0, 0.0, 0.3, 2.0, 3.1] {
            let hinge = folds.hinges()[0];
            let x = raised(angle);
            let (found, slopes) = hinge.turned(&x).expect("it has area");
            assert!((found - angle).abs() < 1e-12, "{found} is not {angle}");
            for (k, way) in (0..4).flat_map(|k| DVec3::AXES.map(|way| (k, way))) {
                let at = |by: f64| {
                    let mut moved = x.clone();
                    moved[hinge.vertices[k] as usize] += way * by;
                    hinge.turned(&moved).expect("it has area").0
                };
                let slope = (at(1e-7) - at(-1e-7)) / 2e-7;
                assert!((slope - slopes[k].dot(way)).abs() < 1e-4, "{slope} is not {}", slopes[k].dot(way));
            }
        }
    }

    #[test]
    fn what_is_folded_double_does_not_open_the_wrong_way() {
        let hinge = Folds::new(&two(), [([0, 1], PI, 0.02)]).hinges()[0];
        assert!(hinge.off(3.1) < 0.0, "it closes");
        assert!(hinge.off(-3.1) > 0.0, "it goes back to just below π");
        assert!(hinge.off(-0.1) < 0.0, "it opens through flat");
    }
}
