// Depth (metres) and radius of the circle of confusion (pixels) of each pixel.

// Depth of the floor at a place in the picture (0..1, y down): it is drawn without writing depth.
fn floor_depth(place: vec2f) -> f32 {
    let seen = view_position(place, 0.5);
    let ray = seen / -seen.z;
    // Rows of the rotation from view to world.
    let along = vec3f(dot(frame.view[0].xyz, ray), dot(frame.view[1].xyz, ray), dot(frame.view[2].xyz, ray));
    if lens.floor < 0.5 || along.y > -1e-6 {
        return FAR;
    }
    let depth = (frame.floor.z - frame.eye.y) / along.y;
    let at = frame.eye.xz + depth * along.xz;
    return select(FAR, depth, distance(at, frame.floor.xy) < frame.floor.w);
}

@fragment
fn focus_fragment(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let place = in_whole(at.xy) * frame.viewport.zw;
    let stored = nearest_stored(vec2i(at.xy));
    var depth = floor_depth(place);
    if stored > 0.0 {
        depth = -view_position(place, stored).z;
    }
    // The background is so smooth that blur would not change it.
    if depth >= FAR {
        return vec4f(FAR, 0.0, 0.0, 1.0);
    }
    let radius = lens.farthest * abs(depth - lens.focus) / depth;
    return vec4f(depth, min(radius, lens.most), 0.0, 1.0);
}
