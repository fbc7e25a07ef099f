//! What a marker takes: length, yield, consumption and the piece list.

use glam::DVec2;
use serde::Serialize;

use crate::geometry::words::{Words, decimal, words};
use crate::marker::layout::Marker;
use crate::pattern::Pattern;

/// A size, and how many garments of it are cut.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Garments {
    /// Name of the size; empty where the pattern has none.
    pub size: String,
    pub count: usize,
}

/// A piece of the pattern in one size.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PieceRow {
    pub name: String,
    pub size: String,
    /// How many of it are cut.
    pub count: usize,
    /// Area of one within its cutting line, square metres.
    pub area: f64,
    /// Name of the piece that is its mirror image, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub twin: Option<String>,
}

/// Where a piece lies.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PlaceRow {
    pub name: String,
    pub size: String,
    /// Number of its garment among those of its size, from 1.
    pub garment: usize,
    /// The middle of its bounding box: along the cloth and across it, metres.
    pub at: DVec2,
    /// How it is turned, degrees.
    pub turned: f64,
}

/// The report on a marker.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MarkerReport {
    pub version: &'static str,
    pub name: String,
    /// Width of the cloth, metres.
    pub width: f64,
    /// Length of cloth that the layout takes, metres.
    pub length: f64,
    /// Share of that cloth which is in pieces, percent.
    pub yield_percent: f64,
    /// Area of all pieces within their cutting lines, square metres.
    pub area: f64,
    /// Length of cloth for each garment, metres.
    pub length_per_garment: f64,
    /// Length that the bounding boxes would take in columns, metres.
    pub plain_length: f64,
    pub gap: f64,
    pub nap: bool,
    /// Degrees by which pieces might be tilted.
    pub tilt: f64,
    pub seed: u64,
    pub garments: Vec<Garments>,
    pub pieces: Vec<PieceRow>,
    pub places: Vec<PlaceRow>,
    /// What cannot be cut as it is, in words.
    pub problems: Vec<Words>,
}

impl MarkerReport {
    /// The report on `marker`, made of the pattern called `name`.
    pub fn new(name: &str, pattern: &Pattern, marker: &Marker) -> Self {
        let order = &marker.order;
        let garments = order.garments.iter().filter(|garment| garment.1 > 0);
        Self {
            version: env!("CARGO_PKG_VERSION"),
            name: name.to_owned(),
            width: order.width,
            length: marker.length,
            yield_percent: marker.share() * 100.0,
            area: marker.area,
            length_per_garment: marker.length / marker.garments() as f64,
            plain_length: marker.plain_length,
            gap: order.gap,
            nap: order.nap,
            tilt: order.tilt.to_degrees(),
            seed: order.effort.seed,
            garments: garments.map(|(size, count)| Garments { size: size.clone(), count: *count }).collect(),
            pieces: piece_rows(pattern, marker),
            places: place_rows(pattern, marker),
            problems: marker.problems.clone(),
        }
    }

    /// The result in a few lines, for people.
    pub fn words(&self) -> Vec<Words> {
        let garments: Vec<String> =
            self.garments
                .iter()
                .map(|g| {
                    if g.size.is_empty() { g.count.to_string() } else { format!("{} × {}", g.count, g.size) }
                })
                .collect();
        let way = if self.nap { words!("all one way") } else { words!("either way") };
        let cloth = words!(
            "{length} m of cloth {width} m wide; {percent} % of it in pieces",
            length = decimal(self.length, 3),
            width = decimal(self.width, 3),
            percent = decimal(self.yield_percent, 1)
        );
        let garments = words!(
            "{n} pieces, garments: {garments}; {length} m for each; gap {mm} mm, {way}",
            n = self.places.len(),
            garments = garments.join(", "),
            length = decimal(self.length_per_garment, 3),
            mm = decimal(self.gap * 1000.0, 1),
            way
        );
        vec![cloth, garments]
    }
}

fn piece_rows(pattern: &Pattern, marker: &Marker) -> Vec<PieceRow> {
    let mut rows: Vec<PieceRow> = Vec::new();
    for placed in &marker.placed {
        let piece = &pattern.pieces[&placed.id];
        if placed.garment > 1 {
            if let Some(row) = rows.last_mut() {
                row.count += 1;
            }
            continue;
        }
        let twin = piece.twin.and_then(|id| pattern.pieces.get(&id)).map(|twin| twin.name.clone());
        let area = crate::geometry::polygon::signed_area(&placed.outline).abs();
        rows.push(PieceRow { name: piece.name.clone(), size: placed.size.clone(), count: 1, area, twin });
    }
    rows
}

fn place_rows(pattern: &Pattern, marker: &Marker) -> Vec<PlaceRow> {
    let row = |placed: &crate::marker::layout::Placed| {
        let lower = placed.outline.iter().copied().reduce(DVec2::min).unwrap_or_default();
        let upper = placed.outline.iter().copied().reduce(DVec2::max).unwrap_or_default();
        PlaceRow {
            name: pattern.pieces[&placed.id].name.clone(),
            size: placed.size.clone(),
            garment: placed.garment,
            at: (lower + upper) / 2.0,
            turned: placed.turn.to_degrees(),
        }
    };
    marker.placed.iter().map(row).collect()
}
