//! Flat sheets of several kinds of triangles, and scenes of them.

use glam::{DVec2, DVec3};
use toile::cloth::Fabric;
use toile::drape::solver::newton::Newton;
use toile::drape::solver::settle::{SettleSettings, settle};
use toile::drape::{Contacts, Elastic, Scene, Sheet};

/// How a rectangle is cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// All diagonals alike.
    Diagonal,
    /// Diagonals turn like a chessboard.
    Alternating,
    /// Rows shifted by half an edge.
    Equilateral,
    /// Alternating, with every inner vertex moved a little.
    Jittered,
    /// Every square cut in four.
    Crossed,
}

pub const KINDS: [Kind; 5] =
    [Kind::Diagonal, Kind::Alternating, Kind::Equilateral, Kind::Jittered, Kind::Crossed];

/// Points and triangles of a rectangle `size` in `cells`.
pub struct Flat {
    pub points: Vec<DVec2>,
    pub triangles: Vec<[u32; 3]>,
}

/// The same every time, -1..1.
fn chance(i: u32, j: u32, k: u32) -> f64 {
    let mut z = (u64::from(i) << 40) ^ (u64::from(j) << 20) ^ u64::from(k) ^ 0x9E37_79B9_7F4A_7C15;
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
}

pub fn flat(kind: Kind, size: DVec2, cells: [u32; 2]) -> Flat {
    let [m, n] = cells;
    let step = size / DVec2::new(f64::from(m), f64::from(n));
    let at = |i: u32, j: u32| j * (m + 1) + i;
    let mut points = Vec::new();
    for j in 0..=n {
        for i in 0..=m {
            let mut p = step * DVec2::new(f64::from(i), f64::from(j));
            let inner = i > 0 && j > 0 && i < m && j < n;
            if kind == Kind::Jittered && inner {
                p += step * DVec2::new(chance(i, j, 0), chance(i, j, 1)) * 0.25;
            }
            if kind == Kind::Equilateral && j % 2 == 1 && i > 0 && i < m {
                p.x += step.x * 0.5 * (1.0 - 2.0 * f64::from(i) / f64::from(m)).signum() * 0.5;
            }
            points.push(p);
        }
    }
    let mut triangles = Vec::new();
    for j in 0..n {
        for i in 0..m {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            let turned = match kind {
                Kind::Diagonal => false,
                Kind::Alternating | Kind::Jittered => (i + j) % 2 == 1,
                Kind::Equilateral => j % 2 == 1,
                Kind::Crossed => {
                    let middle = points.len() as u32;
                    points.push(step * DVec2::new(f64::from(i) + 0.5, f64::from(j) + 0.5));
                    triangles.extend([[a, b, middle], [b, c, middle], [c, d, middle], [d, a, middle]]);
                    continue;
                }
            };
            if turned {
                triangles.extend([[a, b, d], [b, c, d]]);
            } else {
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
    Flat { points, triangles }
}

impl Flat {
    pub fn sheet(&self) -> Sheet {
        let rest = self.triangles.iter().map(|vs| vs.map(|v| self.points[v as usize])).collect();
        Sheet::new(self.points.len(), self.triangles.clone(), rest).expect("a sheet")
    }

    /// Placed in space.
    pub fn placed(&self, place: impl Fn(DVec2) -> DVec3) -> Vec<DVec3> {
        self.points.iter().map(|&p| place(p)).collect()
    }

    /// The vertices that `who` picks.
    pub fn picked(&self, who: impl Fn(DVec2) -> bool) -> Vec<bool> {
        self.points.iter().map(|&p| who(p)).collect()
    }
}

/// A scene under gravity of 10 m/s² along -y.
pub fn scene(flat: &Flat, fabric: &Fabric, pinned: Vec<bool>) -> Scene {
    let sheet = flat.sheet();
    let elastic = Elastic::new(&sheet, fabric, 1.0);
    let mass = sheet.vertex_area.iter().map(|a| a * fabric.density_kg_per_m2).collect();
    Scene {
        sheet,
        elastic,
        mass,
        pinned,
        gravity: DVec3::new(0.0, -10.0, 0.0),
        damping: fabric.damping_per_s,
        collider: None,
    }
}

/// At rest from `x` under gravity and `extra` forces.
pub fn settled(scene: &Scene, extra: &[DVec3], settings: &SettleSettings, mut x: Vec<DVec3>) -> Vec<DVec3> {
    let mut newton = Newton::new(&scene.sheet, &scene.elastic).expect("room");
    let mut contacts = Contacts::new(x.len(), 0.0, 0.0);
    let solved = settle(scene, &mut newton, &mut contacts, extra, settings, &mut x);
    assert!(solved.converged, "{solved:?} {:?}", newton.work);
    x
}

pub fn near(what: &str, found: f64, exact: f64, tolerance: f64) {
    assert!(((found - exact) / exact).abs() <= tolerance, "{what}: {found}, exactly {exact}");
}
