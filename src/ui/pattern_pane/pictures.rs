//! Pictures on the pieces of the table.

use std::sync::Arc;

use egui::{Color32, Context, Pos2, TextureHandle, TextureOptions, epaint, pos2};
use glam::DVec2;
use image::RgbaImage;

use super::shapes::PieceShape;
use crate::geometry::ids::PieceId;
use crate::pattern::Piece;
use crate::session::Document;
use crate::ui::scenery::pictures::{PiecePicture, picture_of, pictures_on};

/// Largest width and height of a picture on the table, pixels.
const MOST_SIDE: u32 = 1024;

/// The pictures of the document as textures.
#[derive(Default)]
pub struct Pictures {
    kept: Vec<(Arc<RgbaImage>, TextureHandle)>,
}

impl std::fmt::Debug for Pictures {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Pictures").field("kept", &self.kept.len()).finish()
    }
}

impl Pictures {
    /// Loads the pictures of `document`, and drops others.
    pub fn update(&mut self, ctx: &Context, document: &Document) {
        let artwork = &document.artwork;
        let wanted: Vec<&Arc<RgbaImage>> =
            artwork.images.keys().map(|&image| picture_of(artwork, image)).collect();
        self.kept.retain(|(picture, _)| wanted.iter().any(|other| Arc::ptr_eq(other, picture)));
        for picture in wanted {
            if self.of(picture).is_none() {
                self.kept.push((Arc::clone(picture), load(ctx, picture)));
            }
        }
    }

    fn of(&self, picture: &Arc<RgbaImage>) -> Option<&TextureHandle> {
        self.kept.iter().find(|(kept, _)| Arc::ptr_eq(kept, picture)).map(|(_, texture)| texture)
    }

    /// What is seen of the pictures on a piece, clipped to it; `place` gives places on the screen.
    pub fn on_piece(
        &self,
        document: &Document,
        (id, piece, shape): (PieceId, &Piece, &PieceShape),
        place: impl Fn(DVec2) -> Pos2,
    ) -> Vec<egui::Mesh> {
        let pictures = pictures_on(&document.pattern, &document.dyes, &document.artwork, id);
        let seen = pictures.iter().filter_map(|own| Some((own, self.of(&own.picture)?)));
        let onto = |p: DVec2| place(piece.pose.plane_from_piece(p));
        seen.map(|(own, texture)| clipped(own, texture.id(), &shape.fill, onto)).collect()
    }
}

fn load(ctx: &Context, picture: &RgbaImage) -> TextureHandle {
    let longest = picture.width().max(picture.height());
    let most = MOST_SIDE.min(ctx.input(|i| i.max_texture_side) as u32);
    let small = (longest > most).then(|| {
        let side = |n: u32| (n * most / longest).max(1);
        image::imageops::thumbnail(picture, side(picture.width()), side(picture.height()))
    });
    let picture = small.as_ref().unwrap_or(picture);
    let size = [picture.width() as usize, picture.height() as usize];
    let image = egui::ColorImage::from_rgba_unmultiplied(size, picture.as_raw());
    ctx.load_texture("picture on a piece", image, TextureOptions::LINEAR_REPEAT)
}

/// The part of a picture that is on the cloth `fill`, trapezoids in the piece's plane.
fn clipped(
    own: &PiecePicture,
    texture: egui::TextureId,
    fill: &[[DVec2; 4]],
    onto: impl Fn(DVec2) -> Pos2,
) -> egui::Mesh {
    let mut mesh = egui::Mesh::with_texture(texture);
    let piece_from_picture = own.picture_from_piece.inverse();
    for part in fill {
        let in_picture = part.map(|p| own.picture_from_piece.transform_point2(p)).to_vec();
        let seen = if own.repeats { in_picture } else { within_unit_square(in_picture) };
        let base = mesh.vertices.len() as u32;
        for &p in &seen {
            mesh.vertices.push(epaint::Vertex {
                pos: onto(piece_from_picture.transform_point2(p)),
                uv: pos2(p.x as f32, (1.0 - p.y) as f32),
                color: Color32::WHITE,
            });
        }
        (2..seen.len() as u32).for_each(|i| mesh.add_triangle(base, base + i - 1, base + i));
    }
    mesh
}

/// A convex polygon cut to 0..1 both ways (Sutherland and Hodgman 1974).
fn within_unit_square(polygon: Vec<DVec2>) -> Vec<DVec2> {
    let sides: [fn(DVec2) -> f64; 4] = [|p| p.x, |p| 1.0 - p.x, |p| p.y, |p| 1.0 - p.y];
    sides.into_iter().fold(polygon, |polygon, inside| {
        let mut kept = Vec::with_capacity(polygon.len() + 1);
        for (i, &p) in polygon.iter().enumerate() {
            let q = polygon[(i + 1) % polygon.len()];
            let (here, there) = (inside(p), inside(q));
            if here >= 0.0 {
                kept.push(p);
            }
            if (here < 0.0) != (there < 0.0) {
                kept.push(p.lerp(q, here / (here - there)));
            }
        }
        kept
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::polygon::signed_area;

    #[test]
    fn what_overhangs_is_cut_off() {
        let square = [(-1.0, 0.5), (0.5, 0.5), (0.5, 3.0), (-1.0, 3.0)].map(DVec2::from);
        let kept = within_unit_square(square.to_vec());
        assert!((signed_area(&kept) - 0.25).abs() < 1e-12, "{kept:?}");
        let away = square.map(|p| p + DVec2::splat(5.0));
        assert!(within_unit_square(away.to_vec()).is_empty());
    }
}
