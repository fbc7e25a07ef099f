//! Trims of edges and internal lines: fold lines (creases), elastic, topstitching and hems.

use serde::{Deserialize, Serialize};

/// Range of the strength of a fold line, N: moment per metre of the line and per radian.
pub const FOLD_STRENGTHS: std::ops::RangeInclusive<f64> = 1e-5..=10.0;

/// Range of the length of elastic, as a share of that of the cloth.
pub const ELASTIC_RATIOS: std::ops::RangeInclusive<f64> = 0.3..=1.0;
/// Range of the force of elastic at double length, N.
pub const ELASTIC_TENSIONS: std::ops::RangeInclusive<f64> = 0.1..=1000.0;

/// What is worked along one edge of a closed line or of an internal line. Each edge carries its own, so that it follows when
/// edges are split, mirrored or numbered anew.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Trims {
    /// The cloth is creased here.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fold: Option<Fold>,
    /// Elastic is sewn on here.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub elastic: Option<Elastic>,
    /// Rows of stitches that are seen, along the line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub topstitch: Option<Topstitch>,
    /// The edge is turned in and sewn down.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub hem: Option<Hem>,
}

/// Topstitching: rows of stitches along a line, on the cloth side of an edge.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Topstitch {
    /// Distance of the first row from the line, metres, 0..=0.1.
    pub distance: f64,
    /// Length of a stitch, metres, 0.0005..=0.03.
    pub length: f64,
    /// Number of rows, 1..=6.
    pub rows: u8,
    /// Distance between two rows, metres, 0.0005..=0.05.
    pub spacing: f64,
    /// Colour of the thread, sRGB.
    pub colour: [u8; 3],
}

impl Default for Topstitch {
    fn default() -> Self {
        Self { distance: 0.006, length: 0.003, rows: 1, spacing: 0.006, colour: [246, 243, 232] }
    }
}

/// A hem: cloth outside the outline that is turned in along it. It lies double up to `width`, and is stiffer there.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Hem {
    /// Width of the doubled cloth, metres, 0.003..=0.2.
    pub width: f64,
    /// Colour of its stitches, sRGB; None: that of plain thread.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub colour: Option<[u8; 3]>,
}

/// Elastic sewn along a line: it gathers the cloth to its own length, and stretches up to that of the cloth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Elastic {
    /// Length at rest as a share of that of the cloth, within [`ELASTIC_RATIOS`].
    pub ratio: f64,
    /// Force at double length, N, within [`ELASTIC_TENSIONS`].
    pub tension: f64,
}

/// A fold line: draped cloth is creased along it. On a seam it is the angle of the sewn seam.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fold {
    /// Angle at rest by which one side is turned out of the plane of the other, radians, -π..=π: 0 flat, positive towards the
    /// outer (front) side, ±π folded double.
    pub angle: f64,
    /// Moment per metre of the line and per radian away from the angle, N, within [`FOLD_STRENGTHS`].
    pub strength: f64,
}

impl Fold {
    /// Strength of a crease pressed with an iron, N.
    pub const PRESSED: f64 = 0.02;

    /// A pressed fold of `angle` radians.
    pub fn pressed(angle: f64) -> Self {
        Self { angle, strength: Self::PRESSED }
    }

    /// What is out of range, in words.
    pub fn problem(&self) -> Option<String> {
        if !(-std::f64::consts::PI..=std::f64::consts::PI).contains(&self.angle) {
            return Some(format!(
                "a fold has an angle of -180 to 180 degrees, not {}",
                self.angle.to_degrees()
            ));
        }
        let (least, most) = (FOLD_STRENGTHS.start(), FOLD_STRENGTHS.end());
        (!FOLD_STRENGTHS.contains(&self.strength))
            .then(|| format!("the strength of a fold is {least} to {most} N, not {}", self.strength))
    }
}

impl Elastic {
    /// Force of a waistband elastic 25 mm wide at double length, N.
    pub const WAISTBAND: f64 = 15.0;
    /// The elastic that a line is given first.
    pub const USUAL: Self = Self { ratio: 0.75, tension: Self::WAISTBAND };

    /// What is out of range, in words.
    pub fn problem(&self) -> Option<String> {
        let within = |what: &str, value: f64, range: &std::ops::RangeInclusive<f64>| {
            beyond(what, value, *range.start(), *range.end())
        };
        within("the length ratio of elastic", self.ratio, &ELASTIC_RATIOS)
            .or_else(|| within("the tension of elastic (N)", self.tension, &ELASTIC_TENSIONS))
    }
}

/// "WHAT is LEAST to MOST, not VALUE", where that is so.
fn beyond(what: &str, value: f64, least: f64, most: f64) -> Option<String> {
    (!(least..=most).contains(&value)).then(|| format!("{what} is {least} to {most}, not {value}"))
}

impl Topstitch {
    /// What is out of range, in words.
    pub fn problem(&self) -> Option<String> {
        beyond("the distance of topstitching (m)", self.distance, 0.0, 0.1)
            .or_else(|| beyond("the length of a stitch (m)", self.length, 0.0005, 0.03))
            .or_else(|| beyond("the number of rows of topstitching", f64::from(self.rows), 1.0, 6.0))
            .or_else(|| beyond("the distance between rows of topstitching (m)", self.spacing, 0.0005, 0.05))
    }
}

impl Hem {
    /// The hem that an edge is given first.
    pub const USUAL: Self = Self { width: 0.02, colour: None };

    /// What is out of range, in words.
    pub fn problem(&self) -> Option<String> {
        beyond("the width of a hem (m)", self.width, 0.003, 0.2)
    }
}

impl Trims {
    /// Whether there are none.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Whether edges of the mesh must follow the line.
    pub fn needs_mesh(&self) -> bool {
        self.fold.is_some() || self.elastic.is_some()
    }

    /// The trims that physics knows of.
    pub fn physical(&self) -> Self {
        Self { topstitch: None, hem: self.hem.map(|hem| Hem { colour: None, ..hem }), ..*self }
    }

    /// The first thing out of range, in words.
    pub fn problem(&self) -> Option<String> {
        let Self { fold, elastic, topstitch, hem } = self;
        fold.and_then(|fold| fold.problem())
            .or_else(|| elastic.and_then(|elastic| elastic.problem()))
            .or_else(|| topstitch.and_then(|topstitch| topstitch.problem()))
            .or_else(|| hem.and_then(|hem| hem.problem()))
    }
}

impl From<Fold> for Trims {
    fn from(fold: Fold) -> Self {
        Self { fold: Some(fold), ..Self::default() }
    }
}
