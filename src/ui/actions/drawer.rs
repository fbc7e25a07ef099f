//! The contents of the drawer below the panes.

/// What the drawer shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drawer {
    /// The undo history.
    History,
    /// The messages of this session.
    Log,
    /// The map as a table.
    Map,
}
