//! The layout of the two panes.

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
    /// All choices, in the order of menus.
    pub const ALL: [Self; 3] = [Self::Both, Self::Pattern, Self::Body];
}

/// Which panes are shown, and on which side.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Layout {
    /// The panes that are shown.
    pub panes: Panes,
    /// Whether the body pane is on the left.
    pub swapped: bool,
}
