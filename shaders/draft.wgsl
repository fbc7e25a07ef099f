// Cloth and body in plain light, found at the vertices: what a processor draws while things move.
struct Draft {
    @builtin(position) clip: vec4f,
    @location(0) front: vec3f, // gamma-encoded
    @location(1) back: vec3f,
}

@vertex
fn draft_vertex(in: MeshVertex) -> Draft {
    let normal = normalize(in.normal + vec3f(0.0, 1e-9, 0.0));
    let eye = eyeward(in.position);
    let dye = in.colour.rgb * in.colour.rgb;
    var out: Draft;
    out.clip = frame.clip_from_world * vec4f(in.position, 1.0);
    out.front = encoded(reflected(material.front.rgb * dye, normal, normal, eye, 1.0, 1.0));
    out.back = encoded(reflected(material.back.rgb * dye, -normal, -normal, eye, 1.0, 1.0));
    return out;
}

@fragment
fn draft_fragment(in: Draft, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    return vec4f(select(in.back, in.front, front), 1.0);
}

@fragment
fn draft_sheer_fragment(in: Draft, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    return vec4f(select(in.back, in.front, front), 0.45);
}

@fragment
fn draft_open_fragment(in: Draft, @builtin(front_facing) front: bool) -> @location(0) vec4f {
    return vec4f(select(in.back, in.front, front), material.repeat.y);
}
