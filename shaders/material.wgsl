// What cloth and skin are made of and how they take light. Appended to frame.wgsl.
struct Material {
    front: vec4f,   // linear; w 1 for cloth, 0 for skin
    back: vec4f,    // linear
    second: vec4f,  // linear, of the threads across the grain; w the kind of weave
    threads: vec4f, // pitch in metres, relief in pitches, sheen, unevenness
    gloss: vec4f,   // its strength, roughness, share of light stopped, how far it is drawn out along the threads
    print: vec4f,   // linear; w the kind of print
    repeat: vec4f,  // of the print in metres, share of light stopped by threads and gaps together
}

@group(1) @binding(0) var<uniform> material: Material;

struct MeshVertex {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) colour: vec4f,
    @location(3) flat: vec2f,
}

// Unit, from a place towards the eye.
fn eyeward(world: vec3f) -> vec3f {
    return select(frame.towards_eye.xyz, normalize(frame.eye.xyz - world), frame.eye.w > 0.5);
}

// Linear light from a surface: soft light from everywhere, a lamp above the eye's left shoulder, hollows and turning edges
// darker. `normal` with the relief of threads, `shape` without; `open` 0..1 in hollows, `shadow` 0..1 in the lamp's shadow.
fn reflected(albedo: vec3f, normal: vec3f, shape: vec3f, eye: vec3f, open: f32, shadow: f32) -> vec3f {
    let facing = clamp(dot(shape, eye), 0.0, 1.0);
    let toward = dot(normal, frame.lamp.xyz);
    // Light that went into skin comes out beside where it went in, the red of it farthest.
    let spread = mix(vec3f(0.42, 0.3, 0.24), vec3f(0.3), material.front.w);
    let diffuse = clamp((toward + spread) / (1.0 + spread), vec3f(0.0), vec3f(1.0));
    let from_above = normal.y * 0.5 + 0.5;
    let around = mix(vec3f(0.72, 0.68, 0.66), vec3f(1.02, 1.03, 1.06), from_above) * frame.sky.w;
    let lamp = vec3f(1.04, 1.0, 0.95) * (frame.lamp.w * diffuse * diffuse * shadow);
    let hollow = mix(1.0, open, frame.hollows.y);
    // Light that bounced in a hollow took on the colour of its walls.
    let tinted = mix(albedo * hollow, vec3f(hollow), hollow);
    var colour = albedo * (around * tinted + lamp * mix(1.0, hollow, 0.55));

    let sheen = material.front.w * pow(1.0 - facing, 3.0) * material.threads.z * open;
    let polish = (1.0 - material.front.w) * pow(clamp(dot(normal, normalize(eye + frame.lamp.xyz)), 0.0, 1.0), 28.0);
    colour += albedo * sheen + vec3f(0.05 * polish * shadow);
    // A thin dark contour where the surface turns away.
    return colour * mix(0.5, 1.0, smoothstep(0.0, 0.34, facing));
}

// Linear light that threads mirror: lamp and sky by a microfacet model (Walter et al. 2007), narrow along the threads and broad
// across them where these lie side by side.
fn mirrored(albedo: vec3f, normal: vec3f, along: vec3f, eye: vec3f, open: f32, shadow: f32) -> vec3f {
    let rough = material.gloss.y * material.gloss.y;
    let a = vec2f(rough * (1.0 - 0.65 * material.gloss.w), min(rough * (1.0 + material.gloss.w), 1.0));
    let half = normalize(eye + frame.lamp.xyz);
    let across = cross(normal, along);
    let h = vec3f(dot(half, along) / a.x, dot(half, across) / a.y, dot(half, normal));
    let hh = dot(h, h);
    let peak = 1.0 / (3.14159265 * a.x * a.y * hh * hh);
    let deep = max(dot(frame.lamp.xyz, half), 0.3);
    let toward = clamp(dot(normal, frame.lamp.xyz), 0.0, 1.0);
    let facing = clamp(dot(normal, eye), 0.0, 1.0);
    let lamp = min(peak / (4.0 * deep * deep * (rough + 0.5)), 12.0) * toward * frame.lamp.w * shadow;
    let grazing = 0.05 + 0.95 * pow(1.0 - facing, 5.0) * (1.0 - 0.8 * material.gloss.y);
    let up = 2.0 * facing * normal.y - eye.y;
    let sky = mix(0.35, 1.0, smoothstep(-0.4, 0.5, up)) * frame.sky.w * open * (1.0 - material.gloss.y);
    let tint = mix(vec3f(1.0), albedo / max(max(albedo.r, albedo.g), max(albedo.b, 0.02)), 0.5);
    return tint * (material.gloss.x * (0.06 * lamp + grazing * sky));
}
