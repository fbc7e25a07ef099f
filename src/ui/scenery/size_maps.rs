//! Maps of several sizes of a garment in the same colours.

use crate::fit::{Map, MapKind};
use crate::render::{Legend, Rgb};
use crate::session::Outfit;
use crate::ui::language::{decimal_sign, tr};
use crate::ui::scenery::map_colours::{colours, palette};

/// A map of each size, and the range of all of them.
#[derive(Debug)]
pub struct SizeMaps {
    kind: MapKind,
    maps: Vec<Map>,
    range: [f64; 2],
}

impl SizeMaps {
    /// Maps of this kind of all `outfits`.
    pub fn new<'a>(kind: MapKind, outfits: impl Iterator<Item = &'a Outfit>) -> Self {
        let maps: Vec<Map> = outfits.map(|outfit| Map::new(kind, outfit.worn())).collect();
        let ranges = maps.iter().map(Map::range);
        let range = ranges.reduce(|a, b| [a[0].min(b[0]), a[1].max(b[1])]).unwrap_or([0.0, 1.0]);
        Self { kind, maps, range }
    }

    /// A colour for each vertex of outfit number `i`.
    pub fn colours(&self, i: usize) -> Vec<Rgb> {
        colours(self.kind, &self.maps[i].vertices, self.range)
    }

    /// The legend of the size called `name`, in the language that is shown.
    pub fn legend(&self, name: &str) -> Legend {
        let (unit, times) = self.kind.unit();
        let title = format!("{name}: {}", tr(self.kind.short()));
        Legend {
            title,
            unit: unit.to_owned(),
            range: self.range.map(|v| v * times),
            palette: palette(self.kind),
            decimal_sign: decimal_sign(),
        }
    }
}
