//! The files of dressed cloth: OBJ with its materials, binary glTF, and USD. Without egui, as the command line writes them, too.

use std::path::{Path, PathBuf};

use crate::cloth::{ClothState, Garment};
use crate::geometry::mesh::TriMesh;
use crate::io::atlas::AtlasLayout;
use crate::io::dressed::Dressed;
use crate::io::materials::Colours;
use crate::io::usd::{UsdFormat, UsdScene};
use crate::io::words::any_of;
use crate::io::{glb, mtl, obj};
use crate::pattern::Pattern;
use crate::session::Document;
use crate::ui::language::say;
use crate::ui::scenery::fabric_looks::materials;
use crate::ui::scenery::fabric_textures::{Relief, TextureOptions, textured};

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
    /// Its fabrics.
    pub document: &'a Document,
}

impl Worn<'_> {
    fn colours(self, options: TextureOptions) -> Result<Colours, String> {
        match options.side {
            0 => Ok(materials(self.document)),
            _ => textured(self.garment, self.pattern, self.document, options),
        }
    }

    /// The files of it at `path`, in the format of its ending: as OBJ alone with files beside it, as binary glTF or USD together
    /// with `body`. `side` are the pixels of textures each way; 0: colours alone.
    ///
    /// # Errors
    /// In words: an ending that is none of [`ENDINGS`], what is larger than the format or a texture allows.
    pub fn files(
        self,
        side: u32,
        layout: AtlasLayout,
        body: Option<&TriMesh>,
        path: &Path,
    ) -> Result<Vec<(PathBuf, Vec<u8>)>, String> {
        let ending = ending(path);
        match (ending.as_str(), UsdFormat::of_ending(&ending)) {
            ("obj", _) => self.obj(side, layout, path),
            ("glb", _) => Ok(vec![(path.to_owned(), self.glb(side, layout, body)?)]),
            (_, Some(format)) => self.usd(side, layout, body, path, format),
            _ => Err(say!("the name must end in {endings}", endings = any_of(ENDINGS))),
        }
    }

    /// It on `body` as binary glTF with textures of `side` pixels each way; 0: colours alone.
    ///
    /// # Errors
    /// In words: what is larger than the format or a texture allows.
    fn glb(self, side: u32, layout: AtlasLayout, body: Option<&TriMesh>) -> Result<Vec<u8>, String> {
        let colours = self.colours(TextureOptions { side, layout, relief: Relief::Tiles, inside: true })?;
        glb::write(Some(self.dressed()), body, &colours).map_err(|e| e.to_string())
    }

    /// It on `body` as USD at `path`, with textures of `side` pixels each way; 0: colours alone. A package is one file, text has
    /// its images beside it.
    ///
    /// # Errors
    /// In words: what is larger than the format or a texture allows.
    fn usd(
        self,
        side: u32,
        layout: AtlasLayout,
        body: Option<&TriMesh>,
        path: &Path,
        format: UsdFormat,
    ) -> Result<Vec<(PathBuf, Vec<u8>)>, String> {
        let colours = self.colours(TextureOptions { side, layout, relief: Relief::Tiles, inside: false })?;
        let stem = stem(path);
        let image_path = |name: &str| match format {
            UsdFormat::Text => format!("{stem}-{name}.png"),
            UsdFormat::Package => format!("textures/{name}.png"),
        };
        let scene = UsdScene::new(self.dressed(), body, &colours, image_path).map_err(|e| e.to_string())?;
        if format == UsdFormat::Package {
            return Ok(vec![(path.to_owned(), scene.package().map_err(|e| e.to_string())?)]);
        }
        let images = scene.images().iter().map(|(name, png)| (path.with_file_name(name), png.to_vec()));
        Ok(std::iter::once((path.to_owned(), scene.text().into())).chain(images).collect())
    }

    fn dressed(&self) -> Dressed<'_> {
        Dressed { garment: self.garment, state: self.cloth, pattern: self.pattern }
    }

    /// It as OBJ at `path`, its materials and their images, of `side` pixels each way, beside it; 0: colours alone.
    ///
    /// # Errors
    /// In words: what is larger than a texture allows.
    fn obj(self, side: u32, layout: AtlasLayout, path: &Path) -> Result<Vec<(PathBuf, Vec<u8>)>, String> {
        let colours = self.colours(TextureOptions { side, layout, relief: Relief::Atlas, inside: false })?;
        let stem = stem(path);
        let image_name = |name: &str| format!("{stem}-{name}.png");
        let library = format!("{stem}.mtl");
        let textures = colours.textures.as_deref();
        let file = mtl::write(self.garment.pieces.iter().map(|(id, _)| *id), &colours, image_name);
        let used = obj::UsedMaterials {
            file: &file,
            file_name: &library,
            atlas: textures.map(|textures| &textures.atlas),
        };
        let text = obj::garment_with(self.garment, self.cloth, self.pattern, Some(used));
        let images = textures.into_iter().flat_map(|textures| &textures.images);
        let images = images.map(|image| (path.with_file_name(image_name(&image.name)), image.png.to_vec()));
        let all =
            [(path.to_owned(), text.into_bytes()), (path.with_file_name(&library), file.text.into_bytes())];
        Ok(all.into_iter().chain(images).collect())
    }
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
    use super::*;

    #[test]
    fn every_ending_has_its_files_and_others_are_refused() {
        let (garment, cloth) = (Garment::default(), ClothState::default());
        let (pattern, document) = (Pattern::default(), Document::default());
        let worn = Worn { garment: &garment, cloth: &cloth, pattern: &pattern, document: &document };
        let files = |name: &str| worn.files(0, AtlasLayout::Pattern, None, Path::new(name));
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
    }
}
