// Detection of contact: walls between nearby features, as src/contact/separation does it.

// Numbers of `faults`.
const NEAR_FULL = 0u;
const WALLS_FULL = 1u;
const CONTACTS_FULL = 2u;
const TOUCHING = 3u;
const IN_BODY = 4u;
// Least reach, metres.
const LEAST_REACH = 0.001;
// How much nearer than they seem to come two features are looked at for the thickness, metres.
const NEARER = 0.0005;

@compute @workgroup_size(64)
fn anchor(@builtin(global_invocation_id) id: vec3<u32>) {
    let v = id.x;
    if v >= scene.vertices { return; }
    let more = length(scene.gravity) * scene.span * scene.span * 0.5;
    let reach = clamp(length(velocities[v].xyz) * scene.span + more, LEAST_REACH, scene.most_reach);
    anchors[v] = vec4<i32>(places[v].xyz, bitcast<i32>(reach));
}

fn reach_of(v: u32) -> f32 { return bitcast<f32>(anchors[v].w); }

@compute @workgroup_size(64)
fn enclose(@builtin(global_invocation_id) id: vec3<u32>) {
    let s = id.x;
    if s >= scene.triangles { return; }
    let ids = triangles[slots[s]].xyz;
    let a = anchors[ids.x];
    let b = anchors[ids.y];
    let c = anchors[ids.z];
    let farthest = max(max(bitcast<f32>(a.w), bitcast<f32>(b.w)), bitcast<f32>(c.w));
    let more = i32(ceil((farthest + scene.thickness * 0.5) / scene.unit * 1.000001));
    boxes[2u * s] = vec4<i32>(min(min(a.xyz, b.xyz), c.xyz) - more, bitcast<i32>(farthest));
    boxes[2u * s + 1u] = vec4<i32>(max(max(a.xyz, b.xyz), c.xyz) + more, 0);
}

@compute @workgroup_size(64)
fn refit(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x >= level.count { return; }
    let at = order[level.first + id.x];
    let node = nodes[at];
    var lower: vec3<i32>;
    var upper: vec3<i32>;
    if node.x == 0u {
        lower = boxes[2u * node.y].xyz;
        upper = boxes[2u * node.y + 1u].xyz;
        for (var k = node.y + 1u; k < node.y + node.z; k++) {
            lower = min(lower, boxes[2u * k].xyz);
            upper = max(upper, boxes[2u * k + 1u].xyz);
        }
    } else {
        lower = min(node_boxes[2u * at + 2u].xyz, node_boxes[2u * node.x].xyz);
        upper = max(node_boxes[2u * at + 3u].xyz, node_boxes[2u * node.x + 1u].xyz);
    }
    node_boxes[2u * at] = vec4<i32>(lower, 0);
    node_boxes[2u * at + 1u] = vec4<i32>(upper, 0);
}

// Whether three points, relative to corner a of triangle abc as b and c are, lie on one side of its plane, all farther than `far`.
fn is_off(b: vec3<f32>, c: vec3<f32>, p: vec3<f32>, q: vec3<f32>, r: vec3<f32>, far: f32) -> bool {
    let across = cross(b, c);
    let whole = length(across);
    if whole == 0.0 { return false; }
    let heights = vec3<f32>(dot(across, p), dot(across, q), dot(across, r)) / whole;
    let more = far * 1.00001 + 1e-7;
    return all(heights > vec3<f32>(more)) || all(heights < vec3<f32>(-more));
}

// A triangle, relative to its corner a, and the largest distance from its corners that anything else may come within.
struct Placed { at: vec3<i32>, b: vec3<f32>, c: vec3<f32> }

// Whether triangle pqr is farther from `own` than `far`, as seen from the planes of both.
fn are_apart(own: Placed, p: vec3<i32>, q: vec3<i32>, r: vec3<i32>, far: f32) -> bool {
    let u = metres(p - own.at);
    let v = metres(q - own.at);
    let w = metres(r - own.at);
    return is_off(own.b, own.c, u, v, w, far) || is_off(v - u, w - u, -u, own.b - u, own.c - u, far);
}

// Lists the triangles of the cloth near the one in slot s. Returns how many there are.
fn gather_cloth(s: u32, own: Placed) -> u32 {
    let t = slots[s];
    let lower = boxes[2u * s];
    let upper = boxes[2u * s + 1u].xyz;
    let corners = triangles[t].xyz;
    var open: array<u32, 40>;
    var height = 1;
    open[0] = 0u;
    var count = 0u;
    while height > 0 {
        height--;
        let at = open[height];
        if any(node_boxes[2u * at].xyz > upper) || any(node_boxes[2u * at + 1u].xyz < lower.xyz) { continue; }
        let node = nodes[at];
        if node.x != 0u {
            open[height] = node.x;
            open[height + 1] = at + 1u;
            height += 2;
            continue;
        }
        for (var k = node.y; k < node.y + node.z; k++) {
            let other = boxes[2u * k];
            if k == s || any(other.xyz > upper) || any(boxes[2u * k + 1u].xyz < lower.xyz) { continue; }
            let u = slots[k];
            let ids = triangles[u].xyz;
            if any(ids.xxx == corners) || any(ids.yyy == corners) || any(ids.zzz == corners) { continue; }
            let far = bitcast<f32>(lower.w) + bitcast<f32>(other.w) + scene.thickness;
            if are_apart(own, anchors[ids.x].xyz, anchors[ids.y].xyz, anchors[ids.z].xyz, far) { continue; }
            if count < scene.near { near[count * scene.triangles + t] = u; }
            count++;
        }
    }
    return count;
}

// Lists the triangles of the body near the one in slot s. Returns how many there are.
fn gather_body(s: u32, own: Placed) -> u32 {
    let t = slots[s];
    let lower = boxes[2u * s];
    let upper = boxes[2u * s + 1u].xyz;
    var open: array<u32, 40>;
    var height = 1;
    open[0] = 0u;
    var count = 0u;
    while height > 0 {
        height--;
        let at = open[height];
        if any(body_boxes[2u * at].xyz > upper) || any(body_boxes[2u * at + 1u].xyz < lower.xyz) { continue; }
        let node = body_nodes[at];
        if node.x != 0u {
            open[height] = node.x;
            open[height + 1] = at + 1u;
            height += 2;
            continue;
        }
        for (var k = node.y; k < node.y + node.z; k++) {
            let u = body_slots[k];
            let ids = body_triangles[u].xyz;
            let far = bitcast<f32>(lower.w);
            if are_apart(own, body_places[ids.x].xyz, body_places[ids.y].xyz, body_places[ids.z].xyz, far) { continue; }
            if count < scene.near { near_body[count * scene.triangles + t] = u; }
            count++;
        }
    }
    return count;
}

@compute @workgroup_size(64)
fn gather(@builtin(global_invocation_id) id: vec3<u32>) {
    let s = id.x;
    if s >= scene.triangles { return; }
    let t = slots[s];
    let ids = triangles[t].xyz;
    let at = anchors[ids.x].xyz;
    let own = Placed(at, metres(anchors[ids.y].xyz - at), metres(anchors[ids.z].xyz - at));
    var found = vec2<u32>(gather_cloth(s, own), 0u);
    if (scene.flags & BODY) != 0u { found.y = gather_body(s, own); }
    if max(found.x, found.y) > scene.near { atomicMax(&faults[NEAR_FULL], max(found.x, found.y)); }
    near_counts[t] = min(found, vec2<u32>(scene.near));
}

// What a vertex has found at one of its triangles.
var<private> own_round: u32;
var<private> own_walls: u32;
var<private> own_contacts: u32;
var<private> own_reach: f32;

// The distance that two features keep at least until the next detection.
fn kept(gap: f32) -> f32 { return max(0.1 * gap, min(gap, scene.floor)); }

// Stores a wall `clear` metres from the anchor of v. Where there is no room for it, v may not reach it.
fn wall(v: u32, normal: vec3<f32>, clear: f32) {
    if clear >= own_reach { return; }
    if own_walls == scene.part_walls {
        own_reach = max(min(own_reach, clear), 0.0);
        atomicAdd(&faults[WALLS_FULL], 1u);
        return;
    }
    part_walls[own_walls * scene.rounds + own_round] = vec4<f32>(normal, max(clear, 0.0));
    own_walls++;
}

// The thickness of features that an edge from a to b joins, metres.
fn joined(a: u32, b: u32) -> f32 {
    let count = u32(places[a].w);
    for (var k = 0u; k < count; k++) {
        let spring = springs[k * scene.vertices + a];
        if spring.x == b { return 0.25 * sqrt(bitcast<f32>(spring.y)); }
    }
    return 1e9;
}

// Stores two features that may come nearer than the thickness.
fn remember(v: u32, ids: vec4<u32>, role: u32, gap: f32, normal: vec3<f32>) {
    let is_edges = (role & 4u) != 0u;
    let p = velocities[ids.x].xyz;
    let q = velocities[ids.y].xyz;
    let r = velocities[ids.z].xyz;
    let s = velocities[ids.w].xyz;
    let come = select((q + r + s) / 3.0 - p, (r + s - p - q) * 0.5, is_edges);
    let nearer = max(dot(normal, come), 0.0) * scene.span + NEARER;
    if gap >= scene.thickness + nearer { return; }
    var thickness = min(scene.thickness, min(joined(ids.x, ids.z), joined(ids.x, ids.w)));
    if is_edges {
        thickness = min(thickness, min(joined(ids.y, ids.z), joined(ids.y, ids.w)));
    } else {
        thickness = min(thickness, joined(ids.x, ids.y));
    }
    if gap >= thickness + nearer { return; }
    if own_contacts == scene.part_contacts {
        atomicAdd(&faults[CONTACTS_FULL], 1u);
        return;
    }
    let friction = vertices[ids.x].friction + vertices[ids.y].friction + vertices[ids.z].friction + vertices[ids.w].friction;
    part_contacts[own_contacts * scene.rounds + own_round] = Contact(ids, thickness, friction * 0.25, role, 0u);
    own_contacts++;
}

// Looks at two features as vertex v, which is number `role & 3` of their vertices, sees them. Every one of the four computes the
// same from the same numbers, so that their walls are one plane, or two that leave room between.
fn features(v: u32, ids: vec4<u32>, role: u32) {
    let at = anchors[ids.x];
    let q = anchors[ids.y];
    let r = anchors[ids.z];
    let s = anchors[ids.w];
    let b = metres(q.xyz - at.xyz);
    let c = metres(r.xyz - at.xyz);
    let d = metres(s.xyz - at.xyz);
    var way: vec3<f32>;
    var reach = vec2<f32>(bitcast<f32>(at.w), max(bitcast<f32>(r.w), bitcast<f32>(s.w)));
    let is_edges = (role & 4u) != 0u;
    if is_edges {
        let st = closest_on_segments(vec3<f32>(0.0), b, c, d);
        way = b * st.x - (c + (d - c) * st.y);
        reach.x = max(reach.x, bitcast<f32>(q.w));
    } else {
        way = -closest_on_triangle(b, c, d).point;
        reach.y = max(reach.y, bitcast<f32>(q.w));
    }
    let distance = length(way);
    let whole = reach.x + reach.y;
    if distance > whole + scene.thickness { return; }
    let normal = way / max(distance, 1e-12);
    let heights = vec4<f32>(0.0, dot(normal, b), dot(normal, c), dot(normal, d));
    let above = select(0.0, min(heights.y, 0.0), is_edges);
    let below = max(max(heights.z, heights.w), select(heights.y, heights.w, is_edges));
    let gap = above - below;
    if distance < 1e-9 || gap <= 0.0 {
        atomicAdd(&faults[TOUCHING], 1u);
        return;
    }
    remember(v, ids, role, gap, normal);
    if gap > whole { return; }
    let room = gap - kept(gap);
    let share = clamp(reach.y / whole, 0.2, 0.8);
    let height = heights[role & 3u];
    let is_first = (role & 3u) < select(1u, 2u, is_edges);
    if is_first {
        wall(v, normal, height - above + room * (1.0 - share));
    } else {
        wall(v, -normal, below - height + room * share);
    }
}

// Whether the boxes around two segments are farther apart than `far`.
fn sides_apart(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>, far: f32) -> bool {
    let more = vec3<f32>(far * 1.00001 + 1e-7);
    return any(min(a, b) - max(c, d) > more) || any(min(c, d) - max(a, b) > more);
}

// All pairs of features of triangles t, whose corner k is v, and u of the cloth in which v takes part.
fn pair(v: u32, at: vec3<i32>, t: u32, own: vec4<u32>, k: u32, u: u32) {
    let other = triangles[u];
    let ids = other.xyz;
    let places_of = array<vec4<i32>, 3>(anchors[ids.x], anchors[ids.y], anchors[ids.z]);
    var others = array<vec3<f32>, 3>(metres(places_of[0].xyz - at), metres(places_of[1].xyz - at), metres(places_of[2].xyz - at));
    let reaches = vec3<f32>(bitcast<f32>(places_of[0].w), bitcast<f32>(places_of[1].w), bitcast<f32>(places_of[2].w));
    let ends = vec2<u32>(own[(k + 1u) % 3u], own[(k + 2u) % 3u]);
    let first = anchors[ends.x];
    let second = anchors[ends.y];
    var own_others = array<vec3<f32>, 2>(metres(first.xyz - at), metres(second.xyz - at));
    let mine = reach_of(v);
    let own_reaches = vec3<f32>(mine, bitcast<f32>(first.w), bitcast<f32>(second.w));
    let farthest = max(max(own_reaches.x, own_reaches.y), own_reaches.z) + max(max(reaches.x, reaches.y), reaches.z) + scene.thickness;
    let near_enough = vec3<f32>(farthest * 1.00001 + 1e-7);
    // v itself, then each corner of u that u owns, against the other triangle.
    for (var m = 0u; m < 4u; m++) {
        if m == 3u {
            if any(ids == vec3<u32>(v)) || (own.w & (1u << k)) == 0u { continue; }
            features(v, vec4<u32>(v, ids), 0u);
            continue;
        }
        let w = ids[m];
        if (other.w & (1u << m)) == 0u || any(own.xyz == vec3<u32>(w)) { continue; }
        let p = others[m];
        let lower = min(min(own_others[0], own_others[1]), vec3<f32>(0.0));
        let upper = max(max(own_others[0], own_others[1]), vec3<f32>(0.0));
        if any(p - upper > near_enough) || any(lower - p > near_enough) { continue; }
        features(v, vec4<u32>(w, own.xyz), 1u + k);
    }
    // Side k of t begins at v, side k + 2 ends at it.
    for (var side = 0u; side < 2u; side++) {
        if (own.w & (8u << ((k + 2u * side) % 3u))) == 0u { continue; }
        let end = ends[side];
        for (var m = 0u; m < 3u; m++) {
            let n = (m + 1u) % 3u;
            let two = vec2<u32>(ids[m], ids[n]);
            if (other.w & (8u << m)) == 0u || any(two == vec2<u32>(end)) || any(two == vec2<u32>(v)) { continue; }
            if sides_apart(vec3<f32>(0.0), own_others[side], others[m], others[n], farthest) { continue; }
            let one = select(vec2<u32>(v, end), vec2<u32>(end, v), side == 1u);
            // The edge of the triangle with the lower number comes first.
            let is_first = t < u;
            features(v, select(vec4<u32>(two, one), vec4<u32>(one, two), is_first), select(6u, 4u, is_first) + side);
        }
    }
}

// Stores a wall between v, `above` the lowest vertex of its feature, and a feature of the body `gap` below that.
fn hold(v: u32, normal: vec3<f32>, above: f32, gap: f32, reach: f32) {
    if gap <= 0.0 {
        atomicAdd(&faults[IN_BODY], 1u);
        return;
    }
    if gap > reach { return; }
    wall(v, normal, above + gap - kept(gap));
}

// All pairs of features of triangle t (with v) and triangle u of the body in which v takes part.
fn body_pair(v: u32, at: vec3<i32>, own: vec4<u32>, k: u32, u: u32) {
    let other = body_triangles[u];
    let ids = other.xyz;
    var others = array<vec3<f32>, 3>(metres(body_places[ids.x].xyz - at), metres(body_places[ids.y].xyz - at), metres(body_places[ids.z].xyz - at));
    let mine = reach_of(v);
    if (own.w & (1u << k)) != 0u {
        let way = -closest_on_triangle(others[0], others[1], others[2]).point;
        let distance = length(way);
        if distance <= mine {
            let n = way / max(distance, 1e-12);
            hold(v, n, 0.0, -max(max(dot(n, others[0]), dot(n, others[1])), dot(n, others[2])), mine);
        }
    }
    let own_ids = own.xyz;
    let one = own_ids[(k + 1u) % 3u];
    let two = own_ids[(k + 2u) % 3u];
    let b = metres(anchors[one].xyz - at);
    let c = metres(anchors[two].xyz - at);
    let reaches = vec3<f32>(mine, reach_of(one), reach_of(two));
    let farthest = max(max(reaches.x, reaches.y), reaches.z);
    let more = vec3<f32>(farthest * 1.00001 + 1e-7);
    let own_lower = min(min(b, c), vec3<f32>(0.0)) - more;
    let own_upper = max(max(b, c), vec3<f32>(0.0)) + more;
    for (var m = 0u; m < 3u; m++) {
        if (other.w & (1u << m)) == 0u { continue; }
        let p = others[m];
        if any(p < own_lower) || any(p > own_upper) { continue; }
        let q = closest_on_triangle(-p, b - p, c - p).point;
        let distance = length(q);
        if distance > farthest { continue; }
        let n = q / max(distance, 1e-12);
        let low = min(min(dot(n, -p), dot(n, b - p)), dot(n, c - p));
        hold(v, n, dot(n, -p) - low, low, farthest);
    }
    for (var side = 0u; side < 2u; side++) {
        let mk = (k + 2u * side) % 3u;
        if (own.w & (8u << mk)) == 0u { continue; }
        let far_at = select(b, c, side == 1u);
        let reach = max(mine, select(reaches.y, reaches.z, side == 1u));
        for (var m = 0u; m < 3u; m++) {
            if (other.w & (8u << m)) == 0u { continue; }
            let p = others[m];
            let q = others[(m + 1u) % 3u];
            if sides_apart(vec3<f32>(0.0), far_at, p, q, reach) { continue; }
            let st = closest_on_segments(vec3<f32>(0.0), far_at, p, q);
            let way = far_at * st.x - (p + (q - p) * st.y);
            let distance = length(way);
            if distance > reach { continue; }
            let n = way / max(distance, 1e-12);
            let low = min(0.0, dot(n, far_at));
            hold(v, n, -low, low - max(dot(n, p), dot(n, q)), reach);
        }
    }
}

@compute @workgroup_size(64)
fn part(@builtin(global_invocation_id) id: vec3<u32>) {
    own_round = id.x;
    if own_round >= scene.rounds { return; }
    let v = rounds[own_round].x;
    let t = rounds[own_round].y;
    let anchor = anchors[v];
    own_walls = 0u;
    own_contacts = 0u;
    own_reach = bitcast<f32>(anchor.w);
    let own = triangles[t];
    let k = select(select(0u, 1u, own.y == v), 2u, own.z == v);
    let found = near_counts[t];
    for (var j = 0u; j < found.x; j++) {
        pair(v, anchor.xyz, t, own, k, near[j * scene.triangles + t]);
    }
    for (var j = beside_starts[t]; j < beside_starts[t + 1u]; j++) {
        pair(v, anchor.xyz, t, own, k, beside[j]);
    }
    for (var j = 0u; j < found.y; j++) {
        body_pair(v, anchor.xyz, own, k, near_body[j * scene.triangles + t]);
    }
    part_counts[own_round] = vec4<u32>(own_walls, own_contacts, bitcast<u32>(own_reach), 0u);
}

// Puts together what a vertex has found at all triangles round it.
@compute @workgroup_size(64)
fn collect(@builtin(global_invocation_id) id: vec3<u32>) {
    let v = id.x;
    if v >= scene.vertices { return; }
    var reach = bitcast<f32>(anchors[v].w);
    var all = vec2<u32>(0u);
    for (var r = round_starts[v]; r < round_starts[v + 1u]; r++) {
        let found = part_counts[r];
        reach = min(reach, bitcast<f32>(found.z));
        for (var k = 0u; k < found.x; k++) {
            let wall = part_walls[k * scene.rounds + r];
            if wall.w >= reach { continue; }
            if all.x == scene.walls {
                reach = min(reach, wall.w);
                atomicAdd(&faults[WALLS_FULL], 1u);
                continue;
            }
            walls[all.x * scene.vertices + v] = wall;
            all.x++;
        }
        for (var k = 0u; k < found.y; k++) {
            if all.y == scene.contacts {
                atomicAdd(&faults[CONTACTS_FULL], 1u);
                break;
            }
            contacts[all.y * scene.vertices + v] = part_contacts[k * scene.rounds + r];
            all.y++;
        }
    }
    counts[v] = all;
    anchors[v].w = bitcast<i32>(reach);
}
