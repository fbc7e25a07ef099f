//! The interface around the panes: menu, toolbar, status bar, command palette, dialogs, messages.

pub(in crate::ui) mod command_palette;
pub(in crate::ui) mod dialogs;
pub(in crate::ui) mod drop_overlay;
pub(in crate::ui) mod manual;
pub(in crate::ui) mod menu;
pub(in crate::ui) mod messages;
pub(in crate::ui) mod pace;
pub(in crate::ui) mod status;
pub(in crate::ui) mod toolbar;
