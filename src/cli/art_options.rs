//! Command line options of images: all over the cloth, and as graphics on pieces.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use clap::Args;
use glam::DVec2;

use crate::cli::failure::Failure;
use crate::cli::files;
use crate::geometry::ids::{ImageId, PieceId};
use crate::session::{Command, Dye, Graphic, ImageFile, Repeated, Session};

/// Options of images.
#[derive(Clone, Debug, Default, Args)]
pub struct ArtOptions {
    /// An image (PNG, JPEG) all over the pieces that have none of their own, and the width of a repeat in millimetres
    #[arg(long, value_name = "FILE:WIDTH_MM", value_parser = repeated)]
    pub image: Option<RepeatedFile>,
    /// An image (PNG, JPEG) on a piece: the piece's name or number, the middle in metres of the piece's own plane, the width in
    /// metres and, if given, the angle in degrees, counter-clockwise; several times for several
    #[arg(long = "graphic", value_name = "FILE:PIECE:X,Y:WIDTH[:ANGLE]", value_parser = placed)]
    pub graphics: Vec<PlacedFile>,
}

/// An image file all over the cloth.
#[derive(Clone, Debug, PartialEq)]
pub struct RepeatedFile {
    file: PathBuf,
    width_m: f64,
}

/// An image file at a place of a piece.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedFile {
    file: PathBuf,
    piece: String,
    at: DVec2,
    width_m: f64,
    angle: f64,
}

impl ArtOptions {
    /// The files that it names.
    pub fn files(&self) -> impl Iterator<Item = &PathBuf> {
        self.image.iter().map(|own| &own.file).chain(self.graphics.iter().map(|own| &own.file))
    }

    /// The file of the image all over the cloth.
    pub fn image_file_mut(&mut self) -> Option<&mut PathBuf> {
        self.image.as_mut().map(|own| &mut own.file)
    }

    /// The files of the graphics.
    pub fn graphic_files_mut(&mut self) -> impl Iterator<Item = &mut PathBuf> {
        self.graphics.iter_mut().map(|own| &mut own.file)
    }

    /// Takes the images into `session`.
    pub fn choose(&self, session: &mut Session) -> Result<(), Failure> {
        if let Some(RepeatedFile { file, width_m }) = &self.image {
            let image = take(session, file)?;
            let repeated = Repeated { image, width_m: *width_m, angle: 0.0 };
            let dye = Dye { image: Some(repeated), ..session.document().dyes.all };
            apply(session, Command::SetDye { piece: None, dye })?;
        }
        for PlacedFile { file, piece, at, width_m, angle } in &self.graphics {
            let piece = find_piece(session, piece)?;
            refuse_beside(session, piece, file, (*at, *width_m))?;
            let image = take(session, file)?;
            let graphic = Graphic { piece, image, at: *at, width_m: *width_m, angle: *angle, on_twin: false };
            apply(session, Command::AddGraphic { graphic })?;
        }
        Ok(())
    }
}

fn apply(session: &mut Session, command: Command) -> Result<(), Failure> {
    session.apply_alone(command).map(drop).map_err(|why| Failure::Usage(why.0.into()))
}

/// Takes the image of a file into the document, unless it is there; its id.
fn take(session: &mut Session, path: &Path) -> Result<ImageId, Failure> {
    let name = path.file_name().map_or_else(|| "image".into(), |name| name.to_string_lossy());
    let file = Arc::new(ImageFile::new(name, files::read(path)?));
    file.picture().map_err(|why| Failure::input(path, why))?;
    let known = |session: &Session| {
        let images = &session.document().artwork.images;
        images.iter().find(|(_, other)| **other == file).map(|(id, _)| *id)
    };
    if let Some(image) = known(session) {
        return Ok(image);
    }
    apply(session, Command::AddImage { file: Arc::clone(&file) })?;
    known(session).ok_or_else(|| Failure::Internal("an image that was taken is not there".to_owned()))
}

fn find_piece(session: &Session, name: &str) -> Result<PieceId, Failure> {
    let pattern = &session.document().pattern;
    let numbered = || Some(PieceId(name.parse().ok()?)).filter(|id| pattern.pieces.contains_key(id));
    pattern.piece_named(name).or_else(numbered).ok_or_else(|| {
        let names: Vec<&str> = pattern.pieces.values().map(|piece| &*piece.name).collect();
        Failure::Usage(format!("there is no piece {name:?}; there are {}", names.join(", ")))
    })
}

/// Refuses a graphic that would not be seen: its middle is farther from the piece than it is wide.
fn refuse_beside(
    session: &Session,
    id: PieceId,
    file: &Path,
    (at, width_m): (DVec2, f64),
) -> Result<(), Failure> {
    let piece = &session.document().pattern.pieces[&id];
    let corners = piece.outline.iter().map(|edge| edge.start);
    let (low, high) = corners.fold((DVec2::MAX, DVec2::MIN), |(low, high), p| (low.min(p), high.max(p)));
    // A width that no graphic has is refused in words of its own.
    if width_m <= 0.0 || (at.clamp(low, high) - at).length() <= width_m {
        return Ok(());
    }
    Err(Failure::Usage(format!(
        "{} would lie beside {:?}, whose plane reaches from x {:.3}, y {:.3} to x {:.3}, y {:.3} m",
        file.display(),
        piece.name,
        low.x,
        low.y,
        high.x,
        high.y
    )))
}

fn number(text: &str, what: &str) -> Result<f64, String> {
    let number = text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
    number.ok_or_else(|| format!("{what} {text:?} is not a number"))
}

fn repeated(text: &str) -> Result<RepeatedFile, String> {
    let (file, width) =
        text.rsplit_once(':').ok_or_else(|| format!("{text:?} is not FILE:WIDTH_MM, as silk.png:120"))?;
    Ok(RepeatedFile { file: file.into(), width_m: number(width, "the width")? / 1e3 })
}

fn placed(text: &str) -> Result<PlacedFile, String> {
    let words = || format!("{text:?} is not FILE:PIECE:X,Y:WIDTH[:ANGLE], as logo.png:front:0.05,0.3:0.12");
    let mut parts: Vec<&str> = text.rsplitn(5, ':').collect();
    // From the end; without an angle the place comes second.
    let has_angle = parts.get(1).is_some_and(|place| !place.contains(','));
    let angle = if has_angle { number(parts.remove(0), "the angle")? } else { 0.0 };
    let [width, place, piece, ..] = parts[..] else { return Err(words()) };
    let (x, y) = place.split_once(',').ok_or_else(words)?;
    let length = [width, place, piece].iter().map(|part| part.len() + 1).sum::<usize>();
    let rest = if has_angle { &text[..text.rfind(':').unwrap_or(0)] } else { text };
    let file = rest.len().checked_sub(length).map(|end| &rest[..end]).filter(|file| !file.is_empty());
    Ok(PlacedFile {
        file: file.ok_or_else(words)?.into(),
        piece: piece.to_owned(),
        at: DVec2::new(number(x, "x")?, number(y, "y")?),
        width_m: number(width, "the width")?,
        angle: angle.to_radians(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn images_and_graphics_are_read_or_refused_in_words() {
        assert_eq!(repeated("a b.png:120"), Ok(RepeatedFile { file: "a b.png".into(), width_m: 0.12 }));
        let logo = PlacedFile {
            file: "logo.png".into(),
            piece: "front".to_owned(),
            at: DVec2::new(0.05, -0.3),
            width_m: 0.12,
            angle: 0.0,
        };
        assert_eq!(placed("logo.png:front:0.05,-0.3:0.12"), Ok(logo.clone()));
        let turned = placed("c:/logo.png:front:0.05,-0.3:0.12:90").expect("turned");
        assert_eq!((turned.file, turned.angle), ("c:/logo.png".into(), std::f64::consts::FRAC_PI_2));
        for wrong in
            ["logo.png", "logo.png:front:0.1:0.2", "a:b:c,d:1", ":front:0,0:1", "a:p:0,0:x", "a:p:0,0:1:y"]
        {
            assert!(placed(wrong).is_err(), "{wrong}");
        }
        assert!(repeated("silk.png").is_err() && repeated("silk.png:wide").is_err());
    }
}
