//! The window: a pattern pane, a body pane, and everything around them. egui is used here and nowhere else.
//!
//! Panes and panels read the document and push [`actions::asks::Ask`]s; [`App`] alone turns them into commands of the session.
//!
//! | folder | holds |
//! | --- | --- |
//! | `app` | the window's state, one frame of it, and what every action does |
//! | `actions` | everything that can be chosen: its texts, its keys, when it is enabled; the requests of panes and panels |
//! | `shell` | menu, toolbar, status bar, command palette, dialogs, messages |
//! | `panels` | the side panel |
//! | `pattern_pane`, `body_pane` | the two panes with their tools |
//! | `maps`, `fit_page` | maps of the cloth; the fit report as a page |
//! | `scenery` | document and cloth as the buffers that are drawn |
//! | `files` | files, recent files, thumbnails |
//! | `language` | which language is shown, its keys, fields for its numbers |
//! | `preferences` | the user's preferences, and their page; units |
//! | `pointer`, `look` | mouse and strokes; colours and icons |
//! | `list` | drop-down lists and their keys |

pub mod actions;
pub mod app;
mod body_pane;
mod files;
pub mod fit_page;
pub(crate) mod language;
mod list;
mod look;
mod maps;
mod panels;
mod pattern_pane;
mod pointer;
pub mod preferences;
pub mod scenery;
mod selection;
mod shell;

pub use app::App;
pub use app::run::{display_lost, is_loss_of_display, run};
