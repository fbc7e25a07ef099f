//! Beginning of render passes.

/// Begins a pass that clears its attachments. With a resolve target the multisampled texture is discarded after the pass.
pub(super) fn begin<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    label: &str,
    colour: Option<(&wgpu::TextureView, Option<&wgpu::TextureView>)>,
    depth: Option<(&wgpu::TextureView, f32)>,
) -> wgpu::RenderPass<'e> {
    let colours = colour.map(|(view, resolve_target)| {
        [Some(wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                store: if resolve_target.is_some() { wgpu::StoreOp::Discard } else { wgpu::StoreOp::Store },
            },
        })]
    });
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(label),
        color_attachments: colours.as_ref().map_or(&[], |c| c.as_slice()),
        depth_stencil_attachment: depth.map(|(view, far)| wgpu::RenderPassDepthStencilAttachment {
            view,
            depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(far), store: wgpu::StoreOp::Store }),
            stencil_ops: None,
        }),
        ..Default::default()
    })
}
