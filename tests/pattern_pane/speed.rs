//! How long a frame of a crowded pattern takes.

use super::*;

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
        pattern.add_seam(Seam { sides, same_direction: false, ratio: None });
    }
    pattern
}

#[test]
fn a_crowded_pattern_is_panned_and_zoomed_fast() {
    let mut window = window_on(crowd());
    press(&mut window, Key::S);
    let middle = at(&window, 0.0, 0.0);
    move_to(&mut window, middle);
    let frames = 60;
    let start = Instant::now();
    for i in 0..frames {
        let delta = Vec2::new(0.0, if i % 2 == 0 { 1.0 } else { -1.0 });
        window.event(Event::MouseWheel {
            unit: egui::MouseWheelUnit::Line,
            delta,
            phase: egui::TouchPhase::Move,
            source: egui::MouseWheelSource::Wheel,
            modifiers: Modifiers::NONE,
        });
        window.run_steps(1);
    }
    let each = start.elapsed().as_secs_f64() * 1000.0 / f64::from(frames);
    let shapes = window.output().shapes.clone();
    let start = Instant::now();
    let triangles: usize = window
        .ctx
        .tessellate(shapes, 1.0)
        .iter()
        .map(|clipped| match &clipped.primitive {
            egui::epaint::Primitive::Mesh(mesh) => mesh.indices.len() / 3,
            egui::epaint::Primitive::Callback(_) => 0,
        })
        .sum();
    let drawn = start.elapsed().as_secs_f64() * 1000.0;
    println!("26 pieces, 70 seams: {each:.2} ms a frame, and {drawn:.2} ms for its {triangles} triangles");
    // Generous: machines that run tests have other things to do.
    assert!(each + drawn < 100.0, "{each} ms");
}
