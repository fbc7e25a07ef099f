//! Colours and prints of pieces, and named sets of them (colourways).

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::geometry::ids::{ImageId, PieceId};
use crate::geometry::words::{Words, within_quotes, words};
use crate::session::artwork::Repeated;
use crate::session::fabrics::Fabrics;

/// Range of the repeat of a print, metres.
const REPEATS: [f64; 2] = [0.001, 2.0];
/// Largest number of characters of a colourway's name.
const LONGEST_NAME: usize = 100;
/// Largest number of colourways of a document.
const MOST_COLOURWAYS: usize = 100;

/// A printed or woven pattern of two colours. The numbers are those of shaders/textile.wgsl.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Motif {
    /// Stripes along the grain.
    Stripes = 1,
    /// Stripes across the grain.
    Hoops = 2,
    /// Stripes both ways, darker where they cross (gingham).
    Checks = 3,
    /// Dots in rows that are shifted by half a repeat.
    Dots = 4,
}

impl Motif {
    /// All motifs.
    pub const ALL: [Self; 4] = [Self::Stripes, Self::Hoops, Self::Checks, Self::Dots];

    /// Name for users.
    pub fn name(self) -> &'static str {
        match self {
            Self::Stripes => "stripes",
            Self::Hoops => "hoops",
            Self::Checks => "checks",
            Self::Dots => "dots",
        }
    }
}

impl std::str::FromStr for Motif {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let names = || Self::ALL.map(Self::name).join(", ");
        let found = Self::ALL.into_iter().find(|motif| motif.name().eq_ignore_ascii_case(text));
        found.ok_or_else(|| format!("there is no print {text:?}; there are {}", names()))
    }
}

/// A print of a fabric.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Print {
    /// What is repeated.
    pub motif: Motif,
    /// Length of a repeat, metres, 0.001..=2.
    pub repeat_m: f64,
    /// Its colour, sRGB.
    pub colour: [u8; 3],
}

/// Colour, print and image of a piece; None: those of all pieces, or of the fabric.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Dye {
    /// Colour of the fabric, sRGB.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colour: Option<[u8; 3]>,
    /// Print on it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub print: Option<Print>,
    /// Image all over it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub image: Option<Repeated>,
}

impl Dye {
    /// Whether it changes nothing.
    pub fn is_plain(&self) -> bool {
        *self == Self::default()
    }
}

/// Colours and prints of all pieces and of single ones.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Dyes {
    /// Of pieces that have none of their own.
    #[serde(skip_serializing_if = "Dye::is_plain")]
    pub all: Dye,
    /// Of single pieces.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub pieces: BTreeMap<PieceId, Dye>,
}

impl Dyes {
    /// Whether no piece has a colour or print.
    pub fn is_plain(&self) -> bool {
        *self == Self::default()
    }

    /// Colour and print of `piece`: its own, else those of all pieces.
    pub fn of(&self, piece: PieceId) -> Dye {
        let own = self.pieces.get(&piece).copied().unwrap_or_default();
        let Dye { colour, print, image } = self.all;
        Dye { colour: own.colour.or(colour), print: own.print.or(print), image: own.image.or(image) }
    }

    /// Sets the dye of `piece` (None: of all pieces that have none of their own).
    pub fn set(&mut self, piece: Option<PieceId>, dye: Dye) {
        match piece {
            None => self.all = dye,
            Some(piece) if dye.is_plain() => {
                self.pieces.remove(&piece);
            }
            Some(piece) => {
                self.pieces.insert(piece, dye);
            }
        }
    }

    fn each(&self) -> impl Iterator<Item = &Dye> {
        std::iter::once(&self.all).chain(self.pieces.values())
    }

    /// The images of fabrics, with repetitions.
    pub fn images(&self) -> impl Iterator<Item = ImageId> {
        self.each().filter_map(|dye| Some(dye.image?.image))
    }

    /// Removes an image from all fabrics.
    pub fn forget(&mut self, image: ImageId) {
        for dye in std::iter::once(&mut self.all).chain(self.pieces.values_mut()) {
            dye.image = dye.image.filter(|own| own.image != image);
        }
        self.pieces.retain(|_, dye| !dye.is_plain());
    }

    /// The first print or image that cannot be drawn, in words.
    pub fn problem(&self) -> Option<Words> {
        let prints = self.each().filter_map(|dye| dye.print);
        let [least, most] = REPEATS;
        let wrong = prints.map(|print| print.repeat_m).find(|repeat| !(least..=most).contains(repeat));
        let wrong = wrong.map(|repeat| {
            let [repeat, least, most] = [repeat, least, most].map(|metres| (metres * 1e5).round() / 100.0);
            words!("a print repeats every {least} to {most} mm, not every {repeat} mm", least, most, repeat)
        });
        wrong.or_else(|| self.each().find_map(|dye| dye.image?.problem()))
    }
}

/// A named set of fabrics, colours and prints.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Colourway {
    /// Name, unique in the document.
    pub name: String,
    /// Fabrics of the pieces.
    #[serde(default, skip_serializing_if = "Fabrics::is_usual")]
    pub fabrics: Fabrics,
    /// Colours and prints of the pieces.
    #[serde(default, skip_serializing_if = "Dyes::is_plain")]
    pub dyes: Dyes,
}

/// The first thing wrong with a document's colourways, in words; their fabrics are checked elsewhere.
pub fn colourways_problem(colourways: &[Colourway]) -> Option<Words> {
    if colourways.len() > MOST_COLOURWAYS {
        return Some(words!("there are more than {most} colourways", most = MOST_COLOURWAYS));
    }
    colourways.iter().enumerate().find_map(|(i, colourway)| {
        if colourway.name.trim().is_empty() || colourway.name.chars().count() > LONGEST_NAME {
            return Some(words!("the name of a colourway has 1 to {most} characters", most = LONGEST_NAME));
        }
        let is_twice = colourways[..i].iter().any(|other| other.name == colourway.name);
        is_twice
            .then(|| {
                words!("there are two colourways named \"{name}\"", name = within_quotes(&colourway.name))
            })
            .or(colourway.dyes.problem())
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_piece_has_its_own_dye_else_that_of_all() {
        let mut dyes = Dyes::default();
        assert!(dyes.is_plain());
        let print = Print { motif: Motif::Checks, repeat_m: 0.02, colour: [9; 3] };
        dyes.set(None, Dye { colour: Some([1; 3]), print: Some(print), image: None });
        dyes.set(Some(PieceId(2)), Dye { colour: Some([2; 3]), ..Dye::default() });
        assert_eq!(dyes.of(PieceId(1)), Dye { colour: Some([1; 3]), print: Some(print), image: None });
        assert_eq!(dyes.of(PieceId(2)), Dye { colour: Some([2; 3]), print: Some(print), image: None });
        dyes.set(Some(PieceId(2)), Dye::default());
        assert!(dyes.pieces.is_empty() && dyes.problem().is_none());
        dyes.set(None, Dye { print: Some(Print { repeat_m: f64::NAN, ..print }), ..Dye::default() });
        assert!(dyes.problem().is_some_and(|words| words.contains("NaN")));
        dyes.set(None, Dye { print: Some(Print { repeat_m: 2.5, ..print }), ..Dye::default() });
        let told = dyes.problem().map(|words| words.to_string());
        assert_eq!(told.as_deref(), Some("a print repeats every 1 to 2000 mm, not every 2500 mm"));
    }

    #[test]
    fn names_of_colourways_are_unique() {
        let named = |name: &str| Colourway {
            name: name.to_owned(),
            fabrics: Fabrics::default(),
            dyes: Dyes::default(),
        };
        assert_eq!(colourways_problem(&[named("a"), named("b")]), None);
        assert!(colourways_problem(&[named("a"), named("a")]).is_some_and(|words| words.contains("two")));
        assert!(colourways_problem(&[named(" ")]).is_some());
    }
}
