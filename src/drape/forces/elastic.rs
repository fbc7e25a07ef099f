//! Internal forces of cloth: stretching, bending, strain limits, and the pressure of an enclosed volume.

use glam::{DMat3, DVec3};

use crate::cloth::Fabric;
use crate::cloth::fabric::Bending as Plate;
use crate::drape::forces::bands::Bands;
use crate::drape::forces::bending::Bending;
use crate::drape::forces::folds::Folds;
use crate::drape::forces::limits::StrainLimits;
use crate::drape::forces::membrane::Membrane;
use crate::drape::sheet::Sheet;

/// Elastic energy of a sheet.
#[derive(Clone, Debug)]
pub struct Elastic {
    /// Stretching and shearing.
    pub membrane: Membrane,
    /// Bending.
    pub bending: Bending,
    /// Bending stiffness of the fabric, from which `bending` was built.
    pub plate: Plate,
    /// Springs along edges, for strain control or in place of the membrane.
    pub limits: Option<StrainLimits>,
    /// Elastic sewn along edges.
    pub bands: Bands,
    /// Fold lines; the sheet must be creased there ([`Sheet::creased`]).
    pub folds: Folds,
    /// Excess pressure on the back of the cloth, which pushes it towards its front normal, Pa. 0 for none.
    pub pressure: f64,
    triangles: Vec<[u32; 3]>,
}

impl Elastic {
    /// Elasticity of `fabric`; `compression` as in [`Membrane::new`].
    pub fn new(sheet: &Sheet, fabric: &Fabric, compression: f64) -> Self {
        Self {
            membrane: Membrane::new(sheet, fabric.stretch.tangent(), compression),
            bending: Bending::new(sheet, &fabric.bending),
            plate: fabric.bending,
            limits: None,
            bands: Bands::default(),
            folds: Folds::default(),
            pressure: 0.0,
            triangles: sheet.triangles.clone(),
        }
    }

    /// Elasticity with a net of springs in place of the membrane: equal in warp and weft, and as stiff in compression as in
    /// tension.
    pub fn of_springs(sheet: &Sheet, fabric: &Fabric) -> Self {
        let stiffness = (fabric.stretch.warp * fabric.stretch.weft).sqrt();
        Self {
            membrane: Membrane::new(sheet, [0.0; 4], 1.0),
            limits: Some(StrainLimits::net(sheet, stiffness)),
            ..Self::new(sheet, fabric, 1.0)
        }
    }

    /// Adds the gradient, N, and gives the energy, J.
    pub fn add_gradient(&self, x: &[DVec3], gradient: &mut [DVec3]) -> f64 {
        let mut energy = self.membrane.add_gradient(x, gradient) + self.bending.add_gradient(x, gradient);
        if let Some(limits) = &self.limits {
            energy += limits.add_gradient(x, gradient);
        }
        energy += self.bands.add_gradient(x, gradient) + self.folds.add_gradient(x, gradient);
        if self.pressure != 0.0 {
            energy += self.add_pressure(x, gradient);
        }
        energy
    }

    fn add_pressure(&self, x: &[DVec3], gradient: &mut [DVec3]) -> f64 {
        let about = x[0];
        let mut volume = 0.0;
        for vs in &self.triangles {
            let [a, b, c] = vs.map(|v| x[v as usize] - about);
            volume += a.dot(b.cross(c)) / 6.0;
            let push = self.pressure / 6.0;
            gradient[vs[0] as usize] -= b.cross(c) * push;
            gradient[vs[1] as usize] -= c.cross(a) * push;
            gradient[vs[2] as usize] -= a.cross(b) * push;
        }
        -self.pressure * volume
    }

    /// Hessian blocks of the pressure, N/m, for corners k > l of triangle t.
    pub fn pressure_hessian(&self, x: &[DVec3], mut block: impl FnMut(usize, usize, usize, DMat3)) {
        if self.pressure == 0.0 {
            return;
        }
        let about = x[0];
        for (t, vs) in self.triangles.iter().enumerate() {
            let p = vs.map(|v| x[v as usize] - about);
            for (k, l, third, sign) in [(1, 0, 2, 1.0), (2, 1, 0, 1.0), (2, 0, 1, -1.0)] {
                // d/dx_l of -P/6 (x_l' × …): the gradient at k holds ± P/6 [third]×.
                let cross = skew(p[third]) * (sign * self.pressure / 6.0);
                block(t, k, l, cross * -1.0);
            }
        }
    }
}

/// The matrix of v ↦ a × v.
fn skew(a: DVec3) -> DMat3 {
    DMat3::from_cols(DVec3::new(0.0, a.z, -a.y), DVec3::new(-a.z, 0.0, a.x), DVec3::new(a.y, -a.x, 0.0))
}
