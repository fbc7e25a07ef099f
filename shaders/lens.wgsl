// What the passes of depth of field know. Appended to frame.wgsl.
// LensUniform in src/render/lens_blur.rs matches it.
struct Lens {
    focus: f32,    // depth of the plane in focus, metres
    farthest: f32, // radius of the circle of confusion of what is infinitely far, pixels
    most: f32,     // largest radius, pixels
    floor: f32,    // 1 where the floor is drawn
}

@group(1) @binding(0) var<uniform> lens: Lens;

// Depth of what nothing is drawn at, metres.
const FAR: f32 = 1e9;
// Side of a block of pixels of the whole picture. As in src/render/lens_blur.rs.
const BLOCK: i32 = 16;

// The first block of the whole picture that the part reaches into.
fn first_block() -> vec2i {
    return vec2i(frame.part.xy) / BLOCK;
}
