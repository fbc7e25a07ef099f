//! Draws a scene: shadow map, depth and normals, ambient occlusion, then everything with light.

use glam::UVec2;

use super::buffers::{DeviceMesh, Wire, bind, upload};
use super::frame::Frame;
use super::gpu::DEPTH;
use super::lens_blur::LensBlur;
use super::part::BLUR_REACH;
use super::pass::begin;
use super::pipelines::{Pictured, Pipelines};
use super::strokes::strokes;
use super::target::{HalfSize, texture};
use super::{Camera, Gpu, Look, OffscreenTarget, Quality, RenderError, Scene};

/// Pipelines, shadow map, and the meshes and the textures for depth of field of the last picture; one per device.
#[derive(Debug)]
pub struct Renderer {
    pipelines: Pipelines,
    shadow_map: wgpu::TextureView,
    shadow_sampler: wgpu::Sampler,
    meshes: Vec<DeviceMesh>,
    lens: Option<LensBlur>,
}

/// The bind groups and buffers of one picture.
struct Bound {
    frame: wgpu::BindGroup,
    /// Shadow map and ambient occlusion; None in a draft.
    light: Option<wgpu::BindGroup>,
    strokes: Option<(wgpu::Buffer, u32)>,
    ground: bool,
}

impl Renderer {
    /// Creates the pipelines and the shadow map.
    ///
    /// # Errors
    /// Where the adapter cannot, such as one that does not take a shader.
    pub fn new(gpu: &Gpu) -> Result<Self, RenderError> {
        gpu.checked(|| Ok(Self::unchecked(gpu)))
    }

    fn unchecked(gpu: &Gpu) -> Self {
        let side = if gpu.software { 1024 } else { 2048 };
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
        Self {
            pipelines: Pipelines::new(gpu),
            shadow_map: texture(gpu, "shadow map", UVec2::splat(side), DEPTH, 1, usage)
                .create_view(&Default::default()),
            shadow_sampler: gpu.device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("shadow"),
                mag_filter: wgpu::FilterMode::Linear,
                min_filter: wgpu::FilterMode::Linear,
                compare: Some(wgpu::CompareFunction::LessEqual),
                ..Default::default()
            }),
            meshes: Vec::new(),
            lens: None,
        }
    }

    /// Draws `scene` on `target`. The work is submitted to the device; reading the target waits for it.
    ///
    /// # Errors
    /// Where the device reports one, or the adapter cannot hold the scene or draw depth of field that `look` asks for.
    pub fn draw(
        &mut self,
        gpu: &Gpu,
        scene: &Scene,
        camera: &Camera,
        look: &Look,
        target: &OffscreenTarget,
    ) -> Result<(), RenderError> {
        if look.lens.is_some() && target.quality == Quality::Finished && !gpu.loads_depth {
            return Err(RenderError::NoDepthOfField(gpu.adapter_name.clone()));
        }
        let look = &Look { occlusion: if gpu.loads_depth { look.occlusion } else { 0.0 }, ..*look };
        gpu.checked(|| {
            let frame = Frame::new(camera, scene, look, &target.part);
            let wire = look.wire.then(|| Wire::new(look.drawn_per_pixel, frame.wire_lift()));
            let last = std::mem::take(&mut self.meshes);
            self.meshes = upload(gpu, &self.pipelines, last, &scene.meshes, wire)?;
            let bound = self.bind(gpu, &frame, scene, camera, look, target);
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            if let Some(half) = &target.half {
                self.draw_shadow_map(&mut encoder, &bound);
                if let Some(pipelines) = self.pipelines.hollows.as_ref().filter(|_| look.occlusion > 0.0) {
                    self.draw_hollows(gpu, &mut encoder, &bound, target, (half, pipelines));
                }
            }
            if target.quality == Quality::Draft {
                self.pipelines.prepare_drafts(gpu);
            }
            let lens = look.lens.filter(|_| target.quality == Quality::Finished);
            let defocus = lens.and_then(|lens| lens.defocus(camera, target.part.whole));
            self.lens = defocus.map(|_| LensBlur::for_target(self.lens.take(), gpu, target));
            self.draw_picture(&mut encoder, &bound, look, wire, target);
            if let Some((defocus, lens)) = defocus.zip(self.lens.as_ref()) {
                let with = self.pipelines.lens(gpu);
                lens.blur(gpu, &mut encoder, with, &bound.frame, (defocus, bound.ground), target);
            }
            gpu.queue.submit([encoder.finish()]);
            Ok(())
        })
    }

    fn bind(
        &self,
        gpu: &Gpu,
        frame: &Frame,
        scene: &Scene,
        camera: &Camera,
        look: &Look,
        target: &OffscreenTarget,
    ) -> Bound {
        let frame = gpu.buffer("frame", bytemuck::bytes_of(frame), wgpu::BufferUsages::UNIFORM);
        let strokes = strokes(&scene.lines, &scene.labels, look.pixels_per_point);
        let bytes = bytemuck::cast_slice(&strokes);
        let buffer = || gpu.buffer("strokes", bytes, wgpu::BufferUsages::VERTEX);
        let view = wgpu::BindingResource::TextureView;
        let p = &self.pipelines;
        Bound {
            frame: bind(gpu, &p.frame_layout, &[frame.as_entire_binding()]),
            light: target.half.as_ref().map(|half| {
                let sampler = wgpu::BindingResource::Sampler(&self.shadow_sampler);
                bind(gpu, &p.light_layout, &[view(&self.shadow_map), sampler, view(&half.hollows)])
            }),
            strokes: (!strokes.is_empty()).then(|| (buffer(), strokes.len() as u32)),
            // Seen from below, the floor would only hide the scene.
            ground: scene.ground.is_some_and(|g| camera.eye().y > g.height) && !look.cut_out,
        }
    }

    fn draw_wire(&self, pass: &mut wgpu::RenderPass<'_>, with: &Pictured, wire: Wire) {
        if wire == Wire::Thin {
            pass.set_pipeline(&with.wire);
            for mesh in &self.meshes {
                if let Some((edges, count)) = &mesh.edges {
                    pass.set_vertex_buffer(0, mesh.vertices.slice(..));
                    pass.set_index_buffer(edges.slice(..), wgpu::IndexFormat::Uint32);
                    pass.draw_indexed(0..*count, 0, 0..1);
                }
            }
            return;
        }
        pass.set_pipeline(&with.line);
        for (strokes, count) in self.meshes.iter().filter_map(|mesh| mesh.strokes_as(wire)) {
            pass.set_vertex_buffer(0, strokes.slice(..));
            pass.draw(0..6, 0..count);
        }
    }

    fn draw_meshes(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        with_material: bool,
        which: impl Fn(&DeviceMesh) -> bool,
    ) {
        for mesh in self.meshes.iter().filter(|mesh| which(mesh)) {
            if with_material {
                pass.set_bind_group(1, &mesh.material, &[]);
            }
            pass.set_vertex_buffer(0, mesh.vertices.slice(..));
            pass.set_index_buffer(mesh.indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..mesh.index_count, 0, 0..1);
        }
    }

    fn draw_shadow_map(&self, encoder: &mut wgpu::CommandEncoder, bound: &Bound) {
        let mut pass = begin(encoder, "shadow map", None, Some((&self.shadow_map, 1.0)));
        pass.set_bind_group(0, &bound.frame, &[]);
        pass.set_pipeline(&self.pipelines.shadow);
        self.draw_meshes(&mut pass, false, |mesh| !mesh.is_open());
    }

    fn draw_hollows(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        bound: &Bound,
        target: &OffscreenTarget,
        (half, [hollow, blurred]): (&HalfSize, &[wgpu::RenderPipeline; 2]),
    ) {
        let view = wgpu::BindingResource::TextureView;
        let hollows = bind(gpu, &self.pipelines.hollows_layout, &[view(&half.depth), view(&half.normals)]);
        let blur = bind(gpu, &self.pipelines.blur_layout, &[view(&half.rough_hollows)]);
        {
            let mut pass = begin(encoder, "depth", Some((&half.normals, None)), Some((&half.depth, 0.0)));
            pass.set_bind_group(0, &bound.frame, &[]);
            if bound.ground {
                pass.set_pipeline(&self.pipelines.depth_ground);
                pass.draw(0..6, 0..1);
            }
            pass.set_pipeline(&self.pipelines.depth);
            self.draw_meshes(&mut pass, false, |mesh| !mesh.is_open());
        }
        for (label, pipeline, inputs, output) in
            [("hollows", hollow, &hollows, &half.rough_hollows), ("blur", blurred, &blur, &half.hollows)]
        {
            let mut pass = begin(encoder, label, Some((output, None)), None);
            pass.set_bind_group(0, &bound.frame, &[]);
            pass.set_bind_group(1, inputs, &[]);
            // Of a tile's surroundings only the depths are needed.
            let [first, size] = target.part.needed(BLUR_REACH);
            pass.set_scissor_rect(first.x, first.y, size.x, size.y);
            pass.set_pipeline(pipeline);
            pass.draw(0..3, 0..1);
        }
    }

    fn draw_picture(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        bound: &Bound,
        look: &Look,
        wire: Option<Wire>,
        target: &OffscreenTarget,
    ) {
        let (picture, depth) = match &self.lens {
            Some(lens) => (&lens.sharp, &lens.depth),
            None => (&target.picture_view, &target.depth),
        };
        let colour = match &target.samples {
            Some(samples) => (samples, Some(picture)),
            None => (picture, None),
        };
        let with = self.pipelines.pictured(target.quality);
        let mut pass = begin(encoder, "picture", Some(colour), Some((depth, 0.0)));
        pass.set_bind_group(0, &bound.frame, &[]);
        // Shaders place things in the part with its surroundings, so that triangles are not clipped at the border of a tile: a
        // clipped edge is rounded a little otherwise than the whole.
        let part = &target.part;
        let corner = part.around_at.as_vec2() - part.at.as_vec2();
        let size = part.around_size.as_vec2();
        pass.set_viewport(corner.x, corner.y, size.x, size.y, 0.0, 1.0);
        if !look.cut_out {
            pass.set_pipeline(&with.background);
            pass.draw(0..3, 0..1);
        }
        if let Some(light) = &bound.light {
            pass.set_bind_group(2, light, &[]);
        }
        if bound.ground {
            pass.set_pipeline(&with.ground);
            pass.draw(0..6, 0..1);
        }
        // A cut-out picture has no background that could show through.
        let sheer = look.sheer && !look.cut_out;
        pass.set_pipeline(&with.cloth);
        self.draw_meshes(&mut pass, true, |mesh| mesh.is_cloth() && !mesh.is_open());
        pass.set_pipeline(if sheer { &with.sheer } else { &with.skin });
        self.draw_meshes(&mut pass, true, |mesh| !mesh.is_cloth());
        pass.set_pipeline(&with.open);
        self.draw_meshes(&mut pass, true, DeviceMesh::is_open);
        if let Some(wire) = wire {
            self.draw_wire(&mut pass, with, wire);
        }
        if let Some((strokes, count)) = &bound.strokes {
            pass.set_vertex_buffer(0, strokes.slice(..));
            if look.xray {
                pass.set_pipeline(&with.faint);
                pass.draw(0..6, 0..*count);
            }
            pass.set_pipeline(&with.line);
            pass.draw(0..6, 0..*count);
        }
    }
}
