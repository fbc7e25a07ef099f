//! The skirt with a bow: a gathered skirt whose waistband holds a bow of another colour in front.

use glam::DVec2;

use crate::body::Mannequin;
use crate::pattern::{Bow, PiecePoint};
use crate::session::Document;
use crate::session::samples::gallery::{self, SASH, dyed};

/// Colour of the bow, sRGB.
const RIBBON: [u8; 3] = [196, 74, 88];

/// The skirt drafted for `body`. Panics where the drafting gives no waistband: it does.
pub fn skirt(body: &Mannequin) -> Document {
    let mut bow = Vec::new();
    let mut document = gallery::document_with(&gallery::sash_skirt(), body, |pattern| {
        let piece = pattern.piece_named("waistband front").expect("a waistband");
        let at = PiecePoint { piece, at: DVec2::new(0.0, SASH / 2.0) };
        let measures = Bow { width: 0.065, loops: 0.1, tails: 0.32 };
        bow.extend(pattern.add_bow(at, &measures).expect("inside the waistband"));
    });
    let dyes = &mut document.dyes;
    dyes.pieces.extend(bow.into_iter().map(|piece| (piece, dyed(RIBBON))));
    document
}
