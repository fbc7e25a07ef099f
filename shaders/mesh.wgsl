// Cloth and body in the light.
struct Shaded {
    @builtin(position) clip: vec4f,
    @location(0) world: vec3f,
    @location(1) normal: vec3f,
    @location(2) colour: vec3f,
    @location(3) depth: f32,
    @location(4) flat: vec2f,
}

@vertex
fn mesh_vertex(in: MeshVertex) -> Shaded {
    var out: Shaded;
    out.clip = on_grid(frame.clip_from_world * vec4f(in.position, 1.0), 256.0);
    out.world = in.position;
    out.normal = in.normal;
    out.colour = in.colour.rgb * in.colour.rgb;
    out.depth = -(frame.view * vec4f(in.position, 1.0)).z;
    out.flat = in.flat;
    return out;
}

// Gamma-encoded; alpha is how much of what lies behind is hidden.
fn shaded(in: Shaded, front: bool) -> vec4f {
    let side = select(-1.0, 1.0, front);
    let smooth_normal = normalize(in.normal + vec3f(0.0, 1e-9, 0.0)) * side;
    let dye = select(material.back.rgb, material.front.rgb, front) * in.colour;
    let cloth = textured(in.flat, in.world, smooth_normal, dye, material.second.rgb * in.colour, front);
    let toward = dot(smooth_normal, frame.lamp.xyz);
    var shadow = 1.0;
    if toward > -0.1 {
        let shade = lit(in.world + smooth_normal * frame.hollows.w, 2.6, in_whole(in.clip.xy));
        shadow = mix(1.0, shade, frame.horizon.w * smoothstep(-0.1, 0.25, toward));
    }
    let eye = eyeward(in.world);
    let open = openness(in.clip.xy, in.depth);
    var colour = reflected(cloth.albedo, cloth.normal, smooth_normal, eye, open, shadow);
    if material.gloss.x > 0.0 {
        colour += mirrored(cloth.albedo, cloth.normal, cloth.along, eye, open, shadow);
    }
    if material.front.w < 0.5 {
        colour += skin_sheen(smooth_normal, eye, open);
    }
    return vec4f(encoded(colour) + dither(in_whole(in.clip.xy)), cloth.cover);
}

@fragment
fn mesh_fragment(in: Shaded, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    return vec4f(shaded(in, front).rgb, 1.0);
}

// The same, for coverage by alpha: half of the samples, or half of the light.
@fragment
fn sheer_fragment(in: Shaded, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    return vec4f(shaded(in, front).rgb, 0.45);
}

// The same for cloth that has holes or lets light through. Alpha takes whole samples: from pixel to pixel one more or less.
@fragment
fn open_fragment(in: Shaded, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    let out = shaded(in, front);
    let uneven = speckle(in_whole(in.clip.xy)) - 0.5;
    return vec4f(out.rgb, clamp(out.a + uneven * 0.25 * step(0.02, out.a) * step(out.a, 0.98), 0.0, 1.0));
}

@vertex
fn shadow_vertex(in: MeshVertex) -> @builtin(position) vec4f {
    return frame.lamp_from_world * vec4f(in.position, 1.0);
}
