//! The user's preferences, kept between runs.

pub mod depth_of_field;
pub mod lighting;
pub(in crate::ui) mod page;
pub(in crate::ui) mod units;

use std::collections::BTreeMap;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::body::{Unit, UpAxis};
use crate::io::pdf::Paper;
use crate::io::scale::DrawingUnit;
use crate::ui::actions::keymap::Keymap;
use crate::ui::actions::layout::Layout;
use crate::ui::files;
use crate::ui::language::choice::Language;
use crate::ui::language::say;
use crate::ui::look::scheme::Theme;
use crate::ui::pointer::mouse::Mouse;
use crate::ui::preferences::depth_of_field::DepthOfField;
use crate::ui::preferences::lighting::Lighting;
use crate::ui::preferences::units::LengthUnit;

/// Largest size of a file of preferences, bytes.
const MOST_BYTES: u64 = 1 << 20;

/// The user's preferences.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Preferences {
    /// Language of the window.
    #[serde(deserialize_with = "or_default")]
    pub language: Language,
    /// Mapping of mouse buttons.
    #[serde(deserialize_with = "or_default")]
    pub mouse: Mouse,
    /// Theme of the interface.
    #[serde(deserialize_with = "or_default")]
    pub theme: Theme,
    /// Light of the body pane and of its pictures.
    #[serde(deserialize_with = "or_default")]
    pub lighting: Lighting,
    /// Depth of field of the body pane and of its pictures.
    #[serde(deserialize_with = "or_default")]
    pub depth_of_field: DepthOfField,
    /// Unit in which lengths are shown.
    #[serde(deserialize_with = "or_default")]
    pub unit: LengthUnit,
    /// Paper that patterns are printed on.
    #[serde(deserialize_with = "or_default")]
    pub paper: Paper,
    /// Size of the interface.
    #[serde(deserialize_with = "or_default")]
    pub scale: Scale,
    /// Layout of the panes.
    #[serde(deserialize_with = "or_default")]
    pub layout: Layout,
    /// Resolution of the screen.
    #[serde(deserialize_with = "or_default")]
    pub screen: Screen,
    /// Last answers to questions about units of files.
    #[serde(deserialize_with = "or_default")]
    pub answers: Answers,
    /// Interval of copies of unsaved work.
    #[serde(deserialize_with = "or_default")]
    pub copies: Copies,
    /// Whether large garments are draped on the graphics card.
    #[serde(deserialize_with = "or_default")]
    pub card: UsesCard,
    /// Keyboard shortcuts.
    #[serde(deserialize_with = "or_default")]
    pub keymap: Arc<Keymap>,
}

/// Size of the interface, percent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Scale(pub u16);

impl Default for Scale {
    fn default() -> Self {
        Self(100)
    }
}

impl Scale {
    /// The choices, percent.
    pub const ALL: [u16; 11] = [75, 85, 100, 110, 125, 150, 175, 200, 225, 250, 300];

    /// The size as a factor, 0.75..=3.
    pub fn factor(self) -> f32 {
        f32::from(self.0.clamp(75, 300)) / 100.0
    }
}

/// The user's last answers to questions about the unit of files that do not state it.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
pub struct Answers {
    /// Unit and up axis of bodies.
    pub body: Option<(Unit, UpAxis)>,
    /// Length of a drawing unit, by the drawing's extension in small letters.
    pub drawings: BTreeMap<String, DrawingUnit>,
}

impl Answers {
    /// The answer for drawings with the extension of `path`.
    pub fn drawing(&self, path: &Path) -> Option<DrawingUnit> {
        self.drawings.get(&ending(path)).copied()
    }

    /// Keeps `unit` as the answer for drawings with the extension of `path`.
    pub fn keep_drawing(&mut self, path: &Path, unit: DrawingUnit) {
        self.drawings.insert(ending(path), unit);
    }
}

fn ending(path: &Path) -> String {
    path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default()
}

/// Resolution of the screen in pixels per inch, as measured by the user; None if it was not measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Screen(pub Option<f32>);

impl Screen {
    /// Accepted resolutions, pixels per inch.
    pub const PIXELS: RangeInclusive<f32> = 40.0..=600.0;
    /// Resolution if the user has not measured it: logical pixels per inch on a screen with a correct scale factor.
    const USUAL: f32 = 96.0;

    /// Pixels per inch; `native` is the number of pixels per point before the interface is scaled.
    pub fn pixels_per_inch(self, native: f32) -> f32 {
        let said = self.0.filter(|said| Self::PIXELS.contains(said));
        said.unwrap_or(Self::USUAL * native)
    }

    /// Points per metre; `per_point` is the number of pixels per point after the interface is scaled.
    pub fn points_per_metre(self, native: f32, per_point: f32) -> f64 {
        f64::from(self.pixels_per_inch(native)) / f64::from(per_point) / 0.0254
    }
}

/// Shortest interval between two copies of unsaved work, seconds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Copies(pub u16);

impl Default for Copies {
    fn default() -> Self {
        Self(10)
    }
}

impl Copies {
    /// The choices, seconds.
    pub const ALL: [u16; 5] = [10, 30, 60, 120, 300];

    /// The interval, limited to 5..=600 s.
    pub fn seconds(self) -> f64 {
        f64::from(self.0.clamp(5, 600))
    }
}

/// Whether large garments are draped on the graphics card.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct UsesCard(pub bool);

impl Default for UsesCard {
    fn default() -> Self {
        Self(true)
    }
}

/// Deserialises a value, or takes the default if it is not understood (from a newer version, say), so that the other values are
/// kept.
fn or_default<'de, D, T>(from: D) -> Result<T, D::Error>
where
    D: serde::Deserializer<'de>,
    T: Default + for<'v> Deserialize<'v>,
{
    let value = serde_json::Value::deserialize(from)?;
    Ok(serde_json::from_value(value).unwrap_or_default())
}

impl Preferences {
    /// The preferences in `text`; None if it holds none.
    pub fn understood(text: &str) -> Option<Self> {
        serde_json::from_str(text).ok()
    }

    fn kept(path: &Path) -> Option<Self> {
        let is_small = std::fs::metadata(path).is_ok_and(|file| file.is_file() && file.len() <= MOST_BYTES);
        let text = if is_small { std::fs::read_to_string(path).ok() } else { None };
        text.and_then(|text| Self::understood(&text))
    }

    /// Reads the preferences from `path`; the defaults if there is no such file. A file that cannot be understood is renamed, so
    /// that it is not overwritten; then a message with its new name is returned too.
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
                Some(aside) => say!(
                    "The preferences could not be read. They were set aside as {path}.",
                    path = aside.display()
                ),
                None => say!("The preferences in {path} cannot be read.", path = path.display()),
            }
        });
        (Self::default(), words)
    }

    /// Writes the preferences to `path` atomically. The error is a message.
    pub fn write(&self, path: &Path) -> Result<(), String> {
        let mut text = serde_json::to_string_pretty(self).map_err(|e| e.to_string())?;
        text.push('\n');
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
        }
        files::write(path, text.as_bytes())
    }
}

/// The system's file for preferences; None where there is no home folder.
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
    use crate::render::Light;
    use crate::ui::preferences::depth_of_field::FNumber;
    use crate::ui::preferences::lighting::Rotation;

    #[test]
    fn what_was_written_is_read_and_what_is_broken_is_not() {
        let folder = tempfile::tempdir().expect("a folder");
        let read = |path: &Path| Preferences::read(path).0;
        let path = folder.path().join("deep/preferences.json");
        assert_eq!(read(&path), Preferences::default());
        let preferences = Preferences {
            language: Language(Some("de".to_owned())),
            mouse: Mouse::Blender,
            theme: Theme::Light,
            lighting: Lighting {
                light: Light::Evening,
                environment: Some("/home/me/garden.hdr".into()),
                is_put_aside: true,
                rotation: Rotation(90),
            },
            depth_of_field: DepthOfField { is_on: true, f_number: FNumber(5.6) },
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
