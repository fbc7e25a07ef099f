// The body near each vertex: its nearest point, looked up again where the vertex has moved too far.

// Cosine of the angle between the normals of two successive nearest points below which they form a crease, and the distance
// from there within which cloth is still kept off it, in offsets.
const CREASE = 0.5;
const CREASE_REACH = 4.0;
// Distance, in offsets, that a vertex may move before it is looked up again.
const STALE = 2.0;
// Metres beyond which the body is not searched.
const FARTHEST = 0.1;
const NONE = 0xffffffffu;

fn box_distance(at: u32, p: vec3<i32>) -> f32 {
    let out = max(max(body_boxes[2u * at].xyz - p, p - body_boxes[2u * at + 1u].xyz), vec3<i32>(0));
    return length(metres(out));
}

struct Nearest { distance: f32, triangle: u32, on: OnTriangle }

fn nearest(place: vec3<i32>) -> Nearest {
    var best = Nearest(FARTHEST, NONE, OnTriangle(vec3<f32>(0.0), 0u));
    var open: array<u32, 40>;
    var count = 1;
    open[0] = 0u;
    while count > 0 {
        count--;
        let at = open[count];
        if box_distance(at, place) >= best.distance { continue; }
        let node = body_nodes[at];
        if node.x == 0u {
            for (var k = node.y; k < node.y + node.z; k++) {
                let t = body_slots[k];
                let ids = body_triangles[t].xyz;
                let on = closest_on_triangle(metres(body_places[ids.x].xyz - place), metres(body_places[ids.y].xyz - place),
                    metres(body_places[ids.z].xyz - place));
                let far = length(on.point);
                if far < best.distance { best = Nearest(far, t, on); }
            }
        } else {
            // The nearer child is taken first.
            let left_first = box_distance(at + 1u, place) < box_distance(node.x, place);
            open[count] = select(at + 1u, node.x, left_first);
            open[count + 1] = select(node.x, at + 1u, left_first);
            count += 2;
        }
    }
    return best;
}

@compute @workgroup_size(64)
fn look(@builtin(global_invocation_id) id: vec3<u32>) {
    let v = id.x;
    if v >= scene.vertices { return; }
    let place = places[v].xyz;
    var skin = skins[v];
    let leaves = length(metres(place - skin.other_place.xyz)) > CREASE_REACH * scene.offset;
    if leaves && any(skin.other.xyz != vec3<f32>(0.0)) {
        skin.other = vec4<f32>(0.0);
        skins[v].other = skin.other;
    }
    let moves = length(velocities[v].xyz) * scene.look_span;
    if length(metres(place - skin.place.xyz)) + moves <= bitcast<f32>(skin.place.w) { return; }
    let found = nearest(place);
    let offset = scene.offset + vertices[v].lift;
    let seen = skin;
    skin.place = vec4<i32>(place, bitcast<i32>(found.distance - 2.0 * offset));
    skin.side = vec4<f32>(0.0);
    if found.triangle != NONE {
        let outward = body_normals[7u * found.triangle + found.on.part].xyz;
        let inside = dot(outward, found.on.point) > 0.0;
        let signed = select(found.distance, -found.distance, inside);
        if signed <= 2.0 * offset {
            var normal = outward;
            if found.distance > 1e-6 { normal = found.on.point * (select(-1.0, 1.0, inside) / found.distance); }
            skin.side = vec4<f32>(normal, signed - scene.offset);
            skin.place.w = bitcast<i32>(STALE * max(scene.offset, 1e-4));
            if any(seen.side.xyz != vec3<f32>(0.0)) && dot(seen.side.xyz, normal) < CREASE {
                skin.other_place = seen.place;
                skin.other = seen.side;
            }
        }
    }
    skins[v] = skin;
}
