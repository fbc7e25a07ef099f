//! Computes and shows the maps of [`crate::fit::maps`] in both panes. A map is computed only while it is shown and after the
//! cloth has changed.

mod beside;
mod chooser;
mod comparison;
mod flat;
mod legend;
mod opening;
mod probe;
mod table;

use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

use crate::cloth::FlatPlace;
use crate::fit::maps::{Histogram, MapStats, PieceStats};
use crate::fit::{Map, MapKind};
use crate::render::{Legend, Palette, Rgb};
use crate::session::{Fabrics, Outfit};
use crate::sim::Snapshot;
use crate::ui::language::{decimal_sign, number, say, tr};
use crate::ui::scenery::body_look::BodyLook;
use crate::ui::scenery::map_colours::palette;
pub use beside::{beside_ui, opening_ui};
pub use chooser::{choices, chooser_ui};
pub use comparison::Comparison;
pub use legend::legend_ui;
pub use opening::Opening;
pub use probe::probe_ui;
pub use table::{table_ui, text as table_text};

/// The chosen map, and the last one computed.
#[derive(Debug, Default)]
pub struct MapView {
    kind: Option<MapKind>,
    /// Ranges set by the user, by map and whether it is a difference, in the units that people see.
    ranges: BTreeMap<(MapKind, bool), [f64; 2]>,
    shown: Option<ShownMap>,
    /// The other garment of a comparison.
    beside: Option<Comparison>,
    /// Whether the other garment is drawn on the left.
    on_the_left: bool,
    /// A comparison that is being opened.
    opening: Option<Opening>,
    /// Number of maps computed.
    computed: u64,
}

/// A computed map with its colours.
#[derive(Debug)]
pub struct ShownMap {
    outfit: Outfit,
    map: Map,
    /// Whether it is the difference to the garment beside.
    is_difference: bool,
    /// Whether the difference was requested; there is none if the pieces differ.
    asks_difference: bool,
    /// Statistics of all values.
    pub stats: MapStats,
    pieces: OnceLock<Vec<PieceStats>>,
    /// Values at the ends of the colour bar, in the unit of the map.
    range: [f64; 2],
    is_automatic: bool,
    /// A colour for each vertex of the cloth as it is drawn.
    pub colours: Arc<Vec<Rgb>>,
    histogram: Histogram,
}

impl MapView {
    /// The chosen map.
    pub fn kind(&self) -> Option<MapKind> {
        self.kind
    }

    /// Chooses a map.
    pub fn choose(&mut self, kind: Option<MapKind>) {
        self.kind = kind;
    }

    /// Sets the range that the colours of `kind` span, in the unit that people see; None: the range of its values.
    pub fn set_range(&mut self, kind: MapKind, range: Option<[f64; 2]>) {
        let of = (kind, self.shown.as_ref().is_some_and(|shown| shown.is_difference));
        match range {
            Some(range) => self.ranges.insert(of, range),
            None => self.ranges.remove(&of),
        };
    }

    /// Shows `other` beside; None ends the comparison.
    pub fn compare(&mut self, other: Option<Comparison>) {
        (self.beside, self.shown, self.opening) = (other, None, None);
    }

    /// Shows the result of `opening` beside once it is there.
    pub fn wait_for(&mut self, opening: Opening) {
        self.opening = Some(opening);
    }

    /// The comparison that is being opened.
    pub fn opening(&self) -> Option<&Opening> {
        self.opening.as_ref()
    }

    /// Shows a comparison that has finished opening. True if it does so now; the error says why it cannot be shown.
    pub fn take_opened(&mut self) -> Result<bool, String> {
        let Some(opened) = self.opening.as_ref().and_then(Opening::take) else { return Ok(false) };
        self.opening = None;
        self.compare(Some(opened?));
        Ok(true)
    }

    /// Whether the other garment is drawn on the left.
    pub fn is_on_the_left(&self) -> bool {
        self.on_the_left
    }

    /// Draws the other garment on the opposite side.
    pub fn change_sides(&mut self) {
        self.on_the_left = !self.on_the_left;
    }

    /// The other garment, while there is cloth to compare it with.
    pub fn beside(&self) -> Option<&Comparison> {
        self.beside.as_ref().filter(|beside| beside.meshes().is_some())
    }

    /// Switches between the map and its difference to the garment beside. If no map is chosen, that of the ease is.
    pub fn toggle_difference(&mut self) {
        if let Some(beside) = &mut self.beside {
            beside.difference = !beside.difference;
            self.kind = self.kind.or(Some(MapKind::Ease));
        }
    }

    /// Number of maps computed.
    pub fn computed(&self) -> u64 {
        self.computed
    }

    /// The map of the cloth at the last [`MapView::look`].
    pub fn shown(&self) -> Option<&ShownMap> {
        self.shown.as_ref()
    }

    /// Computes the chosen map of the cloth of `snapshot`, unless that was done before. `fabrics` are those of the cloth; a
    /// garment beside is on a body with `body_look`.
    pub fn look(&mut self, snapshot: &Snapshot, fabrics: &Fabrics, body_look: BodyLook) {
        let is_wanted = self.kind.is_some() || self.beside.is_some();
        let outfit = is_wanted.then(|| Outfit::of(snapshot, fabrics)).flatten();
        self.look_at(outfit.as_ref());
        let Some(beside) = &mut self.beside else { return };
        match &outfit {
            Some(outfit) => {
                let own = self.shown.as_ref().filter(|shown| !shown.is_difference);
                let colours = own.map(|shown| (shown.map.kind, shown.range, shown.palette()));
                beside.draw_beside(outfit, self.on_the_left, colours, body_look);
            }
            None => beside.put_away(),
        }
    }

    fn look_at(&mut self, outfit: Option<&Outfit>) {
        let (Some(kind), Some(outfit)) = (self.kind, outfit) else {
            self.shown = None;
            return;
        };
        let asks_difference = self.beside.as_ref().is_some_and(|beside| beside.difference);
        let by_hand = |ranges: &BTreeMap<(MapKind, bool), [f64; 2]>, is_difference| {
            ranges.get(&(kind, is_difference)).map(|range| range.map(|v| v / kind.unit().1))
        };
        if let Some(shown) = &mut self.shown
            && shown.map.kind == kind
            && shown.asks_difference == asks_difference
            && shown.outfit.is(outfit)
        {
            shown.span(by_hand(&self.ranges, shown.is_difference));
            return;
        }
        self.computed += 1;
        let map = Map::new(kind, outfit.worn());
        let compared = self.beside.as_mut().filter(|_| asks_difference);
        let difference = compared.and_then(|beside| beside.less(outfit, &map));
        let is_difference = difference.is_some();
        let map = difference.unwrap_or(map);
        let mut shown = ShownMap {
            outfit: outfit.clone(),
            is_difference,
            asks_difference,
            stats: map.stats(),
            pieces: OnceLock::new(),
            range: [f64::NAN; 2],
            is_automatic: false,
            colours: Arc::default(),
            histogram: Histogram { borders: Vec::new(), counts: Vec::new() },
            map,
        };
        shown.span(by_hand(&self.ranges, is_difference));
        self.shown = Some(shown);
    }
}

impl ShownMap {
    /// Sets the range of the colours to `by_hand`, or to that of the values.
    fn span(&mut self, by_hand: Option<[f64; 2]>) {
        self.is_automatic = by_hand.is_none();
        let automatic = || match self.is_difference {
            true => self.map.range_about_zero(&self.stats),
            false => self.map.range_of(&self.stats),
        };
        let range = by_hand.unwrap_or_else(automatic);
        if range == self.range {
            return;
        }
        let palette = self.palette();
        self.colours = Arc::new(self.map.vertices.iter().map(|&v| palette.colour(v, range)).collect());
        self.histogram = self.map.histogram(range);
        self.range = range;
    }

    /// The kind of the map.
    pub fn kind(&self) -> MapKind {
        self.map.kind
    }

    /// Title of the map in the language of the window.
    pub fn heading(&self) -> String {
        let kind = self.map.kind;
        match self.is_difference {
            true => say!("Difference of {map}", map = tr(&kind.short().to_lowercase())),
            false => tr(kind.title()).to_owned(),
        }
    }

    /// Title of the map in English, for files.
    pub fn title(&self) -> String {
        match self.is_difference {
            true => format!("Difference of {}", self.map.kind.short().to_lowercase()),
            false => self.map.kind.title().to_owned(),
        }
    }

    fn palette(&self) -> Palette {
        if self.is_difference { Palette::Diverging } else { palette(self.map.kind) }
    }

    /// The legend for pictures, in the language of the window.
    pub fn legend(&self) -> Legend {
        let (unit, times) = self.map.kind.unit();
        Legend {
            title: self.heading(),
            unit: unit.to_owned(),
            range: self.range.map(|v| v * times),
            palette: self.palette(),
            decimal_sign: decimal_sign(),
        }
    }

    /// The value at a place of the cloth; None where there is none.
    pub fn value(&self, place: FlatPlace) -> Option<f64> {
        let vertices = place.vertices(&self.outfit.garment);
        let value = vertices.iter().map(|&(v, share)| self.map.vertices[v as usize] * share).sum::<f64>();
        value.is_finite().then_some(value)
    }

    /// A value with its unit, such as "12.3 mm".
    pub fn words(&self, value: f64) -> String {
        let (unit, times) = self.map.kind.unit();
        format!("{} {unit}", number(value * times + 0.0, self.map.kind.digits()))
    }

    /// Statistics of each piece, computed when first needed.
    pub fn pieces(&self) -> &[PieceStats] {
        self.pieces.get_or_init(|| self.map.pieces(&self.outfit.garment))
    }
}
