//! Ten thousand commands at random on three bodies: everything stays finite, nothing panics, the same commands give the
//! same bits, and undo returns every bit of document and cloth.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::{DVec2, DVec3};
use toile::drag::{DragMode, Ray};
use toile::geometry::ids::{MarkId, PieceId, PinId};
use toile::geometry::mesh::TriMesh;
use toile::pattern::edit::{PatternEdit, PointRef};
use toile::pattern::{EdgeRef, Pattern};
use toile::relax::RelaxSettings;
use toile::session::recording::Recording;
use toile::session::replay::Replay;
use toile::session::{BodyChoice, Command, Document, GestureId, Notice, Project, Session, Settings};
use toile::sim::{Runner, Simulation};
use toile::wrap::ClothSide;

use crate::common::chance::Chance;
use crate::common::{self, exact};

/// On each body.
const COMMANDS: usize = 3334;
/// As many can be undone.
const MOST_STEPS: usize = 1000;
/// Metres: small garments.
const EDGE: f64 = 0.07;

/// A closed ring about y: two limbs for cloth to lie on, and a hole to fall through.
fn torus(radius: f64, thick: f64, round: u32, sides: u32) -> TriMesh {
    let mut mesh = TriMesh::default();
    for i in 0..round {
        let (sin, cos) = (f64::from(i) / f64::from(round) * TAU).sin_cos();
        for j in 0..sides {
            let (up, out) = (f64::from(j) / f64::from(sides) * TAU).sin_cos();
            let r = radius + thick * out;
            mesh.positions.push(DVec3::new(r * sin, thick * up, r * cos));
        }
    }
    let at = |i: u32, j: u32| (i % round) * sides + j % sides;
    for i in 0..round {
        for j in 0..sides {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            mesh.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    mesh
}

fn on_body(name: &str, mesh: TriMesh) -> Project {
    let mut project = common::project();
    project.document.body = BodyChoice::Imported { name: name.to_owned(), mesh: Arc::new(mesh) };
    project.document.settings.edge_length = EDGE;
    project
}

/// What undo must bring back: the document before the step, and the cloth if the step touched it.
#[derive(Clone, PartialEq)]
struct Kept {
    document: Document,
    cloth: Option<u64>,
}

struct Fuzz {
    session: Session,
    chance: Chance,
    /// What each done step returns to, and each undone one.
    done: Vec<Kept>,
    undone: Vec<Kept>,
    /// Points on the skin to aim at.
    skin: Vec<DVec3>,
    given: usize,
    /// Undos and redos that brought other cloth back.
    returns: usize,
    /// Drags that had cloth in the hand.
    drags: usize,
    /// Wraps that laid cloth.
    wraps: usize,
}

impl Fuzz {
    fn new(project: Project, seed: u64) -> Self {
        let BodyChoice::Imported { mesh, .. } = &project.document.body else { panic!("a mesh") };
        let skin = mesh.positions.clone();
        let session = Session::new(project, Runner::inline(Simulation::default()));
        Self {
            session,
            chance: Chance(seed),
            done: Vec::new(),
            undone: Vec::new(),
            skin,
            given: 0,
            returns: 0,
            drags: 0,
            wraps: 0,
        }
    }

    fn cloth(&mut self) -> u64 {
        common::cloth_hash(&mut self.session)
    }

    fn steps(&self) -> usize {
        self.session.step_labels().count()
    }

    /// Ticks, and looks that all is well.
    fn run(&mut self, ticks: u64) {
        let simulation = self.session.runner().simulation().expect("inline");
        (0..ticks).for_each(|_| {
            simulation.tick();
        });
        for notice in self.session.update() {
            assert!(!matches!(notice, Notice::Failed { .. }), "command {}: {notice:?}", self.given);
            assert!(notice != Notice::HistoryShortened, "memory for these small states does not run out");
        }
        let cloth = &self.session.snapshot().cloth;
        let mapped = cloth.positions.iter().zip(&cloth.mapped).filter(|(_, m)| **m);
        for (p, _) in mapped {
            assert!(p.is_finite() && p.length() < 1e3, "command {}: {p}", self.given);
        }
    }

    fn piece(&mut self) -> PieceId {
        PieceId(1 + self.chance.below(20).saturating_sub(17) as u32 + self.chance.below(2) as u32)
    }

    fn flat(&mut self) -> DVec2 {
        let c = &mut self.chance;
        DVec2::new(c.number(-0.02, 0.27), c.number(-0.02, 0.32))
    }

    fn on_skin(&mut self) -> DVec3 {
        let i = self.chance.below(self.skin.len() as u64) as usize;
        self.skin[i] + DVec3::splat(1.0) * self.chance.number(-0.01, 0.01)
    }

    /// A short level stroke, or any.
    fn solid_stroke(&mut self) -> Vec<DVec3> {
        let from = self.on_skin();
        match self.chance.below(4) {
            0 => vec![from],
            1 => vec![from, self.on_skin(), self.on_skin()],
            _ => {
                let way = DVec3::Y.cross(from).normalize_or_zero() * self.chance.between(0.05, 0.2);
                (0..4).map(|k| from + way * f64::from(k) / 3.0).collect()
            }
        }
    }

    fn ray(&mut self) -> Ray {
        let to = self.on_skin();
        let c = &mut self.chance;
        let eye = DVec3::new(c.between(-3.0, 3.0), c.between(-1.0, 2.0), c.between(-3.0, 3.0));
        Ray { origin: eye, direction: to - eye }
    }

    fn command(&mut self) -> Command {
        let mark = MarkId(1 + self.chance.below(u64::from(self.session.document().last_mark) + 2) as u32);
        match self.chance.below(27) {
            24..=26 => Command::EditPattern { edits: vec![self.edit()], anew: false },
            0..=1 => {
                let (piece, count) = (self.piece(), 1 + self.chance.below(4));
                let side = if self.chance.below(8) == 0 { ClothSide::Back } else { ClothSide::Front };
                let points = (0..count).map(|_| self.flat()).collect();
                Command::AddClothMark { piece, side, points }
            }
            2..=3 => Command::AddBodyMark { points: self.solid_stroke() },
            4..=6 => Command::DeleteMark { mark },
            7 => Command::MoveMark { mark, to: 1 + self.chance.below(4) as usize },
            8..=10 => Command::Wrap,
            11..=13 => Command::AddPin { piece: self.piece(), at: self.flat() },
            14..=15 => {
                let last = u64::from(self.session.document().last_pin);
                let pin = PinId(1 + self.chance.below(last + 1) as u32);
                match self.chance.below(6) {
                    0 => Command::MovePin { pin, piece: self.piece(), at: self.flat() },
                    1 => Command::LockPins { pins: vec![pin], locked: self.chance.below(2) == 0 },
                    2 => Command::ClearPins,
                    _ => Command::DeletePin { pin },
                }
            }
            16 => {
                let c = &mut self.chance;
                let relax = RelaxSettings {
                    stretch: c.number(-0.01, 1.0),
                    flatten: c.number(0.0, 1.01),
                    gravity: c.number(0.0, 0.101),
                    friction: c.number(0.0, 2.01),
                    offset: c.number(0.0, 0.05),
                    ..RelaxSettings::default()
                };
                Command::SetSettings {
                    settings: Settings { edge_length: c.number(0.06, 0.12), relax, ..Settings::default() },
                }
            }
            17 => Command::SetSettings { settings: Settings { edge_length: EDGE, ..Settings::default() } },
            18..=21 => Command::Undo,
            _ => Command::Redo,
        }
    }

    /// Changes the pattern a little.
    fn edit(&mut self) -> PatternEdit {
        let id = self.piece();
        let piece = self.session.document().pattern.pieces.get(&id).cloned();
        let count = piece.as_ref().map_or(4, |piece| piece.edge_count());
        let c = &mut self.chance;
        let point = c.below(count as u64) as usize;
        let edge = EdgeRef { piece: id, edge: point };
        match c.below(if count > 8 { 6 } else { 5 }) {
            0..=1 => {
                let start = piece.map_or(DVec2::ZERO, |piece| piece.edge(point).start);
                let to = start + DVec2::new(c.number(-0.01, 0.01), c.number(-0.01, 0.01));
                PatternEdit::MovePoints { points: vec![(PointRef { piece: id, point }, to)] }
            }
            2 => PatternEdit::InsertPoint { edge, at: c.number(0.1, 0.9) },
            3 => {
                let seam = self.session.document().pattern.seams.keys().next().copied().unwrap_or_default();
                PatternEdit::SetRatio { seam, ratio: [None, Some(1.0)][self.chance.below(2) as usize] }
            }
            4 => PatternEdit::Scale {
                pieces: vec![id],
                about: DVec2::ZERO,
                factor: DVec2::new(c.number(0.97, 1.03), c.number(0.97, 1.03)),
            },
            _ => PatternEdit::DeletePoint { point: PointRef { piece: id, point } },
        }
    }

    /// Carries out `command` and holds it against what undo and redo should do. Whether it was not refused.
    fn apply(&mut self, command: Command, gesture: GestureId) -> bool {
        self.given += 1;
        let before = Kept { document: self.session.document().clone(), cloth: Some(self.cloth()) };
        let (relax, cloth_before) = (before.document.settings.relax, before.cloth);
        let touches = match &command {
            Command::Wrap
            | Command::AddPin { .. }
            | Command::DeletePin { .. }
            | Command::ClearPins
            | Command::MovePin { .. }
            | Command::Grab { .. } => true,
            Command::SetSettings { settings } => settings.relax != relax,
            _ => false,
        };
        let steps = self.steps();
        let is_step = !matches!(command, Command::DragTo { .. } | Command::Release);
        let words = format!("command {}: {command:?}", self.given);
        let is_undo = command == Command::Undo;
        let is_redo = command == Command::Redo;
        let is_wrap = command == Command::Wrap;
        let (is_edit, old) =
            (matches!(command, Command::EditPattern { .. }), before.document.pattern.clone());
        let applied = self.session.apply(command, gesture).is_ok();
        if !applied {
            let now = Kept { document: self.session.document().clone(), cloth: Some(self.cloth()) };
            assert!(now == before && self.steps() == steps, "refused, but not without a trace: {words}");
        } else if is_undo || is_redo {
            let (from, to) =
                if is_undo { (&mut self.done, &mut self.undone) } else { (&mut self.undone, &mut self.done) };
            let kept = from.pop().expect("something to return to");
            to.push(Kept { cloth: before.cloth.filter(|_| kept.cloth.is_some()), ..before });
            self.returns += usize::from(kept.cloth.is_some() && kept.cloth != cloth_before);
            assert!(*self.session.document() == kept.document, "another document: {words}");
            if let Some(cloth) = kept.cloth {
                assert_eq!(self.cloth(), cloth, "other cloth: {words}");
            }
        } else if is_step {
            let new = &self.session.document().pattern;
            let cut = |p: &Pattern| -> Vec<_> { p.pieces.values().map(|p| p.outline.clone()).collect() };
            let touches = touches || (is_edit && cut(&old) != cut(new));
            self.undone.clear();
            self.done.push(Kept { cloth: before.cloth.filter(|_| touches), ..before });
            if self.done.len() > MOST_STEPS {
                self.done.remove(0);
            }
        }
        assert_eq!(self.steps(), self.done.len(), "{words}");
        self.run(0);
        self.wraps += usize::from(is_wrap && self.session.snapshot().is_dressed());
        applied
    }

    fn alone(&mut self, command: Command) {
        let gesture = self.session.begin_gesture();
        self.apply(command, gesture);
        self.session.end_gesture(gesture);
    }

    /// A drag, let go or cancelled, seldom left in the hand.
    fn drag(&mut self) {
        let gesture = self.session.begin_gesture();
        let before = self.session.document().clone();
        let (cloth, done, undone) = (self.cloth(), self.done.clone(), self.undone.clone());
        let mode = [DragMode::Surface, DragMode::Vertex, DragMode::Rigid][self.chance.below(3) as usize];
        let grab = Command::Grab { piece: self.piece(), at: self.flat(), mode };
        let taken = self.apply(grab, gesture);
        self.drags += usize::from(self.session.snapshot().dragged.is_some());
        for _ in 0..=self.chance.below(4) {
            let ray = self.ray();
            self.apply(Command::DragTo { ray }, gesture);
            let ticks = self.chance.below(4);
            self.run(ticks);
        }
        match self.chance.below(8) {
            0..=1 if taken && done.len() < MOST_STEPS => {
                self.given += 1;
                self.session.apply(Command::CancelGesture, gesture).expect("cancelled");
                (self.done, self.undone) = (done, undone);
                assert!(*self.session.document() == before && self.steps() == self.done.len());
                assert_eq!(self.cloth(), cloth, "command {}: a cancelled drag leaves a trace", self.given);
            }
            2 => {}
            _ => {
                self.apply(Command::Release, gesture);
            }
        }
        self.session.end_gesture(gesture);
    }

    fn go(&mut self) {
        while self.given < COMMANDS {
            if self.chance.below(12) == 0 {
                self.drag();
            } else {
                let command = self.command();
                self.alone(command);
            }
            let ticks = match self.chance.below(60) {
                0..=2 => 60,
                3..=30 => self.chance.below(4),
                _ => 0,
            };
            self.run(ticks);
        }
    }

    /// All the way back, and forth again.
    fn back_and_forth(&mut self) {
        let end = Kept { document: self.session.document().clone(), cloth: None };
        let count = self.done.len();
        for _ in 0..count {
            self.alone(Command::Undo);
        }
        assert_eq!(self.steps(), 0);
        for _ in 0..count {
            self.alone(Command::Redo);
        }
        assert!(*self.session.document() == end.document);
    }
}

fn fuzz(name: &str, mesh: TriMesh, seed: u64) {
    let mut fuzz = Fuzz::new(on_body(name, mesh), seed);
    fuzz.go();
    fuzz.back_and_forth();
    let Fuzz { given, returns, drags, wraps, .. } = fuzz;
    println!("{name}: {given} commands, {wraps} wraps, {drags} drags, other cloth came back {returns} times");
    assert!(wraps > 100 && drags > 20 && returns > 100);
    // The same commands again, in a session of their own: the same hashes.
    let recording = Recording::parse(&fuzz.session.recording()).expect("a recording");
    let mut replay = Replay::new(recording);
    replay.run().unwrap_or_else(|difference| panic!("{name}: {difference}"));
    assert!(replay.hashes_compared() > 1000);
}

#[test]
fn on_a_ball() {
    fuzz("ball", common::ball(0.75, 16, 32), 1);
}

#[test]
fn on_a_cylinder() {
    fuzz("cylinder", exact::cylinder(0.15, 1.0, 24, 10), 2);
}

#[test]
fn on_a_ring() {
    let ring = torus(0.3, 0.12, 32, 16);
    assert!((ring.volume() - 2.0 * PI * PI * 0.3 * 0.12f64.powi(2)).abs() < 0.005, "inside out");
    fuzz("ring", ring, 3);
}

/// What undo and redo bring back is all of the cloth, not only where it is: it goes on as it would have.
#[test]
fn cloth_brought_back_goes_on_as_it_would_have() {
    let run = |back: bool| {
        let project = on_body("ball", common::ball(0.75, 16, 32));
        let mut session = Session::new(project, Runner::inline(Simulation::default()));
        let mut hashes = Vec::new();
        let pin =
            |ticks: usize| Command::AddPin { piece: PieceId(1), at: DVec2::new(0.1, ticks as f64 * 1e-3) };
        for pins in [false, true] {
            for ticks in [0, 3, 17, 90] {
                let command = if pins { pin(ticks) } else { Command::Wrap };
                session.apply_alone(command).expect("done");
                common::run(&mut session, ticks);
                if back {
                    session.apply_alone(Command::Undo).expect("undone");
                    common::run(&mut session, 5);
                    session.apply_alone(Command::Redo).expect("redone");
                }
                common::run(&mut session, 30);
                hashes.push(common::cloth_hash(&mut session));
            }
        }
        hashes
    };
    assert_eq!(run(false), run(true));
}
