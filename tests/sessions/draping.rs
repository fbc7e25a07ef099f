//! Physics on the dressed garment, and garments sewn from placed pieces.

use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};
use toile::body::mannequin::{Measurements, mannequin};
use toile::card::CardSlot;
use toile::cloth::{Corner, Fabric};
use toile::drag::{DragMode, Ray};
use toile::fit::{BodyIndex, Report, measure};
use toile::geometry::crossings::{meetings, self_crossings};
use toile::geometry::ids::{PieceId, PinId};
use toile::geometry::mesh::TriMesh;
use toile::geometry::shapes::cylinder;
use toile::pattern::{EdgeRef, Seam, SpacePose};
use toile::session::recording::Recording;
use toile::session::replay::Replay;
use toile::session::samples::Sample;
use toile::session::{BodyChoice, Command, Notice, Session, Settings};
use toile::sim::{DrapeState, Runner, Simulation, Start, StartChoice, faults};
use toile::wrap::Phase;

use crate::common::{ball, cloth_hash, project, run, session, tube_project};

const LEFT: PieceId = PieceId(1);
const RIGHT: PieceId = PieceId(2);

/// The two patches on top of the ball.
fn on_top() -> Session {
    let mut project = project();
    let marks = Arc::make_mut(&mut project.document.marks);
    let top = |x: f64| DVec3::new(x, (0.75f64.powi(2) - x * x).sqrt(), 0.0);
    marks.body[0].points = vec![top(-0.2), top(-0.12), top(-0.05)];
    marks.cloth[0].points = vec![DVec2::new(0.05, 0.15), DVec2::new(0.2, 0.15)];
    project.document.settings.edge_length = 0.03;
    let mut s = Session::new(project, Runner::inline(Simulation::default()));
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(&mut s, 3000);
    assert_eq!(s.snapshot().phase, Some(Phase::AtRest));
    s
}

fn drape(s: &Session) -> DrapeState {
    s.snapshot().drape.expect("draped")
}

fn measured(s: &Session) -> Report {
    let snapshot = s.snapshot();
    let (garment, cloth) = snapshot.drawn().expect("a garment");
    let body = snapshot.body.as_ref().expect("a body");
    let source = snapshot.source.as_ref().expect("a pattern");
    measure(&source.pattern, garment, cloth, &BodyIndex::new(body))
}

fn mean_height(s: &Session) -> f64 {
    let positions = &s.snapshot().cloth.positions;
    positions.iter().map(|p| p.y).sum::<f64>() / positions.len() as f64
}

/// Whether the cloth is said to have slid down.
fn is_told_to_slide(s: &Session) -> bool {
    let snapshot = s.snapshot();
    let (garment, cloth) = snapshot.drawn().expect("a garment");
    let body = snapshot.body.as_ref().expect("a body");
    let source = snapshot.source.as_ref().expect("a pattern");
    let found = faults(&measured(s), source, garment, cloth, &BodyIndex::new(body), snapshot.lies());
    found.iter().any(|fault| fault.problem.words.contains("slid down"))
}

#[test]
fn wrapped_cloth_that_slides_down_when_it_is_draped_is_told() {
    let mut s = session();
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(&mut s, 3000);
    let before = mean_height(&s);
    s.apply_alone(Command::SetDraping { on: true }).expect("draped");
    run(&mut s, 2);
    assert!(!is_told_to_slide(&s), "it hangs on the side of the ball");
    run(&mut s, 40);
    assert!(mean_height(&s) < before - 0.25, "{} of {before}", mean_height(&s));
    assert!(is_told_to_slide(&s));
    run(&mut s, 1200);
    let fallen = drape(&s);
    assert!(!fallen.runs && fallen.restless && fallen.ticks < 400, "it is left where it falls: {fallen:?}");
}

#[test]
fn draped_cloth_that_was_opened_again_stays_as_it_lies_when_a_pin_is_taken_out() {
    let mut s = on_top();
    s.apply_alone(Command::SetDraping { on: true }).expect("draped");
    run(&mut s, 1500);
    let mut again = Session::new(s.project(), Runner::inline(Simulation::default()));
    again.update();
    let lying = again.snapshot().cloth.positions.clone();
    again.apply_alone(Command::AddPin { piece: LEFT, at: DVec2::new(0.05, 0.1) }).expect("pinned");
    run(&mut again, 30);
    again.apply_alone(Command::DeletePin { pin: PinId(1) }).expect("pulled out");
    run(&mut again, 30);
    assert_eq!(again.snapshot().cloth.positions, lying, "relaxed without weight it would creep");
}

#[test]
fn cloth_drapes_to_rest_and_costs_nothing_then() {
    let mut s = on_top();
    let (before, high) = (cloth_hash(&mut s), mean_height(&s));
    s.apply_alone(Command::SetDraping { on: true }).expect("draped");
    let ticks = run(&mut s, 1100);
    assert!((10..1100).contains(&ticks), "{ticks} ticks");
    let state = drape(&s);
    assert!(state.on && !state.runs && state.residual < 0.01 && state.speed < 0.02, "{state:?}");
    assert_eq!(run(&mut s, 600), 0, "asleep");
    assert!(mean_height(&s) < high - 0.001, "it came down on the skin");
    let report = measured(&s);
    assert_eq!(report.penetration.vertices + report.penetration.faces, 0);
    assert_eq!(report.edges_through_body + report.self_crossings, 0);
    assert!(report.strain.p99 < 0.012, "strain {}", report.strain.p99);
    // Paper B, Figure 10.
    for piece in &report.pieces {
        assert!(piece.area_change.abs() <= 0.0144 && piece.perimeter_change.abs() <= 0.0087, "{piece:?}");
    }
    // Friction holds it: it has not slid off.
    assert!(s.snapshot().cloth.positions.iter().all(|p| p.y > 0.6));
    assert_eq!(s.undo_label(), Some("drape"));
    let draped = cloth_hash(&mut s);
    s.apply_alone(Command::Undo).expect("undone");
    assert_eq!(cloth_hash(&mut s), before, "the whole run is one step");
    s.apply_alone(Command::Redo).expect("done again");
    run(&mut s, 1100);
    assert_eq!(cloth_hash(&mut s), draped);
}

/// On software that stands in for a graphics card; without an adapter the test says so and passes.
#[test]
fn cloth_drapes_on_a_card_as_on_the_processor_and_tells_no_hash() {
    let slot = CardSlot::new(true, 0);
    if let Err(why) = slot.look() {
        assert!(std::env::var_os("TOILE_REQUIRE_ADAPTER").is_none(), "{why}");
        return println!("skipped: {why}");
    }
    let [mut plain, mut s] = [on_top(), on_top()];
    let before = cloth_hash(&mut s);
    let lines = |s: &mut Session| s.recording().lines().filter(|line| line.contains("\"cloth\"")).count();
    s.use_card(Some(Arc::new(slot)));
    for session in [&mut plain, &mut s] {
        session.apply_alone(Command::SetDraping { on: true }).expect("draped");
    }
    let hashes = lines(&mut s);
    for session in [&mut plain, &mut s] {
        let ticks = run(session, 1100);
        assert!((10..1100).contains(&ticks), "{ticks} ticks");
    }
    assert!(drape(&s).card && !drape(&plain).card);
    assert_eq!(lines(&mut s), hashes, "what a card has moved has no hash");
    assert!((mean_height(&s) - mean_height(&plain)).abs() < 0.001);
    let report = measured(&s);
    assert_eq!(report.penetration.vertices + report.penetration.faces, 0);
    assert_eq!(report.edges_through_body + report.self_crossings, 0);
    assert!(report.strain.p99 < 0.012, "strain {}", report.strain.p99);
    s.apply_alone(Command::Undo).expect("undone");
    assert_eq!(cloth_hash(&mut s), before);
    // Commands of the recording can be done again by the processor.
    let text = s.recording();
    let mut replay = Replay::new(Recording::parse(&text).expect("a recording"));
    replay.run().expect("no divergence");
}

#[test]
fn a_recorded_drape_has_the_same_bits_on_any_number_of_threads() {
    let mut s = on_top();
    s.apply_alone(Command::SetFabric { piece: Some(LEFT), fabric: Some("denim-11oz".to_owned()) })
        .expect("chosen");
    s.apply_alone(Command::SetDraping { on: true }).expect("draped");
    run(&mut s, 40);
    s.apply_alone(Command::Grab { piece: RIGHT, at: DVec2::new(0.2, 0.1), mode: DragMode::Surface })
        .expect("taken");
    let ray = Ray { origin: DVec3::new(0.3, 1.2, 1.0), direction: DVec3::new(0.0, -0.3, -1.0) };
    s.apply_alone(Command::DragTo { ray }).expect("pulled");
    run(&mut s, 30);
    s.apply_alone(Command::Release).expect("let go");
    run(&mut s, 150);
    // The recording knows of ticks up to its last command.
    s.apply_alone(Command::SetDraping { on: false }).expect("paused");
    let hash = cloth_hash(&mut s);
    let text = s.recording();
    for workers in [1, 2, 8] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(workers).build().expect("workers");
        let replayed = pool.install(|| {
            let mut replay = Replay::new(Recording::parse(&text).expect("a recording"));
            replay.run().expect("the same bits");
            replay.session().runner().simulation().expect("inline").hash()
        });
        assert_eq!(replayed, hash, "{workers} workers");
    }
}

#[test]
fn a_run_is_paused_goes_on_and_is_made_by_steps() {
    let mut s = on_top();
    s.apply_alone(Command::SetDraping { on: true }).expect("draped");
    run(&mut s, 5);
    let steps = s.step_labels().count();
    s.apply_alone(Command::SetDraping { on: false }).expect("paused");
    assert_eq!(run(&mut s, 5), 0);
    assert_eq!(s.step_labels().count(), steps, "pausing is no step");
    s.apply_alone(Command::StepDraping { ticks: 3 }).expect("stepped");
    assert_eq!(run(&mut s, 10), 3);
    assert!(s.apply_alone(Command::StepDraping { ticks: 0 }).is_err());
    s.apply_alone(Command::SetDraping { on: true }).expect("draped");
    assert!(run(&mut s, 1100) > 5);
    assert!(!drape(&s).runs);
}

/// The two patches on the front of the ball, held by three pins.
fn hung_by_pins() -> Session {
    let mut s = Session::new(project(), Runner::inline(Simulation::default()));
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(&mut s, 3000);
    for (piece, x) in [(LEFT, 0.0), (LEFT, 0.25), (RIGHT, 0.25)] {
        s.apply_alone(Command::AddPin { piece, at: DVec2::new(x, 0.3) }).expect("pinned");
    }
    s
}

/// On the front of the ball it would fall; pins hold it, bit for bit where they were.
#[test]
fn pins_hold_and_a_hand_pulls() {
    let mut s = hung_by_pins();
    s.update();
    let held = |s: &Session| -> Vec<DVec3> {
        let snapshot = s.snapshot();
        snapshot.pinned.iter().flatten().map(|&v| snapshot.cloth.positions[v as usize]).collect()
    };
    let before = held(&s);
    s.apply_alone(Command::SetDraping { on: true }).expect("draped");
    run(&mut s, 1100);
    assert!(!drape(&s).runs && held(&s) == before && before.len() == 3);
    let low = |s: &Session| s.snapshot().cloth.positions.iter().map(|p| p.y).fold(f64::MAX, f64::min);
    assert!(low(&s) > -0.2, "it hangs");
    s.apply_alone(Command::Grab { piece: RIGHT, at: DVec2::new(0.2, 0.02), mode: DragMode::Surface })
        .expect("taken");
    let ray = Ray { origin: DVec3::new(0.15, 0.1, 3.0), direction: DVec3::NEG_Z };
    s.apply_alone(Command::DragTo { ray }).expect("pulled");
    run(&mut s, 60);
    assert!(drape(&s).runs, "what is in the hand does not sleep");
    let report = measured(&s);
    assert!(report.strain.p99 < 0.05, "pulled by hand: strain {}", report.strain.p99);
    assert_eq!(report.penetration.vertices, 0);
    s.apply_alone(Command::Release).expect("let go");
    run(&mut s, 1100);
    assert!(!drape(&s).runs && held(&s) == before);
}

/// In the longer steps of unslowed time it would sink under its own weight as soon as it is touched.
#[test]
fn draped_cloth_that_is_taken_and_held_still_stays() {
    let mut s = hung_by_pins();
    s.apply_alone(Command::SetDraping { on: true }).expect("draped");
    run(&mut s, 1300);
    assert!(!drape(&s).runs, "it rests");
    let before = s.snapshot().cloth.positions.clone();
    s.apply_alone(Command::Grab { piece: RIGHT, at: DVec2::new(0.2, 0.02), mode: DragMode::Surface })
        .expect("taken");
    run(&mut s, 60);
    let farthest = |s: &Session| {
        let now = &s.snapshot().cloth.positions;
        now.iter().zip(&before).map(|(x, y)| x.distance(*y)).fold(0.0, f64::max)
    };
    assert!(farthest(&s) < 0.001, "held: {} m", farthest(&s));
    s.apply_alone(Command::Release).expect("let go");
    run(&mut s, 1300);
    assert!(!drape(&s).runs && farthest(&s) < 0.001, "let go: {} m", farthest(&s));
}

/// From one side of the ball to the other within a tick, and back: what it holds stays on its side of everything.
#[test]
fn a_hand_that_jumps_takes_cloth_through_nothing() {
    let mut s = on_top();
    s.apply_alone(Command::SetDraping { on: true }).expect("draped");
    run(&mut s, 10);
    s.apply_alone(Command::Grab { piece: RIGHT, at: DVec2::new(0.2, 0.02), mode: DragMode::Surface })
        .expect("taken");
    for tick in 0..40 {
        let side = if tick / 4 % 2 == 0 { 1.0 } else { -1.0 };
        let ray = Ray { origin: DVec3::new(0.5 * side, 0.3 - 0.6 * side, 3.0), direction: DVec3::NEG_Z };
        s.apply_alone(Command::DragTo { ray }).expect("pulled");
        run(&mut s, 1);
        let snapshot = s.snapshot();
        let (garment, body) =
            (snapshot.garment.as_ref().expect("a garment"), snapshot.body.as_ref().expect("a body"));
        let mesh =
            TriMesh { positions: snapshot.cloth.positions.clone(), triangles: garment.triangles.clone() };
        let edges = &garment.adjacency.edges;
        assert_eq!(self_crossings(&mesh, edges, &mesh.tree()).len(), 0, "tick {tick}: through itself");
        let into = meetings(&mesh.positions, edges, &body.mesh, &body.mesh.tree());
        let out = meetings(&body.mesh.positions, &body.adjacency.edges, &mesh, &mesh.tree());
        assert_eq!(into.len() + out.len(), 0, "tick {tick}: through the body");
    }
}

/// A knit that its own weight would stretch, held by three pins.
fn hung(strain: f64) -> Report {
    let mut s = hung_by_pins();
    s.apply_alone(Command::SetFabric { piece: None, fabric: Some("sweat-knit".to_owned()) }).expect("set");
    let settings = Settings { strain, ..s.document().settings };
    s.apply_alone(Command::SetSettings { settings }).expect("set");
    s.apply_alone(Command::SetDraping { on: true }).expect("draped");
    run(&mut s, 1300);
    measured(&s)
}

#[test]
fn strain_is_controlled_at_what_was_asked_for() {
    let [tight, loose] = [0.01, 0.1].map(|strain| hung(strain).strain);
    assert!(tight.p99 < 0.012, "{}", tight.p99);
    assert!(loose.p99 > 2.0 * tight.p99 && loose.p99 < 0.11, "{} and {}", loose.p99, tight.p99);
}

#[test]
fn fabrics_are_chosen_by_name_for_all_and_for_one() {
    let mut s = on_top();
    let set = |s: &mut Session, piece, fabric: Option<&str>| {
        s.apply_alone(Command::SetFabric { piece, fabric: fabric.map(str::to_owned) })
    };
    let why = set(&mut s, None, Some("chain mail")).expect_err("no such cloth").0;
    assert!(why.contains("cotton"), "{why}");
    assert!(set(&mut s, Some(PieceId(9)), Some("wool")).is_err());
    assert_eq!(s.document().fabrics.name(Some(LEFT)), Fabric::USUAL);
    set(&mut s, None, Some("wool")).expect("set");
    set(&mut s, Some(LEFT), Some("denim-11oz")).expect("set");
    let fabrics = s.document().fabrics.clone();
    assert_eq!([LEFT, RIGHT].map(|p| fabrics.name(Some(p)).to_owned()), ["denim-11oz", "wool"]);
    set(&mut s, Some(LEFT), None).expect("set");
    assert_eq!(s.document().fabrics.name(Some(LEFT)), "wool");
    s.apply_alone(Command::Undo).expect("undone");
    assert_eq!(s.document().fabrics, fabrics);
}

/// A front and a back, `bottom` and `top` metres wide, placed before and behind the ball from `low` up.
fn placed([bottom, top]: [f64; 2], low: f64, height: f64, edge_length: f64) -> Session {
    let mut project = tube_project();
    let document = &mut project.document;
    let (left, right) = ((bottom - top) / 2.0, (bottom + top) / 2.0);
    let corners = [(0.0, 0.0), (bottom, 0.0), (right, height), (left, height)].map(DVec2::from);
    let pattern = Arc::make_mut(&mut document.pattern);
    for (piece, turn) in [(LEFT, 0.0), (RIGHT, std::f64::consts::PI)] {
        let piece = Arc::make_mut(pattern.pieces.get_mut(&piece).expect("a piece"));
        for (edge, corner) in piece.outline.iter_mut().zip(corners) {
            edge.start = corner;
        }
        let rotation = DQuat::from_rotation_y(turn);
        let translation = rotation * DVec3::new(-bottom / 2.0, low, 0.16);
        piece.placement = Some(SpacePose::flat(translation, rotation));
    }
    document.settings.edge_length = edge_length;
    let mesh = Arc::new(ball(0.12, 24, 48));
    document.body = BodyChoice::Imported { name: "ball".to_owned(), mesh };
    Session::new(project, Runner::inline(Simulation::default()))
}

#[test]
fn placed_pieces_are_sewn_and_draped() {
    let mut s = placed([0.39, 0.2], -0.09, 0.2, 0.015);
    s.apply_alone(Command::Sew).expect("sewn");
    s.update();
    assert_eq!(s.snapshot().phase, Some(Phase::Growing));
    run(&mut s, 1500);
    let snapshot = Arc::clone(s.snapshot());
    assert_eq!(snapshot.phase, Some(Phase::AtRest));
    assert!(snapshot.problems.is_empty(), "{:?}", snapshot.problems);
    let report = measured(&s);
    assert_eq!((report.seams.open, report.unmapped_vertices), (0, 0));
    assert_eq!(report.penetration.vertices + report.penetration.faces + report.edges_through_body, 0);
    // A known fault: where it hangs on the ball it is left with 2.2 %, more than the 1 % asked for.
    assert!(report.strain.p99 < 0.023, "strain {}", report.strain.p99);
    // The ball is through the hem; the narrower end stands above it.
    assert_eq!(report.openings.iter().map(|o| o.body_through).collect::<Vec<_>>(), [true, false]);
    assert_eq!(s.undo_label(), Some("sew"));
    s.apply_alone(Command::Undo).expect("undone");
    s.update();
    assert!(!s.snapshot().is_dressed());
}

#[test]
fn a_garment_of_many_triangles_is_sewn_in_a_coarser_mesh_first() {
    let mut s = placed([0.39, 0.2], -0.09, 0.2, 0.006);
    s.apply_alone(Command::Sew).expect("sewn");
    let triangles = |s: &mut Session| {
        s.update();
        s.snapshot().garment.as_ref().map_or(0, |garment| garment.triangles.len())
    };
    assert!((2000..6000).contains(&triangles(&mut s)), "{}", triangles(&mut s));
    run(&mut s, 3000);
    assert!(triangles(&mut s) > 6000, "{}", triangles(&mut s));
    assert_eq!(s.snapshot().phase, Some(Phase::AtRest));
    assert!(s.snapshot().problems.is_empty(), "{:?}", s.snapshot().problems);
    let report = measured(&s);
    assert_eq!((report.seams.open, report.unmapped_vertices, report.self_crossings), (0, 0, 0));
    assert_eq!(report.penetration.vertices + report.penetration.faces + report.edges_through_body, 0);
}

/// What is being sewn has more vertices than the garment, or others: only the pattern is kept then.
#[test]
fn what_is_saved_while_pieces_are_sewn_can_be_opened() {
    for edge_length in [0.015, 0.006] {
        let mut s = placed([0.39, 0.2], -0.09, 0.2, edge_length);
        s.apply_alone(Command::Sew).expect("sewn");
        run(&mut s, 3);
        let project = s.project();
        let mut opened = Session::new(project, Runner::inline(Simulation::default()));
        let notices = opened.update();
        assert!(!notices.iter().any(|n| matches!(n, Notice::Failed { .. })), "{notices:?}");
        assert!(opened.snapshot().problems.is_empty(), "{:?}", opened.snapshot().problems);
    }
}

/// Two panels that hang from one seam, placed so that it lies below the widest part of what they should hang on: pulled
/// straight together they would slide down along it.
#[test]
fn a_strap_that_was_placed_too_low_is_sewn_over_the_shoulder() {
    let mut project = placed([0.1, 0.1], -0.23, 0.2, 0.015).project();
    let document = &mut project.document;
    let pattern = Arc::make_mut(&mut document.pattern);
    pattern.seams.clear();
    let tops = [LEFT, RIGHT].map(|piece| EdgeRef { piece, edge: 2 });
    pattern.add_seam(Seam::of_edges(tops, false));
    // Level; as thick as a shoulder with the chest below it, and 11 cm of it above the seam.
    let TriMesh { positions, triangles } = cylinder(0.08, 0.6, 48, 40);
    let down = |y: f64| if y < 0.0 { 3.0 * y } else { y };
    let positions = positions.iter().map(|p| DVec3::new(p.y - 0.3, down(p.x), -p.z)).collect();
    let mesh = Arc::new(TriMesh { positions, triangles });
    document.body = BodyChoice::Imported { name: "bar".to_owned(), mesh };
    let mut s = Session::new(project, Runner::inline(Simulation::default()));
    s.apply_alone(Command::Sew).expect("sewn");
    run(&mut s, 1500);
    assert_eq!(s.snapshot().phase, Some(Phase::AtRest));
    assert!(s.snapshot().problems.is_empty(), "{:?}", s.snapshot().problems);
    let report = measured(&s);
    assert_eq!((report.seams.open, report.unmapped_vertices, report.flipped_faces), (0, 0, 0));
    assert_eq!(report.penetration.vertices + report.penetration.faces + report.edges_through_body, 0);
    let heights = || s.snapshot().cloth.positions.iter().map(|p| p.y);
    assert!((0.08..0.085).contains(&heights().fold(f64::MIN, f64::max)), "over the bar");
    assert!(heights().fold(f64::MAX, f64::min) < -0.02, "down on both sides");
}

/// Both are placed at one place, as files of two garments are: the outer one is made room for, and the inner one gives way.
#[test]
fn what_is_worn_over_is_sewn_over_what_lies() {
    let mut outfit = placed([0.39, 0.28], -0.02, 0.2, 0.018).project();
    let outer = placed([0.42, 0.3], -0.04, 0.2, 0.018).project().document.pattern;
    let mut spindle = ball(0.12, 24, 48);
    spindle.positions.iter_mut().for_each(|p| p.y *= 3.0);
    outfit.document.body = BodyChoice::Imported { name: "spindle".to_owned(), mesh: Arc::new(spindle) };
    Arc::make_mut(&mut outfit.document.pattern).wear_over(&outer, "coat").expect("two layers");
    let layers: Vec<u8> = outfit.document.pattern.pieces.values().map(|p| p.layer).collect();
    assert_eq!(layers, [0, 0, 1, 1]);
    let mut s = Session::new(outfit, Runner::inline(Simulation::default()));
    s.apply_alone(Command::Sew).expect("sewn");
    s.update();
    let laid = |s: &Session| s.snapshot().cloth.mapped.iter().filter(|m| **m).count();
    let first = laid(&s);
    assert!(first < s.snapshot().cloth.mapped.len(), "the outer layer waits");
    run(&mut s, 3000);
    assert_eq!(s.snapshot().phase, Some(Phase::AtRest));
    assert!(s.snapshot().problems.is_empty(), "{:?}", s.snapshot().problems);
    let report = measured(&s);
    assert_eq!((report.seams.open, report.unmapped_vertices, report.self_crossings), (0, 0, 0));
    assert_eq!(report.penetration.vertices + report.penetration.faces + report.edges_through_body, 0);
    // At each height the outer one is farther out.
    let garment = s.snapshot().garment.clone().expect("a garment");
    let far = |inner: bool, band: i32| {
        let at = |c: &Corner| s.snapshot().cloth.positions[c.vertex as usize];
        let own = garment.corners.iter().filter(|c| (c.piece == LEFT || c.piece == RIGHT) == inner);
        let there: Vec<f64> =
            own.map(at).filter(|p| (p.y / 0.02).floor() as i32 == band).map(|p| p.x.hypot(p.z)).collect();
        (!there.is_empty()).then(|| there.iter().sum::<f64>() / there.len() as f64)
    };
    let bands: Vec<[f64; 2]> =
        (-8..8).filter_map(|band| Some([far(true, band)?, far(false, band)?])).collect();
    assert!(bands.len() > 3 && bands.iter().all(|[inner, outer]| outer > inner), "{bands:?}");
    s.apply_alone(Command::Undo).expect("undone");
    s.update();
    assert!(!s.snapshot().is_dressed());
}

/// A tube that is far too wide for what it is put round.
#[test]
fn what_falls_down_is_told() {
    let mut project = placed([0.6, 0.6], -0.1, 0.2, 0.03).project();
    let mut stick = ball(0.12, 24, 48);
    stick.positions.iter_mut().for_each(|p| *p *= DVec3::new(0.5, 8.0, 0.5));
    project.document.body = BodyChoice::Imported { name: "stick".to_owned(), mesh: Arc::new(stick) };
    let mut s = Session::new(project, Runner::inline(Simulation::default()));
    s.apply_alone(Command::Sew).expect("sewn");
    let told = |s: &Session| {
        let snapshot = s.snapshot();
        let (garment, cloth) = snapshot.drawn().expect("cloth");
        let (source, body) =
            (snapshot.source.as_ref().expect("a source"), snapshot.body.as_ref().expect("a body"));
        let faults = faults(&measured(s), source, garment, cloth, &BodyIndex::new(body), snapshot.lies());
        faults.iter().any(|fault| fault.problem.words.contains("slid down by"))
    };
    while !s.snapshot().was_sewn {
        assert!(run(&mut s, 1) > 0, "sewn in time");
    }
    assert!(!told(&s));
    run(&mut s, 40);
    assert!(told(&s));
}

/// A skirt that is wider than the hips, without anything that holds it.
#[test]
fn what_slides_down_when_it_is_draped_is_taken_as_wrapped_and_told() {
    let mut project = placed([0.56, 0.56], 0.55, 0.5, 0.03).project();
    project.document.body = BodyChoice::Mannequin(Measurements::default());
    project.document.take_marks(Arc::default());
    let mut s = Session::new(project, Runner::inline(Simulation::default()));
    s.apply_alone(Command::Dress { choice: StartChoice::default() }).expect("begun");
    run(&mut s, 6000);
    let started = s.snapshot().started.clone().expect("starts were tried");
    let taken = started.taken();
    assert_eq!((taken.start, taken.draped, taken.faults.len()), (Start::Marks, false, 0), "{started:?}");
    assert!(started.draped_fault().is_some());
    let draped = started.tried.iter().find(|tried| tried.draped).expect("it was draped");
    assert!(draped.faults.iter().any(|fault| fault.contains("slid down by")), "{started:?}");
    assert!(s.snapshot().cloth.positions.iter().all(|p| p.y > 0.4), "it is where it was put");
    // The user may still have it draped.
    s.apply_alone(Command::Dress { choice: StartChoice { draped: true, ..StartChoice::default() } })
        .expect("begun");
    run(&mut s, 6000);
    let started = s.snapshot().started.clone().expect("starts were tried");
    let taken = started.taken();
    assert!(taken.draped && taken.faults.iter().any(|fault| fault.contains("slid down by")), "{started:?}");
}

#[test]
fn seams_that_cannot_close_are_told() {
    // An hourglass keeps it where it is sewn, and is too thick there.
    let mut narrow = placed([0.3, 0.3], -0.15, 0.3, 0.018).project();
    let mut hourglass = cylinder(0.12, 1.0, 48, 40);
    hourglass.positions.iter_mut().for_each(|p| {
        p.y -= 0.5;
        *p *= DVec3::new(1.0 + 4.0 * p.y * p.y, 1.0, 1.0 + 4.0 * p.y * p.y);
    });
    narrow.document.body = BodyChoice::Imported { name: "hourglass".to_owned(), mesh: Arc::new(hourglass) };
    let mut s = Session::new(narrow, Runner::inline(Simulation::default()));
    s.apply_alone(Command::Sew).expect("sewn");
    while !s.snapshot().was_sewn {
        assert!(run(&mut s, 1) > 0, "sewn in time");
    }
    let told = |s: &Session| s.snapshot().problems.iter().any(|p| p.words.contains("does not come together"));
    assert!(!told(&s), "before it lies still nothing is said");
    run(&mut s, 1500);
    assert_eq!(s.snapshot().phase, Some(Phase::AtRest));
    assert!(told(&s), "{:?}", s.snapshot().problems);
    // What only had the skin between while it was sewn.
    let mut s = placed([0.386, 0.2], -0.09, 0.2, 0.015);
    s.apply_alone(Command::Sew).expect("sewn");
    run(&mut s, 1500);
    assert_eq!(s.snapshot().phase, Some(Phase::AtRest));
    assert!(!told(&s), "{:?}", s.snapshot().problems);
    let mut s = Session::new(project(), Runner::inline(Simulation::default()));
    let why = s.apply_alone(Command::Sew).expect_err("not placed").0;
    assert!(why.contains("placed"), "{why}");
}

/// Between the legs cloth is folded sharply, and the wrap strains it: the first ticks are rough.
#[test]
fn trousers_drape_to_rest_on_several_threads_without_passing_through_themselves() {
    let mannequin = mannequin(&Measurements::default()).expect("a mannequin");
    let draped = |workers: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(workers).build().expect("workers");
        pool.install(|| {
            let mut project = Sample::Trousers.project(&mannequin);
            // Enough vertices for several parts.
            project.document.settings.edge_length = 0.0165;
            let mut s = Session::new(project, Runner::inline(Simulation::default()));
            s.apply_alone(Command::Wrap).expect("wrapped");
            run(&mut s, 3000);
            s.apply_alone(Command::SetDraping { on: true }).expect("draped");
            run(&mut s, 5000);
            (s.snapshot().drape.expect("draped").ticks, cloth_hash(&mut s), measured(&s))
        })
    };
    let (ticks, hash, report) = draped(1);
    assert!(ticks < 400, "{ticks} ticks");
    assert_eq!(report.self_crossings + report.edges_through_body, 0);
    assert_eq!(report.penetration.vertices + report.penetration.faces, 0);
    assert_eq!(report.flipped_faces, report.faces_in_folds, "nothing is inside out");
    assert!(report.strain.p99 < 0.02, "strain {}", report.strain.p99);
    assert_eq!(draped(3).1, hash, "the same bits");
}

/// Legs that went through each other by centimetres hold each other fast with pairs of what is near: they know no way out.
#[test]
fn trouser_legs_that_are_deep_in_each_other_come_out() {
    let mannequin = mannequin(&Measurements::default()).expect("a mannequin");
    let mut s = Session::new(Sample::Trousers.project(&mannequin), Runner::inline(Simulation::default()));
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(&mut s, 3000);
    let mut project = s.project();
    let dressed = project.dressed.as_mut().expect("cloth");
    let (crotch, wide, deep) = (0.7, 0.09, 0.08);
    for p in &mut Arc::make_mut(&mut dressed.cloth).positions {
        let down = ((crotch - p.y) / 0.1).clamp(0.0, 1.0);
        p.x -= p.x.signum() * deep * down * (1.0 - p.x.abs() / wide).max(0.0);
    }
    let mut s = Session::new(project, Runner::inline(Simulation::default()));
    s.update();
    assert!(measured(&s).self_crossings > 100, "they are in each other");
    s.apply_alone(Command::SetDraping { on: true }).expect("draped");
    run(&mut s, 1300);
    let report = measured(&s);
    assert_eq!(report.self_crossings, 0);
    assert_eq!(report.penetration.vertices + report.edges_through_body, 0);
    assert!(report.strain.p99 < 0.02, "strain {}", report.strain.p99);
}
