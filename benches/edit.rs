//! Time of what a designer waits for while the pattern is edited on a dressed garment of about 10,000 triangles: the
//! change itself, cutting and carrying the cloth over, and the first tick after it.

use criterion::{Criterion, criterion_group, criterion_main};
use glam::DVec2;
use toile::body::mannequin;
use toile::cloth::{Carry, build, build_again};
use toile::geometry::ids::PieceId;
use toile::pattern::edit::{PatternEdit, PointRef, apply};
use toile::pattern::triangulate::Meshes;
use toile::session::samples::Sample;
use toile::session::{Command, Session};
use toile::sim::{Runner, Simulation};

const FINE: f64 = 0.0125;

fn moved_point(session: &Session, by: f64) -> PatternEdit {
    let pattern = &session.document().pattern;
    let piece: PieceId = *pattern.pieces.keys().next().expect("a piece");
    let to = pattern.pieces[&piece].edge(0).start + DVec2::new(by, -by);
    PatternEdit::MovePoints { points: vec![(PointRef { piece, point: 0 }, to)] }
}

fn edits(c: &mut Criterion) {
    let mut group = c.benchmark_group("a moved point of a dressed garment");
    group.sample_size(10);
    for sample in [Sample::Skirt, Sample::Tshirt] {
        let mut project = sample.project(&mannequin::default());
        project.document.settings.edge_length = FINE;
        for seam in std::sync::Arc::make_mut(&mut project.document.pattern).seams.values_mut() {
            seam.ratio = None;
        }
        let pattern = std::sync::Arc::clone(&project.document.pattern);
        let mut session = Session::new(project, Runner::inline(Simulation::default()));
        session.apply_alone(Command::Wrap).expect("wrapped");
        let simulation = session.runner().simulation().expect("inline");
        while !simulation.is_at_rest() {
            simulation.tick();
        }
        let edit = moved_point(&session, 0.004);
        let name = format!("{sample:?}").to_lowercase();
        group.bench_function(format!("{name}: change the pattern"), |b| b.iter(|| apply(&pattern, &edit)));
        let mut meshes = Meshes::default();
        let (before, _) = build_again(&pattern, FINE, &mut meshes);
        let changed = apply(&pattern, &edit).expect("a change").pattern;
        group.bench_function(format!("{name}: triangulate all pieces"), |b| b.iter(|| build(&changed, FINE)));
        group.bench_function(format!("{name}: triangulate what changed"), |b| {
            b.iter(|| build_again(&changed, FINE, &mut meshes.clone()));
        });
        let after = build(&changed, FINE).0;
        group.bench_function(format!("{name}: carry over"), |b| b.iter(|| Carry::new(&before, &after)));
        let mut far = false;
        group.bench_function(format!("{name}: until the cloth is seen moved"), |b| {
            b.iter(|| {
                far = !far;
                let edit = moved_point(&session, if far { 0.004 } else { -0.004 });
                let command = Command::EditPattern { edits: vec![edit], anew: false };
                session.apply_alone(command).expect("edited");
                session.runner().simulation().expect("inline").tick();
            });
        });
    }
}

criterion_group!(benches, edits);
criterion_main!(benches);
