// Depth with several samples for each pixel. Appended to lens.wgsl.
@group(1) @binding(1) var depth_map: texture_depth_multisampled_2d;

// The nearest of a pixel's samples: a pixel at a border counts to what is in front, so that this leaves no rim on what lies behind.
fn nearest_stored(pixel: vec2i) -> f32 {
    var nearest = 0.0;
    for (var i = 0; i < i32(textureNumSamples(depth_map)); i++) {
        nearest = max(nearest, textureLoad(depth_map, pixel, i));
    }
    return nearest;
}
