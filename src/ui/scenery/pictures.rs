//! Pictures on pieces: the images of fabrics, and graphics. Without egui, so that headless pictures use it too.

use std::sync::{Arc, LazyLock};

use glam::{DAffine2, DMat2, DVec2, Mat2};
use image::{Rgba, RgbaImage};

use crate::geometry::ids::{ImageId, PieceId};
use crate::pattern::Pattern;
use crate::render::Decal;
use crate::render::decal::MOST_DECALS;
use crate::session::artwork::MOST_ON_A_PIECE;
use crate::session::{Artwork, Document, Dyes, Graphic};

/// Pixels of a square of the placeholder.
const CHECK: u32 = 8;

// A surface, a piece's own graphics and those of its twin are all drawn.
const _: () = assert!(2 * MOST_ON_A_PIECE < MOST_DECALS);

/// A picture on a piece.
#[derive(Clone, Debug)]
pub struct PiecePicture {
    /// The picture; the placeholder where its file cannot be read.
    pub picture: Arc<RgbaImage>,
    /// The place in it, 0..1 from its lower left corner, of a point of the piece in its own plane.
    pub picture_from_piece: DAffine2,
    /// Whether it is repeated all over the piece.
    pub repeats: bool,
}

/// What is shown in place of an image that cannot be read: grey and magenta squares.
fn placeholder() -> &'static Arc<RgbaImage> {
    static SQUARES: LazyLock<Arc<RgbaImage>> = LazyLock::new(|| {
        let square = |x: u32, y: u32| match (x / CHECK + y / CHECK) % 2 {
            0 => Rgba([96, 96, 96, 255]),
            _ => Rgba([220, 40, 160, 255]),
        };
        Arc::new(RgbaImage::from_fn(8 * CHECK, 8 * CHECK, square))
    });
    &SQUARES
}

/// The picture of an image, or the placeholder.
pub fn picture_of(artwork: &Artwork, image: ImageId) -> &Arc<RgbaImage> {
    artwork.images.get(&image).and_then(|file| file.picture().ok()).unwrap_or_else(|| placeholder())
}

/// Height over width of an image.
pub fn aspect(artwork: &Artwork, image: ImageId) -> f64 {
    let (width, height) = picture_of(artwork, image).dimensions();
    f64::from(height.max(1)) / f64::from(width.max(1))
}

/// The linear map from the plane of a piece to flat cloth: y along `grain`, a unit vector.
pub fn cloth_from_piece(grain: DVec2) -> DMat2 {
    DMat2::from_cols(DVec2::new(grain.y, grain.x), DVec2::new(-grain.x, grain.y))
}

/// The pictures on `piece`, the last on top.
pub fn pictures_on(pattern: &Pattern, dyes: &Dyes, artwork: &Artwork, piece: PieceId) -> Vec<PiecePicture> {
    let Some(own) = pattern.pieces.get(&piece) else { return Vec::new() };
    let surface = dyes.of(piece).image.map(|repeated| PiecePicture {
        picture: Arc::clone(picture_of(artwork, repeated.image)),
        picture_from_piece: repeated.image_from_cloth(aspect(artwork, repeated.image))
            * DAffine2::from_mat2(cloth_from_piece(own.grain())),
        repeats: true,
    });
    let graphics = artwork.graphics.values().filter_map(|graphic| {
        let mirrored = own.twin == Some(graphic.piece) && graphic.on_twin;
        let map = match mirrored {
            false if graphic.piece != piece => return None,
            false => image_from_piece(artwork, graphic),
            true => image_from_piece(artwork, graphic) * DAffine2::from_scale(DVec2::new(-1.0, 1.0)),
        };
        let picture = Arc::clone(picture_of(artwork, graphic.image));
        Some(PiecePicture { picture, picture_from_piece: map, repeats: false })
    });
    surface.into_iter().chain(graphics).collect()
}

/// The place in the image of `graphic`, 0..1 from its lower left corner, of a point of its piece.
pub fn image_from_piece(artwork: &Artwork, graphic: &Graphic) -> DAffine2 {
    graphic.image_from_piece(aspect(artwork, graphic.image))
}

/// The pictures on `piece` for the renderer, whose texture coordinates are flat cloth with y along `grain`.
pub fn decals(document: &Document, piece: PieceId, grain: DVec2) -> Vec<Decal> {
    let piece_from_cloth = DAffine2::from_mat2(cloth_from_piece(grain).transpose());
    let pictures = pictures_on(&document.pattern, &document.dyes, &document.artwork, piece);
    let decal = |own: PiecePicture| {
        let map = own.picture_from_piece * piece_from_cloth;
        let matrix = Mat2::from_cols(map.matrix2.x_axis.as_vec2(), map.matrix2.y_axis.as_vec2());
        Decal {
            picture: own.picture,
            picture_from_flat: (matrix, map.translation.as_vec2()),
            repeats: own.repeats,
        }
    };
    pictures.into_iter().map(decal).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::ids::GraphicId;
    use crate::pattern::Piece;
    use crate::session::ImageFile;
    use crate::ui::scenery::fabric_looks::on_fabric;

    /// Two twins, and a graphic on the first that the second has, too; the grain of both runs aslant.
    fn document() -> (Document, [PieceId; 2]) {
        let mut document = Document::default();
        let pattern = Arc::make_mut(&mut document.pattern);
        let square = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
        let piece =
            Piece { grainline: Some([DVec2::ZERO, DVec2::new(0.3, 0.4)]), ..Piece::polygon("p", &square) };
        let one = pattern.add_piece(piece.clone());
        let two = pattern.add_piece(Piece { twin: Some(one), ..piece });
        let artwork = Arc::make_mut(&mut document.artwork);
        artwork.images.insert(ImageId(1), Arc::new(ImageFile::new("bad.png", vec![0])));
        let at = DVec2::new(0.3, 0.2);
        let graphic = Graphic { piece: one, image: ImageId(1), at, width_m: 0.1, angle: 0.4, on_twin: true };
        artwork.graphics.insert(GraphicId(2), graphic);
        (document, [one, two])
    }

    #[test]
    fn the_twin_has_the_mirror_image() {
        let (document, [one, two]) = document();
        let on = |piece| pictures_on(&document.pattern, &document.dyes, &document.artwork, piece);
        let [own, mirrored] = [one, two].map(|piece| on(piece)[0].picture_from_piece);
        let p = DVec2::new(0.32, 0.23);
        let image = mirrored.transform_point2(DVec2::new(-p.x, p.y));
        assert!(own.transform_point2(p).distance(image) < 1e-12);
        assert!(own.matrix2.determinant() * mirrored.matrix2.determinant() < 0.0);
        assert!(Arc::ptr_eq(&on(one)[0].picture, placeholder()), "its file cannot be read");
    }

    #[test]
    fn the_renderer_has_pictures_where_the_piece_has_them() {
        let (document, [one, _]) = document();
        let grain = document.pattern.pieces[&one].grain();
        let decal = &decals(&document, one, grain)[0];
        let on_piece = &pictures_on(&document.pattern, &document.dyes, &document.artwork, one)[0];
        for p in [DVec2::ZERO, DVec2::new(0.3, 0.2), DVec2::new(0.9, 0.1)] {
            let (matrix, move_by) = decal.picture_from_flat;
            let found = matrix * on_fabric(p, grain).as_vec2() + move_by;
            assert!(found.distance(on_piece.picture_from_piece.transform_point2(p).as_vec2()) < 1e-5, "{p}");
        }
    }
}
