//! Options of a picture.

use std::ops::RangeInclusive;

use clap::Args;

use crate::render::{Fineness, Lens, Light, View};
use crate::ui::scenery::body_look::BodyLook;

/// Distances at which a lens may be focused, metres.
const FOCUS: RangeInclusive<f32> = 0.01..=1000.0;

/// Options of a picture.
#[derive(Clone, Copy, Debug, Args)]
pub struct PictureOptions {
    /// The view: front, back, left, right, top, below, three-quarter, or YAW,PITCH in degrees
    #[arg(long, default_value = "front", value_parser = view, allow_hyphen_values = true)]
    pub view: View,
    /// Width and height in pixels
    #[arg(long, default_value = "1280x800", value_parser = size)]
    pub size: [u32; 2],
    /// Draws neither background nor floor
    #[arg(long)]
    pub transparent: bool,
    /// Draws this many times as wide and high, 1 to 8, tile by tile, and shrinks the picture: smoother edges and threads
    #[arg(long, value_name = "TIMES", default_value_t = 1, value_parser = times())]
    pub supersample: u32,
    /// The light: studio, daylight or evening; a transparent picture has it, too
    #[arg(long, value_name = "NAME", default_value = "studio")]
    pub light: Light,
    /// How the body is shown: skin, or form for a dress form covered in linen
    #[arg(long, value_name = "NAME", default_value = "skin")]
    pub body_look: BodyLook,
    /// Draws seams as lines alone, without the stitches by which they are known in editing
    #[arg(long)]
    pub plain_seams: bool,
}

impl PictureOptions {
    /// The options by default, seen from `view`.
    pub fn seen_from(view: View) -> Self {
        Self {
            view,
            size: [1280, 800],
            transparent: false,
            supersample: 1,
            light: Light::Studio,
            body_look: BodyLook::Skin,
            plain_seams: false,
        }
    }
}

/// Options of depth of field.
#[derive(Clone, Copy, Debug, Args)]
pub struct LensOptions {
    /// Depth of field: blurs what is out of focus as a lens of this f-number does, 1.4 to 22, on a sensor whose longer side is
    /// 36 mm; the smaller, the stronger
    #[arg(long, value_name = "NUMBER", value_parser = f_number)]
    pub f_number: Option<f32>,
    /// Distance from the eye to the plane in focus, metres; by default the first surface in the middle of
    /// the picture is in focus, or where there is none the middle of what is drawn
    #[arg(long, value_name = "METRES", requires = "f_number", value_parser = focus)]
    pub focus: Option<f32>,
}

impl LensOptions {
    /// The lens; None where everything is sharp.
    pub fn lens(self) -> Option<Lens> {
        self.f_number.map(|f_number| Lens { f_number, focus: self.focus })
    }
}

/// Reads an f-number.
fn f_number(text: &str) -> Result<f32, String> {
    let number = text.parse::<f32>().ok().filter(|number| Lens::F_NUMBERS.contains(number));
    let (least, most) = Lens::F_NUMBERS.into_inner();
    number.ok_or_else(|| format!("{text:?} is not an f-number from {least} to {most}"))
}

/// Reads the distance to the plane in focus, metres.
fn focus(text: &str) -> Result<f32, String> {
    let distance = text.parse::<f32>().ok().filter(|distance| FOCUS.contains(distance));
    let (least, most) = FOCUS.into_inner();
    distance.ok_or_else(|| format!("{text:?} is not a distance in metres from {least} to {most}"))
}

fn times() -> clap::builder::RangedI64ValueParser<u32> {
    clap::value_parser!(u32).range(1..=i64::from(Fineness::MOST_TIMES))
}

/// Reads the name or the angles of a view.
pub(super) fn view(text: &str) -> Result<View, String> {
    text.parse::<View>().map_err(|e| e.to_string())
}

/// Reads a rotation, degrees.
pub(super) fn rotation(text: &str) -> Result<f32, String> {
    let degrees = text.parse::<f32>().ok().filter(|degrees| (0.0..=360.0).contains(degrees));
    degrees.ok_or_else(|| format!("{text:?} is not a number of degrees from 0 to 360"))
}

/// Reads "WIDTHxHEIGHT", pixels.
pub(super) fn size(text: &str) -> Result<[u32; 2], String> {
    let side = |t: &str| t.parse::<u32>().ok().filter(|n| (1..=16384).contains(n));
    match text.split_once('x').map(|(w, h)| (side(w), side(h))) {
        Some((Some(width), Some(height))) => Ok([width, height]),
        _ => Err(format!("{text:?} is not WIDTHxHEIGHT, each 1 to 16384")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_and_views_are_read() {
        assert_eq!(size("1280x800"), Ok([1280, 800]));
        assert!(size("0x10").is_err() && size("99999x9").is_err() && size("12").is_err());
        assert_eq!([rotation("0"), rotation("22.5"), rotation("360")], [Ok(0.0), Ok(22.5), Ok(360.0)]);
        assert!(["-1", "361", "NaN", "", "90°"].into_iter().all(|text| rotation(text).is_err()));
        assert_eq!([f_number("1.4"), f_number("8"), f_number("22")], [Ok(1.4), Ok(8.0), Ok(22.0)]);
        assert!(
            ["0", "1.3", "22.1", "-4", "NaN", "inf", "f/4", ""].into_iter().all(|t| f_number(t).is_err())
        );
        assert_eq!([focus("0.01"), focus("3.5")], [Ok(0.01), Ok(3.5)]);
        assert!(["0", "-1", "1001", "NaN", "inf", "3m", ""].into_iter().all(|text| focus(text).is_err()));
        assert!(view("front").is_ok() && view("-30,10").is_ok() && view("inside").is_err());
    }
}
