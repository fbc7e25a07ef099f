//! Where demos are played: a session, a hand with a mouse, and time to watch.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};
use toile::body::mannequin;
use toile::cloth::FlatPiece;
use toile::drag::{DragMode, Ray};
use toile::geometry::ids::PieceId;
use toile::session::samples::Sample;
use toile::session::{Command, Project, Session};
use toile::sim::{Runner, Simulation};
use toile::wrap::{BodyMark, ClothMark, Marks, Phase};

/// How far in front of the cloth the eye is, metres.
const EYE: f64 = 3.0;

/// A point of the flat cloth.
pub type At = (PieceId, DVec2);

/// A session under a hand.
pub struct Stage {
    pub session: Session,
}

impl Stage {
    pub fn new(project: Project) -> Self {
        Self { session: Session::new(project, Runner::inline(Simulation::default())) }
    }

    /// The sample without its marks, and those.
    pub fn bare(sample: Sample) -> (Self, Arc<Marks>) {
        let mut project = sample.project(&mannequin::default());
        let marks = std::mem::take(&mut project.document.marks);
        project.document.last_mark = 0;
        (Self::new(project), marks)
    }

    /// The sample on the body, at rest.
    pub fn dressed(sample: Sample) -> Self {
        let mut stage = Self::new(sample.project(&mannequin::default()));
        stage.give(Command::Wrap);
        stage.rest();
        stage
    }

    pub fn give(&mut self, command: Command) {
        self.session.apply_alone(command).expect("accepted");
        self.session.update();
    }

    /// As one gesture.
    pub fn give_together(&mut self, commands: impl IntoIterator<Item = Command>) {
        let gesture = self.session.begin_gesture();
        for command in commands {
            self.session.apply(command, gesture).expect("accepted");
        }
        self.session.end_gesture(gesture);
        self.session.update();
    }

    pub fn run(&mut self, ticks: usize) {
        let simulation = self.session.runner().simulation().expect("inline");
        for _ in 0..ticks {
            simulation.tick();
        }
        self.session.update();
    }

    pub fn rest(&mut self) {
        self.run(5000);
        assert_eq!(self.session.snapshot().phase, Some(Phase::AtRest));
    }

    pub fn wrap_and_drape(&mut self) {
        for command in [Command::Wrap, Command::SetDraping { on: true }] {
            self.give(command);
            self.rest();
        }
    }

    pub fn piece(&self, name: &str) -> PieceId {
        self.session.document().pattern.piece_named(name).expect("a piece of this name")
    }

    /// Where a point of the cloth lies.
    pub fn place(&self, (piece, at): At) -> DVec3 {
        let snapshot = self.session.snapshot();
        let garment = snapshot.garment.as_ref().expect("dressed");
        let place = FlatPiece::new(garment, piece).nearest(garment, at).expect("on the piece");
        place.point(garment, &snapshot.cloth).expect("laid")
    }

    pub fn paint_pair(&mut self, cloth: &ClothMark, body: &BodyMark) {
        self.give(paint_cloth(cloth));
        self.give(paint_body(body));
    }

    /// Along the skin through `corners`.
    pub fn stroke(&self, corners: &[DVec3]) -> Vec<DVec3> {
        let surface = self.session.surface().expect("a body");
        let mut points = Vec::new();
        for side in corners.windows(2) {
            let steps = (side[0].distance(side[1]) / 0.01).ceil();
            points.extend((0..steps as usize).map(|k| side[0].lerp(side[1], k as f64 / steps)));
        }
        points.extend(corners.last());
        points.into_iter().map(|p| surface.nearest(p).point).collect()
    }

    pub fn pin(&mut self, (piece, at): At) {
        self.give(Command::AddPin { piece, at });
    }

    /// Takes the cloth at `from` in the hand, goes along `way` (from where the cloth is; 0..=1) in `ticks` ticks, waits
    /// a little and lets go.
    pub fn drag(&mut self, from: At, mode: DragMode, ticks: usize, way: impl Fn(DVec3, f64) -> DVec3) {
        let start = self.place(from);
        let out = DVec3::new(start.x, 0.0, start.z).normalize_or(DVec3::Z);
        let eye = start + out * EYE;
        let gesture = self.session.begin_gesture();
        let give = |stage: &mut Self, command: Command, ticks: usize| {
            stage.session.apply(command, gesture).expect("accepted");
            stage.run(ticks);
        };
        give(self, Command::Grab { piece: from.0, at: from.1, mode }, 1);
        for k in 1..=ticks {
            let at = way(start, k as f64 / ticks as f64);
            give(self, Command::DragTo { ray: Ray { origin: eye, direction: at - eye } }, 1);
        }
        self.run(40);
        self.session.apply(Command::Release, gesture).expect("accepted");
        self.session.end_gesture(gesture);
        self.rest();
    }

    /// What is wrong with the cloth as it lies, in words.
    pub fn faults(&mut self) -> Vec<String> {
        self.session.runner().simulation().expect("inline").judge();
        self.session.update();
        let verdict = self.session.snapshot().verdict.clone().expect("judged");
        verdict.iter().map(|fault| format!("{}: {}", fault.problem.place, fault.problem.words)).collect()
    }
}

/// Round the body by `turn` radians.
pub fn round(turn: f64) -> impl Fn(DVec3, f64) -> DVec3 {
    move |start, t| DQuat::from_rotation_y(turn * t) * start
}

/// Straight by `shift`.
pub fn straight(shift: DVec3) -> impl Fn(DVec3, f64) -> DVec3 {
    move |start, t| start + shift * t
}

/// How far round the body `p` is, radians from the front to the left.
pub fn heading(p: DVec3) -> f64 {
    p.x.atan2(p.z)
}

/// `a` minus `b`, the short way round.
pub fn turned(a: f64, b: f64) -> f64 {
    (a - b + 1.5 * TAU).rem_euclid(TAU) - TAU / 2.0
}

pub fn paint_cloth(mark: &ClothMark) -> Command {
    Command::AddClothMark { piece: mark.piece, side: mark.side, points: mark.points.clone() }
}

pub fn paint_body(mark: &BodyMark) -> Command {
    Command::AddBodyMark { points: mark.points.clone() }
}
