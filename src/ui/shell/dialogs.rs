//! Dialogs over the window: unsaved changes, a path, units, shortcuts, recovery.

use std::future::Future;
use std::path::{Path, PathBuf};
use std::pin::Pin;
use std::sync::Arc;
use std::task::{Context, Poll, Wake, Waker};
use std::time::{Duration, Instant};

use egui::{Id, Modal, ScrollArea, TextEdit};

use crate::body::{Unit, UpAxis};
use crate::io::scale::{DrawingUnit, ScaleQuestion};
use crate::pattern::bow::{BOW_LOOPS, BOW_TAILS, BOW_WIDTHS};
use crate::pattern::{Bow, PiecePoint};
use crate::session::recovery::Left;
use crate::session::whole_file;
use crate::ui::actions::Action;
use crate::ui::actions::keymap::Keymap;
use crate::ui::files::thumbnails::{Subject, Thumbnails};
use crate::ui::files::{Purpose, RawBody};
use crate::ui::language::keys::shortcut_text;
use crate::ui::language::{number, said, say, tr};
use crate::ui::panels::fields::length_field;
use crate::ui::pointer::mouse::Mouse;
use crate::ui::preferences::units::LengthUnit;
use crate::ui::scenery::worn::WornFiles;

/// If a native dialog reports "cancelled" sooner than this, it has not been shown at all: no hand clicks that fast.
const TOO_QUICK: Duration = Duration::from_millis(400);

/// A dialog.
#[derive(Debug)]
pub enum Dialog {
    /// Asks what to do with unsaved changes before `then`.
    Unsaved { then: Action },
    /// Asks for a path, where the desktop offers no file dialog.
    Path { purpose: Purpose, text: String },
    /// Asks whether to revert to the saved file.
    Revert { path: PathBuf },
    /// Asks for the unit of a body.
    Unit { raw: Box<RawBody> },
    /// Asks for the unit of length of a drawing.
    Scale { path: PathBuf, question: ScaleQuestion, unit: DrawingUnit },
    /// Shows the shortcuts, and the mapping of mouse buttons.
    Shortcuts { mouse: Mouse, keymap: Arc<Keymap> },
    /// Offers work left by sessions that did not end properly, each with its name.
    Recover { found: Vec<(Left, String)> },
    /// Asks for the language of the tech pack: code and name of each, and the chosen code.
    TechPack { languages: Vec<(String, String)>, chosen: String },
    /// Asks for the measures of a bow.
    Bow { at: PiecePoint, bow: Bow, unit: LengthUnit },
    /// Tells that another program has changed the project's file since it was opened or saved.
    ChangedOnDisk { path: PathBuf },
    /// Tells that the project could not be saved to the file, and why.
    NotSaved { path: PathBuf, words: String },
    /// Asks whether to replace the file that is there already.
    Exists { purpose: Purpose, path: PathBuf },
    /// Asks whether to replace files of these names, which belong beside the first of `written`.
    Beside { written: Box<WornFiles>, names: Vec<String> },
}

/// The user's answer to a dialog.
#[derive(Debug)]
pub enum Answer {
    /// No answer yet.
    None,
    /// Cancel: leave everything as it is.
    Cancel,
    /// Save, then carry out the action.
    SaveThen(Action),
    /// Carry out the action without saving.
    Discard(Action),
    /// The chosen file.
    File(Purpose, PathBuf),
    /// The body, with its unit and up axis chosen.
    Body(Box<RawBody>),
    /// Restore this work; the rest is offered the next time.
    Restore(Box<Left>),
    /// Overwrite the changes of another program.
    Overwrite(PathBuf),
    /// Overwrite a write-protected file.
    Replace(PathBuf),
    /// Write the dressed garment, over files that are there.
    Export(Box<WornFiles>),
    /// Choose another file.
    Elsewhere(Purpose),
    /// The pattern in this file, in this unit.
    Pattern(PathBuf, DrawingUnit),
    /// A tech pack in the language with this code.
    TechPack(String),
    /// A bow at this place.
    Bow(PiecePoint, Bow),
}

impl Answer {
    /// The answer, or Cancel if there is none and the dialog was closed by Esc or a click beside it.
    fn or_cancel(self, closed: bool) -> Self {
        if matches!(self, Self::None) && closed { Self::Cancel } else { self }
    }
}

impl Dialog {
    /// Draws the dialog.
    pub fn ui(&mut self, ctx: &egui::Context, thumbnails: &mut Thumbnails) -> Answer {
        match self {
            Self::Unsaved { then } => unsaved_ui(ctx, *then),
            Self::Path { purpose, text } => match path_ui(ctx, *purpose, text) {
                Answer::File(purpose, path) if purpose.writes() && path.exists() => {
                    *self = Self::Exists { purpose, path };
                    ctx.request_repaint();
                    Answer::None
                }
                answer => answer,
            },
            Self::Revert { path } => revert_ui(ctx, path),
            Self::Unit { raw } => unit_ui(ctx, raw),
            Self::Scale { path, question, unit } => scale_ui(ctx, path, question, unit),
            Self::Shortcuts { mouse, keymap } => shortcuts_ui(ctx, *mouse, keymap),
            Self::Recover { found } => recover_ui(ctx, found, thumbnails),
            Self::TechPack { languages, chosen } => tech_pack_ui(ctx, languages, chosen),
            Self::Bow { at, bow, unit } => bow_ui(ctx, *at, bow, *unit),
            Self::ChangedOnDisk { path } => changed_ui(ctx, path),
            Self::NotSaved { path, words } => not_saved_ui(ctx, path, words),
            Self::Exists { purpose, path } => exists_ui(ctx, *purpose, path),
            Self::Beside { written, names } => beside_ui(ctx, written, names),
        }
    }
}

/// Draws a question with a row of buttons: label, tooltip and answer of each. The last button cancels.
fn question_ui(
    ctx: &egui::Context,
    id: &str,
    heading: &str,
    words: &str,
    buttons: Vec<(&str, &str, Answer)>,
) -> Answer {
    let shown = Modal::new(Id::unique(id)).show(ctx, |ui| {
        ui.set_width(400.0);
        ui.heading(heading);
        ui.add_space(4.0);
        ui.label(words);
        ui.add_space(10.0);
        ui.horizontal(|ui| {
            let mut given = Answer::None;
            for (text, tip, answer) in buttons {
                let button = ui.button(text);
                let button = if tip.is_empty() { button } else { button.on_hover_text(tip) };
                if button.clicked() {
                    given = answer;
                }
            }
            given
        })
        .inner
    });
    to_top(ctx, &shown);
    let closed = shown.should_close();
    shown.inner.or_cancel(closed)
}

/// Keeps a dialog above pages that were opened after one of its kind: a layer keeps its old place when it is shown again.
fn to_top<T>(ctx: &egui::Context, shown: &egui::ModalResponse<T>) {
    ctx.move_to_top(shown.response.layer_id);
}

fn unsaved_ui(ctx: &egui::Context, then: Action) -> Answer {
    let words = tr("This project has changes that are not saved.");
    let buttons = vec![
        (tr("Save"), "", Answer::SaveThen(then)),
        (tr("Don't save"), "", Answer::Discard(then)),
        (tr("Cancel"), "", Answer::Cancel),
    ];
    question_ui(ctx, "unsaved", tr("Save the changes?"), words, buttons)
}

fn recover_ui(ctx: &egui::Context, found: &mut Vec<(Left, String)>, thumbnails: &mut Thumbnails) -> Answer {
    let shown = Modal::new(Id::unique("recover")).show(ctx, |ui| {
        ui.set_width(460.0);
        ui.heading(tr("Go on with unsaved work?"));
        ui.add_space(4.0);
        ui.label(tr("Toile did not end as it should. This was not saved:"));
        ui.add_space(6.0);
        let (mut restored, mut forgotten) = (None, None);
        ScrollArea::vertical().max_height(300.0).show(ui, |ui| {
            for (i, (left, words)) in found.iter().enumerate() {
                ui.horizontal(|ui| {
                    picture_ui(ui, left, thumbnails);
                    if ui.button(tr("Restore")).clicked() {
                        restored = Some(i);
                    }
                    if ui.button(tr("Delete")).on_hover_text(tr("This work is gone then")).clicked() {
                        forgotten = Some(i);
                    }
                    let label = ui.label(words);
                    if let Some(path) = &left.about.path {
                        label.on_hover_text(path.display().to_string());
                    }
                });
            }
        });
        ui.add_space(10.0);
        let later = ui.button(tr("Later")).on_hover_text(tr("It is offered again the next time")).clicked();
        if let Some(i) = forgotten {
            found.remove(i).0.forget().ok();
        }
        match restored {
            Some(i) => Answer::Restore(Box::new(found.remove(i).0)),
            None if later || found.is_empty() => Answer::Cancel,
            None => Answer::None,
        }
    });
    let closed = shown.should_close();
    shown.inner.or_cancel(closed)
}

/// Draws the thumbnail of the last copy of the work, once it is ready.
fn picture_ui(ui: &mut egui::Ui, left: &Left, thumbnails: &mut Thumbnails) {
    let (rect, _) = ui.allocate_exact_size(egui::vec2(56.0, 70.0), egui::Sense::hover());
    ui.painter().rect_filled(rect, 4.0, ui.visuals().faint_bg_color);
    let Some(copy) = left.copy() else { return };
    if let Some(texture) = thumbnails.get(ui.ctx(), &Subject::Project(copy)) {
        let whole = egui::Rect::from_min_max(egui::Pos2::ZERO, egui::Pos2::new(1.0, 1.0));
        ui.painter().image(texture.id(), rect, whole, egui::Color32::WHITE);
    }
}

fn changed_ui(ctx: &egui::Context, path: &Path) -> Answer {
    let words =
        say!("{path} was changed by another program since you opened or saved it.", path = path.display());
    let buttons = vec![
        (tr("Save as…"), "", Answer::Elsewhere(Purpose::Save)),
        (tr("Save over it"), tr("The other version stays as .bak"), Answer::Overwrite(path.to_owned())),
        (tr("Cancel"), "", Answer::Cancel),
    ];
    question_ui(ctx, "changed", tr("The file has changed"), &words, buttons)
}

fn not_saved_ui(ctx: &egui::Context, path: &Path, words: &str) -> Answer {
    let mut buttons = vec![(tr("Save as…"), "", Answer::Elsewhere(Purpose::Save))];
    if whole_file::is_protected(path) {
        let tip = tr("It stays write-protected; the version before stays as .bak");
        buttons.push((tr("Replace it anyway"), tip, Answer::Replace(path.to_owned())));
    }
    buttons.push((tr("Cancel"), "", Answer::Cancel));
    let kept = match path.exists() {
        true => say!("{path} is as it was; your work is kept here.", path = path.display()),
        false => tr("Your work is kept here.").to_owned(),
    };
    question_ui(ctx, "not saved", tr("Not saved"), &format!("{words}.\n{kept}"), buttons)
}

fn exists_ui(ctx: &egui::Context, purpose: Purpose, path: &Path) -> Answer {
    let words = say!("{path} is there already, and would be replaced.", path = path.display());
    let buttons = vec![
        (tr("Replace it"), "", Answer::File(purpose, path.to_owned())),
        (tr("Choose another name…"), "", Answer::Elsewhere(purpose)),
        (tr("Cancel"), "", Answer::Cancel),
    ];
    question_ui(ctx, "exists", tr("Replace the file?"), &words, buttons)
}

fn beside_ui(ctx: &egui::Context, written: &mut WornFiles, names: &[String]) -> Answer {
    let words = say!(
        "The garment is written as several files. These are there already, and would be replaced: {names}",
        names = names.join(", ")
    );
    let buttons = vec![
        (tr("Replace them"), "", Answer::Export(Box::default())),
        (tr("Choose another name…"), "", Answer::Elsewhere(Purpose::Export)),
        (tr("Cancel"), "", Answer::Cancel),
    ];
    match question_ui(ctx, "beside", tr("Replace the files beside it?"), &words, buttons) {
        Answer::Export(_) => Answer::Export(Box::new(std::mem::take(written))),
        other => other,
    }
}

fn revert_ui(ctx: &egui::Context, path: &Path) -> Answer {
    let words = say!("What has changed since {path} was saved will be gone.", path = path.display());
    let back = Answer::File(Purpose::Open, path.to_owned());
    let buttons = vec![(tr("Go back"), "", back), (tr("Cancel"), "", Answer::Cancel)];
    question_ui(ctx, "revert", tr("Go back to the saved version?"), &words, buttons)
}

fn path_ui(ctx: &egui::Context, purpose: Purpose, text: &mut String) -> Answer {
    let shown = Modal::new(Id::unique("path")).show(ctx, |ui| {
        ui.set_width(460.0);
        ui.heading(tr(purpose.title()));
        ui.add_space(4.0);
        let (kind, endings) = purpose.filter();
        ui.weak(format!("{} (.{})", tr(kind), endings.join(", .")));
        ui.add_space(4.0);
        let label = ui.label(tr("Path of the file"));
        let hint = format!("/home/me/name.{}", endings.first().unwrap_or(&"toile"));
        let field = ui
            .add(TextEdit::singleline(text).desired_width(f32::INFINITY).hint_text(hint))
            .labelled_by(label.id);
        // Asked before the field gets the focus back, which Enter takes from it.
        let entered = field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter));
        if !ui.memory(|m| m.focused().is_some()) {
            field.request_focus();
            // What is typed then replaces the name that is suggested.
            let mut state = TextEdit::load_state(ctx, field.id).unwrap_or_default();
            let end = egui::text::CCursor::new(text.chars().count());
            state
                .cursor
                .set_char_range(Some(egui::text::CCursorRange::two(egui::text::CCursor::default(), end)));
            state.store(ctx, field.id);
        }
        let picked = if purpose.writes() { None } else { files_ui(ui, purpose, text) };
        ui.add_space(8.0);
        ui.horizontal(|ui| {
            let path = PathBuf::from(text.trim());
            let good = !text.trim().is_empty() && (purpose.writes() || path.is_file());
            let words = if purpose.writes() { tr("Write") } else { tr("Read") };
            let go = ui.add_enabled(good, egui::Button::new(words));
            if go.clicked() || (entered && good) {
                return Answer::File(purpose, with_extension(path, purpose));
            }
            if ui.button(tr("Cancel")).clicked() {
                return Answer::Cancel;
            }
            picked.map_or(Answer::None, |path| Answer::File(purpose, path))
        })
        .inner
    });
    to_top(ctx, &shown);
    let closed = shown.should_close();
    shown.inner.or_cancel(closed)
}

fn unit_ui(ctx: &egui::Context, raw: &mut RawBody) -> Answer {
    let shown = Modal::new(Id::unique("unit")).show(ctx, |ui| {
        ui.set_width(360.0);
        ui.heading(say!("In which unit is {name}?", name = raw.name));
        ui.add_space(4.0);
        for unit in Unit::ALL {
            let height = number(raw.height(unit), 2);
            let words = say!("{unit}: the body is {height} m tall", unit, height);
            ui.radio_value(&mut raw.unit, unit, words);
        }
        ui.add_space(6.0);
        ui.label(tr("Which axis points up?"));
        ui.horizontal(|ui| {
            ui.radio_value(&mut raw.up, UpAxis::Y, tr("y up"));
            ui.radio_value(&mut raw.up, UpAxis::Z, tr("z up"));
        });
        ui.add_space(8.0);
        taken_ui(ui, tr("Take it"), || Answer::Body(Box::new(raw.clone())))
    });
    let closed = shown.should_close();
    shown.inner.or_cancel(closed)
}

/// Draws the buttons of a dialog whose fields are chosen: `take`, which gives `answer`, at Enter, too, and Cancel.
fn taken_ui(ui: &mut egui::Ui, take: &str, answer: impl FnOnce() -> Answer) -> Answer {
    ui.horizontal(|ui| {
        let button = ui.button(take);
        if ui.memory(|memory| memory.focused().is_none()) {
            button.request_focus();
        }
        let is_taken = button.clicked();
        if ui.button(tr("Cancel")).clicked() {
            return Answer::Cancel;
        }
        if is_taken { answer() } else { Answer::None }
    })
    .inner
}

fn tech_pack_ui(ctx: &egui::Context, languages: &[(String, String)], chosen: &mut String) -> Answer {
    let shown = Modal::new(Id::unique("tech pack")).show(ctx, |ui| {
        ui.set_width(320.0);
        ui.heading(tr("In which language is the tech pack to be?"));
        ui.add_space(4.0);
        for (code, name) in languages {
            ui.radio_value(chosen, code.clone(), name);
        }
        ui.add_space(8.0);
        taken_ui(ui, tr("Choose a file…"), || Answer::TechPack(chosen.clone()))
    });
    let closed = shown.should_close();
    shown.inner.or_cancel(closed)
}

fn bow_ui(ctx: &egui::Context, at: PiecePoint, bow: &mut Bow, unit: LengthUnit) -> Answer {
    let shown = Modal::new(Id::unique("bow")).show(ctx, |ui| {
        ui.set_width(360.0);
        ui.heading(tr("Bow"));
        ui.add_space(4.0);
        ui.label(tr("A knot, two loops and two tails of ribbon, sewn together and tacked to the place."));
        ui.add_space(6.0);
        egui::Grid::new("measures of a bow").num_columns(2).spacing([12.0, 6.0]).show(ui, |ui| {
            let rows = [
                ("Width of the ribbon", &mut bow.width, BOW_WIDTHS),
                ("Length of the loops", &mut bow.loops, BOW_LOOPS),
                ("Length of the tails", &mut bow.tails, BOW_TAILS),
            ];
            for (text, metres, range) in rows {
                let label = ui.label(tr(text));
                if let Some(new) = length_field(ui, ("bow", text), &label, *metres, unit) {
                    *metres = new.clamp(*range.start(), *range.end());
                }
                ui.end_row();
            }
        });
        bow.loops = bow.loops.max(bow.width);
        ui.add_space(4.0);
        ui.label(tr("Crisp cloth holds its loops up; in soft cloth they hang."));
        ui.add_space(8.0);
        taken_ui(ui, tr("Add the bow"), || Answer::Bow(at, *bow))
    });
    to_top(ctx, &shown);
    let closed = shown.should_close();
    shown.inner.or_cancel(closed)
}

fn scale_ui(ctx: &egui::Context, path: &Path, question: &ScaleQuestion, unit: &mut DrawingUnit) -> Answer {
    let shown = Modal::new(Id::unique("scale")).show(ctx, |ui| {
        ui.set_width(420.0);
        ui.heading(tr("How large is the pattern?"));
        ui.add_space(4.0);
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        ui.label(format!("{name}: {}.", said(&question.why)));
        ui.add_space(4.0);
        for &candidate in &question.candidates {
            let size = question.size(candidate) * 100.0;
            let words = say!(
                "{unit}: the largest piece is {width} × {height} cm",
                unit = tr(candidate.long()),
                width = number(size.x, 1),
                height = number(size.y, 1)
            );
            ui.radio_value(unit, candidate, words);
        }
        ui.add_space(8.0);
        taken_ui(ui, tr("Take it"), || Answer::Pattern(path.to_owned(), *unit))
    });
    let closed = shown.should_close();
    shown.inner.or_cancel(closed)
}

/// Lists folders and matching files at the typed path. A double-click chooses a file.
fn files_ui(ui: &mut egui::Ui, purpose: Purpose, text: &mut String) -> Option<PathBuf> {
    let path = PathBuf::from(text.trim());
    let folder = if path.is_dir() { path } else { path.parent().map(Path::to_owned).unwrap_or_default() };
    let folder = if folder.as_os_str().is_empty() { PathBuf::from(".") } else { folder };
    let mut picked = None;
    ScrollArea::vertical().max_height(180.0).auto_shrink([false, true]).show(ui, |ui| {
        if let Some(up) = folder.canonicalize().ok().and_then(|f| f.parent().map(Path::to_owned))
            && ui.selectable_label(false, "../").clicked()
        {
            *text = format!("{}/", up.display());
        }
        for (name, is_folder) in listing(&folder, purpose) {
            let response =
                ui.selectable_label(false, if is_folder { format!("{name}/") } else { name.clone() });
            if response.clicked() {
                let slash = if is_folder { "/" } else { "" };
                *text = format!("{}{slash}", folder.join(&name).display());
            }
            if response.double_clicked() && !is_folder {
                picked = Some(folder.join(&name));
            }
        }
    });
    picked
}

fn listing(folder: &Path, purpose: Purpose) -> Vec<(String, bool)> {
    let fits =
        |name: &str| purpose.filter().1.iter().any(|e| name.to_lowercase().ends_with(&format!(".{e}")));
    let mut all: Vec<(String, bool)> = std::fs::read_dir(folder)
        .into_iter()
        .flatten()
        .flatten()
        .map(|f| (f.file_name().to_string_lossy().into_owned(), f.path().is_dir()))
        .filter(|(name, is_folder)| !name.starts_with('.') && (*is_folder || fits(name)))
        .collect();
    all.sort_by(|a, b| (!a.1, &a.0).cmp(&(!b.1, &b.0)));
    all
}

/// `path` with the extension for `purpose`, unless it has a suitable one.
pub fn with_extension(path: PathBuf, purpose: Purpose) -> PathBuf {
    let fits = path.extension().is_some_and(|e| purpose.filter().1.iter().any(|f| e.eq_ignore_ascii_case(f)));
    if fits || !purpose.writes() {
        return path;
    }
    let mut name = path.into_os_string();
    name.push(".");
    name.push(purpose.filter().1[0]);
    name.into()
}

fn shortcuts_ui(ctx: &egui::Context, mouse: Mouse, keymap: &Keymap) -> Answer {
    let shown = Modal::new(Id::unique("shortcuts")).show(ctx, |ui| {
        ui.set_width(560.0);
        ui.heading(tr("Keys and mouse"));
        ui.add_space(6.0);
        ScrollArea::vertical().max_height(ctx.content_rect().height() * 0.7).show(ui, |ui| {
            ui.strong(tr("Mouse"));
            egui::Grid::new("mouse").num_columns(2).spacing([24.0, 5.0]).striped(true).show(ui, |ui| {
                let of_view = mouse.help();
                let of_view = of_view.iter().map(|(what, does)| (what.as_str(), *does));
                for (what, does) in of_view.chain(MOUSE.iter().map(|(what, does)| (tr(what), tr(does)))) {
                    ui.label(what);
                    ui.label(does);
                    ui.end_row();
                }
            });
            ui.add_space(8.0);
            ui.strong(tr("Keys"));
            egui::Grid::new("keys").num_columns(3).spacing([24.0, 5.0]).striped(true).show(ui, |ui| {
                let mut all = keymap.bound();
                all.sort_by_key(|(action, _)| action.row().label());
                for (action, keys) in all {
                    ui.label(shortcut_text(ctx, &keys));
                    ui.label(action.row().label());
                    ui.label(tr(action.row().tip));
                    ui.end_row();
                }
            });
        });
        ui.add_space(8.0);
        ui.button(tr("Close")).clicked()
    });
    let closed = shown.should_close();
    if shown.inner { Answer::Cancel } else { Answer::None.or_cancel(closed) }
}

const MOUSE: &[(&str, &str)] = &[
    ("Left drag on a piece or the body", "Paint a mark (tool Mark); a click makes a dot"),
    ("Left click on a mark", "Select it; its name and number are in the side panel"),
    ("Ctrl + left click on a mark", "Take it away"),
    ("Left drag on a piece", "Move it (tool Move); a double-click turns it over"),
    ("Space + left drag on the table", "Move the view"),
    ("Wheel", "Zoom to the pointer"),
    ("Esc while drawing", "Give the stroke up"),
];

/// A native file dialog of the desktop, open beside the window.
pub struct NativeDialog {
    purpose: Purpose,
    opened: Instant,
    answer: Pin<Box<dyn Future<Output = Option<PathBuf>>>>,
}

impl std::fmt::Debug for NativeDialog {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "NativeDialog({:?})", self.purpose)
    }
}

/// Wakes the window when the native dialog has an answer.
struct Repaint(egui::Context);

impl Wake for Repaint {
    fn wake(self: Arc<Self>) {
        self.0.request_repaint();
    }
}

impl NativeDialog {
    /// Opens a native dialog; None where there is no desktop that has one.
    pub fn open(purpose: Purpose, current: Option<&Path>) -> Option<Self> {
        if cfg!(target_os = "linux") && std::env::var_os("DBUS_SESSION_BUS_ADDRESS").is_none() {
            return None;
        }
        let (kind, extensions) = purpose.filter();
        let mut dialog =
            rfd::AsyncFileDialog::new().set_title(tr(purpose.title())).add_filter(tr(kind), extensions);
        if let Some(folder) = current.and_then(Path::parent) {
            dialog = dialog.set_directory(folder);
        }
        let answer: Pin<Box<dyn Future<Output = Option<PathBuf>>>> = if purpose.writes() {
            let name = current.and_then(Path::file_name).map(|n| n.to_string_lossy().into_owned());
            let name = name.filter(|_| purpose == Purpose::Save).unwrap_or_else(|| purpose.default_name());
            let shown = dialog.set_file_name(name).save_file();
            Box::pin(async move { shown.await.map(|f| f.path().to_owned()) })
        } else {
            let shown = dialog.pick_file();
            Box::pin(async move { shown.await.map(|f| f.path().to_owned()) })
        };
        Some(Self { purpose, opened: Instant::now(), answer })
    }

    /// Checks for an answer. A native dialog that could not be shown is replaced by one of our own.
    pub fn poll(&mut self, ctx: &egui::Context) -> Option<Result<PathBuf, Option<Dialog>>> {
        let waker = Waker::from(Arc::new(Repaint(ctx.clone())));
        match self.answer.as_mut().poll(&mut Context::from_waker(&waker)) {
            Poll::Pending => None,
            Poll::Ready(Some(path)) => {
                let (purpose, whole) = (self.purpose, with_extension(path.clone(), self.purpose));
                // The desktop has asked about the name that was chosen, not about the one with its ending.
                let is_other = whole != path && whole.exists();
                Some(if is_other { Err(Some(Dialog::Exists { purpose, path: whole })) } else { Ok(whole) })
            }
            Poll::Ready(None) if self.opened.elapsed() < TOO_QUICK => {
                Some(Err(Some(Dialog::Path { purpose: self.purpose, text: String::new() })))
            }
            Poll::Ready(None) => Some(Err(None)),
        }
    }

    /// The purpose of the dialog.
    pub fn purpose(&self) -> Purpose {
        self.purpose
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn written_files_get_their_extension_once() {
        let cases = [
            (Purpose::Save, "a/b", "a/b.toile"),
            (Purpose::Save, "a/b.toile", "a/b.toile"),
            (Purpose::Export, "x.GLB", "x.GLB"),
            (Purpose::Export, "x.usdz", "x.usdz"),
            (Purpose::Export, "x.y", "x.y.obj"),
            (Purpose::Open, "whatever", "whatever"),
        ];
        for (purpose, given, wanted) in cases {
            assert_eq!(with_extension(given.into(), purpose), PathBuf::from(wanted));
        }
    }
}
