//! Triangulation of flat pieces: constrained Delaunay with refinement (spade), seeded by a triangular lattice.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use glam::DVec2;
use spade::{AngleLimit, ConstrainedDelaunayTriangulation, Point2, RefinementParameters, Triangulation};

use crate::geometry::ids::PieceId;
use crate::geometry::polygon::{contains, distance_to_segment, first_crossing, is_inside, signed_area};
use crate::geometry::words::{Words, words};
use crate::pattern::chains::{Link, links};
use crate::pattern::sampling::Sampling;
use crate::pattern::wrinkles::{self, Ridge};
use crate::pattern::{CutPattern, Edge, EdgeRef, EdgeShape, InternalLine, Piece, Problem, ProblemKind};

/// Smallest angle that refinement aims at, degrees; sharp corners of the outline keep theirs.
const SMALLEST_ANGLE_DEG: f64 = 27.0;
/// Clearance between lattice points and the outline, in edge lengths; nearer lattice points are left out.
const LATTICE_CLEARANCE: f64 = 0.62;
/// Clearance of points of wrinkles from edges of outline and lines, in lengths of those: nearer ones would make slivers with them,
/// which are not split.
const EDGE_CLEARANCE: f64 = 0.3;
/// Most points that the finer mesh of the wrinkles of one piece may have.
const MOST_WRINKLE_POINTS: f64 = 1e5;
/// Most points that the outline of one piece may have.
const MOST_OUTLINE_POINTS: usize = 100_000;
/// Most triangles that one piece may have.
const MOST_TRIANGLES: f64 = 2e6;

/// A triangulated piece in its own plane.
#[derive(Clone, Debug, PartialEq)]
pub struct PieceMesh {
    /// Points, metres. Those of the outline come first, in its order.
    pub points: Vec<DVec2>,
    /// For each edge its points from start to end, both included.
    pub edge_points: Vec<Vec<u32>>,
    /// Edges of the mesh that follow internal lines.
    pub line_edges: Vec<LineEdge>,
    /// Counter-clockwise seen from the front of the piece.
    pub triangles: Vec<[u32; 3]>,
    /// Whether the outline runs clockwise, so that the front is the far side of the drawing.
    pub front_is_far: bool,
}

/// An edge of the mesh that follows an internal line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineEdge {
    /// Its points.
    pub ends: [u32; 2],
    /// Number of the internal line.
    pub line: usize,
    /// Number of the edge of that line.
    pub edge: usize,
}

/// Triangulated pieces, kept so that unchanged ones are not triangulated again.
#[derive(Clone, Debug, Default)]
pub struct Meshes {
    made: BTreeMap<PieceId, (Key, Arc<PieceMesh>)>,
    /// Number of pieces that the last update triangulated rather than reused.
    pub fresh: usize,
}

/// Key of a kept mesh: the piece, the number of intervals of each edge, and the length of the edges inside.
type Key = (Arc<Piece>, Vec<usize>, f64);

impl Meshes {
    /// Triangulates every piece that it can; the others are reported in `problems` by name. A piece that has not
    /// changed, with the same intervals, is reused.
    pub fn update(
        &mut self,
        pattern: &CutPattern,
        sampling: &Sampling,
        problems: &mut Vec<Problem>,
    ) -> BTreeMap<PieceId, Arc<PieceMesh>> {
        let before = std::mem::take(&mut self.made);
        self.fresh = 0;
        for (&id, piece) in &pattern.pieces {
            let (intervals, edge_length) = (&sampling.intervals[&id], sampling.edge_lengths[&id]);
            let same = |(old, of_edges, of_inside): &Key| {
                of_edges == intervals
                    && *of_inside == edge_length
                    && (Arc::ptr_eq(old, piece) || is_cut_alike(old, piece))
            };
            let kept = before.get(&id).filter(|(key, _)| same(key));
            let mesh = match kept {
                Some((_, mesh)) => Ok(Arc::clone(mesh)),
                None => piece_mesh(pattern, id, piece, intervals, edge_length).map(Arc::new),
            };
            self.fresh += usize::from(kept.is_none());
            match mesh {
                Ok(mesh) => {
                    self.made.insert(id, ((Arc::clone(piece), intervals.clone(), edge_length), mesh));
                }
                Err(problem) => problems.push(problem),
            }
        }
        self.made.iter().map(|(&id, (_, mesh))| (id, Arc::clone(mesh))).collect()
    }
}

/// Whether two pieces with the same intervals give the same mesh.
fn is_cut_alike(one: &Piece, other: &Piece) -> bool {
    let is_alike = |a: &[Edge], b: &[Edge]| {
        a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a.start, a.shape) == (b.start, b.shape))
    };
    let followed = |piece: &Piece| -> Vec<InternalLine> {
        piece.lines.iter().filter(|line| line.needs_mesh()).cloned().collect()
    };
    let is_line = |a: &InternalLine, b: &InternalLine| {
        let needs = |line: &InternalLine| -> Vec<(bool, Option<f64>)> {
            let width = |edge: &Edge| edge.trims.wrinkle.map(|wrinkle| wrinkle.width);
            line.edges.iter().map(|edge| (edge.trims.needs_mesh(), width(edge))).collect()
        };
        is_alike(&a.edges, &b.edges) && a.end == b.end && needs(a) == needs(b)
    };
    let (mine, others) = (followed(one), followed(other));
    let numbers = |piece: &Piece| -> Vec<usize> {
        (0..piece.lines.len()).filter(|&k| piece.lines[k].needs_mesh()).collect()
    };
    is_alike(&one.outline, &other.outline)
        && one.holes.len() == other.holes.len()
        && one.holes.iter().zip(&other.holes).all(|(a, b)| is_alike(a, b))
        && numbers(one) == numbers(other)
        && mine.iter().zip(&others).all(|(a, b)| is_line(a, b))
}

fn piece_mesh(
    pattern: &CutPattern,
    id: PieceId,
    piece: &Piece,
    intervals: &[usize],
    edge_length: f64,
) -> Result<PieceMesh, Problem> {
    let fault =
        |kind, words: Words| Problem { kind, place: words!("{name} ({id})", name = piece.name, id), words };
    if piece.outline.len() < 2 {
        return Err(fault(ProblemKind::ZeroLength, words!("its outline has fewer than two edges")));
    }
    if !is_finite(piece) {
        return Err(fault(
            ProblemKind::NotTriangulated,
            words!("its outline has coordinates that are not numbers"),
        ));
    }
    let too_fine = || {
        fault(
            ProblemKind::NotTriangulated,
            words!("it would need more than two million triangles; raise the edge length"),
        )
    };
    if intervals.iter().fold(0, |sum: usize, n| sum.saturating_add(*n)) > MOST_OUTLINE_POINTS {
        return Err(too_fine());
    }
    let lines = sampled_lines(piece, intervals);
    let (outline, edge_points) = (lines.of_loop(0), &lines.edge_points);
    let extent = outline.iter().fold(0.0f64, |m, p| m.max((*p - outline[0]).length()));
    if is_straight(outline, extent) {
        return Err(fault(ProblemKind::ZeroLength, words!("it has no area")));
    }
    if let Some((i, j)) = lines.crossing() {
        let (a, b) = (edge_of(edge_points, i), edge_of(edge_points, j));
        return Err(Problem {
            kind: ProblemKind::SelfCrossing,
            place: pattern.place(EdgeRef { piece: id, edge: a }),
            words: words!(
                "the outline crosses itself: edge {a} meets edge {b}; move their points apart",
                a,
                b
            ),
        });
    }
    if let Some(fault) = lines.misplaced_hole() {
        return Err(Problem {
            kind: ProblemKind::NotTriangulated,
            place: words!("{name} ({id})", name = piece.name, id),
            words: fault,
        });
    }
    let area = signed_area(outline);
    if area.abs() < 1e-9 || area.abs() < extent * extent * 1e-6 {
        return Err(fault(ProblemKind::ZeroLength, words!("it has no area")));
    }
    if area.abs() / (edge_length * edge_length * 0.433) > MOST_TRIANGLES {
        return Err(too_fine());
    }
    let ridges: Vec<Ridge> = wrinkles::ridges(piece).into_iter().filter(|r| r.is_fine(edge_length)).collect();
    let count = ridges.iter().map(Ridge::count).sum::<f64>();
    if count > MOST_WRINKLE_POINTS || count.is_nan() {
        let words =
            words!("its wrinkles would need more than a hundred thousand points; make them wider or shorter");
        return Err(fault(ProblemKind::NotTriangulated, words));
    }
    let within: Vec<[DVec2; 2]> = (0..lines.points.len()).map(|i| lines.segment(i).into()).collect();
    let links = links(piece, edge_length, &within, |p| is_inside(within.iter().copied(), p));
    let (points, mut triangles, line_edges) =
        refined(&lines, &links, &ridges, edge_length).ok_or_else(|| {
            fault(ProblemKind::NotTriangulated, words!("its outline could not be triangulated"))
        })?;
    let front_is_far = area < 0.0;
    if front_is_far {
        for t in &mut triangles {
            t.swap(1, 2);
        }
    }
    Ok(PieceMesh { points, edge_points: lines.edge_points, line_edges, triangles, front_is_far })
}

/// Whether all points are on one line, to within a millionth of their extent.
fn is_straight(outline: &[DVec2], extent: f64) -> bool {
    let far = outline.iter().copied().find(|p| (*p - outline[0]).length() >= extent);
    let along = far.map_or(DVec2::ZERO, |p| (p - outline[0]).normalize_or_zero());
    outline.iter().all(|p| (*p - outline[0]).perp_dot(along).abs() <= extent * 1e-6)
}

fn is_finite(piece: &Piece) -> bool {
    piece.loops().flatten().all(|edge| {
        edge.start.is_finite()
            && match edge.shape {
                EdgeShape::Line => true,
                EdgeShape::Arc { radius, .. } => radius.is_finite(),
                EdgeShape::Quadratic { control } => control.is_finite(),
                EdgeShape::Cubic { controls } => controls.iter().all(|c| c.is_finite()),
            }
    })
}

/// The closed lines of a piece as polylines, one after the other.
struct Lines {
    points: Vec<DVec2>,
    /// For each point the one that follows it on its line.
    next: Vec<u32>,
    /// For each line the index of its first point; then the number of points.
    starts: Vec<usize>,
    /// For each edge its points from start to end, both included.
    edge_points: Vec<Vec<u32>>,
}

fn sampled_lines(piece: &Piece, intervals: &[usize]) -> Lines {
    let mut lines = Lines { points: Vec::new(), next: Vec::new(), starts: vec![0], edge_points: Vec::new() };
    let mut number = 0;
    for edges in piece.loops() {
        let start = lines.points.len() as u32;
        for _ in edges {
            let (first, n) = (lines.points.len() as u32, intervals[number]);
            let fractions: Vec<f64> = (0..n).map(|k| k as f64 / n as f64).collect();
            lines.points.extend(piece.edge_points(number, &fractions));
            lines.edge_points.push((first..=first + n as u32).collect());
            number += 1;
        }
        if let Some(last) = lines.edge_points.last_mut().and_then(|e| e.last_mut()) {
            *last = start;
        }
        lines.next.extend(start + 1..=lines.points.len() as u32);
        if let Some(last) = lines.next.last_mut() {
            *last = start;
        }
        lines.starts.push(lines.points.len());
    }
    lines
}

impl Lines {
    fn of_loop(&self, k: usize) -> &[DVec2] {
        &self.points[self.starts[k]..self.starts[k + 1]]
    }

    fn segment(&self, i: usize) -> (DVec2, DVec2) {
        (self.points[i], self.points[self.next[i] as usize])
    }

    /// The first two segments that intersect without being neighbours.
    fn crossing(&self) -> Option<(usize, usize)> {
        let segments: Vec<[DVec2; 2]> = (0..self.points.len()).map(|i| self.segment(i).into()).collect();
        first_crossing(&segments, |i, j| self.next[i] as usize == j || self.next[j] as usize == i)
    }

    /// Describes a hole that lies outside the outline or inside another hole; assumes that the lines do not cross.
    fn misplaced_hole(&self) -> Option<Words> {
        let inside = |k: usize, p: DVec2| contains(self.of_loop(k), p);
        let holes = 1..self.starts.len() - 1;
        holes.clone().find_map(|k| {
            let p = *self.of_loop(k).first()?;
            if !inside(0, p) {
                return Some(words!("hole {k} lies outside its outline; move it back", k));
            }
            let other = holes.clone().find(|&other| other != k && inside(other, p))?;
            Some(words!("hole {k} lies inside hole {other}; delete it", k, other))
        })
    }
}

fn edge_of(edge_points: &[Vec<u32>], segment: usize) -> usize {
    edge_points.iter().position(|e| e[..e.len() - 1].contains(&(segment as u32))).unwrap_or(0)
}

/// Points, those of the outline first; triangles, counter-clockwise in the drawing; edges along internal lines.
type Refined = (Vec<DVec2>, Vec<[u32; 3]>, Vec<LineEdge>);

/// Refined triangulation with edges along `links`, finer in `ridges`.
fn refined(lines: &Lines, links: &[Link], ridges: &[Ridge], edge_length: f64) -> Option<Refined> {
    let outline = &lines.points;
    let mut cdt = ConstrainedDelaunayTriangulation::<Point2<f64>>::new();
    let mut handles = Vec::with_capacity(outline.len());
    for p in outline {
        handles.push(cdt.insert(Point2::new(p.x, p.y)).ok()?);
    }
    if cdt.num_vertices() != outline.len() {
        return None;
    }
    for i in 0..handles.len() {
        let (a, b) = (handles[i], handles[lines.next[i] as usize]);
        if !cdt.exists_constraint(a, b) {
            if !cdt.can_add_constraint(a, b) {
                return None;
            }
            cdt.add_constraint(a, b);
        }
    }
    let mut line_edges = Vec::with_capacity(links.len());
    for link in links {
        let [a, b] = link.ends.map(|p| cdt.insert(Point2::new(p.x, p.y)));
        let (a, b) = (a.ok()?, b.ok()?);
        if a != b && !cdt.exists_constraint(a, b) && cdt.can_add_constraint(a, b) {
            cdt.add_constraint(a, b);
            let ends = [a, b].map(|v| v.index() as u32);
            line_edges.push(LineEdge { ends, line: link.line, edge: link.edge });
        }
    }
    let keep = cdt.num_vertices();
    for p in inner_points(lines, links, ridges, edge_length) {
        cdt.insert(Point2::new(p.x, p.y)).ok()?;
    }
    // What open lines enclose would count as a hole, so that with them the surroundings are refined, too: faces between a nearly
    // straight edge of the outline and the hull could not be, and would draw ever more points to them.
    let has_links = !links.is_empty();
    if has_links {
        for p in corners_around(outline) {
            cdt.insert(Point2::new(p.x, p.y)).ok()?;
        }
    }
    let most = 4 * cdt.num_vertices() + 1000;
    let parameters = RefinementParameters::new()
        .keep_constraint_edges()
        .with_angle_limit(AngleLimit::from_deg(SMALLEST_ANGLE_DEG))
        .exclude_outer_faces(!has_links)
        .with_max_additional_vertices(most);
    let result = cdt.refine(parameters);
    let outside = match has_links {
        true => beyond_outline(&cdt, lines),
        false => result.excluded_faces.iter().map(|f| f.index()).collect(),
    };
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    for face in cdt.inner_faces() {
        if !outside.contains(&face.fix().index()) {
            triangles.push(face.vertices().map(|v| v.fix().index() as u32));
        }
    }
    let points: Vec<DVec2> = cdt.vertices().map(|v| DVec2::new(v.position().x, v.position().y)).collect();
    let (points, triangles) = only_used(points, triangles, keep);
    Some((points, triangles, line_edges))
}

/// Corners of a box that clears the outline by a third of its extent.
fn corners_around(outline: &[DVec2]) -> [DVec2; 4] {
    let lower = outline.iter().fold(DVec2::INFINITY, |m, &p| m.min(p));
    let upper = outline.iter().fold(DVec2::NEG_INFINITY, |m, &p| m.max(p));
    let by = DVec2::splat((upper - lower).max_element() / 3.0);
    let [lower, upper] = [lower - by, upper + by];
    [lower, DVec2::new(upper.x, lower.y), upper, DVec2::new(lower.x, upper.y)]
}

/// Indices of the faces outside the closed lines, which the first points of `cdt` follow: those reached from outside over an even
/// number of their segments.
fn beyond_outline(cdt: &ConstrainedDelaunayTriangulation<Point2<f64>>, lines: &Lines) -> BTreeSet<usize> {
    let is_segment = |ends: [usize; 2]| {
        let follows = |a: usize, b: usize| lines.next.get(a).is_some_and(|&next| next as usize == b);
        follows(ends[0], ends[1]) || follows(ends[1], ends[0])
    };
    let mut is_outside: Vec<Option<bool>> = vec![None; cdt.num_all_faces()];
    is_outside[cdt.outer_face().fix().index()] = Some(true);
    let mut open: Vec<_> = cdt.convex_hull().map(|edge| (edge, true)).collect();
    while let Some((edge, from_outside)) = open.pop() {
        let face = edge.rev().face();
        let here = from_outside != is_segment(edge.vertices().map(|v| v.fix().index()));
        if let (None, Some(inner)) = (is_outside[face.fix().index()], face.as_inner()) {
            is_outside[face.fix().index()] = Some(here);
            open.extend(inner.adjacent_edges().map(|next| (next, here)));
        }
    }
    cdt.inner_faces().map(|f| f.fix().index()).filter(|&f| is_outside[f] == Some(true)).collect()
}

/// Removes points that no triangle uses (refinement may leave some outside), keeping the first `keep`.
fn only_used(points: Vec<DVec2>, mut triangles: Vec<[u32; 3]>, keep: usize) -> (Vec<DVec2>, Vec<[u32; 3]>) {
    let mut used = vec![false; points.len()];
    used[..keep].fill(true);
    for &v in triangles.iter().flatten() {
        used[v as usize] = true;
    }
    let mut renamed = vec![0; points.len()];
    let mut kept = Vec::with_capacity(points.len());
    for (i, &p) in points.iter().enumerate() {
        if used[i] {
            renamed[i] = kept.len() as u32;
            kept.push(p);
        }
    }
    for v in triangles.iter_mut().flatten() {
        *v = renamed[*v as usize];
    }
    (kept, triangles)
}

/// Points inside the outline: an equilateral lattice, and in wrinkles that need a finer one rows along them.
fn inner_points(lines: &Lines, links: &[Link], ridges: &[Ridge], edge_length: f64) -> Vec<DVec2> {
    let mut points = lattice(lines, links, edge_length);
    if ridges.is_empty() {
        return points;
    }
    let is_near = |p: DVec2, ridge: &Ridge| {
        ridge.distance(p) < ridge.wrinkle.width / 2.0 + edge_length * LATTICE_CLEARANCE
    };
    points.retain(|&p| !ridges.iter().any(|ridge| is_near(p, ridge)));
    let outline: Vec<[DVec2; 2]> = (0..lines.points.len()).map(|i| lines.segment(i).into()).collect();
    let is_free = |p: DVec2, row: f64| {
        let clears = |&[a, b]: &[DVec2; 2]| {
            let clearance = (row * LATTICE_CLEARANCE).max(a.distance(b) * EDGE_CLEARANCE);
            distance_to_segment(p, a, b) >= clearance
        };
        outline.iter().all(clears)
            && links.iter().all(|link| clears(&link.ends))
            && is_inside(outline.iter().copied(), p)
    };
    points.extend(wrinkles::points(ridges, is_free));
    points
}

/// Points of an equilateral lattice inside the outline, with clearance from it and from `links`.
fn lattice(lines: &Lines, links: &[Link], spacing: f64) -> Vec<DVec2> {
    let outline = &lines.points;
    let lower = outline.iter().fold(DVec2::INFINITY, |m, &p| m.min(p));
    let upper = outline.iter().fold(DVec2::NEG_INFINITY, |m, &p| m.max(p));
    let row_height = spacing * 0.75f64.sqrt();
    let rows = ((upper.y - lower.y) / row_height).ceil() as i64;
    let columns = ((upper.x - lower.x) / spacing).ceil() as i64 + 1;
    let clearance = spacing * LATTICE_CLEARANCE;
    let mut points = Vec::new();
    for row in 0..=rows {
        let y = lower.y + row as f64 * row_height;
        let crossings: Vec<f64> =
            (1..lines.starts.len()).flat_map(|k| row_crossings(lines.of_loop(k - 1), y)).collect();
        let near: Vec<(DVec2, DVec2)> = (0..outline.len())
            .map(|i| lines.segment(i))
            .chain(links.iter().map(|link| link.ends.into()))
            .filter(|(a, b)| a.y.min(b.y) <= y + clearance && a.y.max(b.y) >= y - clearance)
            .collect();
        let shift = if row % 2 == 0 { 0.0 } else { 0.5 };
        for column in 0..=columns {
            let p = DVec2::new(lower.x + (column as f64 + shift) * spacing, y);
            let inside = crossings.iter().filter(|&&x| x < p.x).count() % 2 == 1;
            if inside && near.iter().all(|&(a, b)| distance_to_segment(p, a, b) >= clearance) {
                points.push(p);
            }
        }
    }
    points
}

fn row_crossings(outline: &[DVec2], y: f64) -> Vec<f64> {
    (0..outline.len())
        .filter_map(|i| {
            let (a, b) = (outline[i], outline[(i + 1) % outline.len()]);
            ((a.y <= y) != (b.y <= y)).then(|| a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x))
        })
        .collect()
}
