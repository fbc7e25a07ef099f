// Cloth and body in the light.
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
    let albedo = select(material.back.rgb, material.front.rgb, front) * in.colour;
    let toward = dot(normal, frame.lamp.xyz);
    var shadow = 1.0;
    if toward > -0.1 {
        let shade = lit(in.world + normal * frame.hollows.w, 2.6, in.clip.xy);
        shadow = mix(1.0, shade, frame.horizon.w * smoothstep(-0.1, 0.25, toward));
    }
    let colour = reflected(albedo, normal, eyeward(in.world), openness(in.clip.xy, in.depth), shadow);
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
