//! The list of maps: add a map here first. Menus, legend and command line follow from [`MapKind::ALL`].

use serde::{Deserialize, Serialize};

/// Quantity shown by a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MapKind {
    /// Strain along the grain: length over flat length, minus one.
    Warp,
    /// Strain across the grain: length over flat length, minus one.
    Weft,
    /// Shear: how much smaller than a right angle the angle between grain and weft is, radians.
    Shear,
    /// Change of area: area over flat area, minus one.
    Area,
    /// Ease: distance from the body, metres; negative inside.
    Ease,
    /// Paper C's curvature: the largest angle between the normals of two triangles that share the vertex, radians.
    Curvature,
    /// Mean curvature (half the sum of the principal curvatures), 1/m; positive where the front side bulges out.
    MeanCurvature,
    /// Strain along seams: length over the mean flat length of both sides, minus one. Only on seams.
    Seams,
    /// Pressure of the cloth on the skin, Pa. Only where it touches the skin.
    Pressure,
}

impl MapKind {
    /// Every kind, in the order of menus.
    pub const ALL: [Self; 9] = [
        Self::Warp,
        Self::Weft,
        Self::Shear,
        Self::Area,
        Self::Ease,
        Self::Curvature,
        Self::MeanCurvature,
        Self::Seams,
        Self::Pressure,
    ];

    /// Name on the command line and in file names.
    pub fn name(self) -> &'static str {
        match self {
            Self::Warp => "warp",
            Self::Weft => "weft",
            Self::Shear => "shear",
            Self::Area => "area",
            Self::Ease => "ease",
            Self::Curvature => "curvature",
            Self::MeanCurvature => "mean-curvature",
            Self::Seams => "seams",
            Self::Pressure => "pressure",
        }
    }

    /// Title for the user.
    pub fn title(self) -> &'static str {
        match self {
            Self::Warp => "Warp strain: along the grain",
            Self::Weft => "Weft strain: across the grain",
            Self::Shear => "Shear",
            Self::Area => "Change of area",
            Self::Ease => "Ease: gap to the body",
            Self::Curvature => "Largest angle at the vertex",
            Self::MeanCurvature => "Mean curvature",
            Self::Seams => "Strain along seams",
            Self::Pressure => "Pressure on the skin",
        }
    }

    /// Short title for a button.
    pub fn short(self) -> &'static str {
        match self {
            Self::Warp => "Warp strain",
            Self::Weft => "Weft strain",
            Self::Shear => "Shear",
            Self::Area => "Area",
            Self::Ease => "Ease",
            Self::Curvature => "Angles",
            Self::MeanCurvature => "Curvature",
            Self::Seams => "Seams",
            Self::Pressure => "Pressure",
        }
    }

    /// Tooltip.
    pub fn tip(self) -> &'static str {
        match self {
            Self::Warp => "How much the cloth is stretched along its grainline",
            Self::Weft => "How much the cloth is stretched across its grainline",
            Self::Shear => "By how much warp and weft no longer cross at a right angle",
            Self::Area => "How much larger the cloth is than it lies flat",
            Self::Ease => "How far the cloth is from the skin",
            Self::Curvature => "How sharply the cloth is folded at each point",
            Self::MeanCurvature => "Where the cloth bulges out and where it is hollow",
            Self::Seams => "How much seams are stretched",
            Self::Pressure => "How hard the cloth presses where it lies on the skin",
        }
    }

    /// Display unit, and the factor from the value to that unit.
    pub fn unit(self) -> (&'static str, f64) {
        match self {
            Self::Warp | Self::Weft | Self::Area | Self::Seams => ("%", 100.0),
            Self::Shear | Self::Curvature => ("deg", 180.0 / std::f64::consts::PI),
            Self::Ease => ("mm", 1000.0),
            Self::MeanCurvature => ("1/m", 1.0),
            Self::Pressure => ("kPa", 1e-3),
        }
    }

    /// Whether positive and negative values have opposite meanings: the palette is then centred on zero.
    pub fn is_signed(self) -> bool {
        match self {
            Self::Warp | Self::Weft | Self::Shear | Self::Area | Self::MeanCurvature | Self::Seams => true,
            Self::Ease | Self::Curvature | Self::Pressure => false,
        }
    }

    /// Digits after the decimal point of a value in its display unit.
    pub fn digits(self) -> usize {
        if self == Self::Pressure { 2 } else { 1 }
    }
}

impl std::str::FromStr for MapKind {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        Self::ALL.into_iter().find(|kind| kind.name() == text).ok_or_else(|| {
            format!("there is no map {text:?}; there are {}", Self::ALL.map(Self::name).join(", "))
        })
    }
}
