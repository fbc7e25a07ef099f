// Depth of field, gathered: each pixel takes light from those whose circles of confusion reach it. What is nearer than the pixel
// covers it as far as it reaches it; what is farther shows as far as the pixel's own surface is blurred. So a sharp thing gives
// nothing to what is blurred behind it, and takes nothing from it.
@group(1) @binding(1) var picture: texture_2d<f32>;
@group(1) @binding(2) var light_map: texture_2d<f32>; // linear, premultiplied
@group(1) @binding(3) var focus_map: texture_2d<f32>; // depth, radius
@group(1) @binding(4) var reach_map: texture_2d<f32>; // in blocks

const PI: f32 = 3.14159265;
// Every pixel up to this squared distance is read, beyond it some on a spiral.
const NEAR_SQUARE: i32 = 20;
// Radius of a circle with the area of those pixels: the square root of 69 / pi.
const NEAR: f32 = 4.68651;
// Readings on the spiral for each pixel of the finished picture along its radius, and their limits.
const DENSITY: f32 = 10.0;
const FEWEST: i32 = 48;
const MOST: i32 = 320;

// Linear, premultiplied light of the picture, whose encoded values are multiplied with alpha.
@fragment
fn light_fragment(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let own = textureLoad(picture, vec2i(at.xy), 0);
    if own.a <= 0.0 {
        return vec4f(0.0);
    }
    return vec4f(decoded(min(own.rgb / own.a, vec3f(1.0))) * own.a, own.a);
}

// What a pixel has gathered.
struct Gathered {
    front: vec4f, // light of what is nearer than the pixel
    cover: f32,   // its weight: how much of the pixel it covers
    rest: vec4f,  // light of the pixel's own surface and of what is farther
    weight: f32,
}

// With the light of pixel `other`, which is `away` pixels away and stands for `area` pixels. `here`: depth and radius of the pixel.
fn with_light(sum: Gathered, here: vec2f, other: vec2i, away: f32, area: f32) -> Gathered {
    let inside = clamp(other, vec2i(0), vec2i(textureDimensions(focus_map)) - 1);
    let there = textureLoad(focus_map, inside, 0).rg;
    let is_front = there.x < here.x;
    let radius = select(here.y, there.y, is_front);
    let reached = clamp(radius + 0.5 - away, 0.0, 1.0);
    if reached <= 0.0 {
        return sum;
    }
    // The sum of `reached` over all pixels.
    let spread = max(PI * (radius * radius + 1.0 / 12.0), 1.0);
    let weight = area * reached / spread;
    let light = textureLoad(light_map, inside, 0);
    if is_front {
        return Gathered(sum.front + light * weight, sum.cover + weight, sum.rest, sum.weight);
    }
    return Gathered(sum.front, sum.cover, sum.rest + light * weight, sum.weight + weight);
}

@fragment
fn lens_blur_fragment(@builtin(position) at: vec4f) -> @location(0) vec4f {
    let pixel = vec2i(at.xy);
    let own = textureLoad(picture, pixel, 0);
    let block = (vec2i(frame.part.xy) + pixel) / BLOCK - first_block();
    let reach = textureLoad(reach_map, block, 0).r;
    if reach <= 0.5 {
        return own;
    }
    let here = textureLoad(focus_map, pixel, 0).rg;
    var sum = Gathered(vec4f(0.0), 0.0, vec4f(0.0), 0.0);
    let side = i32(min(reach + 0.5, 4.0));
    for (var y = -side; y <= side; y++) {
        for (var x = -side; x <= side; x++) {
            let square = x * x + y * y;
            if square <= NEAR_SQUARE {
                sum = with_light(sum, here, pixel + vec2i(x, y), sqrt(f32(square)), 1.0);
            }
        }
    }
    let beyond = reach + 0.5 - NEAR;
    if beyond > 0.0 {
        let count = clamp(i32(ceil(DENSITY * beyond / frame.towards_eye.w)), FEWEST, MOST);
        let step = beyond / f32(count);
        let turn = 2.0 * PI * speckle(in_whole(at.xy));
        for (var i = 0; i < count; i++) {
            let away = NEAR + (f32(i) + 0.5) * step;
            let angle = f32(i) * 2.3999632 + turn;
            let other = pixel + vec2i(round(vec2f(cos(angle), sin(angle)) * away));
            sum = with_light(sum, here, other, away, 2.0 * PI * away * step);
        }
    }
    if here.y <= 0.5 && sum.cover <= 0.0 {
        return own;
    }
    let front = sum.front / max(sum.cover, 1e-6);
    let light = mix(sum.rest / sum.weight, front, min(sum.cover, 1.0));
    let straight = light.rgb / max(light.a, 1e-6);
    return vec4f((encoded(straight) + dither(in_whole(at.xy))) * light.a, light.a);
}
