//! What a picture of a session shows, in the window and without one.

use std::path::{Path, PathBuf};

use crate::render::{Scene, View};
use crate::session::Session;
use crate::ui::scene::{Scenery, Shown};

/// The body and the cloth on it; where `marks` or nothing is dressed yet also the marks, where `pins` the pins.
pub fn portrait(scenery: &mut Scenery, session: &Session, marks: bool, pins: bool) -> Scene {
    let snapshot = session.snapshot();
    let dressed = snapshot.is_dressed();
    scenery.scene(&Shown {
        body: snapshot.body.as_ref().filter(|_| dressed).or(session.surface()),
        cloth: snapshot.drawn().filter(|_| dressed),
        marks: (marks || !dressed).then_some(&session.document().marks),
        pinned: if pins { &snapshot.pinned } else { &[] },
        ..Shown::default()
    })
}

/// From where picture `i` of `count` in a full turn is taken, beginning at `first`.
pub fn turned(first: View, i: u32, count: u32) -> View {
    let (yaw, pitch) = first.angles();
    View::Angles { yaw: yaw.to_degrees() + 360.0 * i as f32 / count as f32, pitch: pitch.to_degrees() }
}

/// "a/b.png" becomes "a/b-07.png", with as many digits as the last of `count` needs.
pub fn numbered(path: &Path, i: u32, count: u32) -> PathBuf {
    let digits = count.saturating_sub(1).to_string().len().max(2);
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push(format!("-{i:0digits$}"));
    if let Some(extension) = path.extension() {
        name.push(".");
        name.push(extension);
    }
    path.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_is_numbered_and_goes_all_the_way_round() {
        assert_eq!(numbered(Path::new("a/b.png"), 7, 36), Path::new("a/b-07.png"));
        assert_eq!(numbered(Path::new("a/b.png"), 7, 360), Path::new("a/b-007.png"));
        let View::Angles { yaw, pitch } = turned(View::Left, 9, 36) else { panic!("angles") };
        assert!((yaw - 180.0).abs() < 1e-3 && pitch.abs() < 1e-6);
    }
}
