//! Cloth against itself: vertices against triangles and edges against edges, kept a thickness apart.
//!
//! Pairs that could meet in a step are gathered when it begins, with the side they are on. A pair keeps its side: whoever comes
//! through in an iterate is pushed back to where it came from, so that a fast step does not tangle.

use std::cmp::Ordering;
use std::sync::Arc;

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use crate::body::closest::{Part, closest_on_triangle};
use crate::cloth::Garment;
use crate::drape::sheet::Sheet;
use crate::geometry::bvh::{Aabb, Bvh};

/// Of the mean edge: nearer than this in the flat cloth is no contact.
const MOST_THICKNESS: f64 = 0.7;

/// What is beside one another in the flat cloth and nearer than this share of the thickness is so by its cut. (Pairs that are
/// pushed by springs and not put in their place leave all that is beside one another alone: bent sharply it would fly apart.)
const HINGED: f64 = 0.5;

/// Of a vertex's expected way that is looked over.
const LOOK_AHEAD: f64 = 1.5;

/// Vertices or edges one thread takes at a time.
const LEAST_SHARE: usize = 256;

/// What may meet in one step, and what does.
#[derive(Clone, Debug, Default)]
pub struct Itself {
    thickness: f64,
    pairs: Vec<Pair>,
    active: Vec<Push>,
    stiffness: Vec<f64>,
    /// What is to be sewn counts as sewn.
    pub sewn: Option<Arc<Sides>>,
    /// So much deeper than it is thick cloth of different layers may come in a small step and still be known to have come
    /// through, metres.
    pub quick: f64,
    /// Vertices that pass through the cloth, as long as they are to be untangled; empty for none.
    pub free: Vec<bool>,
    /// Of each vertex: a higher layer stays on the outer side of a lower one. Empty: there is one.
    pub layers: Vec<u8>,
    /// Of triangles and of edges.
    trees: [Bvh; 2],
    /// Where the vertices were when pairs were last gathered ahead.
    gathered: Vec<DVec3>,
    /// And how far beside the mean of all they were looked ahead for then.
    ahead: Vec<DVec3>,
    /// Pairs looked at since the start.
    pub looked_at: u64,
    /// How often pairs were gathered.
    pub gatherings: u64,
}

/// The sides of seams that are still open.
#[derive(Clone, Debug)]
pub struct Sides {
    /// For each vertex that of `garment` which it will be.
    pub will_be: Vec<u32>,
    /// The garment with its seams shut.
    pub garment: Arc<Garment>,
}

#[derive(Clone, Copy, Debug)]
struct Pair {
    /// A vertex and a triangle's corners, or the ends of two edges.
    vertices: [u32; 4],
    edges: bool,
    /// On which side the first is of the second, ±1; 0 while they are not before one another.
    side: f64,
    /// They are of different layers: the side is known.
    layered: bool,
    /// How far one can come towards the other, metres: who seems farther behind has come round, not through.
    reach: f64,
}

/// Distance as a sum over four vertices: n·Σ w x.
#[derive(Clone, Copy, Debug)]
struct Push {
    vertices: [u32; 4],
    weights: [f64; 4],
    normal: DVec3,
    depth: f64,
    stiffness: f64,
}

impl Itself {
    /// Cloth that keeps `thickness` metres from itself; contact stiffness per vertex, N/m. Thickness zero: it passes through.
    pub fn new(sheet: &Sheet, thickness: f64, stiffness: Vec<f64>) -> Self {
        let thickness = thickness.min(MOST_THICKNESS * sheet.mean_edge());
        Self { thickness, stiffness, ..Self::default() }
    }

    /// The same as [`gather`](Self::gather), with pairs that last until a vertex has left the way expected of it then by `margin`
    /// metres. Does nothing while those from the last time do, also when the vertices have moved by `soon`.
    pub fn gather_ahead(
        &mut self,
        sheet: &Sheet,
        x: &[DVec3],
        ways: &[DVec3],
        soon: impl Fn(usize) -> DVec3,
        margin: f64,
    ) {
        if self.thickness == 0.0 {
            return;
        }
        let lasts = self.gathered.len() == x.len() && {
            let mean = |of: &dyn Fn(usize) -> DVec3| (0..x.len()).map(of).sum::<DVec3>() / x.len() as f64;
            let come = |i: usize| x[i] + soon(i) - self.gathered[i];
            let drift = mean(&come);
            (0..x.len()).all(|i| {
                let (come, ahead) = (come(i) - drift, self.ahead[i]);
                let along = (come.dot(ahead) / ahead.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
                (come - ahead * along).length_squared() < margin * margin
            })
        };
        if !lasts {
            self.gather_pairs(sheet, x, ways, 2.0 * margin, HINGED * self.thickness);
            let drift = ways.iter().sum::<DVec3>() / ways.len() as f64;
            self.gathered.clear();
            self.gathered.extend_from_slice(x);
            self.ahead.clear();
            self.ahead.extend(ways.iter().map(|way| (*way - drift) * LOOK_AHEAD));
        }
    }

    /// Pairs are gathered again next time.
    pub fn forget(&mut self) {
        self.gathered.clear();
    }

    /// Gathers what could meet while the vertices at `x` move about as far as `ways` and `slack` metres more.
    pub fn gather(&mut self, sheet: &Sheet, x: &[DVec3], ways: &[DVec3], slack: f64) {
        self.gather_pairs(sheet, x, ways, slack, f64::INFINITY);
    }

    /// What is beside one another in the flat cloth counts as joined where it is nearer than `hinge` metres.
    fn gather_pairs(&mut self, sheet: &Sheet, x: &[DVec3], ways: &[DVec3], slack: f64, hinge: f64) {
        self.pairs.clear();
        self.active.clear();
        if self.thickness == 0.0 {
            return;
        }
        let drift = ways.iter().sum::<DVec3>() / ways.len() as f64;
        let near = self.thickness + slack;
        let grown = |vs: &[u32]| {
            let now = vs.iter().map(|&v| x[v as usize]);
            let then = vs.iter().map(|&v| x[v as usize] + (ways[v as usize] - drift) * LOOK_AHEAD);
            let points = Aabb::around(&now.chain(then).collect::<Vec<_>>());
            Aabb { lower: points.lower - near / 2.0, upper: points.upper + near / 2.0 }
        };
        // What is joined bends like a hinge and cannot meet; what is beside one another can, where it is not near anyway.
        let (names, adjacency) = match self.sewn.as_deref() {
            None => (None, &sheet.adjacency),
            Some(sides) => (Some(&sides.will_be), &sides.garment.adjacency),
        };
        let name = |v: u32| names.map_or(v, |names| names[v as usize]);
        let joined = |a: &[u32], b: &[u32]| a.iter().any(|&a| b.iter().any(|&b| name(a) == name(b)));
        let hinged = |a: &[u32], b: &[u32], distance: f64| {
            let beside = |a, b| adjacency.vertex_neighbours.of(name(a)).binary_search(&name(b)).is_ok();
            let any = |of: &dyn Fn(u32, u32) -> bool| a.iter().any(|&a| b.iter().any(|&b| of(a, b)));
            // What a seam has yet to bring beside one another must not be kept apart.
            let closes = |a: u32, b: u32| {
                beside(a, b) && sheet.adjacency.vertex_neighbours.of(a).binary_search(&b).is_err()
            };
            any(&beside) && (distance < hinge || (names.is_some() && any(&closes)))
        };
        // Neighbours in the cloth move alike: what counts is how much farther the one goes than the other.
        let apart = |a: &[u32], b: &[u32]| {
            let ways = a.iter().flat_map(|&a| b.iter().map(move |&b| ways[a as usize] - ways[b as usize]));
            near + LOOK_AHEAD * ways.map(|w| w.length()).fold(0.0, f64::max)
        };
        let layer = |vs: &[u32]| self.layers.get(vs[0] as usize).copied().unwrap_or(0);
        let is_free = |a: &[u32], b: &[u32]| {
            let any = |vs: &[u32]| vs.iter().any(|&v| self.free[v as usize]);
            !self.free.is_empty() && layer(a) == layer(b) && (any(a) || any(b))
        };
        let layer = &layer;
        // Of triangle `t`, not of unit length: the way its outer side looks.
        let out = |t: u32| {
            let [a, b, c] = sheet.triangles[t as usize].map(|v| x[v as usize]);
            (b - a).cross(c - a)
        };
        let of_triangles: Vec<Aabb> = sheet.triangles.par_iter().map(|vs| grown(vs)).collect();
        refit(&mut self.trees[0], &of_triangles);
        let tree = &self.trees[0];
        let at_corners = (0..x.len() as u32).into_par_iter().with_min_len(LEAST_SHARE).map(|v| {
            let (mut pairs, mut looked_at) = (Vec::new(), 0u64);
            let own = grown(&[v]);
            tree.near(&own, |t| {
                if !of_triangles[t as usize].meets(&own) {
                    return;
                }
                let vs @ [a, b, c] = sheet.triangles[t as usize];
                looked_at += 1;
                if joined(&[v], &vs) || is_free(&[v], &vs) {
                    return;
                }
                let (p, [pa, pb, pc]) = (x[v as usize], vs.map(|i| x[i as usize]));
                let reach = apart(&[v], &vs);
                let distance = closest_on_triangle(p, pa, pb, pc).0.distance(p);
                if distance <= reach && !hinged(&[v], &vs, distance) {
                    let (own, other) = (layer(&[v]), layer(&vs));
                    let side = match own.cmp(&other) {
                        Ordering::Less => -1.0,
                        Ordering::Equal => out(t).dot(p - pa).signum(),
                        Ordering::Greater => 1.0,
                    };
                    pairs.push(Pair {
                        vertices: [v, a, b, c],
                        edges: false,
                        side,
                        layered: own != other,
                        reach,
                    });
                }
            });
            (pairs, looked_at)
        });
        let mut found: Vec<(Vec<Pair>, u64)> = at_corners.collect();
        let edges = &sheet.adjacency.edges;
        let boxes: Vec<Aabb> = edges.par_iter().map(|e| grown(e)).collect();
        refit(&mut self.trees[1], &boxes);
        let tree = &self.trees[1];
        let at_edges = edges.par_iter().enumerate().with_min_len(LEAST_SHARE).map(|(e, &[a, b])| {
            let (mut pairs, mut looked_at) = (Vec::new(), 0u64);
            tree.near(&boxes[e], |f| {
                if f as usize <= e || !boxes[f as usize].meets(&boxes[e]) {
                    return;
                }
                let [c, d] = edges[f as usize];
                looked_at += 1;
                if joined(&[a, b], &[c, d]) || is_free(&[a, b], &[c, d]) {
                    return;
                }
                let ends = [a, b, c, d].map(|i| x[i as usize]);
                let reach = apart(&[a, b], &[c, d]);
                let distance = segments_apart(ends);
                if distance <= reach && !hinged(&[a, b], &[c, d], distance) {
                    let [pa, pb, pc, pd] = ends;
                    let (own, other) = (layer(&[a, b]), layer(&[c, d]));
                    let outwards = |e: u32| beside_edge(sheet, e).map(out).sum::<DVec3>();
                    let across = (pb - pa).cross(pd - pc);
                    let side = match own.cmp(&other) {
                        Ordering::Less => across.dot(outwards(e as u32)).signum(),
                        Ordering::Equal => across.dot(pc - pa).signum(),
                        Ordering::Greater => -across.dot(outwards(f)).signum(),
                    };
                    pairs.push(Pair {
                        vertices: [a, b, c, d],
                        edges: true,
                        side,
                        layered: own != other,
                        reach,
                    });
                }
            });
            (pairs, looked_at)
        });
        found.par_extend(at_edges);
        self.looked_at += found.iter().map(|(_, looked_at)| looked_at).sum::<u64>();
        self.pairs = found.into_iter().flat_map(|(pairs, _)| pairs).collect();
        self.gatherings += 1;
        // The order of a tree is no order of meaning.
        self.pairs.sort_by_key(|p| (p.edges, p.vertices));
    }

    /// Adds the gradient at `x`, N, and gives the energy, J.
    pub fn add_gradient(&mut self, x: &[DVec3], gradient: &mut [DVec3]) -> f64 {
        self.active.clear();
        let mut energy = 0.0;
        for pair in &self.pairs {
            let found = if pair.edges { edge_push(pair, x) } else { corner_push(pair, x) };
            let Some((weights, normal, distance)) = found else { continue };
            let depth = self.thickness - distance;
            if depth <= 0.0 || distance < -pair.reach {
                continue;
            }
            let share = |(v, w): (&u32, &f64)| w.abs() * self.stiffness[*v as usize];
            let stiffness = pair.vertices.iter().zip(&weights).map(share).sum::<f64>() / 2.0;
            energy += stiffness * depth * depth / 2.0;
            for (&v, w) in pair.vertices.iter().zip(weights) {
                gradient[v as usize] -= normal * (w * depth * stiffness);
            }
            self.active.push(Push { vertices: pair.vertices, weights, normal, depth, stiffness });
        }
        energy
    }

    /// Moves `x` so that no pair is nearer than the thickness, each vertex by its share of `inverse_mass`, pair after pair. Called
    /// every small step, it sees who comes before whom, and on which side.
    pub fn project(&mut self, x: &mut [DVec3], inverse_mass: &[f64]) {
        for pair in &mut self.pairs {
            let turned = Pair { side: if pair.side == 0.0 { 1.0 } else { pair.side }, ..*pair };
            let found = if pair.edges { edge_push(&turned, x) } else { corner_push(&turned, x) };
            let Some((weights, normal, distance)) = found else {
                pair.side = if pair.layered { pair.side } else { 0.0 };
                continue;
            };
            if pair.side == 0.0 {
                pair.side = if distance < 0.0 { -1.0 } else { 1.0 };
                continue;
            }
            let depth = self.thickness - distance;
            let share = |(&v, w): (&u32, &f64)| w * w * inverse_mass[v as usize];
            let whole: f64 = pair.vertices.iter().zip(&weights).map(share).sum();
            let most = 2.0 * self.thickness + if pair.layered { self.quick } else { 0.0 };
            if depth > 0.0 && depth < most && whole > 0.0 {
                for (&v, w) in pair.vertices.iter().zip(weights) {
                    x[v as usize] += normal * (depth * w * inverse_mass[v as usize] / whole);
                }
            }
        }
    }

    /// Blocks on the diagonal that bound the Hessian from above, N/m: those between vertices are left to them, so that the
    /// matrix keeps its pattern.
    pub fn hessian(&self, mut block: impl FnMut(u32, DMat3)) {
        for push in &self.active {
            let n = push.normal;
            let outer = DMat3::from_cols(n * n.x, n * n.y, n * n.z);
            let whole: f64 = push.weights.iter().map(|w| w.abs()).sum();
            for (&v, w) in push.vertices.iter().zip(push.weights) {
                block(v, outer * (push.stiffness * w.abs() * whole));
            }
        }
    }

    /// Whether anything of the cloth pushes vertex by vertex.
    pub fn mark_touching(&self, touching: &mut [bool]) {
        for push in &self.active {
            push.vertices.iter().for_each(|&v| touching[v as usize] = true);
        }
    }

    /// Largest depth into the thickness, metres.
    pub fn deepest(&self) -> f64 {
        self.active.iter().map(|p| p.depth).fold(0.0, f64::max)
    }
}

fn beside_edge(sheet: &Sheet, edge: u32) -> impl Iterator<Item = u32> {
    sheet.adjacency.edge_triangles.of(edge).iter().copied()
}

/// Cloth keeps its neighbours: a tree made once stays a good one.
fn refit(tree: &mut Bvh, boxes: &[Aabb]) {
    match tree.items.len() == boxes.len() {
        true => tree.refit(boxes),
        false => *tree = Bvh::new(boxes),
    }
}

/// Weights, direction and distance of a vertex before a triangle. None beyond its border on the other side.
fn corner_push(pair: &Pair, x: &[DVec3]) -> Option<([f64; 4], DVec3, f64)> {
    let [p, a, b, c] = pair.vertices.map(|v| x[v as usize]);
    let normal = (b - a).cross(c - a).normalize_or_zero() * pair.side;
    let (near, part) = closest_on_triangle(p, a, b, c);
    let signed = normal.dot(p - near);
    if matches!(part, Part::Face) {
        let (u, v) = barycentric(near, a, b, c)?;
        return Some(([1.0, u + v - 1.0, -u, -v], normal, signed));
    }
    if signed < 0.0 {
        return None;
    }
    let way = p - near;
    let distance = way.length();
    let (u, v) = barycentric(near, a, b, c)?;
    (distance > 0.0).then(|| ([1.0, u + v - 1.0, -u, -v], way / distance, distance))
}

fn barycentric(p: DVec3, a: DVec3, b: DVec3, c: DVec3) -> Option<(f64, f64)> {
    let (u, v, w) = (b - a, c - a, p - a);
    let (uu, uv, vv, wu, wv) = (u.dot(u), u.dot(v), v.dot(v), w.dot(u), w.dot(v));
    let whole = uu * vv - uv * uv;
    (whole > 0.0).then(|| ((vv * wu - uv * wv) / whole, (uu * wv - uv * wu) / whole))
}

/// Weights, direction and distance of two edges that cross within their lengths.
fn edge_push(pair: &Pair, x: &[DVec3]) -> Option<([f64; 4], DVec3, f64)> {
    let [a, b, c, d] = pair.vertices.map(|v| x[v as usize]);
    let (u, v, w) = (b - a, d - c, c - a);
    let (uu, uv, vv, uw, vw) = (u.dot(u), u.dot(v), v.dot(v), u.dot(w), v.dot(w));
    let whole = uu * vv - uv * uv;
    // Nearly parallel edges meet at their ends, which the vertices see.
    if whole <= 1e-6 * uu * vv {
        return None;
    }
    let (s, t) = ((vv * uw - uv * vw) / whole, (uv * uw - uu * vw) / whole);
    if !(0.0..=1.0).contains(&s) || !(0.0..=1.0).contains(&t) {
        return None;
    }
    let normal = u.cross(v).normalize_or_zero() * pair.side;
    Some(([s - 1.0, -s, 1.0 - t, t], normal, normal.dot(w)))
}

/// The distance of the segments ab and cd (Ericson, Real-Time Collision Detection, 5.1.9).
fn segments_apart([a, b, c, d]: [DVec3; 4]) -> f64 {
    let (u, v, w) = (b - a, d - c, a - c);
    let (uu, uv, vv, uw, vw) = (u.dot(u), u.dot(v), v.dot(v), u.dot(w), v.dot(w));
    if uu == 0.0 || vv == 0.0 {
        return w.length().min((b - c).length());
    }
    let whole = uu * vv - uv * uv;
    let s = if whole > 1e-12 * uu * vv { ((uv * vw - vv * uw) / whole).clamp(0.0, 1.0) } else { 0.0 };
    let t = ((uv * s + vw) / vv).clamp(0.0, 1.0);
    let s = ((uv * t - uw) / uu).clamp(0.0, 1.0);
    (w + u * s - v * t).length()
}
