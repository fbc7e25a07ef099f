//! Opens and matches another project for a comparison on a separate thread.

use std::path::Path;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use super::Comparison;
use super::comparison::Unlike;
use crate::language::{shown, shown_in};
use crate::session::Outfit;
use crate::ui::language::say;

/// A project that is being opened for a comparison.
#[derive(Debug)]
pub struct Opening {
    /// Name of its file.
    pub name: String,
    coming: Receiver<Result<Comparison, Unlike>>,
}

impl Opening {
    /// Begins to open the project at `path` and to match it with `present`. The error means that no thread could be started.
    pub fn begin(path: &Path, present: Outfit, ctx: &egui::Context) -> Result<Self, String> {
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let (send, coming) = channel();
        let (path, table, ctx) = (path.to_owned(), shown(), ctx.clone());
        let work = move || {
            // Sending fails if the comparison was cancelled.
            send.send(shown_in(table, || Comparison::open(&path, &present))).ok();
            ctx.request_repaint();
        };
        let thread = std::thread::Builder::new().name("comparison".to_owned()).spawn(work);
        thread.map_err(|why| say!("{name} cannot be opened: {why}", name, why))?;
        Ok(Self { name, coming })
    }

    /// The result; None while the project is still being opened.
    pub fn take(&self) -> Option<Result<Comparison, String>> {
        match self.coming.try_recv() {
            Ok(opened) => Some(opened.map_err(Unlike::words)),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => {
                Some(Err(say!("{name} could not be opened", name = self.name)))
            }
        }
    }
}
