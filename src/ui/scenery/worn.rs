//! The files of dressed cloth: OBJ with its materials, binary glTF, and USD. Without egui, as the command line writes them, too.

use std::path::{Path, PathBuf};

use crate::cloth::{ClothState, Garment};
use crate::geometry::mesh::TriMesh;
use crate::io::atlas::AtlasLayout;
use crate::io::dressed::Dressed;
use crate::io::materials::Colours;
use crate::io::usd::{UsdFormat, UsdScene};
use crate::io::{glb, mtl, obj};
use crate::pattern::Pattern;
use crate::session::Document;
use crate::ui::scenery::fabric_looks::materials;
use crate::ui::scenery::fabric_textures::{Relief, TextureOptions, textured};

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

    /// It on `body` as binary glTF with textures of `side` pixels each way; 0: colours alone.
    ///
    /// # Errors
    /// In words: what is larger than the format or a texture allows.
    pub fn glb(self, side: u32, layout: AtlasLayout, body: Option<&TriMesh>) -> Result<Vec<u8>, String> {
        let colours = self.colours(TextureOptions { side, layout, relief: Relief::Tiles, inside: true })?;
        glb::write(Some(self.dressed()), body, &colours).map_err(|e| e.to_string())
    }

    /// It on `body` as USD at `path`, with textures of `side` pixels each way; 0: colours alone. A package is one file, text has
    /// its images beside it.
    ///
    /// # Errors
    /// In words: what is larger than the format or a texture allows.
    pub fn usd(
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
    pub fn obj(self, side: u32, layout: AtlasLayout, path: &Path) -> Result<Vec<(PathBuf, Vec<u8>)>, String> {
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

/// The name of `path` without its ending, for files beside it.
fn stem(path: &Path) -> String {
    let stem = path.file_stem().map_or_else(|| "garment".into(), |stem| stem.to_string_lossy());
    mtl::plain(&stem)
}
