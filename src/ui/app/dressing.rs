//! Dressing by the best start: reports the result, and shows the marks that were suggested for it, to be accepted.

use std::sync::Arc;

use crate::session::{Command, Document};
use crate::sim::{Snapshot, Start, StartChoice, Started};
use crate::ui::actions::Tool;
use crate::ui::actions::context::Stops;
use crate::ui::app::App;
use crate::ui::body_pane::ghosts::Ghosts;
use crate::ui::language::{said, say, tr};
use crate::wrap::Phase;

impl App {
    /// Dresses the garment by the best start.
    pub(in crate::ui) fn dress(&mut self) {
        if self.tool == Tool::Place {
            // The placement tool shows pieces in place of the cloth, so another tool is chosen to show what is dressed.
            self.tool = Tool::Move;
        }
        self.show_cloth = true;
        self.ghosts = None;
        self.apply(Command::Dress { choice: StartChoice::default() });
    }

    /// Whether a wrap was asked for that has not begun yet.
    pub(in crate::ui) fn has_asked_for_wrap(&self, snapshot: &Snapshot) -> bool {
        self.demo.is_none() && self.wrap_seq.is_some_and(|seq| snapshot.seq < seq)
    }

    /// Whether cloth is being put on the body.
    pub(in crate::ui) fn is_wrapping(&self, snapshot: &Snapshot) -> bool {
        let grows = snapshot.phase == Some(Phase::Growing) || snapshot.trying.is_some();
        self.has_asked_for_wrap(snapshot) || (grows && snapshot.working)
    }

    /// What Esc stops.
    pub(in crate::ui) fn stoppable(&self, snapshot: &Snapshot) -> Option<Stops> {
        Stops::of(self.is_wrapping(snapshot), snapshot, self.shown().can_undo_pose())
    }

    /// Stops what goes on with the cloth, and says what became of it.
    pub(in crate::ui) fn cancel(&mut self) {
        let (command, words) = match self.stoppable(self.session.snapshot()) {
            Some(Stops::Drape) => (
                Command::SetDraping { on: false },
                tr("Draping is paused: the cloth stays as it is. Undo brings back what was before."),
            ),
            Some(Stops::Pose) => {
                (Command::Undo, tr("Cancelled: body and cloth are as before the change of pose or size."))
            }
            Some(Stops::Wrap) if self.session.can_cancel_wrap() => {
                (Command::CancelWrap, tr("Cancelled: on the body all is as before."))
            }
            _ => return self.apply(Command::CancelWrap),
        };
        self.apply(command);
        self.messages.tell(words);
    }

    /// Reports the result once all starts are tried, and shows suggested marks, which disappear with the cloth.
    pub(in crate::ui) fn take_start(&mut self, document: &Document, snapshot: &Snapshot) {
        let is_same = match (&self.started, &snapshot.started) {
            (Some(known), Some(new)) => Arc::ptr_eq(known, new),
            (None, None) => true,
            _ => false,
        };
        if is_same || self.demo.is_some() {
            return;
        }
        self.started.clone_from(&snapshot.started);
        self.messages.forget_result();
        let Some(started) = &snapshot.started else {
            self.ghosts = None;
            return;
        };
        let has_marks = document.marks.pairs().next().is_some();
        let words = words(started, has_marks);
        match started.draped_fault().is_some() || !started.taken().faults.is_empty() {
            true => self.messages.tell_result(words),
            false => self.messages.tell(words),
        }
        let suggested =
            started.taken().start == Start::Marks && started.taken().as_built.is_none() && !has_marks;
        if let Some(source) = snapshot.source.as_ref().filter(|_| suggested) {
            self.ghosts = Ghosts::of(Arc::clone(&source.marks), &self.session);
        }
    }
}

/// A message: how the garment was put on the body, and whether it has faults.
fn words(started: &Started, has_marks: bool) -> String {
    let taken = started.taken();
    let dressed = match (taken.start, taken.draped) {
        _ if taken.as_built.is_some() => {
            tr("Dressed in the pose that the mannequin is built in, and carried to its pose")
        }
        (Start::Placement, _) => tr("Dressed from its placement, sewn"),
        (Start::Marks, true) if has_marks => tr("Dressed by its marks, draped"),
        (Start::Marks, true) => tr("Dressed by suggested marks, draped"),
        (Start::Marks, false) if has_marks => tr("Dressed by its marks, not draped"),
        (Start::Marks, false) => tr("Dressed by suggested marks, not draped"),
    };
    if let Some(fault) = started.draped_fault() {
        let fault = said(fault);
        return say!("{dressed}. When it was draped: {fault}", dressed, fault);
    }
    match taken.faults.len() {
        0 => format!("{dressed}."),
        _ => say!("{dressed}: the best of the starts, and not without faults (see Problems).", dressed),
    }
}
