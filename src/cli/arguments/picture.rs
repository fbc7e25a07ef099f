//! Options of a picture.

use clap::Args;

use crate::render::{Fineness, Light, View};
use crate::ui::scenery::body_look::BodyLook;

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
        }
    }
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
        assert!(view("front").is_ok() && view("-30,10").is_ok() && view("inside").is_err());
    }
}
