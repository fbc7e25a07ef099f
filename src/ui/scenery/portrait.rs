//! The contents of pictures of a session, with and without a window.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::pattern::activity::Activity;
use crate::render::{Rgb, Scene, View};
use crate::session::{Dyes, Outfit, Session};
use crate::ui::scenery::body_look::BodyLook;
use crate::ui::scenery::fabric_looks::{looks_of, piece_looks};
use crate::ui::scenery::scene::{Scenery, Shown};

/// Optional contents of a picture of a session.
#[derive(Clone, Copy, Debug, Default)]
pub struct Extras<'a> {
    /// Draw marks also where the cloth is on the body.
    pub marks: bool,
    /// Draw pins.
    pub pins: bool,
    /// Colours of a map, one for each vertex of the cloth; None: the cloth's own colours.
    pub map: Option<&'a Arc<Vec<Rgb>>>,
    /// How the body is shown.
    pub body_look: BodyLook,
    /// Draw seams as lines alone, without stitches.
    pub plain_seams: bool,
}

/// The scene of a session: the body and the cloth, with frozen and deactivated pieces in their colours; where nothing is dressed
/// yet also the marks.
pub fn portrait(scenery: &mut Scenery, session: &Session, extras: Extras<'_>) -> Scene {
    let snapshot = session.snapshot();
    let dressed = snapshot.is_dressed();
    let activities = session.document().pattern.activities();
    let whole = snapshot.garment.as_ref().map(|garment| (garment, &snapshot.cloth));
    let looks = Arc::new(looks_of(session.document()));
    scenery.scene(&Shown {
        body: snapshot.body.as_ref().filter(|_| dressed).or(session.surface()),
        cloth: snapshot.drawn().filter(|_| dressed),
        pattern: Some(&session.document().pattern),
        marks: (extras.marks || !dressed).then_some(&session.document().marks),
        activities: Some(&activities),
        looks: Some(&looks),
        whole: whole.filter(|_| dressed && activities.values().any(Activity::is_deactivated)),
        map: extras.map,
        body_look: extras.body_look,
        plain_seams: extras.plain_seams,
        pinned: if extras.pins { &snapshot.pinned } else { &[] },
        ..Shown::default()
    })
}

/// The scene of `outfit` on its body, in `colours` of a map, one for each vertex, or in its own; deactivated pieces are pale.
pub fn worn_scene(scenery: &mut Scenery, outfit: &Outfit, colours: Option<&Arc<Vec<Rgb>>>) -> Scene {
    let looks =
        Arc::new(piece_looks(&outfit.source.pattern, |piece| outfit.fabrics.get(&piece), &Dyes::default()));
    scenery.scene(&Shown {
        body: Some(&outfit.body),
        cloth: Some((&outfit.garment, &outfit.state)),
        pattern: Some(&outfit.source.pattern),
        activities: Some(&outfit.source.pattern.activities()),
        looks: Some(&looks),
        whole: outfit.whole.as_ref().map(|(garment, state)| (garment, state)),
        map: colours,
        ..Shown::default()
    })
}

/// The view of picture `i` of `count` in a full turn that begins at `first`.
pub fn turned(first: View, i: u32, count: u32) -> View {
    let (yaw, pitch) = first.angles();
    View::Angles { yaw: yaw.to_degrees() + 360.0 * i as f32 / count as f32, pitch: pitch.to_degrees() }
}

/// A numbered file name: "a/b.png" becomes "a/b-07.png", with as many digits as the last of `count` needs.
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
    use crate::body::mannequin;
    use crate::pattern::edit::PatternEdit;
    use crate::render::CLOTH_FRONT;
    use crate::session::Command;
    use crate::session::samples::Sample;
    use crate::sim::{Runner, Simulation};

    #[test]
    fn a_deactivated_piece_is_shown_pale() {
        let project = Sample::Skirt.project(&mannequin::default());
        let mut session = Session::new(project, Runner::inline(Simulation::default()));
        session.apply_alone(Command::Wrap).expect("wrapped");
        while session.runner().simulation().is_some_and(Simulation::tick) {}
        session.update();
        let pale = |session: &Session| {
            let scene = portrait(&mut Scenery::default(), session, Extras::default());
            let is_pale = |own: [u8; 3]| own.iter().zip(CLOTH_FRONT).all(|(pale, usual)| *pale > usual);
            let vertices = session.snapshot().drawn().map_or(0, |(garment, _)| garment.vertex_count);
            // Rims have vertices of their own.
            let cloth =
                scene.meshes.iter().filter(|mesh| mesh.cloth > 0.0 && mesh.positions.len() == vertices);
            cloth.map(|mesh| (is_pale(mesh.front), mesh.triangles.len())).collect::<Vec<_>>()
        };
        let [(false, all)] = pale(&session)[..] else { panic!("one mesh of cloth") };
        let piece = session.document().pattern.pieces.keys().next().copied().expect("a piece");
        let edits = vec![PatternEdit::SetActivity { pieces: vec![piece], activity: Activity::Deactivated }];
        session.apply_alone(Command::EditPattern { edits, anew: false }).expect("deactivated");
        session.update();
        let [(false, active), (true, asleep)] = pale(&session)[..] else { panic!("two meshes of cloth") };
        assert!(active > 0 && asleep > 0 && active + asleep == all, "{active} {asleep} {all}");
        let outfit = Outfit::of(session.snapshot(), &session.document().fabrics).expect("dressed");
        let red = Arc::new(vec![[200, 0, 0]; outfit.garment.vertex_count]);
        let scene = worn_scene(&mut Scenery::default(), &outfit, Some(&red));
        let cloth = scene.meshes.iter().filter(|mesh| mesh.cloth > 0.0);
        let inked: Vec<bool> = cloth.map(|mesh| mesh.colours.first() == Some(&[200, 0, 0])).collect();
        assert_eq!(inked, [true, false], "a map is over what counts");
    }

    #[test]
    fn a_turn_is_numbered_and_goes_all_the_way_round() {
        assert_eq!(numbered(Path::new("a/b.png"), 7, 36), Path::new("a/b-07.png"));
        assert_eq!(numbered(Path::new("a/b.png"), 7, 360), Path::new("a/b-007.png"));
        let View::Angles { yaw, pitch } = turned(View::Left, 9, 36) else { panic!("angles") };
        assert!((yaw - 180.0).abs() < 1e-3 && pitch.abs() < 1e-6);
    }
}
