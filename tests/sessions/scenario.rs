//! What one person did with the small scene.

use glam::DVec2;
use toile::geometry::ids::PieceId;
use toile::relax::RelaxSettings;
use toile::session::{Command, Session, Settings};
use toile::wrap::ClothSide;

use crate::common::{line_on_ball, run};

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
