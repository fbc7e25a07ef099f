//! Marks that are proposed: seen in both panes, and accepted, dismissed, or moved with the skin.

use toile::body::NamedPose;
use toile::session::samples::Sample;
use toile::ui::actions::Action;

use super::*;

/// The square, said to hang before the ball.
fn placed() -> Project {
    let mut project = project();
    let pattern = Arc::make_mut(&mut project.document.pattern);
    for piece in pattern.pieces.values_mut() {
        let placement = SpacePose::flat(DVec3::new(0.0, 0.0, 0.4), DQuat::IDENTITY);
        let piece = Arc::make_mut(piece);
        piece.placement = Some(placement);
    }
    project
}

#[test]
fn proposed_marks_are_seen_and_accepted_or_dismissed() {
    let mut window = window_on(placed(), None);
    let suggest = |window: &mut Window| {
        window.get_by_label("Edit").click();
        window.run_steps(3);
        window.get_by_label("Suggest marks").click();
        window.run_steps(3);
    };
    suggest(&mut window);
    for side in ["cloth", "body"] {
        assert!(window.query_by_label(&format!("Proposed mark 1 on the {side}")).is_some(), "{side}");
    }
    assert!(!app(&window).session().is_modified(), "ghosts are not in the document");
    key(&mut window, Modifiers::NONE, Key::Escape);
    assert!(window.query_by_label("Accept").is_none());
    assert_eq!(counts(&window), [0, 0]);
    for by_key in [true, false] {
        suggest(&mut window);
        if by_key {
            key(&mut window, Modifiers::NONE, Key::Enter);
        } else {
            window.get_by_label("Accept").click();
            window.run_steps(3);
        }
        let [cloth, body] = counts(&window);
        assert!(cloth > 0 && cloth == body, "{cloth} on the cloth, {body} on the body");
        assert!(window.query_by_label_contains("Proposed").is_none());
        assert_eq!(app(&window).session().step_labels().collect::<Vec<_>>(), ["replace all marks"]);
        key(&mut window, Modifiers::COMMAND, Key::Z);
    }
}

/// By hand they would have to be proposed again for each pose that is looked at.
#[test]
fn proposed_marks_stay_on_the_skin_in_another_pose() {
    let sample = Sample::Tshirt.usual();
    let mut document = sample.document.clone();
    document.take_marks(Arc::default());
    let mut window = window_on(Project { document, dressed: None }, None);
    let put = |window: &mut Window, actions: &[Action]| {
        edit(window, |app, ctx| actions.iter().for_each(|action| app.act(ctx, *action)));
    };
    put(&mut window, &[Action::SuggestMarks]);
    let labels = |window: &Window| window.query_all_by_label_contains("Proposed mark").count();
    let count = labels(&window);
    assert!(count > 0);
    put(&mut window, &[Action::Pose(NamedPose::Sitting)]);
    wait(&mut window, "the pose", |app| matches!(app.session().document().body, BodyChoice::Posed { .. }));
    assert_eq!(labels(&window), count, "none is lost");
    put(&mut window, &[Action::AcceptMarks]);
    let session = app(&window).session();
    let body = session.surface().expect("a body");
    let marks = &session.document().marks;
    assert!(!marks.body.is_empty());
    for point in marks.body.iter().flat_map(|mark| &mark.points) {
        assert!(body.nearest(*point).distance.abs() < 1e-3, "{point} is off the skin");
    }
}
