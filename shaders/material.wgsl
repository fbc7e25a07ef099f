// What cloth and skin are made of and how they take light. Appended to frame.wgsl.
struct PlacedPicture {
    map: vec4f,   // the place in the picture, 0..1, from that in the flat cloth in metres: columns of a matrix
    place: vec4f, // and what is added; z the layer, w 1 where it is repeated all over the cloth
}

struct Material {
    front: vec4f,   // linear; w 1 for cloth, 0 for skin
    back: vec4f,    // linear
    second: vec4f,  // linear, of the threads across the grain; w the kind of weave
    threads: vec4f, // pitch in metres, relief in pitches, sheen, unevenness
    gloss: vec4f,   // its strength, roughness, share of light stopped, how far it is drawn out along the threads
    print: vec4f,   // linear; w the kind of print
    repeat: vec4f,  // of the print in metres, share of light stopped by threads and gaps together, number of pictures
    pictures: array<PlacedPicture, 25>,
}

@group(1) @binding(0) var<uniform> material: Material;
@group(1) @binding(1) var pictures: texture_2d_array<f32>;
@group(1) @binding(2) var picture_sampler: sampler;

struct MeshVertex {
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @location(2) colour: vec4f,
    @location(3) flat: vec2f,
}

// `colour` with the pictures over it at a place of the flat cloth, whose change over the pixel is `px` and `py`. Those at one
// place are on the outside alone. Pictures are premultiplied.
fn with_pictures(colour: vec3f, flat: vec2f, px: vec2f, py: vec2f, outside: bool) -> vec3f {
    var out = colour;
    for (var i = 0; i < i32(material.repeat.z + 0.5); i++) {
        let picture = material.pictures[i];
        let map = mat2x2f(picture.map.xy, picture.map.zw);
        let at = map * flat + picture.place.xy;
        let dx = map * px;
        let dy = map * py;
        var share = 1.0;
        var place = at;
        if picture.place.w < 0.5 {
            let width = max(abs(dx) + abs(dy), vec2f(1e-9));
            let border = clamp(min(at, 1.0 - at) / width + 0.5, vec2f(0.0), vec2f(1.0));
            share = select(0.0, border.x * border.y, outside);
            // The sampler repeats: a border must not see the opposite one.
            let half = 0.5 / vec2f(textureDimensions(pictures));
            place = clamp(at, half, 1.0 - half);
        }
        if share > 0.0 {
            let seen = vec2f(place.x, 1.0 - place.y);
            let flipped = vec2f(1.0, -1.0);
            let layer = i32(picture.place.z + 0.5);
            let ink = textureSampleGrad(pictures, picture_sampler, seen, layer, dx * flipped, dy * flipped) * share;
            out = out * (1.0 - ink.a) + ink.rgb;
        }
    }
    return out;
}

// Unit, from a place towards the eye.
fn eyeward(world: vec3f) -> vec3f {
    return select(frame.towards_eye.xyz, normalize(frame.eye.xyz - world), frame.eye.w > 0.5);
}

// A direction of the world in the frame of the surroundings.
fn in_surroundings(d: vec3f) -> vec3f {
    let turned = frame.surroundings.turned;
    return vec3f(turned.x * d.x - turned.y * d.z, d.y, turned.y * d.x + turned.x * d.z);
}

// Linear light from all sides that a matt white surface reflects (Ramamoorthi and Hanrahan 2001).
fn light_around(normal: vec3f) -> vec3f {
    let n = in_surroundings(normal);
    let c = frame.surroundings.reflected;
    let one = c[0].rgb + c[1].rgb * n.y + c[2].rgb * n.z + c[3].rgb * n.x;
    let two = c[4].rgb * (n.x * n.y) + c[5].rgb * (n.y * n.z) + c[6].rgb * (3.0 * n.z * n.z - 1.0) + c[7].rgb * (n.x * n.z);
    return max(one + two + c[8].rgb * (n.x * n.x - n.y * n.y), vec3f(0.0));
}

// How much of a strip of this half width is seen at a place whose sight is blurred by `edge`.
fn within(at: f32, half: f32, edge: f32) -> f32 {
    return smoothstep(-1.0, 1.0, (at + half) / edge) - smoothstep(-1.0, 1.0, (at - half) / edge);
}

// Linear light that comes from a direction to a surface that mirrors it, blurred by its roughness: the sky is rounded off at the
// horizon, the softboxes have wider borders and are dimmer by as much as they are wider.
fn mirrored_light(direction: vec3f, rough: f32) -> vec3f {
    if frame.surroundings.turned.z > 0.5 {
        return light_around(direction);
    }
    let d = in_surroundings(direction);
    // The lobe of a reflection is about twice as wide as that of the facets' normals.
    let blur = 2.0 * rough * rough;
    let up = 0.5 * (d.y + sqrt(d.y * d.y + blur * blur));
    let heights = min(vec2f(up, up - d.y), vec2f(1.0));
    let horizon = frame.surroundings.gradient[1].rgb;
    var light = horizon + (frame.surroundings.gradient[0].rgb - horizon) * heights.x
        + (frame.surroundings.gradient[2].rgb - horizon) * heights.y;
    for (var i = 0; i < 2; i++) {
        let softbox = frame.surroundings.boxes[i];
        let ahead = dot(d, softbox.toward.xyz);
        let above = cross(softbox.toward.xyz, softbox.right.xyz);
        let place = vec2f(dot(d, softbox.right.xyz), dot(d, above)) / max(ahead, 0.05);
        let edge = length(vec2f(softbox.light.w, blur));
        let share = within(place.x, softbox.toward.w, edge) * within(place.y, softbox.right.w, edge);
        light += softbox.light.rgb * (share * smoothstep(0.0, 0.2, ahead));
    }
    return light;
}

// Linear light from a surface: soft light from everywhere, a lamp above the eye's left shoulder, hollows and turning edges
// darker. `normal` with the relief of threads, `shape` without; `open` 0..1 in hollows, `shadow` 0..1 in the lamp's shadow.
fn reflected(albedo: vec3f, normal: vec3f, shape: vec3f, eye: vec3f, open: f32, shadow: f32) -> vec3f {
    let facing = clamp(dot(shape, eye), 0.0, 1.0);
    let toward = dot(normal, frame.lamp.xyz);
    // Light that went into skin comes out beside where it went in, the red of it farthest.
    let spread = mix(vec3f(0.42, 0.3, 0.24), vec3f(0.3), material.front.w);
    let diffuse = clamp((toward + spread) / (1.0 + spread), vec3f(0.0), vec3f(1.0));
    let around = light_around(normal) * frame.sky.w;
    let lamp = vec3f(1.04, 1.0, 0.95) * frame.lamp_tint.rgb * (frame.lamp.w * diffuse * diffuse * shadow);
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

// Linear light that threads mirror: what is around them, and the lamp by a microfacet model (Walter et al. 2007), narrow along
// the threads and broad across them where these lie side by side.
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
    let sky = mirrored_light(reflect(-eye, normal), material.gloss.y) * (frame.sky.w * open * (1.0 - material.gloss.y));
    let tint = mix(vec3f(1.0), albedo / max(max(albedo.r, albedo.g), max(albedo.b, 0.02)), 0.5);
    return tint * material.gloss.x * (0.06 * lamp * frame.lamp_tint.rgb + grazing * sky);
}

// Linear light that skin mirrors of what is around it, more at grazing angles: a surface with little oil, so rough that it blurs
// light as much as a matt one.
fn skin_sheen(normal: vec3f, eye: vec3f, open: f32) -> vec3f {
    let facing = clamp(dot(normal, eye), 0.0, 1.0);
    let fresnel = 0.018 + 0.1 * pow(1.0 - facing, 5.0);
    return light_around(reflect(-eye, normal)) * (fresnel * frame.sky.w * open);
}
