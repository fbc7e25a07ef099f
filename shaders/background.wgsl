// A vertical gradient behind everything.
@fragment
fn background_fragment(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let pixel = in_whole(at.xy);
    let down = smoothstep(0.0, 1.0, pixel.y * frame.viewport.w);
    return vec4f(mix(frame.sky.rgb, frame.horizon.rgb, down) + dither(pixel), 1.0);
}
