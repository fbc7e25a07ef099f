//! Colours of the values of a map.

use crate::fit::MapKind;
use crate::render::{Palette, Rgb};

/// The colours for values of `kind`.
pub fn palette(kind: MapKind) -> Palette {
    if kind.is_signed() { Palette::Diverging } else { Palette::Sequential }
}

/// The colour of each of `values`, which are of `kind`; `range` are the values at the ends of the palette.
pub fn colours(kind: MapKind, values: &[f64], range: [f64; 2]) -> Vec<Rgb> {
    let palette = palette(kind);
    values.iter().map(|&v| palette.colour(v, range)).collect()
}
