//! What one person did with the small scenes.

use glam::{DVec2, DVec3};
use toile::geometry::ids::PieceId;
use toile::pattern::activity::Activity;
use toile::pattern::edit::PatternEdit;
use toile::relax::RelaxSettings;
use toile::session::{Command, Session, Settings};
use toile::wrap::ClothSide;

use crate::common::{line_on_ball, run};

/// On a front and a back that are a tube: one stroke through both, one through the body, wrap.
pub fn laser(s: &mut Session) {
    let at = |y: f64| vec![DVec2::new(0.2, y - 0.03), DVec2::new(0.2, y + 0.03)];
    let cloth =
        |piece| Command::AddClothMark { piece: PieceId(piece), side: ClothSide::Front, points: at(0.06) };
    let skin = |side: f64, y: f64| DVec3::new(0.0, y, side * (0.12_f64.powi(2) - y * y).sqrt());
    let body = |side| Command::AddBodyMark { points: [-0.03, 0.0, 0.03].map(|y| skin(side, y)).to_vec() };
    for commands in [[cloth(1), cloth(2)], [body(1.0), body(-1.0)]] {
        let gesture = s.begin_gesture();
        commands.into_iter().for_each(|command| s.apply(command, gesture).expect("painted"));
        s.end_gesture(gesture);
    }
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(s, 2000);
}

/// One of two patches is frozen, the other drapes from it; then both drape.
pub fn frozen(s: &mut Session) {
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(s, 2000);
    for activity in [Activity::Frozen, Activity::Active] {
        let edits = vec![PatternEdit::SetActivity { pieces: vec![PieceId(1)], activity }];
        s.apply_alone(Command::EditPattern { edits, anew: false }).expect("set");
        s.apply_alone(Command::SetDraping { on: true }).expect("draped");
        run(s, 40);
    }
    s.apply_alone(Command::SetDraping { on: false }).expect("paused");
}

/// A little of everything, with ticks between.
pub fn play(s: &mut Session) {
    let points = vec![DVec2::new(0.05, 0.05), DVec2::new(0.2, 0.05)];
    s.apply_alone(Command::AddClothMark { piece: PieceId(1), side: ClothSide::Front, points })
        .expect("painted");
    s.apply_alone(Command::AddBodyMark { points: line_on_ball(0.75, 0.05, 0.075) }).expect("painted");
    s.apply_alone(Command::Wrap).expect("wrapped");
    run(s, 4);
    s.apply_alone(Command::RenamePiece { piece: PieceId(1), name: "front".to_owned() }).expect("renamed");
    run(s, 2000);
    let relax = RelaxSettings { gravity: 0.001, ..RelaxSettings::default() };
    s.apply_alone(Command::SetSettings { settings: Settings { relax, ..s.document().settings } })
        .expect("set");
    run(s, 7);
    s.apply_alone(Command::Undo).expect("undone");
    s.apply_alone(Command::Redo).expect("redone");
    run(s, 2000);
}
