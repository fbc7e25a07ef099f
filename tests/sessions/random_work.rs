//! Everything that can be done, in any order, on five bodies: what is refused leaves no trace, each step is taken back and done
//! again bit for bit, everything stays finite and sound, what is saved is what is opened, and the same work gives the same bits.
//! `TOILE_COMMANDS` says how much is done on each body.

use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};
use toile::body::pose::NamedPose;
use toile::drag::{DragMode, Ray};
use toile::geometry::ids::{MarkId, PieceId, PinId, SeamId};
use toile::geometry::mesh::TriMesh;
use toile::pattern::activity::Activity;
use toile::pattern::edit::{PatternEdit, PointRef};
use toile::pattern::{
    AllowanceCorner, Edge, EdgeRef, EdgeShape, InternalLine, Piece, PlanePose, Seam, SpacePose,
};
use toile::session::recording::Recording;
use toile::session::replay::Replay;
use toile::session::{BodyChoice, Command, Document, Notice, Project, Session, Settings, project_file};
use toile::sim::{Runner, Simulation, StartChoice};
use toile::wrap::ClothSide;

use crate::common::chance::Chance;
use crate::common::{self, exact};

/// On each body, where nothing else is said.
const USUAL: usize = 120;
/// What recordings are replayed on, one after the other.
const WORKERS: [usize; 5] = [16, 3, 8, 1, 2];
/// Pieces beyond which none is added: more only take longer.
const MOST_PIECES: usize = 6;

struct Work {
    session: Session,
    chance: Chance,
    given: usize,
    done: usize,
    saved: usize,
    /// Of the work before it was opened again.
    recordings: Vec<String>,
}

/// What failed can be looked at and replayed.
impl Drop for Work {
    fn drop(&mut self) {
        if std::thread::panicking() {
            let path = std::env::temp_dir().join(format!("toile-random-work-{}.jsonl", self.given));
            match std::fs::write(&path, self.session.recording()) {
                Ok(()) => println!("recorded in {}", path.display()),
                Err(why) => println!("{}: {why}", path.display()),
            }
        }
    }
}

impl Work {
    fn new(mut project: Project, seed: u64) -> Self {
        project.document.settings.edge_length = 0.07;
        let session = Session::new(project, Runner::inline(Simulation::default()));
        Self { session, chance: Chance(seed), given: 0, done: 0, saved: 0, recordings: Vec::new() }
    }

    fn document(&self) -> &Document {
        self.session.document()
    }

    /// One of the ids given so far, or the next.
    fn id(&mut self) -> u32 {
        1 + self.chance.below(u64::from(self.document().pattern.next_id) + 1) as u32
    }

    fn piece(&mut self) -> PieceId {
        let pieces: Vec<PieceId> = self.document().pattern.pieces.keys().copied().collect();
        let at = self.chance.below(pieces.len() as u64 + 1) as usize;
        pieces.get(at).copied().unwrap_or(PieceId(self.id()))
    }

    fn seam(&mut self) -> SeamId {
        SeamId(self.id())
    }

    fn edge(&mut self) -> EdgeRef {
        EdgeRef { piece: self.piece(), edge: self.chance.below(6) as usize }
    }

    fn flat(&mut self) -> DVec2 {
        let c = &mut self.chance;
        DVec2::new(c.number(-0.02, 0.3), c.number(-0.02, 0.35))
    }

    fn corners(&mut self) -> Vec<DVec2> {
        let (origin, count) = (self.flat(), 3 + self.chance.below(3));
        let about = |i: u64| DVec2::from_angle(std::f64::consts::TAU * i as f64 / count as f64) * 0.12;
        (0..count).map(|i| origin + about(i)).collect()
    }

    fn solid(&mut self) -> DVec3 {
        let on_body = match &self.document().body {
            BodyChoice::Imported { mesh, .. } => mesh.positions.clone(),
            _ => vec![DVec3::new(0.0, 1.2, 0.12), DVec3::new(0.1, 0.9, 0.1), DVec3::new(-0.1, 1.1, -0.1)],
        };
        let at = self.chance.below(on_body.len() as u64) as usize;
        on_body[at] + DVec3::splat(self.chance.number(-0.01, 0.01))
    }

    fn strokes(&mut self) -> (Vec<DVec2>, Vec<DVec3>) {
        let count = 1 + self.chance.below(3);
        ((0..count).map(|_| self.flat()).collect(), (0..count).map(|_| self.solid()).collect())
    }

    fn shape(&mut self) -> EdgeShape {
        match self.chance.below(4) {
            0 => EdgeShape::Line,
            1 => EdgeShape::Arc { radius: self.chance.number(0.05, 0.5), large: false, sweep: self.heads() },
            2 => EdgeShape::Quadratic { control: self.flat() },
            _ => EdgeShape::Cubic { controls: [self.flat(), self.flat()] },
        }
    }

    fn heads(&mut self) -> bool {
        self.chance.below(2) == 0
    }

    /// Another body, or another pose of the same.
    fn body(&mut self) -> BodyChoice {
        let turn = DQuat::from_rotation_y(self.chance.number(-0.2, 0.2));
        let grown = self.chance.number(0.95, 1.05);
        let same = self.heads();
        match (&self.document().body, same) {
            (BodyChoice::Imported { name, mesh }, true) => {
                let positions = mesh.positions.iter().map(|&p| turn * p * grown).collect();
                let mesh = Arc::new(TriMesh { positions, triangles: mesh.triangles.clone() });
                BodyChoice::Imported { name: name.clone(), mesh }
            }
            (BodyChoice::Imported { .. }, false) => {
                let mesh = Arc::new(exact::cylinder(0.15 * grown, 1.0, 16, 6));
                BodyChoice::Imported { name: "cylinder".to_owned(), mesh }
            }
            (figure, _) => figure.in_named_pose(NamedPose::T).unwrap_or_default(),
        }
    }

    fn command(&mut self) -> Command {
        let mark = MarkId(1 + self.chance.below(u64::from(self.document().last_mark) + 1) as u32);
        let pin = PinId(1 + self.chance.below(u64::from(self.document().last_pin) + 1) as u32);
        let (flat, solid) = self.strokes();
        match self.chance.below(40) {
            0 => Command::AddClothMark { piece: self.piece(), side: ClothSide::Front, points: flat },
            1 => Command::AddBodyMark { points: solid },
            2 => Command::DeleteMark { mark },
            3 => Command::DeletePair { number: 1 + self.chance.below(3) as usize },
            4 => Command::MoveMark { mark, to: 1 + self.chance.below(3) as usize },
            5 => Command::RenameMark {
                mark,
                name: ["Ärmel", "", "\u{7}"][self.chance.below(3) as usize].to_owned(),
            },
            6 => Command::SetMarks { marks: self.document().marks.clone() },
            7 => Command::DeletePiece { piece: self.piece() },
            8 => Command::RenamePiece { piece: self.piece(), name: format!("piece {}", self.given) },
            9 => {
                let pose = PlanePose {
                    offset: self.flat(),
                    rotation: self.chance.number(-3.0, 3.0),
                    flipped: self.heads(),
                };
                Command::SetPiecePose { piece: self.piece(), pose }
            }
            10 => Command::AddSeam { seam: Seam::of_edges([self.edge(), self.edge()], self.heads()) },
            11 => Command::DeleteSeam { seam: self.seam() },
            12 => Command::ReverseSeam { seam: self.seam() },
            13 => Command::Repose { body: self.body(), settle: self.heads(), draft: self.heads() },
            14 => Command::AimPose { body: self.body() },
            15 => Command::PoseTowards { share: self.chance.number(-0.05, 1.05), draft: self.heads() },
            16 if self.chance.below(4) == 0 => Command::SetBody { body: self.body(), animations: None },
            16 => Command::SetBones { bones: self.heads().then(|| vec![[DVec3::ZERO, solid[0]]]) },
            17 => {
                let settings = Settings { edge_length: self.chance.number(0.06, 0.1), ..Settings::default() };
                Command::SetSettings { settings }
            }
            18..=20 => Command::Wrap,
            21 => Command::Rewrap { pairs: (0..self.chance.below(3)).map(|n| 1 + n as usize).collect() },
            22 => Command::CancelWrap,
            23 if self.chance.below(4) == 0 => Command::Unwrap,
            23 => Command::Sew,
            24 => Command::Dress { choice: StartChoice::default() },
            25..=26 => Command::AddPin { piece: self.piece(), at: self.flat() },
            27 => Command::MovePin { pin, piece: self.piece(), at: self.flat() },
            28 => Command::LockPins { pins: vec![pin], locked: self.heads() },
            29 => Command::DeletePins { pins: vec![pin] },
            30 => Command::SetRelaxing { on: self.heads() },
            31 => Command::SetDraping { on: self.heads() },
            32 => Command::StepDraping { ticks: self.chance.below(3) as u32 },
            33 => {
                let fabric = ["wool", "denim-14oz", "gold"][self.chance.below(3) as usize];
                let piece = self.heads().then(|| self.piece());
                Command::SetFabric { piece, fabric: Some(fabric.to_owned()) }
            }
            34 => Command::Undo,
            35 => Command::Redo,
            _ => Command::EditPattern { edits: vec![self.edit()], anew: false },
        }
    }

    fn edit(&mut self) -> PatternEdit {
        let (piece, edge, seam) = (self.piece(), self.edge(), self.seam());
        let point = PointRef { piece, point: self.chance.below(5) as usize };
        let [from, to] = [self.flat(), self.flat()];
        let is_full = self.document().pattern.pieces.len() >= MOST_PIECES;
        match self.chance.below(31) {
            0 if !is_full => {
                PatternEdit::AddPiece { piece: Arc::new(Piece::polygon("new", &self.corners())) }
            }
            1 if !is_full => PatternEdit::Duplicate { pieces: vec![piece], offset: to },
            2 if !is_full => PatternEdit::AddTwin { piece, offset: to },
            3 => PatternEdit::MakeSymmetric { piece, axis: [from, to] },
            4 => PatternEdit::Unfold { edge },
            5 => PatternEdit::Fold { piece },
            6 => PatternEdit::Unlink { piece },
            7 => {
                let turn = DQuat::from_rotation_y(self.chance.number(-3.0, 3.0));
                let pose = self.heads().then(|| SpacePose::flat(self.solid() * 1.2, turn));
                PatternEdit::PlaceInSpace { placements: vec![(piece, pose)] }
            }
            8 => PatternEdit::Scale {
                pieces: vec![piece],
                about: from,
                factor: DVec2::splat(self.chance.number(0.9, 1.1)),
            },
            9 => PatternEdit::SetLayer { pieces: vec![piece], layer: self.chance.below(18) as u8 },
            10 => {
                let activity = [Activity::Active, Activity::Frozen, Activity::Deactivated]
                    [self.chance.below(3) as usize];
                PatternEdit::SetActivity { pieces: vec![piece], activity }
            }
            11..=13 => PatternEdit::MovePoints { points: vec![(point, to)] },
            14 => PatternEdit::SetEdge { edge, shape: self.shape() },
            15 => PatternEdit::InsertPoint { edge, at: self.chance.number(-0.05, 1.05) },
            16 => PatternEdit::DeletePoint { point },
            17 => PatternEdit::SetSmooth { point, smooth: self.heads() },
            18 if !is_full => {
                let line = InternalLine {
                    name: String::new(),
                    edges: vec![Edge { start: from, ..Edge::default() }],
                    end: to,
                    ..InternalLine::default()
                };
                PatternEdit::Cut { piece, line, sew: self.heads() }
            }
            19 => PatternEdit::AddDart {
                edge,
                at: self.chance.number(0.2, 0.8),
                width: self.chance.number(0.005, 0.04),
                depth: self.chance.number(0.02, 0.1),
            },
            20 => PatternEdit::AddNotch { edge, at: self.chance.number(0.0, 1.0) },
            21 => PatternEdit::DeleteNotch { piece, notch: 0 },
            22 => {
                let line = InternalLine {
                    name: "fold".to_owned(),
                    edges: vec![Edge { start: from, ..Edge::default() }],
                    end: to,
                    ..InternalLine::default()
                };
                PatternEdit::AddLine { piece, line }
            }
            23 => PatternEdit::AddHole {
                piece,
                edges: Piece::polygon("", &[from, to, from + DVec2::splat(0.02)]).outline,
            },
            24 => PatternEdit::DeleteHole { piece, hole: 0 },
            25 => PatternEdit::SetGrainline { piece, grainline: self.heads().then_some([from, to]) },
            26 => PatternEdit::SetAllowance { pieces: vec![piece], width: self.chance.number(0.0, 0.05) },
            27 => {
                PatternEdit::SetCorner { point, corner: AllowanceCorner::ALL[self.chance.below(5) as usize] }
            }
            28 => PatternEdit::Sew { seam: Seam::of_edges([edge, self.edge()], self.heads()) },
            29 => PatternEdit::SetRatio { seam, ratio: self.heads().then(|| self.chance.number(0.5, 2.0)) },
            _ => PatternEdit::UntwistSeams,
        }
    }

    fn state(&mut self) -> (Document, u64) {
        (self.document().clone(), common::cloth_hash(&mut self.session))
    }

    /// `command`, held against what must be so after any; often it is taken back and done again at once.
    fn carry_out(&mut self, command: Command) {
        self.given += 1;
        let words = format!("command {}: {command:?}", self.given);
        let words: String = words.chars().take(400).collect();
        let is_return = matches!(command, Command::Undo | Command::Redo);
        let (before, steps) = (self.state(), self.session.step_labels().count());
        let applied = self.session.apply_alone(command);
        self.look(&words);
        if let Err(why) = applied {
            assert!(self.state() == before, "refused ({why}), but not without a trace: {words}");
            return;
        }
        self.done += 1;
        let problem = self.session.project().problem();
        assert_eq!(problem, None, "{words}");
        if !is_return && self.session.step_labels().count() > steps && self.chance.below(3) == 0 {
            let after = self.state();
            self.session.apply_alone(Command::Undo).expect("a step can be taken back");
            assert!(self.state() == before, "taken back, but other than before: {words}");
            self.session.apply_alone(Command::Redo).expect("and be done again");
            assert!(self.state() == after, "done again, but other than before: {words}");
        }
    }

    /// A drag along the skin that may be let go or taken back.
    fn drag(&mut self) {
        let mode = [DragMode::Surface, DragMode::Vertex, DragMode::Rigid][self.chance.below(3) as usize];
        let gesture = self.session.begin_gesture();
        let grab = Command::Grab { piece: self.piece(), at: self.flat(), mode };
        if self.session.apply(grab, gesture).is_ok() {
            for _ in 0..2 {
                let to = self.solid();
                let ray = Ray { origin: to * 3.0, direction: -to };
                self.session.apply(Command::DragTo { ray }, gesture).ok();
                self.tick(2, "a drag");
            }
            let end = if self.heads() { Command::Release } else { Command::CancelGesture };
            self.session.apply(end, gesture).ok();
        }
        self.session.end_gesture(gesture);
        self.look("a drag");
    }

    fn tick(&mut self, ticks: u64, words: &str) {
        let simulation = self.session.runner().simulation().expect("inline");
        (0..ticks).take_while(|_| simulation.tick()).for_each(drop);
        self.look(words);
    }

    /// Nothing failed inside, and cloth lies where finite points are.
    fn look(&mut self, words: &str) {
        for notice in self.session.update() {
            let inside =
                |words: &str| words.contains("a step of the simulation failed") || words.contains("finite");
            if let Notice::Failed { words: why, .. } = &notice {
                assert!(!inside(why), "{words}: {why}");
            }
        }
        let cloth = &self.session.snapshot().cloth;
        let mut laid = cloth.positions.iter().zip(&cloth.mapped).filter(|(_, mapped)| **mapped);
        assert!(laid.all(|(p, _)| p.is_finite() && p.length() < 1e3), "{words}");
    }

    /// What is saved is what is opened; sometimes the work goes on from there.
    fn save(&mut self) {
        let project = self.session.project();
        let bytes = project_file::to_bytes(&project).expect("any work can be saved");
        let opened = project_file::from_bytes(&bytes).expect("what was saved can be opened");
        assert!(opened == project);
        self.saved += 1;
        if self.chance.below(3) == 0 {
            self.recordings.push(self.session.recording());
            self.session = Session::new(opened, Runner::inline(Simulation::default()));
        }
    }

    fn go(&mut self, count: usize) {
        while self.given < count {
            match self.chance.below(30) {
                0 => self.save(),
                1..=2 => self.drag(),
                _ => {
                    let command = self.command();
                    self.carry_out(command);
                }
            }
            let ticks = [0, 1, 3, 40][self.chance.below(4) as usize];
            self.tick(ticks, "a tick");
        }
        self.recordings.push(self.session.recording());
    }
}

fn work(name: &str, project: Project, seed: u64) {
    let count =
        std::env::var("TOILE_COMMANDS").map_or(USUAL, |n| n.parse().expect("TOILE_COMMANDS is a number"));
    let mut work = Work::new(project, seed);
    work.go(count);
    let mut compared = 0;
    for (recording, workers) in work.recordings.iter().zip(WORKERS.into_iter().cycle().skip(seed as usize)) {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(workers).build().expect("workers");
        compared += pool.install(|| {
            let mut replay = Replay::new(Recording::parse(recording).expect("a recording"));
            replay.run().unwrap_or_else(|difference| panic!("{name} on {workers} threads: {difference}"));
            replay.hashes_compared()
        });
    }
    let (given, done, saved) = (work.given, work.done, work.saved);
    println!("{name}: {given} commands, {done} carried out, saved {saved} times, {compared} hashes the same");
    assert!(done > count / 4 && compared > 0);
}

fn with_body(name: &str, mesh: TriMesh) -> Project {
    let mut project = common::project();
    project.document.body = BodyChoice::Imported { name: name.to_owned(), mesh: Arc::new(mesh) };
    project
}

#[test]
fn on_a_ball() {
    work("ball", common::project(), 11);
}

#[test]
fn on_a_cylinder() {
    work("cylinder", with_body("cylinder", exact::cylinder(0.15, 1.0, 24, 10)), 12);
}

#[test]
fn on_a_limb() {
    work("limb", common::limb::project(), 13);
}

#[test]
fn on_a_spindle_with_placed_pieces() {
    work("spindle", common::placed_project(0.39, 0.33), 14);
}

#[test]
fn on_the_mannequin() {
    let mut project = common::project();
    project.document.body = BodyChoice::default();
    work("mannequin", project, 15);
}
