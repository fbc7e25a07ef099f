//! Replays a recording on the caller's thread, as fast as it can, and compares hashes. Stops at the first difference.

use std::collections::{BTreeMap, VecDeque};

use crate::geometry::words::{Words, words};
use crate::session::command::Command;
use crate::session::recording::{Hex, RecordedEvent, Recording, machine};
use crate::session::session::{GestureId, Session};
use crate::sim::{Runner, Simulation};

/// The first difference between a replay and its recording.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.words())]
pub struct Divergence {
    /// Ticks executed before.
    pub tick: u64,
    /// Number of the last command carried out; 0: none.
    pub seq: u64,
    /// What differs.
    pub words: Words,
}

impl Divergence {
    /// The difference in words.
    pub fn words(&self) -> Words {
        let Self { tick, seq, words } = self;
        words!("diverged at tick {tick}, after command {seq}: {words}", tick, seq, words)
    }
}

/// A replay in progress.
#[derive(Debug)]
pub struct Replay {
    session: Session,
    commands: VecDeque<(u64, u64, Command)>,
    told: VecDeque<RecordedEvent>,
    last_gesture: u64,
    hashes_compared: u64,
    /// The kind of machine it was made on, if different from this one.
    other_machine: Option<String>,
    /// Whether it goes on after differences.
    watched: bool,
}

impl Replay {
    /// A replay that has not begun. Cloth that a graphics card has moved cannot be compared: differences then do not stop it.
    pub fn new(recording: Recording) -> Self {
        let runner = Runner::inline(Simulation::default());
        let other_machine = Some(recording.machine).filter(|kind| *kind != machine());
        Self {
            other_machine,
            session: Session::replaying(recording.project, runner),
            commands: recording.commands.into(),
            told: recording.told.into(),
            last_gesture: 0,
            hashes_compared: 0,
            watched: recording.by_card,
        }
    }

    /// A replay for watching: differences do not stop it.
    pub fn to_watch(recording: Recording) -> Self {
        Self { watched: true, ..Self::new(recording) }
    }

    /// Does one tick, one command or one comparison. False at the end of the recording.
    pub fn step(&mut self) -> Result<bool, Divergence> {
        if self.due_command().is_some() {
            self.apply_next()?;
            return Ok(true);
        }
        match self.told.front().copied() {
            Some(RecordedEvent::Applied { seq, tick }) => {
                if self.is_at(tick)? {
                    self.expect_taken_up(seq)?;
                    self.told.pop_front();
                }
            }
            Some(RecordedEvent::Hash { tick, seq, cloth, document }) => {
                if self.is_at(tick)? {
                    self.compare(seq, cloth, document)?;
                    self.told.pop_front();
                }
            }
            None => return Ok(false),
        }
        Ok(true)
    }

    /// The command that the next step will carry out; None if it does something else.
    pub fn due_command(&mut self) -> Option<&Command> {
        let last = match self.told.front().copied() {
            Some(
                RecordedEvent::Applied { seq, tick }
                | RecordedEvent::Hash { seq, tick, document: Some(_), .. },
            ) => self.has_come(tick).then_some(seq)?,
            Some(RecordedEvent::Hash { document: None, .. }) => return None,
            None => u64::MAX,
        };
        self.commands.front().filter(|(seq, ..)| *seq <= last).map(|(.., command)| command)
    }

    /// Whether the next step is a tick.
    pub fn is_tick_due(&mut self) -> bool {
        match self.told.front().copied() {
            Some(RecordedEvent::Applied { tick, .. } | RecordedEvent::Hash { tick, .. }) => {
                !self.has_come(tick)
            }
            None => false,
        }
    }

    /// Replays all of the recording.
    pub fn run(&mut self) -> Result<(), Divergence> {
        while self.step()? {}
        Ok(())
    }

    /// The session being replayed.
    pub fn session(&mut self) -> &mut Session {
        &mut self.session
    }

    /// The session being replayed, read-only.
    pub fn shown(&self) -> &Session {
        &self.session
    }

    /// Cloth hashes compared so far.
    pub fn hashes_compared(&self) -> u64 {
        self.hashes_compared
    }

    /// Ticks executed so far.
    pub fn ticks(&mut self) -> u64 {
        self.simulation().ticks()
    }

    fn simulation(&mut self) -> &mut Simulation {
        self.session.runner().simulation().expect("a replay runs inline")
    }

    /// Whether the event that the recording has after `tick` ticks is due.
    fn has_come(&mut self, tick: u64) -> bool {
        let watched = self.watched;
        let simulation = self.simulation();
        simulation.ticks() == tick || (watched && (simulation.ticks() > tick || simulation.is_at_rest()))
    }

    /// Whether the event that the recording has after `tick` ticks is due; does a tick if not.
    fn is_at(&mut self, tick: u64) -> Result<bool, Divergence> {
        if self.has_come(tick) {
            return Ok(true);
        }
        let now = self.simulation().ticks();
        if now > tick {
            return Err(self.diverged(words!("the recording goes back to tick {tick}", tick)));
        }
        if self.simulation().is_at_rest() {
            return Err(self.diverged(words!(
                "the cloth is at rest; in the recording it moves until tick {tick}",
                tick
            )));
        }
        self.simulation().tick();
        // Hashes and rejections are compared with the recording's lines, not kept.
        self.simulation().take_events();
        Ok(false)
    }

    fn apply_next(&mut self) -> Result<(), Divergence> {
        match self.commands.pop_front() {
            Some((seq, gesture, command)) => self.apply(seq, gesture, command),
            None => Ok(()),
        }
    }

    fn apply(&mut self, seq: u64, gesture: u64, command: Command) -> Result<(), Divergence> {
        if seq != self.session.last_seq() + 1 {
            return Err(self.diverged(words!("the next command is numbered {seq}", seq)));
        }
        if gesture != self.last_gesture && gesture != self.last_gesture + 1 {
            let words = words!(
                "command {seq} belongs to gesture {gesture}, not {next}",
                seq,
                gesture,
                next = self.last_gesture + 1
            );
            return Err(self.diverged(words));
        }
        self.last_gesture = gesture;
        let name = format!("{command:?}");
        let applied = self.session.apply(command, GestureId(gesture));
        self.simulation().take_events();
        applied.map_err(|why| {
            let name = name.split([' ', '{']).next().unwrap_or_default();
            self.diverged(words!("command {seq} ({name}) was refused: {why}", seq, name, why = why.0))
        })
    }

    fn expect_taken_up(&mut self, seq: u64) -> Result<(), Divergence> {
        let taken = self.simulation().seq();
        if taken == seq || self.watched {
            return Ok(());
        }
        Err(self.diverged(words!(
            "in the recording the simulation took command {seq} up, here {taken} was the last",
            seq,
            taken
        )))
    }

    fn compare(&mut self, seq: u64, cloth: u64, document: Option<u64>) -> Result<(), Divergence> {
        match document {
            Some(document) => {
                self.same(&words!("last command"), self.session.last_seq(), seq)?;
                let gesture = GestureId(self.last_gesture);
                self.session.end_gesture(gesture);
                self.simulation().take_events();
                let ours = self.session.document_hash();
                self.same_hash(&words!("document"), ours, document)?;
            }
            None => {
                let taken = self.simulation().seq();
                self.same(&words!("last command in the simulation"), taken, seq)?;
            }
        }
        let ours = self.simulation().hash();
        self.same_hash(&words!("cloth"), ours, cloth)?;
        self.hashes_compared += 1;
        Ok(())
    }

    fn same(&mut self, what: &Words, ours: u64, recorded: u64) -> Result<(), Divergence> {
        if ours == recorded || self.watched {
            return Ok(());
        }
        Err(self.diverged(words!("the {what} is {ours}, in the recording {recorded}", what, ours, recorded)))
    }

    fn same_hash(&mut self, what: &Words, ours: u64, recorded: u64) -> Result<(), Divergence> {
        if ours == recorded || self.watched {
            return Ok(());
        }
        let [ours, recorded] = [ours, recorded].map(|hash| Hex(hash).to_string());
        Err(self.diverged(words!(
            "the {what}'s hash is {ours}, in the recording {recorded}",
            what,
            ours,
            recorded
        )))
    }

    fn diverged(&mut self, mut words: Words) -> Divergence {
        if let Some(kind) = &self.other_machine {
            let own = machine();
            let note = words!("(recorded on {kind}, this is {own}: the last bits may differ)", kind, own);
            words = words.and(" ", note);
        }
        Divergence { tick: self.simulation().ticks(), seq: self.session.last_seq(), words }
    }
}

/// Carries out the commands of `recording` again, at the same ticks or at rest if that comes first, and returns a recording with
/// this program's hashes. For recordings that a change of the program has made outdated. A rejected command is an error, in
/// words.
pub fn recorded_again(recording: Recording) -> Result<String, String> {
    let mut session = Session::new(recording.project, Runner::inline(Simulation::default()));
    let ticks: BTreeMap<u64, u64> = recording
        .told
        .iter()
        .filter_map(
            |told| if let RecordedEvent::Applied { seq, tick } = *told { Some((seq, tick)) } else { None },
        )
        .collect();
    let mut last = GestureId(0);
    for (seq, gesture, command) in recording.commands {
        if gesture != last.0 {
            session.end_gesture(last);
        }
        last = GestureId(gesture);
        run_until(&mut session, ticks.get(&seq).copied().unwrap_or(0));
        session.apply(command, last).map_err(|why| format!("command {seq}: {why}"))?;
    }
    session.end_gesture(last);
    run_until(&mut session, u64::MAX);
    Ok(session.recording())
}

fn run_until(session: &mut Session, tick: u64) {
    if let Some(simulation) = session.runner().simulation() {
        while simulation.ticks() < tick && simulation.tick() {}
    }
    session.update();
}
