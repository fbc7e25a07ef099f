//! Time of a frame while the pattern pane is panned and zoomed: everything egui does and the triangles of what it drew,
//! without a graphics card. Of the sample with the most pieces, and of a crowd larger than most garments.

use std::sync::Arc;

use criterion::{Criterion, criterion_group, criterion_main};
use egui::{Event, Key, Modifiers, PointerButton, Vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use glam::DVec2;
use toile::body::mannequin;
use toile::pattern::{Pattern, Piece, Seam, Stretch};
use toile::session::samples::Sample;
use toile::session::{Document, Project};
use toile::ui::App;

/// 26 pieces with curved edges and 70 seams.
fn crowd() -> Pattern {
    let mut pattern = Pattern::default();
    let ids: Vec<_> = (0..26)
        .map(|i| {
            let at = DVec2::new(f64::from(i % 7) * 0.3, f64::from(i / 7) * 0.4);
            let corners = [[0.0, 0.0], [0.12, 0.02], [0.25, 0.0], [0.25, 0.3], [0.12, 0.33], [0.0, 0.3]];
            let mut piece =
                Piece::polygon(&format!("piece number {i}"), &corners.map(|c| DVec2::from(c) + at));
            for edge in [1, 4] {
                let (a, b) = piece.edge_ends(edge);
                let control = a.midpoint(b) + DVec2::new(0.0, 0.04);
                piece.outline[edge].shape = toile::pattern::EdgeShape::Quadratic { control };
            }
            pattern.add_piece(piece)
        })
        .collect();
    for i in 0..70 {
        let (a, b) = (ids[i % 26], ids[(i + 1 + i / 26) % 26]);
        let sides = [Stretch::edge(a, i % 6), Stretch::edge(b, (i + 3) % 6)];
        pattern.add_seam(Seam { sides, same_direction: false, ratio: None, zip: None });
    }
    pattern
}

/// The window on a pattern, seams in view and the pointer in the middle of the pane.
fn window(pattern: Pattern) -> (Harness<'static, Option<App>>, egui::Pos2) {
    let document = Document { pattern: Arc::new(pattern), ..Document::default() };
    let mut project = Some(Project { document, dressed: None });
    let builder = Harness::builder().with_size(Vec2::new(1280.0, 720.0)).with_step_dt(1.0 / 60.0);
    let mut window = builder.build_ui_state(
        move |ui, app: &mut Option<App>| {
            let app = app.get_or_insert_with(|| {
                let project = project.take().expect("only once");
                App::new(ui.ctx(), project, None, None).expect("a thread for the simulation")
            });
            app.ui(ui);
        },
        None,
    );
    window.run_steps(4);
    window.key_press(Key::S);
    let middle = window.get_by_label("Pattern pane").rect().center();
    window.event(Event::PointerMoved(middle));
    window.run_steps(3);
    (window, middle)
}

fn frames(c: &mut Criterion) {
    let mut group = c.benchmark_group("a frame of the pattern pane");
    group.sample_size(30);
    let largest = Sample::ALL.iter().map(|sample| sample.project(&mannequin::default()).document.pattern);
    let largest = largest.max_by_key(|pattern| pattern.pieces.len()).expect("a sample");
    for (name, pattern) in [("largest sample", Pattern::clone(&largest)), ("26 pieces, 70 seams", crowd())] {
        let (mut window, middle) = window(pattern);
        let mut turn = 1.0;
        group.bench_function(format!("{name}: zoomed"), |b| {
            b.iter(|| {
                turn = -turn;
                window.event(Event::MouseWheel {
                    unit: egui::MouseWheelUnit::Line,
                    delta: Vec2::new(0.0, turn),
                    phase: egui::TouchPhase::Move,
                    source: egui::MouseWheelSource::Wheel,
                    modifiers: Modifiers::NONE,
                });
                window.run_steps(1);
            });
        });
        let button = |pressed| Event::PointerButton {
            pos: middle,
            button: PointerButton::Middle,
            pressed,
            modifiers: Modifiers::NONE,
        };
        window.event(button(true));
        group.bench_function(format!("{name}: panned"), |b| {
            b.iter(|| {
                turn = -turn;
                window.event(Event::PointerMoved(middle + Vec2::splat(20.0 * turn)));
                window.run_steps(1);
            });
        });
        window.event(button(false));
        window.run_steps(2);
        let shapes = window.output().shapes.clone();
        group.bench_function(format!("{name}: triangles of what is drawn"), |b| {
            b.iter(|| window.ctx.tessellate(shapes.clone(), 1.0));
        });
    }
}

criterion_group!(benches, frames);
criterion_main!(benches);
