//! The pictures of a mesh on the device: a texture with a layer for each.

use std::sync::Arc;

use glam::UVec2;
use image::RgbaImage;

use super::Gpu;
use super::pyramid::Pyramid;

/// Format of the pictures: premultiplied, decoded to linear light when they are read.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;
/// Largest width and height of a layer, pixels, on a processor and on a graphics card.
const MOST_SIDE: [u32; 2] = [1024, 2048];

/// Pictures as layers of one texture. They are drawn out to squares of one size.
#[derive(Clone, Debug)]
pub(super) struct PictureArray {
    pictures: Vec<Arc<RgbaImage>>,
    pub(super) view: wgpu::TextureView,
}

impl PictureArray {
    /// Uploads `pictures`; without any a single transparent pixel.
    pub fn new(gpu: &Gpu, pictures: Vec<Arc<RgbaImage>>) -> Self {
        let longest = pictures.iter().map(|picture| picture.width().max(picture.height())).max().unwrap_or(1);
        let side = longest.next_power_of_two().min(MOST_SIDE[usize::from(!gpu.software)]);
        let layers: Vec<Pyramid> =
            pictures.iter().map(|picture| Pyramid::new(picture).square(side)).collect();
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("pictures"),
            size: wgpu::Extent3d {
                width: side,
                height: side,
                depth_or_array_layers: layers.len().max(1) as u32,
            },
            mip_level_count: side.ilog2() + 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: FORMAT,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        for (layer, pyramid) in (0..).zip(&layers) {
            for (level, image) in (0..).zip(&pyramid.levels) {
                upload(gpu, &texture, layer, level, image);
            }
        }
        let view = texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..Default::default()
        });
        Self { pictures, view }
    }

    /// Whether these are the pictures it has.
    pub fn has(&self, pictures: &[Arc<RgbaImage>]) -> bool {
        self.pictures.len() == pictures.len()
            && self.pictures.iter().zip(pictures).all(|(own, other)| Arc::ptr_eq(own, other))
    }
}

fn upload(gpu: &Gpu, texture: &wgpu::Texture, layer: u32, level: u32, image: &RgbaImage) {
    let size = UVec2::from(image.dimensions());
    gpu.queue.write_texture(
        wgpu::TexelCopyTextureInfo {
            texture,
            mip_level: level,
            origin: wgpu::Origin3d { x: 0, y: 0, z: layer },
            aspect: wgpu::TextureAspect::All,
        },
        image.as_raw(),
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(size.x * 4),
            rows_per_image: Some(size.y),
        },
        wgpu::Extent3d { width: size.x, height: size.y, depth_or_array_layers: 1 },
    );
}
