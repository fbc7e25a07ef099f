//! Images in glTF scenes.

use gltf_json::image::{Image, MimeType};
use gltf_json::material::NormalTexture;
use gltf_json::texture::{Info, MagFilter, MinFilter, Sampler};
use gltf_json::validation::Checked;
use gltf_json::{Index, Texture};

use super::Builder;
use crate::io::materials::Textures;

/// A texture and the set of texture coordinates that it is read with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Map {
    pub texture: Index<Texture>,
    pub set: u32,
}

impl Map {
    pub fn info(self) -> Info {
        Info { index: self.texture, tex_coord: self.set, extensions: None, extras: Default::default() }
    }

    pub fn normal(self) -> NormalTexture {
        NormalTexture {
            index: self.texture,
            scale: 1.0,
            tex_coord: self.set,
            extensions: None,
            extras: Default::default(),
        }
    }
}

impl Builder {
    /// The texture of an image of `textures`, written once; None where there is no such image.
    pub(super) fn texture(&mut self, textures: &Textures, image: usize) -> Option<Index<Texture>> {
        if let Some((_, texture)) = self.textures.iter().find(|(written, _)| *written == image) {
            return Some(*texture);
        }
        let file = textures.images.get(image)?;
        let view = self.view(&file.png, None);
        // What follows begins at a multiple of 4 again.
        self.data.resize(self.data.len().next_multiple_of(4), 0);
        let source = self.root.push(Image {
            buffer_view: Some(view),
            mime_type: Some(MimeType("image/png".to_owned())),
            name: Some(file.name.clone()),
            uri: None,
            extensions: None,
            extras: Default::default(),
        });
        let sampler = match self.root.samplers.is_empty() {
            true => self.root.push(Sampler {
                mag_filter: Some(Checked::Valid(MagFilter::Linear)),
                min_filter: Some(Checked::Valid(MinFilter::LinearMipmapLinear)),
                ..Sampler::default()
            }),
            false => Index::new(0),
        };
        let texture = self.root.push(Texture {
            name: Some(file.name.clone()),
            sampler: Some(sampler),
            source,
            extensions: None,
            extras: Default::default(),
        });
        self.textures.push((image, texture));
        Some(texture)
    }
}
