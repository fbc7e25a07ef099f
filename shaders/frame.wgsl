// What every pass of one picture, or of one tile of it, knows. Prepended to each of the other files; Frame in src/render/frame.rs matches it.
// A bright rectangle far away; directions are in the frame of the surroundings.
struct Softbox {
    toward: vec4f, // unit; w tangent of half its width
    right: vec4f,  // unit; w tangent of half its height
    light: vec4f,  // linear; w width of its border, a tangent
}

// Light from all sides. Surroundings in src/render/environment.rs matches it.
struct Surroundings {
    reflected: array<vec4f, 9>, // linear, what a matt surface reflects: factors of polynomials of its normal
    gradient: array<vec4f, 3>,  // linear, straight above, at the horizon, straight below
    boxes: array<Softbox, 2>,
    turned: vec4f,              // cosine and sine of the turn about y from this frame to the world; z 1 for an image
}

struct Frame {
    view: mat4x4f,
    projection: mat4x4f,      // depth reversed: 1 near, 0 far
    clip_from_world: mat4x4f,
    lamp_from_world: mat4x4f, // depth 0 near, 1 far
    eye: vec4f,               // xyz where it is; w 1 perspective, 0 parallel
    towards_eye: vec4f,       // xyz unit, from the pivot; w drawn pixels a pixel of the finished picture
    viewport: vec4f,          // width, height of the whole picture, and one over each, pixels
    lamp: vec4f,              // xyz unit, towards it; w its strength
    sky: vec4f,               // gamma-encoded; w strength of the light from everywhere
    horizon: vec4f,           // gamma-encoded; w strength of shadows
    ground: vec4f,            // linear; w strength of the grid
    floor: vec4f,             // centre x, centre z, height, radius, metres
    hollows: vec4f,           // radius in metres, strength, 1 when they were drawn, shadow normal offset in metres
    lamp_tint: vec4f,         // linear, colour of the lamp
    part: vec4f,              // what of the picture is drawn: left, top, width, height, pixels
    around: vec4f,            // the same with its surroundings, for the textures at half size, whose texels are 2 x 2 pixels; even
    surroundings: Surroundings,
}

@group(0) @binding(0) var<uniform> frame: Frame;

// From clip space of the whole picture to that of the part with its surroundings, which is the viewport of every pass: what
// reaches beyond the part itself is clipped far from its border.
fn in_part(clip: vec4f) -> vec4f {
    let scale = frame.viewport.xy / frame.around.zw;
    let by = (scale - 2.0 * frame.around.xy / frame.around.zw - 1.0) * vec2f(1.0, -1.0);
    return vec4f(clip.xy * scale + by * clip.w, clip.zw);
}

// The same, on a grid of `steps` a pixel of the whole picture, the one that rasterisation rounds to: the tiles of a picture then
// cover the same samples as the whole.
fn on_grid(clip: vec4f, steps: f32) -> vec4f {
    let ndc = clip.xy / clip.w;
    if clip.w <= 0.0 || any(abs(ndc) > vec2f(2.0)) {
        return in_part(clip);
    }
    let pixel = vec2f(0.5 + 0.5 * ndc.x, 0.5 - 0.5 * ndc.y) * frame.viewport.xy;
    let place = (round(pixel * steps) / steps - frame.around.xy) / frame.around.zw;
    return vec4f(vec2f(2.0 * place.x - 1.0, 1.0 - 2.0 * place.y) * clip.w, clip.zw);
}

// The place in the whole picture of a place in the part.
fn in_whole(pixel: vec2f) -> vec2f {
    return pixel + frame.part.xy;
}

fn encoded(linear: vec3f) -> vec3f {
    let c = clamp(linear, vec3f(0.0), vec3f(1.0));
    return select(1.055 * pow(c, vec3f(1.0 / 2.4)) - 0.055, c * 12.92, c <= vec3f(0.0031308));
}

fn decoded(c: vec3f) -> vec3f {
    return select(pow((c + 0.055) / 1.055, vec3f(2.4)), c / 12.92, c <= vec3f(0.04045));
}

// A triangle that covers the picture.
@vertex
fn whole_vertex(@builtin(vertex_index) i: u32) -> @builtin(position) vec4f {
    let corner = vec2f(f32((i << 1u) & 2u), f32(i & 2u));
    return vec4f(corner * 2.0 - 1.0, 0.0, 1.0);
}

// Interleaved gradient noise (Jimenez 2014), 0..1: every value once among neighbouring pixels.
fn speckle(pixel: vec2f) -> f32 {
    return fract(52.9829189 * fract(dot(pixel, vec2f(0.06711056, 0.00583715))));
}

// Half a step of noise, so that eight bits show no bands.
fn dither(pixel: vec2f) -> f32 {
    return (speckle(pixel) - 0.5) / 255.0;
}

// View-space position of a depth value at a place in the picture (0..1, y down).
fn view_position(place: vec2f, depth: f32) -> vec3f {
    let p = frame.projection;
    let z = (p[3][2] - depth * p[3][3]) / (depth * p[2][3] - p[2][2]);
    let w = p[2][3] * z + p[3][3];
    let ndc = vec2f(2.0 * place.x - 1.0, 1.0 - 2.0 * place.y);
    return vec3f(ndc * w / vec2f(p[0][0], p[1][1]), z);
}
