//! Graphics on pieces, by the mouse and by numbers.

use toile::session::{Command, Graphic, ImageFile};

use super::*;

/// The window on square A, with an image of 2:1 on it: 10 cm wide, its middle in that of the square.
fn with_graphic() -> Window {
    let mut pattern = squares();
    let b = pattern.piece_named("B").expect("B");
    pattern.pieces.remove(&b);
    let picture = image::RgbaImage::from_pixel(20, 10, image::Rgba([200, 30, 40, 255]));
    let bytes = toile::render::png(&picture).expect("a file");
    let document = Document { pattern: Arc::new(pattern), ..Document::default() };
    let mut session = toile::session::Session::new(
        Project { document, dressed: None },
        toile::sim::Runner::inline(toile::sim::Simulation::default()),
    );
    session
        .apply_alone(Command::AddImage { file: Arc::new(ImageFile::new("logo.png", bytes)) })
        .expect("an image");
    let mut window = crate::window_on(session.project(), None);
    window.run_steps(3);
    window.get_by_label("Place logo.png").click();
    window.run_steps(3);
    window
}

fn graphic(window: &Window) -> Graphic {
    *app(window).session().document().artwork.graphics.values().next().expect("a graphic")
}

/// Where a point of the square is on the screen: its corners are at the ends of its box.
fn on_screen(window: &Window, p: DVec2) -> Pos2 {
    app(window).on_screen(p).expect("a pane")
}

#[test]
fn a_graphic_is_dragged_scaled_and_turned() {
    let mut window = with_graphic();
    let first = graphic(&window);
    assert!(first.at.distance(DVec2::new(0.1, 0.1)) < 1e-9 && first.width_m == 0.1, "{first:?}");
    let from = on_screen(&window, first.at);
    let to = on_screen(&window, first.at + DVec2::new(0.03, -0.02));
    drag(&mut window, from, to);
    let moved = graphic(&window);
    assert!(moved.at.distance(first.at + DVec2::new(0.03, -0.02)) < 2e-3, "{moved:?}");
    assert_eq!(app(&window).session().undo_label(), Some("change the graphic"));
    // By its corner to twice the distance from its middle.
    let corner = DVec2::new(0.05, 0.025);
    let (from, to) = (on_screen(&window, moved.at + corner), on_screen(&window, moved.at + corner * 1.5));
    drag(&mut window, from, to);
    let scaled = graphic(&window);
    assert!((scaled.width_m - 0.15).abs() < 3e-3 && scaled.at == moved.at, "{scaled:?}");
    // The knob stands above the upper edge, 22 points away.
    let knob = on_screen(&window, scaled.at + DVec2::new(0.0, 0.0375)) - Vec2::new(0.0, 22.0);
    let beside = on_screen(&window, scaled.at) - Vec2::new(80.0, 0.0);
    drag(&mut window, knob, beside);
    let turned = graphic(&window);
    assert!((turned.angle - std::f64::consts::FRAC_PI_2).abs() < 0.05, "{turned:?}");
    for _ in 0..3 {
        key(&mut window, Modifiers::COMMAND, Key::Z);
    }
    assert_eq!(graphic(&window), first, "three steps");
}

#[test]
fn a_graphic_is_deleted_in_the_side_panel() {
    let mut window = with_graphic();
    let id = *app(&window).session().document().artwork.graphics.keys().next().expect("a graphic");
    window.get_by_label(&format!("Delete {id}")).scroll_to_me();
    window.run_steps(3);
    window.get_by_label(&format!("Delete {id}")).click();
    window.run_steps(3);
    assert!(app(&window).session().document().artwork.graphics.is_empty());
    window.get_by_label("Delete logo.png").scroll_to_me();
    window.run_steps(3);
    window.get_by_label("Delete logo.png").click();
    window.run_steps(3);
    assert!(app(&window).session().document().artwork.images.is_empty());
}
