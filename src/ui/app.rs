//! The window's state and one frame of it.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::{CentralPanel, Frame, Key, KeyboardShortcut, Margin, Modifiers, Panel, ViewportCommand};

use crate::geometry::ids::MarkId;
use crate::io::scale::DrawingUnit;
use crate::render::Camera;
use crate::session::{Command, Document, GestureId, Notice, Project, Session};
use crate::sim::{Runner, Simulation, Snapshot, thread::DEFAULT_RATE_HZ};
use crate::ui::actions::{Action, Tool};
use crate::ui::asks::{Ask, Asks};
use crate::ui::dialogs::{Answer, Dialog, NativeDialog};
use crate::ui::edits::Picked;
use crate::ui::files::{self, PatternImport, Purpose, RawBody};
use crate::ui::ghosts::Ghosts;
use crate::ui::marks_panel::MarksPanel;
use crate::ui::messages::Messages;
use crate::ui::mouse::Mouse;
use crate::ui::pattern_pane::view::TableView;
use crate::ui::pattern_pane::{self, Laid, PatternPane};
use crate::ui::pattern_panel::PatternPanel;
use crate::ui::picking::Picks;
use crate::ui::player::Player;
use crate::ui::preferences::Preferences;
use crate::ui::safety::Safety;
use crate::ui::scene_pane::{self, ScenePane, Seen};
use crate::ui::selection::Selection;
use crate::ui::side_panel::Told;
use crate::ui::situation::Situation;
use crate::ui::theme::{self, Palette};
use crate::ui::{menu, side_panel, status, toolbar};
use crate::wrap::Phase;

/// The window's state. What the user has done is the session's; the rest is how it is looked at.
#[derive(Debug)]
pub struct App {
    pub(super) session: Session,
    pub(super) path: Option<PathBuf>,
    pub(super) tool: Tool,
    pub(super) laser: bool,
    /// The mark chosen in a pane or in the list.
    pub(super) selected: Option<MarkId>,
    /// What is selected of the pattern.
    pub(super) picks: Picks,
    /// What lies near draws the pointer on.
    pub(super) snapping: bool,
    marks_panel: MarksPanel,
    pattern_panel: PatternPanel,
    /// Marks proposed and not accepted yet.
    pub(super) ghosts: Option<Ghosts>,
    pub(super) pattern_pane: PatternPane,
    pub(super) scene_pane: ScenePane,
    pub(super) show_cloth: bool,
    pub(super) show_panel: bool,
    pub(super) dialog: Option<Dialog>,
    pub(super) native: Option<NativeDialog>,
    pub(super) messages: Messages,
    pub(super) may_close: bool,
    /// A demo that is shown instead of the document, and how both panes were seen before.
    pub(super) demo: Option<(Player, Camera, TableView)>,
    pub(super) preferences: Preferences,
    /// Where they are kept.
    pub(super) preferences_path: Option<PathBuf>,
    /// To be done once the project is saved.
    pub(super) after_save: Option<Action>,
    pub(super) safety: Safety,
    /// What the project's file was when it was opened or saved here.
    pub(super) on_disk: Option<files::OnDisk>,
    pub(super) drag: Option<GestureId>,
    /// The last wrap asked for, and what was then the tick of the simulation.
    wrap_seq: Option<u64>,
    title: String,
    frames: u64,
}

impl App {
    /// The window on `project`. Without `graphics` the body pane stays empty.
    pub fn new(
        ctx: &egui::Context,
        project: Project,
        path: Option<PathBuf>,
        graphics: Option<egui_wgpu::RenderState>,
    ) -> std::io::Result<Self> {
        theme::install(ctx);
        let on_disk = path.as_deref().and_then(files::OnDisk::of);
        ctx.options_mut(|options| {
            // Closing goes by our own question; plus, minus and zero belong to the panes.
            options.quit_shortcuts.clear();
            options.zoom_with_keyboard = false;
        });
        Ok(Self {
            session: Session::new(project, runner(ctx)?),
            path,
            tool: Tool::Mark,
            laser: false,
            selected: None,
            picks: Picks::default(),
            snapping: true,
            marks_panel: MarksPanel::default(),
            pattern_panel: PatternPanel::default(),
            ghosts: None,
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
            preferences_path: None,
            after_save: None,
            safety: Safety::default(),
            on_disk,
            drag: None,
            wrap_seq: None,
            title: String::new(),
            frames: 0,
        })
    }

    /// Prefers what `path` says, and keeps there what is preferred from now on.
    pub fn keep_preferences(&mut self, ctx: &egui::Context, path: PathBuf) {
        self.preferences = Preferences::read(&path);
        ctx.set_theme(egui::ThemePreference::from(self.preferences.theme));
        self.preferences_path = Some(path);
    }

    /// Writes everything done, from the beginning, to `file` as well.
    pub fn record_to(&mut self, file: std::fs::File) -> std::io::Result<()> {
        self.session.recorder().also_to(file)
    }

    /// Frames drawn so far.
    pub fn frames(&self) -> u64 {
        self.frames
    }

    /// The session, for reading.
    pub fn session(&self) -> &Session {
        &self.session
    }

    /// The session, to be given commands as by a person.
    pub fn session_mut(&mut self) -> &mut Session {
        &mut self.session
    }

    /// Saves the project to `path`; asks first where somebody else has changed it.
    pub fn save_as(&mut self, ctx: &egui::Context, path: &Path) -> Result<(), String> {
        self.save_to(ctx, path)
    }

    /// From where the body is seen.
    pub fn camera(&self) -> Camera {
        self.scene_pane.camera
    }

    /// While the pointer is over cloth that pins hold back: how much of a drag would reach each vertex, 0..=1.
    pub fn reach(&self) -> Option<&[f32]> {
        self.scene_pane.reached()
    }

    /// Everything done so far, as a recording.
    pub fn recording(&mut self) -> String {
        self.session.recording()
    }

    /// Pictures of the body drawn so far.
    pub fn pictures(&self) -> u64 {
        self.scene_pane.graphics.as_ref().map_or(0, |g| g.pictures)
    }

    /// Starts over with `project`.
    pub(super) fn replace(&mut self, ctx: &egui::Context, project: Project, path: Option<PathBuf>) {
        match runner(ctx) {
            Ok(runner) => self.session = Session::new(project, runner),
            Err(e) => return self.messages.error(format!("The simulation could not be started: {e}")),
        }
        self.on_disk = path.as_deref().and_then(files::OnDisk::of);
        self.path = path;
        self.safety.work_is_saved();
        self.drag = None;
        self.wrap_seq = None;
        self.selected = None;
        self.picks = Picks::default();
        self.ghosts = None;
        self.pattern_pane = PatternPane::fitted();
        self.scene_pane.frame = Some(Some(crate::render::View::Front));
    }

    /// One frame.
    pub fn ui(&mut self, ui: &mut egui::Ui) {
        self.frames += 1;
        let ctx = ui.ctx().clone();
        self.take_notices();
        self.play_demo(&ctx);
        let document = self.shown().document().clone();
        let snapshot = Arc::clone(self.shown().snapshot());
        self.ghosts = self.ghosts.take().filter(|g| g.fit(&document, self.shown().surface()));
        self.carry_selection(&document);
        let now = self.situation(&ctx, &document, &snapshot);
        let palette = Palette::of(ctx.theme());
        let mut asks = Asks::new();
        self.keys(&ctx, &now, &mut asks);
        self.panels(ui, &document, &snapshot, &now, &palette, &mut asks);
        self.messages.ui(&ctx, &palette, status::HEIGHT);
        if let (Some((player, ..)), Some(table)) = (&self.demo, self.pattern_pane.area) {
            player.ui(&ctx, &palette, table, &mut asks);
            asks.retain(|ask| matches!(ask, Ask::Act(action) if action.is_for_demos()));
        }
        if !asks.is_empty() {
            // This frame showed how things stood before.
            ctx.request_repaint();
        }
        for ask in asks {
            self.carry_out(&ctx, ask);
        }
        self.dialogs(&ctx);
        self.dropped_files(&ctx);
        self.guard_closing(&ctx);
        self.set_title(&ctx);
        self.tend_safety(&ctx);
    }

    /// What is on the screen: the document, or a demo.
    pub fn shown(&self) -> &Session {
        self.demo.as_ref().map_or(&self.session, |(player, ..)| player.session())
    }

    fn panels(
        &mut self,
        ui: &mut egui::Ui,
        document: &Document,
        snapshot: &Snapshot,
        now: &Situation,
        palette: &Palette,
        asks: &mut Asks,
    ) {
        let bar = |ui: &egui::Ui, y: i8| {
            Frame::new().fill(ui.visuals().panel_fill).inner_margin(Margin::symmetric(10, y))
        };
        let (thin, thick) = (bar(ui, 3), bar(ui, 6));
        let surface = self.shown().surface().cloned();
        let lost = self.shown().problems().to_vec();
        Panel::top("menu")
            .frame(thin)
            .show_separator_line(false)
            .show(ui, |ui| menu::menu_bar_ui(ui, now, asks));
        Panel::top("tools").frame(thick).show(ui, |ui| toolbar::toolbar_ui(ui, now, palette, asks));
        Panel::bottom("status").frame(thin).exact_size(status::HEIGHT).show(ui, |ui| {
            status::status_ui(ui, now, &self.hint(document, now, palette), palette);
        });
        if self.show_panel {
            Panel::right("side").default_size(256.0).size_range(220.0..=420.0).frame(thick).show(ui, |ui| {
                let told = Told {
                    document,
                    surface: surface.as_ref(),
                    selection: &self.picks.selection,
                    problems: &snapshot.problems,
                    verdict: snapshot.verdict.as_ref().map_or(&[], |found| found),
                    lost: &lost,
                    now,
                    palette,
                };
                side_panel::side_panel_ui(ui, &told, &mut self.marks_panel, &mut self.pattern_panel, asks);
            });
        }
        let half = ui.available_width() * 0.46;
        let least = (ui.available_width() - 200.0).max(160.0);
        Panel::left("table").frame(Frame::new()).default_size(half).size_range(160.0..=least).show(
            ui,
            |ui| {
                let mut pane = std::mem::take(&mut self.pattern_pane);
                pane.ui(ui, &self.laid(document, now, palette), asks);
                self.pattern_pane = pane;
                if let Some(response) = self.pattern_pane.response.take() {
                    response.context_menu(|ui| menu::context_ui(ui, now, asks));
                }
                if document.pattern.pieces.is_empty() && matches!(now.tool, Tool::Mark | Tool::Move) {
                    let area = ui.max_rect().shrink2(egui::vec2(20.0, ui.max_rect().height() * 0.36));
                    ui.scope_builder(egui::UiBuilder::new().max_rect(area), |ui| {
                        pattern_pane::empty_ui(ui, asks);
                    });
                }
            },
        );
        CentralPanel::default().frame(Frame::new()).show(ui, |ui| {
            let cloth = snapshot.drawn().filter(|_| self.show_cloth && snapshot.is_dressed());
            let stand_out = self.picks.standing_out(now.highlight);
            let seen = Seen {
                document,
                body: surface.as_ref(),
                cloth,
                pinned: &snapshot.pinned,
                dragged: snapshot.dragged.as_ref(),
                growing: now.wrapping,
                working: now.working,
                tool: now.tool,
                mouse: now.mouse,
                laser: self.laser,
                selected: now.selected.map(|(mark, _)| mark),
                stand_out: &stand_out,
                ghosts: self.ghosts.as_ref().map(|g| &g.marks),
                look: theme::look(ui.ctx().theme()),
                palette,
            };
            self.scene_pane.ui(ui, &seen, asks);
        });
    }

    fn laid<'a>(&'a self, document: &'a Document, now: &'a Situation, palette: &'a Palette) -> Laid<'a> {
        Laid {
            document,
            tool: now.tool,
            mouse: now.mouse,
            laser: now.laser,
            selected: now.selected.map(|(mark, _)| mark),
            selection: &self.picks.selection,
            highlight: now.highlight,
            unit: now.unit,
            snapping: self.snapping,
            ghosts: self.ghosts.as_ref().map(|g| &*g.marks),
            palette,
        }
    }

    fn hint(&self, document: &Document, now: &Situation, palette: &Palette) -> String {
        let mouse = now.mouse;
        let next = |painted: usize| painted + 1;
        if self.demo.is_some() {
            "A demo is shown. Drag: turn · Wheel: zoom · Esc: back to your work".to_owned()
        } else if self.ghosts.is_some() {
            "Proposed marks: Enter takes them, Esc forgets them.".to_owned()
        } else if self.pattern_pane.hovered || self.pattern_pane.is_busy() {
            self.pattern_pane.hint(&self.laid(document, now, palette))
        } else if self.scene_pane.hovered {
            scene_pane::hint(self.tool, mouse, self.laser, now.dressed, next(document.marks.body.len()))
        } else {
            "Paint a mark on a piece and one on the body where it should lie, then press Wrap.".to_owned()
        }
    }

    fn situation(&self, ctx: &egui::Context, document: &Document, snapshot: &Snapshot) -> Situation {
        let asked = self.demo.is_none() && self.wrap_seq.is_some_and(|seq| snapshot.seq < seq);
        let growing = snapshot.phase == Some(Phase::Growing) && snapshot.working;
        Situation {
            undo: self.shown().undo_label().map(str::to_owned),
            redo: self.shown().redo_label().map(str::to_owned),
            // In a demo the mouse only turns the view.
            tool: if self.demo.is_some() { Tool::Move } else { self.tool },
            mouse: if self.demo.is_some() { Mouse::Clo } else { self.preferences.mouse },
            laser: self.laser,
            picked: Picked::new(&document.pattern, &self.picks.selection),
            twisted: self.pattern_pane.has_twisted(),
            snapping: self.snapping,
            highlight: self.highlight(),
            unit: self.preferences.unit,
            selected: self.selected.and_then(|mark| Some((mark, document.marks.place(mark)?))),
            pieces: document.pattern.pieces.len(),
            marks: [document.marks.cloth.len(), document.marks.body.len()],
            pins: document.pins.len(),
            proposed: self.ghosts.as_ref().map_or(0, |g| g.marks.pairs().count()),
            has_body: self.shown().surface().is_some(),
            demo: self.demo.is_some(),
            dressed: snapshot.is_dressed(),
            wrapped: self.shown().can_cancel_wrap(),
            wrapping: asked || growing,
            working: asked || snapshot.working,
            dragging: snapshot.dragged.is_some(),
            relaxing: snapshot.relaxing,
            phase: snapshot.phase,
            progress: snapshot.progress,
            tick: snapshot.tick,
            triangles: snapshot.garment.as_ref().map_or(0, |g| g.triangles.len()),
            show_cloth: self.show_cloth,
            show_panel: self.show_panel,
            parallel: self.scene_pane.camera.projection == crate::render::Projection::Orthographic,
            free_turning: self.scene_pane.free_turning,
            theme: ctx.options(|o| o.theme_preference),
        }
    }

    fn take_notices(&mut self) {
        if let Some(why) = self.session.recorder().take_file_error() {
            self.messages.error(format!("The recording is no longer written to its file: {why}"));
        }
        for notice in self.session.update() {
            match notice {
                Notice::AtRest { .. } => {}
                Notice::Failed { words, .. } => self.messages.error(words),
                Notice::HistoryShortened => {
                    self.messages.tell("Older steps can no longer be undone, to save memory.");
                }
            }
        }
    }

    fn keys(&self, ctx: &egui::Context, now: &Situation, asks: &mut Asks) {
        if self.dialog.is_some() || ctx.text_edit_focused() {
            return;
        }
        let table = &self.pattern_pane;
        let focused = ctx.memory(|m| m.focused().is_some()) && !table.has_focus(ctx);
        let menu = egui::Popup::is_any_open(ctx);
        if now.demo && !menu && ctx.input_mut(|i| i.consume_key(Modifiers::NONE, Key::Escape)) {
            return asks.push(Ask::Act(Action::StopDemo));
        }
        let drawing = table.is_busy() || !self.scene_pane.stroke().is_empty();
        let at_table = table.hovered || table.has_focus(ctx);
        if now.proposed > 0 && !menu && !drawing {
            for action in [Action::AcceptMarks, Action::DismissMarks] {
                let keys = action.entry().keys;
                let wanted = |k: &KeyboardShortcut| !(focused && k.logical_key == Key::Enter);
                if keys.iter().filter(|k| wanted(k)).any(|k| ctx.input_mut(|i| i.consume_shortcut(k))) {
                    asks.push(Ask::Act(action));
                }
            }
        }
        let escape = ctx.input(|i| i.key_pressed(Key::Escape)) && !menu && !drawing && !now.wrapping;
        if escape && self.selected.is_some() {
            asks.push(Ask::Select(None));
        }
        for (action, keys) in Action::with_keys() {
            // A focused button takes Enter and Space for itself; Space over the table moves the view; Esc first gives up a
            // stroke.
            let of_table = [Key::Enter, Key::Backspace, Key::Delete].contains(&keys.logical_key);
            let is_figure = keys.logical_key.symbol_or_name().parse::<u8>().is_ok();
            let taken = Action::is_plain(keys)
                && (menu
                    || (focused && [Key::Enter, Key::Space].contains(&keys.logical_key))
                    || (table.is_busy() && of_table)
                    || (table.takes_numbers() && at_table && is_figure)
                    || (action == Action::ToggleRelaxing && at_table)
                    || (action == Action::CancelWrap && (drawing || self.drag.is_some())));
            // What cannot be chosen now leaves its keys to the panes.
            if !taken && now.why_not(action).is_none() && ctx.input_mut(|i| i.consume_shortcut(&keys)) {
                asks.push(Ask::Act(action));
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
            Ask::Say(words) => self.messages.tell(words),
        }
    }

    /// Carries out `command` as a step of its own; a refusal is told.
    pub(super) fn apply(&mut self, command: Command) {
        self.end_drag();
        let is_wrap = matches!(command, Command::Wrap | Command::Rewrap { .. });
        let is_body = matches!(command, Command::SetBody { .. });
        match self.session.apply_alone(command) {
            Ok(()) if is_wrap => self.wrap_seq = Some(self.session.last_seq()),
            Ok(()) if is_body => self.tell_lost_marks(),
            Ok(()) => {}
            Err(why) => self.messages.error(sentence(&why.0)),
        }
    }

    fn tell_lost_marks(&mut self) {
        let lost = self.session.problems();
        if !lost.is_empty() {
            let places: Vec<&str> = lost.iter().map(|p| p.place.as_str()).collect();
            self.messages.error(format!("Not carried to the new body: {}.", places.join(", ")));
        }
    }

    fn drag(&mut self, command: Command) {
        let gesture = *self.drag.get_or_insert_with(|| self.session.begin_gesture());
        // The hand may go on to where it can be done: no error that stays.
        if let Err(why) = self.session.apply(command, gesture) {
            self.messages.tell(sentence(&why.0));
        }
    }

    pub(super) fn end_drag(&mut self) {
        if let Some(gesture) = self.drag.take() {
            self.session.end_gesture(gesture);
        }
    }

    fn cancel_drag(&mut self) {
        if let Some(gesture) = self.drag.take() {
            // Refused only when the drag has changed nothing yet.
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
        let answer = dialog.ui(ctx);
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
            Answer::SaveAs => self.ask_file(Purpose::Save),
            Answer::Overwrite(path) => {
                self.on_disk = None;
                self.file(ctx, Purpose::Save, &path);
            }
            Answer::Pattern(path, unit) => {
                if let Err(words) = self.import_pattern(&path, Some(unit)) {
                    self.messages.error(words);
                }
            }
            Answer::Body(raw) => {
                if let Err(words) = self.take_body(*raw) {
                    self.messages.error(words);
                }
            }
        }
    }

    fn dropped_files(&mut self, ctx: &egui::Context) {
        let dropped = ctx.input(|i| i.raw.dropped_files.clone());
        for path in dropped.into_iter().map(|f| f.path().to_owned()) {
            let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
            match extension.as_deref() {
                Some("toile") => self.file(ctx, Purpose::Open, &path),
                Some("json" | "dxf" | "svg") => self.file(ctx, Purpose::ImportPattern, &path),
                Some("obj") => self.file(ctx, Purpose::ImportBody, &path),
                _ => self.messages.error(format!(
                    "{} is neither a project (.toile), a pattern (.dxf, .svg, .json) nor a body (.obj)",
                    path.display()
                )),
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
        let title = format!("{}{mark} – Toile", name.as_deref().unwrap_or("Untitled"));
        if title != self.title {
            ctx.send_viewport_cmd(ViewportCommand::Title(title.clone()));
            self.title = title;
        }
    }

    /// Asks the person for a file.
    pub(super) fn ask_file(&mut self, purpose: Purpose) {
        match NativeDialog::open(purpose, self.path.as_deref()) {
            Some(native) => self.native = Some(native),
            None => {
                let text = if purpose.writes() { purpose.default_name() } else { String::new() };
                self.dialog = Some(Dialog::Path { purpose, text });
            }
        }
    }

    fn file(&mut self, ctx: &egui::Context, purpose: Purpose, path: &Path) {
        let done = match purpose {
            Purpose::Open => files::open(path).map(|p| self.replace(ctx, p, Some(path.to_owned()))),
            Purpose::Save => self.save_to(ctx, path),
            Purpose::ImportPattern => self.import_pattern(path, None),
            Purpose::ImportBody => files::read_body(path).and_then(|raw| self.import_body(raw)),
            Purpose::Export => {
                let pattern = &self.session.document().pattern;
                files::export(path, self.session.snapshot(), pattern).map(|()| self.wrote(path))
            }
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

    /// Asks for the unit first when the file does not say it.
    fn import_pattern(&mut self, path: &Path, unit: Option<DrawingUnit>) -> Result<(), String> {
        match files::import_pattern(path, unit)? {
            PatternImport::Pattern(command, notes) => {
                self.apply(command);
                self.pattern_pane.fit = true;
                if !notes.is_empty() {
                    self.messages.tell(notes.join("; "));
                }
            }
            PatternImport::Question(question) => {
                let unit = question.candidates.first().copied().unwrap_or_default();
                self.dialog = Some(Dialog::Scale { path: path.to_owned(), question, unit });
            }
        }
        Ok(())
    }

    fn export_pattern(&mut self, path: &Path) -> Result<(), String> {
        let left_out = files::export_pattern(path, &self.session.document().pattern)?;
        self.wrote(path);
        if !left_out.is_empty() {
            self.messages.tell(left_out.join("; "));
        }
        Ok(())
    }

    /// Asks for the unit first when there is a doubt.
    fn import_body(&mut self, raw: RawBody) -> Result<(), String> {
        if raw.is_doubtful {
            self.dialog = Some(Dialog::Unit { raw: Box::new(raw) });
            return Ok(());
        }
        self.take_body(raw)
    }

    fn take_body(&mut self, raw: RawBody) -> Result<(), String> {
        let (command, notes) = files::take_body(raw)?;
        self.apply(command);
        if !notes.is_empty() {
            self.messages.tell(notes.join("; "));
        }
        Ok(())
    }

    pub(super) fn wrote(&mut self, path: &Path) {
        self.messages.tell(format!("Written: {}", path.display()));
    }
}

/// A simulation on its own thread that wakes the window when there is something new.
fn runner(ctx: &egui::Context) -> std::io::Result<Runner> {
    let ctx = ctx.clone();
    Runner::threaded(Simulation::default(), DEFAULT_RATE_HZ, Box::new(move || ctx.request_repaint()))
}

fn sentence(words: &str) -> String {
    let mut letters = words.chars();
    let first = letters.next().map(|c| c.to_uppercase().to_string()).unwrap_or_default();
    format!("{first}{}.", letters.as_str())
}
