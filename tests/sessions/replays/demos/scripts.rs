//! What the hand does in each demo, and what must come of it.

use glam::{DVec2, DVec3};
use toile::drag::DragMode;
use toile::session::Command;
use toile::session::demos::Demo;
use toile::session::samples::Sample;
use toile::wrap::ClothSide;

use super::stage::{At, Stage, heading, paint_body, paint_cloth, round, straight, turned};
use super::walks;

/// Plays `demo` to its end.
pub fn play(demo: Demo) -> Stage {
    match demo {
        Demo::Drafting => walks::drafting(),
        Demo::Fitting => walks::fitting(),
        Demo::Drawing => walks::drawing(),
        Demo::Creature => walks::creature(),
        Demo::Grading => walks::grading(),
        Demo::Posing => walks::posing(),
        Demo::Finishing => walks::finishing(),
        Demo::Colourways => walks::colourways(),
        Demo::Cutting => walks::cutting(),
        Demo::Export => walks::export(),
        Demo::Wrapping => wrapping(),
        Demo::Dragging => dragging(),
        Demo::Rewrapping => rewrapping(),
        Demo::Rewearing => rewearing(),
        Demo::Laser => laser(),
        Demo::Scarf => scarf(),
        Demo::Modes => modes(),
        Demo::Pins => pins(),
    }
}

fn wrapping() -> Stage {
    let (mut stage, marks) = Stage::bare(Sample::Tshirt);
    marks.pairs().for_each(|(cloth, body)| stage.paint_pair(cloth, body));
    stage.give(Command::Wrap);
    stage.rest();
    stage
}

fn scarf() -> Stage {
    let (mut stage, marks) = Stage::bare(Sample::Scarf);
    marks.pairs().for_each(|(cloth, body)| stage.paint_pair(cloth, body));
    stage.give(Command::Wrap);
    stage.rest();
    stage
}

/// The back pieces are laid face down under the front ones, as when cloth is cut double.
fn laser() -> Stage {
    let (mut stage, marks) = Stage::bare(Sample::Dress);
    for (front, back) in [("bodice front", "bodice back"), ("skirt front", "skirt back")] {
        let [front, back] = [front, back].map(|name| stage.piece(name));
        let pose = stage.session.document().pattern.pieces[&front].pose;
        let pose = toile::pattern::PlanePose { flipped: true, ..pose };
        stage.give(Command::SetPiecePose { piece: back, pose });
    }
    stage.give_together(marks.cloth.iter().map(paint_cloth));
    stage.give_together(marks.body.iter().map(paint_body));
    stage.give(Command::Wrap);
    stage.rest();
    stage
}

fn dragging() -> Stage {
    let mut stage = Stage::dressed(Sample::Dress);
    let [front, back] = ["skirt front", "skirt back"].map(|name| (stage.piece(name), DVec2::new(0.0, -0.35)));
    let shoulder: At = (stage.piece("bodice front"), DVec2::new(0.14, 0.22));
    let behind = heading(stage.place(back));
    let turn_behind = |stage: &Stage| turned(heading(stage.place(back)), behind).abs();
    stage.drag(front, DragMode::Vertex, 70, round(0.5));
    let by_vertex = turn_behind(&stage);
    stage.run(30);
    stage.give(Command::Undo);
    stage.pin(shoulder);
    let held = stage.place(shoulder);
    stage.drag(front, DragMode::Surface, 70, round(0.5));
    let (by_surface, gave) = (turn_behind(&stage), stage.place(shoulder).distance(held));
    println!(
        "dragging: back turned by vertex {by_vertex:.3}, by surface {by_surface:.3}; pin gave {gave:.4}"
    );
    assert!(by_surface > 3.0 * by_vertex && by_surface > 0.15);
    assert!(gave < 0.012, "the pin gave way");
    stage
}

fn rewrapping() -> Stage {
    let mut stage = Stage::dressed(Sample::Scarf);
    let piece = stage.piece("scarf");
    let at = |x: f64, y: f64| -> At { (piece, DVec2::new(x, y)) };
    for y in [-0.04, 0.0, 0.04] {
        stage.pin(at(0.10, y));
    }
    let (end, other) = (stage.place(at(0.84, 0.0)), stage.place(at(-0.60, 0.0)));
    let points = vec![DVec2::new(0.26, 0.0), DVec2::new(0.72, 0.0)];
    println!("rewrapping: from {:.3}", stage.place(at(0.10, 0.0)));
    stage.give(Command::AddClothMark { piece, side: ClothSide::Front, points });
    let marks = stage.session.document().marks.clone();
    let right = -marks.body[0].points[0].x.signum();
    let corners = [(0.19, 1.47), (0.30, 1.36), (0.52, 1.12)].map(|(x, y)| DVec3::new(right * x, y, 0.0));
    let points = stage.stroke(&corners);
    stage.give(Command::AddBodyMark { points });
    let pairs = vec![stage.session.document().marks.pairs().count()];
    stage.give(Command::Rewrap { pairs });
    stage.rest();
    let (moved, stayed) =
        (stage.place(at(0.84, 0.0)).distance(end), stage.place(at(-0.60, 0.0)).distance(other));
    println!("rewrapping: end {end:.3} moved {moved:.3}, the other {stayed:.4}");
    assert!(moved > 0.2 && stayed < 0.01);
    stage
}

fn rewearing() -> Stage {
    let mut stage = Stage::dressed(Sample::Scarf);
    let piece = stage.piece("scarf");
    let middle: At = (piece, DVec2::ZERO);
    let nape = stage.place(middle);
    let points = vec![DVec2::new(-0.55, 0.0), DVec2::new(0.55, 0.0)];
    stage.give(Command::AddClothMark { piece, side: ClothSide::Front, points });
    let corners = [
        DVec3::new(-0.10, 1.02, 0.3),
        DVec3::new(0.13, 1.40, 0.2),
        DVec3::new(0.13, 1.60, 0.0),
        DVec3::new(0.13, 1.40, -0.3),
        DVec3::new(-0.10, 1.02, -0.3),
    ];
    let points = stage.stroke(&corners);
    stage.give(Command::AddBodyMark { points });
    let pairs = vec![stage.session.document().marks.pairs().count()];
    stage.give(Command::Rewrap { pairs });
    stage.rest();
    println!("middle from {nape:.3} to {:.3}", stage.place(middle));
    assert!(stage.place(middle).distance(nape) > 0.05);
    stage
}

fn modes() -> Stage {
    let mut stage = Stage::dressed(Sample::Skirt);
    let [front, back] = ["skirt front", "skirt back"].map(|name| (stage.piece(name), DVec2::new(0.0, -0.3)));
    let (behind, ahead) = (heading(stage.place(back)), heading(stage.place(front)));
    let mut went = Vec::new();
    for mode in [DragMode::Vertex, DragMode::Rigid, DragMode::Surface] {
        stage.drag(front, mode, 75, round(0.55));
        went.push([(front, ahead), (back, behind)].map(|(at, was)| turned(heading(stage.place(at)), was)));
        if mode != DragMode::Surface {
            stage.run(30);
            stage.give(Command::Undo);
        }
    }
    println!("front and back turned by {went:.3?}");
    assert!(went[2][1] > 0.3, "surface dragging turns the back, too: {went:?}");
    let [point, _, surface] = [went[0], went[1], went[2]];
    assert!(point[1] < 0.5 * point[0], "a dragged point takes the back half as far at most: {went:?}");
    assert!(point[1] < 0.25 * surface[1], "and far less than surface dragging does: {went:?}");
    stage
}

fn pins() -> Stage {
    let mut stage = Stage::dressed(Sample::Skirt);
    let [front, back] = ["skirt front", "skirt back"].map(|name| stage.piece(name));
    let middle = |piece| (piece, DVec2::new(0.0, -0.3));
    stage.drag(middle(front), DragMode::Surface, 60, round(0.4));
    let low = stage.place(middle(front)).y;
    stage.drag(middle(front), DragMode::Surface, 50, straight(DVec3::Y * 0.06));
    let high = stage.place(middle(front)).y;
    let held: [At; 2] = [-0.10, 0.10].map(|x| (back, DVec2::new(x, -0.3)));
    held.into_iter().for_each(|at| stage.pin(at));
    let before = held.map(|at| stage.place(at));
    let ahead = heading(stage.place(middle(front)));
    stage.drag(middle(front), DragMode::Surface, 60, round(-0.4));
    let moved = [0, 1].map(|i| stage.place(held[i]).distance(before[i]));
    let turn = turned(heading(stage.place(middle(front))), ahead);
    println!("up {:.3}, pins moved {moved:.4?}, front turned {turn:.3}", high - low);
    assert!(high > low + 0.02 && turn < -0.1);
    assert!(moved.iter().all(|&m| m < 0.012), "{moved:?}");
    stage
}
