//! The window: a pattern pane, a body pane, and everything around them. egui lives here and nowhere else.
//!
//! Panes and panels read the document and push [`asks::Ask`]s; [`App`] alone turns them into commands of the session.

mod act;
pub mod actions;
pub mod app;
mod asks;
mod clicks;
mod demo;
mod dialogs;
mod edits;
mod entries;
mod exchange;
mod fields;
mod files;
mod ghosts;
mod keyboard;
mod marks_panel;
mod menu;
mod messages;
mod mouse;
mod panels;
mod pattern_pane;
mod pattern_panel;
mod pick;
mod picking;
mod player;
mod preferences;
mod run;
mod safety;
pub mod scene;
mod scene_pane;
mod selection;
mod side_panel;
mod signs;
mod situation;
mod status;
mod stroke;
mod theme;
mod toolbar;
mod units;

pub use app::App;
pub use run::run;
