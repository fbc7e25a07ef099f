//! The session: carries out commands, which change the document, send requests to the simulation, and are recorded.

use std::sync::Arc;

use crate::body::Surface;
use crate::card::CardSlot;
use crate::cloth::Fabric;
use crate::contact::Bone;
use crate::geometry::words::{Words, within_quotes, words};
use crate::pattern::edit::Carried;
use crate::pattern::{Pattern, Problem};
use crate::place::Moved;
use crate::session::body::{Body, BodyCache};
use crate::session::command::{Command, Rejection};
use crate::session::document::Document;
use crate::session::edit::{self, ClothChange};
use crate::session::hashes::DocumentHasher;
use crate::session::history::{History, Step, StepKind, Version};
use crate::session::placing;
use crate::session::project::{Dressed, Project};
use crate::session::recording::Recorder;
use crate::session::recovery::Journal;
use crate::sim::{DrapeSource, Event, GarmentSource, Request, RequestKind, Runner, Snapshot};
use crate::wrap::Marks;

/// Id of a gesture, such as a pointer drag or a press of a button. A gesture is one undo step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct GestureId(pub u64);

/// A notice for the user; the session has already handled it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Notice {
    /// The cloth has come to rest.
    AtRest { tick: u64 },
    /// A request to the simulation failed; the cloth is as before, and paused.
    Failed { tick: u64, words: Words },
    /// Old steps were dropped to save memory and can no longer be undone.
    HistoryShortened,
}

/// A document being worked on.
#[derive(Debug)]
pub struct Session {
    document: Document,
    history: History,
    runner: Runner,
    recorder: Recorder,
    bodies: BodyCache,
    hasher: DocumentHasher,
    last_seq: u64,
    /// Number of the last command that sent a request to the simulation.
    last_request: u64,
    last_gesture: u64,
    /// The gesture whose end has not been recorded yet.
    open_gesture: Option<GestureId>,
    /// Pieces that the last pattern edit in this gesture moved, relative to before the gesture.
    moved: Option<(GestureId, Vec<Carried>)>,
    /// The present version.
    version: Version,
    /// The version that was last opened or saved; None: the project is in no file.
    saved: Option<Version>,
    /// Problems of marks lost in a change of body, and the marks right after it.
    lost_marks: Option<(Arc<Marks>, Vec<Problem>)>,
    /// Numbers of undo and redo steps when the last recovery copy was made, lowered to the fewest since.
    copied_steps: (usize, usize),
    /// Whether a step older than the last recovery copy was undone or redone, which the commands since do not show.
    needs_copy: bool,
    /// Number of the last command when the last recovery copy was made.
    copied_seq: u64,
    /// Whether this is a replay, in which the recording tells when history is forgotten.
    replaying: bool,
}

/// Everything a command will do, computed before anything changes.
struct Plan {
    document: Document,
    history: HistoryChange,
    request: Option<RequestKind>,
    /// Marks lost in a change of body.
    problems: Vec<Problem>,
}

enum HistoryChange {
    None,
    Push { label: Words, kind: StepKind },
    Undo,
    Redo,
    DropOpen,
    DropLast,
    Forget { before_seq: u64 },
}

impl Session {
    /// A session on `project`, with the simulation in `runner` (which must be new).
    pub fn new(project: Project, mut runner: Runner) -> Self {
        let mut bodies = BodyCache::default();
        let body = bodies.surface(&project.document.body);
        let recorder = Recorder::new(&project);
        if let (Some(Dressed { source, cloth, moved }), Ok(body)) = (project.dressed, body) {
            let kind = RequestKind::Adopt { source, body, cloth, moved };
            runner.send(Request { seq: 0, checkpoint: false, kind });
            if !project.document.pins.is_empty() {
                let kind = RequestKind::SetPins(project.document.pinned_places());
                runner.send(Request { seq: 0, checkpoint: false, kind });
            }
        }
        let mut session = Self {
            document: project.document,
            history: History::default(),
            runner,
            recorder,
            bodies,
            hasher: DocumentHasher::default(),
            last_seq: 0,
            last_request: 0,
            last_gesture: 0,
            open_gesture: None,
            moved: None,
            version: Version::default(),
            saved: Some(Version::default()),
            lost_marks: None,
            copied_steps: (0, 0),
            needs_copy: false,
            copied_seq: 0,
            replaying: false,
        };
        session.ask_for_hash();
        session
    }

    /// A session for a replay, in which the recording tells when history is forgotten.
    pub fn replaying(project: Project, runner: Runner) -> Self {
        Self { replaying: true, ..Self::new(project, runner) }
    }

    /// The document.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// The body of the document. None when cloth cannot be put on it: `Wrap` is then rejected with the reason.
    pub fn surface(&self) -> Option<&Arc<Surface>> {
        self.bodies.kept(&self.document.body)
    }

    /// Marks lost in the last change of body, until strokes are changed.
    pub fn problems(&self) -> &[Problem] {
        match &self.lost_marks {
            Some((after, problems)) if Arc::ptr_eq(after, &self.document.marks) => problems,
            _ => &[],
        }
    }

    /// The newest snapshot at the last [`Session::update`].
    pub fn snapshot(&self) -> &Arc<Snapshot> {
        self.runner.snapshot()
    }

    /// The runner of the simulation.
    pub fn runner(&mut self) -> &mut Runner {
        &mut self.runner
    }

    /// Begins a gesture.
    pub fn begin_gesture(&mut self) -> GestureId {
        self.last_gesture += 1;
        GestureId(self.last_gesture)
    }

    /// Carries out `command` as part of `gesture`, or rejects it with the reason and changes nothing.
    pub fn apply(&mut self, command: Command, gesture: GestureId) -> Result<(), Rejection> {
        let plan = self.plan(&command, gesture)?;
        if self.open_gesture.is_some_and(|open| open != gesture) {
            self.close_gesture();
        }
        self.open_gesture = Some(gesture);
        self.last_gesture = self.last_gesture.max(gesture.0);
        self.last_seq += 1;
        self.recorder.command(self.last_seq, gesture.0, command);
        self.carry_out(plan, gesture);
        Ok(())
    }

    /// Ends the gesture: later commands make steps of their own, and the recording gets its hashes.
    pub fn end_gesture(&mut self, gesture: GestureId) {
        if self.open_gesture == Some(gesture) {
            self.close_gesture();
        }
    }

    /// Carries out `command` as a gesture of its own.
    pub fn apply_alone(&mut self, command: Command) -> Result<(), Rejection> {
        let gesture = self.begin_gesture();
        self.apply(command, gesture)?;
        self.end_gesture(gesture);
        Ok(())
    }

    /// Takes the simulation's events since the last call. Call it once a frame.
    pub fn update(&mut self) -> Vec<Notice> {
        // Events first: the snapshot taken after them is at least as new.
        let events = self.runner.take_events();
        self.runner.refresh();
        events.into_iter().filter_map(|event| self.take_event(event)).collect()
    }

    /// Label of the step that undo would undo.
    pub fn undo_label(&self) -> Option<&str> {
        self.history.last_done().map(|step| step.label.as_str())
    }

    /// Label of the step that redo would redo.
    pub fn redo_label(&self) -> Option<&str> {
        self.history.last_undone().map(|step| step.label.as_str())
    }

    /// Labels of the steps that undo and redo would go to, in words for any language.
    pub fn next_labels(&self) -> [Option<&Words>; 2] {
        [self.history.last_done(), self.history.last_undone()].map(|step| step.map(|step| &step.label))
    }

    /// Labels of the done steps, oldest first.
    pub fn step_labels(&self) -> impl Iterator<Item = &Words> {
        self.history.done().iter().map(|step| &step.label)
    }

    /// Labels of the undone steps, the next one to be redone first.
    pub fn undone_labels(&self) -> impl Iterator<Item = &Words> {
        self.history.undone().iter().rev().map(|step| &step.label)
    }

    /// Whether the newest step that changed the cloth is a wrap, which `CancelWrap` can undo.
    pub fn can_cancel_wrap(&self) -> bool {
        let newest = self.history.done().iter().rev().find(|step| step.kind != StepKind::Edit);
        newest.is_some_and(|step| step.kind == StepKind::Wrap)
    }

    /// Whether the newest step is a change of the body's pose or size, which `Undo` takes back.
    pub fn can_undo_pose(&self) -> bool {
        self.history.last_done().is_some_and(|step| step.kind == StepKind::Pose)
    }

    /// The content of a project file now.
    pub fn project(&mut self) -> Project {
        self.runner.refresh();
        let snapshot = self.runner.snapshot();
        let dressed = match &snapshot.source {
            // Cloth that is being sewn has another mesh than the pattern gives: only the pattern is saved.
            Some(source) if snapshot.is_dressed() && !snapshot.is_sewing => {
                let (source, cloth) = (Arc::clone(source), Arc::clone(&snapshot.cloth));
                Some(Dressed { source, cloth, moved: snapshot.moved })
            }
            _ => None,
        };
        Project { document: self.document.clone(), dressed }
    }

    /// Records that the project was saved in its present state.
    pub fn mark_saved(&mut self) {
        self.saved = Some(self.version);
    }

    /// Whether the project is another than when it was opened or saved: what was undone since does not count.
    pub fn is_modified(&self) -> bool {
        self.saved != Some(self.version)
    }

    /// Records that the project is in no file of the user's: it was recovered.
    pub fn mark_modified(&mut self) {
        self.saved = None;
    }

    /// Records that a recovery copy was made in the present state: `journal` takes the commands from here on.
    pub fn mark_copied(&mut self, journal: Option<Journal>) {
        self.recorder.journal_to(journal);
        self.copied_seq = self.last_seq;
        self.copied_steps = (self.history.done().len(), self.history.undone_count());
        self.needs_copy = false;
    }

    /// Whether no command was given since the last recovery copy.
    pub fn is_copied(&self) -> bool {
        self.copied_seq == self.last_seq
    }

    /// Whether a new recovery copy is needed: a step older than the last copy was undone or redone, which the copy and the
    /// commands since do not show.
    pub fn needs_copy(&self) -> bool {
        self.needs_copy
    }

    /// The recording so far, as JSON lines.
    pub fn recording(&mut self) -> String {
        self.update();
        self.recorder.text()
    }

    /// The recorder, to send lines to a file as well.
    pub fn recorder(&mut self) -> &mut Recorder {
        &mut self.recorder
    }

    /// Whether the simulation has applied all requests, as of the last snapshot.
    pub fn is_caught_up(&self) -> bool {
        self.runner.snapshot().seq >= self.last_request
    }

    /// Number of the last command.
    pub fn last_seq(&self) -> u64 {
        self.last_seq
    }

    /// Hash of the document and of the numbers of steps that can be undone and redone.
    pub fn document_hash(&mut self) -> u64 {
        self.hasher.hash(&self.document, self.history.done().len(), self.history.undone_count())
    }

    fn plan(&mut self, command: &Command, gesture: GestureId) -> Result<Plan, Rejection> {
        match command {
            Command::Undo => self.plan_undo(),
            Command::Redo => self.plan_redo(),
            Command::CancelGesture => self.plan_cancel_gesture(gesture),
            Command::CancelWrap => self.plan_cancel_wrap(),
            Command::ForgetHistory { before_seq } => Ok(Plan {
                document: self.document.clone(),
                history: HistoryChange::Forget { before_seq: *before_seq },
                request: None,
                problems: Vec::new(),
            }),
            _ => self.plan_edit(command, gesture),
        }
    }

    fn plan_edit(&mut self, command: &Command, gesture: GestureId) -> Result<Plan, Rejection> {
        // An edit during a drag replaces what the gesture did so far.
        let anew = matches!(command, Command::EditPattern { anew: true, .. });
        let begun = anew && self.history.is_open(gesture.0);
        let start = self.history.last_done().filter(|_| begun).map(|step| step.document.clone());
        let mut edit = edit::edit(start.as_ref().unwrap_or(&self.document), command, &mut self.bodies)?;
        if begun && edit.cloth == ClothChange::None {
            edit.cloth = ClothChange::Resew(Vec::new()); // Back to how it was.
        }
        let request = match edit.cloth {
            ClothChange::None => None,
            ClothChange::Wrap => {
                let (source, body) = self.garment_source()?;
                Some(RequestKind::Wrap { source, body })
            }
            ClothChange::Rewrap(ref pairs) => {
                let (source, body) = self.garment_source()?;
                Some(RequestKind::Rewrap { source, body, pairs: pairs.clone() })
            }
            ClothChange::Clear => Some(RequestKind::Clear),
            ClothChange::Resew(ref carried) => {
                let since = match &self.moved {
                    Some((of, before)) if begun && *of == gesture => Carried::since(before, carried),
                    _ => carried.clone(),
                };
                self.moved = Some((gesture, carried.clone()));
                Some(RequestKind::Resew {
                    pattern: Arc::clone(&edit.document.pattern),
                    marks: Arc::clone(&edit.document.marks),
                    pins: edit.document.pinned_places(),
                    carried: Arc::new(since),
                })
            }
            ClothChange::Repose { settle, draft } => {
                let body = self.bodies.surface(&edit.document.body)?;
                let (marks, fabrics) = (Arc::clone(&edit.document.marks), drape_source(&edit.document)?);
                Some(RequestKind::Repose { body, marks, fabrics, settle, draft })
            }
            ClothChange::Resize => {
                let through = self.bodies.in_triangles_of(&self.document.body, &edit.document.body)?;
                let body = self.bodies.surface(&edit.document.body)?;
                let (marks, fabrics) = (Arc::clone(&edit.document.marks), drape_source(&edit.document)?);
                Some(RequestKind::Resize { through, body, marks, fabrics })
            }
            ClothChange::SetPins => Some(RequestKind::SetPins(edit.document.pinned_places())),
            ClothChange::Grab { at, mode } => Some(RequestKind::Grab { at, mode, bones: self.bones() }),
            ClothChange::DragTo(ray) => Some(RequestKind::DragTo(ray)),
            ClothChange::Release => Some(RequestKind::Release),
            ClothChange::SetRelax(relax) => Some(RequestKind::SetRelax(relax)),
            ClothChange::SetRelaxing(on) => Some(RequestKind::SetRelaxing(on)),
            ClothChange::Sew => {
                let (source, body) = self.garment_source()?;
                Some(RequestKind::Sew { source, body, fabrics: drape_source(&edit.document)? })
            }
            ClothChange::Dress(choice) => {
                let (source, body) = self.garment_source()?;
                let fabrics = drape_source(&edit.document)?;
                let built =
                    edit.document.body.as_built().map(|built| self.bodies.surface(&built)).transpose()?;
                Some(RequestKind::Dress { source, body, built, fabrics, choice })
            }
            ClothChange::SetDraping(on) => {
                Some(RequestKind::SetDraping { on, source: drape_source(&edit.document)? })
            }
            ClothChange::StepDraping(ticks) => {
                Some(RequestKind::StepDraping { ticks, source: drape_source(&edit.document)? })
            }
            ClothChange::SetFabrics => Some(RequestKind::SetFabrics(drape_source(&edit.document)?)),
            ClothChange::SetActivities => {
                Some(RequestKind::SetActivities(Arc::new(edit.document.pattern.activities())))
            }
        };
        let kind = edit.kind();
        let history = if edit.is_step() {
            HistoryChange::Push { label: edit.label, kind }
        } else {
            HistoryChange::None
        };
        Ok(Plan { document: edit.document, history, request, problems: edit.problems })
    }

    fn garment_source(&mut self) -> Result<(Arc<GarmentSource>, Arc<Surface>), Rejection> {
        let body = self.bodies.surface(&self.document.body)?;
        let source = GarmentSource {
            pattern: Arc::clone(&self.document.pattern),
            marks: Arc::clone(&self.document.marks),
            edge_length: self.document.settings.edge_length,
            relax: self.document.settings.relax,
        };
        Ok((Arc::new(source), body))
    }

    /// Bones that cloth cannot be pulled across: those drawn, or else the body's own.
    pub fn bones(&mut self) -> Arc<Vec<Bone>> {
        let own = |body: Arc<Body>| Arc::clone(body.bones());
        let drawn = self.document.bones.clone();
        drawn.or_else(|| self.bodies.body(&self.document.body).ok().map(own)).unwrap_or_default()
    }

    /// The placement of `pattern`, as a file has it, adapted to the body of the document; empty without a body.
    pub fn brought(&mut self, pattern: &Pattern) -> Moved {
        let body = self.bodies.body(&self.document.body);
        body.map(|body| placing::brought(pattern, &self.document, &body)).unwrap_or_default()
    }

    fn plan_undo(&self) -> Result<Plan, Rejection> {
        let step = self.history.last_done().ok_or_else(|| Rejection(words!("there is nothing to undo")))?;
        Ok(Plan::back_to(step, HistoryChange::Undo))
    }

    fn plan_redo(&self) -> Result<Plan, Rejection> {
        let step = self.history.last_undone().ok_or_else(|| Rejection(words!("there is nothing to redo")))?;
        Ok(Plan::back_to(step, HistoryChange::Redo))
    }

    fn plan_cancel_gesture(&self, gesture: GestureId) -> Result<Plan, Rejection> {
        match self.history.last_done() {
            Some(step) if self.history.is_open(gesture.0) => Ok(Plan::back_to(step, HistoryChange::DropOpen)),
            _ => Err(Rejection(words!("this gesture has changed nothing"))),
        }
    }

    /// Undoes the newest wrap, and leaves no step when nothing was done since.
    fn plan_cancel_wrap(&self) -> Result<Plan, Rejection> {
        let newest = self.history.done().iter().rev().find(|step| step.kind != StepKind::Edit);
        let Some(step) = newest.filter(|step| step.kind == StepKind::Wrap) else {
            return Err(Rejection(words!("there is no wrap to cancel")));
        };
        let is_last = self.history.last_done().is_some_and(|last| last.restore == step.restore);
        let history = if is_last {
            HistoryChange::DropLast
        } else {
            HistoryChange::Push { label: words!("cancel wrap"), kind: StepKind::Cloth }
        };
        let mut plan = Plan::back_to(step, history);
        if !is_last {
            plan.document = self.document.clone();
        }
        Ok(plan)
    }

    fn carry_out(&mut self, plan: Plan, gesture: GestureId) {
        let seq = self.last_seq;
        let before = std::mem::replace(&mut self.document, plan.document);
        let back = !matches!(plan.history, HistoryChange::None | HistoryChange::Push { .. });
        if !plan.problems.is_empty() {
            self.lost_marks = Some((Arc::clone(&self.document.marks), plan.problems));
        }
        let keeps = match plan.history {
            HistoryChange::Push { .. } => self.history.needs_checkpoint(gesture.0),
            HistoryChange::Undo | HistoryChange::Redo => true,
            _ => false,
        };
        let version = self.version;
        self.version = self.version_after(&plan.history, plan.request.is_some());
        match plan.history {
            HistoryChange::None => {}
            HistoryChange::Push { label, kind } => {
                let restore = plan.request.as_ref().map(|_| seq);
                self.history.push(gesture.0, Step { label, kind, document: before, restore, version });
            }
            HistoryChange::Undo => self.history.undo((before, version), seq),
            HistoryChange::Redo => self.history.redo((before, version), seq),
            HistoryChange::DropOpen => self.history.drop_open(gesture.0),
            HistoryChange::DropLast => self.history.drop_last(),
            HistoryChange::Forget { before_seq } => self.history.forget(before_seq),
        }
        let (done, undone) = (self.history.done().len(), self.history.undone_count());
        self.needs_copy |= back && (done < self.copied_steps.0 || undone < self.copied_steps.1);
        self.copied_steps = (self.copied_steps.0.min(done), self.copied_steps.1.min(undone));
        if let Some(kind) = plan.request {
            self.last_request = seq;
            self.runner.send(Request { seq, checkpoint: keeps, kind });
        }
    }

    /// The version after the last command, which changes the history by `change` and, if `moves_cloth`, the cloth.
    fn version_after(&self, change: &HistoryChange, moves_cloth: bool) -> Version {
        let returned = |step: Option<&Step>| step.map_or(self.version, |step| step.returned(self.version));
        match change {
            HistoryChange::None | HistoryChange::Push { .. } => Version {
                document: self.last_seq,
                cloth: if moves_cloth { self.last_seq } else { self.version.cloth },
            },
            HistoryChange::Undo | HistoryChange::DropOpen | HistoryChange::DropLast => {
                returned(self.history.last_done())
            }
            HistoryChange::Redo => returned(self.history.last_undone()),
            HistoryChange::Forget { .. } => self.version,
        }
    }

    fn close_gesture(&mut self) {
        self.open_gesture = None;
        self.history.close();
        self.ask_for_hash();
    }

    /// Drapes on this graphics card from the next start of draping on; None: on the processor. Not a command: recordings then have
    /// no hashes of the cloth.
    pub fn use_card(&mut self, card: Option<Arc<CardSlot>>) {
        let kind = RequestKind::UseCard(card);
        self.runner.send(Request { seq: self.last_seq, checkpoint: false, kind });
    }

    fn ask_for_hash(&mut self) {
        let hash = self.document_hash();
        self.recorder.expect_hash(self.last_seq, hash);
        self.runner.send(Request { seq: self.last_seq, checkpoint: false, kind: RequestKind::Hash });
    }

    fn take_event(&mut self, event: Event) -> Option<Notice> {
        self.recorder.event(&event);
        match event {
            Event::Applied { .. } | Event::Hash { asked: Some(_), .. } => None,
            Event::Hash { tick, .. } => Some(Notice::AtRest { tick }),
            Event::Failed { tick, words, .. } => Some(Notice::Failed { tick, words }),
            Event::Forgotten { before_seq } => {
                if !self.replaying {
                    self.forget_history(before_seq);
                }
                Some(Notice::HistoryShortened)
            }
        }
    }

    /// Forgets history by a command, so that a replay forgets at the same point. A drag in progress goes on.
    fn forget_history(&mut self, before_seq: u64) {
        let command = Command::ForgetHistory { before_seq };
        let forgotten = match self.open_gesture {
            Some(gesture) => self.apply(command, gesture),
            None => self.apply_alone(command),
        };
        debug_assert!(forgotten.is_ok(), "forgetting is never refused");
    }
}

/// Fabrics of the document, for draping.
fn drape_source(document: &Document) -> Result<Arc<DrapeSource>, Rejection> {
    let fabric = |name: &str| {
        Fabric::preset(name)
            .cloned()
            .ok_or_else(|| Rejection(words!("there is no fabric \"{name}\"", name = within_quotes(name))))
    };
    let fabrics = &document.fabrics;
    let of_pieces = fabrics.pieces.iter().map(|(&piece, name)| Ok((piece, fabric(name)?)));
    Ok(Arc::new(DrapeSource {
        fabric: fabric(fabrics.name(None))?,
        of_pieces: of_pieces.collect::<Result<_, Rejection>>()?,
        strain: document.settings.strain,
    }))
}

impl Plan {
    fn back_to(step: &Step, history: HistoryChange) -> Self {
        let request = step.restore.map(|before_seq| RequestKind::Restore { before_seq });
        Self { document: step.document.clone(), history, request, problems: Vec::new() }
    }
}
