//! What can be opened below the panes.

/// What is open.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drawer {
    /// Every step that can be undone or done again.
    History,
    /// Messages of this session.
    Log,
    /// What the map shows, in figures.
    Map,
}
