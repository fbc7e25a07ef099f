//! Piping: cords along edges of the cloth, as tubes. Pictures show them and files hold them.

use std::collections::{BTreeMap, BTreeSet};

use glam::{DVec2, Quat, Vec3};

use crate::cloth::{Garment, trims::Along};
use crate::geometry::ids::PieceId;
use crate::geometry::polygon::distance_to_segment;
use crate::geometry::solid::{Rings, Solid};
use crate::pattern::{Pattern, Piece, Piping, curve};

/// Sides of a tube.
const SIDES: usize = 10;
/// Parts into which the curve along each edge of the cloth's mesh is cut.
const PARTS: usize = 4;
/// Tolerance to which lines of the pattern are flattened, metres.
const TOLERANCE: f64 = 2e-4;

/// An edge of the mesh: its two vertices, the lower one first.
pub type Ends = [u32; 2];

/// A cord along edges of the cloth.
#[derive(Clone, Debug, PartialEq)]
pub struct Cord {
    /// The vertices of the cloth in order, at least two; of a closed cord each once.
    pub vertices: Vec<u32>,
    /// Whether the last vertex is joined to the first.
    pub is_closed: bool,
    /// Its radius and colour.
    pub look: Piping,
}

/// The edges of the mesh of `garment` that have piping.
pub fn piped(garment: &Garment) -> BTreeSet<Ends> {
    garment.trims.piped.iter().map(|along| ends(garment, along)).collect()
}

/// Whether the edge between two vertices is one of `piped`.
pub fn is_piped(piped: &BTreeSet<Ends>, [a, b]: [u32; 2]) -> bool {
    piped.contains(&[a.min(b), a.max(b)])
}

fn ends(garment: &Garment, along: &Along<f64>) -> Ends {
    let [a, b] = along.corners.map(|c| garment.corners[c as usize].vertex);
    [a.min(b), a.max(b)]
}

/// The cords of `garment`, which look as `pattern` says. Edges that are sewn to each other have one cord, and neighbouring edges with
/// the same piping share one.
pub fn cords(garment: &Garment, pattern: &Pattern) -> Vec<Cord> {
    let mut lines: BTreeMap<PieceId, Vec<Line>> = BTreeMap::new();
    let mut looks: BTreeMap<Ends, Piping> = BTreeMap::new();
    for along in &garment.trims.piped {
        let corners = along.corners.map(|c| garment.corners[c as usize]);
        let Some(piece) = pattern.pieces.get(&corners[0].piece).filter(|p| !p.activity.is_deactivated())
        else {
            continue;
        };
        let lines = lines.entry(corners[0].piece).or_insert_with(|| piped_lines(piece));
        let ends = ends(garment, along);
        if let Some(look) = look_at(lines, corners[0].uv.midpoint(corners[1].uv))
            && ends[0] != ends[1]
        {
            looks.entry(ends).or_insert(look);
        }
    }
    joined(&looks)
}

/// A line with piping, flattened.
type Line = (Piping, Vec<DVec2>);

fn piped_lines(piece: &Piece) -> Vec<Line> {
    let mut lines = Vec::new();
    let mut push = |edge: &crate::pattern::Edge, end: DVec2| {
        if let Some(look) = edge.trims.piping {
            let mut points = Vec::new();
            curve::flatten(edge.start, edge.shape, end, TOLERANCE, &mut points);
            points.push(end);
            lines.push((look, points));
        }
    };
    for i in 0..piece.edge_count() {
        push(piece.edge(i), piece.edge_ends(i).1);
    }
    for line in &piece.lines {
        for (i, edge) in line.edges.iter().enumerate() {
            push(edge, line.edge_end(i));
        }
    }
    lines
}

/// The piping of the line that is nearest to `p`.
fn look_at(lines: &[Line], p: DVec2) -> Option<Piping> {
    let distance = |points: &[DVec2]| {
        points.windows(2).map(|w| distance_to_segment(p, w[0], w[1])).fold(f64::MAX, f64::min)
    };
    let near = lines.iter().map(|(look, points)| (distance(points), *look));
    near.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, look)| look)
}

/// Joins edges that follow each other, with the same look, into cords.
fn joined(looks: &BTreeMap<Ends, Piping>) -> Vec<Cord> {
    let mut at: BTreeMap<u32, Vec<Ends>> = BTreeMap::new();
    for &ends in looks.keys() {
        ends.iter().for_each(|&v| at.entry(v).or_default().push(ends));
    }
    // The edge after `ends` beyond its vertex `v`.
    let next = |ends: Ends, v: u32| match at[&v][..] {
        [a, b] if looks[&a] == looks[&b] => Some(if a == ends { b } else { a }),
        _ => None,
    };
    let mut left: BTreeSet<Ends> = looks.keys().copied().collect();
    let mut walk = |first: Ends, from: u32| -> Option<Vec<u32>> {
        left.remove(&first).then_some(())?;
        let mut vertices = vec![from];
        let (mut ends, mut v) = (first, from);
        loop {
            v = if ends[0] == v { ends[1] } else { ends[0] };
            vertices.push(v);
            match next(ends, v).filter(|after| left.remove(after)) {
                Some(after) => ends = after,
                None => return Some(vertices),
            }
        }
    };
    let mut cords = Vec::new();
    for (&ends, &look) in looks {
        let Some(from) = ends.into_iter().find(|&v| next(ends, v).is_none()) else { continue };
        cords.extend(walk(ends, from).map(|vertices| Cord { vertices, is_closed: false, look }));
    }
    // What is left has no ends.
    for (&ends, &look) in looks {
        cords.extend(walk(ends, ends[0]).map(|mut vertices| {
            vertices.pop();
            Cord { vertices, is_closed: true, look }
        }));
    }
    cords
}

impl Cord {
    /// Adds the tube of the cord to `mesh`, with normals, where `place` has its vertices, each with the direction that a corner of
    /// a tube which begins there points in; zero: any. Its axis is the line itself: half of it shows on the outer side. `scale`
    /// is that of the body.
    pub fn push(&self, mesh: &mut Solid, place: impl Fn(u32) -> Option<[Vec3; 2]>, scale: f32) {
        let places: Vec<Option<[Vec3; 2]>> = self.vertices.iter().map(|&v| place(v)).collect();
        let radius = self.look.radius as f32 * scale;
        let is_whole = self.is_closed && places.len() > 2 && places.iter().all(Option::is_some);
        // A closed cord that is covered somewhere goes on past where it begins.
        let again = if self.is_closed && !is_whole { places.first().copied() } else { None };
        let places: Vec<Option<[Vec3; 2]>> = places.into_iter().chain(again).collect();
        for run in places.split(Option::is_none).filter(|run| run.len() > 1) {
            let across = run.iter().flatten().next().map_or(Vec3::ZERO, |[_, across]| *across);
            let run: Vec<Vec3> = run.iter().flatten().map(|[at, _]| *at).collect();
            push_tube(mesh, (&rounded(&run, is_whole), across), is_whole, radius, self.look.colour);
        }
    }
}

/// Points on the uniform Catmull-Rom curve through `points`, [`PARTS`] for each of its sides.
fn rounded(points: &[Vec3], is_closed: bool) -> Vec<Vec3> {
    let n = points.len();
    let at = |i: isize| match usize::try_from(i) {
        _ if is_closed => points[i.rem_euclid(n as isize) as usize],
        Err(_) => points[0] * 2.0 - points[1],
        Ok(i) if i >= n => points[n - 1] * 2.0 - points[n - 2],
        Ok(i) => points[i],
    };
    let sides = if is_closed { n } else { n - 1 };
    let mut curve = Vec::with_capacity(sides * PARTS + 1);
    for i in 0..sides as isize {
        let [before, a, b, after] = [i - 1, i, i + 1, i + 2].map(at);
        let (from, to) = ((b - before) / 2.0, (after - a) / 2.0);
        for k in 0..PARTS {
            let t = k as f32 / PARTS as f32;
            let (square, cube) = (t * t, t * t * t);
            curve.push(
                a * (2.0 * cube - 3.0 * square + 1.0)
                    + from * (cube - 2.0 * square + t)
                    + b * (3.0 * square - 2.0 * cube)
                    + to * (cube - square),
            );
        }
    }
    if !is_closed {
        curve.push(points[n - 1]);
    }
    curve
}

/// Unit tangents of a polyline, and at each point a unit vector across it, which turns about the tangent as little as it can. The
/// first is as near to `across` as it can be.
fn frames(points: &[Vec3], across: Vec3, is_closed: bool) -> Vec<[Vec3; 2]> {
    let n = points.len();
    let mut frames: Vec<[Vec3; 2]> = Vec::with_capacity(n);
    let tangent = |i: usize| {
        let (before, after) = match is_closed {
            true => ((i + n - 1) % n, (i + 1) % n),
            false => (i.saturating_sub(1), (i + 1).min(n - 1)),
        };
        (points[after] - points[before]).try_normalize()
    };
    let carried = |[from, side]: [Vec3; 2], to: Vec3| {
        let side = Quat::from_rotation_arc(from, to) * side;
        [to, side.reject_from_normalized(to).try_normalize().unwrap_or_else(|| to.any_orthonormal_vector())]
    };
    for i in 0..n {
        let last = frames.last().copied();
        frames.push(match (last, tangent(i)) {
            (Some(last), Some(way)) => carried(last, way),
            (Some(last), None) => last,
            (None, way) => {
                let way = way.unwrap_or(Vec3::X);
                let side = across.reject_from_normalized(way).try_normalize();
                [way, side.unwrap_or_else(|| way.any_orthonormal_vector())]
            }
        });
    }
    if is_closed {
        // Carried round, the last meets the first turned by an angle that all share.
        let [way, side] = frames[0];
        let [_, back] = carried(frames[n - 1], way);
        let twist = way.dot(side.cross(back)).atan2(side.dot(back));
        for (i, [way, side]) in frames.iter_mut().enumerate() {
            *side = Quat::from_axis_angle(*way, -twist * i as f32 / n as f32) * *side;
        }
    }
    frames
}

/// Adds a tube of `radius` about the polyline `axis`, at least two points; its first corner is as near to `across` as it can
/// be. Its ends are closed by domes, or joined where it `is_closed`.
fn push_tube(
    mesh: &mut Solid,
    (axis, across): (&[Vec3], Vec3),
    is_closed: bool,
    radius: f32,
    colour: [u8; 3],
) {
    let ring: [(f32, f32); SIDES] =
        std::array::from_fn(|k| (std::f32::consts::TAU * k as f32 / SIDES as f32).sin_cos());
    let first = mesh.positions.len() as u32;
    let frames = frames(axis, across, is_closed);
    for (&at, [way, side]) in axis.iter().zip(&frames) {
        let other = way.cross(*side);
        for (sin, cos) in ring {
            let normal = *side * cos + other * sin;
            mesh.positions.push(at + normal * radius);
            mesh.normals.push(normal);
        }
    }
    let rings = Rings { first, sides: SIDES as u32, count: axis.len() as u32 };
    mesh.join(rings, is_closed);
    if let ([from, .., to], [[start, _], .., [end, _]]) = (axis, &frames[..])
        && !is_closed
    {
        mesh.close(rings, [*from, *to], [-*start, *end], radius);
    }
    mesh.colours.resize(mesh.positions.len(), colour);
}

#[cfg(test)]
mod tests {
    use glam::Vec3Swizzles;

    use super::*;
    use crate::cloth::build;
    use crate::geometry::solid::tests::volume_of_closed;
    use crate::pattern::edit::{PatternEdit, TrimLine, apply};
    use crate::pattern::{EdgeRef, InternalLine, Seam};

    const RADIUS: f32 = 0.0015;

    fn tube(axis: &[Vec3], is_closed: bool) -> Solid {
        let mut mesh = Solid::default();
        push_tube(&mut mesh, (axis, Vec3::ZERO), is_closed, RADIUS, [1, 2, 3]);
        mesh
    }

    #[test]
    fn a_straight_tube_has_its_radius_and_closed_ends() {
        let axis = rounded(&[Vec3::ZERO, Vec3::X * 0.02, Vec3::X * 0.04, Vec3::X * 0.06], false);
        assert_eq!(axis.len(), 3 * PARTS + 1);
        let mesh = tube(&axis, false);
        assert_eq!(mesh.positions.len(), axis.len() * SIDES + 2);
        assert_eq!(mesh.triangles.len(), (axis.len() - 1) * SIDES * 2 + 2 * SIDES);
        for (p, normal) in mesh.positions.iter().zip(&mesh.normals).take(axis.len() * SIDES) {
            assert!((p.yz().length() - RADIUS).abs() < 1e-7, "{p}");
            assert!((normal.yz() * RADIUS - p.yz()).length() < 1e-7 && normal.is_normalized());
        }
        let section = SIDES as f32 / 2.0 * (std::f32::consts::TAU / SIDES as f32).sin() * RADIUS * RADIUS;
        let wanted = section * (0.06 + 2.0 * crate::geometry::solid::DOME * RADIUS / 3.0);
        assert!((volume_of_closed(&mesh) / wanted - 1.0).abs() < 1e-3);
    }

    #[test]
    fn a_closed_cord_has_no_ends_and_no_twist() {
        // A ring that goes up and down three times.
        let ring: Vec<Vec3> = (0..24)
            .map(|i| {
                let (sin, cos) = (std::f32::consts::TAU * i as f32 / 24.0).sin_cos();
                Vec3::new(cos, 0.3 * (std::f32::consts::TAU * i as f32 / 8.0).sin(), sin) * 0.08
            })
            .collect();
        let axis = rounded(&ring, true);
        assert_eq!(axis.len(), 24 * PARTS);
        let mesh = tube(&axis, true);
        assert_eq!(mesh.positions.len(), axis.len() * SIDES);
        assert!(volume_of_closed(&mesh) > 0.0);
        let across = |i: usize| (mesh.positions[i * SIDES] - axis[i]) / RADIUS;
        for (i, at) in axis.iter().enumerate() {
            for k in 0..SIDES {
                let off = mesh.positions[i * SIDES + k].distance(*at);
                assert!((off - RADIUS).abs() < 1e-6, "{off}");
            }
            assert!(across(i).dot(across((i + 1) % axis.len())) > 0.9, "twisted at {i}");
        }
    }

    #[test]
    fn the_curve_goes_through_the_cloth_and_stays_on_a_circle() {
        let circle = |a: f32| Vec3::new(a.cos(), a.sin(), 0.0) * 0.08;
        let points: Vec<Vec3> = (0..25).map(|i| circle(std::f32::consts::TAU * i as f32 / 25.0)).collect();
        let curve = rounded(&points, true);
        assert!(points.iter().enumerate().all(|(i, p)| curve[i * PARTS].distance(*p) < 1e-7));
        assert!(curve.iter().all(|p| (p.length() - 0.08).abs() < 2e-5), "20 mm sides bend like the circle");
    }

    /// Two squares 0.1 m wide; the right edge of the first is sewn to the left edge of the second.
    fn squares(piped: &[(usize, usize)]) -> (Pattern, Garment) {
        let mut pattern = Pattern::default();
        let corners = [(0.0, 0.0), (0.1, 0.0), (0.1, 0.1), (0.0, 0.1)].map(DVec2::from);
        let ids = [0, 1].map(|k| {
            let mut piece = Piece::polygon("square", &corners);
            for &(_, edge) in piped.iter().filter(|(of, _)| *of == k) {
                piece.outline[edge].trims.piping = Some(Piping::USUAL);
            }
            pattern.add_piece(piece)
        });
        let sides = [EdgeRef { piece: ids[0], edge: 1 }, EdgeRef { piece: ids[1], edge: 3 }];
        pattern.add_seam(Seam::of_edges(sides, false));
        let garment = build(&pattern, 0.025).0;
        (pattern, garment)
    }

    #[test]
    fn a_seam_has_one_cord_whichever_side_names_it() {
        for piped in [&[(0, 1)][..], &[(1, 3)], &[(0, 1), (1, 3)]] {
            let (pattern, garment) = squares(piped);
            let cords = cords(&garment, &pattern);
            assert_eq!(cords.len(), 1, "{piped:?}");
            assert_eq!((cords[0].vertices.len(), cords[0].is_closed), (5, false));
            assert_eq!(cords[0].look, Piping::USUAL);
        }
    }

    #[test]
    fn a_cord_goes_on_over_a_seam_and_round_corners_until_its_look_changes() {
        // The lower edges of both, which meet at the seam.
        let (pattern, garment) = squares(&[(0, 0), (1, 0)]);
        let lower = cords(&garment, &pattern);
        assert_eq!(lower.iter().map(|c| c.vertices.len()).collect::<Vec<_>>(), [9]);
        let second = *pattern.pieces.keys().last().expect("a piece");
        let lines = vec![TrimLine::Edge(EdgeRef { piece: second, edge: 0 })];
        let piping = Some(Piping { colour: [9; 3], ..Piping::USUAL });
        let edited = apply(&pattern, &PatternEdit::SetPiping { lines, piping }).expect("dyed");
        let dyed = cords(&garment, &edited.pattern);
        assert_eq!(dyed.iter().map(|c| c.vertices.len()).collect::<Vec<_>>(), [5, 5]);
        // All open edges of both: one ring.
        let (pattern, garment) = squares(&[(0, 0), (0, 2), (0, 3), (1, 0), (1, 1), (1, 2)]);
        let ring = cords(&garment, &pattern);
        assert_eq!((ring.len(), ring[0].is_closed, ring[0].vertices.len()), (1, true, 24));
        assert_eq!(piped(&garment).len(), 24);
    }

    #[test]
    fn the_mesh_follows_a_line_with_piping() {
        let (pattern, _) = squares(&[]);
        let first = *pattern.pieces.keys().next().expect("a piece");
        let start = DVec2::new(0.02, 0.03);
        let edges = vec![crate::pattern::Edge {
            start,
            trims: crate::pattern::Trims { piping: Some(Piping::USUAL), ..Default::default() },
            ..Default::default()
        }];
        let line = InternalLine { edges, end: DVec2::new(0.07, 0.06), ..InternalLine::default() };
        let pattern = apply(&pattern, &PatternEdit::AddLine { piece: first, line }).expect("drawn").pattern;
        let garment = build(&pattern, 0.025).0;
        let cords = cords(&garment, &pattern);
        assert_eq!(cords.len(), 1);
        let corner = |v: u32| garment.corners.iter().find(|c| c.vertex == v).expect("a corner").uv;
        let on = |p: DVec2| distance_to_segment(p, start, DVec2::new(0.07, 0.06)) < 1e-9;
        assert!(cords[0].vertices.len() >= 3 && cords[0].vertices.iter().all(|&v| on(corner(v))));
    }

    #[test]
    fn a_covered_part_is_not_drawn() {
        let cord = Cord { vertices: (0..8).collect(), is_closed: true, look: Piping::USUAL };
        let at = |v: u32| Vec3::new((v as f32 * 0.785).cos(), (v as f32 * 0.785).sin(), 0.0);
        let mut mesh = Solid::default();
        cord.push(&mut mesh, |v| (v != 3).then(|| [at(v), Vec3::ZERO]), 1.0);
        // From 4 over 0 to 2 there are 6 sides, in two runs that meet at 0.
        assert_eq!(mesh.positions.len(), (2 * PARTS + 1 + 4 * PARTS + 1) * SIDES + 4);
        assert!(volume_of_closed(&mesh) > 0.0);
        let mut none = Solid::default();
        cord.push(&mut none, |_| None, 1.0);
        assert!(none.positions.is_empty());
    }
}
