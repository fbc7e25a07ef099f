//! The passes of depth of field: from the colours and depths of a picture the blur of a lens is gathered.

use bytemuck::{Pod, Zeroable};
use glam::UVec2;

use super::buffers::bind;
use super::frame::nearest_depth;
use super::gpu::{COLOUR, DEPTH};
use super::lens::Defocus;
use super::pass::begin;
use super::pipelines::LensPipelines;
use super::target::{FOCUS, LIGHT, OffscreenTarget, REACH, texture};
use super::{Camera, Gpu, Look, Scene};

/// Side of a block, pixels. As in shaders/lens.wgsl.
const BLOCK: u32 = 16;

/// The uniform buffer of the passes. It matches `Lens` in shaders/lens.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct LensUniform {
    focus: f32,
    farthest: f32,
    most: f32,
    floor: f32,
}

/// The textures for depth of field, for targets of one size.
#[derive(Debug)]
pub(super) struct LensBlur {
    /// Size, samples per pixel, and number of blocks each way.
    made_for: (UVec2, u32, UVec2),
    /// The picture before it is blurred.
    pub(super) sharp: wgpu::TextureView,
    /// Its depth.
    pub(super) depth: wgpu::TextureView,
    focus: wgpu::TextureView,
    light: wgpu::TextureView,
    spread: wgpu::TextureView,
    reach: wgpu::TextureView,
}

impl LensBlur {
    /// The textures for `target`: those of the last picture, if they fit.
    pub(super) fn for_target(last: Option<Self>, gpu: &Gpu, target: &OffscreenTarget) -> Self {
        let (at, size) = (target.part.at, target.size);
        let samples = target.quality.samples(gpu);
        let first = at / BLOCK;
        let blocks = (at + size + (BLOCK - 1)) / BLOCK - first;
        let made_for = (size, samples, blocks);
        if let Some(last) = last.filter(|last| last.made_for == made_for) {
            return last;
        }
        let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
        let view = |label, size, format, samples| {
            texture(gpu, label, size, format, samples, usage).create_view(&Default::default())
        };
        Self {
            made_for,
            sharp: view("sharp picture", size, COLOUR, 1),
            depth: view("lens depth", size, DEPTH, samples),
            focus: view("focus", size, FOCUS, 1),
            light: view("light", size, LIGHT, 1),
            spread: view("spread", blocks, REACH, 1),
            reach: view("reach", blocks, REACH, 1),
        }
    }

    /// Draws the blurred picture on `target`, from what is drawn on `self.sharp` and `self.depth`. `frame` is its uniform buffer,
    /// `ground` whether the floor is drawn.
    pub(super) fn blur(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        pipelines: &LensPipelines,
        frame: &wgpu::BindGroup,
        (defocus, ground): (Defocus, bool),
        target: &OffscreenTarget,
    ) {
        let Defocus { focus, farthest, most } = defocus;
        let uniform = LensUniform { focus, farthest, most, floor: f32::from(ground) };
        let uniform = gpu.buffer("lens", bytemuck::bytes_of(&uniform), wgpu::BufferUsages::UNIFORM);
        let of = |layout: &wgpu::BindGroupLayout, views: &[&wgpu::TextureView]| {
            let views = views.iter().map(|&view| wgpu::BindingResource::TextureView(view));
            let all: Vec<_> = std::iter::once(uniform.as_entire_binding()).chain(views).collect();
            bind(gpu, layout, &all)
        };
        let p = pipelines;
        let all = [&self.sharp, &self.light, &self.focus, &self.reach];
        for (label, pipeline, inputs, output) in [
            ("focus", &p.focus, of(&p.depth_layout, &[&self.depth]), &self.focus),
            ("light", &p.light, of(&p.one_layout, &[&self.sharp]), &self.light),
            ("spread", &p.spread, of(&p.one_layout, &[&self.focus]), &self.spread),
            ("reach", &p.reach, of(&p.one_layout, &[&self.spread]), &self.reach),
            ("lens blur", &p.blur, of(&p.all_layout, &all), &target.picture_view),
        ] {
            let mut pass = begin(encoder, label, Some((output, None)), None);
            pass.set_bind_group(0, frame, &[]);
            pass.set_bind_group(1, &inputs, &[]);
            pass.set_pipeline(pipeline);
            pass.draw(0..3, 0..1);
        }
    }
}

/// How far beyond a tile its blur depends on what is drawn, in pixels of a picture of `size` pixels; even.
pub(super) fn blur_margin(camera: &Camera, scene: &Scene, look: &Look, size: UVec2) -> u32 {
    let Some(defocus) = look.lens.and_then(|lens| lens.defocus(camera, size)) else { return 0 };
    let largest = defocus.largest(nearest_depth(camera, scene, size.as_vec2()));
    if largest <= 0.5 {
        return 0;
    }
    // The reach of a block is known from whole blocks.
    (largest.ceil() as u32 + 2 * BLOCK).next_multiple_of(2)
}
