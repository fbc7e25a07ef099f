// Cloth, body: soft light from everywhere, a lamp above the eye's left shoulder, hollows and turning edges darker.
struct Material {
    front: vec4f, // linear; w 1 for cloth, 0 for skin
    back: vec4f,  // linear
}

@group(2) @binding(0) var<uniform> material: Material;

struct MeshVertex {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) colour: vec4f,
}

struct Shaded {
    @builtin(position) clip: vec4f,
    @location(0) world: vec3f,
    @location(1) normal: vec3f,
    @location(2) colour: vec3f,
    @location(3) depth: f32,
}

@vertex
fn mesh_vertex(in: MeshVertex) -> Shaded {
    var out: Shaded;
    out.clip = frame.clip_from_world * vec4f(in.position, 1.0);
    out.world = in.position;
    out.normal = in.normal;
    out.colour = in.colour.rgb * in.colour.rgb;
    out.depth = -(frame.view * vec4f(in.position, 1.0)).z;
    return out;
}

fn shaded(in: Shaded, front: bool) -> vec3f {
    let side = select(-1.0, 1.0, front);
    let normal = normalize(in.normal + vec3f(0.0, 1e-9, 0.0)) * side;
    let eye = select(frame.towards_eye.xyz, normalize(frame.eye.xyz - in.world), frame.eye.w > 0.5);
    let albedo = select(material.back.rgb, material.front.rgb, front) * in.colour;
    let open = openness(in.clip.xy, in.depth);
    let facing = clamp(dot(normal, eye), 0.0, 1.0);

    let toward = dot(normal, frame.lamp.xyz);
    let diffuse = clamp((toward + 0.3) / 1.3, 0.0, 1.0);
    var shadow = 1.0;
    if toward > -0.1 {
        let shade = lit(in.world + normal * frame.hollows.w, 2.6, in.clip.xy);
        shadow = mix(1.0, shade, frame.horizon.w * smoothstep(-0.1, 0.25, toward));
    }
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
    colour *= mix(0.5, 1.0, smoothstep(0.0, 0.34, facing));
    return encoded(colour) + dither(in.clip.xy);
}

@fragment
fn mesh_fragment(in: Shaded, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    return vec4f(shaded(in, front), 1.0);
}

// The same, for coverage by alpha: half of the samples, or half of the light.
@fragment
fn sheer_fragment(in: Shaded, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    return vec4f(shaded(in, front), 0.45);
}

@vertex
fn shadow_vertex(in: MeshVertex) -> @builtin(position) vec4f {
    return frame.lamp_from_world * vec4f(in.position, 1.0);
}
