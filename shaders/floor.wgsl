// The floor, with a faint ten-centimetre grid that fades away. Appended to frame.wgsl.
struct Floor {
    @builtin(position) clip: vec4f,
    @location(0) world: vec3f,
    @location(1) depth: f32,
}

@vertex
fn ground_vertex(@builtin(vertex_index) i: u32) -> Floor {
    var corners = array<vec2f, 6>(
        vec2f(-1.0, -1.0), vec2f(1.0, 1.0), vec2f(1.0, -1.0),
        vec2f(-1.0, -1.0), vec2f(-1.0, 1.0), vec2f(1.0, 1.0),
    );
    let place = frame.floor.xy + corners[i] * frame.floor.w;
    var out: Floor;
    out.world = vec3f(place.x, frame.floor.z, place.y);
    out.clip = in_part(frame.clip_from_world * vec4f(out.world, 1.0));
    out.depth = -(frame.view * vec4f(out.world, 1.0)).z;
    return out;
}

// How much of a line of the grid with this spacing (metres) covers the pixel.
fn grid(at: vec2f, spacing: f32, width: vec2f) -> f32 {
    let away = abs(fract(at / spacing - 0.5) - 0.5) * spacing;
    let cover = clamp(1.0 - away / max(width, vec2f(1e-6)), vec2f(0.0), vec2f(1.0));
    // Lines that are closer than a few pixels melt into the floor.
    let clear = clamp(spacing / max(width.x, width.y) / 6.0 - 0.5, 0.0, 1.0);
    return max(cover.x, cover.y) * clear;
}

// `shade`: how much light comes to it, 0..1.
fn floor_colour(in: Floor, shade: f32) -> vec4f {
    let pixel = fwidth(in.world.xz) * frame.towards_eye.w;
    let away = length(in.world.xz - frame.floor.xy) / frame.floor.w;
    let fade = 1.0 - smoothstep(0.15, 1.0, away);
    let lines = max(grid(in.world.xz, 0.1, pixel * 1.2) * 0.45, grid(in.world.xz, 0.5, pixel * 1.4));
    let light = dot(frame.ground.rgb, vec3f(0.33)) > 0.2;
    let ink = select(vec3f(1.6), vec3f(0.62), light);
    let colour = frame.ground.rgb * shade * mix(vec3f(1.0), ink, lines * frame.ground.w * fade);
    return vec4f(encoded(colour) + dither(in_whole(in.clip.xy)), fade);
}
