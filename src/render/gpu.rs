//! A graphics device: opened without a window, or shared with one.

use std::sync::Arc;
use std::time::Duration;

use super::RenderError;

/// Colour format of every target. Shaders write gamma-encoded values, as egui expects of its textures.
pub const COLOUR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
/// Depth format. Depth is reversed, 1 at the near plane and 0 far away, which keeps the relative accuracy of floats.
pub const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Default time after which a picture counts as failed; software rendering takes seconds for the largest pictures.
const PATIENCE: Duration = Duration::from_secs(30);

/// A device and its queue.
#[derive(Clone, Debug)]
pub struct Gpu {
    /// The device.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// Name and backend of the adapter, for people.
    pub adapter_name: String,
    /// Whether the adapter renders in software; optional passes may then be smaller.
    pub software: bool,
    /// Samples per pixel: 4, or 1 where the adapter does not support that.
    pub samples: u32,
    /// Whether shaders can load depth. OpenGL's language has no such instruction: ambient occlusion is then left out, and depth of
    /// field refused.
    pub loads_depth: bool,
    /// Time after which a picture counts as failed.
    pub patience: Duration,
}

impl Gpu {
    /// Opens the best adapter available, without a window.
    pub fn headless() -> Result<Self, RenderError> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            ..Default::default()
        };
        let adapter = pollster::block_on(instance.request_adapter(&options))
            .map_err(|e| RenderError::NoAdapter(e.to_string()))?;
        let (device, queue) = pollster::block_on(adapter.request_device(&device_descriptor(&adapter)))
            .map_err(|e| RenderError::NoDevice { adapter: adapter.get_info().name, reason: e.to_string() })?;
        device.on_uncaptured_error(Arc::new(|e| tracing::error!("graphics: {e}")));
        Ok(Self::from_parts(&adapter, device, queue))
    }

    /// Wraps a device that a window has opened.
    pub fn from_parts(adapter: &wgpu::Adapter, device: wgpu::Device, queue: wgpu::Queue) -> Self {
        let info = adapter.get_info();
        let can = |format| {
            adapter
                .get_texture_format_features(format)
                .flags
                .contains(wgpu::TextureFormatFeatureFlags::MULTISAMPLE_X4)
        };
        Self {
            samples: if can(COLOUR) && can(DEPTH) { 4 } else { 1 },
            adapter_name: format!("{} ({})", info.name, info.backend),
            software: info.device_type == wgpu::DeviceType::Cpu,
            loads_depth: info.backend != wgpu::Backend::Gl,
            device,
            queue,
            patience: PATIENCE,
        }
    }

    /// Makes a buffer with `contents`, padded to a multiple of 4 bytes. On a lost device it is empty, and nothing panics.
    pub(super) fn buffer(&self, label: &str, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
        let unpadded = contents.len() as u64;
        let size = unpadded.next_multiple_of(wgpu::COPY_BUFFER_ALIGNMENT).max(wgpu::COPY_BUFFER_ALIGNMENT);
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size,
            usage: usage | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        if unpadded == size {
            self.queue.write_buffer(&buffer, 0, contents);
        } else {
            let mut padded = contents.to_vec();
            padded.resize(size as usize, 0);
            self.queue.write_buffer(&buffer, 0, &padded);
        }
        buffer
    }

    /// Does `work`; what the device reports meanwhile is an error.
    pub(super) fn checked<T>(&self, work: impl FnOnce() -> Result<T, RenderError>) -> Result<T, RenderError> {
        let filters =
            [wgpu::ErrorFilter::OutOfMemory, wgpu::ErrorFilter::Validation, wgpu::ErrorFilter::Internal];
        let scopes = filters.map(|filter| self.device.push_error_scope(filter));
        let done = work();
        // Scopes end in the order opposite to that in which they began.
        let errors = scopes.into_iter().rev().filter_map(|scope| pollster::block_on(scope.pop()));
        match errors.map(|e| one_line(&e.to_string())).reduce(|all, e| format!("{all}; {e}")) {
            Some(words) => Err(RenderError::Device(words)),
            None => done,
        }
    }

    /// Longest side of a texture, pixels.
    pub fn max_side(&self) -> u32 {
        self.device.limits().max_texture_dimension_2d
    }
}

/// The lines of a message in one.
fn one_line(words: &str) -> String {
    words.lines().map(str::trim).filter(|line| !line.is_empty()).collect::<Vec<_>>().join(" ")
}

/// The limits requested of an adapter: no optional features, and the largest textures and buffers it offers.
pub fn device_descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
    let offered = adapter.limits();
    let base = if adapter.get_info().backend == wgpu::Backend::Gl {
        wgpu::Limits::downlevel_webgl2_defaults()
    } else {
        wgpu::Limits::default()
    };
    wgpu::DeviceDescriptor {
        label: Some("toile"),
        required_limits: wgpu::Limits {
            max_texture_dimension_2d: offered.max_texture_dimension_2d,
            max_buffer_size: offered.max_buffer_size,
            ..base
        },
        ..Default::default()
    }
}
