//! Statistics of a map: over the garment and piece by piece, with a histogram.

use serde::Serialize;

use crate::cloth::Garment;
use crate::fit::maps::Map;
use crate::fit::shape::quantile;

/// Bins of a histogram.
const BARS: usize = 32;

/// Statistics of the values at some vertices, in the unit of the map's kind (metres, radians, ratios).
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct MapStats {
    /// Number of vertices with a value.
    pub count: usize,
    /// Minimum.
    pub min: f64,
    /// 1st percentile.
    pub p01: f64,
    /// Median.
    pub median: f64,
    /// Mean.
    pub mean: f64,
    /// 99th percentile.
    pub p99: f64,
    /// Maximum.
    pub max: f64,
}

/// Statistics of one piece.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct PieceStats {
    /// Name of the piece.
    pub piece: String,
    /// Over the vertices of the piece, including those on its seams.
    #[serde(flatten)]
    pub stats: MapStats,
}

/// Histogram of the values at vertices.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Histogram {
    /// Bin edges, ascending, one more than bins.
    pub borders: Vec<f64>,
    /// Values in each bin; a value on an edge belongs to the upper bin, values beyond the ends to the first or last bin.
    pub counts: Vec<usize>,
}

impl Map {
    /// Statistics over the whole garment.
    pub fn stats(&self) -> MapStats {
        stats(self.vertices.iter().copied())
    }

    /// Statistics piece by piece, in id order.
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

    /// Range of the legend: 1st to 99th percentile, symmetric about zero where signs matter, else including zero.
    pub fn range(&self) -> [f64; 2] {
        self.range_of(&self.stats())
    }

    /// The result of [`Map::range`], given the result of [`Map::stats`].
    pub fn range_of(&self, stats: &MapStats) -> [f64; 2] {
        if self.kind.is_signed() {
            return self.range_about_zero(stats);
        }
        [stats.p01.min(0.0), stats.p99]
    }

    /// Range symmetric about zero that covers the 1st and 99th percentiles: for differences of values, whatever the kind.
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
