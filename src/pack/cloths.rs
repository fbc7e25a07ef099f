//! The cloths that the pieces are cut from, colourways, and how much of each is needed.

use std::sync::Arc;

use serde::Serialize;

use crate::cloth::Fabric;
use crate::geometry::ids::PieceId;
use crate::geometry::polygon::signed_area;
use crate::geometry::words::Words;
use crate::io::cutting_line;
use crate::marker::nest::{Effort, Watch};
use crate::marker::{MarkerError, Order, make};
use crate::pack::words;
use crate::pattern::{Pattern, Piece};
use crate::session::{Artwork, Document, Dye, Dyes, Fabrics};

/// Largest distance of chords from cutting lines where areas are measured, metres.
const CHORDS: f64 = 2e-4;

/// Area of a piece within its cutting line, square metres.
pub(super) fn area(piece: &Piece) -> f64 {
    signed_area(&cutting_line(piece, CHORDS)).abs()
}

/// What is wished of a tech pack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wish {
    /// Width of cloth that can be used, metres.
    pub width: f64,
    /// Whether all pieces point the same way on the cloth.
    pub nap: bool,
    /// What may be spent on all layouts together.
    pub effort: Effort,
}

impl Default for Wish {
    fn default() -> Self {
        Self { width: 1.5, nap: false, effort: Effort { seconds: 5.0, seed: 1 } }
    }
}

/// A cloth: all pieces of the same fabric, colour and print.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Cloth {
    /// Name of the fabric.
    pub fabric: String,
    /// Mass per area, kg/m²; None for a fabric that is not known.
    pub density_kg_per_m2: Option<f64>,
    /// Colour of the outside, sRGB; None where neither fabric nor document has one.
    pub colour: Option<[u8; 3]>,
    /// Print, in words.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub print: Option<Words>,
    /// Name of the image all over it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub image: Option<String>,
    /// Numbers of the pieces.
    pub pieces: Vec<u32>,
    /// Area of the pieces within their cutting lines in the base size, square metres.
    pub area: f64,
    /// What each size takes; empty for colourways that are not chosen.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub taken: Vec<Taken>,
}

/// How much of a cloth one garment takes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Taken {
    /// Name of the size; empty where the pattern has none.
    pub size: String,
    /// Length of cloth, metres; None where the pieces cannot be laid out.
    pub length: Option<f64>,
    /// Share of that cloth which is in pieces, percent.
    pub yield_percent: Option<f64>,
    /// Why the pieces cannot be laid out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub why: Option<Words>,
}

/// A named set of cloths.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Colourway {
    pub name: String,
    /// Whether it is the one that the garment has now.
    pub is_chosen: bool,
    pub cloths: Vec<Cloth>,
}

impl Cloth {
    /// Mass of its pieces, kg.
    pub fn mass(&self) -> Option<f64> {
        Some(self.density_kg_per_m2? * self.area)
    }
}

/// The cloths of the garment as it is now, with what each size takes of them.
///
/// # Errors
/// A number of `wish` that no cloth has.
pub fn cloths(document: &Document, wish: &Wish) -> Result<Vec<Cloth>, MarkerError> {
    let pattern = &document.pattern;
    let mut cloths = grouped(pattern, &document.fabrics, &document.dyes, &document.artwork);
    let sizes = match pattern.sizes.is_empty() {
        true => vec![String::new()],
        false => pattern.sizes.names.clone(),
    };
    let seconds = wish.effort.seconds / (cloths.len() * sizes.len()).max(1) as f64;
    for cloth in &mut cloths {
        let mut own = (**pattern).clone();
        own.pieces.retain(|id, _| cloth.pieces.contains(&id.0));
        cloth.taken = sizes
            .iter()
            .map(|size| taken(&own, size, wish, Effort { seconds, ..wish.effort }))
            .collect::<Result<_, _>>()?;
    }
    Ok(cloths)
}

/// The kept colourways of `document`.
pub fn colourways(document: &Document) -> Vec<Colourway> {
    let row = |own: &crate::session::Colourway| Colourway {
        name: own.name.clone(),
        is_chosen: own.fabrics == document.fabrics && own.dyes == document.dyes,
        cloths: grouped(&document.pattern, &own.fabrics, &own.dyes, &document.artwork),
    };
    document.colourways.iter().map(row).collect()
}

/// The pieces by what they are cut from.
fn grouped(pattern: &Pattern, fabrics: &Fabrics, dyes: &Dyes, artwork: &Arc<Artwork>) -> Vec<Cloth> {
    let mut groups: Vec<(&str, Dye, Vec<PieceId>)> = Vec::new();
    for &id in pattern.pieces.keys() {
        let (fabric, dye) = (fabrics.name(Some(id)), dyes.of(id));
        match groups.iter_mut().find(|group| group.0 == fabric && group.1 == dye) {
            Some(group) => group.2.push(id),
            None => groups.push((fabric, dye, vec![id])),
        }
    }
    let area = |id: &PieceId| area(&pattern.pieces[id]);
    let cloth = |(name, dye, pieces): (&str, Dye, Vec<PieceId>)| {
        let fabric = Fabric::preset(name);
        let image = dye.image.and_then(|repeated| artwork.images.get(&repeated.image));
        Cloth {
            fabric: name.to_owned(),
            density_kg_per_m2: fabric.map(|fabric| fabric.density_kg_per_m2),
            colour: dye.colour.or(fabric.and_then(|fabric| fabric.look.colour)),
            print: dye.print.map(words::print),
            image: image.map(|image| image.name.clone()),
            area: pieces.iter().map(area).sum(),
            pieces: pieces.into_iter().map(|id| id.0).collect(),
            taken: Vec::new(),
        }
    };
    groups.into_iter().map(cloth).collect()
}

fn taken(pattern: &Pattern, size: &str, wish: &Wish, effort: Effort) -> Result<Taken, MarkerError> {
    let garments = vec![(size.to_owned(), 1)];
    let order = Order { garments, width: wish.width, nap: wish.nap, effort, ..Order::default() };
    let none = Taken { size: size.to_owned(), length: None, yield_percent: None, why: None };
    match make(pattern, &order, &Watch::default()) {
        Ok(marker) => {
            let percent = marker.share() * 100.0;
            Ok(Taken { length: Some(marker.length), yield_percent: Some(percent), ..none })
        }
        Err(error @ MarkerError::Number(_)) => Err(error),
        Err(error) => Ok(Taken { why: Some(error.words()), ..none }),
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::pattern::Piece;

    fn document() -> Document {
        let mut pattern = Pattern::default();
        for (name, width) in [("front", 0.5), ("back", 0.5), ("collar", 2.0)] {
            let corners = [DVec2::ZERO, DVec2::X * width, DVec2::new(width, width), DVec2::new(0.0, width)];
            pattern.add_piece(Piece::polygon(name, &corners));
        }
        let mut document = Document { pattern: Arc::new(pattern), ..Document::default() };
        let collar = document.pattern.piece_named("collar").expect("a collar");
        document.dyes.set(Some(collar), Dye { colour: Some([200, 0, 0]), ..Dye::default() });
        document
    }

    #[test]
    fn each_cloth_is_laid_out_by_itself_and_what_is_too_wide_is_told() {
        let effort = Effort { seconds: 0.0, seed: 1 };
        let wish = Wish { width: 1.1, nap: false, effort };
        let cloths = cloths(&document(), &wish).expect("cloths");
        assert_eq!(cloths.len(), 2);
        let [main, collar] = &cloths[..] else { panic!("two") };
        assert!((main.area - 0.5).abs() < 1e-9 && main.pieces.len() == 2);
        assert_eq!(main.fabric, Fabric::USUAL);
        assert!((main.taken[0].length.expect("laid out") - 0.5).abs() < 1e-6);
        assert_eq!((collar.colour, collar.taken[0].length), (Some([200, 0, 0]), None));
        let why = collar.taken[0].why.as_deref().expect("why");
        assert!(why.contains("\"collar\" needs cloth of 200.0 cm"), "{why}");
        let wrong = Wish { width: f64::NAN, ..wish };
        assert!(matches!(super::cloths(&document(), &wrong), Err(MarkerError::Number(_))));
    }
}
