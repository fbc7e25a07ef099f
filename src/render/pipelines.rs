//! How each pass is set up on the device.

use super::gpu::{COLOUR, DEPTH};
use super::shaders::{self, Shader};
use super::target::{HOLLOWS, NORMALS};
use super::{Gpu, strokes::Stroke};

/// Everything that lives as long as the device.
#[derive(Debug)]
pub(super) struct Pipelines {
    pub(super) frame_layout: wgpu::BindGroupLayout,
    pub(super) light_layout: wgpu::BindGroupLayout,
    pub(super) material_layout: wgpu::BindGroupLayout,
    pub(super) hollows_layout: wgpu::BindGroupLayout,
    pub(super) blur_layout: wgpu::BindGroupLayout,
    pub(super) shadow: wgpu::RenderPipeline,
    pub(super) depth: wgpu::RenderPipeline,
    pub(super) depth_ground: wgpu::RenderPipeline,
    pub(super) hollows: wgpu::RenderPipeline,
    pub(super) blur: wgpu::RenderPipeline,
    pub(super) background: wgpu::RenderPipeline,
    pub(super) ground: wgpu::RenderPipeline,
    pub(super) mesh: wgpu::RenderPipeline,
    pub(super) line: wgpu::RenderPipeline,
    /// Meshes that can be seen through.
    pub(super) sheer: wgpu::RenderPipeline,
    /// Edges of triangles.
    pub(super) wire: wgpu::RenderPipeline,
    /// Lines, whatever hides them.
    pub(super) faint: wgpu::RenderPipeline,
}

/// A mesh vertex: position, normal, colour.
pub(super) const MESH_STRIDE: u64 = 28;

impl Pipelines {
    pub(super) fn new(gpu: &Gpu) -> Self {
        let frame_layout = layout(gpu, "frame", &[uniform()]);
        let light_layout = layout(gpu, "light", &[depth_texture(), comparison(), colour_texture()]);
        let material_layout = layout(gpu, "material", &[uniform()]);
        let hollows_layout = layout(gpu, "hollows", &[depth_texture(), colour_texture()]);
        let blur_layout = layout(gpu, "blur", &[colour_texture()]);

        let make = Maker { gpu, frame: &frame_layout };
        let mesh = make.module(&shaders::mesh());
        let ground = make.module(&shaders::ground());
        let depth = make.module(&shaders::depth());
        let hollows = make.module(&shaders::hollows());
        let blur = make.module(&shaders::blur());
        let background = make.module(&shaders::background());
        let line = make.module(&shaders::line());
        let wire = make.module(&shaders::wire());
        let opaque = Some(wgpu::ColorTargetState::from(COLOUR));
        let blended = Some(wgpu::ColorTargetState {
            blend: Some(wgpu::BlendState::ALPHA_BLENDING),
            ..wgpu::ColorTargetState::from(COLOUR)
        });
        let samples = gpu.samples;
        let nearer = (wgpu::CompareFunction::GreaterEqual, true);
        let tested = (wgpu::CompareFunction::GreaterEqual, false);
        let untested = (wgpu::CompareFunction::Always, false);
        let meshes = Some(mesh_vertices());
        Self {
            shadow: make.pipeline(Pass {
                depth: Some((wgpu::CompareFunction::LessEqual, true)),
                bias: wgpu::DepthBiasState { constant: 2, slope_scale: 2.0, clamp: 0.0 },
                vertices: meshes.clone(),
                ..Pass::new(&mesh, "shadow_vertex")
            }),
            depth: make.pipeline(Pass {
                fragment: Some(("depth_fragment", Some(NORMALS.into()))),
                depth: Some(nearer),
                vertices: meshes.clone(),
                ..Pass::new(&depth, "depth_vertex")
            }),
            depth_ground: make.pipeline(Pass {
                fragment: Some(("depth_fragment", Some(NORMALS.into()))),
                depth: Some(nearer),
                ..Pass::new(&depth, "depth_ground_vertex")
            }),
            hollows: make.pipeline(Pass {
                extra: &[&hollows_layout],
                fragment: Some(("hollows_fragment", Some(HOLLOWS.into()))),
                ..Pass::new(&hollows, "hollows_vertex")
            }),
            blur: make.pipeline(Pass {
                extra: &[&blur_layout],
                fragment: Some(("blur_fragment", Some(HOLLOWS.into()))),
                ..Pass::new(&blur, "blur_vertex")
            }),
            background: make.pipeline(Pass {
                fragment: Some(("background_fragment", opaque.clone())),
                depth: Some(untested),
                samples,
                ..Pass::new(&background, "background_vertex")
            }),
            ground: make.pipeline(Pass {
                extra: &[&light_layout],
                fragment: Some(("ground_fragment", blended.clone())),
                depth: Some(tested),
                samples,
                ..Pass::new(&ground, "ground_vertex")
            }),
            mesh: make.pipeline(Pass {
                extra: &[&light_layout, &material_layout],
                fragment: Some(("mesh_fragment", opaque)),
                depth: Some(nearer),
                vertices: meshes.clone(),
                samples,
                ..Pass::new(&mesh, "mesh_vertex")
            }),
            sheer: make.pipeline(Pass {
                extra: &[&light_layout, &material_layout],
                fragment: Some(("sheer_fragment", Some(sheer_target(samples)))),
                depth: Some(nearer),
                vertices: meshes.clone(),
                samples,
                covers_by_alpha: samples > 1,
                ..Pass::new(&mesh, "mesh_vertex")
            }),
            wire: make.pipeline(Pass {
                fragment: Some(("wire_fragment", blended.clone())),
                depth: Some(tested),
                vertices: meshes.clone(),
                samples,
                topology: wgpu::PrimitiveTopology::LineList,
                ..Pass::new(&wire, "wire_vertex")
            }),
            faint: make.pipeline(Pass {
                fragment: Some(("faint_fragment", blended.clone())),
                depth: Some(untested),
                vertices: Some(stroke_instances()),
                samples,
                ..Pass::new(&line, "line_vertex")
            }),
            line: make.pipeline(Pass {
                fragment: Some(("line_fragment", blended)),
                depth: Some(tested),
                vertices: Some(stroke_instances()),
                samples,
                ..Pass::new(&line, "line_vertex")
            }),
            frame_layout,
            light_layout,
            material_layout,
            hollows_layout,
            blur_layout,
        }
    }
}

/// What distinguishes one pass from another.
struct Pass<'a> {
    module: &'a wgpu::ShaderModule,
    vertex: &'a str,
    fragment: Option<(&'a str, Option<wgpu::ColorTargetState>)>,
    extra: &'a [&'a wgpu::BindGroupLayout],
    vertices: Option<wgpu::VertexBufferLayout<'a>>,
    depth: Option<(wgpu::CompareFunction, bool)>,
    bias: wgpu::DepthBiasState,
    samples: u32,
    covers_by_alpha: bool,
    topology: wgpu::PrimitiveTopology,
}

impl<'a> Pass<'a> {
    fn new(module: &'a wgpu::ShaderModule, vertex: &'a str) -> Self {
        Self {
            module,
            vertex,
            fragment: None,
            extra: &[],
            vertices: None,
            depth: None,
            bias: wgpu::DepthBiasState::default(),
            samples: 1,
            covers_by_alpha: false,
            topology: wgpu::PrimitiveTopology::TriangleList,
        }
    }
}

struct Maker<'a> {
    gpu: &'a Gpu,
    frame: &'a wgpu::BindGroupLayout,
}

impl Maker<'_> {
    fn module(&self, shader: &Shader) -> wgpu::ShaderModule {
        self.gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(shader.name),
            source: wgpu::ShaderSource::Wgsl(shader.text.as_str().into()),
        })
    }

    fn pipeline(&self, pass: Pass<'_>) -> wgpu::RenderPipeline {
        let groups: Vec<Option<&wgpu::BindGroupLayout>> =
            std::iter::once(Some(self.frame)).chain(pass.extra.iter().map(|&l| Some(l))).collect();
        let layout = self.gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(pass.vertex),
            bind_group_layouts: &groups,
            immediate_size: 0,
        });
        let targets = pass.fragment.as_ref().map(|(_, t)| [t.clone()]);
        let fragment =
            pass.fragment.as_ref().zip(targets.as_ref()).map(|((entry, _), targets)| wgpu::FragmentState {
                module: pass.module,
                entry_point: Some(entry),
                compilation_options: Default::default(),
                targets,
            });
        self.gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(pass.vertex),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: pass.module,
                entry_point: Some(pass.vertex),
                compilation_options: Default::default(),
                buffers: &[pass.vertices].into_iter().filter(Option::is_some).collect::<Vec<_>>(),
            },
            primitive: wgpu::PrimitiveState { topology: pass.topology, ..Default::default() },
            depth_stencil: pass.depth.map(|(compare, write)| wgpu::DepthStencilState {
                format: DEPTH,
                depth_write_enabled: Some(write),
                depth_compare: Some(compare),
                stencil: Default::default(),
                bias: pass.bias,
            }),
            multisample: wgpu::MultisampleState {
                count: pass.samples,
                alpha_to_coverage_enabled: pass.covers_by_alpha,
                ..Default::default()
            },
            fragment,
            multiview_mask: None,
            cache: None,
        })
    }
}

/// With several samples a pixel alpha takes some of them, in whatever order things are drawn; else it blends.
fn sheer_target(samples: u32) -> wgpu::ColorTargetState {
    let blend = (samples == 1).then_some(wgpu::BlendState::ALPHA_BLENDING);
    wgpu::ColorTargetState {
        blend,
        // What is seen through it is opaque already.
        write_mask: wgpu::ColorWrites::COLOR,
        ..wgpu::ColorTargetState::from(COLOUR)
    }
}

fn mesh_vertices() -> wgpu::VertexBufferLayout<'static> {
    const ATTRIBUTES: [wgpu::VertexAttribute; 3] =
        wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Unorm8x4];
    wgpu::VertexBufferLayout {
        array_stride: MESH_STRIDE,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &ATTRIBUTES,
    }
}

fn stroke_instances() -> wgpu::VertexBufferLayout<'static> {
    const ATTRIBUTES: [wgpu::VertexAttribute; 6] = wgpu::vertex_attr_array![
        0 => Float32x3, 1 => Float32x3, 2 => Float32x2, 3 => Float32x2, 4 => Unorm8x4, 5 => Float32x3
    ];
    wgpu::VertexBufferLayout {
        array_stride: size_of::<Stroke>() as u64,
        step_mode: wgpu::VertexStepMode::Instance,
        attributes: &ATTRIBUTES,
    }
}

fn layout(gpu: &Gpu, label: &str, kinds: &[wgpu::BindingType]) -> wgpu::BindGroupLayout {
    let entries: Vec<wgpu::BindGroupLayoutEntry> = kinds
        .iter()
        .enumerate()
        .map(|(i, &ty)| wgpu::BindGroupLayoutEntry {
            binding: i as u32,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty,
            count: None,
        })
        .collect();
    gpu.device
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries })
}

fn uniform() -> wgpu::BindingType {
    wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: None,
    }
}

fn sampled(sample_type: wgpu::TextureSampleType) -> wgpu::BindingType {
    wgpu::BindingType::Texture {
        sample_type,
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    }
}

fn depth_texture() -> wgpu::BindingType {
    sampled(wgpu::TextureSampleType::Depth)
}

fn colour_texture() -> wgpu::BindingType {
    sampled(wgpu::TextureSampleType::Float { filterable: false })
}

fn comparison() -> wgpu::BindingType {
    wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison)
}
