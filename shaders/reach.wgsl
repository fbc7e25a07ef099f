// How far circles of confusion reach, in blocks of pixels: where none does, the blur has nothing to gather.
@group(1) @binding(1) var radius_map: texture_2d<f32>;

// The largest radius in a block.
@fragment
fn spread_fragment(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let size = vec2i(textureDimensions(radius_map));
    let corner = (first_block() + vec2i(at.xy)) * BLOCK - vec2i(frame.part.xy);
    let first = max(corner, vec2i(0));
    let end = min(corner + BLOCK, size);
    var most = 0.0;
    for (var y = first.y; y < end.y; y++) {
        for (var x = first.x; x < end.x; x++) {
            most = max(most, textureLoad(radius_map, vec2i(x, y), 0).g);
        }
    }
    return vec4f(most, 0.0, 0.0, 1.0);
}

// The largest radius of the blocks that reach into a block.
@fragment
fn reach_fragment(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let block = vec2i(at.xy);
    let last = vec2i(textureDimensions(radius_map)) - 1;
    let away = i32(lens.most) / BLOCK + 2;
    let first = max(block - away, vec2i(0));
    let end = min(block + away, last);
    var most = 0.0;
    for (var y = first.y; y <= end.y; y++) {
        for (var x = first.x; x <= end.x; x++) {
            let other = vec2i(x, y);
            let radius = textureLoad(radius_map, other, 0).r;
            // From the nearest pixels of the two.
            let gap = max(abs(other - block) * BLOCK - BLOCK + 1, vec2i(0));
            if radius + 0.5 > length(vec2f(gap)) {
                most = max(most, radius);
            }
        }
    }
    return vec4f(most, 0.0, 0.0, 1.0);
}
