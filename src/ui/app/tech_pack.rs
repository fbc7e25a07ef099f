//! Makes the tech pack: one picture per frame, so that it can be stopped, and the rest behind the window.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use crate::geometry::words::{Words, words};
use crate::language::{Table, shown, shown_in};
use crate::pack::{Pack, Pictures, Source, Wish, no_adapter, write};
use crate::session::{Document, Outfit};
use crate::ui::app::App;
use crate::ui::app::turn::progress_bar_ui;
use crate::ui::files;
use crate::ui::language::choice::Language;
use crate::ui::language::pictures::no_picture;
use crate::ui::language::{code, said, say, tr};
use crate::ui::look::theme::Palette;
use crate::ui::scenery::front_and_back::FrontAndBack;
use crate::ui::shell::dialogs::Dialog;

/// A tech pack in the making. Dropping it stops it.
#[derive(Debug)]
pub struct TechPack {
    path: PathBuf,
    stage: Stage,
    /// Whether its progress was shown yet; nothing is drawn before.
    is_shown: bool,
}

#[derive(Debug)]
enum Stage {
    /// Its pictures are drawn.
    Drawing(Box<Contents>, Box<FrontAndBack>),
    /// A thread measures and writes its pages, and sends the file, or why there is none.
    Measuring(Receiver<Result<Vec<u8>, Words>>),
    /// The file.
    Made(Vec<u8>),
}

/// What a tech pack is about, as it was when it was begun.
#[derive(Debug)]
struct Contents {
    name: String,
    document: Document,
    outfit: Option<Outfit>,
    /// The texts of its pages; None for English.
    table: Option<&'static Table>,
}

impl TechPack {
    /// Part of the work that is done, 0..=1.
    fn share(&self) -> f32 {
        match &self.stage {
            Stage::Drawing(_, drawing) => {
                let (done, count) = drawing.progress();
                done as f32 / (count + 1) as f32
            }
            Stage::Measuring(_) => 0.75,
            Stage::Made(_) => 1.0,
        }
    }
}

impl Contents {
    /// Measures and writes the pages with `pictures` on a thread of its own.
    fn measured(self, ctx: &egui::Context, pictures: Pictures) -> Result<Stage, String> {
        let (send, coming) = channel();
        let done = ctx.clone();
        let work = move || {
            // Sending fails if it was stopped or the window was closed.
            send.send(self.written(&pictures)).ok();
            done.request_repaint();
        };
        let thread = std::thread::Builder::new().name("tech pack".to_owned()).spawn(work);
        thread.map_err(|why| say!("The tech pack cannot be made: {why}", why))?;
        Ok(Stage::Measuring(coming))
    }

    /// The tech pack as PDF, or why there is none.
    fn written(&self, pictures: &Pictures) -> Result<Vec<u8>, Words> {
        let Self { name, document, outfit, table } = self;
        let source = Source { name, document, outfit: outfit.as_ref() };
        let pack = Pack::of(source, &Wish::default()).map_err(|why| why.words())?;
        shown_in(*table, || write(&pack, &document.pattern, pictures)).map_err(|why| why.words())
    }
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
        let contents = Contents { name, document, outfit, table };
        let stage = match FrontAndBack::of(&self.session, &mut self.scenery) {
            None => contents.measured(ctx, Pictures::LeftOut(words!("it is not dressed")))?,
            Some(drawing) => Stage::Drawing(Box::new(contents), Box::new(drawing)),
        };
        self.shell.tech_pack = Some(TechPack { path: path.to_owned(), stage, is_shown: false });
        Ok(())
    }

    /// Goes on with the tech pack and draws the progress; writes the file once it is made.
    pub(in crate::ui) fn go_on_packing(&mut self, ctx: &egui::Context, palette: &Palette, above: f32) {
        let Some(mut pack) = self.shell.tech_pack.take() else { return };
        let was_shown = std::mem::replace(&mut pack.is_shown, true);
        if was_shown {
            match self.next_stage(ctx, pack.stage) {
                Ok(stage) => pack.stage = stage,
                Err(words) => return self.messages.error(words),
            }
        }
        if let Stage::Made(bytes) = &pack.stage {
            return match files::write(&pack.path, bytes) {
                Ok(()) => self.wrote(&pack.path),
                Err(words) => self.messages.error(words),
            };
        }
        if progress_bar_ui(ctx, palette, above, tr("The tech pack is being made"), pack.share()) {
            return self.messages.tell(tr("The tech pack was stopped: nothing is written"));
        }
        // A thread asks for a frame by itself.
        if !was_shown || matches!(pack.stage, Stage::Drawing(..)) {
            ctx.request_repaint();
        }
        self.shell.tech_pack = Some(pack);
    }

    /// The stage after `stage`, or the same where it is not over. The error is a message.
    fn next_stage(&mut self, ctx: &egui::Context, stage: Stage) -> Result<Stage, String> {
        match stage {
            Stage::Drawing(contents, mut drawing) => {
                let Some(graphics) = &mut self.scene_pane.graphics else {
                    return contents.measured(ctx, Pictures::LeftOut(no_adapter()));
                };
                drawing
                    .draw_next(|scene, camera, look, size| graphics.photograph(scene, camera, look, size))
                    .map_err(|why| no_picture(&why))?;
                match drawing.progress() {
                    (done, count) if done < count => Ok(Stage::Drawing(contents, drawing)),
                    _ => contents.measured(ctx, Pictures::Drawn(drawing.pictures())),
                }
            }
            Stage::Measuring(coming) => match coming.try_recv() {
                Err(TryRecvError::Empty) => Ok(Stage::Measuring(coming)),
                Err(TryRecvError::Disconnected) => Err(tr("The tech pack could not be made").to_owned()),
                Ok(Ok(bytes)) => Ok(Stage::Made(bytes)),
                Ok(Err(why)) => Err(say!("There is no tech pack: {why}", why = said(&why))),
            },
            Stage::Made(_) => Ok(stage),
        }
    }
}
