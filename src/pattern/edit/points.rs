//! Edits of points and curves of closed lines.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use glam::DVec2;

use crate::geometry::words::{Words, decimal, words};
use crate::pattern::edit::lines::{self, Part, previous};
use crate::pattern::edit::{Change, PointRef, find, symmetric_image};
use crate::pattern::{AllowanceCorner, Edge, EdgeRef, EdgeShape, Pattern, Piece, curve};

/// Angle between two tangents up to which they count as smooth, radians.
const SMOOTH: f64 = 1e-7;

pub(super) fn move_points(pattern: &mut Pattern, moves: &[(PointRef, DVec2)]) -> Result<Change, Words> {
    if moves.is_empty() {
        return Err(words!("no point was named"));
    }
    let mut of_piece: BTreeMap<_, BTreeMap<usize, DVec2>> = BTreeMap::new();
    for (point, to) in moves {
        let piece = find(pattern, point.piece)?;
        point_number(piece, point.point)?;
        let moved = of_piece.entry(point.piece).or_default();
        let n = piece.outline.len();
        let on_axis = piece.symmetric && (point.point == 0 || point.point == n / 2);
        let to = if on_axis { DVec2::new(0.0, to.y) } else { *to };
        moved.insert(point.point, to);
        if piece.symmetric && point.point > n / 2 && point.point < n {
            moved.insert(n - point.point, curve::mirror(to));
        }
    }
    let mut held = BTreeSet::new();
    for (id, moved) in of_piece {
        let piece = find(pattern, id)?;
        let mut places: Vec<DVec2> = (0..piece.edge_count()).map(|i| piece.edge(i).start).collect();
        let mut new = Piece::clone(piece);
        for (&i, &to) in &moved {
            places[i] = to;
            held.insert(EdgeRef { piece: id, edge: i });
        }
        put_all(&mut new, &places);
        new.cut_line.clear();
        for &i in moved.keys() {
            smooth_around(&mut new, i);
        }
        pattern.pieces.insert(id, Arc::new(new));
    }
    let what =
        if moves.len() == 1 { words!("move a point") } else { words!("move {n} points", n = moves.len()) };
    Ok(Change { held, ..Change::new(what) })
}

pub(super) fn set_edge(pattern: &mut Pattern, edge: EdgeRef, shape: EdgeShape) -> Result<Change, Words> {
    let piece = find(pattern, edge.piece)?;
    edge_number(piece, edge.edge)?;
    let (a, b) = piece.edge_ends(edge.edge);
    if let EdgeShape::Arc { radius, .. } = shape
        && radius < a.distance(b) / 2.0 * (1.0 - 1e-9)
    {
        return Err(words!(
            "an arc between points {apart} cm apart has a radius of {radius} cm at least",
            apart = decimal(a.distance(b) * 100.0, 1),
            radius = decimal(a.distance(b) * 50.0, 1)
        ));
    }
    let mut new = Piece::clone(piece);
    new.cut_line.clear();
    let mut set = |edge: usize, shape: EdgeShape| {
        shape_mut(&mut new, edge).shape = shape;
        let (before, behind) = (previous(&new, edge), new.next_edge(edge));
        if new.edge(edge).smooth {
            let leaving = tangents(&new, edge)[0];
            turn_end(&mut new, before, leaving);
        }
        if new.edge(behind).smooth {
            let arriving = tangents(&new, edge)[1];
            turn_start(&mut new, behind, arriving);
        }
    };
    set(edge.edge, shape);
    if let Some(image) = symmetric_image(piece, edge.edge) {
        set(image, shape.reversed().mapped(true, curve::mirror));
    }
    let held = [edge.edge, new.next_edge(edge.edge)].map(|e| EdgeRef { edge: e, ..edge });
    pattern.pieces.insert(edge.piece, Arc::new(new));
    Ok(Change { held: held.into(), ..Change::new(words!("bend an edge")) })
}

pub(super) fn insert(pattern: &mut Pattern, edge: EdgeRef, at: f64) -> Result<Change, Words> {
    let piece = find(pattern, edge.piece)?;
    edge_number(piece, edge.edge)?;
    if !(at > 0.0 && at < 1.0) {
        return Err(words!("a point on an edge lies between its ends"));
    }
    let image = symmetric_image(piece, edge.edge);
    // Split the later edge first, so that the number of the earlier one stays valid.
    let mut sites = vec![(edge.edge, at)];
    sites.extend(image.map(|image| (image, 1.0 - at)));
    sites.sort_by_key(|site| std::cmp::Reverse(site.0));
    for (number, at) in sites {
        lines::insert_points(pattern, EdgeRef { edge: number, ..edge }, &[at]);
    }
    Ok(Change::new(words!("add a point")))
}

pub(super) fn delete(pattern: &mut Pattern, point: PointRef) -> Result<Change, Words> {
    let piece = find(pattern, point.piece)?;
    point_number(piece, point.point)?;
    let n = piece.outline.len();
    let mut sites = vec![point.point];
    if piece.symmetric && point.point < n {
        if point.point == 0 || point.point == n / 2 {
            return Err(words!(
                "this point is the middle of {name}: unlink its halves first",
                name = piece.name
            ));
        }
        sites.push(n - point.point);
    }
    let (k, _) = piece.loop_of(point.point);
    if piece.loop_edges(k).len() < 2 + sites.len() {
        return Err(words!("a closed line needs two points at least"));
    }
    sites.sort_unstable();
    for &site in sites.iter().rev() {
        join(pattern, EdgeRef { piece: point.piece, edge: site });
    }
    Ok(Change::new(words!("take a point away")))
}

/// Joins the two edges that meet at the start of `point` into one.
pub(super) fn join(pattern: &mut Pattern, point: EdgeRef) {
    let Some(piece) = pattern.pieces.get(&point.piece) else { return };
    let before = previous(piece, point.edge);
    let (a, m) = piece.edge_ends(before);
    let (_, b) = piece.edge_ends(point.edge);
    let shapes = [before, point.edge].map(|i| piece.edge(i).shape);
    let lengths = [before, point.edge].map(|i| piece.exact_edge_length(i));
    let shape = joined([a, m, b], shapes);
    let (k, first) = piece.loop_of(point.edge);
    let mut edges = piece.loop_edges(k).clone();
    let n = edges.len();
    let (own, gone) = (before - first, point.edge - first);
    edges[own].shape = shape;
    edges.remove(gone);
    let share = lengths[0] / (lengths[0] + lengths[1]).max(f64::MIN_POSITIVE);
    let kept = if gone < own { own - 1 } else { own };
    let map = (0..n)
        .map(|i| match i {
            _ if i == own => vec![Part { old: [0.0, 1.0], edge: kept, new: [0.0, share] }],
            _ if i == gone => vec![Part { old: [0.0, 1.0], edge: kept, new: [share, 1.0] }],
            _ => vec![Part::whole(if i > gone { i - 1 } else { i })],
        })
        .collect();
    lines::replace(pattern, point.piece, k, edges, &map);
}

/// One curve in place of two that meet, with the same tangents at its ends. Two parts of one curve give that curve again.
fn joined([a, m, b]: [DVec2; 3], [first, second]: [EdgeShape; 2]) -> EdgeShape {
    match (first, second) {
        (EdgeShape::Line, EdgeShape::Line) => return EdgeShape::Line,
        (EdgeShape::Arc { radius, sweep, .. }, EdgeShape::Arc { .. }) => {
            if let (Some(one), Some(other)) = (curve::arc(a, first, m), curve::arc(m, second, b))
                && one.centre.distance(other.centre) < 1e-6 * radius
                && one.turn * other.turn > 0.0
            {
                let large = (one.turn + other.turn).abs() > std::f64::consts::PI;
                return EdgeShape::Arc { radius, large, sweep };
            }
        }
        _ => {}
    }
    let [c, d] = as_cubic(a, first, m);
    let [e, f] = as_cubic(m, second, b);
    let (arriving, leaving) = (m.distance(d), e.distance(m));
    let t = (arriving / (arriving + leaving).max(f64::MIN_POSITIVE)).clamp(0.1, 0.9);
    EdgeShape::Cubic { controls: [a + (c - a) / t, b + (f - b) / (1.0 - t)] }
}

/// The control points of a cubic equal to the curve; for arcs an approximation.
pub(super) fn as_cubic(a: DVec2, shape: EdgeShape, b: DVec2) -> [DVec2; 2] {
    match shape {
        EdgeShape::Line => [a.lerp(b, 1.0 / 3.0), a.lerp(b, 2.0 / 3.0)],
        EdgeShape::Quadratic { control } => [a.lerp(control, 2.0 / 3.0), b.lerp(control, 2.0 / 3.0)],
        EdgeShape::Cubic { controls } => controls,
        EdgeShape::Arc { .. } => match curve::arc(a, shape, b) {
            None => as_cubic(a, EdgeShape::Line, b),
            Some(arc) => {
                // The usual handle length: 4/3 of the tangent of a quarter of the angle, times the radius.
                let handle = arc.radius * (4.0 / 3.0) * (arc.turn / 4.0).tan();
                let way = |angle: f64| DVec2::from_angle(angle).perp() * handle;
                [a + way(arc.start), b - way(arc.start + arc.turn)]
            }
        },
    }
}

pub(super) fn set_smooth(pattern: &mut Pattern, point: PointRef, smooth: bool) -> Result<Change, Words> {
    let piece = find(pattern, point.piece)?;
    point_number(piece, point.point)?;
    let mut new = Piece::clone(piece);
    new.cut_line.clear();
    let n = new.outline.len();
    let mut sites = vec![point.point];
    if piece.symmetric && point.point < n {
        sites.push((n - point.point) % n);
    }
    for site in sites {
        shape_mut(&mut new, site).smooth = smooth;
        if !smooth {
            continue;
        }
        let (before, own) = (previous(&new, site), site);
        let straight = |i: usize| matches!(new.edge(i).shape, EdgeShape::Line);
        if straight(before) && straight(own) {
            for i in [before, own] {
                let (a, b) = new.edge_ends(i);
                let controls = as_cubic(a, EdgeShape::Line, b);
                shape_mut(&mut new, i).shape = EdgeShape::Cubic { controls };
            }
        }
        smooth_point(&mut new, site);
    }
    pattern.pieces.insert(point.piece, Arc::new(new));
    Ok(Change::new(if smooth { words!("make a point smooth") } else { words!("make a corner") }))
}

/// Sets how the seam allowance goes round a point of an outline.
pub(super) fn set_corner(
    pattern: &mut Pattern,
    point: PointRef,
    corner: AllowanceCorner,
) -> Result<Change, Words> {
    let piece = find(pattern, point.piece)?;
    point_number(piece, point.point)?;
    let n = piece.outline.len();
    if point.point >= n {
        return Err(words!("a seam allowance runs round the outline, not round holes"));
    }
    let image = (n - point.point) % n;
    if piece.symmetric && image == point.point && !corner.is_mitre() {
        return Err(words!("on the fold line of a symmetric piece a corner of the allowance stays mitred"));
    }
    let mut new = Piece::clone(piece);
    new.outline[point.point].corner = corner;
    if piece.symmetric && image != point.point {
        new.outline[image].corner = corner.reversed();
    }
    pattern.pieces.insert(point.piece, Arc::new(new));
    Ok(Change::new(words!("change a corner of the allowance")))
}

/// Moves every point to its entry of `places`; curves rotate and scale with their chords.
pub(super) fn put_all(piece: &mut Piece, places: &[DVec2]) {
    let count = piece.edge_count();
    let carried: Vec<EdgeShape> = (0..count)
        .map(|i| {
            let (a, b) = piece.edge_ends(i);
            piece.edge(i).shape.carried([a, b], [places[i], places[piece.next_edge(i)]])
        })
        .collect();
    for i in 0..count {
        let edge = shape_mut(piece, i);
        (edge.start, edge.shape) = (places[i], carried[i]);
    }
}

/// Restores smooth tangents at all smooth points. True where it had to turn one.
pub(super) fn smooth_all(pattern: &mut Pattern) -> bool {
    let mut turned = false;
    for piece in pattern.pieces.values_mut() {
        let count = piece.edge_count();
        for i in (0..count).filter(|&i| piece.edge(i).smooth).collect::<Vec<_>>() {
            if !runs_on(piece, i) {
                turned |= smooth_point(Arc::make_mut(piece), i);
            }
        }
    }
    turned
}

/// Restores smooth tangents at all smooth points of a piece.
pub(super) fn smooth_piece(piece: &mut Piece) {
    for i in 0..piece.edge_count() {
        if piece.edge(i).smooth && !runs_on(piece, i) {
            smooth_point(piece, i);
        }
    }
}

/// Restores smooth tangents at point `i` and its neighbours, where they are smooth points.
pub(super) fn smooth_around(piece: &mut Piece, i: usize) {
    for j in [previous(piece, i), i, piece.next_edge(i)] {
        if piece.edge(j).smooth && !runs_on(piece, j) {
            smooth_point(piece, j);
        }
    }
}

fn runs_on(piece: &Piece, i: usize) -> bool {
    let arriving = tangents(piece, previous(piece, i))[1];
    arriving.angle_to(tangents(piece, i)[0]).abs() <= SMOOTH
}

/// Turns the tangents at a point to a common direction: that of a straight edge or an arc, or half-way between two
/// curves. False where neither edge is a Bézier curve.
fn smooth_point(piece: &mut Piece, i: usize) -> bool {
    let before = previous(piece, i);
    let bends = |p: &Piece, i: usize| {
        matches!(p.edge(i).shape, EdgeShape::Cubic { .. } | EdgeShape::Quadratic { .. })
    };
    let (arriving, leaving) = (tangents(piece, before)[1], tangents(piece, i)[0]);
    let way = match (bends(piece, before), bends(piece, i)) {
        (false, false) => return false,
        (true, false) => leaving,
        (false, true) => arriving,
        (true, true) => (arriving + leaving).try_normalize().unwrap_or(leaving),
    };
    turn_end(piece, before, way);
    turn_start(piece, i, way);
    true
}

/// Unit tangents of edge `i` at its start and its end, in the direction of the edge.
pub(super) fn tangents(piece: &Piece, i: usize) -> [DVec2; 2] {
    let (a, b) = piece.edge_ends(i);
    let shape = piece.edge(i).shape;
    if let Some(arc) = curve::arc(a, shape, b) {
        let way = |angle: f64| DVec2::from_angle(angle).perp() * arc.turn.signum();
        return [way(arc.start), way(arc.start + arc.turn)];
    }
    let [c, d] = as_cubic(a, shape, b);
    let way = |v: DVec2, other: DVec2| v.try_normalize().unwrap_or(other.normalize_or_zero());
    [way(c - a, b - a), way(b - d, b - a)]
}

fn turn_start(piece: &mut Piece, i: usize, way: DVec2) {
    let (a, b) = piece.edge_ends(i);
    let shape = piece.edge(i).shape;
    if matches!(shape, EdgeShape::Cubic { .. } | EdgeShape::Quadratic { .. }) && way != DVec2::ZERO {
        let [c, d] = as_cubic(a, shape, b);
        shape_mut(piece, i).shape = EdgeShape::Cubic { controls: [a + way * a.distance(c), d] };
    }
}

fn turn_end(piece: &mut Piece, i: usize, way: DVec2) {
    let (a, b) = piece.edge_ends(i);
    let shape = piece.edge(i).shape;
    if matches!(shape, EdgeShape::Cubic { .. } | EdgeShape::Quadratic { .. }) && way != DVec2::ZERO {
        let [c, d] = as_cubic(a, shape, b);
        shape_mut(piece, i).shape = EdgeShape::Cubic { controls: [c, b - way * b.distance(d)] };
    }
}

pub(super) fn shape_mut(piece: &mut Piece, i: usize) -> &mut Edge {
    let (k, first) = piece.loop_of(i);
    &mut piece.loop_edges_mut(k)[i - first]
}

pub(super) fn edge_number(piece: &Piece, edge: usize) -> Result<(), Words> {
    if edge < piece.edge_count() {
        return Ok(());
    }
    Err(words!("{name} has no edge {n}", name = piece.name, n = edge.saturating_add(1)))
}

fn point_number(piece: &Piece, point: usize) -> Result<(), Words> {
    if point < piece.edge_count() {
        return Ok(());
    }
    Err(words!("{name} has no point {n}", name = piece.name, n = point.saturating_add(1)))
}
