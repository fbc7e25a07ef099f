//! The walks: each does one of the program's tasks from its beginning, and what must come of it.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use toile::body::{NamedPose, mannequin};
use toile::draft::{Design, Form, Kind};
use toile::geometry::ids::PieceId;
use toile::geometry::polygon;
use toile::io::{allowance_line, garmentcode};
use toile::pattern::edit::{PatternEdit, PointRef, TrimLine};
use toile::pattern::grading::{READY_SIZES, graded};
use toile::pattern::{
    AllowanceCorner, EdgeRef, GradeRule, Hem, Pattern, Piece, PlanePose, RulePoint, Seam, Side, Topstitch,
};
use toile::session::samples::{Sample, seal};
use toile::session::{BodyChoice, Command, Dye, Graphic, ImageFile, Motif, Print, Project};
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

/// Mesh size of the jacket, metres: coarser than usual, so that it comes to rest sooner.
const MESH: f64 = 0.03;

/// By what share of its side seams the coat becomes a jacket, and where its grainlines begin then, metres.
const SHORTER: [f64; 2] = [0.45, -0.3];

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

/// The edges of a piece that have this label.
fn labelled(stage: &Stage, piece: PieceId, label: &str) -> Vec<EdgeRef> {
    let shape = &stage.session.document().pattern.pieces[&piece];
    let is_named = |&edge: &usize| shape.edge(edge).label.as_deref() == Some(label);
    (0..shape.edge_count()).filter(is_named).map(|edge| EdgeRef { piece, edge }).collect()
}

/// The edges with one of these labels, of all pieces.
fn all_labelled(pattern: &Pattern, labels: &[&str]) -> Vec<TrimLine> {
    let edges = pattern.pieces.iter().flat_map(|(&piece, shape)| {
        let is_meant = |&edge: &usize| shape.edge(edge).label.as_deref().is_some_and(|l| labels.contains(&l));
        (0..shape.edge_count()).filter(is_meant).map(move |edge| EdgeRef { piece, edge })
    });
    edges.map(TrimLine::Edge).collect()
}

/// Makes a jacket of the coat.
fn shortened(stage: &Stage, pattern: &Pattern) -> Vec<PatternEdit> {
    let mut points = Vec::new();
    let mut grainlines = Vec::new();
    // Lower and upper ends of the side seams. Point 0 of each piece is the end of its hem in the middle of the body.
    let bodies: [(&str, &[[usize; 2]]); 3] =
        [("front left", &[[1, 2]]), ("front right", &[[6, 5]]), ("back", &[[1, 2], [9, 8]])];
    for (name, sides) in bodies {
        let piece = stage.piece(name);
        let shape = &pattern.pieces[&piece];
        let mut level = 0.0;
        for &[low, high] in sides {
            let [low_end, high_end] = [low, high].map(|point| shape.edge(point).start);
            let to = low_end + (high_end - low_end) * SHORTER[0];
            level = to.y;
            points.push((PointRef { piece, point: low }, to));
        }
        points.push((PointRef { piece, point: 0 }, DVec2::new(shape.edge(0).start.x, level)));
        let [tail, head] = shape.grainline.expect("a grainline");
        let grainline = Some([DVec2::new(tail.x, SHORTER[1]), head]);
        grainlines.push(PatternEdit::SetGrainline { piece, grainline });
    }
    std::iter::once(PatternEdit::MovePoints { points }).chain(grainlines).collect()
}

pub fn finishing() -> Stage {
    let mut project = Sample::Coat.project(&mannequin::default());
    project.document.settings.edge_length = MESH;
    let pattern = Arc::make_mut(&mut project.document.pattern);
    let buttons: Vec<_> = std::mem::take(&mut pattern.buttons).into_values().collect();
    let pattern = Arc::clone(&project.document.pattern);
    let mut stage = Stage::new(project);
    stage.give(edit(shortened(&stage, &pattern)));
    stage.give(edit(vec![PatternEdit::AddButtons { buttons: buttons.clone() }]));
    let edges = all_labelled(
        &pattern,
        &[
            "front edge left",
            "front edge right",
            "stand left",
            "stand right",
            "centre left",
            "centre right",
            "collar edge left",
            "collar edge right",
        ],
    );
    let hems = all_labelled(&pattern, &["hem left", "hem right", "sleeve hem"]);
    assert_eq!((edges.len(), hems.len()), (10, 8));
    let colour = [248, 240, 222];
    let topstitch = Topstitch { distance: 0.01, length: 0.006, rows: 2, spacing: 0.008, colour };
    stage.give(edit(vec![PatternEdit::SetTopstitch { lines: edges, topstitch: Some(topstitch) }]));
    let hem = Hem { width: 0.04, colour: Some(colour) };
    stage.give(edit(vec![PatternEdit::SetHem { lines: hems, hem: Some(hem) }]));
    stage.give(Command::Sew);
    stage.rest();
    let gaps = buttons.iter().map(|button| {
        let [own, hole] = [button.button, button.hole].map(|end| stage.place((end.piece, end.at)));
        own.distance(hole)
    });
    let gap = gaps.fold(0.0, f64::max);
    println!("finishing: {} buttons, the widest gap {gap:.4} m", buttons.len());
    assert!(buttons.len() > 3 && gap < 0.006, "{gap}");
    stage
}

pub fn colourways() -> Stage {
    let mut stage = Stage::new(Sample::Tshirt.project(&mannequin::default()));
    stage.give(Command::SetFabric { piece: None, fabric: Some("jersey".to_owned()) });
    stage.wrap_and_drape();
    let sleeves = ["sleeve left", "sleeve right"].map(|name| stage.piece(name));
    let coloured = |stage: &mut Stage, colour: [u8; 3], stripes: [u8; 3]| {
        stage.give(Command::SetDye { piece: None, dye: Dye { colour: Some(colour), ..Dye::default() } });
        let print = Some(Print { motif: Motif::Hoops, repeat_m: 0.03, colour: stripes });
        for piece in sleeves {
            stage.give(Command::SetDye { piece: Some(piece), dye: Dye { print, ..Dye::default() } });
        }
    };
    coloured(&mut stage, [238, 231, 214], [176, 58, 52]);
    let picture = include_bytes!("../../../../assets/install/icons/toile-256.png");
    stage.give(Command::AddImage { file: Arc::new(ImageFile::new("toile.png", picture.to_vec())) });
    let image = *stage.session.document().artwork.images.keys().next().expect("an image");
    let (piece, at) = (stage.piece("front"), DVec2::new(0.0, -0.03));
    let graphic = Graphic { piece, image, at, width_m: 0.17, angle: 0.0, on_twin: false };
    stage.give(Command::AddGraphic { graphic });
    stage.give(Command::KeepColourway { name: "Day".to_owned() });
    let day = stage.session.document().dyes.clone();
    coloured(&mut stage, [40, 52, 78], [222, 186, 96]);
    stage.give(Command::KeepColourway { name: "Night".to_owned() });
    assert!(stage.session.document().dyes != day);
    stage.give(Command::WearColourway { name: "Day".to_owned() });
    let document = stage.session.document();
    assert!(document.dyes == day && document.colourways.len() == 2 && document.artwork.graphics.len() == 1);
    stage
}

pub fn cutting() -> Stage {
    let mut stage = Stage::new(Sample::Dress.project(&mannequin::default()));
    stage.give(Command::SetFabric { piece: None, fabric: Some("satin".to_owned()) });
    let print = Print { motif: Motif::Stripes, repeat_m: 0.045, colour: [46, 84, 112] };
    let dye = Dye { colour: Some([232, 224, 206]), print: Some(print), ..Dye::default() };
    stage.give(Command::SetDye { piece: None, dye });
    stage.give(Command::Wrap);
    stage.rest();
    let pieces: Vec<_> = stage.session.document().pattern.pieces.keys().copied().collect();
    let area = |stage: &Stage| {
        let cut = |piece: &Arc<Piece>| polygon::signed_area(&allowance_line(piece, 1e-4)).abs();
        stage.session.document().pattern.pieces.values().map(cut).sum::<f64>()
    };
    let small = area(&stage);
    stage.give(edit(vec![PatternEdit::SetAllowance { pieces, width: 0.015 }]));
    assert!(area(&stage) > 1.01 * small, "the cutting lines are farther out");
    let skirts = ["skirt front", "skirt back"].map(|name| stage.piece(name));
    let turned_up = skirts.iter().flat_map(|&piece| {
        // The hem runs from point 0 to point 1.
        [(0, Side::After), (1, Side::Before)].map(|(point, side)| PatternEdit::SetCorner {
            point: PointRef { piece, point },
            corner: AllowanceCorner::TurnedUp(side),
        })
    });
    stage.give(edit(turned_up.collect()));
    for [ours, theirs] in [["side lower right", "side lower left"], ["side lower left", "side lower right"]] {
        let sides = [(skirts[0], ours), (skirts[1], theirs)];
        let notches = sides
            .map(|(piece, label)| PatternEdit::AddNotch { edge: labelled(&stage, piece, label)[0], at: 0.5 });
        stage.give(edit(notches.to_vec()));
    }
    let (middle, along) = (DVec2::new(0.0, -0.294), DVec2::splat(0.127));
    for piece in skirts {
        let grainline = Some([middle - along, middle + along]);
        stage.give(edit(vec![PatternEdit::SetGrainline { piece, grainline }]));
    }
    stage.give(Command::SetDraping { on: true });
    stage.rest();
    let grain = stage.session.document().pattern.pieces[&skirts[0]].grain();
    assert!((grain.x - grain.y).abs() < 1e-9, "on the bias: {grain}");
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
