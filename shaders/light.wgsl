// Shadow and hollows, as mesh.wgsl and ground.wgsl read them. Appended to frame.wgsl.
@group(2) @binding(0) var shadow_map: texture_depth_2d;
@group(2) @binding(1) var shadow_sampler: sampler_comparison;
@group(2) @binding(2) var hollow_map: texture_2d<f32>;

// 1 in the light, 0 in shadow; `spread` in texels of the shadow map, `pixel` in the whole picture.
fn lit(world: vec3f, spread: f32, pixel: vec2f) -> f32 {
    let clip = frame.lamp_from_world * vec4f(world, 1.0);
    let place = vec2f(clip.x * 0.5 + 0.5, 0.5 - clip.y * 0.5);
    if any(place < vec2f(0.0)) || any(place > vec2f(1.0)) || clip.z > 1.0 {
        return 1.0;
    }
    let texel = spread / vec2f(textureDimensions(shadow_map));
    let turn = 6.2831853 * speckle(pixel);
    let x = vec2f(cos(turn), sin(turn)) * texel;
    let y = vec2f(-sin(turn), cos(turn)) * texel;
    // Points of a Vogel disc, turned differently in every pixel.
    var disc = array<vec2f, 6>(
        vec2f(0.289, 0.0), vec2f(-0.369, 0.338), vec2f(0.056, -0.643),
        vec2f(0.465, 0.606), vec2f(-0.853, -0.151), vec2f(0.808, -0.514),
    );
    var sum = 0.0;
    for (var i = 0; i < 6; i++) {
        let offset = x * disc[i].x + y * disc[i].y;
        sum += textureSampleCompareLevel(shadow_map, shadow_sampler, place + offset, clip.z);
    }
    return sum / 6.0;
}

// 1 in the open, less in hollows; `pixel` in the part that is drawn. Four texels of the half-size map, weighed by how near in depth they are.
fn openness(pixel: vec2f, depth: f32) -> f32 {
    if frame.hollows.z < 0.5 {
        return 1.0;
    }
    let size = vec2i(textureDimensions(hollow_map));
    let at = (pixel + frame.part.xy - frame.around.xy) * 0.5 - 0.5;
    let base = vec2i(floor(at));
    let part = at - floor(at);
    var sum = 0.0;
    var weights = 1e-5;
    for (var i = 0; i < 4; i++) {
        let corner = vec2i(i & 1, i >> 1u);
        let texel = textureLoad(hollow_map, clamp(base + corner, vec2i(0), size - 1), 0);
        let near = select(1.0 - part, part, corner == vec2i(1));
        let far = abs(texel.g - depth) / (frame.hollows.x * 0.3 + depth * 0.002);
        let weight = (near.x * near.y + 1e-3) * max(1.0 - far, 1e-4);
        sum += texel.r * weight;
        weights += weight;
    }
    return sum / weights;
}
