//! What cloth is made of, as the physics sees it.

use std::sync::LazyLock;

use glam::DVec3;
use serde::{Deserialize, Serialize};

/// The presets, with the source of each figure.
const PRESETS: &str = include_str!("../../assets/fabrics/presets.json");

/// A fabric: an orthotropic plate, thin beside its extent. Forces are per metre of width, so that thickness plays no part in
/// them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fabric {
    /// For people.
    #[serde(default)]
    pub name: String,
    /// Resistance to stretching, N/m.
    pub stretch: Stretch,
    /// Resistance to bending, N·m.
    pub bending: Bending,
    /// Mass per area, kg/m².
    pub density_kg_per_m2: f64,
    /// How far from its middle to whatever it touches, metres: it is kept so far from a body, and from itself.
    pub thickness_m: f64,
    /// Coulomb's coefficient against bodies and cloth.
    pub friction: f64,
    /// Rate at which free motion through the air dies away, 1/s.
    #[serde(default)]
    pub damping_per_s: f64,
    /// Where the figures are from.
    #[serde(default)]
    pub source: String,
}

/// Membrane stiffness: force per metre of width and unit of strain.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stretch {
    /// Pulled along the warp with free sides, N/m.
    pub warp: f64,
    /// Pulled along the weft with free sides, N/m.
    pub weft: f64,
    /// Sheared, N/m.
    pub shear: f64,
    /// How much narrower it becomes than longer, -1..1; for unlike directions the geometric mean of the two.
    pub poisson: f64,
}

/// Plate stiffness: moment per metre of width and unit of curvature, other curvatures held at zero.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bending {
    /// Curved along the warp, N·m.
    pub warp: f64,
    /// Curved along the bias at 45°, N·m.
    pub bias: f64,
    /// Curved along the weft, N·m.
    pub weft: f64,
    /// The ratio of moments across and along a cylinder, -1..1.
    #[serde(default)]
    pub poisson: f64,
}

impl Fabric {
    /// The preset that cloth is made of when nothing else was chosen.
    pub const USUAL: &str = "cotton";

    /// Alike in all directions: Young's modulus times thickness in N/m, Poisson's ratio, plate stiffness in N·m, kg/m².
    pub fn isotropic(stiffness: f64, poisson: f64, bending: f64, density_kg_per_m2: f64) -> Self {
        Self {
            name: String::new(),
            stretch: Stretch {
                warp: stiffness,
                weft: stiffness,
                shear: stiffness / (2.0 * (1.0 + poisson)),
                poisson,
            },
            bending: Bending { warp: bending, bias: bending, weft: bending, poisson },
            density_kg_per_m2,
            thickness_m: 1e-3,
            friction: 0.3,
            damping_per_s: 0.0,
            source: String::new(),
        }
    }

    /// All presets, in the order of the file.
    pub fn presets() -> &'static [Self] {
        static ALL: LazyLock<Vec<Fabric>> =
            LazyLock::new(|| serde_json::from_str(PRESETS).unwrap_or_default());
        &ALL
    }

    /// The preset called `name`.
    pub fn preset(name: &str) -> Option<&'static Self> {
        Self::presets().iter().find(|f| f.name == name)
    }

    /// What no cloth can be, in words.
    pub fn problem(&self) -> Option<String> {
        let Self {
            name: _,
            stretch,
            bending,
            density_kg_per_m2,
            thickness_m,
            friction,
            damping_per_s,
            source: _,
        } = self;
        let Stretch { warp, weft, shear, poisson } = *stretch;
        let outside = |what: &str, value: f64, least: f64, most: f64| {
            (!(least..=most).contains(&value))
                .then(|| format!("{what} is {value}, not within {least}..{most}"))
        };
        outside("stretch warp", warp, 0.1, 1e9)
            .or_else(|| outside("stretch weft", weft, 0.1, 1e9))
            .or_else(|| outside("stretch shear", shear, 0.01, 1e9))
            .or_else(|| outside("stretch poisson", poisson, -0.95, 0.95))
            .or_else(|| outside("bending warp", bending.warp, 0.0, 1e6))
            .or_else(|| outside("bending weft", bending.weft, 0.0, 1e6))
            .or_else(|| outside("bending bias", bending.bias, 0.0, 1e6))
            .or_else(|| outside("bending poisson", bending.poisson, -0.95, 0.95))
            .or_else(|| outside("density_kg_per_m2", *density_kg_per_m2, 1e-4, 1e3))
            .or_else(|| outside("thickness_m", *thickness_m, 0.0, 0.1))
            .or_else(|| outside("friction", *friction, 0.0, 10.0))
            .or_else(|| outside("damping_per_s", *damping_per_s, 0.0, 1e3))
            .or_else(|| {
                (bending.twist() < 0.0).then(|| "bending bias is too small beside warp and weft".to_owned())
            })
    }
}

impl Stretch {
    /// C11, C22, C12 and shear stiffness in N/m: stress (s11, s22, s12) of Green strain (e11, e22, 2 e12).
    pub fn tangent(&self) -> [f64; 4] {
        let side = 1.0 - self.poisson * self.poisson;
        let (c11, c22) = (self.warp / side, self.weft / side);
        [c11, c22, self.poisson * (c11 * c22).sqrt(), self.shear]
    }
}

/// The tangent (as [`Stretch::tangent`] gives it) of cloth that wrinkles along its threads where they would be pressed, at the
/// strain (e11, e22, 2 e12): of the relaxed energy min over a, b ≥ 0 of W(e11 + a, e22 + b), which is convex and once
/// differentiable (after Pipkin 1986, with wrinkles across warp and weft only, so that the minimum has a closed form).
pub fn wrinkled(tangent: [f64; 4], e: [f64; 3]) -> [f64; 4] {
    let [c11, c22, c12, shear] = tangent;
    let (warp, weft) = (c11 * e[0] + c12 * e[1], c12 * e[0] + c22 * e[1]);
    let alone = |c: f64, other: f64| c - c12 * c12 / other;
    if warp >= 0.0 && weft >= 0.0 {
        tangent
    } else if e[0] > 0.0 && weft < 0.0 {
        [alone(c11, c22), 0.0, 0.0, shear]
    } else if e[1] > 0.0 && warp < 0.0 {
        [0.0, alone(c22, c11), 0.0, shear]
    } else {
        [0.0, 0.0, 0.0, shear]
    }
}

/// Stress (s11, s22, s12), N/m, of Green strain (e11, e22, 2 e12) under a tangent C11, C22, C12 and shear.
pub fn stress([c11, c22, c12, shear]: [f64; 4], e: [f64; 3]) -> [f64; 3] {
    [c11 * e[0] + c12 * e[1], c12 * e[0] + c22 * e[1], shear * e[2]]
}

/// Green strain (e11, e22, 2 e12) where the unit vectors along warp and weft have become `f0` and `f1`.
pub fn green([f0, f1]: [DVec3; 2]) -> [f64; 3] {
    [(f0.length_squared() - 1.0) / 2.0, (f1.length_squared() - 1.0) / 2.0, f0.dot(f1)]
}

impl Bending {
    /// The moment that goes with 2 k12, N·m: from curvature along the bias, which is k11 = k22 = k12.
    pub fn twist(&self) -> f64 {
        self.bias - (self.warp + self.weft + 2.0 * self.cross()) / 4.0
    }

    /// The moment along one direction that curvature along the other gives, N·m.
    pub fn cross(&self) -> f64 {
        self.poisson * (self.warp * self.weft).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presets_are_sound_and_named_once() {
        let all: Vec<Fabric> = serde_json::from_str(PRESETS).expect("the presets");
        assert!(all.len() >= 8);
        for fabric in &all {
            assert_eq!(fabric.problem(), None, "{}", fabric.name);
            assert!(!fabric.source.is_empty(), "{}", fabric.name);
            assert_eq!(Fabric::preset(&fabric.name), Some(fabric));
        }
    }

    #[test]
    fn an_isotropic_fabric_is_alike_along_the_bias() {
        let fabric = Fabric::isotropic(1000.0, 0.3, 1e-5, 0.2);
        assert_eq!(fabric.problem(), None);
        assert!((fabric.bending.twist() - 0.35e-5).abs() < 1e-18);
        let [c11, c22, c12, g] = fabric.stretch.tangent();
        assert!((c11 - c12 * c12 / c22 - 1000.0).abs() < 1e-9, "pulled with free sides");
        assert!((g - (c11 - c12) / 2.0).abs() < 1e-9, "isotropy");
    }

    #[test]
    fn pressed_threads_carry_nothing() {
        let tangent = Fabric::isotropic(1000.0, 0.3, 1e-5, 0.2).stretch.tangent();
        let relaxed = |e| stress(wrinkled(tangent, e), e);
        assert_eq!(relaxed([0.1, 0.1, 0.0]), stress(tangent, [0.1, 0.1, 0.0]));
        assert_eq!(relaxed([-0.1, -0.1, 0.0]), [0.0; 3]);
        // Pulled along one thread and free to narrow: Young's modulus alone.
        for (e, k) in [([0.1, -0.2, 0.0], 0), ([-0.2, 0.1, 0.0], 1)] {
            let found = relaxed(e);
            assert!((found[k] - 100.0).abs() < 1e-9 && found[1 - k] == 0.0, "{found:?}");
        }
    }

    #[test]
    fn impossible_fabrics_are_told() {
        let mut fabric = Fabric::isotropic(1000.0, 0.3, 1e-5, 0.2);
        fabric.density_kg_per_m2 = f64::NAN;
        assert!(fabric.problem().is_some_and(|words| words.contains("density")));
        fabric.density_kg_per_m2 = 0.2;
        fabric.bending.bias = 0.0;
        assert!(fabric.problem().is_some_and(|words| words.contains("bias")));
    }
}
