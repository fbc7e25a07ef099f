//! Planes against the plainest contact that cannot cross: a vertex goes no farther than a share of the way to what is nearest to it
//! or to its edges and triangles, found by trying every pair (Offset Geometric Contact's isotropic bound).

use glam::{DVec2, DVec3};
use toile::contact::Separation;
use toile::geometry::adjacency::Adjacency;

use super::crossings::through;
use super::meshes::{Kind, flat};

/// Of the way to what is nearest.
const BOUND: f64 = 0.45;
/// Steps between detections.
const EVERY: usize = 5;
const STEPS: usize = 4000;
/// Sheets push each other away from here on, metres.
const THICK: f64 = 0.004;

/// A point of a triangle or segment, as shares of its corners.
type Shares = [f64; 3];

fn at(corners: [DVec3; 3], shares: Shares) -> DVec3 {
    corners.iter().zip(shares).map(|(p, s)| *p * s).sum()
}

/// The point of a triangle that is nearest to `p`.
fn nearest_on_triangle(p: DVec3, corners: [DVec3; 3]) -> Shares {
    let [a, b, c] = corners;
    let normal = (b - a).cross(c - a);
    let share = |q: DVec3, r: DVec3| (q - p).cross(r - p).dot(normal) / normal.length_squared();
    let inner = [share(b, c), share(c, a), share(a, b)];
    if inner.iter().all(|s| *s >= 0.0) {
        return inner;
    }
    let on_side = |k: usize| {
        let (from, to) = (corners[k], corners[(k + 1) % 3]);
        let along = ((p - from).dot(to - from) / (to - from).length_squared()).clamp(0.0, 1.0);
        let mut shares = [0.0; 3];
        (shares[k], shares[(k + 1) % 3]) = (1.0 - along, along);
        shares
    };
    let far = |shares: &Shares| at(corners, *shares).distance_squared(p);
    (0..3).map(on_side).min_by(|s, t| far(s).total_cmp(&far(t))).expect("three sides")
}

/// How far two segments are apart: from an end to the other, or between the lines where that is between the ends.
fn segments_apart([a, b]: [DVec3; 2], [c, d]: [DVec3; 2]) -> f64 {
    let from_end = |p: DVec3, [q, r]: [DVec3; 2]| {
        let along = ((p - q).dot(r - q) / (r - q).length_squared()).clamp(0.0, 1.0);
        p.distance(q.lerp(r, along))
    };
    let ends = [from_end(a, [c, d]), from_end(b, [c, d]), from_end(c, [a, b]), from_end(d, [a, b])];
    let least = ends.into_iter().fold(f64::MAX, f64::min);
    let (u, v, w) = (b - a, d - c, a - c);
    let across = u.cross(v);
    let area = across.length_squared();
    let (s, t) = (v.cross(w).dot(across) / area, u.cross(w).dot(across) / area);
    let is_between = area > 1e-18 && (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&t);
    if is_between { least.min(w.dot(across).abs() / area.sqrt()) } else { least }
}

/// Two sheets, one held at its rim and one free over it.
struct Sheets {
    triangles: Vec<[u32; 3]>,
    adjacency: Adjacency,
    rest: Vec<f64>,
    start: Vec<DVec3>,
    is_held: Vec<bool>,
    /// Triangles and vertices of the lower one.
    lower: [usize; 2],
}

impl Sheets {
    fn new() -> Self {
        let (wide, narrow) = (0.2, 0.15);
        let below = flat(Kind::Jittered, DVec2::splat(wide), [6, 6]);
        let above = flat(Kind::Alternating, DVec2::splat(narrow), [5, 5]);
        let first = below.points.len() as u32;
        let mut triangles = below.triangles.clone();
        triangles.extend(above.triangles.iter().map(|vs| vs.map(|v| v + first)));
        let place = |p: &DVec2, size: f64, y: f64| DVec3::new(p.x - size / 2.0, y, p.y - size / 2.0);
        let mut start: Vec<DVec3> = below.points.iter().map(|p| place(p, wide, 0.0)).collect();
        start.extend(above.points.iter().map(|p| place(p, narrow, 0.006)));
        let rim = |p: &DVec2| [p.x, p.y, wide - p.x, wide - p.y].iter().any(|d| *d < 1e-9);
        let is_held = (0..start.len()).map(|v| below.points.get(v).is_some_and(rim)).collect();
        let adjacency = Adjacency::new(start.len(), &triangles);
        let rest =
            adjacency.edges.iter().map(|e| start[e[0] as usize].distance(start[e[1] as usize])).collect();
        let lower = [below.triangles.len(), first as usize];
        Self { triangles, adjacency, rest, start, is_held, lower }
    }

    fn corners(&self, x: &[DVec3], t: usize) -> [DVec3; 3] {
        self.triangles[t].map(|v| x[v as usize])
    }

    /// Springs along the edges, weight, and what pushes the sheets apart.
    fn forces(&self, x: &[DVec3]) -> Vec<DVec3> {
        let (stiff, push) = (1.0, 0.5);
        let mut forces = vec![DVec3::NEG_Y * 2e-5; x.len()];
        // What lies free has one place to rest in.
        for v in self.lower[1]..x.len() {
            forces[v] += (self.start[v] - x[v]).with_y(0.0) * 1e-3;
        }
        for (&[a, b], rest) in self.adjacency.edges.iter().zip(&self.rest) {
            let way = x[b as usize] - x[a as usize];
            let pull = way.normalize() * (stiff * (way.length() - rest));
            forces[a as usize] += pull;
            forces[b as usize] -= pull;
        }
        let [parted, first] = self.lower;
        let both = [(0..first, parted..self.triangles.len()), (first..x.len(), 0..parted)];
        for (v, t) in
            both.into_iter().flat_map(|(vs, ts)| vs.flat_map(move |v| ts.clone().map(move |t| (v, t))))
        {
            let corners = self.corners(x, t);
            if (corners[0] - x[v]).abs().max_element() > 0.05 {
                continue;
            }
            let shares = nearest_on_triangle(x[v], corners);
            let way = x[v] - at(corners, shares);
            let force = way.normalize() * (push * (THICK - way.length()).max(0.0));
            forces[v] += force;
            self.triangles[t].iter().zip(shares).for_each(|(w, s)| forces[*w as usize] -= force * s);
        }
        forces
    }

    /// How far each vertex may go before something could meet.
    fn bounds(&self, x: &[DVec3]) -> Vec<f64> {
        let mut bounds = vec![f64::MAX; x.len()];
        let mut bound = |vertices: &[u32], far: f64| {
            vertices.iter().for_each(|&v| bounds[v as usize] = bounds[v as usize].min(BOUND * far));
        };
        for (t, vs) in self.triangles.iter().enumerate() {
            for v in (0..x.len() as u32).filter(|v| !vs.contains(v)) {
                let corners = self.corners(x, t);
                let far = at(corners, nearest_on_triangle(x[v as usize], corners)).distance(x[v as usize]);
                bound(&[v], far);
                bound(vs, far);
            }
        }
        let edges = &self.adjacency.edges;
        for (k, e) in edges.iter().enumerate() {
            for f in edges[k + 1..].iter().filter(|f| !e.iter().any(|v| f.contains(v))) {
                let far = segments_apart(e.map(|v| x[v as usize]), f.map(|v| x[v as usize]));
                bound(e, far);
                bound(f, far);
            }
        }
        bounds
    }

    /// Goes downhill to rest; `detect` is told where all are every few steps, `truncate` brings back what went too far since.
    fn to_rest<T>(
        &self,
        contact: &mut T,
        detect: impl Fn(&mut T, &[DVec3]),
        truncate: impl Fn(&mut T, &mut [DVec3]),
    ) -> Vec<DVec3> {
        let (mut x, mut before) = (self.start.clone(), self.start.clone());
        // The upper one is thrown at the lower one.
        before[self.lower[1]..].iter_mut().for_each(|p| p.y += 0.02);
        for step in 0..STEPS {
            if step % EVERY == 0 {
                detect(contact, &x);
            }
            let forces = self.forces(&x);
            let mut next: Vec<DVec3> =
                (0..x.len())
                    .map(|v| {
                        if self.is_held[v] {
                            x[v]
                        } else {
                            x[v] + (x[v] - before[v]) * 0.97 + forces[v] * 0.05
                        }
                    })
                    .collect();
            truncate(contact, &mut next);
            before = std::mem::replace(&mut x, next);
            if step % EVERY == 0 {
                let count = through((&x, &self.adjacency.edges), (&x, &self.triangles), true);
                assert_eq!(count, 0, "step {step}: edges through triangles");
            }
        }
        let still = x.iter().zip(&before).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        assert!(still < 1e-6, "it still moves: {still} m a step");
        x
    }
}

#[test]
fn planes_come_to_rest_where_the_isotropic_bound_does() {
    let sheets = Sheets::new();
    let mut bound = (Vec::new(), Vec::new());
    let plain = sheets.to_rest(
        &mut bound,
        |(anchors, bounds), x| (*anchors, *bounds) = (x.to_vec(), sheets.bounds(x)),
        |(anchors, bounds), x| {
            for ((x, anchor), bound) in x.iter_mut().zip(anchors).zip(bounds) {
                let way = *x - *anchor;
                *x = *anchor + way * (*bound / way.length().max(f64::MIN_POSITIVE)).min(1.0);
            }
        },
    );
    let (triangles, adjacency) = (&sheets.triangles, &sheets.adjacency);
    let mut planes = Separation::new(triangles, adjacency, (&sheets.rest, 0.0), None, None);
    let fast = sheets.to_rest(
        &mut planes,
        |planes, x| planes.detect(x, |_| 0.01, |_| false),
        |planes, x| _ = planes.truncate(x),
    );
    assert!(planes.counters.truncated_vertices > 0, "planes are met on the way");
    let sag = plain.iter().map(|p| p.y).fold(f64::MAX, f64::min);
    assert!(sag < -0.005, "it hangs by {sag} m");
    let apart = plain.iter().zip(&fast).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
    assert!(apart < 1e-5, "{apart} m apart at rest");
}
