// Edges of triangles, one pixel wide, a little nearer to the eye than what they lie on.
@vertex
fn wire_vertex(@location(0) position: vec3f) -> @builtin(position) vec4f {
    let p = (frame.view * vec4f(position, 1.0)).xyz;
    let lift = frame.hollows.w * 0.3;
    let away = max(length(p), 1e-6);
    let nearer = select(p + vec3f(0.0, 0.0, lift), p * max(1.0 - lift / away, 0.5), frame.eye.w > 0.5);
    return on_grid(frame.projection * vec4f(nearer, 1.0), 256.0);
}

@fragment
fn wire_fragment() -> @location(0) vec4f {
    return vec4f(0.06, 0.09, 0.08, 0.5);
}
