//! The window's state, and the drawing of one frame.

pub(in crate::ui) mod act;
pub(in crate::ui) mod all_sizes;
pub(in crate::ui) mod arrange;
mod bar;
mod bow;
pub(in crate::ui) mod demo;
pub(in crate::ui) mod depth_of_field;
pub(in crate::ui) mod drawer;
pub(in crate::ui) mod dressing;
pub(in crate::ui) mod environment;
pub(in crate::ui) mod exchange;
pub(in crate::ui) mod focus_round;
pub(in crate::ui) mod keyboard;
pub(in crate::ui) mod marker_page;
mod marker_preview;
pub(in crate::ui) mod panes;
pub(in crate::ui) mod picking;
pub(in crate::ui) mod picture_page;
pub(in crate::ui) mod player;
pub(in crate::ui) mod reopening;
pub(in crate::ui) mod reporting;
pub(in crate::ui) mod run;
pub(in crate::ui) mod safety;
pub(in crate::ui) mod shell;
pub(in crate::ui) mod start_page;
pub(in crate::ui) mod tech_pack;
pub(in crate::ui) mod tight;
pub(in crate::ui) mod tour;
pub(in crate::ui) mod tries;
pub(in crate::ui) mod turn;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::ViewportCommand;

use crate::card::CardSlot;
use crate::drape::garment::on_card::LEAST_TRIANGLES;
use crate::geometry::ids::MarkId;
use crate::render::Camera;
use crate::session::{Command, GestureId, Notice, Project, Session};
use crate::sim::{Runner, Simulation, Started, thread::DEFAULT_RATE_HZ};
use crate::ui::actions::asks::{Ask, Asks};
use crate::ui::actions::{Action, Tool};
use crate::ui::app::picking::Picks;
use crate::ui::app::picture_page::PictureOptions;
use crate::ui::app::player::Player;
use crate::ui::app::reopening::Wakeup;
use crate::ui::app::safety::Safety;
use crate::ui::app::shell::Shell;
use crate::ui::body_pane::ScenePane;
use crate::ui::body_pane::ghosts::Ghosts;
use crate::ui::files::recent::Recent;
use crate::ui::files::{self, Purpose};
use crate::ui::language::choice::{self, Languages};
use crate::ui::language::{self, said, say, tr};
use crate::ui::look::scheme::Scheme;
use crate::ui::look::theme::{self, Palette};
use crate::ui::panels::marks::MarksPanel;
use crate::ui::panels::pattern::PatternPanel;
use crate::ui::pattern_pane::view::TableView;
use crate::ui::pattern_pane::{PLACE_HEIGHT, PatternPane};
use crate::ui::preferences::Preferences;
use crate::ui::scenery::scene::Scenery;
use crate::ui::selection::Selection;
use crate::ui::shell::dialogs::{Answer, Dialog, NativeDialog};
use crate::ui::shell::messages::Messages;
use crate::ui::shell::pace::Pacer;
use crate::ui::shell::status;

/// The window's state. What the user has done is in the session; everything else is about how it is shown.
#[derive(Debug)]
pub struct App {
    pub(in crate::ui) session: Session,
    pub(in crate::ui) path: Option<PathBuf>,
    pub(in crate::ui) tool: Tool,
    pub(in crate::ui) laser: bool,
    /// The mark selected in a pane or in the list.
    pub(in crate::ui) selected: Option<MarkId>,
    /// The selection in the pattern.
    pub(in crate::ui) picks: Picks,
    /// Whether the pointer snaps to points, edges, guides and the grid.
    pub(in crate::ui) snapping: bool,
    pub(in crate::ui) marks_panel: MarksPanel,
    pub(in crate::ui) pattern_panel: PatternPanel,
    /// Proposed marks that are not accepted yet.
    pub(in crate::ui) ghosts: Option<Ghosts>,
    /// The result of the last starts, once it was reported.
    pub(in crate::ui) started: Option<Arc<Started>>,
    pub(in crate::ui) pattern_pane: PatternPane,
    pub(in crate::ui) scene_pane: ScenePane,
    pub(in crate::ui) show_cloth: bool,
    pub(in crate::ui) show_panel: bool,
    pub(in crate::ui) dialog: Option<Dialog>,
    pub(in crate::ui) native: Option<NativeDialog>,
    pub(in crate::ui) messages: Messages,
    pub(in crate::ui) may_close: bool,
    /// A demo that is shown instead of the document, with the views of both panes to return to.
    pub(in crate::ui) demo: Option<(Player, Camera, TableView)>,
    pub(in crate::ui) preferences: Preferences,
    pub(in crate::ui) languages: Languages,
    /// The file of the preferences.
    pub(in crate::ui) preferences_path: Option<PathBuf>,
    /// An action to be carried out once the project is saved.
    pub(in crate::ui) after_save: Option<Action>,
    pub(in crate::ui) safety: Safety,
    /// State of the project's file when it was last opened or saved here.
    pub(in crate::ui) on_disk: Option<files::OnDisk>,
    pub(in crate::ui) drag: Option<GestureId>,
    /// Sequence number of the last request for a wrap.
    pub(in crate::ui) wrap_seq: Option<u64>,
    /// The interface around the panes.
    pub(in crate::ui) shell: Shell,
    /// The options of the last picture.
    pub(in crate::ui) picture_options: PictureOptions,
    /// Builds the scenes of pictures that are written to files.
    pub(in crate::ui) scenery: Scenery,
    /// Wakes the window when the simulation has new results.
    pub(in crate::ui) wakeup: Wakeup,
    /// Whether the window closes only to be reopened.
    pub(in crate::ui) moving: bool,
    /// The colours of the last frame.
    pub(in crate::ui) scheme: Scheme,
    /// Measures the speed of the window and of the simulation.
    pub(in crate::ui) pacer: Pacer,
    /// The graphics card that large garments are draped on.
    card: Arc<CardSlot>,
    title: String,
    pub(in crate::ui) frames: u64,
}

impl App {
    /// The window's state on `project`. Without `graphics` the body pane stays empty.
    pub fn new(
        ctx: &egui::Context,
        project: Project,
        path: Option<PathBuf>,
        graphics: Option<egui_wgpu::RenderState>,
    ) -> std::io::Result<Self> {
        Self::set_up(ctx);
        let on_disk = path.as_deref().and_then(files::OnDisk::of);
        let wakeup = Wakeup::new(ctx);
        Ok(Self {
            session: Session::new(project, runner(&wakeup, DEFAULT_RATE_HZ)?),
            wakeup,
            moving: false,
            path,
            tool: Tool::Mark,
            laser: false,
            selected: None,
            picks: Picks::default(),
            snapping: true,
            marks_panel: MarksPanel::default(),
            pattern_panel: PatternPanel::default(),
            ghosts: None,
            started: None,
            pattern_pane: PatternPane::fitted(),
            scene_pane: ScenePane::new(graphics),
            show_cloth: true,
            show_panel: true,
            dialog: None,
            native: None,
            messages: Messages::default(),
            may_close: false,
            demo: None,
            preferences: Preferences::default(),
            languages: Languages::default(),
            preferences_path: None,
            after_save: None,
            safety: Safety::default(),
            on_disk,
            drag: None,
            wrap_seq: None,
            shell: Shell::default(),
            picture_options: PictureOptions::default(),
            scenery: Scenery::default(),
            scheme: Scheme::default(),
            pacer: Pacer::default(),
            card: Arc::new(CardSlot::new(false, LEAST_TRIANGLES)),
            title: String::new(),
            frames: 0,
        })
    }

    /// Settings that every window needs.
    pub(in crate::ui) fn set_up(ctx: &egui::Context) {
        theme::install(ctx);
        ctx.options_mut(|options| {
            // The program asks by itself before closing; plus, minus and zero are keys of the panes.
            options.quit_shortcuts.clear();
            options.zoom_with_keyboard = false;
        });
    }

    /// Reads the preferences from `path` and saves changes there from now on.
    pub fn keep_preferences(&mut self, ctx: &egui::Context, path: PathBuf) {
        let (preferences, words) = Preferences::read(&path);
        self.preferences = preferences;
        if let Some(words) = words {
            self.messages.error(words);
        }
        self.shell.recent = Recent::read(path.with_file_name("recent.json"));
        let no_tables = self.languages.read(&path.with_file_name(choice::FOLDER));
        self.preferences_path = Some(path);
        self.live_by_preferences(ctx);
        // The language is known only now.
        no_tables.iter().for_each(|words| self.messages.error(said(words)));
        self.read_kept_environment(ctx);
    }

    /// Lets the session drape on the graphics card if the user wants that, and no recording is written whose hashes it would cost.
    pub(super) fn use_card(&mut self) {
        let wanted = self.preferences.card.0 && !self.session.recorder().has_file();
        self.session.use_card(wanted.then(|| Arc::clone(&self.card)));
    }

    /// Follows the system's language, `locale`, unless the user chose another.
    pub fn follow_language(&mut self, locale: String) {
        self.languages.take_system(locale);
        self.speak();
    }

    /// Shows all texts from now on in the chosen language.
    pub(in crate::ui) fn speak(&self) {
        language::show(self.languages.table(&self.preferences.language));
    }

    /// Shows an error message.
    pub fn warn(&mut self, words: &str) {
        self.messages.error(words);
    }

    /// Also writes the recording, from the beginning on, to `file`.
    pub fn record_to(&mut self, file: std::fs::File) -> std::io::Result<()> {
        self.session.recorder().also_to(file)?;
        self.use_card();
        Ok(())
    }

    /// Number of frames drawn.
    pub fn frames(&self) -> u64 {
        self.frames
    }

    /// The session, for reading.
    pub fn session(&self) -> &Session {
        &self.session
    }

    /// The session, to apply commands as the user would.
    pub fn session_mut(&mut self) -> &mut Session {
        &mut self.session
    }

    /// Saves the project to `path`; asks first if another program has changed the file.
    pub fn save_as(&mut self, ctx: &egui::Context, path: &Path) -> Result<(), String> {
        self.save_to(ctx, path)
    }

    /// The camera of the body pane.
    pub fn camera(&self) -> Camera {
        self.scene_pane.camera
    }

    /// Position of a point of the table on the screen; None before the first frame.
    pub fn on_screen(&self, p: glam::DVec2) -> Option<egui::Pos2> {
        Some(self.pattern_pane.view.screen_from_table(self.pattern_pane.area?, p))
    }

    /// While the pointer is over cloth held by pins: the fraction of a drag's motion that would reach each vertex, 0..=1.
    pub fn reach(&self) -> Option<&[f32]> {
        self.scene_pane.reached()
    }

    /// The recording of everything done.
    pub fn recording(&mut self) -> String {
        self.session.recording()
    }

    /// Number of pictures of the body drawn.
    pub fn pictures(&self) -> u64 {
        self.scene_pane.graphics.as_ref().map_or(0, |g| g.pictures)
    }

    /// Number of maps computed.
    pub fn maps(&self) -> u64 {
        self.shell.maps.computed()
    }

    /// Replaces the project by `project`.
    pub(in crate::ui) fn replace(&mut self, project: Project, path: Option<PathBuf>) {
        match runner(&self.wakeup, DEFAULT_RATE_HZ) {
            Ok(runner) => {
                self.session = Session::new(project, runner);
                self.use_card();
            }
            Err(e) => {
                return self.messages.error(say!("The simulation could not be started: {why}", why = e));
            }
        }
        self.on_disk = path.as_deref().and_then(files::OnDisk::of);
        self.path = path;
        self.safety.work_is_saved();
        self.drag = None;
        self.wrap_seq = None;
        self.selected = None;
        self.picks = Picks::default();
        (self.ghosts, self.started) = (None, None);
        self.leave_start_page();
        self.shell.maps.compare(None);
        self.pattern_pane = PatternPane::fitted();
        self.scene_pane.frame = Some(Some(crate::render::View::Front));
    }

    /// Draws one frame and carries out its requests.
    pub fn ui(&mut self, ui: &mut egui::Ui) {
        self.frames += 1;
        self.speak();
        let ctx = ui.ctx().clone();
        self.take_notices();
        self.play_demo(&ctx);
        let document = self.shown().document().clone();
        let snapshot = Arc::clone(self.shown().snapshot());
        self.take_start(&document, &snapshot);
        self.ghosts = self.ghosts.take().and_then(|ghosts| ghosts.now(&document, self.shown().surface()));
        self.carry_selection(&document);
        self.take_comparison();
        self.take_environment(&ctx);
        self.shell.maps.look(&snapshot, &document.fabrics, self.shell.sight.body_look);
        let now = self.situation(&ctx, &document, &snapshot);
        self.scheme = Scheme::of(self.preferences.theme, ctx.theme());
        let palette = Palette::of(self.scheme);
        let mut asks = Asks::new();
        self.escape_from_bar(&ctx, &now);
        self.keys(&ctx, &now, &mut asks);
        if self.shell.start.is_some() {
            self.start_page(ui, &now, &palette, &mut asks);
        } else {
            self.panels(ui, &document, &snapshot, &now, &palette, &mut asks);
        }
        self.over_panes(&ctx, &now, &palette, &mut asks);
        self.messages.ui(&ctx, &palette, self.below_messages(&ctx));
        if let (Some((player, ..)), Some(table)) = (&self.demo, self.pattern_pane.area) {
            player.ui(&ctx, &palette, table, &mut asks);
            asks.retain(|ask| matches!(ask, Ask::Act(action) if action.row().in_demos));
        }
        if !asks.is_empty() {
            // This frame showed the state before the requests were carried out.
            ctx.request_repaint();
        }
        for ask in asks {
            self.carry_out(&ctx, ask);
        }
        self.dialogs(&ctx);
        self.tend_focus(&ctx);
        self.dropped_files(&ctx);
        self.guard_closing(&ctx);
        self.set_title(&ctx);
        self.tend_safety(&ctx);
        self.tend_graphics(&ctx);
    }

    /// Height of what stays free below the messages, points: the status bar, and of the table the position of the pointer.
    fn below_messages(&self, ctx: &egui::Context) -> f32 {
        let table = self.pattern_pane.area.filter(|_| self.shell.start.is_none());
        let below = |pane: egui::Rect| ctx.content_rect().bottom() - pane.bottom() + PLACE_HEIGHT;
        table.map_or(status::HEIGHT, below)
    }

    /// Makes the next frame set the window's title.
    pub(in crate::ui) fn forget_title(&mut self) {
        self.title.clear();
    }

    /// The session that is shown: the document's, or that of a demo.
    pub fn shown(&self) -> &Session {
        self.demo.as_ref().map_or(&self.session, |(player, ..)| player.session())
    }

    fn take_notices(&mut self) {
        if let Some(why) = self.session.recorder().take_file_error() {
            self.messages.error(say!("The recording is no longer written to its file: {why}", why));
        }
        for notice in self.session.update() {
            match notice {
                Notice::AtRest { .. } => {}
                Notice::Failed { words, .. } => self.messages.error(said(&words)),
                Notice::HistoryShortened => {
                    self.messages.tell(tr("Older steps can no longer be undone, to save memory."));
                }
            }
        }
    }

    fn carry_out(&mut self, ctx: &egui::Context, ask: Ask) {
        match ask {
            Ask::Act(action) => self.act(ctx, action),
            Ask::Do(command) => self.apply_and_select(command),
            Ask::Drag(command) => self.drag(command),
            Ask::EndDrag => self.end_drag(),
            Ask::CancelDrag => self.cancel_drag(),
            Ask::Select(mark) => {
                self.selected = mark;
                if mark.is_some() {
                    self.pick(Selection::default());
                }
            }
            Ask::Pick(selection) => self.pick(selection),
            Ask::ShowMarks(numbers) => self.show_marks(&numbers),
            Ask::ShowPlace(place) => self.show_place(place),
            Ask::MapRange(kind, range) => self.shell.maps.set_range(kind, range),
            Ask::Say(words) => self.messages.tell(words),
            Ask::ShowSizes(sizes) => self.shell.size_view = sizes,
            Ask::Jump(steps) => self.jump(steps),
        }
    }

    /// Applies `command` as an undo step of its own; if it is refused, an error is shown.
    pub(in crate::ui) fn apply(&mut self, command: Command) {
        self.end_drag();
        let is_wrap =
            matches!(command, Command::Wrap | Command::Rewrap { .. } | Command::Sew | Command::Dress { .. });
        let is_body = matches!(command, Command::SetBody { .. } | Command::ChangeSize { .. });
        match self.session.apply_alone(command) {
            Ok(()) if is_wrap => self.wrap_seq = Some(self.session.last_seq()),
            Ok(()) if is_body => self.tell_lost_marks(),
            Ok(()) => {}
            Err(why) => self.messages.error(sentence(&said(&why.0))),
        }
    }

    fn tell_lost_marks(&mut self) {
        let lost = self.session.problems();
        if !lost.is_empty() {
            let places: Vec<&str> = lost.iter().map(|p| p.place.as_str()).collect();
            self.messages.error(say!("Not carried to the new body: {places}.", places = places.join(", ")));
        }
    }

    fn drag(&mut self, command: Command) {
        let gesture = *self.drag.get_or_insert_with(|| self.session.begin_gesture());
        // The drag may go on to a place where the command is possible, so this is no error that stays on the screen.
        if let Err(why) = self.session.apply(command, gesture) {
            self.messages.tell(sentence(&said(&why.0)));
        }
    }

    pub(in crate::ui) fn end_drag(&mut self) {
        if let Some(gesture) = self.drag.take() {
            self.session.end_gesture(gesture);
        }
    }

    fn cancel_drag(&mut self) {
        if let Some(gesture) = self.drag.take() {
            // It is refused only when the drag has changed nothing yet.
            self.session.apply(Command::CancelGesture, gesture).ok();
            self.session.end_gesture(gesture);
        }
    }

    fn dialogs(&mut self, ctx: &egui::Context) {
        if let Some(native) = &mut self.native
            && let Some(answer) = native.poll(ctx)
        {
            let purpose = native.purpose();
            self.native = None;
            match answer {
                Ok(path) => self.file(ctx, purpose, &path),
                Err(Some(own)) => self.dialog = Some(own),
                Err(None) => self.after_save = None,
            }
        }
        let Some(dialog) = &mut self.dialog else { return };
        let answer = dialog.ui(ctx, &mut self.shell.thumbnails);
        if matches!(answer, Answer::None) {
            return;
        }
        self.dialog = None;
        ctx.request_repaint();
        match answer {
            Answer::None => {}
            Answer::Cancel => self.after_save = None,
            Answer::SaveThen(action) => {
                self.after_save = Some(action);
                self.act(ctx, Action::Save);
            }
            Answer::Discard(action) => self.act_unguarded(ctx, action),
            Answer::File(purpose, path) => self.file(ctx, purpose, &path),
            Answer::Restore(left) => self.restore(ctx, *left),
            Answer::Elsewhere(purpose) => self.ask_file(purpose),
            Answer::Export(written) => {
                if let Err(words) = self.write_export(&written) {
                    self.messages.error(words);
                }
            }
            Answer::Replace(path) => self.save_over(ctx, &path),
            Answer::Overwrite(path) => {
                self.on_disk = None;
                self.file(ctx, Purpose::Save, &path);
            }
            Answer::Pattern(path, unit) => {
                self.prefer(ctx, |p| p.answers.keep_drawing(&path, unit));
                if let Err(words) = self.import_pattern(&path, Some(unit)) {
                    self.messages.error(words);
                }
            }
            Answer::TechPack(code) => {
                self.shell.pack_language = Some(code);
                self.ask_file(Purpose::TechPack);
            }
            Answer::Bow(at, bow) => self.add_bow(at, bow),
            Answer::Body(raw) => {
                self.prefer(ctx, |p| p.answers.body = Some((raw.unit, raw.up)));
                if let Err(words) = self.take_body(*raw) {
                    self.messages.error(words);
                }
            }
        }
    }

    fn guard_closing(&mut self, ctx: &egui::Context) {
        if ctx.input(|i| i.viewport().close_requested()) && !self.may_close && self.session.is_modified() {
            ctx.send_viewport_cmd(ViewportCommand::CancelClose);
            self.dialog = Some(Dialog::Unsaved { then: Action::Quit });
        }
    }

    fn set_title(&mut self, ctx: &egui::Context) {
        let name = self.path.as_deref().and_then(Path::file_stem).map(|n| n.to_string_lossy());
        let mark = if self.session.is_modified() { " •" } else { "" };
        let title = format!("{}{mark} – Toile", name.as_deref().unwrap_or(tr("Untitled")));
        if title != self.title {
            ctx.send_viewport_cmd(ViewportCommand::Title(title.clone()));
            self.title = title;
        }
    }
}

/// A simulation on its own thread, of `rate_hz` ticks a second at most, that wakes the window when it has new results.
fn runner(wakeup: &Wakeup, rate_hz: f64) -> std::io::Result<Runner> {
    let wakeup = wakeup.clone();
    Runner::threaded(Simulation::default(), rate_hz, Box::new(move || wakeup.wake()))
}

pub(in crate::ui) fn sentence(words: &str) -> String {
    let mut letters = words.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string()).unwrap_or_default();
    format!("{first}{}.", letters.as_str())
}
