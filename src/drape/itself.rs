//! Cloth against itself: vertices against triangles and edges against edges, kept a thickness apart.
//!
//! Pairs that could meet in a step are gathered when it begins, with the side they are on. A pair keeps its side: whoever comes
//! through in an iterate is pushed back to where it came from, so that a fast step does not tangle.

use std::sync::Arc;

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use crate::body::closest::closest_on_triangle;
use crate::cloth::Garment;
use crate::drape::near::Near;
use crate::drape::pair::{Pair, segments_apart};
use crate::drape::sheet::Sheet;
use crate::geometry::bvh::{Aabb, Bvh};

/// Of the mean edge: nearer than this in the flat cloth is no contact.
const MOST_THICKNESS: f64 = 0.7;

/// What is beside one another in the flat cloth and nearer than this share of the thickness is so by its cut. (Pairs that are
/// pushed by springs and not put in their place leave all that is beside one another alone: bent sharply it would fly apart.)
const HINGED: f64 = 0.5;

/// Pairs are gathered ahead for so much unexpected motion, as a share of the thickness, and of what is between that and where cloth
/// that bends comes near its own neighbours, which is half an edge; but no less than for a share of the thickness.
const MARGIN: f64 = 0.5;
const LEAST_MARGIN: f64 = 0.05;

/// In fewer small steps than the shortest stretch has, pairs would not pay for being gathered.
const MOST_STRETCHES: usize = 8;

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
    /// Of triangles, of edges and of vertices.
    trees: [Bvh; 3],
    /// Where the vertices were when pairs were last gathered ahead.
    gathered: Vec<DVec3>,
    /// And how far beside the mean of all they were looked ahead for then.
    ahead: Vec<DVec3>,
    near: Near,
    /// Pairs looked at since the start.
    pub looked_at: u64,
    /// How often pairs were gathered.
    pub gatherings: u64,
    /// How often those that can touch soon were found among them.
    pub siftings: u64,
    /// Pairs looked at in small steps.
    pub pairs_seen: u64,
    /// Pairs gathered that were known not to touch in one.
    pub pairs_skipped: u64,
}

/// The sides of seams that are still open.
#[derive(Clone, Debug)]
pub struct Sides {
    /// For each vertex that of `garment` which it will be.
    pub will_be: Vec<u32>,
    /// The garment with its seams shut.
    pub garment: Arc<Garment>,
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
        if !self.lasts(x, soon, margin) {
            let behind = self.behind(x);
            self.gather_pairs(sheet, x, ways, 2.0 * margin, HINGED * self.thickness);
            self.keep_sides(&behind);
            let drift = ways.iter().sum::<DVec3>() / ways.len() as f64;
            self.gathered.clear();
            self.gathered.extend_from_slice(x);
            self.ahead.clear();
            self.ahead.extend(ways.iter().map(|way| (*way - drift) * LOOK_AHEAD));
        }
    }

    /// Whether the pairs gathered ahead are all that may meet yet: no vertex, at `x` and moved by `soon`, is `margin` metres off the
    /// way expected of it.
    pub fn lasts(&self, x: &[DVec3], soon: impl Fn(usize) -> DVec3, margin: f64) -> bool {
        if self.thickness == 0.0 {
            return true;
        }
        if self.gathered.len() != x.len() {
            return false;
        }
        let come = |i: usize| x[i] + soon(i) - self.gathered[i];
        let drift = (0..x.len()).map(come).sum::<DVec3>() / x.len() as f64;
        (0..x.len()).all(|i| {
            let (come, ahead) = (come(i) - drift, self.ahead[i]);
            let along = (come.dot(ahead) / ahead.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
            (come - ahead * along).length_squared() < margin * margin
        })
    }

    /// Pairs that have come through each other, in their order.
    fn behind(&self, x: &[DVec3]) -> Vec<Pair> {
        let is_behind = |pair: &&Pair| {
            let found = if pair.layered || pair.side == 0.0 { None } else { pair.found(x) };
            found.is_some_and(|(_, _, distance)| {
                distance < 0.0 && distance > -self.thickness - if pair.between { self.quick } else { 0.0 }
            })
        };
        self.near.pairs.iter().map(|&p| &self.pairs[p as usize]).filter(is_behind).copied().collect()
    }

    /// What came through just now goes back to where it came from.
    fn keep_sides(&mut self, behind: &[Pair]) {
        for pair in behind {
            if let Ok(i) = self.pairs.binary_search_by_key(&pair.key(), Pair::key) {
                self.pairs[i].side = pair.side;
            }
        }
    }

    /// A margin that keeps the pairs few, metres.
    pub fn margin(&self, sheet: &Sheet) -> f64 {
        let free = self.thickness.min(sheet.mean_edge() / 2.0 - self.thickness);
        (MARGIN * free).max(LEAST_MARGIN * self.thickness)
    }

    /// Stretches, at least one, that a step of `h` seconds is best cut into, each with pairs of its own: at `velocities` no vertex
    /// goes much more than an edge's length beside the mean in any.
    pub fn stretches(&self, sheet: &Sheet, velocities: &[DVec3], h: f64) -> usize {
        if self.thickness == 0.0 {
            return 1;
        }
        let mean = velocities.iter().sum::<DVec3>() / velocities.len() as f64;
        let fastest = velocities.iter().map(|v| v.distance_squared(mean)).fold(0.0, f64::max).sqrt();
        ((fastest * h / sheet.mean_edge()).ceil() as usize).clamp(1, MOST_STRETCHES)
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
        self.near.forget();
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
            near + LOOK_AHEAD * ways.map(|w| w.length_squared()).fold(0.0, f64::max).sqrt()
        };
        let layer = |vs: &[u32]| self.layers.get(vs[0] as usize).copied().unwrap_or(0);
        let layer = &layer;
        // Of triangle `t`, not of unit length: the way its outer side looks.
        let out = |t: u32| {
            let [a, b, c] = sheet.triangles[t as usize].map(|v| x[v as usize]);
            (b - a).cross(c - a)
        };
        let out_at = |v: u32| sheet.adjacency.vertex_triangles.of(v).iter().map(|&t| out(t)).sum::<DVec3>();
        let out_along = |e: u32| beside_edge(sheet, e).map(out).sum::<DVec3>();
        // A higher layer is outside of what looks the same way as it does. In an armpit, and in folds, it is also before what
        // looks towards it, or away from it: there it stays where it is.
        let is_layered = |a: &[u32], b: &[u32], ways: &dyn Fn() -> [DVec3; 2]| {
            layer(a) != layer(b) && {
                let [a, b] = ways();
                a.dot(b) > 0.0
            }
        };
        let is_free = |a: &[u32], b: &[u32]| {
            let any = |vs: &[u32]| vs.iter().any(|&v| self.free[v as usize]);
            !self.free.is_empty() && (any(a) || any(b))
        };
        let of_triangles: Vec<Aabb> = sheet.triangles.par_iter().map(|vs| grown(vs)).collect();
        refit(&mut self.trees[0], &of_triangles);
        let of_vertices: Vec<Aabb> = (0..x.len() as u32).into_par_iter().map(|v| grown(&[v])).collect();
        refit(&mut self.trees[2], &of_vertices);
        let edges = &sheet.adjacency.edges;
        let boxes: Vec<Aabb> = edges.par_iter().map(|e| grown(e)).collect();
        refit(&mut self.trees[1], &boxes);
        let [triangles, tree, vertices] = &self.trees;
        let leaves: Vec<u32> = vertices.leaves().collect();
        let at_corners = leaves.par_iter().with_min_len(LEAST_SHARE).map(|&leaf| {
            let (mut pairs, mut looked_at) = (Vec::new(), 0u64);
            let mut see = |v: u32, t: u32| {
                let vs @ [a, b, c] = sheet.triangles[t as usize];
                looked_at += 1;
                if joined(&[v], &vs) {
                    return;
                }
                let (p, [pa, pb, pc]) = (x[v as usize], vs.map(|i| x[i as usize]));
                let reach = apart(&[v], &vs);
                let distance = closest_on_triangle(p, pa, pb, pc).0.distance(p);
                if distance <= reach && !hinged(&[v], &vs, distance) {
                    let layered = is_layered(&[v], &vs, &|| [out_at(v), out(t)]);
                    if !layered && is_free(&[v], &vs) {
                        return;
                    }
                    let side = match (layered, layer(&[v]) > layer(&vs)) {
                        (false, _) => out(t).dot(p - pa).signum(),
                        (true, true) => 1.0,
                        (true, false) => -1.0,
                    };
                    pairs.push(Pair {
                        vertices: [v, a, b, c],
                        edges: false,
                        side,
                        layered,
                        between: layer(&[v]) != layer(&vs),
                        reach,
                        near: true,
                    });
                }
            };
            triangles.leaves_near(&vertices.nodes[leaf as usize].bounds, |other| {
                each_that_meets(
                    [vertices, triangles],
                    [&of_vertices, &of_triangles],
                    [leaf, other],
                    &mut see,
                );
            });
            (pairs, looked_at)
        });
        let mut found: Vec<(Vec<Pair>, u64)> = at_corners.collect();
        let nodes = (0..tree.nodes.len() as u32).into_par_iter().with_min_len(LEAST_SHARE);
        let at_edges = nodes.map(|node| {
            let (mut pairs, mut looked_at) = (Vec::new(), 0u64);
            let mut see = |e: u32, f: u32| {
                let [e, f] = [e.min(f), e.max(f)];
                let [[a, b], [c, d]] = [e, f].map(|e| edges[e as usize]);
                looked_at += 1;
                if joined(&[a, b], &[c, d]) {
                    return;
                }
                let ends = [a, b, c, d].map(|i| x[i as usize]);
                let reach = apart(&[a, b], &[c, d]);
                let distance = segments_apart(ends);
                if distance <= reach && !hinged(&[a, b], &[c, d], distance) {
                    let [pa, pb, pc, pd] = ends;
                    let layered = is_layered(&[a, b], &[c, d], &|| [e, f].map(out_along));
                    if !layered && is_free(&[a, b], &[c, d]) {
                        return;
                    }
                    let across = (pb - pa).cross(pd - pc);
                    let side = match (layered, layer(&[a, b]) > layer(&[c, d])) {
                        (false, _) => across.dot(pc - pa).signum(),
                        (true, true) => -across.dot(out_along(f)).signum(),
                        (true, false) => across.dot(out_along(e)).signum(),
                    };
                    pairs.push(Pair {
                        vertices: [a, b, c, d],
                        edges: true,
                        side,
                        layered,
                        between: layer(&[a, b]) != layer(&[c, d]),
                        reach,
                        near: true,
                    });
                }
            };
            tree.leaves_between(node, |one, other| {
                each_that_meets([tree; 2], [&boxes; 2], [one, other], &mut see);
            });
            (pairs, looked_at)
        });
        found.par_extend(at_edges);
        self.looked_at += found.iter().map(|(_, looked_at)| looked_at).sum::<u64>();
        self.pairs = found.into_iter().flat_map(|(pairs, _)| pairs).collect();
        self.gatherings += 1;
        // The order of a tree is no order of meaning.
        self.pairs.sort_by_key(Pair::key);
    }

    /// Adds the gradient at `x`, N, and gives the energy, J.
    pub fn add_gradient(&mut self, x: &[DVec3], gradient: &mut [DVec3]) -> f64 {
        self.active.clear();
        let mut energy = 0.0;
        for pair in &self.pairs {
            let Some((weights, normal, distance)) = pair.found(x) else { continue };
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

    /// Moves `x` so that no pair of one layer is nearer than the thickness, each vertex by its share of `inverse_mass`, pair after
    /// pair. Called every small step, it sees who comes before whom, and on which side.
    pub fn project(&mut self, x: &mut [DVec3], inverse_mass: &[f64]) {
        if self.pairs.len() <= x.len() {
            self.near.all(self.pairs.len());
        } else if !self.near.holds(x) {
            self.find_near(x);
        }
        self.pairs_seen += self.near.pairs.len() as u64;
        self.pairs_skipped += (self.pairs.len() - self.near.pairs.len()) as u64;
        for &p in &self.near.pairs {
            let pair = &mut self.pairs[p as usize];
            if pair.between {
                continue;
            }
            let Some((weights, normal, distance)) = pair.see(x) else { continue };
            let depth = self.thickness - distance;
            let share = |(&v, w): (&u32, &f64)| w * w * inverse_mass[v as usize];
            let whole: f64 = pair.vertices.iter().zip(&weights).map(share).sum();
            if depth > 0.0 && depth < 2.0 * self.thickness && whole > 0.0 {
                for (&v, w) in pair.vertices.iter().zip(weights) {
                    x[v as usize] += normal * (depth * w * inverse_mass[v as usize] / whole);
                }
            }
        }
    }

    /// The same, after it, of what is of different layers: of the lower one, what the body `carries` does not give way. Otherwise
    /// what is pulled tight over it would sink into it, by what each small step pulls. Depth that was there `before` leaves by
    /// `ease` metres at most, and without momentum. Whether anything moved.
    pub fn project_layers(
        &mut self,
        (x, before): (&mut [DVec3], &mut [DVec3]),
        inverse_mass: &[f64],
        carries: impl Fn(usize, DVec3) -> bool,
        ease: f64,
    ) -> bool {
        if self.layers.is_empty() {
            return false;
        }
        let mut moved = false;
        for &p in &self.near.pairs {
            let pair = &mut self.pairs[p as usize];
            if !pair.between {
                continue;
            }
            let Some((weights, normal, distance)) = pair.see(x) else { continue };
            let depth = self.thickness - distance;
            if depth <= 0.0 || depth >= 2.0 * self.thickness + self.quick {
                continue;
            }
            let layer = |v: u32| self.layers[v as usize];
            let upper = pair.vertices.map(layer).into_iter().max();
            let inverse = pair.vertices.map(|v| {
                let is_fixed = Some(layer(v)) < upper && carries(v as usize, x[v as usize]);
                if is_fixed { 0.0 } else { inverse_mass[v as usize] }
            });
            let whole: f64 = weights.iter().zip(&inverse).map(|(w, inverse)| w * w * inverse).sum();
            if whole == 0.0 {
                continue;
            }
            let way = |v: &u32, w: f64| normal.dot(x[*v as usize] - before[*v as usize]) * w;
            let come = -pair.vertices.iter().zip(weights).map(|(v, w)| way(v, w)).sum::<f64>();
            let now = come.clamp(0.0, depth);
            let eased = (depth - now).min(ease);
            for ((&v, w), inverse) in pair.vertices.iter().zip(weights).zip(inverse) {
                let share = normal * (w * inverse / whole);
                x[v as usize] += share * (now + eased);
                before[v as usize] += share * eased;
            }
            moved = true;
        }
        moved
    }

    /// Finds the pairs that can come within the thickness while each vertex at `x` keeps to its room. The others know their side
    /// from here.
    fn find_near(&mut self, x: &[DVec3]) {
        self.near.begin(x, self.thickness);
        let (room, thickness) = (&self.near.room, self.thickness);
        self.pairs.par_iter_mut().with_min_len(LEAST_SHARE).for_each(|pair| {
            let reach = |vs: &[u32]| vs.iter().map(|&v| room[v as usize]).fold(0.0, f64::max);
            let reach = thickness + pair.elements().map(reach).iter().sum::<f64>();
            let was_near = std::mem::take(&mut pair.near);
            if was_near && !pair.layered && pair.see(x).is_some_and(|(_, _, signed)| signed < 0.0) {
                pair.near = true;
                return;
            }
            if pair.at_least_apart(x) >= reach {
                return;
            }
            let distance = pair.distance(x);
            pair.near = distance < reach;
            if pair.near && !was_near && !pair.layered && distance >= thickness {
                pair.side = 0.0;
                pair.see(x);
            }
        });
        let near = |(i, pair): (usize, &Pair)| pair.near.then_some(i as u32);
        self.near.pairs.clear();
        self.near.pairs.extend(self.pairs.iter().enumerate().filter_map(near));
        self.siftings += 1;
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

/// Calls `found` for every two items whose `boxes` meet, one of a leaf of the one tree and one of the other's; of one leaf alone
/// for every two of it once.
fn each_that_meets(trees: [&Bvh; 2], boxes: [&[Aabb]; 2], leaves: [u32; 2], mut found: impl FnMut(u32, u32)) {
    let [ones, others] = [0, 1].map(|k| trees[k].items_of(leaves[k]));
    let bounds = &trees[1].nodes[leaves[1] as usize].bounds;
    let alone = std::ptr::eq(ones, others);
    for (k, &i) in ones.iter().enumerate() {
        let own = &boxes[0][i as usize];
        if own.meets(bounds) {
            let others = if alone { &others[k + 1..] } else { others };
            others.iter().filter(|&&j| boxes[1][j as usize].meets(own)).for_each(|&j| found(i, j));
        }
    }
}

/// Cloth keeps its neighbours: a tree made once stays a good one.
fn refit(tree: &mut Bvh, boxes: &[Aabb]) {
    match tree.items.len() == boxes.len() {
        true => tree.refit(boxes),
        false => *tree = Bvh::new(boxes),
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;

    /// A square metre rolled up and shaken: its vertices at `seconds`.
    fn shaken(sheet: &Sheet, seconds: f64) -> Vec<DVec3> {
        let place = |p: &DVec2| {
            let (turn, radius) = (9.0 * p.x, 0.04 + 0.01 * p.x + 0.004 * (11.0 * seconds).sin());
            let sway = 0.01 * (7.0 * seconds + 23.0 * p.y + 5.0 * p.x).sin();
            DVec3::new(radius * turn.cos() + sway, p.y, radius * turn.sin() + seconds * seconds)
        };
        (0..=20u32)
            .flat_map(|j| (0..=20u32).map(move |i| DVec2::new(f64::from(i), f64::from(j)) / 20.0))
            .take(sheet.vertex_area.len())
            .map(|p| place(&p))
            .collect()
    }

    fn sheet() -> Sheet {
        let corner = |i: u32, j: u32| j * 21 + i;
        let squares = (0..20u32).flat_map(|j| (0..20u32).map(move |i| (i, j)));
        let triangles = squares.flat_map(|(i, j)| {
            let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            [[a, b, c], [a, c, d]]
        });
        let triangles: Vec<[u32; 3]> = triangles.collect();
        let flat = |v: u32| DVec2::new(f64::from(v % 21), f64::from(v / 21)) / 20.0;
        let rest = triangles.iter().map(|vs| vs.map(flat)).collect();
        Sheet::new(21 * 21, triangles, rest).expect("a sheet")
    }

    /// A square of the lower layer, its outer side up, and half a millimetre above it one of the upper layer.
    fn stacked(upper_looks_down: bool) -> (Itself, Sheet, Vec<DVec3>) {
        let flat = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].map(|p| p * 0.02);
        let square = |first: u32| [[0, 1, 2], [0, 2, 3]].map(|t: [u32; 3]| t.map(|k| first + k));
        let mut triangles = square(0).to_vec();
        triangles.extend(square(4).map(|[a, b, c]| if upper_looks_down { [a, c, b] } else { [a, b, c] }));
        let rest = triangles.iter().map(|vs| vs.map(|v| flat[v as usize % 4])).collect();
        let sheet = Sheet::new(8, triangles, rest).expect("a sheet");
        let mut itself = Itself::new(&sheet, 1e-3, Vec::new());
        itself.layers = [[0; 4], [1; 4]].concat();
        let at = |z: f64| flat.map(|p| p.extend(z));
        let x = [at(0.0), at(5e-4)].concat();
        itself.gather_ahead(&sheet, &x, &[DVec3::ZERO; 8], |_| DVec3::ZERO, 1e-3);
        (itself, sheet, x)
    }

    fn heights(x: &[DVec3]) -> [f64; 2] {
        [0, 4].map(|first| x[first..first + 4].iter().map(|p| p.z).sum::<f64>() / 4.0)
    }

    #[test]
    fn layers_that_look_at_each_other_stay_before_each_other() {
        for looks_down in [false, true] {
            let (mut itself, _, mut x) = stacked(looks_down);
            for _ in 0..20 {
                let mut before = x.clone();
                itself.project(&mut x, &[1.0; 8]);
                itself.project_layers((&mut x, &mut before), &[1.0; 8], |_, _| false, 1e-4);
            }
            let [lower, upper] = heights(&x);
            assert!((upper - lower - 1e-3).abs() < 1e-5, "{lower} {upper}, looks down: {looks_down}");
        }
    }

    #[test]
    fn what_the_body_carries_does_not_give_way_to_what_lies_on_it() {
        let (mut itself, _, mut x) = stacked(false);
        let lower = x[..4].to_vec();
        for _ in 0..40 {
            let mut before = x.clone();
            itself.project(&mut x, &[1.0; 8]);
            itself.project_layers((&mut x, &mut before), &[1.0; 8], |v, _| v < 4, 1e-4);
            // What was too deep before leaves slowly, and gains no speed.
            assert!(x.iter().zip(&before).all(|(now, before)| now.distance(*before) < 1e-12));
        }
        assert_eq!(x[..4], lower);
        assert!((heights(&x)[1] - 1e-3).abs() < 1e-5, "{:?}", heights(&x));
    }

    #[test]
    fn pairs_left_out_of_small_steps_do_not_touch_in_them() {
        let sheet = sheet();
        let mut itself = Itself::new(&sheet, 0.012, vec![1.0; 21 * 21]);
        let start = shaken(&sheet, 0.0);
        itself.gather(&sheet, &start, &vec![DVec3::ZERO; start.len()], 0.03);
        assert!(itself.pairs.len() > start.len(), "so few that all are looked at");
        let mut left_out = 0;
        for step in 1..400 {
            let mut x = shaken(&sheet, f64::from(step) * 5e-4);
            // Nothing moves: what is looked for is only who is looked at.
            itself.project(&mut x, &vec![0.0; start.len()]);
            for pair in itself.pairs.iter().filter(|pair| !pair.near) {
                left_out += 1;
                assert!(pair.distance(&x) >= itself.thickness, "{pair:?} in step {step}");
            }
        }
        assert!(itself.siftings > 5 && left_out > 0 && itself.pairs_skipped > itself.pairs_seen);
    }

    #[test]
    fn pairs_gathered_ahead_are_all_that_touch_while_they_last() {
        let (sheet, margin, ahead) = (sheet(), 0.002, 0.01);
        let mut itself = Itself::new(&sheet, 0.012, vec![1.0; 21 * 21]);
        let mut now = Itself::new(&sheet, 0.012, vec![1.0; 21 * 21]);
        let mut touching = 0;
        for step in 0..120 {
            let seconds = f64::from(step) * 1e-3;
            let [before, x, then] = [-1e-3, 0.0, 1e-3].map(|more| shaken(&sheet, seconds + more));
            let ways: Vec<DVec3> =
                before.iter().zip(&then).map(|(b, t)| (*t - *b) * (ahead / 2e-3)).collect();
            itself.gather_ahead(&sheet, &x, &ways, |_| DVec3::ZERO, margin);
            now.gather_pairs(&sheet, &x, &vec![DVec3::ZERO; x.len()], 0.0, HINGED * now.thickness);
            for pair in now.pairs.iter().filter(|pair| pair.distance(&x) < now.thickness) {
                touching += 1;
                let known = itself.pairs.binary_search_by_key(&pair.key(), Pair::key);
                assert!(known.is_ok(), "{pair:?} in step {step}");
            }
        }
        let gathered = itself.gatherings;
        assert!(touching > 1000 && (2..100).contains(&gathered), "{touching} {gathered}");
    }
}
