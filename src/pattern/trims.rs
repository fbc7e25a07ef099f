//! Trims of edges and internal lines: fold lines (creases), elastic, topstitching, hems, piping and wrinkles.

use serde::{Deserialize, Serialize};

use crate::geometry::words::{Words, words};

/// Range of the strength of a fold line, N: moment per metre of the line and per radian.
pub const FOLD_STRENGTHS: std::ops::RangeInclusive<f64> = 1e-5..=10.0;

/// Range of the length of elastic, as a share of that of the cloth.
pub const ELASTIC_RATIOS: std::ops::RangeInclusive<f64> = 0.3..=1.0;
/// Range of the force of elastic at double length, N.
pub const ELASTIC_TENSIONS: std::ops::RangeInclusive<f64> = 0.1..=1000.0;

/// Range of the radius of piping, metres.
pub const PIPING_RADII: std::ops::RangeInclusive<f64> = 0.0005..=0.006;

/// Range of the width of a wrinkle, metres.
pub const WRINKLE_WIDTHS: std::ops::RangeInclusive<f64> = 0.005..=0.1;

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
    /// A covered cord is sewn in along the line. Where both sides of a seam name one, the seam has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub piping: Option<Piping>,
    /// The cloth is raised to a soft ridge along the line, or sunk to a valley. Only internal lines have one; on an edge of a closed
    /// line it has no effect.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wrinkle: Option<Wrinkle>,
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

/// Piping: a cord, covered with a strip of cloth, sewn in along an edge, a seam or a fold. Half of it shows on the outer side.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Piping {
    /// Radius of the covered cord, metres, within [`PIPING_RADII`].
    pub radius: f64,
    /// Colour of its cover, sRGB.
    pub colour: [u8; 3],
}

/// A wrinkle along a line: a soft ridge or valley whose profile across the line is H cos²(π d / W) at the distance d < W/2.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Wrinkle {
    /// Width W across the line, metres of cloth, within [`WRINKLE_WIDTHS`].
    pub width: f64,
    /// Height H, metres, -W/2..=W/2: positive towards the outer (front) side. Cloth does not stretch to it, so that a steep wrinkle
    /// is lower than this: at H = W/2, where its sides are upright, 3/4 as high ([`Wrinkle::risen`]).
    pub height: f64,
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

    /// Angle beyond which a fold turns over, radians: one part then lies on the other.
    pub const OVER: f64 = 120.0 * std::f64::consts::PI / 180.0;

    /// Whether one part is turned over on to the other, as the fall of a collar is. Cloth that is closed to a ring, or nearly, does
    /// not turn over once it stands: half-way its outer edge would have to be half as long again as the fold.
    pub fn turns_over(&self) -> bool {
        self.angle.abs() > Self::OVER
    }

    /// A pressed fold of `angle` radians.
    pub fn pressed(angle: f64) -> Self {
        Self { angle, strength: Self::PRESSED }
    }

    /// What is out of range, in words.
    pub fn problem(&self) -> Option<Words> {
        if !(-std::f64::consts::PI..=std::f64::consts::PI).contains(&self.angle) {
            return Some(words!(
                "a fold has an angle of -180 to 180 degrees, not {degrees}",
                degrees = self.angle.to_degrees()
            ));
        }
        let (least, most) = (FOLD_STRENGTHS.start(), FOLD_STRENGTHS.end());
        (!FOLD_STRENGTHS.contains(&self.strength)).then(|| {
            words!(
                "the strength of a fold is {least} to {most} N, not {strength}",
                least,
                most,
                strength = self.strength
            )
        })
    }
}

impl Elastic {
    /// Force of a waistband elastic 25 mm wide at double length, N.
    pub const WAISTBAND: f64 = 15.0;
    /// The elastic that a line is given first.
    pub const USUAL: Self = Self { ratio: 0.75, tension: Self::WAISTBAND };

    /// What is out of range, in words.
    pub fn problem(&self) -> Option<Words> {
        let within = |what: Words, value: f64, range: &std::ops::RangeInclusive<f64>| {
            beyond(what, value, *range.start(), *range.end())
        };
        within(words!("the length ratio of elastic"), self.ratio, &ELASTIC_RATIOS)
            .or_else(|| within(words!("the tension of elastic (N)"), self.tension, &ELASTIC_TENSIONS))
    }
}

/// "WHAT is LEAST to MOST, not VALUE", where that is so.
pub(in crate::pattern) fn beyond(what: Words, value: f64, least: f64, most: f64) -> Option<Words> {
    (!(least..=most).contains(&value))
        .then(|| words!("{what} is {least} to {most}, not {value}", what, least, most, value))
}

impl Topstitch {
    /// What is out of range, in words.
    pub fn problem(&self) -> Option<Words> {
        beyond(words!("the distance of topstitching (m)"), self.distance, 0.0, 0.1)
            .or_else(|| beyond(words!("the length of a stitch (m)"), self.length, 0.0005, 0.03))
            .or_else(|| beyond(words!("the number of rows of topstitching"), f64::from(self.rows), 1.0, 6.0))
            .or_else(|| {
                beyond(words!("the distance between rows of topstitching (m)"), self.spacing, 0.0005, 0.05)
            })
    }
}

impl Hem {
    /// The hem that an edge is given first.
    pub const USUAL: Self = Self { width: 0.02, colour: None };

    /// What is out of range, in words.
    pub fn problem(&self) -> Option<Words> {
        beyond(words!("the width of a hem (m)"), self.width, 0.003, 0.2)
    }
}

impl Piping {
    /// The piping that a line is given first: 3 mm thick.
    pub const USUAL: Self = Self { radius: 0.0015, colour: [168, 42, 48] };
    /// Mass of the covered cord in its volume, kg/m³: a third of that of cotton fibre, which is 1,540. That loosely twisted cord is
    /// one third fibre is an estimate; cord 3 mm thick then weighs 3.6 g/m.
    pub const DENSITY: f64 = 510.0;

    /// Mass of a metre, kg/m.
    pub fn kg_per_m(radius: f64) -> f64 {
        Self::DENSITY * std::f64::consts::PI * radius * radius
    }

    /// What is out of range, in words.
    pub fn problem(&self) -> Option<Words> {
        beyond(words!("the radius of piping (m)"), self.radius, *PIPING_RADII.start(), *PIPING_RADII.end())
    }
}

impl Wrinkle {
    /// The wrinkle that a line is given first.
    pub const USUAL: Self = Self { width: 0.04, height: 0.008 };

    /// What is out of range, in words.
    pub fn problem(&self) -> Option<Words> {
        let half = self.width / 2.0;
        beyond(
            words!("the width of a wrinkle (m)"),
            self.width,
            *WRINKLE_WIDTHS.start(),
            *WRINKLE_WIDTHS.end(),
        )
        .or_else(|| {
            beyond(words!("the height of a wrinkle (m), at most half its width,"), self.height, -half, half)
        })
    }

    /// The same with another width; the height stays at most half of it.
    pub fn as_wide_as(self, width: f64) -> Self {
        let width = width.clamp(*WRINKLE_WIDTHS.start(), *WRINKLE_WIDTHS.end());
        Self { width, ..self }.as_high_as(self.height)
    }

    /// The same with another height, at most half its width.
    pub fn as_high_as(self, height: f64) -> Self {
        Self { height: height.clamp(-self.width / 2.0, self.width / 2.0), ..self }
    }
}

impl Trims {
    /// Whether there are none.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Whether edges of the mesh must follow the line.
    pub fn needs_mesh(&self) -> bool {
        self.fold.is_some() || self.elastic.is_some() || self.piping.is_some() || self.wrinkle.is_some()
    }

    /// The trims that physics knows of.
    pub fn physical(&self) -> Self {
        Self {
            topstitch: None,
            hem: self.hem.map(|hem| Hem { colour: None, ..hem }),
            piping: self.piping.map(|piping| Piping { colour: [0; 3], ..piping }),
            ..*self
        }
    }

    /// The first thing out of range, in words.
    pub fn problem(&self) -> Option<Words> {
        let Self { fold, elastic, topstitch, hem, piping, wrinkle } = self;
        fold.and_then(|fold| fold.problem())
            .or_else(|| elastic.and_then(|elastic| elastic.problem()))
            .or_else(|| topstitch.and_then(|topstitch| topstitch.problem()))
            .or_else(|| hem.and_then(|hem| hem.problem()))
            .or_else(|| piping.and_then(|piping| piping.problem()))
            .or_else(|| wrinkle.and_then(|wrinkle| wrinkle.problem()))
    }
}

impl From<Fold> for Trims {
    fn from(fold: Fold) -> Self {
        Self { fold: Some(fold), ..Self::default() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::Edge;

    #[test]
    fn files_without_piping_are_read_and_written_as_before() {
        let old = r#"{"start":[0.5,0.25],"shape":"line","trims":{"hem":{"width":0.02}}}"#;
        let mut edge: Edge = serde_json::from_str(old).expect("an edge");
        assert_eq!(edge.trims.piping, None);
        assert_eq!(serde_json::to_string(&edge).expect("text"), old);
        edge.trims.piping = Some(Piping::USUAL);
        let text = serde_json::to_string(&edge).expect("text");
        assert!(text.contains(r#""piping":{"radius":0.0015,"colour":[168,42,48]}"#), "{text}");
        assert_eq!(serde_json::from_str::<Edge>(&text).expect("an edge"), edge);
    }

    #[test]
    fn piping_has_a_radius_within_its_range_and_its_colour_is_not_physical() {
        let of = |radius| Trims { piping: Some(Piping { radius, ..Piping::USUAL }), ..Trims::default() };
        assert_eq!([0.0005, 0.0015, 0.006].map(|radius| of(radius).problem()), [None, None, None]);
        for radius in [0.0, 0.0004, 0.0061, -0.001, f64::NAN, f64::INFINITY] {
            let problem = of(radius).problem().expect("a problem");
            assert!(problem.starts_with("the radius of piping (m) is 0.0005 to 0.006, not "), "{problem}");
        }
        let dyed = Trims { piping: Some(Piping { colour: [9; 3], ..Piping::USUAL }), ..Trims::default() };
        assert_eq!(dyed.physical(), of(Piping::USUAL.radius).physical());
        assert!(dyed.physical() != of(0.003).physical() && dyed.needs_mesh());
    }

    #[test]
    fn a_wrinkle_is_kept_in_files_and_bad_ones_are_refused_in_words() {
        let old = r#"{"start":[0.5,0.25],"shape":"line","trims":{"hem":{"width":0.02}}}"#;
        let mut edge: Edge = serde_json::from_str(old).expect("an edge");
        assert_eq!(edge.trims.wrinkle, None);
        edge.trims.wrinkle = Some(Wrinkle { width: 0.03, height: -0.005 });
        let text = serde_json::to_string(&edge).expect("text");
        assert!(text.contains(r#""wrinkle":{"width":0.03,"height":-0.005}"#), "{text}");
        assert_eq!(serde_json::from_str::<Edge>(&text).expect("an edge"), edge);
        let of = |width, height| Trims { wrinkle: Some(Wrinkle { width, height }), ..Trims::default() };
        for (width, height) in [(0.005, 0.0025), (0.1, -0.05), (0.04, 0.0)] {
            assert_eq!(of(width, height).problem(), None);
        }
        for width in [0.0, 0.0049, 0.101, -0.04, f64::NAN, f64::INFINITY] {
            let problem = of(width, 0.0).problem().expect("a problem");
            assert!(problem.starts_with("the width of a wrinkle (m) is 0.005 to 0.1, not "), "{problem}");
        }
        for height in [0.0201, -0.0201, f64::NAN, f64::INFINITY] {
            let problem = of(0.04, height).problem().expect("a problem");
            let words = "the height of a wrinkle (m), at most half its width, is -0.02 to 0.02, not ";
            assert!(problem.starts_with(words), "{problem}");
        }
        let steep = Wrinkle { width: 0.04, height: 0.02 };
        assert_eq!(steep.as_wide_as(0.01), Wrinkle { width: 0.01, height: 0.005 });
        assert_eq!(steep.as_high_as(-1.0), Wrinkle { width: 0.04, height: -0.02 });
        assert!(of(0.04, 0.01).needs_mesh() && of(0.04, 0.01).physical() == of(0.04, 0.01));
    }
}
