use std::collections::BTreeMap;

use glam::DVec3;

use super::*;
use crate::body::measure;
use crate::geometry::adjacency::Adjacency;

fn small() -> Measurements {
    Measurements {
        height: 1.66,
        bust: 0.80,
        waist: 0.62,
        abdomen: 0.76,
        hip: 0.88,
        half_across_shoulder: 0.185,
        neck: 0.31,
        arm_length: 0.56,
        upper_arm: 0.245,
        wrist: 0.148,
        upper_thigh: 0.50,
        mid_thigh: 0.43,
        knee: 0.325,
        calf: 0.325,
        ankle: 0.205,
        waist_to_ankle: 0.985,
    }
}

fn large() -> Measurements {
    Measurements {
        height: 1.72,
        bust: 1.16,
        waist: 0.98,
        abdomen: 1.10,
        hip: 1.20,
        half_across_shoulder: 0.208,
        neck: 0.385,
        arm_length: 0.585,
        upper_arm: 0.36,
        wrist: 0.178,
        upper_thigh: 0.70,
        mid_thigh: 0.60,
        knee: 0.43,
        calf: 0.415,
        ankle: 0.25,
        waist_to_ankle: 1.03,
    }
}

fn tall() -> Measurements {
    Measurements {
        height: 1.92,
        waist_to_ankle: 1.165,
        arm_length: 0.65,
        half_across_shoulder: 0.212,
        ..Default::default()
    }
}

/// The measurements that are in proportion to those of a size.
fn sized(height: f64, [bust, waist, hip]: [f64; 3]) -> Measurements {
    let given = [("height", height), ("bust", bust), ("waist", waist), ("hip", hip)];
    Measurements::completed(|name| given.iter().find(|(known, _)| *known == name).map(|(_, metres)| *metres))
}

/// Children of 98, 116 and 134 cm.
fn children() -> [Measurements; 3] {
    [sized(0.98, [0.55, 0.525, 0.57]), sized(1.16, [0.60, 0.56, 0.635]), sized(1.34, [0.67, 0.61, 0.72])]
}

/// The first crossing of a ray with the mesh, by looking at every triangle.
fn first_hit(mesh: &TriMesh, origin: DVec3, direction: DVec3) -> f64 {
    (0..mesh.triangles.len())
        .filter_map(|t| {
            let [a, b, c] = mesh.corners(t);
            let (e, f) = (b - a, c - a);
            let h = direction.cross(f);
            let det = e.dot(h);
            if det.abs() < 1e-14 {
                return None;
            }
            let s = origin - a;
            let u = s.dot(h) / det;
            let q = s.cross(e);
            let v = direction.dot(q) / det;
            let t = f.dot(q) / det;
            (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
        })
        .fold(f64::INFINITY, f64::min)
}

/// What a tape reads on the finished mesh.
fn reading(m: &Mannequin, name: &str) -> f64 {
    let mark = |name: &str| m.landmarks.get(name).expect(name);
    match name {
        "height" => m.mesh.bounds().1.y - m.mesh.bounds().0.y,
        "half across shoulder" => 0.5 * mark("shoulder_left").distance(mark("shoulder_right")),
        "arm length" => {
            mark("shoulder_left").distance(mark("elbow_left"))
                + mark("elbow_left").distance(mark("wrist_left"))
        }
        "waist to ankle" => {
            let (hip, ankle) = (m.skeleton.position("hip_left"), m.skeleton.position("ankle_left"));
            let (hip, ankle) = (hip.expect("hip"), ankle.expect("ankle"));
            let top = mark("waist_side_left").y;
            let inside: Vec<DVec3> = (0..=100)
                .map(|i| {
                    let y = top + (ankle.y - top) * f64::from(i) / 100.0;
                    let along = ((hip.y - y) / (hip.y - ankle.y)).clamp(0.0, 1.0);
                    DVec3::new(hip.x + (ankle.x - hip.x) * along, y, ankle.z * along)
                })
                .collect();
            fit::side_tape(&inside, |p| first_hit(&m.mesh, p, DVec3::X))
        }
        girth => {
            let tape = m.tapes.iter().find(|t| t.name == girth).expect("a tape");
            measure::girth(&m.mesh, tape).expect("a girth")
        }
    }
}

fn check_measurements(m: &Measurements) {
    let built = mannequin(m).expect("a body");
    for (name, wanted) in m.named() {
        let found = reading(&built, name);
        let error = (found / wanted - 1.0).abs();
        assert!(error < 0.01, "{name}: wanted {wanted:.4} m, the tape reads {found:.4} m");
    }
}

fn check_mesh(m: &Measurements) {
    let mesh = &mannequin(m).expect("a body").mesh;
    let count = mesh.triangles.len();
    assert!((20_000..=30_000).contains(&count), "{count} triangles");
    assert!(remesh::is_ball(mesh));
    let cube = (m.height / Measurements::default().height).powi(3);
    assert!(mesh.volume() > 0.04 * cube, "{} cubic metres", mesh.volume());
    let adjacency = Adjacency::new(mesh.positions.len(), &mesh.triangles);
    assert_eq!(mesh.positions.len() + count, adjacency.edges.len() + 2, "Euler characteristic");
    assert_eq!(components(mesh, &adjacency), 1);
    for v in 0..mesh.positions.len() as u32 {
        assert_eq!(
            adjacency.vertex_triangles.of(v).len(),
            adjacency.vertex_neighbours.of(v).len(),
            "fan of {v}"
        );
    }
    let mut angles: Vec<f64> = (0..count).map(|t| smallest_angle(mesh.corners(t))).collect();
    angles.sort_by(f64::total_cmp);
    assert!(angles[0] > 5.0, "sharpest angle {}", angles[0]);
    assert!(angles[count / 100] > 38.0, "sharpest angle of 99 % {}", angles[count / 100]);
}

fn components(mesh: &TriMesh, adjacency: &Adjacency) -> usize {
    let mut seen = vec![false; mesh.positions.len()];
    let mut count = 0;
    for start in 0..seen.len() {
        if seen[start] {
            continue;
        }
        count += 1;
        let mut open = vec![start as u32];
        seen[start] = true;
        while let Some(v) = open.pop() {
            for &w in adjacency.vertex_neighbours.of(v) {
                if !std::mem::replace(&mut seen[w as usize], true) {
                    open.push(w);
                }
            }
        }
    }
    count
}

fn smallest_angle(p: [DVec3; 3]) -> f64 {
    (0..3)
        .map(|k| {
            let (u, v) = (p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
            u.cross(v).length().atan2(u.dot(v)).to_degrees()
        })
        .fold(180.0, f64::min)
}

#[test]
fn the_default_body_measures_what_it_should() {
    check_measurements(&Measurements::default());
}

#[test]
fn other_bodies_measure_what_they_should() {
    check_measurements(&small());
    check_measurements(&large());
    check_measurements(&tall());
}

#[test]
fn children_measure_what_they_should() {
    children().iter().for_each(check_measurements);
}

#[test]
fn children_are_proportioned_as_children() {
    for (child, share) in children().iter().zip([0.196, 0.1775, 0.1365]) {
        let body = mannequin(child).expect("a body");
        let y = |name: &str| body.landmarks.get(name).expect(name).y;
        let chin = body.skeleton.position("crown").expect("crown").y
            - Figure::new(fit::factors(child, wanted_edge).expect("factors")).y(proportions::level::CHIN);
        assert!((chin / child.height - share).abs() < 0.002, "a head of {chin} m on {} m", child.height);
        assert!(y("crotch") < 0.47 * child.height, "legs of {} m", y("crotch"));
        // No breasts: the chest is as deep at the bust points as in its middle.
        let z = |name: &str| body.landmarks.get(name).expect(name).z;
        assert!(z("bust_point_left") < z("bust_front") + 0.002);
    }
}

#[test]
fn a_child_just_under_the_limit_is_as_a_grown_figure_just_over_it() {
    let [below, above] = [1.39, 1.41].map(|height| sized(height, [0.70, 0.63, 0.75]));
    for ((name, one), (_, other)) in below.named().into_iter().zip(above.named()) {
        assert!((one / other - 1.0).abs() < 0.02, "{name}: {one} and {other}");
    }
    let [below, above] = [below, above].map(|m| mannequin(&m).expect("a body"));
    for (name, p) in below.landmarks.iter() {
        let apart = p.distance(above.landmarks.get(name).expect(name));
        assert!(apart < 0.025, "{name} is {apart} m apart");
    }
}

#[test]
fn meshes_are_closed_even_and_of_one_piece() {
    for m in [Measurements::default(), small(), large(), tall()].into_iter().chain(children()) {
        check_mesh(&m);
    }
}

#[test]
fn it_stands_on_the_floor_and_is_symmetric() {
    let m = default();
    let (lower, upper) = m.mesh.bounds();
    assert!(lower.y.abs() < 1e-3 && (upper.y - 1.78).abs() < 1e-3, "{lower} {upper}");
    let key = |p: DVec3| [p.x.to_bits(), p.y.to_bits(), p.z.to_bits()];
    let there: BTreeMap<_, ()> = m.mesh.positions.iter().map(|&p| (key(p), ())).collect();
    for &p in &m.mesh.positions {
        let twin = if p.x == 0.0 { p } else { DVec3::new(-p.x, p.y, p.z) };
        assert!(there.contains_key(&key(twin)), "{p} has no twin");
    }
    // The chest is in front of the back, and the toes point forward.
    assert!(upper.z > 0.12 && m.landmarks.get("bust_point_left").expect("bust").z > 0.1);
}

#[test]
fn the_same_measurements_give_the_same_bits() {
    let again = built(&Measurements::default()).expect("a body");
    assert!(again == *default());
}

#[test]
fn limbs_keep_apart() {
    for m in [Measurements::default(), small(), large(), tall()].into_iter().chain(children()) {
        let body = mannequin(&m).expect("a body");
        let mark = |name: &str| body.landmarks.get(name).expect(name);
        // At bust height the section is trunk and two arms.
        let bust = measure::section(&body.mesh, mark("bust_front"), DVec3::Y);
        assert_eq!(bust.len(), 3, "arms touch the trunk");
        // Below the crotch two legs, 3 cm apart.
        let crotch = mark("crotch");
        let down = crotch.y - 0.04 * m.height;
        let inner =
            |sign: f64| first_hit(&body.mesh, DVec3::new(0.0, down, crotch.z), DVec3::new(sign, 0.0, 0.0));
        let between = inner(1.0) + inner(-1.0);
        // As a share of the height, or that of a tall figure.
        assert!(between > 0.03 * (m.height / 1.66).min(1.0), "{between} m between the thighs");
    }
}

#[test]
fn landmarks_lie_on_the_skin_in_order() {
    check_landmarks(&default());
    children().iter().for_each(|child| check_landmarks(&mannequin(child).expect("a body")));
}

fn check_landmarks(m: &Mannequin) {
    let y = |name: &str| m.landmarks.get(name).expect(name).y;
    let downwards = [
        "crown",
        "chin",
        "neck_front",
        "shoulder_left",
        "armpit_left",
        "bust_front",
        "waist_front",
        "hip_front",
        "crotch",
        "knee_left",
        "ankle_left",
    ];
    for pair in downwards.windows(2) {
        assert!(y(pair[0]) > y(pair[1]), "{} above {}", pair[0], pair[1]);
    }
    assert_eq!(m.skeleton.six_segments().len(), 6);
    let (surface, bones) =
        (crate::body::Surface::new(m.mesh.clone()).expect("a surface"), &m.skeleton.joints);
    for joint in bones.iter().filter(|j| j.name != "crown") {
        assert!(surface.contains(joint.position), "{} lies inside", joint.name);
    }
    for (name, p) in m.landmarks.iter() {
        assert!(surface.nearest(p).distance.abs() < 1e-6, "{name} lies on the skin");
    }
}

#[test]
fn the_skin_does_not_cross_itself() {
    for m in [Measurements::default(), small(), large()].into_iter().chain(children()) {
        assert_eq!(crossings(&mannequin(&m).expect("a body").mesh), 0);
    }
}

/// Edges that pass through a triangle they share no vertex with, looked for over a grid of boxes.
fn crossings(mesh: &TriMesh) -> usize {
    const CELL: f64 = 0.02;
    let cell = |x: f64| (x / CELL).floor() as i32;
    let mut boxes: BTreeMap<[i32; 3], Vec<u32>> = BTreeMap::new();
    for t in 0..mesh.triangles.len() {
        for key in cells(&mesh.corners(t), cell) {
            boxes.entry(key).or_default().push(t as u32);
        }
    }
    let edges = Adjacency::new(mesh.positions.len(), &mesh.triangles).edges;
    edges
        .iter()
        .filter(|&&[a, b]| {
            let ends = [a, b].map(|v| mesh.positions[v as usize]);
            cells(&ends, cell).iter().filter_map(|key| boxes.get(key)).flatten().any(|&t| {
                let corners = mesh.triangles[t as usize];
                !corners.contains(&a) && !corners.contains(&b) && pierces(ends, mesh.corners(t as usize))
            })
        })
        .count()
}

fn cells(points: &[DVec3], cell: impl Fn(f64) -> i32) -> Vec<[i32; 3]> {
    let (lower, upper) = crate::geometry::mesh::bounds(points);
    let mut keys = Vec::new();
    for i in cell(lower.x)..=cell(upper.x) {
        for j in cell(lower.y)..=cell(upper.y) {
            for k in cell(lower.z)..=cell(upper.z) {
                keys.push([i, j, k]);
            }
        }
    }
    keys
}

fn pierces([p, q]: [DVec3; 2], [a, b, c]: [DVec3; 3]) -> bool {
    let volume = |a: DVec3, b: DVec3, c: DVec3, d: DVec3| (b - a).cross(c - a).dot(d - a);
    let differ = |x: f64, y: f64| x * y < 0.0;
    let sides = [volume(p, q, a, b), volume(p, q, b, c), volume(p, q, c, a)];
    differ(volume(a, b, c, p), volume(a, b, c, q))
        && (sides.iter().all(|&s| s > 0.0) || sides.iter().all(|&s| s < 0.0))
}

#[test]
fn impossible_bodies_are_refused_in_words() {
    let error = mannequin(&Measurements { height: 3.0, ..Default::default() }).expect_err("refused");
    assert!(error.to_string().contains("height is 300.0 cm"), "{error}");
}
