// Depth and view-space normals at half size, for hollows.wgsl.
struct Seen {
    @builtin(position) clip: vec4f,
    @location(0) normal: vec3f,
}

@vertex
fn depth_vertex(@location(0) position: vec3f, @location(1) normal: vec3f) -> Seen {
    return Seen(on_grid(frame.clip_from_world * vec4f(position, 1.0), 128.0), normal);
}

@vertex
fn depth_ground_vertex(@builtin(vertex_index) i: u32) -> Seen {
    var corners = array<vec2f, 6>(
        vec2f(-1.0, -1.0), vec2f(1.0, 1.0), vec2f(1.0, -1.0),
        vec2f(-1.0, -1.0), vec2f(-1.0, 1.0), vec2f(1.0, 1.0),
    );
    let place = frame.floor.xy + corners[i] * frame.floor.w;
    let world = vec4f(place.x, frame.floor.z, place.y, 1.0);
    return Seen(in_part(frame.clip_from_world * world), vec3f(0.0, 1.0, 0.0));
}

@fragment
fn depth_fragment(in: Seen, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    let side = select(-1.0, 1.0, front);
    let normal = normalize(in.normal + vec3f(0.0, 1e-9, 0.0)) * side;
    let in_view = (frame.view * vec4f(normal, 0.0)).xyz;
    return vec4f(in_view * 0.5 + 0.5, 1.0);
}
