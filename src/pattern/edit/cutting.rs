//! Cutting pieces in two, darts, and things drawn on a piece: notches, lines and the grainline.

use std::sync::Arc;

use glam::DVec2;

use crate::geometry::ids::{PieceId, SeamId};
use crate::geometry::polygon::{contains, signed_area};
use crate::geometry::words::{Words, decimal, words};
use crate::pattern::edit::lines::{self, fraction_at, halves};
use crate::pattern::edit::pieces::{change, fresh_name};
use crate::pattern::edit::symmetry::loosen;
use crate::pattern::edit::{Carried, Change, find, points, symmetric_image};
use crate::pattern::piece::flattened_loop;
use crate::pattern::{Edge, EdgeRef, GradeRule, InternalLine, Notch, Pattern, Piece, Seam, Stretch, curve};

/// Distance by which an end of a cut may miss the outline, metres.
const NEAR: f64 = 2e-3;
/// Distance within which an end of a cut is snapped to a point of the outline, metres.
const AT_POINT: f64 = 1e-4;
/// Tolerance of the polylines by which curves are checked, metres.
const TOLERANCE: f64 = 1e-4;
/// Smallest width and depth of a dart, metres.
const SMALLEST_DART: f64 = 1e-3;

pub(super) fn cut(
    pattern: &mut Pattern,
    id: PieceId,
    line: &InternalLine,
    sew: bool,
) -> Result<Change, Words> {
    let name = find(pattern, id)?.name.clone();
    let Some(first) = line.edges.first() else { return Err(words!("the cut has no line")) };
    let (from, to) = (first.start, line.end);
    loosen(pattern, id);
    let miss = |_| words!("a cut goes from edge to edge of {name}", name);
    let a = point_on_outline(pattern, id, from).map_err(miss)?;
    let a_place = find(pattern, id)?.edge(a).start;
    let b = point_on_outline(pattern, id, to).map_err(miss)?;
    // Inserting the second point may have changed the number of the first.
    let piece = find(pattern, id)?;
    let a = (0..piece.outline.len()).find(|&i| piece.edge(i).start == a_place).unwrap_or(a);
    let n = piece.outline.len();
    let mut path = line.clone();
    join(&mut path, [piece.edge(a), piece.edge(b)]);
    if a == b || (path.edges.len() == 1 && ((a + 1) % n == b || (b + 1) % n == a) && is_straight(piece, a, b))
    {
        return Err(words!("the cut does not cut {name}", name));
    }
    inside(piece, &path).map_err(|()| words!("the cut leaves {name} between its ends", name))?;
    for point in [a, b] {
        lines::split_seams_at(pattern, EdgeRef { piece: id, edge: point });
    }
    let piece = find(pattern, id)?.clone();
    let run = |from: usize, to: usize| -> Vec<usize> {
        let count = (to + n - from) % n;
        (0..count).map(|k| (from + k) % n).collect()
    };
    let forward: Vec<Edge> = path.edges.clone();
    let m = forward.len();
    let halves = [(run(a, b), backwards(&path)), (run(b, a), forward)];
    let outlines: Vec<Vec<Edge>> = halves
        .iter()
        .map(|(own, closing)| own.iter().map(|&i| piece.outline[i].clone()).chain(closing.clone()).collect())
        .collect();
    let polygons: Vec<Vec<DVec2>> = outlines.iter().map(|o| flattened_loop(o, TOLERANCE)).collect();
    let mut parts: Vec<Piece> = outlines
        .into_iter()
        .map(|outline| Piece {
            outline,
            holes: Vec::new(),
            lines: Vec::new(),
            notches: Vec::new(),
            cut_line: Vec::new(),
            ..Piece::clone(&piece)
        })
        .collect();
    let numbers = share_out(&piece, &halves, &polygons[0], &mut parts);
    let other_name = fresh_name(pattern, &name);
    let mut second = parts.pop().unwrap_or_default();
    second.name = other_name;
    pattern.pieces.insert(id, Arc::new(parts.pop().unwrap_or_default()));
    let other = pattern.add_piece(second);
    let ids = [id, other];
    for seam in pattern.seams.values_mut() {
        for side in seam.sides.iter_mut().filter(|side| side.piece == id) {
            let (part, edge) = numbers[side.edge];
            (side.piece, side.edge) = (ids[part], edge);
        }
    }
    if sew {
        let [one, two] =
            [0, 1].map(|part| Stretch { further: m - 1, ..Stretch::edge(ids[part], halves[part].0.len()) });
        pattern.add_seam(Seam { sides: [one, two], same_direction: false, ratio: Some(1.0), zip: None });
    }
    let carried = [0, 1]
        .map(|part| Carried {
            from: id,
            to: ids[part],
            map: glam::DAffine2::IDENTITY,
            inside: Some(polygons[part].clone()),
        })
        .to_vec();
    Ok(Change { carried, ..Change::new(words!("cut {name}", name)) })
}

/// Makes `path` begin and end exactly at the points where these edges start, with their grade rules.
fn join(path: &mut InternalLine, [from, to]: [&Edge; 2]) {
    (path.edges[0].start, path.end) = (from.start, to.start);
    (path.edges[0].rule, path.end_rule) = (from.rule.clone(), to.rule.clone());
}

/// Distributes edges, holes, lines and notches over the two `parts` of a cut piece. Returns for each old edge its
/// part and its number there. `halves` hold the old edges of each part, `first` is the outline of the first part.
fn share_out(
    piece: &Piece,
    halves: &[(Vec<usize>, Vec<Edge>); 2],
    first: &[DVec2],
    parts: &mut [Piece],
) -> Vec<(usize, usize)> {
    let which = |p: DVec2| usize::from(!contains(first, p));
    let mut numbers: Vec<(usize, usize)> = vec![(0, 0); piece.edge_count()];
    for (part, (own, _)) in halves.iter().enumerate() {
        for (k, &i) in own.iter().enumerate() {
            numbers[i] = (part, k);
        }
    }
    let mut old_first = piece.outline.len();
    for hole in &piece.holes {
        let part = which(hole[0].start);
        let before = parts[part].edge_count();
        for k in 0..hole.len() {
            numbers[old_first + k] = (part, before + k);
        }
        old_first += hole.len();
        parts[part].holes.push(hole.clone());
    }
    for line in &piece.lines {
        parts[which(line.edges[0].start)].lines.push(line.clone());
    }
    for notch in &piece.notches {
        let (part, edge) = numbers[notch.edge];
        parts[part].notches.push(Notch { edge, ..*notch });
    }
    numbers
}

fn is_straight(piece: &Piece, a: usize, b: usize) -> bool {
    let n = piece.outline.len();
    let edge = if (a + 1) % n == b { a } else { b };
    matches!(piece.outline[edge].shape, crate::pattern::EdgeShape::Line)
}

/// The edges of an open line in the opposite direction.
fn backwards(line: &InternalLine) -> Vec<Edge> {
    let n = line.edges.len();
    (0..n)
        .rev()
        .map(|i| Edge {
            start: line.edge_end(i),
            shape: line.edges[i].shape.reversed(),
            rule: line.edges.get(i + 1).map_or(&line.end_rule, |e| &e.rule).clone(),
            ..Edge::default()
        })
        .collect()
}

/// Checks that an open line is on the cloth between its ends, and crosses neither itself nor a closed line of the piece.
fn inside(piece: &Piece, path: &InternalLine) -> Result<(), ()> {
    let points = path.flattened(TOLERANCE);
    let outline = piece.flattened(TOLERANCE);
    let count = points.len();
    let on_cloth = |p: DVec2| {
        contains(&outline, p) && piece.holes.iter().all(|hole| !contains(&flattened_loop(hole, TOLERANCE), p))
    };
    let middles = points.windows(2).map(|w| (w[0] + w[1]) / 2.0);
    if !middles.chain(points[1..count - 1].iter().copied()).all(on_cloth) {
        return Err(());
    }
    let crosses = |a: DVec2, b: DVec2, c: DVec2, d: DVec2| {
        let side = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p);
        side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
    };
    let own = |i: usize| (points[i], points[i + 1]);
    let itself =
        (0..count - 1).any(|i| (i + 2..count - 1).any(|j| crosses(own(i).0, own(i).1, own(j).0, own(j).1)));
    let closed = std::iter::once(outline).chain(piece.holes.iter().map(|h| flattened_loop(h, TOLERANCE)));
    // The path may touch the outline only near its ends.
    let (start, end) = (points[0], points[count - 1]);
    let clear = |p: DVec2| p.distance(start) > 2.0 * TOLERANCE && p.distance(end) > 2.0 * TOLERANCE;
    let meets = closed.into_iter().any(|line| {
        (0..line.len()).any(|k| {
            let (c, d) = (line[k], line[(k + 1) % line.len()]);
            (0..count - 1).any(|i| {
                let (a, b) = own(i);
                crosses(a, b, c, d) && clear(crossing_of(a, b, c, d))
            })
        })
    });
    if itself || meets { Err(()) } else { Ok(()) }
}

fn crossing_of(a: DVec2, b: DVec2, c: DVec2, d: DVec2) -> DVec2 {
    let t = (c - a).perp_dot(d - c) / (b - a).perp_dot(d - c);
    a + (b - a) * t
}

/// The number of the outline's point at `p`, inserted when there is none. Err when the outline is farther than [`NEAR`].
fn point_on_outline(pattern: &mut Pattern, id: PieceId, p: DVec2) -> Result<usize, ()> {
    let piece = pattern.pieces.get(&id).ok_or(())?;
    let near = (0..piece.outline.len()).map(|edge| {
        let (at, distance) = nearest_on_edge(piece, edge, p);
        (edge, at, distance)
    });
    let (edge, at, distance) = near.min_by(|a, b| a.2.total_cmp(&b.2)).ok_or(())?;
    if distance > NEAR {
        return Err(());
    }
    let length = piece.exact_edge_length(edge);
    if at * length < AT_POINT {
        return Ok(edge);
    }
    if (1.0 - at) * length < AT_POINT {
        return Ok(piece.next_edge(edge));
    }
    lines::insert_points(pattern, EdgeRef { piece: id, edge }, &[at]);
    Ok(edge + 1)
}

/// The point of an edge nearest to `p`: the fraction of the edge's arc length, and the distance to `p`, metres.
pub fn nearest_on_edge(piece: &Piece, edge: usize, p: DVec2) -> (f64, f64) {
    curve::nearest(&piece.edge_segments(edge), p)
}

pub(super) fn dart(
    pattern: &mut Pattern,
    edge: EdgeRef,
    at: f64,
    width: f64,
    depth: f64,
) -> Result<Change, Words> {
    let piece = find(pattern, edge.piece)?.clone();
    points::edge_number(&piece, edge.edge)?;
    let length = piece.exact_edge_length(edge.edge);
    let (from, to) = (at - width / 2.0 / length, at + width / 2.0 / length);
    let room = SMALLEST_DART / length;
    if !(width >= SMALLEST_DART && depth >= SMALLEST_DART && from > room && to < 1.0 - room) {
        return Err(words!(
            "a dart {width} cm wide does not fit on an edge of {length} cm there",
            width = decimal(width * 100.0, 1),
            length = decimal(length * 100.0, 1)
        ));
    }
    let image = symmetric_image(&piece, edge.edge);
    let mut sites = vec![(edge.edge, from, to)];
    sites.extend(image.map(|image| (image, 1.0 - to, 1.0 - from)));
    sites.sort_by_key(|site| std::cmp::Reverse(site.0));
    for (number, from, to) in sites {
        one_dart(pattern, EdgeRef { edge: number, ..edge }, from, to, depth)?;
    }
    Ok(Change::new(words!("cut a dart into {name}", name = piece.name)))
}

fn one_dart(pattern: &mut Pattern, edge: EdgeRef, from: f64, to: f64, depth: f64) -> Result<(), Words> {
    lines::insert_points(pattern, edge, &[from, to]);
    let mouth = EdgeRef { edge: edge.edge + 1, ..edge };
    let piece = find(pattern, edge.piece)?.clone();
    let (k, first) = piece.loop_of(mouth.edge);
    let (a, b) = piece.edge_ends(mouth.edge);
    // The cloth is to the left of an outline drawn counter-clockwise; for a hole it is the other way round.
    let ccw = (piece.signed_area() > 0.0) == (k == 0 || hole_runs_as_outline(&piece, k));
    let inward = (b - a).perp().normalize_or_zero() * if ccw { 1.0 } else { -1.0 };
    let tip = (a + b) / 2.0 + inward * depth;
    let outline = piece.flattened(TOLERANCE);
    if !contains(&outline, tip) {
        return Err(words!("the tip of the dart lies outside {name}", name = piece.name));
    }
    // The edge was sewn as a whole: now its two parts are sewn, one after the other, to what it was sewn to.
    let seams: Vec<(SeamId, Seam)> = pattern.seams.iter().map(|(&id, &seam)| (id, seam)).collect();
    for (id, seam) in seams {
        for side in 0..2 {
            let stretch = &seam.sides[side];
            let ends = [mouth.edge, piece.next_edge(mouth.edge)].map(|edge| EdgeRef { edge, ..mouth });
            let [Some(until), Some(on)] = ends.map(|end| fraction_at(pattern, stretch, end)) else {
                continue;
            };
            if let Some([before, behind]) = halves(pattern, &seam, side, until, on) {
                pattern.seams.insert(id, before);
                pattern.add_seam(behind);
            }
        }
    }
    let mut edges = piece.loop_edges(k).clone();
    let own = mouth.edge - first;
    let rules = [own, (own + 1) % edges.len()].map(|i| edges[i].rule.clone());
    let of_tip = GradeRule::between(rules[0].as_ref(), rules[1].as_ref(), 0.5);
    edges[own] = Edge { start: a, rule: rules[0].clone(), ..Edge::default() };
    edges.insert(own + 1, Edge { start: tip, rule: of_tip, ..Edge::default() });
    if let Some(behind) = edges.get_mut(own + 2) {
        behind.smooth = false;
    }
    let map = (0..edges.len() - 1)
        .map(|i| match i {
            _ if i < own => vec![lines::Part::whole(i)],
            _ if i == own => Vec::new(),
            _ => vec![lines::Part::whole(i + 1)],
        })
        .collect();
    lines::replace(pattern, edge.piece, k, edges, &map);
    let legs = [mouth.edge, mouth.edge + 1].map(|edge| Stretch::edge(mouth.piece, edge));
    pattern.add_seam(Seam { sides: legs, same_direction: false, ratio: Some(1.0), zip: None });
    Ok(())
}

/// Whether hole `k` has the same orientation as the outline.
fn hole_runs_as_outline(piece: &Piece, k: usize) -> bool {
    let hole = signed_area(&flattened_loop(piece.loop_edges(k), TOLERANCE));
    // The cloth is to the left of the hole only where the hole runs against the outline.
    hole * piece.signed_area() < 0.0
}

pub(super) fn add_notch(pattern: &mut Pattern, edge: EdgeRef, at: f64) -> Result<Change, Words> {
    let piece = find(pattern, edge.piece)?;
    points::edge_number(piece, edge.edge)?;
    if !(0.0..=1.0).contains(&at) {
        return Err(words!("a notch lies on its edge"));
    }
    let image = symmetric_image(piece, edge.edge).map(|image| Notch { edge: image, at: 1.0 - at });
    change(pattern, edge.piece, |p| {
        p.notches.push(Notch { edge: edge.edge, at });
        p.notches.extend(image);
    });
    Ok(Change::new(words!("add a notch")))
}

pub(super) fn delete_notch(pattern: &mut Pattern, id: PieceId, notch: usize) -> Result<Change, Words> {
    let piece = find(pattern, id)?;
    if notch >= piece.notches.len() {
        return Err(words!("{name} has no notch {n}", name = piece.name, n = notch.saturating_add(1)));
    }
    change(pattern, id, |p| {
        p.notches.remove(notch);
    });
    Ok(Change::new(words!("take a notch away")))
}

pub(super) fn add_line(pattern: &mut Pattern, id: PieceId, line: &InternalLine) -> Result<Change, Words> {
    find(pattern, id)?;
    change(pattern, id, |p| p.lines.push(line.clone()));
    Ok(Change::new(words!("draw a line")))
}

pub(super) fn delete_line(pattern: &mut Pattern, id: PieceId, line: usize) -> Result<Change, Words> {
    let piece = find(pattern, id)?;
    if line >= piece.lines.len() {
        return Err(words!("{name} has no line {n}", name = piece.name, n = line.saturating_add(1)));
    }
    change(pattern, id, |p| {
        p.lines.remove(line);
    });
    Ok(Change::new(words!("take a line away")))
}

pub(super) fn set_grainline(
    pattern: &mut Pattern,
    id: PieceId,
    grainline: Option<[DVec2; 2]>,
) -> Result<Change, Words> {
    let piece = find(pattern, id)?;
    if let Some([tail, head]) = grainline
        && tail.distance(head) < AT_POINT
    {
        return Err(words!("a grainline has two ends"));
    }
    let label = words!("draw the grain of {name}", name = piece.name);
    change(pattern, id, |p| p.grainline = grainline);
    Ok(Change::new(label))
}
