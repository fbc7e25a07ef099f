//! The user's choice of colours, and the colours in use.

use egui::ThemePreference;
use serde::{Deserialize, Serialize};

/// The theme that the user chose.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Theme {
    Dark,
    Light,
    HighContrast,
    /// Dark or light, as the desktop is.
    #[default]
    System,
}

impl Theme {
    /// All themes, in the order of menus.
    pub const ALL: [Self; 4] = [Self::Dark, Self::Light, Self::HighContrast, Self::System];

    /// Name for menus.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Dark => "Dark",
            Self::Light => "Light",
            Self::HighContrast => "High contrast",
            Self::System => "As the system",
        }
    }
}

impl From<Theme> for ThemePreference {
    fn from(theme: Theme) -> Self {
        match theme {
            // egui knows two themes: high contrast takes the place of the dark one.
            Theme::Dark | Theme::HighContrast => Self::Dark,
            Theme::Light => Self::Light,
            Theme::System => Self::System,
        }
    }
}

/// The colours in use.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scheme {
    #[default]
    Light,
    Dark,
    /// Light on black, with strong lines.
    HighContrast,
}

impl Scheme {
    /// The scheme of `theme`, where `shown` is the theme that egui shows.
    pub fn of(theme: Theme, shown: egui::Theme) -> Self {
        match (theme, shown) {
            (Theme::HighContrast, _) => Self::HighContrast,
            (_, egui::Theme::Light) => Self::Light,
            (_, egui::Theme::Dark) => Self::Dark,
        }
    }
}
