// A 4 x 4 mean of the hollows that does not mix near with far.
@group(1) @binding(0) var rough_map: texture_2d<f32>;

@fragment
fn blur_fragment(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(at.xy);
    let size = vec2i(textureDimensions(rough_map));
    let here = textureLoad(rough_map, pixel, 0);
    if here.g > 50000.0 {
        return here;
    }
    var sum = 0.0;
    var weights = 0.0;
    for (var i = 0; i < 16; i++) {
        let other = clamp(pixel + vec2i((i & 3) - 2, (i >> 2u) - 2), vec2i(0), size - 1);
        let texel = textureLoad(rough_map, other, 0);
        let far = abs(texel.g - here.g) / (frame.hollows.x * 0.25 + here.g * 0.002);
        let weight = max(1.0 - far, 0.0) + 1e-4;
        sum += texel.r * weight;
        weights += weight;
    }
    return vec4f(sum / weights, here.g, 0.0, 1.0);
}
