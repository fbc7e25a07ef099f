//! How a body is shown: as skin, or as a dress form covered in linen.

use std::str::FromStr;

use glam::{Vec2, Vec3};

use crate::cloth::{FabricLook, Weave};
use crate::render::{BODY, Mesh, Rgb, Textile};
use crate::ui::scenery::fabric_looks::textile;

/// How a body is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BodyLook {
    /// Skin like warm plaster.
    #[default]
    Skin,
    /// A dress form covered in ecru linen.
    Form,
}

/// Colours of the threads of the linen, along and across, sRGB.
const LINEN: [Rgb; 2] = [[219, 205, 178], [228, 216, 192]];

impl BodyLook {
    /// All of them, in the order of menus.
    pub const ALL: [Self; 2] = [Self::Skin, Self::Form];

    /// Name for users.
    pub fn name(self) -> &'static str {
        match self {
            Self::Skin => "skin",
            Self::Form => "form",
        }
    }

    /// `body`, the mesh of a body in skin, with this look.
    pub(super) fn on(self, body: Mesh) -> Mesh {
        match self {
            Self::Skin => Mesh { front: BODY, back: BODY, ..body },
            Self::Form => Mesh {
                flat: flat_places(&body),
                textile: linen(),
                covered: true,
                front: LINEN[0],
                back: LINEN[0],
                ..body
            },
        }
    }
}

impl FromStr for BodyLook {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let names = || Self::ALL.map(Self::name).join(", ");
        let found = Self::ALL.into_iter().find(|look| look.name() == text);
        found.ok_or_else(|| format!("there is no look of a body {text:?}; there are {}", names()))
    }
}

/// Firm linen as covers dress forms: coarser than that of clothes, and uneven.
fn linen() -> Textile {
    textile(&FabricLook {
        weave: Weave::Plain,
        weft: Some(LINEN[1]),
        pitch_m: 7e-4,
        relief: 0.35,
        roughness: 0.85,
        gloss: 0.05,
        sheen: 0.1,
        slubs: 0.16,
        ..FabricLook::default()
    })
}

/// Places in the flat cloth (metres, y along the grain) of the corners of each triangle, seen along the axis that its normal is
/// nearest to: the grain is upright all over the body, and the weft goes on from one such side to the next.
fn flat_places(mesh: &Mesh) -> Vec<[Vec2; 3]> {
    let places = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|v| mesh.positions.get(v as usize).copied().unwrap_or(Vec3::ZERO));
        let normal = (b - a).cross(c - a).abs();
        let place = |p: Vec3| {
            if normal.y > normal.x.max(normal.z) {
                Vec2::new(p.x, p.z)
            } else if normal.x > normal.z {
                Vec2::new(p.z, p.y)
            } else {
                Vec2::new(p.x, p.y)
            }
        };
        [a, b, c].map(place)
    };
    mesh.triangles.iter().map(places).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::{Surface, mannequin};
    use crate::ui::scenery::scene::body_mesh;

    fn body() -> Surface {
        Surface::new(mannequin::default().mesh.clone()).expect("a body")
    }

    #[test]
    fn a_form_is_covered_in_woven_linen_and_skin_is_not() {
        let body = body();
        let [skin, form] = BodyLook::ALL.map(|look| body_mesh(&body, look));
        assert!(!skin.covered && skin.flat.is_empty() && skin.front == BODY);
        assert!(form.covered && form.textile.weave != 0 && form.front != BODY);
        assert_eq!((form.flat.len(), form.cloth), (form.triangles.len(), 0.0), "it is drawn as the body is");
        assert_eq!((&form.positions, &form.triangles), (&skin.positions, &skin.triangles));
    }

    #[test]
    fn no_thread_is_stretched_more_than_a_box_stretches_it() {
        let form = body_mesh(&body(), BodyLook::Form);
        for (triangle, flat) in form.triangles.iter().zip(&form.flat) {
            let [a, b, c] = triangle.map(|v| form.positions[v as usize]);
            let area = (b - a).cross(c - a).length();
            let flat = (flat[1] - flat[0]).perp_dot(flat[2] - flat[0]).abs();
            // The normal is at most this far from the nearest axis: cos = 1 / √3.
            assert!(flat >= area / 3f32.sqrt() * 0.999 - 1e-12 && flat <= area * 1.001 + 1e-12);
        }
    }

    #[test]
    fn names_are_read() {
        assert_eq!("form".parse(), Ok(BodyLook::Form));
        assert!("clay".parse::<BodyLook>().is_err_and(|words| words.contains("skin, form")));
    }
}
