// Cloth and body in plain light, found at the vertices: what a processor draws while things move.
struct Draft {
    @builtin(position) clip: vec4f,
    @location(0) front: vec3f, // gamma-encoded
    @location(1) back: vec3f,
    @location(2) flat: vec2f,
}

@vertex
fn draft_vertex(in: MeshVertex) -> Draft {
    let normal = normalize(in.normal + vec3f(0.0, 1e-9, 0.0));
    let eye = eyeward(in.position);
    let dye = in.colour.rgb * in.colour.rgb;
    var out: Draft;
    out.clip = in_part(frame.clip_from_world * vec4f(in.position, 1.0));
    out.front = encoded(reflected(material.front.rgb * dye, normal, normal, eye, 1.0, 1.0));
    out.back = encoded(reflected(material.back.rgb * dye, -normal, -normal, eye, 1.0, 1.0));
    out.flat = in.flat;
    return out;
}

// Gamma-encoded, with the pictures on the cloth in the light that its own colour shows.
fn drafted(in: Draft, front: bool) -> vec3f {
    let plain = select(in.back, in.front, front);
    if material.repeat.z < 0.5 {
        return plain;
    }
    let own = max(select(material.back.rgb, material.front.rgb, front), vec3f(0.02));
    let light = pow(plain, vec3f(2.2)) / own;
    let colour = with_pictures(own, in.flat, dpdx(in.flat), dpdy(in.flat), front);
    return pow(colour * light, vec3f(1.0 / 2.2));
}

@fragment
fn draft_fragment(in: Draft, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    return vec4f(drafted(in, front), 1.0);
}

@fragment
fn draft_sheer_fragment(in: Draft, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    return vec4f(drafted(in, front), 0.45);
}

@fragment
fn draft_open_fragment(in: Draft, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    return vec4f(drafted(in, front), material.repeat.y);
}
