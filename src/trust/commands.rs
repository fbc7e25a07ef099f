//! Short lists of commands of every kind, as files to damage: a recording from elsewhere may contain the like.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use serde_json::json;

use crate::geometry::ids::{GraphicId, ImageId, PieceId, SeamId};
use crate::io::words::readable;
use crate::pattern::edit::{LinePoint, PatternEdit, PointRef, TrimLine};
use crate::pattern::grading::READY_SIZES;
use crate::pattern::{
    AllowanceCorner, Bow, Button, Edge, EdgeRef, EdgeShape, Elastic, Fold, GradeRule, Hem, InternalLine,
    Pattern, Piece, PiecePoint, Piping, PlanePose, RulePoint, Seam, Side, SpacePose, Topstitch, Wrinkle, Zip,
};
use crate::session::{BodyChoice, Command, Dye, Graphic, ImageFile, Repeated, Session, Settings};
use crate::sim::{Runner, Simulation};
use crate::trust::good;
use crate::trust::ticks::go_on;

/// Most commands of a list that are carried out.
const MOST_COMMANDS: usize = 12;

/// Lists of valid commands for the session that [`done`] begins.
pub fn good() -> Vec<Vec<u8>> {
    let project = good::project();
    let mut ids = project.document.pattern.pieces.keys().copied();
    let [front, back] = [(); 2].map(|()| ids.next().unwrap_or_default());
    let seam = project.document.pattern.seams.keys().next().copied().unwrap_or_default();
    let [low, high] = [(0.05, 0.05), (0.2, 0.2)].map(DVec2::from);
    let small = Arc::new(Piece::polygon("pocket", &[low, DVec2::new(0.1, 0.05), DVec2::new(0.1, 0.1)]));
    let moved = good::body().positions.iter().map(|p| *p + DVec3::X * 0.01).collect();
    let mesh = crate::geometry::mesh::TriMesh { positions: moved, triangles: good::body().triangles };
    let body = BodyChoice::Imported { name: "limb".to_owned(), mesh: Arc::new(mesh) };
    let seam_of_part =
        Seam::of_edges([EdgeRef { piece: back, edge: 0 }, EdgeRef { piece: front, edge: 0 }], true);
    let lists = [
        json!([
            Command::AddClothMark { piece: front, side: Default::default(), points: vec![low, high] },
            Command::AddBodyMark { points: vec![DVec3::new(0.0, 0.4, 0.11), DVec3::new(0.05, 0.4, 0.1)] },
            Command::MoveMark { mark: crate::geometry::ids::MarkId(4), to: 1 },
            Command::DeletePair { number: 1 },
        ]),
        json!([
            Command::SetMarks { marks: project.document.marks.clone() },
            Command::Rewrap { pairs: vec![1] }
        ]),
        json!([
            Command::AddPiece { piece: small.clone() },
            Command::SetPiecePose { piece: back, pose: PlanePose { offset: high, ..PlanePose::default() } },
            Command::SetOutline {
                piece: back,
                outline: project.document.pattern.pieces[&back].outline.clone()
            },
            Command::DeletePiece { piece: front },
        ]),
        json!([
            Command::ReverseSeam { seam },
            Command::DeleteSeam { seam },
            Command::AddSeam { seam: seam_of_part }
        ]),
        json!([Command::AimPose { body: body.clone() }, Command::PoseTowards { share: 0.5, draft: true }]),
        json!([Command::Repose { body: body.clone(), settle: true, draft: false }]),
        json!([
            Command::SetBody { body, animations: None },
            Command::SetBones { bones: Some(vec![[DVec3::ZERO, DVec3::Y]]) }
        ]),
        json!([Command::SetSettings { settings: Settings::default() }, Command::StepDraping { ticks: 2 }]),
        json!([
            Command::AddPin { piece: front, at: low },
            Command::MovePin { pin: crate::geometry::ids::PinId(1), piece: back, at: high },
            Command::LockPins { pins: vec![crate::geometry::ids::PinId(1)], locked: true },
        ]),
        json!([Command::SetFabric { piece: Some(front), fabric: Some("wool".to_owned()) }, Command::Sew]),
        json!([
            Command::SetDye { piece: Some(front), dye: good::dye() },
            Command::KeepColourway { name: "red".to_owned() },
            Command::WearColourway { name: "red".to_owned() },
            Command::DeleteColourway { name: "red".to_owned() },
        ]),
        of_images(front, [low, high]),
        json!([Command::ReplacePattern {
            name: "another".to_owned(),
            pattern: Arc::new(Pattern { next_id: 9, ..good::pattern() }),
            marks: Arc::default(),
        }]),
    ];
    let edits = edits([front, back], seam).map(|edits| json!([Command::EditPattern { edits, anew: false }]));
    lists.iter().chain(&edits).map(|list| list.to_string().into_bytes()).collect()
}

/// Commands about an image on `piece`.
fn of_images(piece: PieceId, [low, high]: [DVec2; 2]) -> serde_json::Value {
    let graphic = Graphic { piece, image: ImageId(1), at: low, width_m: 0.05, angle: 0.0, on_twin: true };
    json!([
        Command::AddImage { file: Arc::new(ImageFile::new("logo.png", good::picture())) },
        Command::AddGraphic { graphic },
        Command::SetDye {
            piece: Some(piece),
            dye: Dye {
                image: Some(Repeated { image: ImageId(1), width_m: 0.1, angle: 0.2 }),
                ..Dye::default()
            },
        },
        Command::SetGraphic { id: GraphicId(2), graphic: Graphic { at: high, angle: 0.3, ..graphic } },
        Command::DeleteGraphic { id: GraphicId(2) },
        Command::DeleteImage { image: ImageId(1) },
    ])
}

/// Edits of two pieces and the seam between them.
fn edits([front, back]: [PieceId; 2], seam: SeamId) -> [Vec<PatternEdit>; 7] {
    let [low, high] = [(0.05, 0.05), (0.2, 0.2)].map(DVec2::from);
    let pocket = Piece::polygon("pocket", &[low, DVec2::new(0.1, 0.05), DVec2::new(0.1, 0.1)]);
    let line = InternalLine {
        name: "dart".to_owned(),
        edges: vec![Edge { start: DVec2::new(0.0, 0.1), ..Edge::default() }],
        end: DVec2::new(0.36, 0.12),
        ..InternalLine::default()
    };
    let edge = EdgeRef { piece: back, edge: 2 };
    let curve = EdgeShape::Quadratic { control: DVec2::new(0.18, 0.36) };
    [
        vec![
            PatternEdit::MovePoints {
                points: vec![(PointRef { piece: front, point: 1 }, DVec2::new(0.35, 0.01))],
            },
            PatternEdit::SetEdge { edge, shape: curve },
            PatternEdit::InsertPoint { edge, at: 0.4 },
            PatternEdit::SetSmooth { point: PointRef { piece: back, point: 3 }, smooth: true },
            PatternEdit::DeletePoint { point: PointRef { piece: back, point: 3 } },
        ],
        vec![
            PatternEdit::Scale { pieces: vec![front, back], about: low, factor: DVec2::splat(1.1) },
            PatternEdit::AddDart { edge, at: 0.5, width: 0.02, depth: 0.05 },
            PatternEdit::AddNotch { edge, at: 0.5 },
            PatternEdit::SetAllowance { pieces: vec![back], width: 0.01 },
            PatternEdit::SetCorner {
                point: PointRef { piece: back, point: 0 },
                corner: AllowanceCorner::TurnedUp(Side::After),
            },
        ],
        vec![PatternEdit::Cut { piece: back, line: line.clone(), sew: true }],
        vec![
            PatternEdit::AddLine { piece: front, line: line.clone() },
            PatternEdit::MoveLinePoints {
                points: vec![(LinePoint { piece: front, line: 0, point: 1 }, high)],
            },
            PatternEdit::InsertLinePoint { edge: LinePoint { piece: front, line: 0, point: 0 }, at: 0.4 },
            PatternEdit::SetLineSmooth { point: LinePoint { piece: front, line: 0, point: 1 }, smooth: true },
            PatternEdit::DeleteLinePoint { point: LinePoint { piece: front, line: 0, point: 1 } },
            PatternEdit::AddHole { piece: back, edges: pocket.outline },
            PatternEdit::PlaceInSpace {
                placements: vec![(front, Some(SpacePose::flat(DVec3::Z, Default::default())))],
            },
            PatternEdit::SetRatio { seam, ratio: Some(1.2) },
        ],
        vec![
            PatternEdit::AddTwin { piece: back, offset: high },
            PatternEdit::Duplicate { pieces: vec![front, back], offset: high },
            PatternEdit::MakeSymmetric { piece: back, axis: [DVec2::new(0.18, 0.0), DVec2::new(0.18, 0.3)] },
            PatternEdit::SetLayer { pieces: vec![back], layer: 2 },
        ],
        of_sizes([front, back]),
        trims([front, back], seam, line),
    ]
}

/// Edits of sizes and grade rules.
fn of_sizes([front, back]: [PieceId; 2]) -> Vec<PatternEdit> {
    let ready = READY_SIZES[0].run();
    let rule = GradeRule::even(DVec2::new(0.01, 0.005), ready.len(), ready.base);
    let at = |piece, point| RulePoint { piece, line: None, point };
    vec![
        PatternEdit::SetSizes { sizes: ready },
        PatternEdit::SetRules { rules: vec![(at(front, 1), Some(rule.clone())), (at(back, 2), Some(rule))] },
        PatternEdit::SetRules { rules: vec![(at(front, 1), None)] },
        PatternEdit::SetSizes { sizes: READY_SIZES[1].run() },
    ]
}

/// Edits of what is worked on two pieces and the seam between them.
fn trims([front, back]: [PieceId; 2], seam: SeamId, line: InternalLine) -> Vec<PatternEdit> {
    let lines =
        vec![TrimLine::Line { piece: back, line: 0 }, TrimLine::Edge(EdgeRef { piece: front, edge: 1 })];
    let at = |piece| PiecePoint { piece, at: DVec2::new(0.05, 0.05) };
    let (diameter, colour) = (Button::SHIRT, Button::PEARL);
    let button = Button { button: at(front), hole: at(back), diameter, colour, open: false, tack: false };
    vec![
        PatternEdit::AddLine { piece: back, line },
        PatternEdit::SetFold { lines: lines.clone(), fold: Some(Fold::pressed(2.0)) },
        PatternEdit::SetElastic { lines: lines.clone(), elastic: Some(Elastic { ratio: 0.7, tension: 9.0 }) },
        PatternEdit::SetTopstitch { lines: lines.clone(), topstitch: Some(Topstitch::default()) },
        PatternEdit::SetHem { lines: lines.clone(), hem: Some(Hem { width: 0.02, colour: Some([9; 3]) }) },
        PatternEdit::SetWrinkle { lines: lines[..1].to_vec(), wrinkle: Some(Wrinkle::USUAL) },
        PatternEdit::SetPiping { lines, piping: Some(Piping::USUAL) },
        PatternEdit::AddButtons { buttons: vec![button] },
        PatternEdit::AddBow { at: at(front), bow: Bow::USUAL },
        PatternEdit::SetZip { seam, zip: Some(Zip { open: 0.4, from_end: true, colour }) },
    ]
}

/// Gives the commands in `bytes` to a session with cloth on its body. Asserts that each is carried out or rejected without any
/// change, that the project stays valid, and that everything can be undone.
pub fn done(bytes: &[u8]) -> Result<(), String> {
    let commands: Vec<Command> = serde_json::from_slice(bytes).map_err(|e| readable(&e.to_string()))?;
    let mut session = Session::new(good::project(), Runner::inline(Simulation::default()));
    session.apply_alone(Command::Wrap).map_err(|why| why.to_string())?;
    go_on(&mut session);
    let start = session.document().clone();
    let mut refused = Ok(());
    for command in commands.into_iter().filter(|command| !is_costly(command)).take(MOST_COMMANDS) {
        let before = session.document().clone();
        match session.apply_alone(command) {
            Ok(()) => go_on(&mut session),
            Err(why) => {
                assert!(*session.document() == before, "it was refused, but not without a trace: {why}");
                refused = Err(why.to_string());
            }
        }
        let problem = session.project().problem();
        assert!(problem.is_none(), "after it the work is not sound: {problem:?}");
    }
    while session.undo_label().is_some() && *session.document() != start {
        session.apply_alone(Command::Undo).map_err(|why| why.to_string())?;
    }
    assert!(*session.document() == start, "what was done cannot be taken back");
    refused
}

/// Whether a command builds a mannequin, tries starts, or drops the history.
pub fn is_costly(command: &Command) -> bool {
    match command {
        Command::SetBody { body, .. } | Command::Repose { body, .. } | Command::AimPose { body } => {
            !matches!(body, BodyChoice::Imported { .. })
        }
        Command::ForgetHistory { .. } | Command::Dress { .. } => true,
        _ => false,
    }
}
