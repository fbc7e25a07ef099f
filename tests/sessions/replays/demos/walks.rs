//! The walks: each does one of the program's tasks from its beginning, and what must come of it.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use toile::body::{NamedPose, mannequin};
use toile::draft::{Design, Form, Kind};
use toile::io::garmentcode;
use toile::pattern::edit::{PatternEdit, PointRef};
use toile::pattern::grading::{READY_SIZES, graded};
use toile::pattern::{EdgeRef, GradeRule, Piece, PlanePose, RulePoint, Seam};
use toile::session::samples::{Sample, seal};
use toile::session::{BodyChoice, Command, Dye, Motif, Print, Project};
use toile::sim::StartChoice;
use toile::wrap::{ClothSide, Marks};

use super::stage::Stage;
use crate::common::exact::{quantile, strains};

fn edit(edits: Vec<PatternEdit>) -> Command {
    Command::EditPattern { edits, anew: false }
}

fn laid_at(x: f64, y: f64) -> PlanePose {
    PlanePose { offset: DVec2::new(x, y), ..PlanePose::default() }
}

/// Height of the hem below the waist, half widths at hem and waist, metres.
const SKIRT: [f64; 3] = [0.58, 0.31, 0.225];

pub fn drafting() -> Stage {
    let mut stage = Stage::new(Project::default());
    let [length, hem, waist] = SKIRT;
    let corner = |x: f64, y: f64| DVec2::new(x, y);
    let width = 0.265;
    let corners = [corner(-width, -length), corner(width, -length), corner(width, 0.0), corner(-width, 0.0)];
    let sketch = Piece { pose: laid_at(0.35, -0.05), ..Piece::polygon("front", &corners) };
    stage.give(Command::AddPiece { piece: Arc::new(sketch) });
    let front = stage.piece("front");
    let moved = |point: usize, to: DVec2| (PointRef { piece: front, point }, to);
    stage.give(edit(vec![PatternEdit::MovePoints {
        points: vec![moved(0, corner(-hem, -length)), moved(1, corner(hem, -length))],
    }]));
    stage.give(edit(vec![PatternEdit::MovePoints {
        points: vec![moved(2, corner(waist, 0.01)), moved(3, corner(-waist, 0.01))],
    }]));
    // Along the waist from its right end to its left; the second dart is cut into what the first has left of it.
    for (edge, at) in [(2, 0.25), (5, 0.62)] {
        let edge = EdgeRef { piece: front, edge };
        stage.give(edit(vec![PatternEdit::AddDart { edge, at, width: 0.02, depth: 0.09 }]));
    }
    stage.give(edit(vec![PatternEdit::Duplicate { pieces: vec![front], offset: DVec2::new(0.7, 0.0) }]));
    let pattern = stage.session.document().pattern.clone();
    let back = *pattern.pieces.keys().find(|id| **id != front).expect("a copy");
    stage.give(Command::RenamePiece { piece: back, name: "back".to_owned() });
    let last = pattern.pieces[&front].edge_count() - 1;
    for (ours, theirs) in [(1, last), (last, 1)] {
        let sides = [EdgeRef { piece: front, edge: ours }, EdgeRef { piece: back, edge: theirs }];
        stage.give(Command::AddSeam { seam: Seam::of_edges(sides, false) });
    }
    let y = mannequin::default().landmarks.get("waist_front").expect("a landmark").y;
    for (piece, z) in [(front, 1.0), (back, -1.0)] {
        let points = (0..=8).map(|i| DVec2::new(-0.06 + 0.015 * f64::from(i), 0.0)).collect();
        stage.give(Command::AddClothMark { piece, side: ClothSide::Front, points });
        // From outside, the right of the front is the body's left.
        let points = stage.stroke(&[DVec3::new(-0.06 * z, y, 0.3 * z), DVec3::new(0.06 * z, y, 0.3 * z)]);
        stage.give(Command::AddBodyMark { points });
    }
    stage.wrap_and_drape();
    stage
}

pub fn fitting() -> Stage {
    let mut stage = Stage::dressed(Sample::Trousers);
    let worst = |stage: &Stage| {
        let snapshot = stage.session.snapshot();
        let garment = snapshot.garment.as_ref().expect("dressed");
        quantile(&strains(garment, &snapshot.cloth), 0.99)
    };
    let loose = worst(&stage);
    let usual = toile::body::Measurements::default();
    let measurements = toile::body::Measurements { hip: usual.hip + 0.07, ..usual };
    stage.give(Command::ChangeSize { measurements });
    stage.rest();
    let tight = worst(&stage);
    let pieces: Vec<_> = stage.session.document().pattern.pieces.keys().copied().collect();
    stage.give(edit(vec![PatternEdit::Scale { pieces, about: DVec2::ZERO, factor: DVec2::new(1.06, 1.0) }]));
    stage.rest();
    let let_out = worst(&stage);
    println!("fitting: {loose:.4}, tight {tight:.4}, let out {let_out:.4}");
    assert!(tight > loose + 0.01 && let_out < tight - 0.01);
    stage
}

pub fn drawing() -> Stage {
    let mut stage = Stage::new(Project::default());
    let form = Form::new(&toile::body::Measurements::default(), NamedPose::A).expect("a form");
    let design = Design::drawn(3, 0, &[Kind::Shirt]);
    let bytes = garmentcode::write(&design.drafted(&form)).bytes;
    let pattern = Arc::new(garmentcode::read(&bytes).expect("read"));
    stage.give(Command::ReplacePattern {
        name: "shirt".to_owned(),
        pattern,
        marks: Arc::new(Marks::default()),
    });
    stage.give(Command::Dress { choice: StartChoice::default() });
    stage.rest();
    let started = stage.session.snapshot().started.clone().expect("starts were tried");
    println!("drawing: {started:?}");
    assert!(started.taken().faults.is_empty());
    stage
}

pub fn creature() -> Stage {
    let mut stage = Stage::new(Project::default());
    let body = BodyChoice::Imported { name: "seal".to_owned(), mesh: Arc::new(seal()) };
    stage.give(Command::SetBody { body, animations: None });
    let [long, wide] = [0.34, 0.40];
    let corners = [(-wide, -long), (wide, -long), (wide, long), (-wide, long)].map(|(x, y)| DVec2::new(x, y));
    stage.give(Command::AddPiece {
        piece: Arc::new(Piece { pose: laid_at(0.5, -0.5), ..Piece::polygon("cloak", &corners) }),
    });
    let piece = stage.piece("cloak");
    let points =
        stage.stroke(&[DVec3::new(-0.36, 0.8, 0.0), DVec3::new(0.10, 0.9, 0.0), DVec3::new(0.20, 1.0, 0.0)]);
    // As long on the cloth as on the body.
    let length: f64 = points.windows(2).map(|side| side[0].distance(side[1])).sum();
    assert!(length < 2.0 * long, "{length}");
    let on_cloth = (0..=16).map(|i| DVec2::new(0.0, length * (f64::from(i) / 16.0 - 0.5))).collect();
    stage.give(Command::AddClothMark { piece, side: ClothSide::Front, points: on_cloth });
    stage.give(Command::AddBodyMark { points });
    stage.wrap_and_drape();
    stage
}

pub fn grading() -> Stage {
    let (mut stage, marks) = Stage::bare(Sample::Skirt);
    let run = READY_SIZES[0].run();
    let (count, base) = (run.names.len(), run.base);
    stage.give(edit(vec![PatternEdit::SetSizes { sizes: run }]));
    // A quarter of the girth's step goes to each side, from the side seam inwards; a centimetre of length to the hem.
    for name in ["waistband front", "waistband back", "skirt front", "skirt back"] {
        let piece = stage.piece(name);
        let shape = stage.session.document().pattern.pieces[&piece].clone();
        let rules = (0..shape.edge_count()).map(|point| {
            let at = shape.edge(point).start;
            let widest = (0..shape.edge_count()).map(|i| shape.edge(i).start.x.abs()).fold(0.0, f64::max);
            let low = if name.starts_with("skirt") && at.y < -0.3 { -0.01 } else { 0.0 };
            let step = DVec2::new(0.01 * (at.x / widest), low);
            (RulePoint { piece, line: None, point }, Some(GradeRule::even(step, count, base)))
        });
        stage.give(edit(vec![PatternEdit::SetRules { rules: rules.collect() }]));
    }
    let pattern = stage.session.document().pattern.clone();
    let last = pattern.sizes.names.last().expect("sizes").clone();
    let large = graded(&pattern, &last).expect("the last size");
    assert!(large.problems.is_empty(), "{:?}", large.problems);
    let front = stage.piece("skirt front");
    let grown = large.pattern.pieces[&front].edge_length(0) / pattern.pieces[&front].edge_length(0);
    println!("grading: the hem of {last} is {grown:.3} of the base");
    assert!(grown > 1.05);
    marks.pairs().for_each(|(cloth, body)| stage.paint_pair(cloth, body));
    stage.give(Command::Wrap);
    stage.rest();
    stage
}

pub fn posing() -> Stage {
    let mut stage = Stage::dressed(Sample::Tshirt);
    for pose in [NamedPose::Standing, NamedPose::Walking] {
        let body = stage.session.document().body.in_named_pose(pose).expect("the mannequin");
        stage.give(Command::Repose { body, settle: true, draft: false });
        stage.rest();
    }
    stage
}

pub fn export() -> Stage {
    let (mut stage, marks) = Stage::bare(Sample::Skirt);
    stage.give(Command::SetFabric { piece: None, fabric: Some("wool".to_owned()) });
    stage.give(Command::SetDye { piece: None, dye: Dye { colour: Some([44, 62, 74]), ..Dye::default() } });
    let print = Print { motif: Motif::Checks, repeat_m: 0.08, colour: [214, 196, 160] };
    for name in ["skirt front", "skirt back"] {
        let piece = Some(stage.piece(name));
        stage.give(Command::SetDye { piece, dye: Dye { print: Some(print), ..Dye::default() } });
    }
    marks.pairs().for_each(|(cloth, body)| stage.paint_pair(cloth, body));
    stage.wrap_and_drape();
    let front = stage.piece("skirt front");
    assert_eq!(stage.session.document().fabrics.name(Some(front)), "wool");
    stage
}
