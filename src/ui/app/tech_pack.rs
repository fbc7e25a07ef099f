//! Makes the tech pack: its pictures at once, the rest behind the window.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use crate::geometry::words::{Words, words};
use crate::language::{Table, shown, shown_in};
use crate::pack::{Pack, Pictures, Source, Wish, no_adapter, write};
use crate::session::{Document, Outfit};
use crate::ui::app::App;
use crate::ui::files;
use crate::ui::language::choice::Language;
use crate::ui::language::pictures::no_picture;
use crate::ui::language::{code, said, say, tr};
use crate::ui::scenery::front_and_back::front_and_back;
use crate::ui::shell::dialogs::Dialog;

/// A tech pack in the making.
#[derive(Debug)]
pub struct TechPack {
    path: PathBuf,
    /// The file, or why there is none.
    coming: Receiver<Result<Vec<u8>, Words>>,
}

impl App {
    /// Asks for the language of the tech pack, which a maker abroad reads; at first it is that of the window.
    pub(in crate::ui) fn ask_pack_language(&mut self) {
        let own = |(code, name): (&str, &str)| (code.to_owned(), name.to_owned());
        let chosen = self.shell.pack_language.clone().unwrap_or_else(|| code().to_owned());
        let languages = self.languages.all().into_iter().map(own).collect();
        self.dialog = Some(Dialog::TechPack { languages, chosen });
    }

    /// The table of the language that was chosen for the tech pack; None for English.
    fn pack_table(&self) -> Option<&'static Table> {
        match &self.shell.pack_language {
            Some(code) => self.languages.table(&Language(Some(code.clone()))),
            None => shown(),
        }
    }

    /// Begins the tech pack of the garment; it is written to `path`.
    pub(in crate::ui) fn begin_tech_pack(&mut self, ctx: &egui::Context, path: &Path) -> Result<(), String> {
        let table = self.pack_table();
        let untitled = || shown_in(table, || tr("untitled").to_owned());
        let name = self.path.as_deref().map_or_else(untitled, files::stem);
        let document = self.session.document().clone();
        let outfit = Outfit::of(self.session.snapshot(), &document.fabrics);
        let pictures = self.pictures_of_pack(outfit.is_some())?;
        let (send, coming) = channel();
        let done = ctx.clone();
        let work = move || {
            // Sending fails if the window was closed.
            send.send(made(&name, &document, outfit.as_ref(), &pictures, table)).ok();
            done.request_repaint();
        };
        let thread = std::thread::Builder::new().name("tech pack".to_owned()).spawn(work);
        thread.map_err(|why| say!("The tech pack cannot be made: {why}", why))?;
        self.shell.tech_pack = Some(TechPack { path: path.to_owned(), coming });
        self.messages.tell(tr("The tech pack is being made"));
        Ok(())
    }

    fn pictures_of_pack(&mut self, is_dressed: bool) -> Result<Pictures, String> {
        if !is_dressed {
            return Ok(Pictures::LeftOut(words!("it is not dressed")));
        }
        let Some(graphics) = &mut self.scene_pane.graphics else {
            return Ok(Pictures::LeftOut(no_adapter()));
        };
        let drawn = front_and_back(&self.session, &mut self.scenery, |scene, camera, look, size| {
            graphics.photograph(scene, camera, look, size)
        });
        let pictures = drawn.unwrap_or_else(|| Ok(Vec::new()));
        pictures.map(Pictures::Drawn).map_err(|why| no_picture(&why))
    }

    /// Writes the tech pack once it is made.
    pub(in crate::ui) fn take_tech_pack(&mut self) {
        let Some(pack) = self.shell.tech_pack.take() else { return };
        let made = match pack.coming.try_recv() {
            Err(TryRecvError::Empty) => return self.shell.tech_pack = Some(pack),
            Err(TryRecvError::Disconnected) => Err(tr("The tech pack could not be made").to_owned()),
            Ok(made) => made.map_err(|why| say!("There is no tech pack: {why}", why = said(&why))),
        };
        match made.and_then(|bytes| files::write(&pack.path, &bytes)) {
            Ok(()) => self.wrote(&pack.path),
            Err(words) => self.messages.error(words),
        }
    }
}

/// The tech pack with the texts of `table` as PDF, or why there is none.
fn made(
    name: &str,
    document: &Document,
    outfit: Option<&Outfit>,
    pictures: &Pictures,
    table: Option<&'static Table>,
) -> Result<Vec<u8>, Words> {
    let pack = Pack::of(Source { name, document, outfit }, &Wish::default()).map_err(|why| why.words())?;
    shown_in(table, || write(&pack, &document.pattern, pictures)).map_err(|why| why.words())
}
