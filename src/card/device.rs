//! The device of a graphics card that can compute.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Storage buffers that one shader uses at most.
const STORAGE_BUFFERS: u32 = 20;

/// Why there is no card to compute on.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum NoCard {
    /// No adapter, or its device cannot be opened.
    #[error("no graphics card can be used: {0}")]
    None(String),
    /// It is software, which is slower than the processor itself.
    #[error("{0} draws in software: there is no graphics card")]
    Software(String),
    /// It has too few storage buffers.
    #[error("{0} cannot compute: it has {1} storage buffers, {STORAGE_BUFFERS} are needed")]
    Weak(String, u32),
}

/// A device that can compute.
#[derive(Clone, Debug)]
pub struct Device {
    pub gpu: wgpu::Device,
    pub queue: wgpu::Queue,
    /// Set after an error of the driver: nothing that it computes can be trusted then.
    is_broken: Arc<AtomicBool>,
    /// Name of the adapter, for people.
    pub name: String,
}

impl Device {
    /// The best device of this machine. Software counts as one only with `software`.
    pub fn find(software: bool) -> Result<Self, NoCard> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
        let options = wgpu::RequestAdapterOptions {
            power_preference: wgpu::PowerPreference::HighPerformance,
            ..Default::default()
        };
        let adapter = pollster::block_on(instance.request_adapter(&options))
            .map_err(|e| NoCard::None(e.to_string()))?;
        let (info, offered) = (adapter.get_info(), adapter.limits());
        let name = format!("{} ({})", info.name, info.backend);
        if info.device_type == wgpu::DeviceType::Cpu && !software {
            return Err(NoCard::Software(name));
        }
        if offered.max_storage_buffers_per_shader_stage < STORAGE_BUFFERS {
            return Err(NoCard::Weak(name, offered.max_storage_buffers_per_shader_stage));
        }
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("toile draping"),
            required_limits: wgpu::Limits {
                max_storage_buffers_per_shader_stage: STORAGE_BUFFERS,
                max_storage_buffer_binding_size: offered.max_storage_buffer_binding_size,
                max_buffer_size: offered.max_buffer_size,
                ..wgpu::Limits::default()
            },
            ..Default::default()
        };
        let (gpu, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .map_err(|e| NoCard::None(format!("{name}: {e}")))?;
        let is_broken = Arc::new(AtomicBool::new(false));
        let broken = Arc::clone(&is_broken);
        gpu.on_uncaptured_error(Arc::new(move |e| {
            tracing::error!("draping on the graphics card: {e}");
            broken.store(true, Ordering::Relaxed);
        }));
        Ok(Self { gpu, queue, is_broken, name })
    }

    /// Whether the driver has reported an error.
    pub fn is_broken(&self) -> bool {
        self.is_broken.load(Ordering::Relaxed)
    }

    /// Largest buffer that a shader can use, bytes.
    pub fn most_bytes(&self) -> u64 {
        let limits = self.gpu.limits();
        limits.max_storage_buffer_binding_size.min(limits.max_buffer_size)
    }
}

impl Device {
    /// A buffer of at least `bytes`, filled with zeros.
    pub fn buffer(&self, bytes: u64, usage: wgpu::BufferUsages) -> wgpu::Buffer {
        self.gpu.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: bytes.max(64).next_multiple_of(wgpu::COPY_BUFFER_ALIGNMENT),
            usage: usage | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        })
    }
}
