//! The user's session: one stream of commands builds the document, its undo history and its recording.

pub mod animations;
pub mod artwork;
pub mod body;
pub mod body_choice;
pub mod carry;
pub mod command;
pub mod demos;
pub mod document;
pub mod dyes;
pub mod edit;
pub mod fabrics;
pub mod grading;
pub mod hashes;
pub mod history;
pub mod marks_file;
pub mod outfit;
pub mod placing;
pub mod project;
pub mod project_file;
pub mod recording;
pub mod recovery;
pub mod replay;
pub mod samples;
#[expect(clippy::module_inception, reason = "a file is named by what it holds")]
pub mod session;
pub mod size_fit;
pub mod whole_file;

pub use animations::{AnimatedFile, Animations, Moment};
pub use artwork::{Artwork, Graphic, ImageFile, Repeated};
pub use body_choice::BodyChoice;
pub use command::{Command, Rejection};
pub use document::{Aim, Document, Pin, Settings};
pub use dyes::{Colourway, Dye, Dyes, Motif, Print};
pub use fabrics::Fabrics;
pub use outfit::Outfit;
pub use project::{Dressed, Project};
pub use session::{GestureId, Notice, Session};
