//! A pattern cut for sewing: edges are split so that every seam joins one whole edge to one whole edge.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::geometry::ids::{PieceId, SeamId};
use crate::geometry::words::{Words, words};
use crate::pattern::wrinkles::EDGES_ACROSS;
use crate::pattern::{
    Edge, EdgeRef, EdgeSeam, Pattern, Piece, Problem, ProblemKind, Seam, Stretch, Wrinkle, curve, naming,
};

/// Distance along an edge within which two places count as one, metres.
const SAME_PLACE: f64 = 1e-4;
/// Distance from the outline within which a line that the mesh follows ends on it, and from a place where an edge is split within
/// which that place is its end, metres.
pub const LINE_TOUCHES: f64 = 2e-3;

/// A pattern with split edges, as the cloth is made from. Where all seams join whole edges already, the pieces are
/// those of the pattern.
#[derive(Clone, Debug, Default)]
pub struct CutPattern {
    /// The pieces of the pattern, their edges split where stretches of seams end.
    pub pieces: BTreeMap<PieceId, Arc<Piece>>,
    /// The seams between whole edges, in the order of their ids and then along the first side. A seam of the pattern
    /// that was split gives several with its id.
    pub seams: Vec<(SeamId, EdgeSeam)>,
    /// The length ratio of each seam that keeps one, as in [`Seam::ratio`].
    pub ratios: BTreeMap<SeamId, f64>,
    /// For each piece with split edges: for each of its edges the edge of the pattern that it is a part of.
    origins: BTreeMap<PieceId, Vec<usize>>,
}

/// A part of an edge: from and to are fractions of the edge's arc length, `length` is in metres.
#[derive(Clone, Copy, Debug)]
struct Portion {
    edge: usize,
    from: f64,
    to: f64,
    length: f64,
}

/// A place on an edge: `at` is a fraction of its arc length, 0..1.
#[derive(Clone, Copy, Debug)]
struct Place {
    edge: usize,
    at: f64,
}

impl CutPattern {
    /// Splits the edges of `pattern`. A seam on a stretch that does not exist is reported as a problem and left out.
    pub fn new(pattern: &Pattern) -> (Self, Vec<Problem>) {
        let mut problems = Vec::new();
        let ratio = |(&id, seam): (&SeamId, &Seam)| Some((id, seam.ratio?));
        let ratios = pattern.seams.iter().filter_map(ratio).collect();
        let mut cut = Self { pieces: pattern.pieces.clone(), ratios, ..Self::default() };
        let mut places: BTreeMap<SeamId, [Vec<Place>; 2]> = BTreeMap::new();
        let seams = closed_seams(pattern);
        let ends = line_ends(pattern);
        let mut splits = unsewn_ends(pattern, &seams, &ends);
        for (&id, seam) in &seams {
            if seam.sides.iter().all(|side| side.whole_edge().is_some() && !is_met(side, &ends)) {
                continue;
            }
            match breaks(pattern, seam, &ends) {
                Ok(found) => {
                    for (side, found) in seam.sides.iter().zip(&found) {
                        for place in found.iter().filter(|place| place.at > 0.0) {
                            splits.entry((side.piece, place.edge)).or_default().push(place.at);
                        }
                    }
                    places.insert(id, found);
                }
                Err(side) => problems.push(Problem {
                    kind: ProblemKind::SeamToNothing,
                    place: id.into(),
                    words: words!(
                        "it sews a stretch of {place}, which is not there; delete or redraw the seam",
                        place = naming::place(pattern, side.first_edge())
                    ),
                }),
            }
        }
        let firsts = cut.split(splits);
        for (&id, seam) in &seams {
            match (seam.sides.map(|side| side.whole_edge()), places.get(&id)) {
                ([Some(one), Some(other)], None) => {
                    let renamed = [one, other].map(|e| EdgeRef { edge: first(&firsts, e), ..e });
                    let seam = EdgeSeam { sides: renamed, same_direction: seam.same_direction };
                    cut.seams.push((id, seam));
                }
                (_, Some(found)) => cut.sew(pattern, id, seam, found, &firsts, &mut problems),
                _ => {}
            }
        }
        (cut, problems)
    }

    /// All seams between whole edges.
    pub fn edge_seams(&self) -> impl Iterator<Item = &EdgeSeam> {
        self.seams.iter().map(|(_, seam)| seam)
    }

    /// The edge of the pattern that a split edge is a part of.
    pub fn origin(&self, edge: EdgeRef) -> EdgeRef {
        let origin = self.origins.get(&edge.piece).and_then(|of_piece| of_piece.get(edge.edge));
        EdgeRef { edge: origin.copied().unwrap_or(edge.edge), ..edge }
    }

    /// Describes an edge by its number in the pattern: "front (piece 1), edge 3".
    pub fn place(&self, edge: EdgeRef) -> Words {
        let edge = self.origin(edge);
        match self.pieces.get(&edge.piece) {
            Some(piece) => {
                words!("{name} ({piece}), edge {n}", name = piece.name, piece = edge.piece, n = edge.edge)
            }
            None => words!("{piece}, edge {n}", piece = edge.piece, n = edge.edge),
        }
    }

    /// Splits edges at fractions of their length. Returns for each edge of the changed pieces its first part and
    /// where its parts start.
    fn split(&mut self, splits: BTreeMap<(PieceId, usize), Vec<f64>>) -> Firsts {
        let mut of_piece: BTreeMap<PieceId, BTreeMap<usize, Vec<f64>>> = BTreeMap::new();
        for ((piece, edge), mut fractions) in splits {
            let length = self.pieces[&piece].edge_length(edge);
            fractions.sort_by(f64::total_cmp);
            fractions.dedup_by(|b, a| (*b - *a) * length < SAME_PLACE);
            of_piece.entry(piece).or_default().insert(edge, fractions);
        }
        let mut firsts = Firsts::new();
        for (id, cuts) in of_piece {
            let mut piece = Piece::clone(&self.pieces[&id]);
            let (mut origin, mut number) = (Vec::new(), 0);
            let of_edges = firsts.entry(id).or_default();
            for k in 0..=piece.holes.len() {
                let edges = std::mem::take(piece.loop_edges_mut(k));
                let mut new: Vec<Edge> = Vec::with_capacity(edges.len() + cuts.len());
                for (i, edge) in edges.iter().enumerate() {
                    let fractions = cuts.get(&number).map_or(&[][..], |f| &f[..]);
                    let mut starts = vec![0.0];
                    starts.extend(fractions);
                    of_edges.push((origin.len(), starts));
                    origin.extend(std::iter::repeat_n(number, fractions.len() + 1));
                    number += 1;
                    if fractions.is_empty() {
                        new.push(edge.clone());
                        continue;
                    }
                    let end = edges[(i + 1) % edges.len()].start;
                    for (start, shape) in curve::split(edge.start, edge.shape, end, fractions) {
                        new.push(Edge { start, shape, ..edge.clone() });
                    }
                }
                *piece.loop_edges_mut(k) = new;
            }
            self.origins.insert(id, origin);
            self.pieces.insert(id, Arc::new(piece));
        }
        firsts
    }

    fn sew(
        &mut self,
        pattern: &Pattern,
        id: SeamId,
        seam: &Seam,
        places: &[Vec<Place>; 2],
        firsts: &Firsts,
        problems: &mut Vec<Problem>,
    ) {
        let side = |k: usize| self.parts(seam.sides[k].piece, &places[k], firsts);
        let (Some(one), Some(mut other)) = (side(0), side(1)) else {
            problems.push(Problem {
                kind: ProblemKind::EdgeSewnTwice,
                place: id.into(),
                words: words!(
                    "part of {place} is sewn a second time; the seam was left out",
                    place = naming::place(pattern, seam.sides[0].first_edge())
                ),
            });
            return;
        };
        if !seam.same_direction {
            other.reverse();
        }
        let same_direction = seam.same_direction;
        let pairs = one.into_iter().zip(other).map(|(a, b)| EdgeSeam { sides: [a, b], same_direction });
        self.seams.extend(pairs.map(|pair| (id, pair)));
    }

    /// The split edges that lead through `places` in order. None where the end of another seam lies between two of them.
    fn parts(&self, piece: PieceId, places: &[Place], firsts: &Firsts) -> Option<Vec<EdgeRef>> {
        let of_piece = &self.pieces[&piece];
        let number = |place: &Place| match firsts.get(&piece) {
            None => place.edge,
            Some(of_edges) => {
                let (first, starts) = &of_edges[place.edge];
                let nearest = (0..starts.len())
                    .min_by(|&a, &b| (starts[a] - place.at).abs().total_cmp(&(starts[b] - place.at).abs()));
                first + nearest.unwrap_or(0)
            }
        };
        let numbers: Vec<usize> = places.iter().map(number).collect();
        let parts: Vec<EdgeRef> =
            numbers[..numbers.len() - 1].iter().map(|&edge| EdgeRef { piece, edge }).collect();
        let follow = numbers.windows(2).all(|w| of_piece.next_edge(w[0]) == w[1]);
        follow.then_some(parts)
    }
}

/// For each edge of a piece with split edges: the number of its first part, and the fractions of its arc length at
/// which its parts start.
type Firsts = BTreeMap<PieceId, Vec<(usize, Vec<f64>)>>;

/// For an edge of a piece the fractions of its arc length at which it is split.
type Splits = BTreeMap<(PieceId, usize), Vec<f64>>;

/// Where lines that the mesh follows end on edges, farther than [`LINE_TOUCHES`] from the ends of the edge and from each other; with
/// a wrinkle also where its rows of points end, so that the edge has points there.
fn line_ends(pattern: &Pattern) -> Splits {
    let mut ends = Splits::new();
    for (&id, piece) in &pattern.pieces {
        for line in piece.lines.iter().filter(|line| line.needs_mesh()) {
            let first = line.edges.first().map(|edge| (edge.start, edge.trims.wrinkle));
            let last = line.edges.last().map(|edge| (line.end, edge.trims.wrinkle));
            for (p, wrinkle) in first.into_iter().chain(last) {
                let near =
                    (0..piece.edge_count()).map(|edge| (edge, curve::nearest(&piece.edge_segments(edge), p)));
                let Some((edge, (at, distance))) = near.min_by(|a, b| a.1.1.total_cmp(&b.1.1)) else {
                    continue;
                };
                if distance > LINE_TOUCHES {
                    continue;
                }
                let length = piece.edge_length(edge);
                for at in rows(wrinkle).map(|beside| at + beside / length) {
                    let inside = at * length > LINE_TOUCHES && (1.0 - at) * length > LINE_TOUCHES;
                    let of_edge = || ends.get(&(id, edge)).into_iter().flatten();
                    let is_new = of_edge().all(|other| (at - other).abs() * length > LINE_TOUCHES);
                    if inside && is_new {
                        ends.entry((id, edge)).or_default().push(at);
                    }
                }
            }
        }
    }
    ends
}

/// Where a line with this wrinkle puts points on the edge that it ends on: how far beside its end, metres. First the end itself.
fn rows(wrinkle: Option<Wrinkle>) -> impl Iterator<Item = f64> {
    let beside = wrinkle.into_iter().flat_map(|wrinkle| {
        let most = (EDGES_ACROSS / 2.0) as i32;
        (1..=most).flat_map(move |k| [1.0, -1.0].map(|side| side * f64::from(k) * wrinkle.row()))
    });
    std::iter::once(0.0).chain(beside)
}

/// The seams as they are sewn: of a zip only what is closed.
fn closed_seams(pattern: &Pattern) -> BTreeMap<SeamId, Seam> {
    let piece = |id: PieceId| pattern.pieces.get(&id).map(|piece| &**piece);
    let closed = |(&id, seam): (&SeamId, &Seam)| Some((id, seam.closed(piece)?));
    pattern.seams.iter().filter_map(closed).collect()
}

/// Those of `ends` that are not on a sewn stretch: where one is, [`breaks`] splits both sides.
fn unsewn_ends(pattern: &Pattern, seams: &BTreeMap<SeamId, Seam>, ends: &Splits) -> Splits {
    let sides = || seams.values().flat_map(|seam| seam.sides);
    let is_sewn = |piece: PieceId, edge: usize, at: f64| {
        sides().filter(|side| side.piece == piece).any(|side| {
            let parts = pattern.pieces.get(&piece).and_then(|of| side.parts(of)).unwrap_or_default();
            parts.into_iter().any(|(of, from, to)| of == edge && at > from && at < to)
        })
    };
    let mut left = Splits::new();
    for (&(piece, edge), all) in ends {
        let unsewn: Vec<f64> = all.iter().copied().filter(|&at| !is_sewn(piece, edge, at)).collect();
        if !unsewn.is_empty() {
            left.insert((piece, edge), unsewn);
        }
    }
    left
}

/// Whether a line ends on one of the edges of a stretch.
fn is_met(side: &Stretch, ends: &Splits) -> bool {
    !ends.is_empty() && ends.contains_key(&(side.piece, side.edge))
}

/// The ends of lines on the portions of a side `total` metres long, as fractions of its length.
fn met(portions: &[Portion], piece: PieceId, ends: &Splits, total: f64) -> Vec<f64> {
    let (mut found, mut before) = (Vec::new(), 0.0);
    for portion in portions {
        let whole = portion.length / (portion.to - portion.from);
        let of_edge = ends.get(&(piece, portion.edge)).into_iter().flatten();
        let within = of_edge.filter(|&&at| at > portion.from && at < portion.to);
        found.extend(within.map(|at| (before + (at - portion.from) * whole) / total));
        before += portion.length;
    }
    found
}

fn first(firsts: &Firsts, edge: EdgeRef) -> usize {
    let found = firsts.get(&edge.piece).and_then(|of_edges| of_edges.get(edge.edge));
    found.map_or(edge.edge, |(first, _)| *first)
}

/// The places at which both sides of a seam are split, each side in its own direction, its ends included. Err: the
/// side that does not exist.
fn breaks(pattern: &Pattern, seam: &Seam, ends: &Splits) -> Result<[Vec<Place>; 2], Stretch> {
    let mut sides = Vec::new();
    for side in seam.sides {
        sides.push(portions(pattern, &side).ok_or(side)?);
    }
    let totals = [0, 1].map(|k| sides[k].iter().map(|p| p.length).sum::<f64>());
    let near = SAME_PLACE / totals[0].max(totals[1]);
    let corners = |k: usize| {
        let mut sum = 0.0;
        let mut found: Vec<f64> = Vec::new();
        for portion in &sides[k][..sides[k].len() - 1] {
            sum += portion.length;
            found.push(sum / totals[k]);
        }
        if k == 1 && !seam.same_direction {
            found = found.into_iter().rev().map(|f| 1.0 - f).collect();
        }
        found
    };
    let mut fractions = corners(0);
    for f in corners(1) {
        if fractions.iter().all(|g| (f - g).abs() > near) {
            fractions.push(f);
        }
    }
    for k in 0..2 {
        for f in met(&sides[k], seam.sides[k].piece, ends, totals[k]) {
            let f = if k == 1 && !seam.same_direction { 1.0 - f } else { f };
            let room = LINE_TOUCHES / totals[0].min(totals[1]);
            if f > room && f < 1.0 - room && fractions.iter().all(|g| (f - g).abs() > room) {
                fractions.push(f);
            }
        }
    }
    fractions.sort_by(f64::total_cmp);
    let side = |k: usize| {
        let mut own: Vec<f64> = fractions.clone();
        if k == 1 && !seam.same_direction {
            own = own.into_iter().rev().map(|f| 1.0 - f).collect();
        }
        let piece = &pattern.pieces[&seam.sides[k].piece];
        let mut places = vec![place(piece, sides[k][0].edge, sides[k][0].from)];
        places.extend(own.into_iter().map(|f| at(piece, &sides[k], f * totals[k])));
        let last = sides[k][sides[k].len() - 1];
        places.push(place(piece, last.edge, last.to));
        places
    };
    Ok([side(0), side(1)])
}

/// The place at `along` metres from the start of `portions`.
fn at(piece: &Piece, portions: &[Portion], along: f64) -> Place {
    let mut left = along;
    for portion in portions {
        if left <= portion.length + SAME_PLACE {
            let share = if portion.length > 0.0 { (left / portion.length).clamp(0.0, 1.0) } else { 0.0 };
            return place(piece, portion.edge, portion.from + share * (portion.to - portion.from));
        }
        left -= portion.length;
    }
    let last = portions[portions.len() - 1];
    place(piece, last.edge, last.to)
}

/// A place on an edge, snapped to an end of the edge within [`SAME_PLACE`]; the end of an edge is the start of the next.
fn place(piece: &Piece, edge: usize, at: f64) -> Place {
    let length = piece.edge_length(edge);
    match at {
        _ if at * length < SAME_PLACE => Place { edge, at: 0.0 },
        _ if (1.0 - at) * length < SAME_PLACE => Place { edge: piece.next_edge(edge), at: 0.0 },
        _ => Place { edge, at },
    }
}

/// The parts of edges that a stretch covers. None when the stretch is not on the piece, or has no length.
fn portions(pattern: &Pattern, stretch: &Stretch) -> Option<Vec<Portion>> {
    let piece = pattern.pieces.get(&stretch.piece)?;
    let parts: Vec<Portion> = stretch
        .parts(piece)?
        .into_iter()
        .map(|(edge, from, to)| Portion { edge, from, to, length: piece.edge_length(edge) * (to - from) })
        .collect();
    (parts.iter().map(|p| p.length).sum::<f64>() > SAME_PLACE).then_some(parts)
}
