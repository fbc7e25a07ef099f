//! Undo and redo: states to return to. Copying a document copies pointers.

use crate::session::document::Document;

/// Steps that can be undone.
const MOST_STEPS: usize = 1000;

/// What a step did, as far as later commands need to know.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StepKind {
    /// Began a wrap.
    Wrap,
    /// Took cloth off or put other cloth on.
    Cloth,
    /// Anything else.
    Edit,
}

/// Which document and which cloth there are: the commands that made them so.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Version {
    /// The newest that changed the document.
    pub document: u64,
    /// The newest that moved the cloth.
    pub cloth: u64,
}

/// One step on the undo or the redo side.
#[derive(Clone, Debug)]
pub struct Step {
    /// What it did, for menus: "Undo LABEL".
    pub label: String,
    /// What it did, for later commands.
    pub kind: StepKind,
    /// The document to return to.
    pub document: Document,
    /// The request before which the cloth was as it should be again; None when the step left the cloth alone.
    pub restore: Option<u64>,
    /// What it returns to; its cloth only where that is restored.
    pub version: Version,
}

impl Step {
    /// What there is once one has returned from `now`.
    pub fn returned(&self, now: Version) -> Version {
        let cloth = if self.restore.is_some() { self.version.cloth } else { now.cloth };
        Version { cloth, ..self.version }
    }
}

/// Done and undone steps.
#[derive(Clone, Debug, Default)]
pub struct History {
    done: Vec<Step>,
    undone: Vec<Step>,
    /// The gesture that the last done step still belongs to, and what it took from the redo side.
    open: Option<(u64, Vec<Step>)>,
}

impl History {
    /// Adds what a command of `gesture` did: a step of its own, or part of the gesture's step.
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

    /// Whether the next request of `gesture` must keep the cloth as it is for undo.
    pub fn needs_checkpoint(&self, gesture: u64) -> bool {
        !self.is_open(gesture) || self.done.last().is_none_or(|last| last.restore.is_none())
    }

    /// Later commands make steps of their own.
    pub fn close(&mut self) {
        self.open = None;
    }

    /// Drops the step of `gesture`, if it has made one. Steps it cleared from redo return.
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

    /// The step that would be redone.
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

    /// Moves the last done step to the redo side. `now` is what redo returns to; so does the cloth, to before request
    /// `seq` (the undo itself), if the step touched it.
    pub fn undo(&mut self, now: (Document, Version), seq: u64) {
        self.close();
        self.undone.extend(self.done.pop().map(|step| turned(step, now, seq)));
    }

    /// The reverse of [`History::undo`].
    pub fn redo(&mut self, now: (Document, Version), seq: u64) {
        self.close();
        self.done.extend(self.undone.pop().map(|step| turned(step, now, seq)));
    }

    /// States before requests below `before_seq` are gone: drops the steps that need them, and those behind them.
    pub fn forget(&mut self, before_seq: u64) {
        for steps in [&mut self.done, &mut self.undone] {
            let gone = steps.iter().rposition(|s| s.restore.is_some_and(|seq| seq < before_seq));
            steps.drain(..gone.map_or(0, |i| i + 1));
        }
        if self.done.is_empty() {
            self.close();
        }
    }

    /// Whether the last done step is that of `gesture`, and may grow.
    pub fn is_open(&self, gesture: u64) -> bool {
        self.open.as_ref().is_some_and(|(open, _)| *open == gesture)
    }
}

fn turned(step: Step, (document, version): (Document, Version), seq: u64) -> Step {
    Step { document, version, restore: step.restore.map(|_| seq), ..step }
}
