// A vertical gradient behind everything.
@vertex
fn background_vertex(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
    let corner = vec2f(f32((i << 1u) & 2u), f32(i & 2u));
    return vec4f(corner * 2.0 - 1.0, 0.0, 1.0);
}

@fragment
fn background_fragment(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let pixel = in_whole(at.xy);
    let down = smoothstep(0.0, 1.0, pixel.y * frame.viewport.w);
    return vec4f(mix(frame.sky.rgb, frame.horizon.rgb, down) + dither(pixel), 1.0);
}
