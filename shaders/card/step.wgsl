// One small step of extended position-based dynamics. Corrections of all springs of a vertex are added up (Jacobi), so that a
// step is one pass over the vertices and its result does not depend on the order of threads.

const CREASE_SPEED = 1.5;
const SWEEPS = 3;

// A displacement in a small step, metres, and how much of it gives no momentum.
struct Moved { way: vec3<f32>, free: vec3<f32> }

fn by_springs(v: u32, place: vec4<i32>) -> vec3<f32> {
    var sum = vec3<f32>(0.0);
    for (var k = 0u; k < u32(place.w); k++) {
        let spring = springs[k * scene.vertices + v];
        let along = metres(places[spring.x].xyz - place.xyz);
        let rest = bitcast<f32>(spring.y);
        let squared = dot(along, along);
        let strain = (squared - rest) / (squared + rest);
        let over = strain - clamp(strain, -scene.limit, scene.limit);
        sum += along * (strain * bitcast<f32>(spring.z) + over * bitcast<f32>(spring.w));
    }
    return sum;
}

// Pushes vertex v off cloth that is nearer than the thickness, with friction.
fn by_contacts(v: u32) -> Moved {
    var sum = vec3<f32>(0.0);
    var free = vec3<f32>(0.0);
    var whole_weight = 0.0;
    let count = counts[v].y;
    for (var k = 0u; k < count; k++) {
        let contact = contacts[k * scene.vertices + v];
        let ids = contact.vertices;
        let a = places[ids.x].xyz;
        let b = metres(places[ids.y].xyz - a);
        let c = metres(places[ids.z].xyz - a);
        let d = metres(places[ids.w].xyz - a);
        var weights: vec4<f32>;
        var way: vec3<f32>;
        if (contact.role & 4u) != 0u {
            let st = closest_on_segments(vec3<f32>(0.0), b, c, d);
            weights = vec4<f32>(1.0 - st.x, st.x, st.y - 1.0, -st.y);
            way = b * st.x - (c + (d - c) * st.y);
        } else {
            let q = closest_on_triangle(b, c, d).point;
            let uv = barycentric(q, b, c, d);
            weights = vec4<f32>(1.0, uv.x + uv.y - 1.0, -uv.x, -uv.y);
            way = -q;
        }
        let distance = length(way);
        let depth = contact.thickness - distance;
        if depth <= 0.0 || distance == 0.0 { continue; }
        let p = velocities[ids.x];
        let q = velocities[ids.y];
        let r = velocities[ids.z];
        let s = velocities[ids.w];
        let inverse = vec4<f32>(p.w, q.w, r.w, s.w);
        let whole = dot(weights * weights, inverse);
        if whole == 0.0 { continue; }
        let normal = way / distance;
        let come = (p.xyz * weights.x + q.xyz * weights.y + r.xyz * weights.z + s.xyz * weights.w) * scene.small;
        let approach = -dot(normal, come);
        let now = clamp(approach, 0.0, depth);
        let eased = min(depth - now, scene.ease);
        let slip = come + normal * approach;
        let long = length(slip);
        var hold = 0.0;
        if long > 0.0 { hold = min(contact.friction * now / long, 1.0); }
        let weight = weights[contact.role & 3u];
        let share = weight * inverse[contact.role & 3u] / whole;
        sum += normal * (share * now) - slip * (share * hold);
        free += normal * (share * eased);
        whole_weight += abs(weight);
    }
    // Several contacts of one place tell of the same depth.
    let scale = 1.0 / max(whole_weight, 1.0);
    return Moved((sum + free) * scale, free * scale);
}

// Projects vertex v, displaced by `moved` from `place`, off the body, with friction.
fn off_body(v: u32, place: vec3<i32>, velocity: vec3<f32>, moved: Moved) -> Moved {
    var way = moved.way;
    var free = moved.free;
    let me = vertices[v];
    let skin = skins[v];
    let normal = skin.side.xyz;
    if any(normal != vec3<f32>(0.0)) {
        let height = skin.side.w - me.lift + dot(normal, metres(place - skin.place.xyz));
        var depth = -(height + dot(normal, way));
        let old = -(height + dot(normal, free - velocity * scene.small));
        if scene.body_ease > 0.0 && old > 0.0 {
            let eased = min(old, scene.body_ease);
            depth -= old - eased;
            free += normal * eased;
        }
        if depth > 0.0 {
            way += normal * depth;
            let come = way + velocity * scene.small - free;
            let slip = come - normal * dot(come, normal);
            let long = length(slip);
            let hold = me.friction * min(depth, scene.grip * me.spread * scene.small * scene.small);
            if long <= hold { way -= slip; } else { way -= slip * (hold / long); }
        }
    }
    let other = skin.other.xyz;
    if any(other != vec3<f32>(0.0)) {
        let depth = -(skin.other.w - me.lift + dot(other, metres(place - skin.other_place.xyz) + way));
        // The projection adds no velocity: between the two sides of a crease the cloth would tremble.
        let push = other * clamp(depth, 0.0, CREASE_SPEED * scene.small);
        way += push;
        free += push;
    }
    return Moved(way, free);
}

// Truncates the displacement of vertex v so that it stays within its walls and its reach.
fn truncated(v: u32, place: vec3<i32>, velocity: vec3<f32>, moved: Moved) -> Moved {
    let anchor = anchors[v];
    let reach = bitcast<f32>(anchor.w);
    let start = metres(place - anchor.xyz);
    var x = start + moved.way;
    var free = moved.free;
    let far = length(x);
    if far > reach {
        // It goes on after the next detection, and keeps its momentum until then.
        let inner = x * (reach / far);
        free += inner - x;
        x = inner;
    }
    let count = counts[v].x;
    var is_in = true;
    for (var sweep = 0; sweep < SWEEPS; sweep++) {
        is_in = true;
        for (var k = 0u; k < count; k++) {
            let wall = walls[k * scene.vertices + v];
            let depth = -wall.w - dot(wall.xyz, x);
            if depth > 0.0 {
                x += wall.xyz * depth;
                is_in = false;
            }
        }
        if is_in { break; }
    }
    if !is_in {
        var share = 1.0;
        for (var k = 0u; k < count; k++) {
            let wall = walls[k * scene.vertices + v];
            let height = dot(wall.xyz, x);
            if height < -wall.w { share = min(share, wall.w / -height); }
        }
        x *= share * 0.99999;
    }
    let now = length(x);
    if now > reach { x *= reach / now; }
    // Pulled back towards its anchor it comes to rest: that way in one small step would throw it.
    if !is_in { free = x - start + velocity * scene.small; }
    return Moved(x - start, free);
}

// The displacement of vertex v from `place`, where its `velocity` has brought it, to the end of the small step.
fn solved(v: u32, place: vec4<i32>, velocity: vec3<f32>) -> Moved {
    var moved = Moved(by_springs(v, place), vec3<f32>(0.0));
    let contact = (scene.flags & CONTACT) != 0u;
    if contact && counts[v].y > 0u {
        let pushed = by_contacts(v);
        moved.way += pushed.way;
        moved.free += pushed.free;
    }
    if v == scene.hand {
        let pull = (metres(scene.hand_target - place.xyz) - moved.way) * scene.hand_share;
        moved.way += pull * min(1.0, scene.hand_most / max(length(pull), 1e-30));
    }
    if (scene.flags & BODY) != 0u { moved = off_body(v, place.xyz, velocity, moved); }
    if contact { moved = truncated(v, place.xyz, velocity, moved); }
    return moved;
}

fn driven(v: u32, velocity: vec3<f32>) -> vec3<f32> {
    return velocity * scene.keep + scene.gravity * scene.small + bent[v].xyz;
}

// Stores vertex v of velocity `speed`, moved from `place` by `way`.
fn store(v: u32, place: vec4<i32>, way: vec3<f32>, speed: vec3<f32>, inverse_mass: f32) {
    next_velocities[v] = vec4<f32>(speed, inverse_mass);
    next_places[v] = vec4<i32>(place.xyz + units(way), place.w);
}

// Ends a small step of vertex v, and adds the forces of the next unless it is the last.
fn end(v: u32, is_last: bool) {
    let place = places[v];
    let old = velocities[v];
    var speed = vec3<f32>(0.0);
    var way = vec3<f32>(0.0);
    if old.w > 0.0 {
        let moved = solved(v, place, old.xyz);
        speed = old.xyz + (moved.way - moved.free) / scene.small;
        way = moved.way;
        if !is_last {
            speed = driven(v, speed);
            way += speed * scene.small;
        }
    }
    store(v, place, way, speed, old.w);
}

// The first small step: forces only.
@compute @workgroup_size(64)
fn begin(@builtin(global_invocation_id) id: vec3<u32>) {
    let v = id.x;
    if v >= scene.vertices { return; }
    let old = velocities[v];
    var speed = vec3<f32>(0.0);
    if old.w > 0.0 { speed = driven(v, old.xyz); }
    store(v, places[v], speed * scene.small, speed, old.w);
}

@compute @workgroup_size(64)
fn go(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < scene.vertices { end(id.x, false); }
}

@compute @workgroup_size(64)
fn finish(@builtin(global_invocation_id) id: vec3<u32>) {
    if id.x < scene.vertices { end(id.x, true); }
}

// Bending, held constant until it is evaluated again.
@compute @workgroup_size(64)
fn bend(@builtin(global_invocation_id) id: vec3<u32>) {
    let v = id.x;
    if v >= scene.vertices { return; }
    let place = places[v].xyz;
    let own = velocities[v];
    var sum = vec3<f32>(0.0);
    let count = bending_counts[v];
    for (var k = 0u; k < count; k++) {
        let entry = bending[k * scene.vertices + v];
        let ahead = (velocities[entry.x].xyz - own.xyz) * scene.ahead;
        sum += (metres(places[entry.x].xyz - place) + ahead) * bitcast<f32>(entry.y);
    }
    bent[v] = vec4<f32>(sum * (-scene.small * own.w), 0.0);
}
