//! Cloth in the hand cannot be pulled across a bone.

use std::f64::consts::{PI, TAU};
use std::sync::Arc;

use glam::DVec3;
use toile::body::{Surface, mannequin};
use toile::cloth::{ClothState, Counters, Garment, Skip, Skips, build};
use toile::contact::{Bone, Bones};
use toile::drag::{DragMode, Dragging, Ray};
use toile::relax::{RelaxSettings, Relaxer};
use toile::session::samples::Sample;
use toile::session::{Command, Session};
use toile::sim::{Runner, Simulation};

use crate::common::exact::{cylinder, rolled, tube};

const RADIUS: f64 = 0.04;
const OFFSET: f64 = 0.004;
const EDGE: f64 = 0.015;
/// Along the axis of the limb.
const BONE: Bone = [DVec3::new(0.0, 0.05, 0.0), DVec3::new(0.0, 0.95, 0.0)];

struct Sleeve {
    garment: Arc<Garment>,
    surface: Arc<Surface>,
    state: ClothState,
}

fn sleeve() -> Sleeve {
    let width = PI * (RADIUS + OFFSET) * 1.1;
    let (garment, _) = build(&tube(width, 0.15), EDGE);
    let surface = Surface::new(cylinder(RADIUS, 1.0, 96, 10)).expect("a limb");
    let state = rolled(&garment, width, RADIUS + OFFSET, 0.4);
    Sleeve { garment: Arc::new(garment), surface: Arc::new(surface), state }
}

/// How often the borders of the cloth go round the limb's axis.
fn rounds(garment: &Garment, state: &ClothState) -> f64 {
    let lists = &garment.adjacency;
    let mut sum = 0.0;
    for (t, vs) in garment.triangles.iter().enumerate() {
        for k in 0..3 {
            if lists.edge_triangles.of(lists.triangle_edges[t][k]).len() == 1 {
                let [a, b] = [vs[k], vs[(k + 1) % 3]].map(|v| state.positions[v as usize]);
                // One border goes one way round, the other the other way: each counts by its way.
                let turn = (a.z * b.x - a.x * b.z).atan2(a.x * b.x + a.z * b.z);
                sum += turn * if a.y > 0.475 { -1.0 } else { 1.0 };
            }
        }
    }
    (sum / TAU).abs()
}

/// A sleeve pulled sideways by one point, through the limb if it goes.
fn pulled(mode: DragMode, bones: &[Bone], relaxing: bool, skips: Skips) -> (f64, ClothState, Counters) {
    let sleeve = sleeve();
    let settings =
        RelaxSettings { offset: OFFSET / sleeve.surface.scale(), skips, ..RelaxSettings::default() };
    let mut relaxer =
        Relaxer::new(sleeve.garment.clone(), sleeve.surface.clone(), settings).expect("enough memory");
    relaxer.set_mapped(&sleeve.state.mapped);
    relaxer.bones = Arc::new(Bones::new(bones, &sleeve.surface));
    let front = |v: &u32| {
        let p = sleeve.state.positions[*v as usize];
        (p - DVec3::new(0.0, 0.4, RADIUS + OFFSET)).length()
    };
    let all = 0..sleeve.garment.vertex_count as u32;
    let hand = all.min_by(|a, b| front(a).total_cmp(&front(b))).expect("a vertex");
    let mut dragging = Dragging::new(relaxer, &sleeve.state, hand, DVec3::ZERO, mode, &[]);
    let mut state = sleeve.state.clone();
    assert!((rounds(&sleeve.garment, &state) - 2.0).abs() < 1e-6);
    let mut least = 2.0f64;
    dragging.drag_to(Ray { origin: DVec3::new(0.0, -10.0, -0.5), direction: DVec3::Y });
    for _ in 0..80 {
        dragging.step(&mut state, relaxing);
        assert!(state.positions.iter().all(|p| p.is_finite()));
        least = least.min(rounds(&sleeve.garment, &state));
    }
    (least, state, dragging.counters())
}

#[test]
fn a_sleeve_pulled_sideways_stays_on_its_limb() {
    for (mode, relaxing) in [(DragMode::Vertex, true), (DragMode::Rigid, true), (DragMode::Rigid, false)] {
        let (least, _, counters) = pulled(mode, &[BONE], relaxing, Skips::default());
        println!("{mode:?}, relaxing {relaxing}: {least} rounds, {counters:?}");
        assert!((least - 2.0).abs() < 1e-6, "{mode:?}: {least} rounds");
        // Relaxed after every substep cloth is out of the limb again before it comes to the bone.
        assert_eq!(counters.bone_stops > 0, mode == DragMode::Vertex || !relaxing, "{mode:?}");
    }
}

/// The same without bones: a vertex in the hand, or all of it unrelaxed, goes through the limb; and nothing is tested.
#[test]
fn without_bones_it_goes_through_and_nothing_is_tested() {
    for (mode, relaxing) in [(DragMode::Vertex, true), (DragMode::Rigid, false)] {
        let (least, _, counters) = pulled(mode, &[], relaxing, Skips::default());
        assert!(least < 1.5, "{mode:?}: {least} rounds");
        assert_eq!((counters.bone_tests, counters.bone_stops), (0, 0));
    }
}

#[test]
fn edges_far_from_bones_are_not_tested_and_it_changes_nothing() {
    let (_, usual, with) = pulled(DragMode::Rigid, &[BONE], true, Skips::default());
    let (_, other, without) = pulled(DragMode::Rigid, &[BONE], true, Skips::without(&[Skip::Bones]));
    assert!(usual == other);
    println!("{} tests, {} without", with.bone_tests, without.bone_tests);
    assert!(with.bone_tests * 2 < without.bone_tests);
}

/// Bones are the document's: drawn by a command, undone, and the body's own otherwise.
#[test]
fn bones_are_drawn_and_undone() {
    let mut project = Sample::Skirt.project(&mannequin::default());
    project.document.settings.edge_length = 0.06;
    let mut session = Session::new(project, Runner::inline(Simulation::default()));
    let before = session.document_hash();
    session.apply_alone(Command::SetBones { bones: Some(vec![BONE]) }).expect("drawn");
    assert_eq!(session.document().bones.as_deref(), Some(&vec![BONE]));
    let nowhere = [DVec3::NAN, DVec3::ZERO];
    assert!(session.apply_alone(Command::SetBones { bones: Some(vec![nowhere]) }).is_err());
    assert_ne!(session.document_hash(), before);
    let text = serde_json::to_string(session.document()).expect("JSON");
    let read: toile::session::Document = serde_json::from_str(&text).expect("a document");
    assert_eq!(read.bones, session.document().bones);
    session.apply_alone(Command::Undo).expect("undone");
    assert_eq!(session.document().bones, None);
}
