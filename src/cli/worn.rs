//! The files of dressed cloth: OBJ with its materials, and binary glTF.

use std::path::{Path, PathBuf};

use crate::cli::failure::Failure;
use crate::cli::formats;
use crate::cli::texture_options::TextureOptions;
use crate::cloth::{ClothState, Garment};
use crate::geometry::mesh::TriMesh;
use crate::io::materials::Colours;
use crate::io::{mtl, obj};
use crate::pattern::Pattern;
use crate::session::Document;
use crate::ui::scenery::fabric_looks::materials;
use crate::ui::scenery::fabric_textures::{Relief, TextureOptions as Baked, USUAL_SIDE, textured};

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
    fn colours(self, with: TextureOptions, side: u32, relief: Relief) -> Result<Colours, Failure> {
        if side == 0 {
            return Ok(materials(self.document));
        }
        let options = Baked { side, layout: with.atlas, relief };
        textured(self.garment, self.pattern, self.document, options).map_err(Failure::Internal)
    }

    /// It on `body` as binary glTF.
    pub fn glb(self, with: TextureOptions, body: Option<&TriMesh>) -> Result<Vec<u8>, Failure> {
        let colours = self.colours(with, with.textures.unwrap_or(USUAL_SIDE), Relief::Tiles)?;
        formats::scene_glb(self.garment, self.cloth, self.pattern, body, &colours)
    }

    /// It as OBJ at `path`, its materials and their images beside it.
    pub fn obj(self, with: TextureOptions, path: &Path) -> Result<Vec<(PathBuf, Vec<u8>)>, Failure> {
        let colours = self.colours(with, with.textures.unwrap_or(0), Relief::Atlas)?;
        let stem = path.file_stem().map_or_else(|| "garment".into(), |stem| stem.to_string_lossy());
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
        let images = textures
            .into_iter()
            .flat_map(|textures| &textures.images)
            .filter(|i| !i.name.starts_with("inside"));
        let images = images.map(|image| (path.with_file_name(image_name(&image.name)), image.png.to_vec()));
        let all =
            [(path.to_owned(), text.into_bytes()), (path.with_file_name(&library), file.text.into_bytes())];
        Ok(all.into_iter().chain(images).collect())
    }
}
