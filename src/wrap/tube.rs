//! Tubes round limbs: where the cloth of a sleeve or leg goes that grows from a seam round its limb.
//!
//! Cloth that grows as a flat flap only comes to be round a limb if its flaps meet behind it. Here a tube is laid round from the
//! start: each of its vertices has an angle round the limb, which goes once round along the seam and is as even as can be beyond it
//! (a harmonic function on the tube, with a jump of a whole turn at a cut from the seam to the far border).

use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec2, DVec3};

use crate::body::Surface;
use crate::body::measure::section;
use crate::cloth::{ClothState, Garment};
use crate::geometry::conjugate_gradients;
use crate::geometry::polygon::{centroid, contains};

/// What a tube is, in shares. Chosen by trial; they leave out what hangs round both legs, and hoods.
const SHAPE: Shape = Shape { within: 0.75, even: 0.5 };

struct Shape {
    /// Least share of its length along which the axis is within the body: a sleeve may be somewhat longer than its arm.
    within: f64,
    /// Least distance of its end from the ring, as a share of the greatest.
    even: f64,
}

/// Triangles, not laid yet, that continue laid cloth beyond a closed seam, the ring, and end at one other border.
pub(super) struct Tube<'a> {
    garment: &'a Garment,
    triangles: Vec<u32>,
    /// For each edge of a triangle, in its direction, that triangle and its third corner.
    beside: BTreeMap<[u32; 2], (u32, u32)>,
    /// The ring's vertices in order, with the tube on their left.
    ring: Vec<u32>,
    /// The vertices of the other border.
    end: BTreeSet<u32>,
}

/// A point on the axis of a limb.
#[derive(Clone, Copy, Debug)]
struct Axis {
    at: DVec3,
    /// Direction of growth, a unit vector away from the trunk.
    along: DVec3,
}

/// Angle round the limb and distance along it of a vertex.
struct Place {
    /// Angle, radians, and distance along the axis, metres.
    at: DVec2,
    /// Radius at which the cloth would not be stretched, metres.
    radius: f64,
}

impl<'a> Tube<'a> {
    /// The tube of `triangles`, whose border to laid cloth is `ring`: the edges with the tube on their left. None unless it is one: with
    /// two borders, of which the ring is one.
    pub fn new(garment: &'a Garment, triangles: Vec<u32>, ring: &[[u32; 2]]) -> Option<Self> {
        let mut beside = BTreeMap::new();
        for &t in &triangles {
            let vs = garment.triangles[t as usize];
            for k in 0..3 {
                let edge = [vs[k], vs[(k + 1) % 3]];
                if beside.insert(edge, (t, vs[(k + 2) % 3])).is_some() {
                    return None;
                }
            }
        }
        let border: Vec<[u32; 2]> =
            beside.keys().copied().filter(|&[a, b]| !beside.contains_key(&[b, a])).collect();
        let edges = (beside.len() + border.len()) / 2;
        let vertices: BTreeSet<u32> = beside.keys().map(|edge| edge[0]).collect();
        let ring = in_order(ring)?;
        let end = border.into_iter().flatten().filter(|v| !ring.contains(v)).collect();
        let is_annulus = vertices.len() + triangles.len() == edges;
        let tube = Self { garment, triangles, beside, ring, end };
        (is_annulus && tube.ring.iter().all(|v| vertices.contains(v))).then_some(tube)
    }

    /// The axis of the limb that the ring goes round: the middle of that section of the body which lies within the ring as seen along it,
    /// near the ring or up to its own width beyond, in steps of `step` metres, where the limb has left the trunk.
    fn axis(&self, surface: &Surface, state: &ClothState, step: f64) -> Option<Axis> {
        let ring: Vec<DVec3> = self.ring.iter().map(|&v| state.positions[v as usize]).collect();
        let centre = ring.iter().sum::<DVec3>() / ring.len() as f64;
        let next = ring.iter().cycle().skip(1);
        let along = ring.iter().zip(next).map(|(a, b)| (*a - centre).cross(*b - centre)).sum::<DVec3>();
        let along = along.try_normalize()?;
        let (x, y) = along.any_orthonormal_pair();
        let flat = |p: &DVec3| DVec2::new((*p - centre).dot(x), (*p - centre).dot(y));
        let outline: Vec<DVec2> = ring.iter().map(flat).collect();
        let width = outline.iter().map(|p| p.length()).sum::<f64>() / outline.len() as f64;
        let middles = |at: DVec3| -> Vec<DVec2> {
            let sections = section(&surface.mesh, at, along);
            let middle = |points: &Vec<DVec3>| centroid(&points.iter().map(flat).collect::<Vec<_>>());
            sections.iter().filter_map(middle).filter(|&middle| contains(&outline, middle)).collect()
        };
        let planes = (0..=(width / step) as u32).map(|k| centre + along * (step * f64::from(k)));
        let (at, middles) = planes.map(|at| (at, middles(at))).find(|(_, middles)| !middles.is_empty())?;
        // A ring round both legs goes round no limb.
        let [middle] = middles[..] else { return None };
        Some(Axis { at: at + x * middle.x + y * middle.y, along })
    }

    /// The place of each vertex that is not laid yet, metres; `distance` from the ring for each vertex of the garment, metres. At least
    /// `offset` metres off the skin. None where the ring does not go round a limb.
    pub fn places(
        &self,
        surface: &Surface,
        state: &ClothState,
        distance: &[f64],
        offset: f64,
    ) -> Option<BTreeMap<u32, DVec3>> {
        let step = self.garment.mean_edge();
        let axis = self.axis(surface, state, step)?;
        let (x, y) = axis.along.any_orthonormal_pair();
        let flat = |v: u32| {
            let p = state.positions[v as usize] - axis.at;
            (DVec2::new(p.dot(x), p.dot(y)), p.dot(axis.along))
        };
        let ends = || self.end.iter().map(|&v| distance[v as usize]);
        if ends().fold(f64::INFINITY, f64::min) < SHAPE.even * ends().fold(0.0, f64::max) {
            return None;
        }
        let path = self.path()?;
        let start = self.ring.iter().position(|&v| v == path[0])?;
        let ring: Vec<u32> = self.ring[start..].iter().chain(&self.ring[..=start]).copied().collect();
        let mut angle = flat(ring[0]).0.to_angle();
        let mut held = BTreeMap::new();
        held.insert(ring[0], DVec2::new(angle, flat(ring[0]).1));
        for pair in ring.windows(2) {
            angle += flat(pair[0]).0.angle_to(flat(pair[1]).0);
            held.entry(pair[1]).or_insert(DVec2::new(angle, flat(pair[1]).1));
        }
        let turn = angle - held[&ring[0]].x;
        if turn.abs() < PI || turn.abs() > TAU + PI {
            return None;
        }
        let mean = ring.iter().map(|&v| flat(v).0.length()).sum::<f64>() / ring.len() as f64;
        let spread = self.spread(&held, &self.left_of(&path), turn);
        let along = |v: &u32, place: &Place| place.at.y + distance[*v as usize];
        // Slivers, or cloth that does not hang together with the ring.
        if !spread.iter().all(|(v, place)| place.at.is_finite() && along(v, place).is_finite()) {
            return None;
        }
        let most = spread.iter().map(|(v, place)| along(v, place)).fold(0.0, f64::max);
        let frames = frames(surface, axis, x, step, most);
        let within = frames.iter().filter(|frame| surface.contains(frame.0)).count();
        if (within as f64) < SHAPE.within * frames.len() as f64 {
            return None;
        }
        let place = |(v, place): (&u32, &Place)| {
            let (centre, [x, y]) = frame_at(&frames, axis, along(v, place) / step, step);
            let out = x * place.at.x.cos() + y * place.at.x.sin();
            (*v, outside(surface, centre, out, [place.radius, mean], offset))
        };
        Some(spread.iter().map(place).collect())
    }

    /// The shortest way from the ring to the other border.
    fn path(&self) -> Option<Vec<u32>> {
        let ring: BTreeSet<u32> = self.ring.iter().copied().collect();
        let mut around: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
        for &[a, b] in self.beside.keys() {
            around.entry(a).or_default().push(b);
            if !self.beside.contains_key(&[b, a]) {
                around.entry(b).or_default().push(a);
            }
        }
        let mut from: BTreeMap<u32, u32> = ring.iter().map(|&v| (v, v)).collect();
        let mut queue: VecDeque<u32> = ring.iter().copied().collect();
        while let Some(v) = queue.pop_front() {
            if self.end.contains(&v) {
                let mut path = vec![v];
                while !ring.contains(&path[path.len() - 1]) {
                    path.push(from[&path[path.len() - 1]]);
                }
                path.reverse();
                return Some(path);
            }
            for &next in &around[&v] {
                from.entry(next).or_insert_with(|| {
                    queue.push_back(next);
                    v
                });
            }
        }
        None
    }

    /// The corners of triangles, each as its triangle and vertex, that touch `path` from the left.
    fn left_of(&self, path: &[u32]) -> BTreeSet<(u32, u32)> {
        let mut left = BTreeSet::new();
        for (i, &v) in path.iter().enumerate() {
            let before = i.checked_sub(1).map(|i| path[i]);
            if let Some(&after) = path.get(i + 1) {
                let mut next = after;
                while let Some(&(t, third)) = self.beside.get(&[v, next]) {
                    left.insert((t, v));
                    next = third;
                    if before == Some(third) {
                        break;
                    }
                }
            } else if let Some(mut next) = before {
                while let Some(&(t, third)) = self.beside.get(&[next, v]) {
                    left.insert((t, v));
                    next = third;
                }
            }
        }
        left
    }

    /// Angle and distance along the axis beyond the ring's, `held`, at each vertex that is not on the ring: harmonic functions on the flat
    /// cloth (finite elements, linear on each triangle). At the corners `left` the angle is greater by `turn`.
    fn spread(
        &self,
        held: &BTreeMap<u32, DVec2>,
        left: &BTreeSet<(u32, u32)>,
        turn: f64,
    ) -> BTreeMap<u32, Place> {
        let extra = |t: u32, v: u32| if left.contains(&(t, v)) { turn } else { 0.0 };
        let vertices: BTreeSet<u32> = self.beside.keys().map(|edge| edge[0]).collect();
        let free: Vec<u32> = vertices.into_iter().filter(|v| !held.contains_key(v)).collect();
        let index: BTreeMap<u32, usize> = free.iter().zip(0..).map(|(&v, i)| (v, i)).collect();
        let mut near: Vec<Vec<(usize, f64)>> = vec![Vec::new(); free.len()];
        let mut sums = vec![0.0; free.len()];
        let mut right = vec![DVec3::ZERO; free.len()];
        for (t, vs) in self.triangles.iter().map(|&t| (t, self.garment.triangles[t as usize])) {
            let rest = &self.garment.rest[t as usize];
            for k in 0..3 {
                let (a, b) = (vs[k], vs[(k + 1) % 3]);
                let [u, w] = [k, (k + 1) % 3].map(|end| rest[end] - rest[(k + 2) % 3]);
                let weight = u.dot(w) / u.perp_dot(w).abs();
                for (v, other) in [(a, b), (b, a)] {
                    let Some(&i) = index.get(&v).filter(|_| weight.is_finite()) else { continue };
                    sums[i] += weight;
                    right[i].x += weight * (extra(t, other) - extra(t, v));
                    match held.get(&other) {
                        Some(at) => right[i] += at.extend(0.0) * weight,
                        None => near[i].push((index[&other], weight)),
                    }
                }
            }
        }
        let times = |x: &[DVec3], y: &mut [DVec3]| {
            for (i, y) in y.iter_mut().enumerate() {
                *y = x[i] * sums[i] - near[i].iter().map(|&(j, weight)| x[j] * weight).sum::<DVec3>();
            }
        };
        let inverses: Vec<DMat3> =
            sums.iter().map(|sum| DMat3::from_diagonal(DVec3::splat(1.0 / sum))).collect();
        let solved = conjugate_gradients::solve(times, &inverses, right, free.len(), f64::EPSILON.sqrt());
        let mut slopes = vec![DVec2::ZERO; free.len()];
        for &t in &self.triangles {
            let vs = self.garment.triangles[t as usize];
            let angle = |v: u32| extra(t, v) + index.get(&v).map_or_else(|| held[&v].x, |&i| solved[i].x);
            let [a, b, c] = self.garment.rest[t as usize];
            let (u, w, area) = (b - a, c - a, (b - a).perp_dot(c - a));
            let (du, dw) = (angle(vs[1]) - angle(vs[0]), angle(vs[2]) - angle(vs[0]));
            let slope = (w.perp() * -du + u.perp() * dw).length() / area.abs();
            for i in vs.iter().filter_map(|v| index.get(v)).filter(|_| slope.is_finite()) {
                slopes[*i] += DVec2::new(slope, 1.0) * area.abs();
            }
        }
        let place = |(&v, (at, slope)): (&u32, (&DVec3, &DVec2))| {
            (v, Place { at: at.truncate(), radius: slope.y / slope.x })
        };
        free.iter().zip(solved.iter().zip(&slopes)).map(place).collect()
    }
}

/// The vertices of the closed line of `edges` in order; None where they make no line, or several.
fn in_order(edges: &[[u32; 2]]) -> Option<Vec<u32>> {
    let next: BTreeMap<u32, u32> = edges.iter().map(|&[a, b]| (a, b)).collect();
    let first = *next.keys().next()?;
    let mut ring = vec![first];
    let mut at = next[&first];
    while at != first && ring.len() < edges.len() {
        ring.push(at);
        at = *next.get(&at)?;
    }
    (at == first && ring.len() == edges.len()).then_some(ring)
}

/// A point on the axis of a limb, its direction there, and the direction of angle zero.
type Frame = (DVec3, DVec3, DVec3);

/// Frames along the limb from `axis` on, `step` metres apart, up to `most` metres; angles count from `x` at the first.
fn frames(surface: &Surface, axis: Axis, x: DVec3, step: f64, most: f64) -> Vec<Frame> {
    let mut frames = vec![(axis.at, axis.along, x)];
    let (mut axis, mut x) = (axis, x);
    for _ in 0..=(most / step) as usize {
        let ahead = axis.at + axis.along * step;
        let centre = limb_centre(surface, ahead, axis.along).unwrap_or(ahead);
        let along = (centre - axis.at).try_normalize().unwrap_or(axis.along);
        axis = Axis { at: centre, along };
        x = (x - along * along.dot(x)).try_normalize().unwrap_or(x);
        frames.push((axis.at, along, x));
    }
    frames
}

/// Centre of the part of the body's section through `at`, perpendicular to `along`, that encloses `at`; None when no part does.
fn limb_centre(surface: &Surface, at: DVec3, along: DVec3) -> Option<DVec3> {
    let (x, y) = along.any_orthonormal_pair();
    let flat = |p: &DVec3| DVec2::new((*p - at).dot(x), (*p - at).dot(y));
    section(&surface.mesh, at, along)
        .iter()
        .map(|points| points.iter().map(flat).collect::<Vec<DVec2>>())
        .filter(|points| contains(points, DVec2::ZERO))
        .filter_map(|points| centroid(&points))
        .min_by(|a, b| a.length_squared().total_cmp(&b.length_squared()))
        .map(|c| at + x * c.x + y * c.y)
}

/// Point of the axis after `steps` steps, and the two directions across it from which angles count.
fn frame_at(frames: &[Frame], axis: Axis, steps: f64, step: f64) -> (DVec3, [DVec3; 2]) {
    let across = |(_, along, x): Frame| [x, along.cross(x)];
    if steps < 0.0 {
        return (axis.at + axis.along * steps * step, across(frames[0]));
    }
    let i = (steps as usize).min(frames.len() - 2);
    let centre = frames[i].0.lerp(frames[i + 1].0, (steps - i as f64).min(1.0));
    (centre, across(frames[i + 1]))
}

/// The point outside the skin from `centre` in direction `out`: at the radius `rest`, which does not stretch the cloth, or farther where the
/// skin is. `ended` is the radius where the limb has ended.
fn outside(surface: &Surface, centre: DVec3, out: DVec3, [rest, ended]: [f64; 2], offset: f64) -> DVec3 {
    let skin = if surface.contains(centre) { surface.ray(centre, out) } else { None };
    let least = skin.map_or(ended, |hit| hit.distance + offset);
    let wide = centre + out * if rest.is_finite() { rest.max(least) } else { least };
    let place = if surface.nearest(wide).distance >= offset { wide } else { centre + out * least };
    let near = surface.nearest(place);
    if near.distance >= offset { place } else { near.point + near.normal * offset }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cloth::build;
    use crate::geometry::mesh::TriMesh;
    use crate::geometry::shapes::cylinder;
    use crate::pattern::{EdgeRef, Pattern, Piece, Seam};
    use crate::wrap::limbs::Limbs;
    use crate::wrap::order::Order;

    const RADIUS: f64 = 0.05;
    const OFFSET: f64 = 0.004;
    /// Height up to which the cloth is laid, metres.
    const LAID: f64 = 0.1;
    /// How far the cloth begins above the lower end of the limb, metres.
    const LOW: f64 = 0.3;

    /// Two rectangles round a limb along y up to [`LAID`], and two that go on from them, of whose upright sides `seams` are sewn; and how
    /// each vertex would lie, did it go on straight.
    fn laid(seams: usize) -> (Garment, Order, ClothState, Vec<DVec3>) {
        let width = PI * (RADIUS + OFFSET);
        let mut pattern = Pattern::default();
        let mut piece = |name: &str, height: f64| {
            let corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)].map(DVec2::from);
            pattern.add_piece(Piece::polygon(name, &corners))
        };
        let [front, back] = ["front", "back"].map(|name| piece(name, LAID));
        let [above, behind] = ["above", "behind"].map(|name| piece(name, 0.3));
        let sides = [(front, 1, back, 3), (front, 3, back, 1), (front, 2, above, 0), (back, 2, behind, 0)];
        let more = [(above, 1, behind, 3), (above, 3, behind, 1)];
        for (a, edge, b, other) in sides.into_iter().chain(more.into_iter().take(seams)) {
            let sides = [EdgeRef { piece: a, edge }, EdgeRef { piece: b, edge: other }];
            pattern.add_seam(Seam::of_edges(sides, false));
        }
        let (garment, problems) = build(&pattern, 0.02);
        assert!(problems.is_empty(), "{problems:?}");
        let mut straight = vec![DVec3::ZERO; garment.vertex_count];
        let (mut distance, mut tier) = (vec![0.0; garment.vertex_count], vec![Some(1); garment.vertex_count]);
        for corner in &garment.corners {
            let angle = corner.uv.x / (RADIUS + OFFSET)
                + if corner.piece == front || corner.piece == above { 0.0 } else { PI };
            let is_laid = corner.piece == front || corner.piece == back;
            let height = corner.uv.y + if is_laid { 0.0 } else { LAID };
            let (v, out) = (corner.vertex as usize, DVec3::new(angle.sin(), 0.0, angle.cos()));
            straight[v] = out * (RADIUS + OFFSET) + DVec3::Y * (LOW + height);
            distance[v] = height - LAID;
            if is_laid {
                tier[v] = Some(0);
            }
        }
        let mapped = tier.iter().map(|&tier| tier == Some(0)).collect();
        let state = ClothState { positions: straight.clone(), mapped };
        let piece_tier = [(front, 0), (back, 0), (above, 1), (behind, 1)].into();
        (garment, Order { tier, distance, tiers: 2, piece_tier }, state, straight)
    }

    /// The places that a tube gets on `body`, by vertex.
    fn places(
        body: TriMesh,
        (garment, order, state, _): &(Garment, Order, ClothState, Vec<DVec3>),
    ) -> Vec<Option<DVec3>> {
        let surface = Surface::new(body).expect("a body");
        let mut limbs = Limbs::new(garment, order);
        limbs.begin(garment, &surface, state, order, OFFSET);
        (0..garment.vertex_count as u32).map(|v| limbs.place(v)).collect()
    }

    /// The limb, bent by `angle` radians towards x from a height of 0.5 m on, three times its radius round.
    fn bend(p: DVec3, angle: f64) -> DVec3 {
        let (start, radius) = (0.5, 3.0 * RADIUS);
        let turn = ((p.y - start) / radius).clamp(0.0, angle);
        let (sin, cos) = turn.sin_cos();
        let centre = DVec3::new(radius * (1.0 - cos), start + radius * sin, 0.0);
        let along = DVec3::new(sin, cos, 0.0) * (p.y - start - radius * turn);
        centre + along + DVec3::new(cos, -sin, 0.0) * p.x + DVec3::Z * p.z
    }

    #[test]
    fn a_tube_on_a_straight_limb_goes_on_straight() {
        let cloth = laid(2);
        let found = places(cylinder(RADIUS, 1.0, 64, 40), &cloth);
        let (_, _, state, straight) = &cloth;
        let mut placed = 0;
        for (v, place) in found.iter().enumerate() {
            assert_eq!(place.is_some(), !state.mapped[v], "vertex {v}");
            let Some(place) = place else { continue };
            placed += 1;
            assert!(place.distance(straight[v]) < 1e-6, "{place} for {}", straight[v]);
        }
        assert!(placed > 100, "{placed}");
    }

    #[test]
    fn a_tube_goes_round_a_limb_that_bends_away_and_does_not_enter_it() {
        let (angle, cloth) = (0.8, laid(2));
        let mut body = cylinder(RADIUS, 1.0, 64, 40);
        body.positions.iter_mut().for_each(|p| *p = bend(*p, angle));
        let found = places(body.clone(), &cloth);
        let surface = Surface::new(body).expect("a body");
        for (place, straight) in found.iter().zip(&cloth.3) {
            let Some(place) = place else { continue };
            let height = surface.nearest(*place).distance;
            assert!(height > 0.0, "{place} for {straight}: {height} m above the skin");
            assert!(place.distance(bend(*straight, angle)) < 0.6 * RADIUS, "{place} for {straight}");
        }
    }

    #[test]
    fn what_is_open_or_goes_round_two_limbs_is_no_tube() {
        let slit = places(cylinder(RADIUS, 1.0, 64, 40), &laid(1));
        assert!(slit.iter().all(Option::is_none), "a seam is open");
        let mut legs = cylinder(0.4 * RADIUS, 1.0, 32, 40);
        let (count, shift) = (legs.positions.len() as u32, DVec3::X * (0.5 * RADIUS));
        let other: Vec<DVec3> = legs.positions.iter().map(|p| *p + shift).collect();
        legs.positions.iter_mut().for_each(|p| *p -= shift);
        legs.positions.extend(other);
        let more: Vec<[u32; 3]> = legs.triangles.iter().map(|t| t.map(|v| v + count)).collect();
        legs.triangles.extend(more);
        assert!(places(legs, &laid(2)).iter().all(Option::is_none), "two legs");
    }
}
