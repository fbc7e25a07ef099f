//! Images and graphics: commands, undo, recordings, project files.

use std::sync::Arc;

use glam::DVec2;
use toile::geometry::ids::{GraphicId, ImageId, PieceId};
use toile::pattern::edit::PatternEdit;
use toile::session::recording::Recording;
use toile::session::replay::Replay;
use toile::session::{Artwork, Command, Dye, Graphic, ImageFile, Project, Repeated, Session, project_file};

use crate::common::{project, session};

/// A PNG of 8 x 4 pixels.
fn png() -> Vec<u8> {
    let picture = image::RgbaImage::from_pixel(8, 4, image::Rgba([200, 30, 40, 255]));
    toile::render::png(&picture).expect("a file")
}

fn add_image() -> Command {
    Command::AddImage { file: Arc::new(ImageFile::new("logo.png", png())) }
}

fn graphic() -> Graphic {
    let at = DVec2::new(0.1, 0.2);
    Graphic { piece: PieceId(1), image: ImageId(1), at, width_m: 0.05, angle: 0.3, on_twin: false }
}

fn surface() -> Dye {
    Dye { image: Some(Repeated { image: ImageId(1), width_m: 0.04, angle: 0.0 }), ..Dye::default() }
}

/// A session with an image, on a piece and all over the cloth.
fn with_art() -> Session {
    let mut s = session();
    let commands = [
        add_image(),
        Command::AddGraphic { graphic: graphic() },
        Command::SetDye { piece: None, dye: surface() },
    ];
    commands.into_iter().for_each(|command| s.apply_alone(command).expect("accepted"));
    s
}

fn art(s: &Session) -> Artwork {
    Artwork::clone(&s.document().artwork)
}

#[test]
fn images_and_graphics_are_added_changed_and_undone() {
    let mut s = with_art();
    let id = *art(&s).graphics.keys().next().expect("a graphic");
    assert_eq!(id, GraphicId(2));
    let moved = Graphic { at: DVec2::new(0.2, 0.1), ..graphic() };
    s.apply_alone(Command::SetGraphic { id, graphic: moved }).expect("moved");
    assert_eq!(art(&s).graphics[&id], moved);
    assert_eq!(s.undo_label(), Some("change the graphic"));
    s.apply_alone(Command::Undo).expect("undone");
    assert_eq!(art(&s).graphics[&id], graphic());
    s.apply_alone(Command::KeepColourway { name: "red".to_owned() }).expect("kept");
    s.apply_alone(Command::DeleteImage { image: ImageId(1) }).expect("deleted");
    let document = s.document();
    assert!(
        art(&s).graphics.is_empty() && document.dyes.is_plain() && document.colourways[0].dyes.is_plain()
    );
    for _ in 0..5 {
        s.apply_alone(Command::Undo).expect("undone");
    }
    assert!(art(&s).is_empty());
    s.apply_alone(Command::Redo).expect("redone");
    assert_eq!(art(&s).images[&ImageId(1)].name, "logo.png");
}

#[test]
fn what_is_no_image_or_has_no_place_is_refused_and_leaves_no_trace() {
    let mut s = session();
    let bad = Command::AddImage { file: Arc::new(ImageFile::new("notes.txt", b"words".to_vec())) };
    assert!(s.apply_alone(bad).expect_err("no image").0.contains("notes.txt: it is neither PNG nor JPEG"));
    assert!(s.apply_alone(Command::AddGraphic { graphic: graphic() }).is_err(), "no such image");
    assert!(s.apply_alone(Command::SetDye { piece: None, dye: surface() }).is_err(), "no such image");
    s.apply_alone(add_image()).expect("an image");
    for (wrong, words) in [
        (Graphic { piece: PieceId(77), ..graphic() }, "piece that is not there"),
        (Graphic { width_m: f64::NAN, ..graphic() }, "wide"),
        (Graphic { at: DVec2::new(0.0, 1e9), ..graphic() }, "origin"),
    ] {
        let why = s.apply_alone(Command::AddGraphic { graphic: wrong }).expect_err("refused").0;
        assert!(why.contains(words), "{why}");
    }
    assert!(s.apply_alone(Command::DeleteGraphic { id: GraphicId(5) }).is_err());
    assert_eq!(art(&s).last, 1, "what was refused took no number");
}

#[test]
fn a_recording_with_images_replays_to_the_same_hashes() {
    let mut s = with_art();
    let mut replay = Replay::new(Recording::parse(&s.recording()).expect("a recording"));
    replay.run().expect("the same document");
    assert!(replay.hashes_compared() >= 3);
}

#[test]
fn the_project_file_keeps_images_whole_even_those_that_cannot_be_read() {
    let mut kept = with_art().project();
    let read =
        |project: &Project| project_file::from_bytes(&project_file::to_bytes(project).expect("written"));
    assert_eq!(read(&kept).expect("read"), kept);
    let artwork = Arc::make_mut(&mut kept.document.artwork);
    artwork.images.insert(ImageId(1), Arc::new(ImageFile::new("logo.png", png()[..40].to_vec())));
    let damaged = read(&kept).expect("the image alone is damaged");
    assert_eq!(damaged, kept);
    let told: Vec<_> = damaged.document.artwork.unreadable().collect();
    assert!(told.len() == 1 && told[0].0 == "logo.png", "{told:?}");
    // What no command would accept is refused.
    Arc::make_mut(&mut kept.document.artwork)
        .graphics
        .insert(GraphicId(2), Graphic { width_m: 0.0, ..graphic() });
    let why = read(&kept).expect_err("no width").to_string();
    assert!(why.contains("graphic is 0 m wide"), "{why}");
}

#[test]
fn graphics_follow_their_piece_and_go_with_it() {
    let mut s = with_art();
    let id = GraphicId(2);
    let edit = PatternEdit::Scale { pieces: vec![PieceId(1)], about: DVec2::ZERO, factor: DVec2::splat(2.0) };
    s.apply_alone(Command::EditPattern { edits: vec![edit], anew: false }).expect("scaled");
    let after = art(&s).graphics[&id];
    assert!(after.at.distance(graphic().at * 2.0) < 1e-9 && (after.width_m - 0.1).abs() < 1e-9, "{after:?}");
    s.apply_alone(Command::DeletePiece { piece: PieceId(1) }).expect("deleted");
    assert!(art(&s).graphics.is_empty() && art(&s).images.len() == 1);
    s.apply_alone(Command::Undo).expect("undone");
    assert_eq!(art(&s).graphics.len(), 1);
}

#[test]
fn a_document_without_images_hashes_as_before() {
    let project = project();
    let text = String::from_utf8(project_file::to_bytes(&project_file_of(&project)).expect("written"));
    assert!(!text.expect("plain").contains("artwork"), "nothing of images is written");
}

/// The project on the usual body, so that its file is plain text.
fn project_file_of(project: &toile::session::Project) -> toile::session::Project {
    let mut plain = project.clone();
    plain.document.body = Default::default();
    plain
}
