//! What a person prefers, kept between runs. A file that cannot be read is set aside.

pub(in crate::ui) mod page;
pub(in crate::ui) mod units;

use std::collections::BTreeMap;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::ThemePreference;
use serde::{Deserialize, Serialize};

use crate::body::{Unit, UpAxis};
use crate::io::pdf::Paper;
use crate::io::scale::DrawingUnit;
use crate::ui::actions::keymap::Keymap;
use crate::ui::actions::layout::Layout;
use crate::ui::files;
use crate::ui::pointer::mouse::Mouse;
use crate::ui::preferences::units::LengthUnit;

/// Bytes a file of preferences may have.
const MOST_BYTES: u64 = 1 << 20;

/// What there is to prefer.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Preferences {
    /// What the mouse buttons do.
    #[serde(deserialize_with = "or_default")]
    pub mouse: Mouse,
    /// Dark, light or as the system.
    #[serde(deserialize_with = "or_default")]
    pub theme: Theme,
    /// What lengths are shown in.
    #[serde(deserialize_with = "or_default")]
    pub unit: LengthUnit,
    /// What patterns are printed on.
    #[serde(deserialize_with = "or_default")]
    pub paper: Paper,
    /// How large everything in the window is.
    #[serde(deserialize_with = "or_default")]
    pub scale: Scale,
    /// Which panes are shown, and where.
    #[serde(deserialize_with = "or_default")]
    pub layout: Layout,
    /// How fine the screen is.
    #[serde(deserialize_with = "or_default")]
    pub screen: Screen,
    /// How files that do not say it were last answered to be.
    #[serde(deserialize_with = "or_default")]
    pub answers: Answers,
    /// How often unsaved work is copied.
    #[serde(deserialize_with = "or_default")]
    pub copies: Copies,
    /// Which keys do what.
    #[serde(deserialize_with = "or_default")]
    pub keymap: Arc<Keymap>,
}

/// Size of the interface, per cent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Scale(pub u16);

impl Default for Scale {
    fn default() -> Self {
        Self(100)
    }
}

impl Scale {
    /// Those that can be chosen.
    pub const ALL: [u16; 11] = [75, 85, 100, 110, 125, 150, 175, 200, 225, 250, 300];

    /// As a factor, 0.75..=3.
    pub fn factor(self) -> f32 {
        f32::from(self.0.clamp(75, 300)) / 100.0
    }
}

/// What was answered when a file did not say how large it is.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Answers {
    /// Unit and upright axis of bodies.
    pub body: Option<(Unit, UpAxis)>,
    /// What a unit of a drawing is, by the ending of its name in small letters.
    pub drawings: BTreeMap<String, DrawingUnit>,
}

impl Answers {
    /// For drawings with the ending of `path`.
    pub fn drawing(&self, path: &Path) -> Option<DrawingUnit> {
        self.drawings.get(&ending(path)).copied()
    }

    /// `unit` is the answer for drawings with the ending of `path`.
    pub fn keep_drawing(&mut self, path: &Path, unit: DrawingUnit) {
        self.drawings.insert(ending(path), unit);
    }
}

fn ending(path: &Path) -> String {
    path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default()
}

/// How fine the screen is, as a person has measured it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Screen(pub Option<f32>);

impl Screen {
    /// Pixels in an inch that a screen can have.
    pub const PIXELS: RangeInclusive<f32> = 40.0..=600.0;
    /// Points in an inch where nobody has measured, on a screen that is honest about its scale.
    const USUAL: f32 = 96.0;

    /// Pixels in an inch; `native`: pixels in a point before the window is scaled.
    pub fn pixels_per_inch(self, native: f32) -> f32 {
        let said = self.0.filter(|said| Self::PIXELS.contains(said));
        said.unwrap_or(Self::USUAL * native)
    }

    /// Points in a metre; `per_point`: pixels in a point of the window as it is scaled.
    pub fn points_per_metre(self, native: f32, per_point: f32) -> f64 {
        f64::from(self.pixels_per_inch(native)) / f64::from(per_point) / 0.0254
    }
}

/// Seconds between two copies of unsaved work, at the least.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Copies(pub u16);

impl Default for Copies {
    fn default() -> Self {
        Self(10)
    }
}

impl Copies {
    /// Those that can be chosen.
    pub const ALL: [u16; 5] = [10, 30, 60, 120, 300];

    /// 5..=600.
    pub fn seconds(self) -> f64 {
        f64::from(self.0.clamp(5, 600))
    }
}

/// See [`ThemePreference`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Theme {
    Dark,
    Light,
    #[default]
    System,
}

impl From<ThemePreference> for Theme {
    fn from(theme: ThemePreference) -> Self {
        match theme {
            ThemePreference::Dark => Self::Dark,
            ThemePreference::Light => Self::Light,
            ThemePreference::System => Self::System,
        }
    }
}

impl From<Theme> for ThemePreference {
    fn from(theme: Theme) -> Self {
        match theme {
            Theme::Dark => Self::Dark,
            Theme::Light => Self::Light,
            Theme::System => Self::System,
        }
    }
}

/// A value that is not understood, from a newer version say, leaves the others as they are.
fn or_default<'de, D, T>(from: D) -> Result<T, D::Error>
where
    D: serde::Deserializer<'de>,
    T: Default + for<'v> Deserialize<'v>,
{
    let value = serde_json::Value::deserialize(from)?;
    Ok(serde_json::from_value(value).unwrap_or_default())
}

impl Preferences {
    /// Those that `text` tells. None where it tells none.
    pub fn understood(text: &str) -> Option<Self> {
        serde_json::from_str(text).ok()
    }

    fn kept(path: &Path) -> Option<Self> {
        let is_small = std::fs::metadata(path).is_ok_and(|file| file.is_file() && file.len() <= MOST_BYTES);
        let text = if is_small { std::fs::read_to_string(path).ok() } else { None };
        text.and_then(|text| Self::understood(&text))
    }

    /// Those in `path`; the usual ones where there is no such file. One that is there and cannot be understood is set aside
    /// under another name, so that what is preferred from now on does not replace it; also that name, in words.
    pub fn read(path: &Path) -> (Self, Option<String>) {
        if let Some(kept) = Self::kept(path) {
            return (kept, None);
        }
        let words = std::fs::symlink_metadata(path).is_ok().then(|| {
            let beside = |n: u32| path.with_extension(format!("unreadable-{n}.json"));
            let free = (1..1000).map(beside).find(|aside| std::fs::symlink_metadata(aside).is_err());
            let free = free.filter(|_| path.is_file());
            let set_aside =
                free.as_ref().and_then(|aside| std::fs::rename(path, aside).ok()).and(free.as_ref());
            match set_aside {
                Some(aside) => {
                    format!("The preferences could not be read. They were set aside as {}.", aside.display())
                }
                None => format!("The preferences in {} cannot be read.", path.display()),
            }
        });
        (Self::default(), words)
    }

    /// Writes them to `path`: the whole new file or the whole old one. The error is in words.
    pub fn write(&self, path: &Path) -> Result<(), String> {
        let mut text = serde_json::to_string_pretty(self).map_err(|e| e.to_string())?;
        text.push('\n');
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
        }
        files::write(path, text.as_bytes())
    }
}

/// Where this system keeps preferences. None where there is no home.
pub fn usual_path() -> Option<PathBuf> {
    let folder = |name: &str| std::env::var_os(name).map(PathBuf::from).filter(|p| p.is_absolute());
    let base = if cfg!(windows) {
        folder("APPDATA")
    } else if cfg!(target_os = "macos") {
        folder("HOME").map(|home| home.join("Library/Application Support"))
    } else {
        folder("XDG_CONFIG_HOME").or_else(|| folder("HOME").map(|home| home.join(".config")))
    };
    base.map(|base| base.join("toile/preferences.json"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_written_is_read_and_what_is_broken_is_not() {
        let folder = tempfile::tempdir().expect("a folder");
        let read = |path: &Path| Preferences::read(path).0;
        let path = folder.path().join("deep/preferences.json");
        assert_eq!(read(&path), Preferences::default());
        let preferences = Preferences {
            mouse: Mouse::Blender,
            theme: Theme::Light,
            unit: LengthUnit::Inch,
            paper: Paper::One,
            scale: Scale(150),
            screen: Screen(Some(109.0)),
            answers: Answers {
                body: Some((Unit::Millimetre, UpAxis::Z)),
                drawings: [("svg".to_owned(), DrawingUnit::Inch)].into(),
            },
            ..Preferences::default()
        };
        preferences.write(&path).expect("written");
        assert_eq!(read(&path), preferences);
        for broken in ["", "{", "[1, 2]", "\u{0}", "{\"mouse\": 7}", "nonsense"] {
            std::fs::write(&path, broken).expect("written");
            assert_eq!(read(&path), Preferences::default(), "{broken:?}");
        }
        std::fs::write(&path, "{\"mouse\": \"from_2040\", \"theme\": \"dark\", \"more\": []}")
            .expect("written");
        assert_eq!(read(&path), Preferences { theme: Theme::Dark, ..Preferences::default() });
        assert_eq!(read(folder.path()), Preferences::default(), "a folder is no file");
        assert!(preferences.write(folder.path()).is_err());
    }

    #[test]
    fn preferences_cut_anywhere_are_set_aside() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("preferences.json");
        let preferences = Preferences { theme: Theme::Light, scale: Scale(150), ..Preferences::default() };
        assert_eq!(Preferences::read(&path), (Preferences::default(), None), "nothing is there");
        preferences.write(&path).expect("written");
        let whole = std::fs::read(&path).expect("read");
        for cut in (0..whole.len() - 2).step_by(37) {
            std::fs::write(&path, &whole[..cut]).expect("written");
            let (read, words) = Preferences::read(&path);
            assert_eq!(read, Preferences::default());
            let words = words.expect("it is told");
            assert!(words.contains("unreadable-1.json"), "{words}");
            let aside = folder.path().join("preferences.unreadable-1.json");
            assert_eq!(std::fs::read(&aside).expect("still there"), &whole[..cut]);
            assert!(!path.exists());
            std::fs::remove_file(aside).expect("removed");
        }
        // Nothing that was set aside is lost to what is set aside next.
        for n in 1..4 {
            std::fs::write(&path, format!("broken {n}")).expect("written");
            let words = Preferences::read(&path).1.expect("it is told");
            assert!(words.contains(&format!("unreadable-{n}.json")), "{words}");
        }
        preferences.write(&path).expect("written");
        assert_eq!(Preferences::read(&path), (preferences, None));
    }

    #[test]
    fn true_size_is_that_of_the_screen_and_not_of_the_scale_of_the_window() {
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-6 * b, "{a} is not {b}");
        near(Screen::default().points_per_metre(1.0, 1.0), 96.0 / 0.0254);
        near(Screen::default().points_per_metre(2.0, 2.0), 96.0 / 0.0254);
        near(Screen(Some(254.0)).points_per_metre(1.0, 1.0), 10_000.0);
        near(Screen(Some(254.0)).points_per_metre(1.0, 2.0), 5_000.0);
        // What no screen has counts as not said.
        near(Screen(Some(7.0)).points_per_metre(1.0, 2.0), 48.0 / 0.0254);
    }
}
