// Cloth on a graphics card: what all steps share. Positions are whole numbers of `unit` metres: the displacement of one small
// step would be lost to rounding in single precision, while differences of neighbours are exact here.

struct Scene {
    gravity: vec3<f32>,
    // Size of a small step, s.
    small: f32,
    // Share of the velocity left after a small step.
    keep: f32,
    // Metres.
    unit: f32,
    // Strain beyond which springs are rigid.
    limit: f32,
    vertices: u32,
    // Distance kept from the body, metres.
    offset: f32,
    // Largest pressure that friction sees, Pa.
    grip: f32,
    // Largest distance, metres, by which older penetration is reduced in a small step; of the body and of cloth.
    body_ease: f32,
    ease: f32,
    // Seconds ahead for which bending is evaluated.
    ahead: f32,
    thickness: f32,
    triangles: u32,
    // Bits: BODY, CONTACT.
    flags: u32,
    // Seconds until the next detection, and until the body is looked up again.
    span: f32,
    look_span: f32,
    // Rooms in the lists of a vertex, in that of a triangle, and in those of a vertex at one triangle.
    walls: u32,
    contacts: u32,
    near: u32,
    part_walls: u32,
    part_contacts: u32,
    // Vertices with each of the triangles round them.
    rounds: u32,
    // Largest reach, metres.
    most_reach: f32,
    // The dragged vertex; none if it is not below `vertices`.
    hand: u32,
    // Share of the way to the target that it takes in a small step, and the most of it, metres.
    hand_share: f32,
    hand_most: f32,
    hand_target: vec3<i32>,
    // Distance that two features keep if they were not nearer, metres: below it single precision cannot tell where they are.
    floor: f32,
}
struct Level { first: u32, count: u32 }
// The body near a vertex, at its last look-up: there `side.w` metres above the offset along the normal `side.xyz`. The other
// side is that of a crease. `place.w` is the distance within which this stays valid, metres, as bits.
struct Skin {
    place: vec4<i32>,
    side: vec4<f32>,
    other_place: vec4<i32>,
    other: vec4<f32>,
}
// Two features that may come nearer than the thickness: a vertex and a triangle, or two edges. `role`: which of the four the
// vertex is that this is stored for, and 4 for edges.
struct Contact { vertices: vec4<u32>, thickness: f32, friction: f32, role: u32, spare: u32 }
// Inverse mass (1/kg), friction coefficient, distance kept besides the offset (m), area over mass (m²/kg).
struct Vertex { inverse_mass: f32, friction: f32, lift: f32, spread: f32 }

@group(0) @binding(0) var<uniform> scene: Scene;
// Spring k of vertex v at k * vertices + v: the other end; bits of the squared rest length, of the share of the correction, and
// of what that grows by where the spring is rigid.
@group(0) @binding(1) var<storage, read> springs: array<vec4<u32>>;
// Position and, last, the number of springs.
@group(0) @binding(2) var<storage, read> places: array<vec4<i32>>;
@group(0) @binding(3) var<storage, read_write> next_places: array<vec4<i32>>;
// Velocity and, last, inverse mass.
@group(0) @binding(4) var<storage, read> velocities: array<vec4<f32>>;
@group(0) @binding(5) var<storage, read_write> next_velocities: array<vec4<f32>>;
// Change of velocity by bending in each small step, m/s.
@group(0) @binding(6) var<storage, read_write> bent: array<vec4<f32>>;
@group(0) @binding(7) var<storage, read_write> skins: array<Skin>;
// Position at the last detection and, as bits, how far the vertex may go from it, metres.
@group(0) @binding(8) var<storage, read_write> anchors: array<vec4<i32>>;
// Half-spaces that a vertex must stay in: normal, and distance of the anchor from the border, metres.
@group(0) @binding(9) var<storage, read_write> walls: array<vec4<f32>>;
// Numbers of walls and contacts of each vertex.
@group(0) @binding(10) var<storage, read_write> counts: array<vec2<u32>>;
@group(0) @binding(11) var<storage, read_write> contacts: array<Contact>;
// Corners and, last, which corners (bits 0..3) and sides (bits 3..6) the triangle owns.
@group(0) @binding(12) var<storage, read> triangles: array<vec4<u32>>;
// Triangles in the order of the leaves; nodes: right child (0: a leaf), first and number of slots; two boxes' corners each.
@group(0) @binding(13) var<storage, read> slots: array<u32>;
@group(0) @binding(14) var<storage, read> nodes: array<vec4<u32>>;
@group(0) @binding(15) var<storage, read_write> node_boxes: array<vec4<i32>>;
@group(0) @binding(16) var<storage, read_write> boxes: array<vec4<i32>>;
// Triangles near each triangle, of the cloth and of the body, and how many.
@group(0) @binding(17) var<storage, read_write> near: array<u32>;
@group(0) @binding(18) var<storage, read_write> near_counts: array<vec2<u32>>;
@group(0) @binding(19) var<storage, read_write> near_body: array<u32>;
// Triangles that share a vertex with each triangle. For each vertex and each triangle round it the two of them.
@group(0) @binding(20) var<storage, read> beside_starts: array<u32>;
@group(0) @binding(21) var<storage, read> beside: array<u32>;
@group(0) @binding(22) var<storage, read> round_starts: array<u32>;
@group(0) @binding(23) var<storage, read> rounds: array<vec2<u32>>;
// Rows of the bending matrix: how many entries; column and bits of the value, N/m.
@group(0) @binding(24) var<storage, read> bending_counts: array<u32>;
@group(0) @binding(25) var<storage, read> bending: array<vec2<u32>>;
@group(0) @binding(26) var<storage, read> body_places: array<vec4<i32>>;
@group(0) @binding(27) var<storage, read> body_triangles: array<vec4<u32>>;
@group(0) @binding(28) var<storage, read> body_nodes: array<vec4<u32>>;
@group(0) @binding(29) var<storage, read> body_boxes: array<vec4<i32>>;
@group(0) @binding(30) var<storage, read> body_slots: array<u32>;
// Seven of each triangle: of its face, its sides, its corners.
@group(0) @binding(31) var<storage, read> body_normals: array<vec4<f32>>;
// Nodes of the cloth's tree, the deepest level first.
@group(0) @binding(32) var<storage, read> order: array<u32>;
@group(0) @binding(33) var<storage, read> vertices: array<Vertex>;
@group(0) @binding(34) var<uniform> level: Level;
// What a vertex finds at one triangle round it, to be put together in `walls` and `contacts`: the numbers of both, and bits of the
// reach.
@group(0) @binding(36) var<storage, read_write> part_counts: array<vec4<u32>>;
@group(0) @binding(37) var<storage, read_write> part_walls: array<vec4<f32>>;
@group(0) @binding(38) var<storage, read_write> part_contacts: array<Contact>;
// How often something went wrong, see `FAULTS` in src/card/steps.rs.
@group(0) @binding(35) var<storage, read_write> faults: array<atomic<u32>>;

const BODY = 1u;
const CONTACT = 2u;

fn units(way: vec3<f32>) -> vec3<i32> {
    return vec3<i32>(floor(way / scene.unit + 0.5));
}

fn metres(way: vec3<i32>) -> vec3<f32> {
    return vec3<f32>(way) * scene.unit;
}


struct OnTriangle { point: vec3<f32>, part: u32 }

// The point of abc closest to the origin; part 0: face, 1..3 sides, 4..6 corners.
fn closest_on_triangle(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> OnTriangle {
    let ab = b - a;
    let ac = c - a;
    let d1 = -dot(ab, a);
    let d2 = -dot(ac, a);
    if d1 <= 0.0 && d2 <= 0.0 { return OnTriangle(a, 4u); }
    let d3 = -dot(ab, b);
    let d4 = -dot(ac, b);
    if d3 >= 0.0 && d4 <= d3 { return OnTriangle(b, 5u); }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 { return OnTriangle(a + ab * (d1 / (d1 - d3)), 1u); }
    let d5 = -dot(ab, c);
    let d6 = -dot(ac, c);
    if d6 >= 0.0 && d5 <= d6 { return OnTriangle(c, 6u); }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 { return OnTriangle(a + ac * (d2 / (d2 - d6)), 3u); }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0 {
        return OnTriangle(b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6))), 2u);
    }
    let sum = va + vb + vc;
    if sum == 0.0 { return OnTriangle(a, 4u); }
    return OnTriangle(a + ab * (vb / sum) + ac * (vc / sum), 0u);
}

fn barycentric(p: vec3<f32>, a: vec3<f32>, b: vec3<f32>, c: vec3<f32>) -> vec2<f32> {
    let u = b - a;
    let v = c - a;
    let w = p - a;
    let uu = dot(u, u);
    let uv = dot(u, v);
    let vv = dot(v, v);
    let wu = dot(w, u);
    let wv = dot(w, v);
    let whole = uu * vv - uv * uv;
    if whole > 0.0 { return vec2<f32>(vv * wu - uv * wv, uu * wv - uv * wu) / whole; }
    return vec2<f32>(0.0);
}

// Shares along ab and cd of the closest points of the two segments.
fn closest_on_segments(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, d: vec3<f32>) -> vec2<f32> {
    let u = b - a;
    let v = d - c;
    let w = a - c;
    let uu = dot(u, u);
    let uv = dot(u, v);
    let vv = dot(v, v);
    let uw = dot(u, w);
    let vw = dot(v, w);
    if uu == 0.0 && vv == 0.0 { return vec2<f32>(0.0); }
    if uu == 0.0 { return vec2<f32>(0.0, clamp(vw / vv, 0.0, 1.0)); }
    if vv == 0.0 { return vec2<f32>(clamp(-uw / uu, 0.0, 1.0), 0.0); }
    let whole = uu * vv - uv * uv;
    var s = 0.0;
    if whole > 1e-6 * uu * vv { s = clamp((uv * vw - vv * uw) / whole, 0.0, 1.0); }
    let t = clamp((uv * s + vw) / vv, 0.0, 1.0);
    s = clamp((uv * t - uw) / uu, 0.0, 1.0);
    return vec2<f32>(s, t);
}

