// What cloth and skin are made of and how they take light. Appended to frame.wgsl.
struct Material {
    front: vec4f, // linear; w 1 for cloth, 0 for skin
    back: vec4f,  // linear
}

@group(1) @binding(0) var<uniform> material: Material;

struct MeshVertex {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) colour: vec4f,
}

// Unit, from a place towards the eye.
fn eyeward(world: vec3f) -> vec3f {
    return select(frame.towards_eye.xyz, normalize(frame.eye.xyz - world), frame.eye.w > 0.5);
}

// Linear light from a surface: soft light from everywhere, a lamp above the eye's left shoulder, hollows and turning edges
// darker. `open` 0..1 in hollows, `shadow` 0..1 in the lamp's shadow.
fn reflected(albedo: vec3f, normal: vec3f, eye: vec3f, open: f32, shadow: f32) -> vec3f {
    let facing = clamp(dot(normal, eye), 0.0, 1.0);
    let toward = dot(normal, frame.lamp.xyz);
    let diffuse = clamp((toward + 0.3) / 1.3, 0.0, 1.0);
    let from_above = normal.y * 0.5 + 0.5;
    let around = mix(vec3f(0.72, 0.68, 0.66), vec3f(1.02, 1.03, 1.06), from_above) * frame.sky.w;
    let lamp = vec3f(1.04, 1.0, 0.95) * (frame.lamp.w * diffuse * diffuse * shadow);
    let hollow = mix(1.0, open, frame.hollows.y);
    // Light that bounced in a hollow took on the colour of its walls.
    let tinted = mix(albedo * hollow, vec3f(hollow), hollow);
    var colour = albedo * (around * tinted + lamp * mix(1.0, hollow, 0.55));

    let sheen = material.front.w * pow(1.0 - facing, 3.0) * 0.16 * open;
    let polish = (1.0 - material.front.w) * pow(clamp(dot(normal, normalize(eye + frame.lamp.xyz)), 0.0, 1.0), 28.0);
    colour += albedo * sheen + vec3f(0.05 * polish * shadow);
    // A thin dark contour where the surface turns away.
    return colour * mix(0.5, 1.0, smoothstep(0.0, 0.34, facing));
}
