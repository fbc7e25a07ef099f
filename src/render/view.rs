//! Named views of a body.

use std::str::FromStr;

use super::RenderError;

/// The direction from which a body that faces +z is seen.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum View {
    /// From +z.
    #[default]
    Front,
    /// From -z.
    Back,
    /// From the body's left, +x.
    Left,
    /// From the body's right, -x.
    Right,
    /// From above, the front at the bottom of the picture.
    Top,
    /// From below, the front at the top of the picture.
    Below,
    /// From the front, a little to the body's left and from above.
    ThreeQuarter,
    /// Any direction, degrees: yaw from the front towards the body's left, pitch upwards (-90..=90).
    Angles {
        /// Yaw: degrees from the front towards the body's left.
        yaw: f32,
        /// Pitch: degrees above the horizon, -90..=90.
        pitch: f32,
    },
}

impl View {
    /// Yaw and pitch of the view, radians.
    pub fn angles(self) -> (f32, f32) {
        let (yaw, pitch): (f32, f32) = match self {
            Self::Front => (0.0, 0.0),
            Self::Back => (180.0, 0.0),
            Self::Left => (90.0, 0.0),
            Self::Right => (-90.0, 0.0),
            Self::Top => (0.0, 90.0),
            Self::Below => (0.0, -90.0),
            Self::ThreeQuarter => (32.0, 12.0),
            Self::Angles { yaw, pitch } => (yaw, pitch.clamp(-90.0, 90.0)),
        };
        (yaw.to_radians(), pitch.to_radians())
    }
}

impl FromStr for View {
    type Err = RenderError;

    fn from_str(s: &str) -> Result<Self, RenderError> {
        Ok(match s {
            "front" => Self::Front,
            "back" => Self::Back,
            "left" => Self::Left,
            "right" => Self::Right,
            "top" => Self::Top,
            "below" => Self::Below,
            "three-quarter" | "three_quarter" => Self::ThreeQuarter,
            _ => angles(s).ok_or_else(|| RenderError::UnknownView(s.to_owned()))?,
        })
    }
}

fn angles(s: &str) -> Option<View> {
    let (yaw, pitch) = s.split_once(',')?;
    let (yaw, pitch) = (yaw.trim().parse::<f32>().ok()?, pitch.trim().parse::<f32>().ok()?);
    (yaw.is_finite() && pitch.is_finite()).then_some(View::Angles { yaw, pitch })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_angles_are_understood() {
        assert_eq!("back".parse::<View>().expect("a view"), View::Back);
        assert_eq!("30,-5".parse::<View>().expect("a view"), View::Angles { yaw: 30.0, pitch: -5.0 });
        for wrong in ["", "behind", "1", "a,b", "nan,0"] {
            assert!(wrong.parse::<View>().is_err(), "{wrong}");
        }
    }
}
