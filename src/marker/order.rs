//! What is to be cut, on which cloth, and what may be turned.

use crate::geometry::words::{Words, decimal, within_quotes, words};
use crate::marker::nest::Effort;
use crate::pattern::Pattern;

/// Most pieces on one marker.
pub const MOST_PIECES: usize = 400;
/// The widest cloth, metres.
pub const WIDEST: f64 = 20.0;
/// The widest gap, metres.
const WIDEST_GAP: f64 = 0.2;
/// The largest tilt, radians.
const MOST_TILT: f64 = std::f64::consts::FRAC_PI_4;

/// An order of garments.
#[derive(Clone, Debug, PartialEq)]
pub struct Order {
    /// Names of sizes, and how many garments of each; a pattern without sizes has one, with an empty name.
    pub garments: Vec<(String, usize)>,
    /// Width of the cloth that can be used, metres.
    pub width: f64,
    /// Least distance between pieces, metres.
    pub gap: f64,
    /// Whether the cloth has a nap or a one-way print, so that all pieces point the same way.
    pub nap: bool,
    /// By how much a piece may be tilted out of the grain, radians.
    pub tilt: f64,
    /// What may be spent on the layout.
    pub effort: Effort,
}

impl Default for Order {
    fn default() -> Self {
        let effort = Effort { seconds: 5.0, seed: 1 };
        Self { garments: Vec::new(), width: 1.5, gap: 0.003, nap: false, tilt: 0.0, effort }
    }
}

/// Why there is no marker.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}", self.words())]
pub enum MarkerError {
    /// The pattern has no pieces.
    Empty,
    /// Every quantity is 0.
    Nothing,
    /// A size that there is not, told in words.
    Size(Words),
    /// A number that cannot be, told in words.
    Number(Words),
    /// A piece does not fit the cloth.
    TooWide { piece: String, needs: f64, width: f64 },
    /// More pieces than [`MOST_PIECES`].
    TooMany(usize),
    /// A piece whose outline encloses nothing.
    NoArea(String),
    /// It was stopped.
    Stopped,
}

impl MarkerError {
    /// The error in words, with lengths in centimetres.
    pub fn words(&self) -> Words {
        self.words_by(&|metres| words!("{cm} cm", cm = decimal(metres * 100.0, 1)))
    }

    /// The error in words, with lengths (metres) told by `length`.
    pub fn words_by(&self, length: &dyn Fn(f64) -> Words) -> Words {
        match self {
            Self::Empty => words!("the pattern has no pieces to cut"),
            Self::Nothing => words!("no garment is asked for: give a size a quantity of 1 or more"),
            Self::Size(words) | Self::Number(words) => words.clone(),
            Self::TooWide { piece, needs, width } => words!(
                "\"{name}\" needs cloth of {needs}, and this is {width} wide",
                name = within_quotes(piece),
                needs = length(*needs),
                width = length(*width)
            ),
            Self::TooMany(n) => {
                words!("{n} pieces would be cut; a marker holds {most}: make several", n, most = MOST_PIECES)
            }
            Self::NoArea(piece) => {
                words!("\"{name}\" encloses no cloth: its outline has no area", name = within_quotes(piece))
            }
            Self::Stopped => words!("the layout was stopped"),
        }
    }
}

/// The garments of an order by words: one of each of `sizes`, or for `quantities` such as "M=2" that many; "3" alone means the
/// base size, and so does nothing at all.
///
/// # Errors
/// A word that is no quantity, or a size that there is not.
pub fn garments(
    pattern: &Pattern,
    sizes: &[String],
    quantities: &[String],
) -> Result<Vec<(String, usize)>, MarkerError> {
    let base = || pattern.sizes.base_name().to_owned();
    let mut all: Vec<(String, usize)> = sizes.iter().map(|size| (size.trim().to_owned(), 1)).collect();
    for words in quantities {
        let (size, number) = match words.rsplit_once('=') {
            Some((size, number)) => (size.trim().to_owned(), number),
            None => (base(), words.as_str()),
        };
        let number = number.trim().parse().map_err(|_| {
            MarkerError::Number(words!(
                "\"{words}\" is no quantity: it is written SIZE=N, such as M=2, or N",
                words = within_quotes(words)
            ))
        })?;
        all.push((size, number));
    }
    if all.is_empty() {
        all.push((base(), 1));
    }
    for (size, _) in &all {
        if !(pattern.sizes.is_empty() && size.is_empty()) {
            pattern.sizes.number(size).map_err(MarkerError::Size)?;
        }
    }
    Ok(all)
}

impl Order {
    /// Refuses numbers that no cloth has.
    pub(super) fn check(&self) -> Result<(), MarkerError> {
        let Self { garments, width, gap, nap: _, tilt, effort } = self;
        let wrong = |words: Words| Err(MarkerError::Number(words));
        if !(*width > 0.0 && *width <= WIDEST) {
            return wrong(words!(
                "cloth {width} m wide: it must be more than 0 and at most {most}",
                width = *width,
                most = WIDEST
            ));
        }
        if !(0.0..=WIDEST_GAP).contains(gap) {
            return wrong(words!("a gap of {gap} m: it must be 0 to {most}", gap = *gap, most = WIDEST_GAP));
        }
        if !(0.0..=MOST_TILT).contains(tilt) {
            return wrong(words!(
                "a tilt of {degrees} degrees: it must be 0 to 45",
                degrees = decimal(tilt.to_degrees(), 1)
            ));
        }
        if !(effort.seconds >= 0.0 && effort.seconds.is_finite()) {
            return wrong(words!("{seconds} seconds: it must be 0 or more", seconds = effort.seconds));
        }
        if garments.iter().all(|(_, count)| *count == 0) {
            return Err(MarkerError::Nothing);
        }
        Ok(())
    }
}
