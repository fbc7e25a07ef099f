// Ambient occlusion from depth and normals, at half size, after McGuire, Mara and Luebke, "Scalable ambient obscurance"
// (HPG 2012); then a small blur that respects depth.
@group(1) @binding(0) var depth_map: texture_depth_2d;
@group(1) @binding(1) var normal_map: texture_2d<f32>;

const SAMPLES: i32 = 12;

// The place in the whole picture, 0..1, of a texel.
fn place_of(texel: vec2i) -> vec2f {
    return (frame.around.xy + 2.0 * vec2f(texel) + 1.0) * frame.viewport.zw;
}

@fragment
fn hollows_fragment(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(at.xy);
    let size = vec2i(textureDimensions(depth_map));
    let whole = pixel + vec2i(frame.around.xy * 0.5);
    let depth = textureLoad(depth_map, pixel, 0);
    if depth <= 0.0 {
        return vec4f(1.0, 60000.0, 0.0, 1.0);
    }
    let here = view_position(place_of(pixel), depth);
    let normal = normalize(textureLoad(normal_map, pixel, 0).xyz * 2.0 - 1.0);
    let radius = frame.hollows.x;
    let w = frame.projection[2][3] * here.z + frame.projection[3][3];
    let height = frame.viewport.y * 0.5;
    let reach = min(radius * frame.projection[1][1] * height * 0.5 / w, height * 0.3);
    // A 4 x 4 pattern of turns, which the blur evens out.
    let turn = f32((whole.x & 3) * 4 + ((whole.y * 7 + whole.x * 2) & 3)) * 0.39269908;
    let noise = f32((whole.y & 3) * 4 + (whole.x * 3 & 3)) / 16.0;
    let bias = radius * 0.02 - here.z * 0.0006;
    var sum = 0.0;
    for (var i = 0; i < SAMPLES; i++) {
        let part = (f32(i) + 0.25 + noise * 0.75) / f32(SAMPLES);
        let angle = f32(i) * 2.3999632 + turn;
        let other = pixel + vec2i(round(vec2f(cos(angle), sin(angle)) * part * reach));
        let inside = clamp(other, vec2i(0), size - 1);
        let there = textureLoad(depth_map, inside, 0);
        if there > 0.0 {
            let v = view_position(place_of(inside), there) - here;
            let vv = dot(v, v);
            let near = max(1.0 - vv / (radius * radius), 0.0);
            sum += near * near * near * max((dot(v, normal) - bias) / (vv + radius * radius * 1e-3), 0.0);
        }
    }
    let open = clamp(1.0 - sum * radius * 1.7 / f32(SAMPLES), 0.0, 1.0);
    return vec4f(open, -here.z, 0.0, 1.0);
}
