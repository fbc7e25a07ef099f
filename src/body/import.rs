//! Import of a body: scales a mesh to metres, repairs and checks it, and reports what was found.
//!
//! Repairs that keep the shape are made and reported: split vertices are joined, triangles are turned outward. An
//! open or non-manifold mesh is not repaired; its problems say why cloth cannot be put on it.

use std::collections::BTreeMap;

use glam::DVec3;

use crate::body::unit::{Unit, guess_unit};
use crate::geometry::mesh::TriMesh;
use crate::geometry::orient;
use crate::geometry::problem::{Problem, ProblemKind};
use crate::geometry::words::{Words, decimal, words};

/// Largest absolute value of a coordinate, metres.
const FARTHEST: f64 = 1e6;
/// Heights (metres) outside of which the unit of the file is questioned.
const USUAL_HEIGHT: std::ops::RangeInclusive<f64> = 0.5..=2.5;

/// Counts and sizes of a mesh after the repairs.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct BodyReport {
    /// Number of vertices.
    pub vertices: usize,
    /// Number of triangles.
    pub triangles: usize,
    /// Number of border edges (used by one triangle).
    pub open_edges: usize,
    /// Number of edges used by three or more triangles.
    pub non_manifold_edges: usize,
    /// Number of edges whose two triangles are still oriented differently: the surface cannot be oriented.
    pub misoriented_edges: usize,
    /// Number of triangles turned because they were oriented differently from their neighbours.
    pub turned_triangles: usize,
    /// Whether the whole mesh was inside out (negative volume) and was turned.
    pub inverted: bool,
    /// Number of connected components.
    pub components: usize,
    /// Number of vertices removed because no triangle uses them.
    pub isolated_vertices: usize,
    /// Number of vertices joined to another at the same position to close the mesh.
    pub welded_vertices: usize,
    /// Number of triangles removed because joining left them fewer than three different vertices.
    pub collapsed_triangles: usize,
    /// Number of triangles without area; they are kept.
    pub thin_triangles: usize,
    /// Enclosed volume, cubic metres; meaningless for an open mesh.
    pub volume: f64,
    /// Sides of the bounding box, metres; the second is the height.
    pub size: DVec3,
    /// Lowest y coordinate, metres.
    pub lowest: f64,
}

/// An imported and checked body.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    /// The mesh, metres, triangles facing outward.
    pub mesh: TriMesh,
    /// For each vertex of `mesh` its index in the file.
    pub kept: Vec<u32>,
    /// Counts and sizes of the mesh.
    pub report: BodyReport,
    /// Why cloth cannot be put on it; empty for a usable body.
    pub problems: Vec<Problem>,
    /// What was repaired and what deserves a look, as messages.
    pub notes: Vec<Words>,
}

impl Imported {
    /// Whether cloth can be put on it.
    pub fn is_usable(&self) -> bool {
        self.problems.is_empty()
    }
}

/// Scales `mesh` from `unit` to metres, repairs and checks it.
pub fn import(mut mesh: TriMesh, unit: Unit) -> Imported {
    for p in &mut mesh.positions {
        *p *= unit.metres();
    }
    let mut report = BodyReport::default();
    if mesh.positions.iter().any(|p| !p.is_finite() || p.abs().max_element() > FARTHEST) {
        let words = words!("a coordinate is not finite or beyond {most} m", most = FARTHEST);
        let (kept, notes) = (Vec::new(), Vec::new());
        return Imported { mesh, kept, report, problems: vec![problem(words)], notes };
    }
    join(&mut mesh, &mut report);
    let kept = drop_isolated(&mut mesh, &mut report);
    turn_outward(&mut mesh, &mut report);
    count(&mesh, &mut report);
    let problems = problems(&mesh, &report);
    let notes = notes(&report, unit);
    Imported { mesh, kept, report, problems, notes }
}

/// Joins vertices at the same position if that leaves fewer border edges: files often split vertices along texture seams.
fn join(mesh: &mut TriMesh, report: &mut BodyReport) {
    let open = orient::edge_uses(&mesh.triangles).open;
    if open == 0 {
        return;
    }
    let mut first: BTreeMap<[u64; 3], u32> = BTreeMap::new();
    let same: Vec<u32> = (0u32..)
        .zip(&mesh.positions)
        .map(|(v, p)| *first.entry([p.x, p.y, p.z].map(|x| (x + 0.0).to_bits())).or_insert(v))
        .collect();
    let joined: Vec<[u32; 3]> = mesh
        .triangles
        .iter()
        .map(|t| t.map(|v| same[v as usize]))
        .filter(|[a, b, c]| a != b && b != c && c != a)
        .collect();
    if orient::edge_uses(&joined).open < open {
        report.welded_vertices = (0u32..).zip(&same).filter(|(v, s)| v != *s).count();
        report.collapsed_triangles = mesh.triangles.len() - joined.len();
        mesh.triangles = joined;
    }
}

/// Removes vertices without triangles. Returns the old indices of those that stay.
fn drop_isolated(mesh: &mut TriMesh, report: &mut BodyReport) -> Vec<u32> {
    let mut used = vec![false; mesh.positions.len()];
    for &v in mesh.triangles.iter().flatten() {
        used[v as usize] = true;
    }
    let mut new_id = Vec::with_capacity(used.len());
    let mut next = 0u32;
    for &u in &used {
        new_id.push(next);
        next += u32::from(u);
    }
    report.isolated_vertices = used.iter().filter(|&&u| !u).count() - report.welded_vertices;
    let mut keep = used.iter();
    mesh.positions.retain(|_| keep.next() == Some(&true));
    for v in mesh.triangles.iter_mut().flatten() {
        *v = new_id[*v as usize];
    }
    (0u32..).zip(used).filter_map(|(v, is_used)| is_used.then_some(v)).collect()
}

fn turn_outward(mesh: &mut TriMesh, report: &mut BodyReport) {
    let oriented = orient::make_consistent(&mut mesh.triangles);
    report.turned_triangles = oriented.turned;
    report.components = oriented.components;
    if mesh.volume() < 0.0 {
        for t in &mut mesh.triangles {
            t.swap(1, 2);
        }
        report.inverted = true;
    }
}

fn count(mesh: &TriMesh, report: &mut BodyReport) {
    let uses = orient::edge_uses(&mesh.triangles);
    let (lower, upper) = mesh.bounds();
    report.vertices = mesh.positions.len();
    report.triangles = mesh.triangles.len();
    report.open_edges = uses.open;
    report.non_manifold_edges = uses.non_manifold;
    report.misoriented_edges = uses.misoriented;
    report.volume = mesh.volume();
    report.size = upper - lower;
    report.lowest = lower.y;
    report.thin_triangles = (0..mesh.triangles.len())
        .filter(|&t| {
            let [a, b, c] = mesh.corners(t);
            (b - a).cross(c - a).length() == 0.0
        })
        .count();
}

fn problem(words: Words) -> Problem {
    Problem { kind: ProblemKind::Body, place: words!("body"), words }
}

fn problems(mesh: &TriMesh, report: &BodyReport) -> Vec<Problem> {
    let mut words = Vec::new();
    if report.triangles == 0 {
        words.push(words!("the body has no triangles"));
    } else if report.size.max_element() == 0.0 {
        words.push(words!("all vertices of the body lie in one place"));
    }
    if report.open_edges > 0 {
        let n = report.open_edges;
        let [low, high] = where_open(mesh).map(|height| decimal(height, 2));
        words.push(words!(
            "the body is open: {n} edges have only one triangle, between {low} m and {high} m of height; inside and outside cannot be told apart. Close the holes",
            n,
            low,
            high
        ));
    }
    if report.non_manifold_edges > 0 {
        let n = report.non_manifold_edges;
        words.push(words!("the body is not manifold: {n} edges have three or more triangles", n));
    }
    if report.misoriented_edges > 0 {
        let n = report.misoriented_edges;
        words
            .push(words!("the body has no outside: at {n} edges its triangles cannot be turned to agree", n));
    }
    if words.is_empty() && report.volume <= 1e-12 * report.size.max_element().powi(3) {
        words.push(words!("the body encloses no volume"));
    }
    words.into_iter().map(problem).collect()
}

/// The range of heights in which border edges are, metres.
fn where_open(mesh: &TriMesh) -> [f64; 2] {
    let heights =
        orient::open_edges(&mesh.triangles).into_iter().flatten().map(|v| mesh.positions[v as usize].y);
    let (low, high) = heights.fold((f64::MAX, f64::MIN), |(lo, hi), y| (lo.min(y), hi.max(y)));
    [low, high]
}

fn notes(report: &BodyReport, unit: Unit) -> Vec<Words> {
    let mut notes = Vec::new();
    let mut tell = |n: usize, words: fn(usize) -> Words| {
        if n > 0 {
            notes.push(words(n));
        }
    };
    tell(report.welded_vertices, |n| {
        words!("{n} vertices lay in the place of another and were joined to it", n)
    });
    tell(report.collapsed_triangles, |n| words!("{n} triangles collapsed by that and were dropped", n));
    tell(report.isolated_vertices, |n| words!("{n} vertices belong to no triangle and were dropped", n));
    tell(report.turned_triangles, |n| {
        words!("{n} triangles looked the other way than their neighbours and were turned", n)
    });
    tell(report.thin_triangles, |n| words!("{n} triangles have no area", n));
    if report.components > 1 {
        tell(report.components, |n| words!("{n} separate parts make up the body", n));
    }
    if report.inverted {
        notes.push(words!("the body was inside out and was turned"));
    }
    notes.extend(unit_note(report.size.y, unit));
    if report.size.z > 1.5 * report.size.y {
        notes.push(words!("the body is longer along z than along y: if it should stand, turn it to y up"));
    }
    notes
}

fn unit_note(height: f64, unit: Unit) -> Option<Words> {
    if USUAL_HEIGHT.contains(&height) {
        return None;
    }
    let told = words!("the body is {height} m high", height = decimal(height, 3));
    Some(match guess_unit(height / unit.metres()) {
        Some(guess) => {
            let metres = height / unit.metres() * guess.metres();
            let guess = guess.to_string();
            let words = words!(
                "in {unit} it would be {metres} m: try --unit {unit}",
                unit = guess,
                metres = decimal(metres, 2)
            );
            told.and("; ", words)
        }
        None => told,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tetrahedron() -> TriMesh {
        TriMesh {
            positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
            triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        }
    }

    fn check(mesh: TriMesh) -> Imported {
        import(mesh, Unit::Metre)
    }

    #[test]
    fn a_good_body_stays_as_it_is() {
        let body = check(tetrahedron());
        assert_eq!(body.mesh, tetrahedron());
        assert!(body.is_usable() && body.notes.is_empty(), "{:?} {:?}", body.problems, body.notes);
        assert!((body.report.volume - 1.0 / 6.0).abs() < 1e-12);
        assert_eq!(body.report.components, 1);
    }

    #[test]
    fn units_become_metres() {
        let mut mesh = tetrahedron();
        for p in &mut mesh.positions {
            *p *= 170.0;
        }
        let right = import(mesh.clone(), Unit::Centimetre);
        assert!((right.report.size.y - 1.7).abs() < 1e-12 && right.notes.is_empty());
        let wrong = import(mesh, Unit::Metre);
        assert!(wrong.notes[0].contains("try --unit cm"), "{:?}", wrong.notes);
    }

    #[test]
    fn an_open_body_is_refused() {
        let mut mesh = tetrahedron();
        mesh.triangles.pop();
        let body = check(mesh);
        assert_eq!(body.report.open_edges, 3);
        assert!(body.problems[0].words.contains("open: 3 edges"), "{:?}", body.problems);
    }

    #[test]
    fn a_body_inside_out_is_turned() {
        let mut mesh = tetrahedron();
        for t in &mut mesh.triangles {
            t.swap(1, 2);
        }
        let body = check(mesh);
        assert!(body.is_usable() && body.report.inverted && body.report.volume > 0.0);
        assert_eq!(body.notes.len(), 1);
    }

    #[test]
    fn one_triangle_the_wrong_way_is_turned() {
        for k in 0..4 {
            let mut mesh = tetrahedron();
            mesh.triangles[k].swap(0, 1);
            let body = check(mesh);
            assert!(body.is_usable() && body.report.turned_triangles > 0, "{k}: {:?}", body.problems);
            assert!(body.report.volume > 0.0);
        }
    }

    #[test]
    fn split_vertices_are_joined() {
        let whole = tetrahedron();
        let split = TriMesh {
            positions: (0..4).flat_map(|t| whole.corners(t)).collect(),
            triangles: (0..4u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect(),
        };
        let body = check(split);
        assert!(body.is_usable(), "{:?}", body.problems);
        assert_eq!((body.report.welded_vertices, body.report.isolated_vertices), (8, 0));
        assert_eq!(body.mesh.positions.len(), 4);
    }

    #[test]
    fn a_fin_is_not_manifold() {
        let mut mesh = tetrahedron();
        mesh.positions.push(DVec3::new(1.0, -1.0, 0.0));
        mesh.triangles.push([0, 1, 4]);
        let body = check(mesh);
        assert_eq!((body.report.non_manifold_edges, body.report.open_edges), (1, 2));
        assert_eq!(body.problems.len(), 2);
    }

    #[test]
    fn isolated_vertices_do_not_count() {
        let mut mesh = tetrahedron();
        mesh.positions.insert(0, DVec3::splat(50.0));
        for v in mesh.triangles.iter_mut().flatten() {
            *v += 1;
        }
        let body = check(mesh);
        assert_eq!(body.mesh, tetrahedron());
        assert_eq!(body.report.isolated_vertices, 1);
    }

    #[test]
    fn a_point_is_no_body() {
        let mut mesh = tetrahedron();
        mesh.positions.fill(DVec3::ONE);
        assert!(!check(mesh).is_usable());
        assert!(!check(TriMesh::default()).is_usable());
    }
}
