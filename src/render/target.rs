//! The textures that a picture is drawn on, and how its pixels are read back.

use glam::UVec2;

use super::gpu::{COLOUR, DEPTH};
use super::part::Part;
use super::{Gpu, RenderError};

/// Rendering quality.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quality {
    /// With shadows, ambient occlusion and antialiasing.
    #[default]
    Finished,
    /// For software rendering while things move: direct light only, one sample per pixel, back faces of the body culled.
    Draft,
}

/// The textures of pictures, or of tiles of pictures, of one size.
#[derive(Debug)]
pub struct OffscreenTarget {
    /// Size, pixels.
    pub size: UVec2,
    /// Quality that the textures were made for.
    pub quality: Quality,
    /// The finished picture, gamma-encoded.
    pub picture: wgpu::Texture,
    /// A view of `picture`.
    pub picture_view: wgpu::TextureView,
    /// The part of a picture that is drawn on it.
    pub(super) part: Part,
    pub(super) samples: Option<wgpu::TextureView>,
    pub(super) depth: wgpu::TextureView,
    /// Textures for ambient occlusion; None in a draft.
    pub(super) half: Option<HalfSize>,
}

/// Textures at half the size from which ambient occlusion is computed.
#[derive(Debug)]
pub(super) struct HalfSize {
    pub(super) depth: wgpu::TextureView,
    pub(super) normals: wgpu::TextureView,
    pub(super) rough_hollows: wgpu::TextureView,
    pub(super) hollows: wgpu::TextureView,
}

/// Format of ambient occlusion: openness and depth.
pub(super) const HOLLOWS: wgpu::TextureFormat = wgpu::TextureFormat::Rg16Float;
/// Format of the view-space normals.
pub(super) const NORMALS: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
/// Format of depth (metres) and radius of the circle of confusion (pixels).
pub(super) const FOCUS: wgpu::TextureFormat = wgpu::TextureFormat::Rg32Float;
/// Format of linear light.
pub(super) const LIGHT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
/// Format of the largest radius (pixels) in a block.
pub(super) const REACH: wgpu::TextureFormat = wgpu::TextureFormat::R32Float;

impl Quality {
    /// Samples per pixel.
    pub(super) fn samples(self, gpu: &Gpu) -> u32 {
        match self {
            Self::Finished => gpu.samples,
            Self::Draft => 1,
        }
    }
}

impl OffscreenTarget {
    /// Makes the textures. `size` is in pixels, at least 1 x 1.
    pub fn new(gpu: &Gpu, size: UVec2, quality: Quality) -> Result<Self, RenderError> {
        Self::of_part(gpu, Part::all(size.max(UVec2::ONE)), quality)
    }

    /// Makes the textures for a part of a picture.
    pub(super) fn of_part(gpu: &Gpu, part: Part, quality: Quality) -> Result<Self, RenderError> {
        let size = part.size;
        check_size(gpu, size)?;
        let used = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let read = used | wgpu::TextureUsages::TEXTURE_BINDING;
        let view = |label, size, format, samples, usage| {
            texture(gpu, label, size, format, samples, usage).create_view(&Default::default())
        };
        let halved = || {
            let half = part.around_size / 2;
            HalfSize {
                depth: view("half depth", half, DEPTH, 1, read),
                normals: view("half normals", half, NORMALS, 1, read),
                rough_hollows: view("rough hollows", half, HOLLOWS, 1, read),
                hollows: view("hollows", half, HOLLOWS, 1, read),
            }
        };
        let samples = quality.samples(gpu);
        let picture = texture(gpu, "picture", size, COLOUR, 1, read | wgpu::TextureUsages::COPY_SRC);
        Ok(Self {
            size,
            quality,
            part,
            picture_view: picture.create_view(&Default::default()),
            picture,
            samples: (samples > 1).then(|| view("samples", size, COLOUR, samples, used)),
            depth: view("depth", size, DEPTH, samples, used),
            half: (quality == Quality::Finished).then(halved),
        })
    }

    /// The same for another part, on the same textures if that has the same sizes.
    pub(super) fn moved_to(self, gpu: &Gpu, part: Part) -> Result<Self, RenderError> {
        if (self.part.size, self.part.around_size) == (part.size, part.around_size) {
            return Ok(Self { part, ..self });
        }
        let quality = self.quality;
        drop(self);
        Self::of_part(gpu, part, quality)
    }

    /// Reads the picture back from the device: RGBA, rows from the top.
    pub fn read(&self, gpu: &Gpu) -> Result<image::RgbaImage, RenderError> {
        let row = self.size.x * 4;
        let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("readback"),
            size: u64::from(padded) * u64::from(self.size.y),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(
            self.picture.as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(padded),
                    rows_per_image: None,
                },
            },
            extent(self.size),
        );
        gpu.queue.submit([encoder.finish()]);
        let bytes = mapped(gpu, &buffer)?;
        let pixels = bytes.chunks(padded as usize).flat_map(|r| &r[..row as usize]).copied().collect();
        image::RgbaImage::from_raw(self.size.x, self.size.y, pixels)
            .ok_or_else(|| RenderError::Device("the picture came back too short".to_owned()))
    }
}

/// Refuses a picture that is larger than the device's textures. `size` in pixels.
pub(super) fn check_size(gpu: &Gpu, size: UVec2) -> Result<(), RenderError> {
    if size.max_element() > gpu.max_side() {
        return Err(RenderError::TooLarge {
            what: format!("a picture of {} x {} pixels", size.x, size.y),
            limit: format!("{} pixels a side", gpu.max_side()),
        });
    }
    Ok(())
}

fn extent(size: UVec2) -> wgpu::Extent3d {
    wgpu::Extent3d { width: size.x, height: size.y, depth_or_array_layers: 1 }
}

/// Makes a 2D texture with one mip level.
pub(super) fn texture(
    gpu: &Gpu,
    label: &str,
    size: UVec2,
    format: wgpu::TextureFormat,
    samples: u32,
    usage: wgpu::TextureUsages,
) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: extent(size),
        mip_level_count: 1,
        sample_count: samples,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    })
}

/// The bytes of `buffer`, once the device has finished its work.
fn mapped(gpu: &Gpu, buffer: &wgpu::Buffer) -> Result<Vec<u8>, RenderError> {
    let (send, receive) = std::sync::mpsc::channel();
    buffer.map_async(wgpu::MapMode::Read, .., move |r| {
        // Sending fails only after a timeout, when nobody waits for the answer.
        let _ = send.send(r);
    });
    let wait = wgpu::PollType::Wait { submission_index: None, timeout: Some(gpu.patience) };
    gpu.device.poll(wait).map_err(|_| RenderError::Timeout(gpu.patience))?;
    receive
        .recv_timeout(gpu.patience)
        .map_err(|_| RenderError::Timeout(gpu.patience))?
        .map_err(|e| RenderError::Device(e.to_string()))?;
    let view = buffer.get_mapped_range(..).map_err(|e| RenderError::Device(e.to_string()))?;
    Ok(view.to_vec())
}
