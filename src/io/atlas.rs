//! Texture atlases: where the pieces of a garment are in a texture.

use std::collections::BTreeMap;
use std::str::FromStr;

use glam::{DAffine2, DVec2};
use guillotiere::{SimpleAtlasAllocator, Size};

use crate::cloth::Garment;
use crate::geometry::ids::PieceId;
use crate::pattern::{Pattern, PlanePose};

/// Free border of a texture, and half the gap between packed pieces, as a share of its width.
const MARGIN: f64 = 0.006;
/// Cells a side in which pieces are packed.
const GRID: i32 = 4096;
/// Steps of halving by which the scale of packed pieces is found.
const HALVINGS: usize = 24;

/// How pieces are laid in textures.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AtlasLayout {
    /// All in one texture, as they lie on the table.
    #[default]
    Pattern,
    /// All in one texture, side by side and as large as fits.
    Packed,
    /// Each fills a texture of its own.
    Pieces,
}

impl FromStr for AtlasLayout {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "pattern" => Ok(Self::Pattern),
            "packed" => Ok(Self::Packed),
            "pieces" => Ok(Self::Pieces),
            _ => Err(format!("{text:?} is none of pattern, packed, pieces")),
        }
    }
}

/// The place of a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AtlasPlace {
    /// Number of the texture, from 0.
    pub texture: usize,
    /// Texture coordinates, 0..=1 with v upwards, of a point of the piece in its own plane (metres).
    pub uv_from_piece: DAffine2,
}

/// The places of all pieces of a garment. Shapes are kept: a metre is as long everywhere in a texture, and along u as along v.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Atlas {
    /// Place of each piece that has triangles.
    pub places: BTreeMap<PieceId, AtlasPlace>,
}

/// A piece in the pattern plane, metres: the lower and the upper corner of its box.
struct Boxed {
    piece: PieceId,
    plane_from_piece: DAffine2,
    low: DVec2,
    high: DVec2,
}

impl Boxed {
    fn size(&self) -> DVec2 {
        self.high - self.low
    }

    /// Where the piece is if its lower corner is at `corner` and a metre is `scale` long.
    fn placed(&self, texture: usize, corner: DVec2, scale: f64) -> (PieceId, AtlasPlace) {
        let to_corner = DAffine2::from_translation(corner) * DAffine2::from_scale(DVec2::splat(scale));
        let uv_from_piece = to_corner * DAffine2::from_translation(-self.low) * self.plane_from_piece;
        (self.piece, AtlasPlace { texture, uv_from_piece })
    }
}

impl Atlas {
    /// Lays out the pieces of `garment` that have triangles; `pattern` has their poses on the table.
    pub fn new(garment: &Garment, pattern: &Pattern, layout: AtlasLayout) -> Self {
        let boxes = boxes(garment, pattern);
        let most = |size: DVec2| size.max_element().max(1e-9);
        let places = match layout {
            AtlasLayout::Packed => packed(&boxes),
            AtlasLayout::Pieces => boxes
                .iter()
                .enumerate()
                .map(|(i, own)| own.placed(i, DVec2::splat(MARGIN), (1.0 - 2.0 * MARGIN) / most(own.size())))
                .collect(),
            AtlasLayout::Pattern => {
                let low = boxes.iter().map(|b| b.low).reduce(DVec2::min).unwrap_or_default();
                let high = boxes.iter().map(|b| b.high).reduce(DVec2::max).unwrap_or_default();
                let scale = (1.0 - 2.0 * MARGIN) / most(high - low);
                let corner = |own: &Boxed| MARGIN + (own.low - low) * scale;
                boxes.iter().map(|own| own.placed(0, corner(own), scale)).collect()
            }
        };
        Self { places }
    }

    /// Number of textures.
    pub fn textures(&self) -> usize {
        self.places.values().map(|place| place.texture + 1).max().unwrap_or(0)
    }

    /// Texture coordinates of `at`, a point of `piece` in its own plane, kept within 0..=1.
    pub fn uv(&self, piece: PieceId, at: DVec2) -> DVec2 {
        let place = self.places.get(&piece);
        place.map_or(DVec2::ZERO, |place| {
            place.uv_from_piece.transform_point2(at).clamp(DVec2::ZERO, DVec2::ONE)
        })
    }
}

/// The affine map of [`PlanePose::plane_from_piece`].
fn plane_from_piece(pose: PlanePose) -> DAffine2 {
    let mirror = DVec2::new(if pose.flipped { -1.0 } else { 1.0 }, 1.0);
    DAffine2::from_angle_translation(pose.rotation, pose.offset) * DAffine2::from_scale(mirror)
}

fn boxes(garment: &Garment, pattern: &Pattern) -> Vec<Boxed> {
    let mut boxes: BTreeMap<PieceId, Boxed> = BTreeMap::new();
    for &c in garment.triangle_corners.iter().flatten() {
        let corner = garment.corners[c as usize];
        let own = boxes.entry(corner.piece).or_insert_with(|| {
            let pose = pattern.pieces.get(&corner.piece).map(|piece| piece.pose).unwrap_or_default();
            let nothing = (DVec2::INFINITY, DVec2::NEG_INFINITY);
            Boxed {
                piece: corner.piece,
                plane_from_piece: plane_from_piece(pose),
                low: nothing.0,
                high: nothing.1,
            }
        });
        let at = own.plane_from_piece.transform_point2(corner.uv);
        (own.low, own.high) = (own.low.min(at), own.high.max(at));
    }
    boxes.into_values().collect()
}

/// The boxes side by side at the largest scale at which they are found to fit.
fn packed(boxes: &[Boxed]) -> BTreeMap<PieceId, AtlasPlace> {
    let mut order: Vec<&Boxed> = boxes.iter().collect();
    order.sort_by(|a, b| b.size().y.total_cmp(&a.size().y).then(a.piece.cmp(&b.piece)));
    let most = boxes.iter().map(|b| b.size().max_element()).fold(1e-9, f64::max);
    let (mut fits, mut too_large) = (0.0, (1.0 - 2.0 * MARGIN) / most);
    let mut best = fitted(&order, too_large);
    if best.is_none() {
        for _ in 0..HALVINGS {
            let middle = (fits + too_large) / 2.0;
            match fitted(&order, middle) {
                Some(places) => (fits, best) = (middle, Some(places)),
                None => too_large = middle,
            }
        }
    }
    best.unwrap_or_default()
}

/// The boxes at this scale, if there is room for them.
fn fitted(order: &[&Boxed], scale: f64) -> Option<BTreeMap<PieceId, AtlasPlace>> {
    let mut free = SimpleAtlasAllocator::new(Size::new(GRID, GRID));
    let cells =
        |length: f64| ((length * scale + 2.0 * MARGIN) * f64::from(GRID)).ceil().clamp(1.0, 1e6) as i32;
    let place = |own: &&Boxed| {
        let taken = free.allocate(Size::new(cells(own.size().x), cells(own.size().y)))?;
        let corner = DVec2::new(f64::from(taken.min.x), f64::from(taken.min.y)) / f64::from(GRID) + MARGIN;
        Some(own.placed(0, corner, scale))
    };
    order.iter().map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cloth::Corner;
    use crate::pattern::Piece;

    /// Two pieces of 0.4 x 0.2 and 0.1 x 0.3 m, the second turned, both at the same place on the table.
    fn two() -> (Garment, Pattern) {
        let mut pattern = Pattern::default();
        let mut garment = Garment::default();
        for (size, rotation) in [(DVec2::new(0.4, 0.2), 0.0), (DVec2::new(0.1, 0.3), 0.5)] {
            let outline = [DVec2::ZERO, DVec2::X * size, size, DVec2::Y * size];
            let pose = PlanePose { rotation, flipped: rotation > 0.0, ..PlanePose::default() };
            let piece = pattern.add_piece(Piece { pose, ..Piece::polygon("p", &outline) });
            let first = garment.corners.len() as u32;
            garment.corners.extend(outline.map(|uv| Corner { piece, uv, vertex: 0 }));
            garment.triangle_corners.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        }
        (garment, pattern)
    }

    #[test]
    fn shapes_are_kept_and_all_is_inside() {
        let (garment, pattern) = two();
        for layout in [AtlasLayout::Pattern, AtlasLayout::Packed, AtlasLayout::Pieces] {
            let atlas = Atlas::new(&garment, &pattern, layout);
            assert_eq!(atlas.textures(), if layout == AtlasLayout::Pieces { 2 } else { 1 });
            for corner in &garment.corners {
                let uv = atlas.places[&corner.piece].uv_from_piece.transform_point2(corner.uv);
                assert!(uv.cmpge(DVec2::splat(0.005)).all() && uv.cmple(DVec2::splat(0.995)).all(), "{uv}");
                assert_eq!(atlas.uv(corner.piece, corner.uv), uv);
            }
            let scales = atlas.places.values().map(|place| {
                let m = place.uv_from_piece.matrix2;
                assert!(
                    (m.x_axis.length() - m.y_axis.length()).abs() < 1e-12
                        && m.x_axis.dot(m.y_axis).abs() < 1e-12
                );
                m.x_axis.length()
            });
            let scales: Vec<f64> = scales.collect();
            assert_eq!(scales[0] == scales[1], layout != AtlasLayout::Pieces, "{scales:?}");
        }
    }

    #[test]
    fn packed_pieces_are_apart_and_large() {
        let (garment, pattern) = two();
        let atlas = Atlas::new(&garment, &pattern, AtlasLayout::Packed);
        let boxes = atlas.places.keys().map(|piece| {
            let own = garment.corners.iter().filter(|c| c.piece == *piece).map(|c| atlas.uv(c.piece, c.uv));
            own.fold((DVec2::ONE, DVec2::ZERO), |(low, high), p| (low.min(p), high.max(p)))
        });
        let boxes: Vec<(DVec2, DVec2)> = boxes.collect();
        let apart = (boxes[0].0 - boxes[1].1).max(boxes[1].0 - boxes[0].1);
        assert!(apart.max_element() > 0.01, "{boxes:?}");
        assert!((boxes[0].1 - boxes[0].0).x > 0.6, "{boxes:?}");
    }
}
