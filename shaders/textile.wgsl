// How woven, knitted and other cloth looks from near: threads in relief, in their colours. Appended to material.wgsl.
//
// Places are in threads: x across the grain, y along it, one repeat a unit. The kinds are those of Weave in src/render/textile.rs.
const PLAIN: u32 = 1u;
const TWILL: u32 = 2u;
const SATIN: u32 = 3u;
const JERSEY: u32 = 4u;
const RIB: u32 = 5u;
const CORDUROY: u32 = 6u;
const TULLE: u32 = 7u;
const LEATHER: u32 = 8u;
const FLEECE: u32 = 9u;

// A place of the cloth.
struct Yarn {
    height: f32, // 0 in the gaps..1 on top of a thread
    second: f32, // share of the second colour
    cover: f32,  // 0 a hole..1 cloth
}

fn hash(cell: vec2f) -> f32 {
    var n = u32(i32(cell.x)) * 0x9e3779b9u + u32(i32(cell.y)) * 0x85ebca6bu;
    n = (n ^ (n >> 16u)) * 0x7feb352du;
    n = (n ^ (n >> 15u)) * 0x846ca68bu;
    return f32((n ^ (n >> 16u)) >> 8u) / 16777216.0;
}

// Value noise, 0..1, one bump a unit.
fn noise(p: vec2f) -> f32 {
    let cell = floor(p);
    let part = p - cell;
    let t = part * part * (3.0 - 2.0 * part);
    let low = mix(hash(cell), hash(cell + vec2f(1.0, 0.0)), t.x);
    let high = mix(hash(cell + vec2f(0.0, 1.0)), hash(cell + vec2f(1.0, 1.0)), t.x);
    return mix(low, high, t.y);
}

// The remainder of a division, never below zero.
fn wrapped(a: f32, n: f32) -> f32 {
    return a - n * floor(a / n);
}

// Threads along y over n - 1 of n threads across, each column moved on by `step`.
fn woven(p: vec2f, n: f32, step: f32) -> Yarn {
    let column = floor(p.x);
    let along = wrapped(p.y + step * column, n);
    let f = fract(p) - 0.5;
    let round_warp = sqrt(max(1.0 - 3.6 * f.x * f.x, 0.0));
    let round_weft = sqrt(max(1.0 - 3.6 * f.y * f.y, 0.0));
    let from_crossing = min(abs(along - 0.5), n - abs(along - 0.5));
    let warp = round_warp * mix(0.2, 1.0, smoothstep(0.1, 1.0, from_crossing));
    let is_over = along < 1.0;
    let weft = round_weft * select(0.2, mix(0.3, 1.0, cos(3.14159265 * f.x)), is_over);
    return Yarn(max(warp, weft), select(0.0, 1.0, weft > warp), 1.0);
}

// Columns of stitches, each a pair of slanting legs.
fn knitted(p: vec2f) -> f32 {
    let x = abs(fract(p.x) - 0.5);
    let across = (x - 0.25) / 0.25;
    let along = fract(p.y - 1.3 * x);
    return sqrt(max(1.0 - across * across, 0.0)) * (0.45 + 0.55 * sin(3.14159265 * along));
}

// Distances to the nearest and the second nearest of scattered points, one a unit.
fn nearest_two(p: vec2f) -> vec2f {
    let cell = floor(p);
    var best = vec2f(9.0);
    for (var i = -1; i <= 1; i++) {
        for (var j = -1; j <= 1; j++) {
            let other = cell + vec2f(f32(i), f32(j));
            let place = other + vec2f(hash(other), hash(other + vec2f(57.0, 113.0)));
            let far = distance(p, place);
            best = select(vec2f(best.x, min(best.y, far)), vec2f(far, best.x), far < best.x);
        }
    }
    return best;
}

fn yarn(kind: u32, p: vec2f) -> Yarn {
    switch kind {
        case PLAIN: { return woven(p, 2.0, 1.0); }
        case TWILL: { return woven(p, 4.0, 1.0); }
        case SATIN: { return woven(p, 5.0, 2.0); }
        case JERSEY: { return Yarn(knitted(p), 0.0, 1.0); }
        case RIB: {
            let wale = 0.5 + 0.5 * cos(1.5707963 * p.x);
            return Yarn(0.75 * smoothstep(0.0, 0.9, wale) + 0.25 * knitted(p), 0.0, 1.0);
        }
        case CORDUROY: {
            let wale = abs(sin(3.14159265 * p.x));
            return Yarn(pow(wale, 0.7) * 0.85 + 0.15 * noise(p * vec2f(9.0, 5.0)), 0.0, 1.0);
        }
        case TULLE: {
            // Hexagons: the distance to the borders between two grids of points.
            let size = vec2f(1.0, 1.7320508);
            let one = abs(p - size * round(p / size));
            let two = abs(p - size * (floor(p / size) + 0.5));
            let q = select(two, one, dot(one, one) < dot(two, two));
            let border = 0.5 - max(q.x, dot(q, vec2f(0.5, 0.8660254)));
            let thread = 1.0 - smoothstep(0.07, 0.12, border);
            return Yarn(thread, 0.0, thread);
        }
        case LEATHER: {
            let near = nearest_two(p);
            let crease = smoothstep(0.02, 0.22, near.y - near.x);
            return Yarn(crease * (0.85 + 0.15 * noise(p * 5.0)), 0.0, 1.0);
        }
        case FLEECE: {
            return Yarn(0.6 * noise(p) + 0.3 * noise(p * 2.3) + 0.1 * noise(p * 5.1), 0.0, 1.0);
        }
        default: { return Yarn(1.0, 0.0, 1.0); }
    }
}

// The mean over a repeat: what is seen where threads are smaller than pixels.
fn mean_yarn(kind: u32) -> Yarn {
    switch kind {
        case PLAIN: { return Yarn(0.64, 0.45, 1.0); }
        case TWILL: { return Yarn(0.73, 0.22, 1.0); }
        case SATIN: { return Yarn(0.75, 0.18, 1.0); }
        case JERSEY: { return Yarn(0.63, 0.0, 1.0); }
        case RIB: { return Yarn(0.56, 0.0, 1.0); }
        case FLEECE: { return Yarn(0.5, 0.0, 1.0); }
        case CORDUROY: { return Yarn(0.67, 0.0, 1.0); }
        case TULLE: { return Yarn(0.9, 0.0, 0.34); }
        case LEATHER: { return Yarn(0.67, 0.0, 1.0); }
        default: { return Yarn(1.0, 0.0, 1.0); }
    }
}

// Share of a stripe as wide as its gap, one a unit, averaged over a pixel `width` units wide.
fn stripe(x: f32, width: f32) -> f32 {
    let edge = abs(fract(x) - 0.5) - 0.25;
    let sharp = clamp(0.5 - edge / max(width, 1e-4), 0.0, 1.0);
    return mix(sharp, 0.5, smoothstep(0.4, 1.0, width));
}

// Share of the print's colour at a place in repeats.
fn printed(kind: u32, p: vec2f, width: f32) -> f32 {
    switch kind {
        case 1u: { return stripe(p.x, width); }
        case 2u: { return stripe(p.y, width); }
        case 3u: { return 0.5 * (stripe(p.x, width) + stripe(p.y, width)); }
        case 4u: {
            let row = floor(p.y * 2.0);
            let q = vec2f(fract(p.x + 0.5 * wrapped(row, 2.0)) - 0.5, (fract(p.y * 2.0) - 0.5) * 0.5);
            let sharp = clamp(0.5 - (length(q) - 0.15) / max(width, 1e-4), 0.0, 1.0);
            return mix(sharp, 0.141, smoothstep(0.3, 0.8, width));
        }
        default: { return 0.0; }
    }
}

// The surface of a textile at a pixel.
struct Textured {
    albedo: vec3f,
    normal: vec3f,
    along: vec3f, // unit, the grain in space
    cover: f32,
}

// `uv` metres in the flat cloth, `normal` unit. Derivatives are taken: call it where control is uniform.
fn textured(uv: vec2f, world: vec3f, normal: vec3f, albedo: vec3f, second: vec3f, front: bool) -> Textured {
    let kind = u32(material.second.w + 0.5);
    let p = uv / max(material.threads.x, 1e-6);
    let px = dpdx(p);
    let py = dpdy(p);
    let wx = dpdx(world);
    let wy = dpdy(world);
    let area = px.x * py.y - py.x * px.y;
    let grain = (wy * px.x - wx * py.x) * sign(area + 1e-20);
    let along = normalize(grain - normal * dot(normal, grain) + vec3f(1e-12, 0.0, 0.0));
    // Threads a pixel: from half a thread on they blur together.
    let width = max(length(px), length(py));
    let sharp = 1.0 - smoothstep(0.3, 0.75, width);
    let mean = mean_yarn(kind);
    var here = mean;
    var bent = normal;
    if kind > 0u && sharp > 0.0 {
        here = yarn(kind, p);
        let step = clamp(width * 0.5, 0.02, 0.2);
        let right = yarn(kind, p + vec2f(step, 0.0)).height;
        let up = yarn(kind, p + vec2f(0.0, step)).height;
        let slope = vec2f(right - here.height, up - here.height) / step;
        // The height in space over the pixel (Mikkelsen, "Bump mapping unparametrized surfaces on the GPU", 2010).
        // Half of it: light between threads softens what the slopes alone would show.
        let relief = 0.5 * material.threads.y * material.threads.x * sharp;
        let rise = vec2f(dot(slope, px), dot(slope, py)) * relief;
        let r1 = cross(wy, normal);
        let r2 = cross(normal, wx);
        let det = dot(wx, r1);
        bent = normalize(abs(det) * normal - sign(det) * (rise.x * r1 + rise.y * r2) + normal * 1e-20);
    }
    // Yarn is never quite even: longer along the threads than across.
    let uneven = noise(p * vec2f(0.31, 0.043)) + noise(p * vec2f(0.043, 0.31)) - 1.0;
    let slubs = 1.0 + material.threads.w * uneven * (1.0 - smoothstep(0.3, 0.9, width * 0.31));
    let height = mix(mean.height, here.height, sharp);
    let share = mix(mean.second, here.second, sharp);
    let repeat = uv / max(material.repeat.x, 1e-6);
    let blur = max(length(dpdx(repeat)), length(dpdy(repeat)));
    let inked = printed(u32(material.print.w + 0.5), repeat, blur);
    let depth = mix(1.0, 0.45 + 0.55 * height / max(mean.height, 0.1), clamp(material.threads.y * 1.5, 0.0, 1.0));
    let dyed = mix(mix(albedo, second, share), material.print.rgb, inked);
    let pitch = max(material.threads.x, 1e-6);
    let colour = with_pictures(dyed, uv, px * pitch, py * pitch, front);
    return Textured(
        colour * slubs * min(depth, 1.25),
        bent,
        along,
        mix(mean.cover, here.cover, sharp) * material.gloss.z,
    );
}
