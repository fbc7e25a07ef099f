//! A map in figures: over the garment and piece by piece, with a histogram.

use serde::Serialize;

use crate::cloth::Garment;
use crate::fit::maps::Map;
use crate::fit::shape::quantile;

/// Bars of a histogram.
const BARS: usize = 32;

/// Of the values at some vertices, in the unit of the map's kind (metres, radians, shares).
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct MapStats {
    /// How many vertices have a value.
    pub count: usize,
    /// The smallest.
    pub min: f64,
    /// One of 100 is smaller.
    pub p01: f64,
    /// The middle one.
    pub median: f64,
    /// The mean.
    pub mean: f64,
    /// 99 of 100 are smaller.
    pub p99: f64,
    /// The largest.
    pub max: f64,
}

/// Of one piece.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PieceStats {
    /// Its name.
    pub piece: String,
    /// Over its vertices, those on its seams with it.
    #[serde(flatten)]
    pub stats: MapStats,
}

/// How many values fall where.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Histogram {
    /// Borders of the bars, ascending, one more than bars.
    pub borders: Vec<f64>,
    /// Values in each bar; a value on a border belongs to the upper one, those beyond the ends to the last bar there.
    pub counts: Vec<usize>,
}

impl Map {
    /// Over the whole garment.
    pub fn stats(&self) -> MapStats {
        stats(self.vertices.iter().copied())
    }

    /// Piece by piece, in id order.
    pub fn pieces(&self, garment: &Garment) -> Vec<PieceStats> {
        let of_piece = |id| {
            let mut vertices: Vec<u32> =
                garment.corners.iter().filter(|c| c.piece == id).map(|c| c.vertex).collect();
            vertices.sort_unstable();
            vertices.dedup();
            stats(vertices.into_iter().map(|v| self.vertices[v as usize]))
        };
        garment
            .pieces
            .iter()
            .map(|(id, name)| PieceStats { piece: name.clone(), stats: of_piece(*id) })
            .collect()
    }

    /// What its legend spans: from the first to the last hundredth, about zero where the signs matter.
    pub fn range(&self) -> [f64; 2] {
        self.range_of(&self.stats())
    }

    /// The same, where [`Map::stats`] are known.
    pub fn range_of(&self, stats: &MapStats) -> [f64; 2] {
        if self.kind.is_signed() {
            return self.range_about_zero(stats);
        }
        [stats.p01.min(0.0), stats.p99]
    }

    /// As far to both sides of zero as the hundredths of the values reach: for values that are a difference, whatever the kind.
    pub fn range_about_zero(&self, stats: &MapStats) -> [f64; 2] {
        let most = stats.p01.abs().max(stats.p99.abs());
        [-most, most]
    }

    /// The histogram over `range`.
    pub fn histogram(&self, range: [f64; 2]) -> Histogram {
        let width = (range[1] - range[0]) / BARS as f64;
        let mut counts = vec![0; BARS];
        for value in self.vertices.iter().filter(|v| v.is_finite()) {
            let bar = if width > 0.0 { ((value - range[0]) / width).floor() } else { 0.0 };
            counts[bar.clamp(0.0, (BARS - 1) as f64) as usize] += 1;
        }
        Histogram { borders: (0..=BARS).map(|i| range[0] + width * i as f64).collect(), counts }
    }
}

fn stats(values: impl Iterator<Item = f64>) -> MapStats {
    let mut sorted: Vec<f64> = values.filter(|v| v.is_finite()).collect();
    sorted.sort_unstable_by(f64::total_cmp);
    let (Some(&min), Some(&max)) = (sorted.first(), sorted.last()) else { return MapStats::default() };
    MapStats {
        count: sorted.len(),
        min,
        p01: quantile(&sorted, 0.01),
        median: quantile(&sorted, 0.5),
        mean: sorted.iter().sum::<f64>() / sorted.len() as f64,
        p99: quantile(&sorted, 0.99),
        max,
    }
}
