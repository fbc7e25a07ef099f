//! Saves unsaved work for recovery after a crash, and offers it after one.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, SystemTime};

use crate::geometry::words::{Words, words};
use crate::session::recovery::{About, Keeper, Left, left};
use crate::session::{Session, whole_file};
use crate::ui::app::App;
use crate::ui::files;
use crate::ui::language::{counted, said, say, tr};
use crate::ui::shell::dialogs::Dialog;

/// Additional delay of a copy while the cloth is moving, seconds.
const LATEST: f64 = 50.0;

/// Whether unsaved work of a window is being kept.
static KEPT: AtomicBool = AtomicBool::new(false);

/// Whether unsaved work of the window is being kept for recovery.
pub fn is_kept() -> bool {
    KEPT.load(Ordering::Relaxed)
}

/// The system's folder for work that is not saved yet; None where there is no home folder.
pub fn usual_root() -> Option<PathBuf> {
    let folder = |name: &str| std::env::var_os(name).map(PathBuf::from).filter(|p| p.is_absolute());
    let base = if cfg!(windows) {
        folder("LOCALAPPDATA")
    } else if cfg!(target_os = "macos") {
        folder("HOME").map(|home| home.join("Library/Application Support"))
    } else {
        folder("XDG_STATE_HOME").or_else(|| folder("HOME").map(|home| home.join(".local/state")))
    };
    base.map(|base| base.join("toile/sessions"))
}

/// Keeps copies of the window's work for recovery.
#[derive(Debug, Default)]
pub struct Safety {
    keeper: Option<Keeper>,
    /// The thread that writes a copy, so that the window need not wait for the disk.
    writing: Option<JoinHandle<Result<(), Words>>>,
    /// Time of the newest copy, in the window's seconds.
    copied: f64,
    /// Whether the work has been saved or replaced since the newest copy, so that a new one is needed.
    fresh: bool,
    /// Shortest time between two copies, seconds. After an undo beyond the last copy one is made at once.
    pub soonest: f64,
}

impl Safety {
    /// Begins to keep work under `root`. Also returns the work left there by sessions that did not end properly, and why nothing
    /// can be kept, if so.
    pub fn begin(root: &Path) -> (Self, Vec<Left>, Option<String>) {
        let found = left(root);
        let begun = Keeper::begin(root);
        KEPT.store(begun.is_ok(), Ordering::Relaxed);
        match begun {
            Ok(keeper) => (
                Self { keeper: Some(keeper), writing: None, copied: 0.0, fresh: true, soonest: 10.0 },
                found,
                None,
            ),
            Err(why) => (
                Self::default(),
                found,
                Some(format!("{}: {}", root.display(), said(&whole_file::words(&why)))),
            ),
        }
    }

    /// Notes that the session was replaced or its work saved.
    pub fn work_is_saved(&mut self) {
        self.fresh = true;
    }

    /// Makes a copy if one is due. `now` is in seconds; `busy`: something is being dragged; `at_rest`: the cloth does not move.
    /// The error says why no more work is kept.
    pub fn tend(
        &mut self,
        session: &mut Session,
        path: Option<&Path>,
        now: f64,
        busy: bool,
        at_rest: bool,
    ) -> Result<(), String> {
        if let Err(why) = self.join(false) {
            self.give_up(session);
            return Err(why);
        }
        if self.writing.is_some() {
            return Ok(()); // One after the other; the journals tell the rest.
        }
        let Some(keeper) = &mut self.keeper else { return Ok(()) };
        let since = now - self.copied;
        let due = !session.is_copied() && !busy && since > self.soonest + if at_rest { 0.0 } else { LATEST };
        if !(self.fresh || session.needs_copy() || due) {
            return Ok(());
        }
        let name = path.map_or_else(|| "untitled".to_owned(), files::stem);
        let about = About { name, path: path.map(Path::to_owned), unsaved: session.is_modified() };
        let begun = keeper.copy(&about).map_err(|why| why.to_string()).and_then(|(journal, copying)| {
            let project = session.project();
            let writing = move || copying.write(&project).map_err(|why| why.words());
            let thread = std::thread::Builder::new().name("copy".to_owned());
            self.writing = Some(thread.spawn(writing).map_err(|why| why.to_string())?);
            session.mark_copied(Some(journal));
            Ok(())
        });
        (self.copied, self.fresh) = (now, false);
        if begun.is_err() {
            self.give_up(session);
        }
        begun
    }

    /// Takes the result of a copy that is being written if it has finished; with `at_any_rate` waits for it.
    fn join(&mut self, at_any_rate: bool) -> Result<(), String> {
        match self.writing.take_if(|writing| at_any_rate || writing.is_finished()) {
            Some(writing) => {
                let written = writing.join();
                written
                    .unwrap_or_else(|_| Err(words!("the copy could not be written")))
                    .map_err(|why| said(&why))
            }
            None => Ok(()),
        }
    }

    fn give_up(&mut self, session: &mut Session) {
        KEPT.store(false, Ordering::Relaxed);
        self.keeper = None;
        session.mark_copied(None);
    }

    /// Time until a copy is due, for which the window must be woken.
    pub fn due_in(&self, session: &Session, now: f64) -> Option<Duration> {
        let waits = self.keeper.is_some() && !session.is_copied();
        waits.then(|| Duration::from_secs_f64((self.copied + self.soonest + 0.5 - now).max(0.5)))
    }

    /// The window closes properly: unsaved work is discarded.
    pub fn finish(&mut self) {
        self.join(true).ok();
        if let Some(keeper) = self.keeper.take() {
            keeper.finish().ok();
        }
    }
}

impl Drop for Safety {
    /// Waits for a copy in progress, also when the window panics.
    fn drop(&mut self) {
        self.join(true).ok();
    }
}

impl App {
    /// Begins to keep work under `root`, and offers work left there by sessions that did not end properly.
    pub fn keep_safe(&mut self, root: &Path) {
        let (safety, found, problem) = Safety::begin(root);
        self.safety = safety;
        if let Some(words) = problem {
            self.messages.error(say!("Unsaved work cannot be kept safe: {why}", why = words));
        }
        if !found.is_empty() {
            let found = found.into_iter().map(|left| (words_for(&left), left)).map(|(w, l)| (l, w));
            self.dialog = Some(Dialog::Recover { found: found.collect() });
        }
    }

    /// The window closes.
    pub fn finish(&mut self) {
        self.safety.finish();
    }

    /// The window ends: because it is closed or, when its display is lost, without anybody's consent. Then unsaved work stays.
    pub fn end(&mut self) {
        if self.may_close || !self.session.is_modified() {
            self.finish();
        }
    }

    pub(in crate::ui) fn tend_safety(&mut self, ctx: &egui::Context) {
        let (now, held) = ctx.input(|i| (i.time, i.pointer.any_down()));
        let at_rest = !self.session.snapshot().working;
        let busy = held || self.drag.is_some();
        self.safety.soonest = self.preferences.copies.seconds();
        if let Err(words) = self.safety.tend(&mut self.session, self.path.as_deref(), now, busy, at_rest) {
            self.messages.error(say!("Unsaved work is no longer kept safe: {why}", why = words));
        }
        if let Some(why) = self.session.recorder().take_journal_error() {
            self.messages.error(say!("Unsaved work is no longer kept safe: {why}", why));
        }
        if let Some(wait) = self.safety.due_in(&self.session, now) {
            ctx.request_repaint_after(wait);
        }
    }

    /// Restores work that a session left behind.
    pub(in crate::ui) fn restore(&mut self, ctx: &egui::Context, left: Left) {
        let found = match left.read() {
            Ok(found) => found,
            Err(why) => {
                return self
                    .messages
                    .error(say!("This work cannot be read; it is kept: {why}", why = said(&why.words())));
            }
        };
        self.replace(found.project, left.about.path.clone());
        self.session.mark_modified();
        let (mut open, mut left_over) = (None, found.commands.len());
        for (gesture, command) in found.commands {
            let own = match open {
                Some((of, own)) if of == gesture => own,
                _ => self.session.begin_gesture(),
            };
            open = Some((gesture, own));
            // This command no longer applies, so the later ones would be applied to a different state.
            if self.session.apply(command, own).is_err() {
                break;
            }
            left_over -= 1;
        }
        if let Some((_, own)) = open {
            self.session.end_gesture(own);
        }
        match found.lost + left_over {
            0 => self.messages.tell(tr("Your work is back. Save it when it is as you want it.")),
            lost => self.messages.error(say!(
                "Your work is back, but for the last {lost} of the things you did, which were not written down whole.",
                lost
            )),
        }
        // The old copy is removed only when the new session has one of its own.
        self.safety.join(true).ok();
        self.tend_safety(ctx);
        if self.session.is_copied() && self.safety.join(true).is_ok() {
            left.forget().ok();
        }
    }

    /// Saves to `path`; if that fails, asks what to do.
    pub(in crate::ui) fn save_or_ask(&mut self, ctx: &egui::Context, path: &Path) {
        if let Err(words) = self.save_to(ctx, path) {
            self.dialog = Some(Dialog::NotSaved { path: path.to_owned(), words });
        }
    }

    pub(in crate::ui) fn save_to(&mut self, ctx: &egui::Context, path: &Path) -> Result<(), String> {
        let ours = self.path.as_deref() == Some(path);
        if ours
            && self.on_disk.is_some()
            && files::OnDisk::of(path).is_some_and(|now| Some(now) != self.on_disk)
        {
            self.dialog = Some(Dialog::ChangedOnDisk { path: path.to_owned() });
            return Ok(());
        }
        files::save(path, &self.session.project())?;
        self.is_saved(ctx, path);
        Ok(())
    }

    /// Saves to `path` even if the file is write-protected.
    pub(in crate::ui) fn save_over(&mut self, ctx: &egui::Context, path: &Path) {
        match files::save_over(path, &self.session.project()) {
            Ok(()) => self.is_saved(ctx, path),
            Err(words) => self.messages.error(words),
        }
    }

    fn is_saved(&mut self, ctx: &egui::Context, path: &Path) {
        self.session.mark_saved();
        self.safety.work_is_saved();
        self.on_disk = files::OnDisk::of(path);
        self.path = Some(path.to_owned());
        self.remember(path);
        self.wrote(path);
        if let Some(action) = self.after_save.take() {
            self.act_unguarded(ctx, action);
        }
    }
}

/// A name for left work, such as "shirt, 12 minutes ago".
pub fn words_for(left: &Left) -> String {
    let written = std::fs::metadata(left.written()).and_then(|file| file.modified()).ok();
    let ago = written.and_then(|then| SystemTime::now().duration_since(then).ok());
    let name = match (left.about.name.as_str(), &left.about.path) {
        ("", _) | ("untitled", None) => tr("untitled"),
        (name, _) => name,
    };
    match ago {
        Some(ago) => format!("{name}, {}", in_words(ago)),
        None => name.to_owned(),
    }
}

fn in_words(ago: Duration) -> String {
    let minutes = ago.as_secs() as usize / 60;
    match minutes {
        0 => tr("just now").to_owned(),
        1..60 => counted(minutes, "1 minute ago", "{n} minutes ago"),
        60..1440 => counted(minutes / 60, "1 hour ago", "{n} hours ago"),
        _ => counted(minutes / 1440, "1 day ago", "{n} days ago"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_told_in_words() {
        let told = |seconds| in_words(Duration::from_secs(seconds));
        let words = [told(20), told(60), told(59 * 60), told(7300), told(26 * 3600), told(864_000)];
        assert_eq!(
            words,
            ["just now", "1 minute ago", "59 minutes ago", "2 hours ago", "1 day ago", "10 days ago"]
        );
    }
}
