//! Images of a document: as the surface of a fabric, and as graphics placed on pieces.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::{Arc, OnceLock};

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use glam::{DAffine2, DVec2};
use image::RgbaImage;
use serde::{Deserialize, Serialize};

use crate::geometry::ids::{GraphicId, ImageId, PieceId};
use crate::geometry::words::{Words, words};
use crate::io::picture;

/// Range of the width of a graphic and of a repeat of an image, metres.
pub const WIDTHS: [f64; 2] = [0.001, 10.0];
/// Largest absolute coordinate of a graphic, metres.
const FARTHEST: f64 = 100.0;
/// Most images of a document.
const MOST_IMAGES: usize = 64;
/// Most bytes of all images of a document.
const MOST_BYTES: usize = 128 << 20;
/// Most graphics on one piece.
pub const MOST_ON_A_PIECE: usize = 12;
/// Largest id in a document that is read: there is room for as many more.
const LARGEST_ID: u32 = u32::MAX / 2;
/// Largest number of characters of an image's name.
const LONGEST_NAME: usize = 200;

/// A picture file as it was read, kept whole.
#[derive(Serialize, Deserialize)]
#[serde(try_from = "StoredImage", into = "StoredImage")]
pub struct ImageFile {
    /// File name, for people.
    pub name: String,
    /// Content of the file: PNG or JPEG.
    pub bytes: Vec<u8>,
    /// The picture, once it was asked for.
    picture: OnceLock<Result<Arc<RgbaImage>, Words>>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct StoredImage {
    name: String,
    base64: String,
}

impl ImageFile {
    /// A file with this content.
    pub fn new(name: impl Into<String>, bytes: Vec<u8>) -> Self {
        Self { name: name.into(), bytes, picture: OnceLock::new() }
    }

    /// The picture. The error says in words why it cannot be shown; the file is kept all the same.
    pub fn picture(&self) -> Result<&Arc<RgbaImage>, &Words> {
        let read = || picture::read(&self.bytes).map(Arc::new);
        self.picture.get_or_init(read).as_ref()
    }
}

impl Clone for ImageFile {
    fn clone(&self) -> Self {
        Self { name: self.name.clone(), bytes: self.bytes.clone(), picture: self.picture.clone() }
    }
}

impl PartialEq for ImageFile {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name && self.bytes == other.bytes
    }
}

impl fmt::Debug for ImageFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("ImageFile").field("name", &self.name).field("bytes", &self.bytes.len()).finish()
    }
}

impl TryFrom<StoredImage> for ImageFile {
    type Error = String;

    fn try_from(stored: StoredImage) -> Result<Self, String> {
        let bytes = STANDARD.decode(&stored.base64);
        let bytes = bytes.map_err(|why| format!("the image {:?} is no base64 text: {why}", stored.name))?;
        Ok(Self::new(stored.name, bytes))
    }
}

impl From<ImageFile> for StoredImage {
    fn from(file: ImageFile) -> Self {
        Self { base64: STANDARD.encode(&file.bytes), name: file.name }
    }
}

/// An image as the surface of a fabric: it is repeated all over the cloth, both ways.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Repeated {
    /// The image.
    pub image: ImageId,
    /// Width of a repeat, metres, 0.001..=10; its height follows from the image.
    pub width_m: f64,
    /// Angle from upright along the grain, counter-clockwise, radians.
    #[serde(default)]
    pub angle: f64,
}

/// A graphic: an image at one place of a piece, on its outside.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Graphic {
    /// The piece.
    pub piece: PieceId,
    /// The image.
    pub image: ImageId,
    /// Its middle, metres in the piece's own plane.
    pub at: DVec2,
    /// Its width, metres, 0.001..=10; its height follows from the image.
    pub width_m: f64,
    /// Angle from upright in the piece's plane, counter-clockwise, radians.
    #[serde(default)]
    pub angle: f64,
    /// Whether the piece's twin has its mirror image.
    #[serde(default)]
    pub on_twin: bool,
}

impl Graphic {
    /// The place in the image, 0..1 from its lower left corner, of a point of the piece; `aspect` is height over width.
    pub fn image_from_piece(&self, aspect: f64) -> DAffine2 {
        placed(self.at, DVec2::new(self.width_m, self.width_m * aspect), self.angle)
    }

    /// It with its place and width brought into the range that a document may have.
    pub fn clamped(self) -> Self {
        let [least, most] = WIDTHS;
        let at = self.at.clamp(DVec2::splat(-FARTHEST), DVec2::splat(FARTHEST));
        Self { at, width_m: self.width_m.clamp(least, most), ..self }
    }

    fn problem(&self) -> Option<Words> {
        let is_near = self.at.is_finite() && self.at.abs().max_element() <= FARTHEST;
        if !is_near {
            return Some(words!("a graphic is not within {most} m of its piece's origin", most = FARTHEST));
        }
        width_problem(words!("a graphic"), self.width_m).or_else(|| angle_problem(self.angle))
    }
}

impl Repeated {
    /// The place in repeats of the image of a point of the cloth (metres, y along the grain).
    pub fn image_from_cloth(&self, aspect: f64) -> DAffine2 {
        placed(DVec2::ZERO, DVec2::new(self.width_m, self.width_m * aspect), self.angle)
    }

    /// What cannot be drawn, in words.
    pub fn problem(&self) -> Option<Words> {
        width_problem(words!("a repeat of an image"), self.width_m).or_else(|| angle_problem(self.angle))
    }
}

/// The unit square from a rectangle of this middle, size and angle.
fn placed(middle: DVec2, size: DVec2, angle: f64) -> DAffine2 {
    let to_middle = DAffine2::from_angle(-angle) * DAffine2::from_translation(-middle);
    DAffine2::from_translation(DVec2::splat(0.5)) * DAffine2::from_scale(size.recip()) * to_middle
}

fn width_problem(what: Words, width: f64) -> Option<Words> {
    let [least, most] = WIDTHS;
    (!(least..=most).contains(&width))
        .then(|| words!("{what} is {width} m wide, not {least} to {most} m", what, width, least, most))
}

fn angle_problem(angle: f64) -> Option<Words> {
    (!angle.is_finite() || angle.abs() > 1e3).then(|| words!("{angle} is no angle of an image", angle))
}

/// Images of a document and the graphics made of them.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Artwork {
    /// The images.
    pub images: BTreeMap<ImageId, Arc<ImageFile>>,
    /// The graphics; of those that cover each other the later is on top.
    pub graphics: BTreeMap<GraphicId, Graphic>,
    /// Counter of ids of images and graphics: the last one given.
    pub last: u32,
}

impl Artwork {
    /// Whether there never was anything.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// A new number for an image or a graphic.
    pub fn fresh(&mut self) -> u32 {
        self.last += 1;
        self.last
    }

    /// The images that cannot be shown: their names and the reasons.
    pub fn unreadable(&self) -> impl Iterator<Item = (&str, &Words)> {
        self.images.values().filter_map(|file| Some((file.name.as_str(), file.picture().err()?)))
    }

    /// What no command would accept, in words. Images that cannot be read are none of it: they are kept.
    pub fn problem(&self, is_piece: impl Fn(PieceId) -> bool) -> Option<Words> {
        let Self { images, graphics, last } = self;
        let ids = images.keys().map(|id| id.0).chain(graphics.keys().map(|id| id.0));
        if ids.max().is_some_and(|id| id > *last) {
            return Some(words!("the counter of images is behind their ids"));
        }
        if *last > LARGEST_ID {
            return Some(words!(
                "the counter of images is {last}, more than {most}",
                last,
                most = LARGEST_ID
            ));
        }
        if images.len() > MOST_IMAGES {
            return Some(words!(
                "there are {count} images, more than {most}",
                count = images.len(),
                most = MOST_IMAGES
            ));
        }
        let bytes: usize = images.values().map(|file| file.bytes.len()).sum();
        if bytes > MOST_BYTES {
            let most = MOST_BYTES >> 20;
            return Some(words!(
                "the images have {bytes} MiB together, more than {most} MiB",
                bytes = bytes >> 20,
                most
            ));
        }
        if images.values().any(|file| file.name.chars().count() > LONGEST_NAME) {
            return Some(words!("the name of an image has more than {most} characters", most = LONGEST_NAME));
        }
        let mut on_piece: BTreeMap<PieceId, usize> = BTreeMap::new();
        for graphic in graphics.values() {
            let count = on_piece.entry(graphic.piece).or_default();
            *count += 1;
            let problem = match () {
                () if !is_piece(graphic.piece) => Some(words!("a graphic is on a piece that is not there")),
                () if !images.contains_key(&graphic.image) => {
                    Some(words!("the image of a graphic is not there"))
                }
                () if *count > MOST_ON_A_PIECE => {
                    Some(words!("a piece has more than {most} graphics", most = MOST_ON_A_PIECE))
                }
                () => graphic.problem(),
            };
            if problem.is_some() {
                return problem;
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_graphic_has_its_corners_where_its_numbers_say() {
        let graphic = Graphic {
            piece: PieceId(1),
            image: ImageId(1),
            at: DVec2::new(0.2, 0.1),
            width_m: 0.1,
            angle: std::f64::consts::FRAC_PI_2,
            on_twin: false,
        };
        let map = graphic.image_from_piece(0.5);
        let near = |p: DVec2, q: DVec2| assert!(p.distance(q) < 1e-12, "{p} {q}");
        near(map.transform_point2(graphic.at), DVec2::splat(0.5));
        // Turned by a quarter to the left, its right edge is above its middle.
        near(map.transform_point2(DVec2::new(0.2, 0.15)), DVec2::new(1.0, 0.5));
        near(map.transform_point2(DVec2::new(0.175, 0.1)), DVec2::new(0.5, 1.0));
    }

    #[test]
    fn damaged_images_are_kept_and_told() {
        let mut artwork = Artwork::default();
        let id = ImageId(artwork.fresh());
        artwork.images.insert(id, Arc::new(ImageFile::new("logo.png", vec![1, 2, 3])));
        assert_eq!(artwork.problem(|_| true), None);
        let told: Vec<(&str, &str)> = artwork.unreadable().map(|(name, why)| (name, why.as_str())).collect();
        assert!(told.len() == 1 && told[0].0 == "logo.png" && told[0].1.contains("PNG"), "{told:?}");
        let text = serde_json::to_string(&artwork).expect("JSON");
        assert_eq!(serde_json::from_str::<Artwork>(&text).expect("read"), artwork);
    }

    #[test]
    fn what_cannot_be_drawn_is_told() {
        let mut artwork = Artwork::default();
        let id = ImageId(artwork.fresh());
        artwork.images.insert(id, Arc::new(ImageFile::new("a", Vec::new())));
        let good = Graphic {
            piece: PieceId(1),
            image: ImageId(1),
            at: DVec2::ZERO,
            width_m: 0.1,
            angle: 0.0,
            on_twin: false,
        };
        for (graphic, words) in [
            (Graphic { width_m: 0.0, ..good }, "wide"),
            (Graphic { at: DVec2::NAN, ..good }, "origin"),
            (Graphic { angle: f64::INFINITY, ..good }, "angle"),
            (Graphic { image: ImageId(7), ..good }, "image of a graphic"),
            (Graphic { piece: PieceId(2), ..good }, "piece that is not there"),
        ] {
            artwork.graphics = BTreeMap::from([(GraphicId(1), graphic)]);
            assert!(
                artwork.problem(|piece| piece.0 == 1).is_some_and(|told| told.contains(words)),
                "{words}"
            );
        }
        artwork.graphics = (1..=13).map(|id| (GraphicId(id), good)).collect();
        artwork.last = 13;
        assert!(artwork.problem(|_| true).is_some_and(|told| told.contains("12 graphics")));
    }
}
