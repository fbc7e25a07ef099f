// Lines, dots and the strokes of digits: capsules of constant width on the screen, hidden by what is nearer.
struct Stroke {
    @location(0) a: vec3f,
    @location(1) b: vec3f,
    @location(2) offset_a: vec2f, // pixels, right and up
    @location(3) offset_b: vec2f,
    @location(4) colour: vec4f,
    @location(5) size: vec4f,     // half width in pixels, lift towards the eye in metres and in half widths, real width in metres
}

struct Capsule {
    @builtin(position) clip: vec4f,
    @location(0) @interpolate(flat) ends: vec4f, // pixels, y down
    @location(1) @interpolate(flat) colour: vec4f,
    @location(2) @interpolate(flat) radius: f32,
}

// Size of a pixel at a view-space depth, metres.
fn pixel_at(z: f32) -> f32 {
    return 2.0 * mix(1.0, -z, frame.eye.w) / (frame.projection[1][1] * frame.viewport.y);
}

fn lifted(world: vec3f, size: vec4f) -> vec3f {
    let p = (frame.view * vec4f(world, 1.0)).xyz;
    let lift = size.y + size.z * size.x * pixel_at(p.z);
    if frame.eye.w < 0.5 {
        return p + vec3f(0.0, 0.0, lift);
    }
    let away = length(p);
    return p * max(1.0 - lift / max(away, 1e-6), 0.5);
}

// `p` moved along the line to `q` until it is in front of the eye.
fn in_front(p: vec3f, q: vec3f) -> vec3f {
    let near = -1e-4 - frame.projection[3][2] * frame.eye.w;
    if frame.eye.w < 0.5 || p.z <= near || q.z >= p.z {
        return p;
    }
    return mix(p, q, clamp((near - p.z) / (q.z - p.z), 0.0, 1.0));
}

fn pixels(clip: vec4f) -> vec2f {
    let ndc = clip.xy / clip.w;
    return vec2f(ndc.x * 0.5 + 0.5, 0.5 - ndc.y * 0.5) * frame.viewport.xy;
}

@vertex
fn line_vertex(in: Stroke, @builtin(vertex_index) i: u32) -> Capsule {
    var corners = array<vec2f, 6>(
        vec2f(0.0, -1.0), vec2f(1.0, -1.0), vec2f(1.0, 1.0),
        vec2f(0.0, -1.0), vec2f(1.0, 1.0), vec2f(0.0, 1.0),
    );
    let va = lifted(in.a, in.size);
    let vb = lifted(in.b, in.size);
    let ca = frame.projection * vec4f(in_front(va, vb), 1.0);
    let cb = frame.projection * vec4f(in_front(vb, va), 1.0);
    let a = pixels(ca) + in.offset_a * vec2f(1.0, -1.0);
    let b = pixels(cb) + in.offset_b * vec2f(1.0, -1.0);
    let along = b - a;
    let span = length(along);
    let direction = select(vec2f(1.0, 0.0), along / max(span, 1e-6), span > 1e-6);
    let across = vec2f(-direction.y, direction.x);
    let corner = corners[i];
    let real = in.size.w * 0.5 / max(pixel_at(va.z), 1e-9);
    let wanted = select(in.size.x, min(in.size.x, real), in.size.w > 0.0);
    let radius = max(wanted, min(in.size.x, 0.5));
    let reach = radius + 1.0;
    let at = mix(a, b, corner.x) + direction * (corner.x * 2.0 - 1.0) * reach + across * corner.y * reach;
    let end = select(ca, cb, corner.x > 0.5);
    let ndc = vec2f(at.x * frame.viewport.z * 2.0 - 1.0, 1.0 - at.y * frame.viewport.w * 2.0);
    var out: Capsule;
    // Ends behind the eye leave no line.
    out.clip = select(vec4f(2.0, 2.0, 2.0, 1.0), in_part(vec4f(ndc * end.w, end.z, end.w)), ca.w > 0.0 && cb.w > 0.0);
    out.ends = vec4f(a, b);
    // Thinner than a pixel is paler.
    out.colour = vec4f(in.colour.rgb, in.colour.a * clamp(wanted / max(radius, 1e-6), 0.0, 1.0));
    out.radius = radius;
    return out;
}

fn inked(in: Capsule) -> vec4f {
    let p = in_whole(in.clip.xy) - in.ends.xy;
    let ab = in.ends.zw - in.ends.xy;
    let t = clamp(dot(p, ab) / max(dot(ab, ab), 1e-6), 0.0, 1.0);
    let away = length(p - ab * t);
    let cover = clamp(in.radius + 0.5 - away, 0.0, 1.0);
    if cover <= 0.0 {
        discard;
    }
    return vec4f(in.colour.rgb, in.colour.a * cover);
}

@fragment
fn line_fragment(in: Capsule) -> @location(0) vec4f {
    return inked(in);
}

// What shows through.
@fragment
fn faint_fragment(in: Capsule) -> @location(0) vec4f {
    let ink = inked(in);
    return vec4f(ink.rgb, ink.a * 0.4);
}
