//! Import and export of files in the window.

use std::path::Path;
use std::sync::Arc;

use crate::geometry::words::{Words, words};
use crate::io::scale::DrawingUnit;
use crate::pattern::edit::PatternEdit;
use crate::place::Moved;
use crate::session::{Command, Outfit};
use crate::ui::actions::Action;
use crate::ui::app::{App, sentence};
use crate::ui::files::obj_sequence::read_sequence;
use crate::ui::files::posed_motion::PosedMotion;
use crate::ui::files::{self, PatternImport, PoseFile, Purpose, RawBody};
use crate::ui::language::{said, say, tr};
use crate::ui::maps::Opening;
use crate::ui::scenery::worn::WornFiles;
use crate::ui::shell::dialogs::{Dialog, NativeDialog};
use crate::ui::shell::drop_overlay::Dropped;

impl App {
    /// Opens a file dialog.
    pub(in crate::ui) fn ask_file(&mut self, purpose: Purpose) {
        match NativeDialog::open(purpose, self.path.as_deref()) {
            Some(native) => self.native = Some(native),
            None => {
                let text = if purpose.writes() { purpose.default_name() } else { String::new() };
                self.dialog = Some(Dialog::Path { purpose, text });
            }
        }
    }

    pub(in crate::ui) fn file(&mut self, ctx: &egui::Context, purpose: Purpose, path: &Path) {
        let done = match purpose {
            Purpose::Open => files::open(path).map(|project| {
                self.replace(project, Some(path.to_owned()));
                self.remember(path);
            }),
            Purpose::Picture => self.write_picture(path),
            Purpose::Turn => {
                self.begin_pictures(path);
                Ok(())
            }
            Purpose::AllSizes => self.write_all_sizes(path),
            Purpose::FitPage => {
                self.begin_fit_page(path);
                Ok(())
            }
            Purpose::Marker(format) => self.write_marker(path, format),
            Purpose::TechPack => self.begin_tech_pack(ctx, path),
            Purpose::Save => {
                self.save_or_ask(ctx, path);
                Ok(())
            }
            Purpose::Copy => files::save(path, &self.session.project()).map(|()| self.wrote(path)),
            Purpose::ImportPattern => self.import_pattern(path, None),
            Purpose::ImportBody => files::read_body(path).and_then(|raw| self.import_body(raw)),
            Purpose::Image => files::take_image(path).map(|command| self.apply(command)),
            Purpose::Pose => self.take_pose(path),
            Purpose::Sequence => self.take_sequence(path),
            Purpose::Compare => self.compare_with(ctx, path),
            Purpose::Environment => self.choose_environment(ctx, path),
            Purpose::Sizes => self.take_sizes(path),
            Purpose::Export => self.export(path),
            Purpose::ExportPattern => self.export_pattern(path),
            Purpose::Recording => {
                let text = self.recording();
                files::write(path, text.as_bytes()).map(|()| self.wrote(path))
            }
        };
        if let Err(words) = done {
            self.after_save = None;
            self.messages.error(words);
        }
    }

    /// Saves under the next version number beside the project's file; the new file becomes that of the project.
    pub(in crate::ui) fn save_next(&mut self, ctx: &egui::Context) {
        let Some(path) = self.path.as_deref().map(files::next_version) else { return };
        self.save_or_ask(ctx, &path);
    }

    /// Imports a pattern; asks for the unit of length first when the file does not state it.
    pub(in crate::ui) fn import_pattern(
        &mut self,
        path: &Path,
        unit: Option<DrawingUnit>,
    ) -> Result<(), String> {
        match files::import_pattern(path, unit)? {
            PatternImport::Pattern(command, mut notes) => {
                let command = self.brought(command, &mut notes);
                self.apply(command);
                self.pattern_pane.fit = true;
                if !notes.is_empty() {
                    self.messages.tell(said(&Words::joined(notes, "; ")));
                }
            }
            PatternImport::Question(question) => {
                let before = self.preferences.answers.drawing(path);
                let before = before.filter(|unit| question.candidates.contains(unit));
                let unit = before.or(question.candidates.first().copied()).unwrap_or_default();
                self.dialog = Some(Dialog::Scale { path: path.to_owned(), question, unit });
            }
        }
        Ok(())
    }

    /// A command that replaces the pattern, changed so that its placement fits the present body. What was moved is added to
    /// `notes`.
    fn brought(&mut self, command: Command, notes: &mut Vec<Words>) -> Command {
        let Command::ReplacePattern { name, mut pattern, marks } = command else { return command };
        let moved = self.session.brought(&pattern);
        if !moved.placements.is_empty() {
            moved.carry_out(Arc::make_mut(&mut pattern));
            let how = Words::joined(moved.words, ", ");
            notes.push(words!("Its pieces were placed for another body: {how}", how));
        }
        Command::ReplacePattern { name, pattern, marks }
    }

    /// Moves the placed pieces as a whole to the body, and sleeves to its arms.
    pub(in crate::ui) fn bring_pieces(&mut self) {
        let pattern = Arc::clone(&self.session.document().pattern);
        let Moved { placements, words } = self.session.brought(&pattern);
        if placements.is_empty() {
            return self.messages.tell(tr("The pieces stand where they belong on this body"));
        }
        let edits = vec![PatternEdit::PlaceInSpace { placements }];
        self.apply(Command::EditPattern { edits, anew: false });
        self.messages.tell(sentence(&said(&Words::joined(words, ", "))));
    }

    /// Writes the dressed garment; asks first where files that belong beside it are there already.
    fn export(&mut self, path: &Path) -> Result<(), String> {
        let shown = self.shown();
        let written = files::exported(path, shown.snapshot(), &shown.document().pattern, shown.document())?;
        let names = files::there_beside(&written.files);
        if names.is_empty() {
            return self.write_export(&written);
        }
        self.dialog = Some(Dialog::Beside { written: Box::new(written), names });
        Ok(())
    }

    pub(in crate::ui) fn write_export(&mut self, written: &WornFiles) -> Result<(), String> {
        files::write_together(&written.files)?;
        if let Some((path, _)) = written.files.first() {
            self.wrote(path);
        }
        if !written.left_out.is_empty() {
            self.messages.tell(said(&Words::joined(written.left_out.iter().cloned(), "; ")));
        }
        Ok(())
    }

    pub(in crate::ui) fn export_pattern(&mut self, path: &Path) -> Result<(), String> {
        let left_out = files::export_pattern(path, &self.session.document().pattern, self.preferences.paper)?;
        self.wrote(path);
        if !left_out.is_empty() {
            self.messages.tell(left_out.iter().map(said).collect::<Vec<_>>().join("; "));
        }
        Ok(())
    }

    /// Imports a body; asks for the unit first when it is doubtful.
    pub(in crate::ui) fn import_body(&mut self, mut raw: RawBody) -> Result<(), String> {
        if raw.is_doubtful {
            raw.answered_before(self.preferences.answers.body);
            self.dialog = Some(Dialog::Unit { raw: Box::new(raw) });
            return Ok(());
        }
        self.take_body(raw)
    }

    pub(in crate::ui) fn take_body(&mut self, raw: RawBody) -> Result<(), String> {
        let (command, notes) = files::take_body(raw)?;
        self.apply(command);
        if !notes.is_empty() {
            self.messages.tell(said(&Words::joined(notes, "; ")));
        }
        Ok(())
    }

    /// Reads a pose or animations of the body, or a motion for the mannequin.
    fn take_pose(&mut self, path: &Path) -> Result<(), String> {
        let dressed = self.session.surface().ok_or(tr("There is no body that could take a pose"))?;
        match files::read_pose(path, &dressed.mesh)? {
            PoseFile::Body(command) => self.apply(command),
            PoseFile::Motion(clip) => {
                let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
                let body = &self.session.document().body;
                let motion =
                    PosedMotion::new(name, clip, body).map_err(|why| format!("{}: {why}", path.display()))?;
                if let Some(words) = motion.note() {
                    self.messages.tell(words);
                }
                self.shell.pose.take_motion(motion);
            }
        }
        Ok(())
    }

    /// Reads the files numbered like this one as an animation of the body, which the side panel then shows.
    fn take_sequence(&mut self, path: &Path) -> Result<(), String> {
        let dressed = self.session.surface().ok_or(tr("There is no body that could take a pose"))?;
        let (command, count) = read_sequence(path, &dressed.mesh)?;
        self.apply(command);
        self.messages.tell(say!("{count} files are an animation under Pose, of 30 a second", count));
        Ok(())
    }

    /// Shows the garment of another project beside, once it is opened.
    fn compare_with(&mut self, ctx: &egui::Context, path: &Path) -> Result<(), String> {
        let present = Outfit::of(self.session.snapshot(), &self.session.document().fabrics);
        let present = present.ok_or(tr("There is no cloth on the body to be compared"))?;
        self.shell.maps.wait_for(Opening::begin(path, present, ctx)?);
        Ok(())
    }

    pub(in crate::ui) fn take_comparison(&mut self) {
        match self.shell.maps.take_opened() {
            Ok(true) => self.scene_pane.frame = Some(None),
            Ok(false) => {}
            Err(words) => self.messages.error(words),
        }
    }

    /// Reads a table of sizes, which the side panel then offers.
    fn take_sizes(&mut self, path: &Path) -> Result<(), String> {
        self.shell.tape.sizes.take(path, &files::read(path)?)?;
        self.messages.tell(tr("The sizes are listed in Measures of the body"));
        Ok(())
    }

    pub(in crate::ui) fn wrote(&mut self, path: &Path) {
        self.messages.tell(say!("Written: {path}", path = path.display()));
    }

    pub(in crate::ui) fn dropped_files(&mut self, ctx: &egui::Context) {
        let dropped = ctx.input(|i| i.raw.dropped_files.clone());
        for path in dropped.into_iter().map(|f| f.path().to_owned()) {
            match Dropped::of(&path) {
                Dropped::Project if self.session.is_modified() => {
                    self.shell.opening = Some(path);
                    self.dialog = Some(Dialog::Unsaved { then: Action::OpenRecent(0) });
                }
                Dropped::Project => self.file(ctx, Purpose::Open, &path),
                Dropped::Pattern => self.file(ctx, Purpose::ImportPattern, &path),
                Dropped::Body => self.file(ctx, Purpose::ImportBody, &path),
                Dropped::Image => self.file(ctx, Purpose::Image, &path),
                Dropped::Environment => self.file(ctx, Purpose::Environment, &path),
                Dropped::Nothing => self.messages.error(say!(
                    "{path} is neither a project (.toile), a pattern (.dxf, .svg, .json), a body (.obj, .glb, .gltf), an image (.png, .jpg) nor an environment map (.hdr)",
                    path = path.display()
                )),
            }
        }
    }
}
