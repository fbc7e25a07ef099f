//! The light of the body pane and of its pictures.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::or_default;
use crate::render::Light;

/// The light of the body pane and of its pictures.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Lighting {
    /// The light; where there is an environment map, its lamp and background.
    #[serde(deserialize_with = "or_default")]
    pub light: Light,
    /// The image that lights the scene from all sides in place of the light's surroundings.
    #[serde(deserialize_with = "or_default", skip_serializing_if = "has_no_text")]
    pub environment: Option<PathBuf>,
    /// Whether that image is put aside, to go back to: the light alone is used.
    #[serde(deserialize_with = "or_default", skip_serializing_if = "std::ops::Not::not")]
    pub is_put_aside: bool,
    /// Rotation of the environment map.
    #[serde(deserialize_with = "or_default")]
    pub rotation: Rotation,
}

/// Rotation about the vertical axis, degrees, counter-clockwise as seen from above; wrapped to 0..=360 when it is used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Rotation(pub u16);

impl Lighting {
    /// The image that lights the scene; None where the light alone does.
    pub fn environment_used(&self) -> Option<&Path> {
        self.environment.as_deref().filter(|_| !self.is_put_aside)
    }
}

impl Rotation {
    /// The largest rotation, degrees.
    pub const MOST: u16 = 360;

    /// The rotation by `degrees`, of which whole turns are left out; 360 stays.
    pub fn wrapped(degrees: i32) -> Self {
        let most = i32::from(Self::MOST);
        let within = if (0..=most).contains(&degrees) { degrees } else { degrees.rem_euclid(most) };
        Self(within as u16)
    }

    /// The angle in degrees, 0..=360.
    pub fn degrees(self) -> u16 {
        Self::wrapped(self.0.into()).0
    }

    /// The angle in radians.
    pub fn radians(self) -> f32 {
        f32::from(self.degrees()).to_radians()
    }
}

/// Whether there is a path that JSON cannot hold: one that is not Unicode. It is left out, as in the list of recent files.
fn has_no_text(path: &Option<PathBuf>) -> bool {
    path.as_ref().is_some_and(|path| path.to_str().is_none())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_understood_costs_nothing_else() {
        let read = |text: &str| serde_json::from_str::<Lighting>(text).expect("lighting");
        let environment = Some(PathBuf::from("/a/garden.hdr"));
        let all = r#"{"light": "evening", "environment": "/a/garden.hdr", "rotation": 90}"#;
        assert_eq!(
            read(all),
            Lighting {
                light: Light::Evening,
                environment: environment.clone(),
                is_put_aside: false,
                rotation: Rotation(90)
            }
        );
        let newer = r#"{"light": "moon", "environment": "/a/garden.hdr", "rotation": -7, "more": 1}"#;
        assert_eq!(read(newer), Lighting { environment, ..Lighting::default() });
        assert_eq!(read("{}"), Lighting::default());
        let aside = read(r#"{"environment": "/a/garden.hdr", "is_put_aside": true}"#);
        assert!(aside.environment.is_some() && aside.environment_used().is_none());
        let text = serde_json::to_string(&aside).expect("text");
        assert_eq!(read(&text), aside);
    }

    #[test]
    fn whole_turns_are_left_out() {
        use std::f32::consts::{FRAC_PI_2, PI, TAU};
        for (degrees, radians) in [(0, 0.0), (180, PI), (360, TAU), (450, FRAC_PI_2), (36_180, PI)] {
            assert!((Rotation(degrees).radians() - radians).abs() < 1e-6, "{degrees}");
        }
        for (typed, kept) in [(0, 0), (360, 360), (450, 90), (-90, 270), (720, 0), (i32::MIN, 232)] {
            assert_eq!(Rotation::wrapped(typed), Rotation(kept), "{typed}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_name_that_is_no_text_is_left_out() {
        use std::ffi::OsStr;
        use std::os::unix::ffi::OsStrExt;
        let odd = PathBuf::from(OsStr::from_bytes(b"/a/\xff.hdr"));
        let lighting = Lighting { environment: Some(odd), rotation: Rotation(5), ..Lighting::default() };
        let text = serde_json::to_string(&lighting).expect("text");
        let kept: Lighting = serde_json::from_str(&text).expect("lighting");
        assert_eq!(kept, Lighting { environment: None, ..lighting });
    }
}
