//! Fabrics: material parameters of cloth for the simulation.

use std::sync::LazyLock;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::cloth::look::FabricLook;

/// Gravity, m/s².
pub const GRAVITY: DVec3 = DVec3::new(0.0, -9.81, 0.0);
/// The presets as JSON, each with the source of its figures.
const PRESETS: &str = include_str!("../../assets/fabrics/presets.json");

/// A fabric: a thin orthotropic plate. Stiffnesses are forces per metre of width, so that thickness is not part of them.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fabric {
    /// Name for people.
    #[serde(default)]
    pub name: String,
    /// Membrane stiffness, N/m.
    pub stretch: Stretch,
    /// Bending stiffness, N·m.
    pub bending: Bending,
    /// Mass per area (grammage), kg/m².
    pub density_kg_per_m2: f64,
    /// Distance from the middle of the cloth to anything that it touches, metres: contact with the body and with
    /// itself keeps it.
    pub thickness_m: f64,
    /// Coefficient of Coulomb friction against bodies and cloth.
    pub friction: f64,
    /// Rate of air damping: decay of free motion, 1/s.
    #[serde(default)]
    pub damping_per_s: f64,
    /// Source of the figures.
    #[serde(default)]
    pub source: String,
    /// Appearance.
    #[serde(default)]
    pub look: FabricLook,
}

/// Membrane stiffness: force per metre of width and unit of strain.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stretch {
    /// Stiffness along the warp with free sides, N/m.
    pub warp: f64,
    /// Stiffness along the weft with free sides, N/m.
    pub weft: f64,
    /// Shear stiffness, N/m.
    pub shear: f64,
    /// Poisson's ratio, -1..1; where warp and weft differ, the geometric mean of their two ratios.
    pub poisson: f64,
}

/// Plate (bending) stiffness: moment per metre of width and unit of curvature, with the other curvatures held at zero.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bending {
    /// Stiffness for curvature along the warp, N·m.
    pub warp: f64,
    /// Stiffness for curvature along the bias at 45°, N·m.
    pub bias: f64,
    /// Stiffness for curvature along the weft, N·m.
    pub weft: f64,
    /// Poisson's ratio of bending, -1..1: the moment along a cylinder divided by that across it.
    #[serde(default)]
    pub poisson: f64,
}

impl Fabric {
    /// Name of the default preset.
    pub const USUAL: &str = "cotton";

    /// An isotropic fabric, from Young's modulus times thickness (N/m), Poisson's ratio, plate stiffness (N·m), and
    /// mass per area (kg/m²).
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
            look: FabricLook::default(),
        }
    }

    /// All presets, in the order of the file.
    pub fn presets() -> &'static [Self] {
        static ALL: LazyLock<Vec<Fabric>> =
            LazyLock::new(|| serde_json::from_str(PRESETS).unwrap_or_default());
        &ALL
    }

    /// The preset called `name`, if there is one.
    pub fn preset(name: &str) -> Option<&'static Self> {
        Self::presets().iter().find(|f| f.name == name)
    }

    /// Describes the first parameter that is outside its valid range, if any.
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
            look,
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
            .or_else(|| look.problem())
    }
}

impl Stretch {
    /// Membrane stiffness matrix C11, C22, C12 and shear, N/m: it gives the stress (s11, s22, s12) for a Green strain
    /// (e11, e22, 2 e12).
    pub fn tangent(&self) -> [f64; 4] {
        let side = 1.0 - self.poisson * self.poisson;
        let (c11, c22) = (self.warp / side, self.weft / side);
        [c11, c22, self.poisson * (c11 * c22).sqrt(), self.shear]
    }
}

/// Stiffness (as [`Stretch::tangent`] gives it) of cloth that wrinkles instead of being compressed along warp or
/// weft, at the strain (e11, e22, 2 e12). It belongs to the relaxed energy min over a, b ≥ 0 of W(e11 + a, e22 + b),
/// which is convex and once differentiable (tension field after Pipkin 1986; wrinkles across warp and weft only, so
/// that the minimum has a closed form).
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

/// Stress (s11, s22, s12), N/m, for a Green strain (e11, e22, 2 e12) and a stiffness matrix C11, C22, C12, shear.
pub fn stress([c11, c22, c12, shear]: [f64; 4], e: [f64; 3]) -> [f64; 3] {
    [c11 * e[0] + c12 * e[1], c12 * e[0] + c22 * e[1], shear * e[2]]
}

/// Green strain (e11, e22, 2 e12), where `f0` and `f1` are the deformed unit vectors along warp and weft.
pub fn green([f0, f1]: [DVec3; 2]) -> [f64; 3] {
    [(f0.length_squared() - 1.0) / 2.0, (f1.length_squared() - 1.0) / 2.0, f0.dot(f1)]
}

impl Bending {
    /// Twisting stiffness, N·m: the moment for 2 k12. It follows from curvature along the bias, where k11 = k22 = k12.
    pub fn twist(&self) -> f64 {
        self.bias - (self.warp + self.weft + 2.0 * self.cross()) / 4.0
    }

    /// Coupling stiffness, N·m: the moment along one direction for curvature along the other.
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
