//! Commands for images and graphics.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DAffine2, DVec2};

use crate::geometry::ids::{GraphicId, ImageId, PieceId};
use crate::geometry::words::{Words, words};
use crate::session::artwork::{Artwork, Graphic, ImageFile};
use crate::session::command::Rejection;
use crate::session::document::Document;
use crate::session::edit::Edit;

/// Adds an image, which must be readable.
pub fn add_image(mut document: Document, file: &Arc<ImageFile>) -> Result<Edit, Rejection> {
    file.picture().map_err(|why| Rejection(words!("{name}: {why}", name = file.name, why)))?;
    let artwork = Arc::make_mut(&mut document.artwork);
    let id = ImageId(artwork.fresh());
    artwork.images.insert(id, Arc::clone(file));
    checked(document, words!("take {name}", name = file.name))
}

/// Deletes an image with its graphics; fabrics lose it as their surface.
pub fn delete_image(mut document: Document, image: ImageId) -> Result<Edit, Rejection> {
    let artwork = Arc::make_mut(&mut document.artwork);
    let Some(file) = artwork.images.remove(&image) else {
        return Err(Rejection(words!("there is no {what}", what = image)));
    };
    artwork.graphics.retain(|_, graphic| graphic.image != image);
    document.dyes.forget(image);
    if document.colourways.iter().any(|colourway| colourway.dyes.images().any(|other| other == image)) {
        Arc::make_mut(&mut document.colourways).iter_mut().for_each(|colourway| colourway.dyes.forget(image));
    }
    checked(document, words!("delete {name}", name = file.name))
}

/// Adds a graphic.
pub fn add_graphic(mut document: Document, graphic: &Graphic) -> Result<Edit, Rejection> {
    let artwork = Arc::make_mut(&mut document.artwork);
    let id = GraphicId(artwork.fresh());
    artwork.graphics.insert(id, *graphic);
    checked(document, words!("add a graphic"))
}

/// Replaces a graphic.
pub fn set_graphic(mut document: Document, id: GraphicId, graphic: &Graphic) -> Result<Edit, Rejection> {
    let artwork = Arc::make_mut(&mut document.artwork);
    let place =
        artwork.graphics.get_mut(&id).ok_or_else(|| Rejection(words!("there is no {what}", what = id)))?;
    *place = *graphic;
    checked(document, words!("change the graphic"))
}

/// Deletes a graphic.
pub fn delete_graphic(mut document: Document, id: GraphicId) -> Result<Edit, Rejection> {
    let artwork = Arc::make_mut(&mut document.artwork);
    artwork.graphics.remove(&id).ok_or_else(|| Rejection(words!("there is no {what}", what = id)))?;
    checked(document, words!("delete the graphic"))
}

fn checked(document: Document, label: Words) -> Result<Edit, Rejection> {
    match problem(&document) {
        None => Ok(Edit::new(label, document)),
        Some(words) => Err(Rejection(words)),
    }
}

/// What is wrong with the images of `document`, in words.
pub fn problem(document: &Document) -> Option<Words> {
    let Document { artwork, pattern, dyes, colourways, .. } = document;
    let dyes = std::iter::once(dyes).chain(colourways.iter().map(|colourway| &colourway.dyes));
    let missing = dyes.flat_map(|dyes| dyes.images()).find(|image| !artwork.images.contains_key(image));
    let missing = missing.map(|image| words!("the {image} of a fabric is not there", image));
    missing.or_else(|| artwork.problem(|piece| pattern.pieces.contains_key(&piece)))
}

/// Moves graphics with the places they are on; `found` gives the piece and the map for a place.
pub fn carry<'c>(
    artwork: &mut Arc<Artwork>,
    found: impl Fn(PieceId, DVec2) -> Option<(PieceId, &'c DAffine2)>,
) {
    let moved: BTreeMap<GraphicId, Graphic> = artwork
        .graphics
        .iter()
        .filter_map(|(id, graphic)| {
            let (piece, map) = found(graphic.piece, graphic.at)?;
            let along = map.matrix2 * DVec2::from_angle(graphic.angle);
            let width_m = graphic.width_m * along.length();
            let at = map.transform_point2(graphic.at);
            Some((*id, Graphic { piece, at, angle: along.to_angle(), width_m, ..*graphic }.clamped()))
        })
        .collect();
    if !moved.is_empty() {
        Arc::make_mut(artwork).graphics.extend(moved);
    }
}

/// Deletes graphics on pieces for which `is_piece` is false.
pub fn forget_gone(artwork: &mut Arc<Artwork>, is_piece: impl Fn(PieceId) -> bool) {
    if artwork.graphics.values().any(|graphic| !is_piece(graphic.piece)) {
        Arc::make_mut(artwork).graphics.retain(|_, graphic| is_piece(graphic.piece));
    }
}
