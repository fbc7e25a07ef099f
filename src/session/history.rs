//! Undo and redo history. Cloning a document clones pointers.

use crate::geometry::words::Words;
use crate::session::document::Document;

/// Most steps that can be undone.
const MOST_STEPS: usize = 1000;

/// Kind of a step, where later commands depend on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepKind {
    /// Began a wrap.
    Wrap,
    /// Changed the body's pose or size; the cloth goes there.
    Pose,
    /// Took cloth off or put other cloth on.
    Cloth,
    /// Anything else.
    Edit,
}

/// Identifies a state of the document and of the cloth by the commands that led to it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Version {
    /// Number of the last command that changed the document.
    pub document: u64,
    /// Number of the last command that moved the cloth.
    pub cloth: u64,
}

/// A step on the undo or the redo side.
#[derive(Clone, Debug)]
pub struct Step {
    /// Label for menus: "Undo LABEL".
    pub label: Words,
    /// Kind of the step.
    pub kind: StepKind,
    /// The document to return to.
    pub document: Document,
    /// The request whose checkpoint holds the cloth to return to; None when the step did not change the cloth.
    pub restore: Option<u64>,
    /// The version that undoing returns to; its cloth counts only if the cloth is restored.
    pub version: Version,
}

impl Step {
    /// The version after this step is undone (or redone) at version `now`.
    pub fn returned(&self, now: Version) -> Version {
        let cloth = if self.restore.is_some() { self.version.cloth } else { now.cloth };
        Version { cloth, ..self.version }
    }
}

/// Undo and redo steps.
#[derive(Clone, Debug, Default)]
pub struct History {
    done: Vec<Step>,
    undone: Vec<Step>,
    /// The gesture that may still extend the last done step, and the redo steps that it cleared.
    open: Option<(u64, Vec<Step>)>,
}

impl History {
    /// Adds the step of a command in `gesture`: a new step, or an extension of the gesture's step.
    pub fn push(&mut self, gesture: u64, step: Step) {
        if self.is_open(gesture)
            && let Some(last) = self.done.last_mut()
        {
            last.label = step.label;
            if last.restore.is_none() {
                (last.restore, last.version.cloth) = (step.restore, step.version.cloth);
            }
            if last.kind == StepKind::Edit {
                last.kind = step.kind;
            }
            return;
        }
        self.open = Some((gesture, std::mem::take(&mut self.undone)));
        self.done.push(step);
        if self.done.len() > MOST_STEPS {
            self.done.remove(0);
        }
    }

    /// Whether the next request of `gesture` needs a checkpoint for undo.
    pub fn needs_checkpoint(&self, gesture: u64) -> bool {
        !self.is_open(gesture) || self.done.last().is_none_or(|last| last.restore.is_none())
    }

    /// Ends the gesture: later commands make steps of their own.
    pub fn close(&mut self) {
        self.open = None;
    }

    /// Drops the step of `gesture`, if it has made one, and brings the redo steps that it cleared back.
    pub fn drop_open(&mut self, gesture: u64) {
        if let Some((open, undone)) = self.open.take()
            && open == gesture
        {
            self.undone = undone;
            self.done.pop();
        }
    }

    /// Drops the last done step.
    pub fn drop_last(&mut self) {
        self.close();
        self.done.pop();
    }

    /// The last done step.
    pub fn last_done(&self) -> Option<&Step> {
        self.done.last()
    }

    /// The step that would be redone next.
    pub fn last_undone(&self) -> Option<&Step> {
        self.undone.last()
    }

    /// Done steps, oldest first.
    pub fn done(&self) -> &[Step] {
        &self.done
    }

    /// Undone steps, the next one to be redone last.
    pub fn undone(&self) -> &[Step] {
        &self.undone
    }

    /// Number of steps that can be redone.
    pub fn undone_count(&self) -> usize {
        self.undone.len()
    }

    /// Moves the last done step to the redo side. Redo returns to the document `now` and, if the step changed the cloth, to the
    /// cloth before request `seq` (the undo itself).
    pub fn undo(&mut self, now: (Document, Version), seq: u64) {
        self.close();
        self.undone.extend(self.done.pop().map(|step| turned(step, now, seq)));
    }

    /// Moves the last undone step to the undo side; the reverse of [`History::undo`].
    pub fn redo(&mut self, now: (Document, Version), seq: u64) {
        self.close();
        self.done.extend(self.undone.pop().map(|step| turned(step, now, seq)));
    }

    /// Drops the steps that need checkpoints of requests below `before_seq`, which are gone, and all steps behind those.
    pub fn forget(&mut self, before_seq: u64) {
        for steps in [&mut self.done, &mut self.undone] {
            let gone = steps.iter().rposition(|s| s.restore.is_some_and(|seq| seq < before_seq));
            steps.drain(..gone.map_or(0, |i| i + 1));
        }
        if self.done.is_empty() {
            self.close();
        }
    }

    /// Whether the last done step is that of `gesture` and may be extended.
    pub fn is_open(&self, gesture: u64) -> bool {
        self.open.as_ref().is_some_and(|(open, _)| *open == gesture)
    }
}

fn turned(step: Step, (document, version): (Document, Version), seq: u64) -> Step {
    Step { document, version, restore: step.restore.map(|_| seq), ..step }
}
