//! The files of dressed cloth: OBJ with its materials, binary glTF, and USD. Without egui, as the command line writes them, too.

use std::path::{Path, PathBuf};

use crate::cloth::trim_parts::{MOST_MOVING, MOST_STILL};
use crate::cloth::{ClothState, Garment, TrimParts, TrimShapes};
use crate::geometry::mesh::TriMesh;
use crate::geometry::words::{Words, words};
use crate::io::atlas::AtlasLayout;
use crate::io::dressed::Dressed;
use crate::io::materials::Colours;
use crate::io::usd::{UsdFormat, UsdScene};
use crate::io::words::any_of;
use crate::io::{glb, mtl, obj};
use crate::pattern::Pattern;
use crate::session::Document;
use crate::ui::scenery::fabric_looks::materials;
use crate::ui::scenery::fabric_textures::{Relief, TextureOptions, USUAL_SIDE, textured};

/// Endings of the files of dressed cloth, in lower case.
pub const ENDINGS: [&str; 4] = ["obj", "glb", "usda", "usdz"];

/// Dressed cloth to be written.
#[derive(Clone, Copy)]
pub struct Worn<'a> {
    /// Its topology.
    pub garment: &'a Garment,
    /// Its positions.
    pub cloth: &'a ClothState,
    /// The pattern it was cut from.
    pub pattern: &'a Pattern,
    /// Its fabrics and trims.
    pub document: &'a Document,
}

/// How dressed cloth is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WornOptions {
    /// Pixels of textures each way; 0: colours alone.
    pub side: u32,
    /// Where the pieces are in them.
    pub layout: AtlasLayout,
    /// Whether buttons, piping, stitches and zips are written.
    pub trims: bool,
}

impl Default for WornOptions {
    fn default() -> Self {
        Self { side: USUAL_SIDE, layout: AtlasLayout::Pattern, trims: true }
    }
}

/// The files of dressed cloth.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WornFiles {
    /// Paths and contents; the first is the one that was asked for, the others belong beside it.
    pub files: Vec<(PathBuf, Vec<u8>)>,
    /// What is left out of them, a line each.
    pub left_out: Vec<Words>,
}

/// What dressed cloth that moves is written with.
#[derive(Clone, Debug, Default)]
pub struct MovingWorn {
    /// Its materials and their textures, for glTF and USD.
    pub colours: Colours,
    /// Its trims.
    pub trims: TrimParts,
    /// What is left out, a line each.
    pub left_out: Vec<Words>,
}

impl Worn<'_> {
    fn colours(self, options: WornOptions, relief: Relief, inside: bool) -> Result<Colours, Words> {
        let WornOptions { side, layout, trims: _ } = options;
        match side {
            0 => Ok(materials(self.document)),
            _ => {
                let options = TextureOptions { side, layout, relief, inside };
                textured(self.garment, self.pattern, self.document, options)
            }
        }
    }

    /// Its trims as a picture has them: those of the document, which may be newer than the cloth. They have at most `most` vertices of
    /// stitches and teeth; there are none where they are not wanted.
    fn trims(self, options: WornOptions, most: usize) -> (TrimParts, Vec<Words>) {
        if !options.trims {
            return (TrimParts::default(), Vec::new());
        }
        let shapes = TrimShapes::new(self.garment, &self.document.pattern);
        let trims = TrimParts::new(&shapes, self.garment, self.cloth, most);
        let left_out = match trims.left_out {
            0 => None,
            1 => Some(words!("1 row of stitches is left out: there would be too many vertices")),
            n => Some(words!("{n} rows of stitches are left out: there would be too many vertices", n)),
        };
        (trims, left_out.into_iter().collect())
    }

    /// The files of it at `path`, in the format of its ending: as OBJ alone with files beside it, as binary glTF or USD together
    /// with `body`.
    ///
    /// # Errors
    /// In words: an ending that is none of [`ENDINGS`], what is larger than the format or a texture allows.
    pub fn files(
        self,
        options: WornOptions,
        body: Option<&TriMesh>,
        path: &Path,
    ) -> Result<WornFiles, Words> {
        let ending = ending(path);
        let format = UsdFormat::of_ending(&ending);
        if !ENDINGS.contains(&ending.as_str()) {
            return Err(words!("the name must end in {endings}", endings = any_of(ENDINGS)));
        }
        let (trims, left_out) = self.trims(options, MOST_STILL);
        let Self { garment, cloth: state, pattern, .. } = self;
        let dressed = Dressed { garment, state, pattern, trims: &trims.parts };
        let files = match (ending.as_str(), format) {
            (_, Some(format)) => self.usd(options, &dressed, body, path, format)?,
            ("obj", _) => self.obj(options, &dressed, path)?,
            _ => {
                let colours = self.colours(options, Relief::Tiles, true)?;
                let bytes = glb::write(Some(dressed), body, &colours).map_err(|e| e.words())?;
                vec![(path.to_owned(), bytes)]
            }
        };
        Ok(WornFiles { files, left_out })
    }

    /// What it is written with where it moves, as binary glTF or USD; [`Worn::cloth`] is then how it was dressed.
    ///
    /// # Errors
    /// In words: what is larger than a texture allows.
    pub fn moving(self, options: WornOptions) -> Result<MovingWorn, Words> {
        let (trims, left_out) = self.trims(options, MOST_MOVING);
        Ok(MovingWorn { colours: self.colours(options, Relief::Tiles, true)?, trims, left_out })
    }

    /// It on `body` as USD at `path`. A package is one file, text has its images beside it.
    ///
    /// # Errors
    /// In words: what is larger than the format or a texture allows.
    fn usd(
        self,
        options: WornOptions,
        dressed: &Dressed<'_>,
        body: Option<&TriMesh>,
        path: &Path,
        format: UsdFormat,
    ) -> Result<Vec<(PathBuf, Vec<u8>)>, Words> {
        let colours = self.colours(options, Relief::Tiles, false)?;
        let stem = stem(path);
        let image_path = |name: &str| match format {
            UsdFormat::Text => format!("{stem}-{name}.png"),
            UsdFormat::Package => packed_image(name),
        };
        let scene = UsdScene::new(*dressed, body, &colours, image_path).map_err(|e| e.words())?;
        if format == UsdFormat::Package {
            return Ok(vec![(path.to_owned(), scene.package().map_err(|e| e.words())?)]);
        }
        let images = scene.images().iter().map(|(name, png)| (path.with_file_name(name), png.to_vec()));
        Ok(std::iter::once((path.to_owned(), scene.text().into())).chain(images).collect())
    }

    /// It as OBJ at `path`, its materials and their images beside it.
    ///
    /// # Errors
    /// In words: what is larger than a texture allows.
    fn obj(
        self,
        options: WornOptions,
        dressed: &Dressed<'_>,
        path: &Path,
    ) -> Result<Vec<(PathBuf, Vec<u8>)>, Words> {
        let colours = self.colours(options, Relief::Atlas, false)?;
        let stem = stem(path);
        let image_name = |name: &str| format!("{stem}-{name}.png");
        let library = format!("{stem}.mtl");
        let textures = colours.textures.as_deref();
        let file = mtl::write(dressed, &colours, image_name);
        let used = obj::UsedMaterials {
            file: &file,
            file_name: &library,
            atlas: textures.map(|textures| &textures.atlas),
        };
        let text = obj::garment_with(dressed, used);
        let images = textures.into_iter().flat_map(|textures| &textures.images);
        let images = images.map(|image| (path.with_file_name(image_name(&image.name)), image.png.to_vec()));
        let all =
            [(path.to_owned(), text.into_bytes()), (path.with_file_name(&library), file.text.into_bytes())];
        Ok(all.into_iter().chain(images).collect())
    }
}

/// The path of an image in a USD package.
pub fn packed_image(name: &str) -> String {
    format!("textures/{name}.png")
}

/// The ending of the name of `path`, in lower case, without its dot.
pub fn ending(path: &Path) -> String {
    path.extension().map(|ending| ending.to_string_lossy().to_lowercase()).unwrap_or_default()
}

/// The name of `path` without its ending, for files beside it.
fn stem(path: &Path) -> String {
    let stem = path.file_stem().map_or_else(|| "garment".into(), |stem| stem.to_string_lossy());
    mtl::plain(&stem)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use glam::DVec2;

    use super::*;
    use crate::cloth::build;
    use crate::language::{Table, said, shown_in};
    use crate::pattern::{Piece, Topstitch};

    #[test]
    fn every_ending_has_its_files_and_others_are_refused() {
        let (garment, cloth) = (Garment::default(), ClothState::default());
        let (pattern, document) = (Pattern::default(), Document::default());
        let worn = Worn { garment: &garment, cloth: &cloth, pattern: &pattern, document: &document };
        let options = WornOptions { side: 0, ..WornOptions::default() };
        let files = |name: &str| worn.files(options, None, Path::new(name)).map(|written| written.files);
        let refused = |name: &str| files(name).is_err_and(|why| why.contains(".obj, .glb, .usda or .usdz"));
        for ending in ENDINGS {
            assert!(!refused(&format!("cloth.{ending}")), "{ending}");
        }
        let names: Vec<PathBuf> =
            files("out/cloth.OBJ").expect("files").into_iter().map(|(path, _)| path).collect();
        assert_eq!(names, ["out/cloth.OBJ", "out/cloth.mtl"].map(PathBuf::from));
        for name in ["cloth.dxf", "cloth", ".obj"] {
            assert!(refused(name), "{name}");
        }
        let german = |words: &Words| shown_in(Table::german(), || said(words));
        let [ending, empty] =
            ["cloth.dxf", "cloth.glb"].map(|name| german(&files(name).expect_err("refused")));
        assert_eq!(ending, "der Name muss auf .obj, .glb, .usda oder .usdz enden");
        assert_eq!(empty, "es gibt nichts zu schreiben: noch liegt kein Stoff auf dem Körper");
    }

    #[test]
    fn trims_are_those_of_the_document_and_may_be_left_out() {
        let corners = [[0.0, 0.0], [0.2, 0.0], [0.2, 0.1], [0.0, 0.1]].map(DVec2::from);
        let mut pattern = Pattern::default();
        let id = pattern.add_piece(Piece::polygon("square", &corners));
        let garment = build(&pattern, 0.03).0;
        let mut positions = vec![glam::DVec3::ZERO; garment.vertex_count];
        garment.corners.iter().for_each(|c| positions[c.vertex as usize] = c.uv.extend(0.0));
        let cloth = ClothState { positions, mapped: vec![true; garment.vertex_count] };
        let mut document = Document::default();
        let own = Arc::make_mut(&mut document.pattern);
        *own = pattern.clone();
        let piece = Arc::make_mut(own.pieces.get_mut(&id).expect("the piece"));
        piece.outline[0].trims.topstitch = Some(Topstitch::default());
        let worn = Worn { garment: &garment, cloth: &cloth, pattern: &pattern, document: &document };
        let options = WornOptions { side: 0, ..WornOptions::default() };
        let text = |options: WornOptions| {
            let written = worn.files(options, None, Path::new("cloth.obj")).expect("files");
            assert!(written.left_out.is_empty());
            String::from_utf8(written.files[0].1.clone()).expect("text")
        };
        assert!(text(options).contains("usemtl Stitches\n"), "sewn after it was dressed");
        let plain = WornOptions { trims: false, ..options };
        assert_eq!(text(plain).matches("usemtl ").count(), 1);
        let moving = worn.moving(options).expect("colours");
        assert_eq!((moving.trims.parts.len(), moving.trims.left_out), (1, 0));
        assert!(worn.moving(plain).expect("colours").trims.parts.is_empty());
    }
}
