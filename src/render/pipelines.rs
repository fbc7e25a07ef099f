//! The render pipelines of all passes.

use super::gpu::{COLOUR, DEPTH};
use super::shaders::{self, Shader};
use super::target::{FOCUS, HOLLOWS, LIGHT, NORMALS, Quality, REACH};
use super::{Gpu, strokes::Stroke};

/// Bind group layouts and pipelines, which last as long as the device.
#[derive(Debug)]
pub(super) struct Pipelines {
    pub(super) frame_layout: wgpu::BindGroupLayout,
    pub(super) light_layout: wgpu::BindGroupLayout,
    pub(super) material_layout: wgpu::BindGroupLayout,
    pub(super) picture_sampler: wgpu::Sampler,
    pub(super) hollows_layout: wgpu::BindGroupLayout,
    pub(super) blur_layout: wgpu::BindGroupLayout,
    pub(super) shadow: wgpu::RenderPipeline,
    pub(super) depth: wgpu::RenderPipeline,
    pub(super) depth_ground: wgpu::RenderPipeline,
    /// Ambient occlusion and its blur; None where shaders cannot load depth.
    pub(super) hollows: Option<[wgpu::RenderPipeline; 2]>,
    finished: Pictured,
    /// Pipelines for drafts; made when the first draft is drawn.
    draft: Option<Pictured>,
    /// Pipelines for depth of field; made when the first picture has it.
    lens: Option<LensPipelines>,
}

/// The layouts of bind group 1, and the pipelines, of the passes of depth of field.
#[derive(Debug)]
pub(super) struct LensPipelines {
    /// Uniform buffer and depth.
    pub(super) depth_layout: wgpu::BindGroupLayout,
    /// Uniform buffer and one texture.
    pub(super) one_layout: wgpu::BindGroupLayout,
    /// Uniform buffer and all that the blur reads: picture, light, focus, reach.
    pub(super) all_layout: wgpu::BindGroupLayout,
    pub(super) focus: wgpu::RenderPipeline,
    pub(super) light: wgpu::RenderPipeline,
    pub(super) spread: wgpu::RenderPipeline,
    pub(super) reach: wgpu::RenderPipeline,
    pub(super) blur: wgpu::RenderPipeline,
}

/// The pipelines that draw the picture itself, after the passes that prepare its light.
#[derive(Debug)]
pub(super) struct Pictured {
    pub(super) background: wgpu::RenderPipeline,
    pub(super) ground: wgpu::RenderPipeline,
    pub(super) cloth: wgpu::RenderPipeline,
    /// Meshes that are not cloth; in a draft with back faces culled.
    pub(super) skin: wgpu::RenderPipeline,
    pub(super) line: wgpu::RenderPipeline,
    /// Transparent meshes.
    pub(super) sheer: wgpu::RenderPipeline,
    /// Transparent cloth, such as a net.
    pub(super) open: wgpu::RenderPipeline,
    /// Edges of triangles (wireframe).
    pub(super) wire: wgpu::RenderPipeline,
    /// Lines and labels without depth test, drawn faintly where something hides them.
    pub(super) faint: wgpu::RenderPipeline,
}

/// Size of a mesh vertex (position, normal, colour, texture coordinates), bytes.
pub(super) const MESH_STRIDE: u64 = 36;

impl Pipelines {
    pub(super) fn new(gpu: &Gpu) -> Self {
        let frame_layout = layout(gpu, "frame", &[uniform()]);
        let light_layout = layout(gpu, "light", &[depth_texture(), comparison(), colour_texture()]);
        let material_layout = layout(gpu, "material", &[uniform(), pictures(), smooth()]);
        let hollows_layout = layout(gpu, "hollows", &[depth_texture(), colour_texture()]);
        let blur_layout = layout(gpu, "blur", &[colour_texture()]);

        let make = Maker { gpu, frame: &frame_layout };
        let mesh = make.module(&shaders::mesh());
        let depth = make.module(&shaders::depth());
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
                depth: Some(NEARER),
                vertices: meshes.clone(),
                ..Pass::new(&depth, "depth_vertex")
            }),
            depth_ground: make.pipeline(Pass {
                fragment: Some(("depth_fragment", Some(NORMALS.into()))),
                depth: Some(NEARER),
                ..Pass::new(&depth, "depth_ground_vertex")
            }),
            hollows: gpu.loads_depth.then(|| occlusion(&make, &hollows_layout, &blur_layout)),
            finished: Pictured::finished(&make, gpu.samples, &light_layout, &material_layout),
            draft: None,
            lens: None,
            picture_sampler: gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("pictures"),
                address_mode_u: wgpu::AddressMode::Repeat,
                address_mode_v: wgpu::AddressMode::Repeat,
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                mipmap_filter: wgpu::MipmapFilterMode::Linear,
                ..Default::default()
            }),
            frame_layout,
            light_layout,
            material_layout,
            hollows_layout,
            blur_layout,
        }
    }

    /// Makes the pipelines for drafts, unless they are there.
    pub(super) fn prepare_drafts(&mut self, gpu: &Gpu) {
        if self.draft.is_none() {
            let make = Maker { gpu, frame: &self.frame_layout };
            self.draft = Some(Pictured::draft(&make, &self.material_layout));
        }
    }

    /// The pipelines for depth of field, made now unless they are there.
    pub(super) fn lens(&mut self, gpu: &Gpu) -> &LensPipelines {
        let make = Maker { gpu, frame: &self.frame_layout };
        self.lens.get_or_insert_with(|| LensPipelines::new(&make, gpu.samples))
    }

    /// The pipelines for a quality. For drafts [`Pipelines::prepare_drafts`] must have been called.
    pub(super) fn pictured(&self, quality: Quality) -> &Pictured {
        match quality {
            Quality::Finished => &self.finished,
            Quality::Draft => self.draft.as_ref().unwrap_or(&self.finished),
        }
    }
}

/// The pipelines of ambient occlusion and of its blur.
fn occlusion(
    make: &Maker<'_>,
    hollows: &wgpu::BindGroupLayout,
    blur: &wgpu::BindGroupLayout,
) -> [wgpu::RenderPipeline; 2] {
    let passes =
        [(shaders::hollows(), "hollows_fragment", hollows), (shaders::blur(), "blur_fragment", blur)];
    passes.map(|(shader, fragment, inputs)| {
        make.pipeline(Pass {
            extra: &[Some(inputs)],
            fragment: Some((fragment, Some(HOLLOWS.into()))),
            ..Pass::new(&make.module(&shader), "whole_vertex")
        })
    })
}

impl LensPipelines {
    fn new(make: &Maker<'_>, samples: u32) -> Self {
        let depth = if samples > 1 { depth_samples() } else { depth_texture() };
        let depth_layout = layout(make.gpu, "lens depth", &[uniform(), depth]);
        let one_layout = layout(make.gpu, "lens", &[uniform(), colour_texture()]);
        let all_layout = layout(make.gpu, "lens blur", &[&[uniform()][..], &[colour_texture(); 4]].concat());
        let focus = make.module(&shaders::focus(samples > 1));
        let reach = make.module(&shaders::reach());
        let blur = make.module(&shaders::lens_blur());
        let pipeline = |module, inputs, fragment, format: wgpu::TextureFormat| {
            make.pipeline(Pass {
                extra: &[Some(inputs)],
                fragment: Some((fragment, Some(format.into()))),
                ..Pass::new(module, "whole_vertex")
            })
        };
        Self {
            focus: pipeline(&focus, &depth_layout, "focus_fragment", FOCUS),
            light: pipeline(&blur, &one_layout, "light_fragment", LIGHT),
            spread: pipeline(&reach, &one_layout, "spread_fragment", REACH),
            reach: pipeline(&reach, &one_layout, "reach_fragment", REACH),
            blur: pipeline(&blur, &all_layout, "lens_blur_fragment", COLOUR),
            depth_layout,
            one_layout,
            all_layout,
        }
    }
}

/// Depth compare function and whether depth is written: tested and written, for opaque things.
const NEARER: (wgpu::CompareFunction, bool) = (wgpu::CompareFunction::GreaterEqual, true);
/// Depth compare function and whether depth is written: tested but not written, for what is blended over opaque things.
const TESTED: (wgpu::CompareFunction, bool) = (wgpu::CompareFunction::GreaterEqual, false);
/// Depth compare function and whether depth is written: neither tested nor written.
const UNTESTED: (wgpu::CompareFunction, bool) = (wgpu::CompareFunction::Always, false);

impl Pictured {
    fn finished(
        make: &Maker<'_>,
        samples: u32,
        light: &wgpu::BindGroupLayout,
        material: &wgpu::BindGroupLayout,
    ) -> Self {
        let (mesh, ground) = (make.module(&shaders::mesh()), make.module(&shaders::ground()));
        let opaque = Pass {
            extra: &[Some(material), Some(light)],
            fragment: Some(("mesh_fragment", Some(COLOUR.into()))),
            depth: Some(NEARER),
            vertices: Some(mesh_vertices()),
            samples,
            ..Pass::new(&mesh, "mesh_vertex")
        };
        let ground = Pass {
            extra: &[None, Some(light)],
            fragment: Some(("ground_fragment", Some(blended()))),
            depth: Some(TESTED),
            samples,
            ..Pass::new(&ground, "ground_vertex")
        };
        let fragments = ["sheer_fragment", "open_fragment"];
        Self::of(make, samples, ground, opaque.clone(), opaque, fragments)
    }

    /// Pipelines for drafts: lit per vertex, without textures.
    fn draft(make: &Maker<'_>, material: &wgpu::BindGroupLayout) -> Self {
        let (mesh, ground) = (make.module(&shaders::draft()), make.module(&shaders::draft_ground()));
        let cloth = Pass {
            extra: &[Some(material)],
            fragment: Some(("draft_fragment", Some(COLOUR.into()))),
            depth: Some(NEARER),
            vertices: Some(mesh_vertices()),
            ..Pass::new(&mesh, "draft_vertex")
        };
        let ground = Pass {
            fragment: Some(("draft_ground_fragment", Some(blended()))),
            depth: Some(TESTED),
            ..Pass::new(&ground, "ground_vertex")
        };
        let skin = Pass { cull: Some(wgpu::Face::Back), ..cloth.clone() };
        let fragments = ["draft_sheer_fragment", "draft_open_fragment"];
        Self::of(make, 1, ground, cloth, skin, fragments)
    }

    fn of(
        make: &Maker<'_>,
        samples: u32,
        ground: Pass<'_>,
        cloth: Pass<'_>,
        skin: Pass<'_>,
        [sheer, open]: [&str; 2],
    ) -> Self {
        let background = make.module(&shaders::background());
        let line = make.module(&shaders::line());
        let wire = make.module(&shaders::wire());
        let strokes = |fragment, depth| Pass {
            fragment: Some((fragment, Some(blended()))),
            depth: Some(depth),
            vertices: Some(stroke_instances()),
            samples,
            ..Pass::new(&line, "line_vertex")
        };
        Self {
            background: make.pipeline(Pass {
                fragment: Some(("background_fragment", Some(COLOUR.into()))),
                depth: Some(UNTESTED),
                samples,
                ..Pass::new(&background, "whole_vertex")
            }),
            ground: make.pipeline(ground),
            sheer: make.pipeline(Pass {
                fragment: Some((sheer, Some(sheer_target(samples)))),
                covers_by_alpha: samples > 1,
                ..skin.clone()
            }),
            open: make.pipeline(Pass {
                fragment: Some((open, Some(sheer_target(samples)))),
                covers_by_alpha: samples > 1,
                ..cloth.clone()
            }),
            cloth: make.pipeline(cloth),
            skin: make.pipeline(skin),
            wire: make.pipeline(Pass {
                fragment: Some(("wire_fragment", Some(blended()))),
                depth: Some(TESTED),
                vertices: Some(mesh_vertices()),
                samples,
                topology: wgpu::PrimitiveTopology::LineList,
                ..Pass::new(&wire, "wire_vertex")
            }),
            faint: make.pipeline(strokes("faint_fragment", UNTESTED)),
            line: make.pipeline(strokes("line_fragment", TESTED)),
        }
    }
}

/// The settings in which passes differ.
#[derive(Clone)]
struct Pass<'a> {
    module: &'a wgpu::ShaderModule,
    vertex: &'a str,
    fragment: Option<(&'a str, Option<wgpu::ColorTargetState>)>,
    /// Bind groups after group 0, which is the frame's.
    extra: &'a [Option<&'a wgpu::BindGroupLayout>],
    vertices: Option<wgpu::VertexBufferLayout<'a>>,
    depth: Option<(wgpu::CompareFunction, bool)>,
    bias: wgpu::DepthBiasState,
    samples: u32,
    covers_by_alpha: bool,
    topology: wgpu::PrimitiveTopology,
    cull: Option<wgpu::Face>,
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
            cull: None,
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
            std::iter::once(Some(self.frame)).chain(pass.extra.iter().copied()).collect();
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
            primitive: wgpu::PrimitiveState {
                topology: pass.topology,
                cull_mode: pass.cull,
                ..Default::default()
            },
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

fn blended() -> wgpu::ColorTargetState {
    wgpu::ColorTargetState {
        blend: Some(wgpu::BlendState::ALPHA_BLENDING),
        ..wgpu::ColorTargetState::from(COLOUR)
    }
}

/// Colour target of transparent meshes. With multisampling alpha selects samples (alpha to coverage), which needs no order of
/// drawing; else it blends.
fn sheer_target(samples: u32) -> wgpu::ColorTargetState {
    let blend = (samples == 1).then_some(wgpu::BlendState::ALPHA_BLENDING);
    wgpu::ColorTargetState {
        blend,
        // Alpha is not written: behind transparent meshes the picture is opaque already.
        write_mask: wgpu::ColorWrites::COLOR,
        ..wgpu::ColorTargetState::from(COLOUR)
    }
}

fn mesh_vertices() -> wgpu::VertexBufferLayout<'static> {
    const ATTRIBUTES: [wgpu::VertexAttribute; 4] =
        wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Unorm8x4, 3 => Float32x2];
    wgpu::VertexBufferLayout {
        array_stride: MESH_STRIDE,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &ATTRIBUTES,
    }
}

fn stroke_instances() -> wgpu::VertexBufferLayout<'static> {
    const ATTRIBUTES: [wgpu::VertexAttribute; 6] = wgpu::vertex_attr_array![
        0 => Float32x3, 1 => Float32x3, 2 => Float32x2, 3 => Float32x2, 4 => Unorm8x4, 5 => Float32x4
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

/// Depth with several samples for each pixel.
fn depth_samples() -> wgpu::BindingType {
    wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Depth,
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: true,
    }
}

fn colour_texture() -> wgpu::BindingType {
    sampled(wgpu::TextureSampleType::Float { filterable: false })
}

/// Pictures as layers of a texture.
fn pictures() -> wgpu::BindingType {
    wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: true },
        view_dimension: wgpu::TextureViewDimension::D2Array,
        multisampled: false,
    }
}

fn smooth() -> wgpu::BindingType {
    wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering)
}

fn comparison() -> wgpu::BindingType {
    wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison)
}
