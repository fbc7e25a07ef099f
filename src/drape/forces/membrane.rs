//! Stretching and shearing: constant-strain triangles of an orthotropic Saint-Venant–Kirchhoff membrane.
//!
//! With F the deformation gradient from the pattern plane to space, E = (FᵀF - I)/2 and the tangent C of
//! [`Stretch::tangent`](crate::cloth::fabric::Stretch::tangent) the energy per area is W(E) = E:C:E/2. Cloth wrinkles under
//! compression: only the share `compression` of the plain energy remains there. The rest is the energy relaxed over wrinkles
//! along the yarns, see [`wrinkled`].

use glam::{DMat3, DVec2, DVec3};

use crate::cloth::fabric::{green, stress, wrinkled};
use crate::drape::sheet::Sheet;

/// Membrane elements of a sheet.
#[derive(Clone, Debug)]
pub struct Membrane {
    elements: Vec<Element>,
    tangent: [f64; 4],
    compression: f64,
}

#[derive(Clone, Copy, Debug)]
struct Element {
    vertices: [u32; 3],
    area: f64,
    /// Gradients of the corners' linear shape functions in the pattern plane, 1/m.
    gradients: [DVec2; 3],
}

/// Energy density and stress of one triangle, N/m, and the tangent stiffness.
struct Response {
    energy: f64,
    stress: [f64; 3],
    /// Tangent stiffness: C11, C22, C12, shear.
    tangent: [f64; 4],
}

impl Membrane {
    /// A membrane with `tangent` from [`Stretch::tangent`](crate::cloth::fabric::Stretch::tangent) (first direction: y of the
    /// pattern plane, the warp). `compression` 0..=1 is the share of stiffness kept under compression; 1 for a plain membrane.
    pub fn new(sheet: &Sheet, tangent: [f64; 4], compression: f64) -> Self {
        let elements = sheet.triangles.iter().zip(&sheet.rest).zip(&sheet.areas);
        let elements = elements
            .map(|((&vertices, corners), &area)| Element {
                vertices,
                area,
                gradients: gradients(corners, area),
            })
            .collect();
        Self { elements, tangent, compression }
    }

    /// Membrane energy, J.
    pub fn energy(&self, x: &[DVec3]) -> f64 {
        self.elements.iter().map(|e| e.area * self.response(e.frame(x)).energy).sum()
    }

    /// Adds the gradient of the energy, N, and returns the energy, J.
    pub fn add_gradient(&self, x: &[DVec3], gradient: &mut [DVec3]) -> f64 {
        let mut energy = 0.0;
        for e in &self.elements {
            let frame = e.frame(x);
            let response = self.response(frame);
            energy += e.area * response.energy;
            let [s0, s1, s01] = response.stress;
            let (p0, p1) =
                ((frame[0] * s0 + frame[1] * s01) * e.area, (frame[0] * s01 + frame[1] * s1) * e.area);
            for (&v, g) in e.vertices.iter().zip(&e.gradients) {
                gradient[v as usize] += p0 * g.y + p1 * g.x;
            }
        }
        energy
    }

    /// The 3 × 3 Hessian blocks of each triangle, N/m, for corners k ≥ l. Without `exact` they are made positive semidefinite by
    /// leaving out the compressive part of the geometric stiffness.
    pub fn hessian(&self, x: &[DVec3], exact: bool, mut block: impl FnMut(usize, usize, usize, DMat3)) {
        for (t, e) in self.elements.iter().enumerate() {
            let frame = e.frame(x);
            let response = self.response(frame);
            let stress = if exact { response.stress } else { tension(response.stress) };
            let [c11, c22, c12, shear] = response.tangent.map(|c| c * e.area);
            let strain =
                e.gradients.map(|g| [frame[0] * g.y, frame[1] * g.x, frame[0] * g.x + frame[1] * g.y]);
            for k in 0..3 {
                let [a0, a1, a2] = strain[k];
                let (d0, d1, d2) = (a0 * c11 + a1 * c12, a0 * c12 + a1 * c22, a2 * shear);
                for (l, [b0, b1, b2]) in strain.into_iter().enumerate().take(k + 1) {
                    let (g, h) = (e.gradients[k], e.gradients[l]);
                    let geometric = e.area
                        * (stress[0] * g.y * h.y
                            + stress[1] * g.x * h.x
                            + stress[2] * (g.x * h.y + g.y * h.x));
                    let outer = DMat3::from_cols(
                        d0 * b0.x + d1 * b1.x + d2 * b2.x,
                        d0 * b0.y + d1 * b1.y + d2 * b2.y,
                        d0 * b0.z + d1 * b1.z + d2 * b2.z,
                    );
                    block(t, k, l, outer + DMat3::from_diagonal(DVec3::splat(geometric)));
                }
            }
        }
    }

    /// Green strain of triangle `t` along warp and weft, and twice its shear component.
    pub fn strain(&self, t: usize, x: &[DVec3]) -> [f64; 3] {
        green(self.elements[t].frame(x))
    }

    fn response(&self, frame: [DVec3; 2]) -> Response {
        let e = green(frame);
        let plain = plain(self.tangent, e);
        let pressed = plain.stress[0] < 0.0 || plain.stress[1] < 0.0;
        if self.compression >= 1.0 || !pressed { plain } else { self.softened(e) }
    }

    fn softened(&self, e: [f64; 3]) -> Response {
        let relaxed = wrinkled(self.tangent, e);
        let soft = self.compression;
        let mix = [0, 1, 2, 3].map(|i| soft * self.tangent[i] + (1.0 - soft) * relaxed[i]);
        self::plain(mix, e)
    }
}

impl Element {
    /// Columns of the deformation gradient: images of the warp and weft directions.
    fn frame(&self, x: &[DVec3]) -> [DVec3; 2] {
        let [a, b, c] = self.vertices.map(|v| x[v as usize]);
        let (u, v) = (b - a, c - a);
        let [_, g, h] = self.gradients;
        [u * g.y + v * h.y, u * g.x + v * h.x]
    }
}

fn plain(tangent: [f64; 4], e: [f64; 3]) -> Response {
    let stress = stress(tangent, e);
    Response { energy: (stress[0] * e[0] + stress[1] * e[1] + stress[2] * e[2]) / 2.0, stress, tangent }
}

/// Positive semidefinite part of a stress.
fn tension([s0, s1, s01]: [f64; 3]) -> [f64; 3] {
    let (mean, half) = ((s0 + s1) / 2.0, (s0 - s1) / 2.0);
    let radius = half.hypot(s01);
    let (high, low) = (mean + radius, mean - radius);
    if low >= 0.0 {
        return [s0, s1, s01];
    }
    if high <= 0.0 || radius == 0.0 {
        return [0.0; 3];
    }
    // High principal stress times the projector on its direction.
    let (c, s) = (half / radius, s01 / radius);
    [high * (1.0 + c) / 2.0, high * (1.0 - c) / 2.0, high * s / 2.0]
}

fn gradients(corners: &[DVec2; 3], area: f64) -> [DVec2; 3] {
    [0, 1, 2].map(|k| {
        let side = corners[(k + 2) % 3] - corners[(k + 1) % 3];
        DVec2::new(-side.y, side.x) / (2.0 * area)
    })
}
