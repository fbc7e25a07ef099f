//! Lines, holes, arcs, guides; pieces folded, unfolded and made symmetric.

use egui::Rect;
use toile::pattern::{AllowanceCorner, EdgeShape, InternalLine, Piping, Side, Wrinkle};

use super::*;

/// The first square with a line and a square hole.
fn detailed() -> Pattern {
    let mut pattern = squares();
    let id = pattern.piece_named("A").expect("a square");
    let piece = Arc::make_mut(pattern.pieces.get_mut(&id).expect("the square"));
    let line =
        |ends: &[[f64; 2]]| Piece::polygon("", &ends.iter().map(|&p| DVec2::from(p)).collect::<Vec<_>>());
    let edges = vec![line(&[[0.02, 0.03], [0.1, 0.03], [0.1, 0.05]]).outline[0].clone()];
    piece.lines.push(InternalLine { edges, end: DVec2::new(0.18, 0.03), ..InternalLine::default() });
    piece.holes.push(line(&[[0.08, 0.1], [0.08, 0.14], [0.12, 0.14], [0.12, 0.1]]).outline);
    pattern
}

#[test]
fn a_line_is_clicked_and_deleted_and_so_is_a_hole_by_an_edge_of_it() {
    let mut window = window_on(detailed());
    press(&mut window, Key::A);
    let line = place(&window, "A, line 1");
    click(&mut window, line);
    press(&mut window, Key::Delete);
    let left = pattern(&window);
    assert!(piece(&left, "A").lines.is_empty() && piece(&left, "A").holes.len() == 1);
    let edge = place(&window, "A, edge 6");
    click(&mut window, edge + Vec2::new(0.0, 3.0));
    press(&mut window, Key::Delete);
    assert!(piece(&pattern(&window), "A").holes.is_empty());
    assert_eq!(pattern(&window).pieces.len(), 2);
    key(&mut window, Modifiers::COMMAND, Key::Z);
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(pattern(&window), detailed());
}

#[test]
fn the_pen_draws_an_arc_through_where_ctrl_clicks() {
    let mut window = window();
    press(&mut window, Key::B);
    let [a, b, top] = [[-100.0, 0.0], [100.0, 0.0], [0.0, -100.0]].map(|[x, y]| at(&window, x, y));
    click(&mut window, a);
    click(&mut window, b);
    click_with(&mut window, top, Modifiers::COMMAND);
    click(&mut window, a);
    press(&mut window, Key::Enter);
    let drawn = pattern(&window);
    let piece = piece(&drawn, "Piece 1");
    let arcs: Vec<usize> = (0..2).filter(|&i| matches!(piece.edge(i).shape, EdgeShape::Arc { .. })).collect();
    assert_eq!((piece.outline.len(), arcs.len()), (2, 1));
    let length = piece.edge_ends(0).0.distance(piece.edge_ends(0).1);
    let half = std::f64::consts::PI * length * length / 8.0;
    assert!((piece.signed_area() / half - 1.0).abs() < 0.02, "{} {half}", piece.signed_area());
}

#[test]
fn selected_edges_become_arcs_that_stay_arcs_when_bent() {
    let mut window = window_on(squares());
    press(&mut window, Key::A);
    let edge = place(&window, "A, edge 1:");
    click(&mut window, edge);
    window.get_by_label("Arc").click();
    window.run_steps(3);
    let shape = |window: &Window| piece(&pattern(window), "A").edge(0).shape;
    let radius = |shape| match shape {
        EdgeShape::Arc { radius, .. } => radius,
        other => panic!("an arc, not {other:?}"),
    };
    let first = radius(shape(&window));
    assert!((first - 0.26).abs() < 1e-9, "a sagitta of a tenth: {first}");
    let edge = place(&window, "A, edge 1:");
    drag(&mut window, edge, edge + Vec2::new(0.0, 30.0));
    assert!(radius(shape(&window)) < first);
}

#[test]
fn guides_are_dragged_out_moved_and_taken_back() {
    let mut window = window_on(squares());
    press(&mut window, Key::V);
    let ruler = window.get_by_label("Ruler beside the pattern").rect().center();
    // Between the squares, where nothing else lies.
    let [first, second] = [-6.0, 12.0].map(|x| at(&window, x, 0.0));
    drag(&mut window, ruler, first);
    drag(&mut window, first, second);
    // A corner dragged near the guide is drawn on to it.
    let guide = |window: &mut Window, near: Pos2| {
        press(window, Key::R);
        let corner = near - Vec2::new(0.0, 160.0);
        drag(window, corner - Vec2::new(60.0, 60.0), corner + Vec2::new(3.0, 0.0));
        let drawn = bounds(piece(&pattern(window), "Piece 1"))[1].x;
        key(window, Modifiers::COMMAND, Key::Z);
        press(window, Key::V);
        drawn
    };
    let scale = (second.x - first.x) as f64;
    let lies = guide(&mut window, second);
    drag(&mut window, second, first);
    let moved = guide(&mut window, first);
    assert!(lies > moved && scale > 0.0, "{lies} {moved}");
    drag(&mut window, first, ruler);
    let count = steps(&window).len();
    let gone = guide(&mut window, first);
    assert_eq!(steps(&window).len(), count, "guides are no steps");
    assert!((gone - moved).abs() > 1e-4, "nothing draws on any more");
}

#[test]
fn pieces_are_made_symmetric_folded_and_unfolded() {
    let mut window = window_on(squares());
    press(&mut window, Key::V);
    let middle = place(&window, "Piece A");
    click(&mut window, middle);
    key(&mut window, Modifiers::COMMAND, Key::M);
    assert!(piece(&pattern(&window), "A").symmetric);
    let whole = piece(&pattern(&window), "A").signed_area();
    window.get_by_label("Fold").click();
    window.run_steps(3);
    let folded = pattern(&window);
    assert!(!piece(&folded, "A").symmetric);
    assert!((piece(&folded, "A").signed_area() - whole / 2.0).abs() < 1e-9);
    press(&mut window, Key::A);
    let edge = place(&window, "B, edge 2");
    click(&mut window, edge);
    key(&mut window, Modifiers::COMMAND, Key::U);
    let unfolded = pattern(&window);
    assert!(piece(&unfolded, "B").symmetric);
    assert!((piece(&unfolded, "B").signed_area() - 2.0 * whole).abs() < 1e-9);
}

#[test]
fn a_piece_is_scaled_by_its_handles() {
    let mut window = window_on(squares());
    press(&mut window, Key::V);
    let middle = place(&window, "Piece A");
    click(&mut window, middle);
    let corner = [place(&window, "A, edge 2").x, place(&window, "A, edge 3").y];
    let corner = Pos2::from(corner) + Vec2::new(7.0, -7.0);
    let before = bounds(piece(&pattern(&window), "A"));
    drag(&mut window, corner, corner + Vec2::new(30.0, -30.0));
    let after = bounds(piece(&pattern(&window), "A"));
    assert!(after[0].distance(before[0]) < 1e-9, "the far corner stays");
    let grown = (after[1] - after[0]) / (before[1] - before[0]);
    assert!(grown.x > 1.05 && (grown.x - grown.y).abs() < 0.02, "{grown}");
}

#[test]
fn a_corner_of_the_allowance_is_chosen_in_the_side_panel_and_undone() {
    let mut squares = squares();
    for piece in squares.pieces.values_mut() {
        Arc::make_mut(piece).allowance = 0.01;
    }
    let mut window = window_on(squares);
    press(&mut window, Key::A);
    let corner = place(&window, "A, point 2");
    click(&mut window, corner);
    let role = egui::accesskit::Role::ComboBox;
    window.get_by_role_and_label(role, "Corner of the allowance").click();
    window.run_steps(4);
    window.get_by_label("Turned up at edge 1").click();
    window.run_steps(4);
    let chosen = |window: &Window| piece(&pattern(window), "A").outline[1].corner;
    assert_eq!(chosen(&window), AllowanceCorner::TurnedUp(Side::Before));
    assert_eq!(steps(&window), ["change a corner of the allowance"]);
    let recording = window.state_mut().as_mut().expect("the app").recording();
    assert!(recording.contains("set_corner"), "it is recorded");
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert_eq!(chosen(&window), AllowanceCorner::Mitre);
}

/// Types `text` over what stands in the field with this label.
fn enter(window: &mut Window, label: &str, text: &str) {
    use egui::accesskit::Role;
    window.get_by_role_and_label(Role::TextInput, label).focus();
    window.run_steps(2);
    key(window, Modifiers::COMMAND, Key::A);
    window.get_by_role_and_label(Role::TextInput, label).type_text(text);
    window.run_steps(2);
    press(window, Key::Enter);
}

/// Chooses `entry` of the pattern menu, where the side panel has a box of the same name.
fn choose_beside_box(window: &mut Window, entry: &str) {
    crate::act(window, "Pattern");
    let is_box = |role| role == egui::accesskit::Role::CheckBox;
    for is_in_view in [false, true] {
        let mut entries = window.get_all_by_label(entry).filter(|node| !is_box(node.accesskit_node().role()));
        let entry = entries.next().expect("an entry");
        if is_in_view {
            entry.click();
        } else {
            entry.scroll_to_me();
        }
        drop(entries);
        window.run_steps(4);
    }
}

#[test]
fn piping_is_sewn_in_changed_and_taken_out_in_the_side_panel_and_undone() {
    use egui::accesskit::Role;
    let mut window = window_on(squares());
    press(&mut window, Key::A);
    let edge = place(&window, "A, edge 1:");
    click(&mut window, edge);
    let piping = |window: &Window| piece(&pattern(window), "A").edge(0).trims.piping;
    window.get_by_role_and_label(Role::CheckBox, "Piping").click_accesskit();
    window.run_steps(4);
    assert_eq!(piping(&window), Some(Piping::USUAL));
    // Of its radius and its colour.
    assert!(window.query_by_label("Colour of the piping").is_some());
    let radius = |window: &mut Window, text: &str| {
        enter(window, "Radius", text);
        piping(window).expect("piping").radius
    };
    assert!((radius(&mut window, "2.5 mm") - 0.0025).abs() < 1e-12);
    assert!((radius(&mut window, "9 mm") - 0.006).abs() < 1e-12, "the thickest there is");
    assert_eq!(steps(&window), ["sew piping in"; 3]);
    window.get_by_role_and_label(Role::CheckBox, "Piping").click_accesskit();
    window.run_steps(4);
    assert_eq!(piping(&window), None);
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(piping(&window).is_some_and(|piping| (piping.radius - 0.006).abs() < 1e-12));
    let recording = window.state_mut().as_mut().expect("the app").recording();
    assert!(recording.contains("set_piping"), "it is recorded");
}

#[test]
fn piping_is_in_the_menu_of_the_pattern() {
    let mut window = window_on(detailed());
    press(&mut window, Key::A);
    let line = place(&window, "A, line 1");
    click(&mut window, line);
    choose_beside_box(&mut window, "Piping");
    let trims = |window: &Window| piece(&pattern(window), "A").lines[0].edges[0].trims;
    assert_eq!(trims(&window).piping, Some(Piping::USUAL));
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(trims(&window).is_none());
}

#[test]
fn a_wrinkle_is_set_changed_and_smoothed_out_in_the_side_panel_and_undone() {
    use egui::accesskit::Role;
    let mut window = window_on(detailed());
    press(&mut window, Key::A);
    let line = place(&window, "A, line 1");
    click(&mut window, line);
    let wrinkle = |window: &Window| piece(&pattern(window), "A").lines[0].edges[0].trims.wrinkle;
    window.get_by_role_and_label(Role::CheckBox, "Wrinkle").click_accesskit();
    window.run_steps(4);
    assert_eq!(wrinkle(&window), Some(Wrinkle::USUAL));
    let typed = |window: &mut Window, label: &str, text: &str| {
        enter(window, label, text);
        let Wrinkle { width, height } = wrinkle(window).expect("a wrinkle");
        [width, height].map(|metres| (metres * 1e6).round() / 1e3)
    };
    assert_eq!(typed(&mut window, "Height", "-12 mm"), [40.0, -12.0]);
    assert_eq!(typed(&mut window, "Width", "10 mm"), [10.0, -5.0], "at most half as high as wide");
    assert_eq!(typed(&mut window, "Width", "300 mm"), [100.0, -5.0], "the widest there is");
    assert_eq!(steps(&window), ["set a wrinkle"; 4]);
    window.get_by_role_and_label(Role::CheckBox, "Wrinkle").click_accesskit();
    window.run_steps(4);
    assert_eq!(wrinkle(&window), None);
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(wrinkle(&window).is_some());
    let recording = window.state_mut().as_mut().expect("the app").recording();
    assert!(recording.contains("set_wrinkle"), "it is recorded");
}

#[test]
fn a_wrinkle_is_in_the_menu_for_lines_inside_pieces() {
    let mut window = window_on(detailed());
    press(&mut window, Key::A);
    let line = place(&window, "A, line 1");
    click(&mut window, line);
    choose_beside_box(&mut window, "Wrinkle");
    let trims = |window: &Window| piece(&pattern(window), "A").lines[0].edges[0].trims;
    assert_eq!(trims(&window).wrinkle, Some(Wrinkle::USUAL));
    key(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(trims(&window).is_none());
    let edge = place(&window, "A, edge 1:");
    click(&mut window, edge);
    assert!(window.query_by_role_and_label(egui::accesskit::Role::CheckBox, "Wrinkle").is_none());
}

/// The texts on the table that name a piece or an angle of a fold line, and their places.
fn texts_on_table(window: &Window) -> Vec<(String, egui::Rect)> {
    let names: Vec<String> = pattern(window).pieces.values().map(|piece| piece.name.clone()).collect();
    let pane = window.get_by_label("Pattern pane").rect();
    let on_table = window.output().shapes.iter().filter(|shape| {
        let clip = shape.clip_rect;
        (clip.min - pane.min).length() < 2.0 && (clip.max - pane.max).length() < 2.0
    });
    let texts = on_table.filter_map(|shape| {
        let egui::Shape::Text(text) = &shape.shape else { return None };
        let words = text.galley.text().to_owned();
        let is_label = words.ends_with('°') || names.iter().any(|name| words.starts_with(name.as_str()));
        is_label.then(|| (words, shape.shape.visual_bounding_rect()))
    });
    texts.collect()
}

fn sample_window(sample: toile::session::samples::Sample) -> Window {
    let mut window = crate::window_on(sample.project(&toile::body::mannequin::default()), None);
    window.run_steps(4);
    window
}

#[test]
fn names_and_angles_on_narrow_pieces_do_not_cover_each_other() {
    use toile::session::samples::Sample;
    for sample in [Sample::PleatedSkirt, Sample::Coat, Sample::Tshirt] {
        let window = sample_window(sample);
        let (texts, pieces) = (texts_on_table(&window), pattern(&window).pieces.len());
        for (i, (words, place)) in texts.iter().enumerate() {
            for (other, taken) in &texts[..i] {
                assert!(!place.intersects(*taken), "{sample:?}: {words} covers {other}");
            }
        }
        let named = texts.iter().filter(|(words, _)| !words.ends_with('°')).count();
        assert!(2 * named >= pieces, "{sample:?}: {named} of {pieces} pieces are named");
    }
}

#[test]
fn names_are_no_longer_than_their_pieces_and_cover_no_other_piece() {
    use toile::session::samples::Sample;
    for sample in [Sample::Shirt, Sample::CampShirt, Sample::PleatedSkirt] {
        let window = sample_window(sample);
        let on_screen = |piece: &toile::pattern::Piece| {
            let outline = piece.flattened(1e-3).into_iter();
            let placed = outline.map(|p| app(&window).on_screen(piece.pose.plane_from_piece(p)));
            placed.map(|p| p.expect("it was drawn")).collect::<Vec<egui::Pos2>>()
        };
        let names = texts_on_table(&window);
        for piece in pattern(&window).pieces.values() {
            let outline = on_screen(piece);
            let bounds = egui::Rect::from_points(&outline);
            for (words, place) in names.iter().filter(|(words, _)| !words.ends_with('°')) {
                let words_of_piece = words.split(" · ").next().unwrap_or_default();
                if words_of_piece != piece.name {
                    assert!(!is_in(&outline, place.center()), "{sample:?}: {words} is on {}", piece.name);
                } else if place.width() > place.height() {
                    assert!(place.width() <= bounds.width(), "{sample:?}: {words} is longer");
                } else {
                    assert!(place.height() <= bounds.height(), "{sample:?}: {words} is longer");
                }
            }
        }
    }
}

/// Whether `p` is in a closed polygon: whether a ray from it crosses an odd number of sides.
fn is_in(polygon: &[egui::Pos2], p: egui::Pos2) -> bool {
    let next = polygon.iter().cycle().skip(1);
    let crossed = polygon
        .iter()
        .zip(next)
        .filter(|(a, b)| (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x));
    crossed.count() % 2 == 1
}

/// The area of the text at the lower left corner of the pane: the position of the pointer.
fn position_told(window: &Window, pane: Rect) -> Option<Rect> {
    let corner = Rect::from_min_max(pane.left_bottom() - Vec2::Y * 30.0, pane.left_bottom() + Vec2::X * 20.0);
    window.output().shapes.iter().find_map(|clipped| match &clipped.shape {
        egui::Shape::Text(text) if text.galley.text().ends_with(" cm") => {
            Some(text.visual_bounding_rect()).filter(|rect| corner.intersects(*rect))
        }
        _ => None,
    })
}

#[test]
fn messages_leave_the_position_of_the_pointer_free() {
    for with_log in [false, true] {
        let mut window = window_on(squares());
        if with_log {
            crate::from_menu(&mut window, "View", "Messages");
        }
        key(&mut window, Modifiers::NONE, Key::D);
        let pane = window.get_by_label("Pattern pane").rect();
        move_to(&mut window, pane.center_top() + Vec2::Y * 40.0);
        window.run_steps(3);
        let told = window.get_all_by_label_contains("There is no cloth on the body.");
        let message = told.map(|label| label.rect()).min_by(|a, b| a.top().total_cmp(&b.top()));
        let (message, place) = (message.expect("it is told"), position_told(&window, pane).expect("a place"));
        assert!(!message.expand(6.0).intersects(place), "{message} over {place}");
    }
}
