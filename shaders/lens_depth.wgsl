// Depth with one sample for each pixel. Appended to lens.wgsl.
@group(1) @binding(1) var depth_map: texture_depth_2d;

fn nearest_stored(pixel: vec2i) -> f32 {
    return textureLoad(depth_map, pixel, 0);
}
