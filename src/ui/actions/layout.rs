//! Which panes are shown, and where.

use serde::{Deserialize, Serialize};

/// Which panes are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Panes {
    #[default]
    Both,
    Pattern,
    Body,
}

impl Panes {
    /// All ways.
    pub const ALL: [Self; 3] = [Self::Both, Self::Pattern, Self::Body];
}

/// How the panes are laid out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Layout {
    /// Which are shown.
    pub panes: Panes,
    /// The body is on the left.
    pub swapped: bool,
}
