//! What is worked on pieces: folds, elastic, stitches, buttons and zips, through commands, undo, recordings and project files.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use toile::cloth::trims::ClothPoint;
use toile::fit::fastenings::Fastenings;
use toile::fit::{BodyIndex, measure};
use toile::geometry::ids::{ButtonId, PieceId};
use toile::pattern::edit::{PatternEdit, TrimLine};
use toile::pattern::{
    Bow, Button, Edge, EdgeRef, Elastic, Fold, Hem, InternalLine, PiecePoint, Piping, Topstitch, Wrinkle, Zip,
};
use toile::session::project_file::{from_bytes, to_bytes};
use toile::session::recording::Recording;
use toile::session::replay::Replay;
use toile::session::{Command, Session};
use toile::sim::{Runner, Simulation};

use crate::common::{cloth_hash, placed_project, project, run};

const LEFT: PieceId = PieceId(1);
const RIGHT: PieceId = PieceId(2);

fn edit(edit: PatternEdit) -> Command {
    Command::EditPattern { edits: vec![edit], anew: false }
}

/// The two patches draped on top of the ball.
fn draped() -> Session {
    let mut project = project();
    let marks = Arc::make_mut(&mut project.document.marks);
    let top = |x: f64| DVec3::new(x, (0.75f64.powi(2) - x * x).sqrt(), 0.0);
    marks.body[0].points = vec![top(-0.2), top(-0.12), top(-0.05)];
    marks.cloth[0].points = vec![DVec2::new(0.05, 0.15), DVec2::new(0.2, 0.15)];
    project.document.settings.edge_length = 0.03;
    let mut s = Session::new(project, Runner::inline(Simulation::default()));
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(&mut s, 3000);
    s.apply_alone(Command::SetDraping { on: true }).expect("draped");
    run(&mut s, 1100);
    s
}

fn hash_of(s: &mut Session) -> (u64, String) {
    (cloth_hash(s), serde_json::to_string(s.document()).expect("json"))
}

fn again(s: &mut Session) {
    // The recording knows of ticks up to its last command.
    s.apply_alone(Command::SetDraping { on: false }).expect("paused");
    let hash = cloth_hash(s);
    let mut replay = Replay::new(Recording::parse(&s.recording()).expect("a recording"));
    replay.run().expect("the same bits");
    assert_eq!(replay.session().runner().simulation().expect("inline").hash(), hash);
    let project = s.project();
    assert_eq!(from_bytes(&to_bytes(&project).expect("bytes")).expect("a project"), project);
}

#[test]
fn a_fold_on_a_line_is_drawn_set_undone_recorded_and_kept() {
    let mut s = draped();
    let edges = vec![Edge { start: DVec2::new(0.1, 0.0), ..Edge::default() }];
    let line = InternalLine { edges, end: DVec2::new(0.1, 0.3), ..InternalLine::default() };
    s.apply_alone(edit(PatternEdit::AddLine { piece: RIGHT, line })).expect("drawn");
    let before = hash_of(&mut s);
    let fold = |degrees: f64| {
        let fold = Some(Fold::pressed(degrees.to_radians()));
        edit(PatternEdit::SetFold { lines: vec![TrimLine::Line { piece: RIGHT, line: 0 }], fold })
    };
    s.apply_alone(fold(90.0)).expect("folded");
    let creases = |s: &Session| s.snapshot().garment.as_ref().map_or(0, |g| g.trims.folds.len());
    run(&mut s, 5);
    assert_eq!(creases(&s), 10);
    s.apply_alone(Command::Undo).expect("undone");
    s.update();
    assert_eq!(hash_of(&mut s), before);
    s.apply_alone(Command::Redo).expect("done again");
    run(&mut s, 5);
    assert_eq!(creases(&s), 10);
    assert!(s.apply_alone(fold(190.0)).is_err_and(|why| why.0.contains("-180 to 180 degrees")));
    let nothing = TrimLine::Line { piece: RIGHT, line: 3 };
    let none = edit(PatternEdit::SetFold { lines: vec![nothing], fold: None });
    assert!(s.apply_alone(none).is_err_and(|why| why.0.contains("no line 4")));
    s.apply_alone(Command::SetDraping { on: true }).expect("draped");
    run(&mut s, 60);
    again(&mut s);
}

#[test]
fn a_bow_is_added_undone_recorded_and_kept_and_its_tacks_go_with_its_knot() {
    let mut s = draped();
    let before = hash_of(&mut s);
    let at = PiecePoint { piece: RIGHT, at: DVec2::new(0.1, 0.15) };
    let bow = edit(PatternEdit::AddBow { at, bow: Bow::USUAL });
    s.apply_alone(bow.clone()).expect("a bow");
    s.update();
    let count = |s: &Session| {
        let pattern = &s.document().pattern;
        [pattern.pieces.len(), pattern.seams.len(), pattern.buttons.len()]
    };
    assert_eq!(count(&s), [7, 8, 2]);
    s.apply_alone(Command::Undo).expect("undone");
    s.update();
    assert_eq!(hash_of(&mut s), before);
    s.apply_alone(Command::Redo).expect("done again");
    let knot = s.document().pattern.piece_named("bow knot").expect("the knot");
    s.apply_alone(edit(PatternEdit::DeletePieces { pieces: vec![knot] })).expect("deleted");
    assert_eq!(count(&s), [6, 1, 0]);
    s.apply_alone(Command::Undo).expect("undone");
    let far = edit(PatternEdit::AddBow { at: PiecePoint { at: DVec2::splat(9.0), ..at }, bow: Bow::USUAL });
    assert!(s.apply_alone(far).is_err_and(|why| why.0.contains("inside a piece")));
    let wide = edit(PatternEdit::AddBow { at, bow: Bow { width: 3.0, ..Bow::USUAL } });
    assert!(s.apply_alone(wide).is_err_and(|why| why.0.contains("width of the ribbon")));
    s.apply_alone(bow).expect("a second one");
    assert!(s.document().pattern.piece_named("bow knot 2").is_some());
    again(&mut s);
}

#[test]
fn a_seam_can_be_folded_where_it_lies_and_draping_goes_on() {
    let mut s = draped();
    let lying = s.snapshot().cloth.positions.clone();
    let lines = vec![TrimLine::Edge(EdgeRef { piece: LEFT, edge: 1 })];
    let fold = Some(Fold::pressed(-1.0));
    s.apply_alone(edit(PatternEdit::SetFold { lines: lines.clone(), fold })).expect("folded");
    s.update();
    assert_eq!(s.snapshot().cloth.positions, lying, "the mesh and the cloth stay");
    let drape = s.snapshot().drape.expect("draped");
    assert!(drape.on && drape.runs, "{drape:?}");
    assert!(run(&mut s, 1500) > 10);
    assert!(s.snapshot().cloth.positions != lying);
    s.apply_alone(edit(PatternEdit::SetFold { lines, fold: None })).expect("unfolded");
    run(&mut s, 20);
    again(&mut s);
}

/// A tube 1 m round about the upper half of a spindle 75 cm round; how far its top sank when it was draped, metres.
fn sunk(elastic: Option<Elastic>) -> f64 {
    let mut project = placed_project(0.5, 0.5);
    project.document.settings.edge_length = 0.05;
    let pattern = Arc::make_mut(&mut project.document.pattern);
    for id in [LEFT, RIGHT] {
        let piece = Arc::make_mut(pattern.pieces.get_mut(&id).expect("a piece"));
        piece.outline[2].trims.elastic = elastic;
    }
    let mut s = Session::new(project, Runner::inline(Simulation::default()));
    s.apply_alone(Command::Sew).expect("sewn");
    run(&mut s, 900);
    let snapshot = s.snapshot();
    let garment = snapshot.garment.as_ref().expect("a garment");
    let top = garment.corners.iter().filter(|c| c.uv.y > 0.199);
    let heights = top.map(|c| snapshot.cloth.positions[c.vertex as usize].y);
    0.11 - heights.fold(f64::MAX, f64::min)
}

#[test]
fn a_waistband_holds_a_skirt_up() {
    let held = sunk(Some(Elastic { ratio: 0.7, tension: Elastic::WAISTBAND }));
    let fallen = sunk(None);
    assert!(held < 0.06, "it sank by {held} m");
    assert!(fallen > 0.2, "without it by {fallen} m");
}

#[test]
fn elastic_is_undone_recorded_and_kept() {
    let mut s = draped();
    let before = hash_of(&mut s);
    let set = |ratio: f64| {
        let elastic = Some(Elastic { ratio, tension: 20.0 });
        let lines = vec![TrimLine::Edge(EdgeRef { piece: LEFT, edge: 2 })];
        edit(PatternEdit::SetElastic { lines, elastic })
    };
    assert!(s.apply_alone(set(0.2)).is_err_and(|why| why.0.contains("0.3 to 1")));
    s.apply_alone(set(0.5)).expect("sewn on");
    assert!(run(&mut s, 1500) > 10);
    s.apply_alone(Command::Undo).expect("undone");
    s.update();
    assert_eq!(hash_of(&mut s), before);
    s.apply_alone(Command::Redo).expect("done again");
    run(&mut s, 20);
    again(&mut s);
}

/// A front and a back about a spindle, as sewing begins, the second on this layer. They are sewn along one side, and buttoned along the
/// other, where they overlap by 3 cm.
fn wrap_skirt(layer: u8) -> Session {
    let mut project = placed_project(0.4, 0.4);
    project.document.settings.edge_length = 0.02;
    let pattern = Arc::make_mut(&mut project.document.pattern);
    pattern.seams.pop_last();
    Arc::make_mut(pattern.pieces.get_mut(&RIGHT).expect("a piece")).layer = layer;
    let mut s = Session::new(project, Runner::inline(Simulation::default()));
    let at = |piece, x: f64, y: f64| PiecePoint { piece, at: DVec2::new(x, y) };
    let button = |y: f64| Button {
        button: at(LEFT, 0.015, y),
        hole: at(RIGHT, 0.385, y),
        diameter: 0.015,
        colour: Button::PEARL,
        open: false,
        tack: false,
    };
    let buttons = [0.03, 0.1, 0.17].map(button).to_vec();
    s.apply_alone(edit(PatternEdit::AddButtons { buttons })).expect("sewn on");
    s.apply_alone(Command::Sew).expect("sewn");
    s.update();
    s
}

fn fastened(s: &Session) -> Fastenings {
    let snapshot = s.snapshot();
    let (garment, cloth) = snapshot.drawn().expect("a garment");
    let body = snapshot.body.as_ref().expect("a body");
    let report = measure(&s.document().pattern, garment, cloth, &BodyIndex::new(body));
    assert_eq!(report.self_crossings, 0);
    report.fastenings
}

/// Largest distance of the two places of all buttons, open ones too.
fn gap(s: &Session) -> f64 {
    let snapshot = s.snapshot();
    let garment = snapshot.garment.as_ref().expect("a garment");
    let place = |point| {
        let point = ClothPoint::new(garment, point).expect("on the cloth");
        point.place(garment, &snapshot.cloth).expect("laid")
    };
    let buttons = s.document().pattern.buttons.values();
    buttons.map(|b| place(b.button).distance(place(b.hole))).fold(0.0, f64::max)
}

#[test]
fn buttons_hold_let_go_and_are_fastened_again() {
    let mut s = wrap_skirt(0);
    run(&mut s, 2000);
    let all: Vec<ButtonId> = s.document().pattern.buttons.keys().copied().collect();
    let fasten = |fastened| edit(PatternEdit::Fasten { buttons: all.clone(), fastened });
    assert!(gap(&s) <= 0.001, "{}", gap(&s));
    let told = fastened(&s);
    assert_eq!((told.count, told.open, told.apart, told.not_closed()), (3, 0, 0, 0));
    let before = hash_of(&mut s);
    s.apply_alone(fasten(false)).expect("unfastened");
    assert!(run(&mut s, 2000) > 10, "the cloth goes on by itself");
    assert!(gap(&s) > 0.01, "{}", gap(&s));
    assert!(
        s.snapshot().drape.is_some_and(|drape| !drape.runs && drape.restless),
        "it slid off and still falls"
    );
    assert_eq!(fastened(&s).open, 3);
    s.apply_alone(Command::Undo).expect("undone");
    s.update();
    assert_eq!(hash_of(&mut s), before);
    s.apply_alone(Command::Redo).expect("done again");
    run(&mut s, 2000);
    s.apply_alone(fasten(true)).expect("fastened");
    run(&mut s, 2000);
    assert!(gap(&s) <= 0.001, "{}", gap(&s));
    assert_eq!(fastened(&s).not_closed(), 0);
    again(&mut s);
}

/// Half a garment would slide off, and its open edges would come to lie in any order.
#[test]
fn a_layer_that_is_sewn_on_comes_before_the_weight_does() {
    let mut s = wrap_skirt(1);
    let is_laid = |s: &Session| s.snapshot().cloth.mapped.iter().all(|mapped| *mapped);
    assert!(!is_laid(&s), "the outer layer waits");
    while s.snapshot().drape.is_none() {
        assert!(run(&mut s, 1) > 0, "it ended before it was draped");
    }
    assert!(is_laid(&s));
    run(&mut s, 2000);
    assert_eq!(fastened(&s).not_closed(), 0);
}

#[test]
fn a_zip_opens_from_one_end_and_closes() {
    let mut project = placed_project(0.37, 0.35);
    project.document.settings.edge_length = 0.03;
    let mut s = Session::new(project, Runner::inline(Simulation::default()));
    s.apply_alone(Command::Sew).expect("sewn");
    run(&mut s, 2000);
    let seam = *s.document().pattern.seams.keys().last().expect("a seam");
    let zip = |open: f64| {
        let zip = Some(Zip { open, from_end: false, colour: Zip::BRASS });
        edit(PatternEdit::SetZip { seam, zip })
    };
    let pairs = |s: &Session| {
        let garment = s.snapshot().garment.clone().expect("a garment");
        garment.seam_pairs.iter().filter(|(id, _)| *id == seam).map(|(_, pairs)| pairs.len()).sum::<usize>()
    };
    let whole = pairs(&s);
    let lying = s.snapshot().cloth.clone();
    s.apply_alone(zip(0.0)).expect("put in");
    s.update();
    assert_eq!((pairs(&s), &s.snapshot().cloth), (whole, &lying), "closed it is a seam");
    s.apply_alone(zip(0.6)).expect("opened");
    assert!(run(&mut s, 2000) > 10, "the cloth goes on by itself");
    assert!(pairs(&s) < whole && pairs(&s) > 2);
    assert_eq!(fastened(&s).open, 1);
    let snapshot = s.snapshot();
    let garment = snapshot.garment.as_ref().expect("a garment");
    let side = s.document().pattern.seams[&seam];
    let end = |k: usize, at: f64| {
        let piece = &s.document().pattern.pieces[&side.sides[k].piece];
        let point =
            PiecePoint { piece: side.sides[k].piece, at: piece.edge_points(side.sides[k].edge, &[at])[0] };
        ClothPoint::new(garment, point).expect("on the cloth").place(garment, &snapshot.cloth).expect("laid")
    };
    assert!(end(0, 0.0).distance(end(1, 1.0)) > 0.002, "{}", end(0, 0.0).distance(end(1, 1.0)));
    assert!(end(0, 0.95).distance(end(1, 0.05)) < 1e-6);
    s.apply_alone(zip(1.0)).expect("wide open");
    run(&mut s, 5);
    assert_eq!((pairs(&s), fastened(&s).open), (0, 1));
    s.apply_alone(zip(0.0)).expect("closed");
    run(&mut s, 2000);
    assert_eq!((pairs(&s), fastened(&s).not_closed()), (whole, 0));
    assert!(s.apply_alone(zip(1.5)).is_err_and(|why| why.0.contains("0 to 1")));
    again(&mut s);
}

#[test]
fn stitches_and_colours_leave_the_cloth_at_rest_and_hems_do_not() {
    let mut s = draped();
    let lines = vec![TrimLine::Edge(EdgeRef { piece: LEFT, edge: 0 })];
    let topstitch = |rows: u8| {
        let topstitch = Some(Topstitch { rows, colour: [200, 30, 30], ..Topstitch::default() });
        edit(PatternEdit::SetTopstitch { lines: lines.clone(), topstitch })
    };
    let before = cloth_hash(&mut s);
    s.apply_alone(topstitch(2)).expect("stitched");
    s.update();
    assert_eq!((cloth_hash(&mut s), run(&mut s, 50)), (before, 0));
    assert!(s.apply_alone(topstitch(9)).is_err_and(|why| why.0.contains("rows")));
    let hem = |width: f64| {
        edit(PatternEdit::SetHem { lines: lines.clone(), hem: Some(Hem { width, colour: None }) })
    };
    assert!(s.apply_alone(hem(0.5)).is_err_and(|why| why.0.contains("hem")));
    s.apply_alone(hem(0.04)).expect("hemmed");
    assert!(run(&mut s, 50) > 0, "it is stiffer now");
    assert!(s.apply_alone(Command::Undo).is_ok());
    s.update();
    assert_eq!(cloth_hash(&mut s), before);
    assert!(s.apply_alone(Command::Redo).is_ok());
    again(&mut s);
}

#[test]
fn piping_is_stiff_undone_recorded_and_kept_and_dyed_at_rest() {
    let mut s = draped();
    let lines = vec![TrimLine::Edge(EdgeRef { piece: LEFT, edge: 1 })];
    let pipe = |radius: f64, colour: [u8; 3]| {
        let piping = Some(Piping { radius, colour });
        edit(PatternEdit::SetPiping { lines: lines.clone(), piping })
    };
    let before = hash_of(&mut s);
    assert!(s.apply_alone(pipe(0.02, [9; 3])).is_err_and(|why| why.0.contains("radius of piping")));
    assert_eq!(hash_of(&mut s), before);
    let lying = s.snapshot().cloth.positions.clone();
    s.apply_alone(pipe(0.003, [9; 3])).expect("sewn in");
    s.update();
    assert_eq!(s.undo_label(), Some("sew piping in"));
    assert_eq!(s.snapshot().cloth.positions, lying, "the mesh and the cloth stay");
    let radii = |s: &Session| -> Vec<f64> {
        let garment = s.snapshot().garment.clone().expect("a garment");
        garment.trims.piped.iter().map(|along| along.what).collect()
    };
    assert_eq!(radii(&s), [0.003; 10], "the edge is 0.3 m long");
    assert!(run(&mut s, 50) > 0, "it is stiffer and heavier now");
    let (stiff, garment) = (cloth_hash(&mut s), s.snapshot().garment.clone().expect("a garment"));
    s.apply_alone(pipe(0.003, [200, 0, 0])).expect("dyed");
    s.update();
    assert_eq!(cloth_hash(&mut s), stiff, "a colour moves nothing");
    let dyed = s.snapshot().garment.clone().expect("a garment");
    assert!(Arc::ptr_eq(&dyed, &garment), "and needs no new garment");
    s.apply_alone(edit(PatternEdit::SetPiping { lines: lines.clone(), piping: None })).expect("taken out");
    s.update();
    assert_eq!((s.undo_label(), radii(&s).len()), (Some("take piping out"), 0));
    for _ in 0..3 {
        s.apply_alone(Command::Undo).expect("undone");
    }
    s.update();
    assert_eq!(hash_of(&mut s), before);
    for _ in 0..2 {
        s.apply_alone(Command::Redo).expect("done again");
    }
    run(&mut s, 20);
    let piping = s.document().pattern.pieces[&LEFT].edge(1).trims.piping;
    assert_eq!(piping, Some(Piping { radius: 0.003, colour: [200, 0, 0] }));
    again(&mut s);
}

#[test]
fn a_wrinkle_is_set_changed_undone_recorded_and_kept() {
    let mut s = draped();
    let edges = vec![Edge { start: DVec2::new(0.1, 0.0), ..Edge::default() }];
    let line = InternalLine { edges, end: DVec2::new(0.1, 0.3), ..InternalLine::default() };
    s.apply_alone(edit(PatternEdit::AddLine { piece: RIGHT, line })).expect("drawn");
    let before = hash_of(&mut s);
    let lines = vec![TrimLine::Line { piece: RIGHT, line: 0 }];
    let wrinkle = |width: f64, height: f64| {
        let wrinkle = Some(Wrinkle { width, height });
        edit(PatternEdit::SetWrinkle { lines: lines.clone(), wrinkle })
    };
    for (bad, words) in [
        (wrinkle(0.2, 0.01), "the width of a wrinkle (m) is 0.005 to 0.1, not 0.2"),
        (
            wrinkle(0.04, 0.03),
            "the height of a wrinkle (m), at most half its width, is -0.02 to 0.02, not 0.03",
        ),
    ] {
        assert!(s.apply_alone(bad).is_err_and(|why| why.0.contains(words)), "{words}");
    }
    let on_an_edge = vec![TrimLine::Edge(EdgeRef { piece: LEFT, edge: 1 })];
    let set = PatternEdit::SetWrinkle { lines: on_an_edge, wrinkle: Some(Wrinkle::USUAL) };
    assert!(s.apply_alone(edit(set)).is_err_and(|why| why.0.contains("not along an edge")));
    assert_eq!(hash_of(&mut s), before);
    let bent = |s: &Session| s.snapshot().garment.as_ref().map_or(0, |g| g.trims.wrinkles.len());
    s.apply_alone(wrinkle(0.04, 0.008)).expect("set");
    assert_eq!(s.undo_label(), Some("set a wrinkle"));
    run(&mut s, 20);
    let edges = bent(&s);
    assert!(edges > 100, "{edges}");
    let lying = s.snapshot().cloth.positions.clone();
    s.apply_alone(wrinkle(0.04, -0.008)).expect("changed");
    s.update();
    assert_eq!((s.snapshot().cloth.positions.len(), bent(&s)), (lying.len(), edges), "the mesh stays");
    run(&mut s, 20);
    for _ in 0..2 {
        s.apply_alone(Command::Undo).expect("undone");
    }
    s.update();
    assert_eq!(hash_of(&mut s), before);
    for _ in 0..2 {
        s.apply_alone(Command::Redo).expect("done again");
    }
    run(&mut s, 20);
    let kept = s.document().pattern.pieces[&RIGHT].lines[0].edges[0].trims.wrinkle;
    assert_eq!((kept, bent(&s)), (Some(Wrinkle { width: 0.04, height: -0.008 }), edges));
    again(&mut s);
}
