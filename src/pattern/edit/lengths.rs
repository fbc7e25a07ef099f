//! Keeps the length ratios of seams while pieces are edited (paper A, 3.1: "the lengths of connected edges").
//!
//! Curves rotate and scale with their chords, so that the length of an edge is a constant times its chord and the
//! only unknowns are points. The result is the nearest one, by weighted least squares, at which all seams have their
//! ratio: Newton's method on the ratio constraints with steps of least norm.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use faer::Side;
use faer::linalg::solvers::Solve;
use glam::DVec2;

use crate::geometry::ids::{PieceId, SeamId};
use crate::pattern::edit::mirror::{self, Dofs};
use crate::pattern::edit::points;
use crate::pattern::{EdgeRef, Pattern, Piece, Seam, Stretch};

/// Error of a seam's length up to which its ratio counts as met in the solver, metres.
const EQUAL: f64 = 1e-11;
/// Error of a seam's length above which the result is rejected, metres.
const KEPT: f64 = 5e-10;
const MOST_STEPS: usize = 60;
/// Most rounds that alternate between keeping lengths and keeping points smooth.
const MOST_ROUNDS: usize = 12;
/// Mobility (inverse weight) of points on pieces that were not edited and that are not sewn to moved points. Points
/// sewn to moved points have 1.
const BESIDE: f64 = 1e-2;
/// Mobility (inverse weight) of points on an edited piece that were not moved themselves. Points sewn to moved points have 1.
const SAME_PIECE: f64 = 1e-4;
/// Mobility (inverse weight) of points that the person moved. Points sewn to them have 1.
const HELD: f64 = 1e-6;
/// Smallest area of a piece after a step, as a fraction of its area before; a smaller result is rejected.
const SMALLEST_AREA: f64 = 0.2;
/// Longest move of a point in one Newton step, as a multiple of the shortest chord.
const LONGEST_STEP: f64 = 0.5;

/// Moves points until every seam with a ratio has it. `held` are the points that the person moved. Err: a seam whose
/// ratio cannot be reached.
pub(super) fn keep(pattern: &mut Pattern, held: &BTreeSet<EdgeRef>) -> Result<(), SeamId> {
    for round in 0..MOST_ROUNDS {
        solve(pattern, held)?;
        // Smoothing changes lengths, so that the lengths must be solved last.
        if round + 1 == MOST_ROUNDS || !points::smooth_all(pattern) {
            break;
        }
        mirror::mend_all(pattern, &[]);
    }
    mirror::mend_all(pattern, &[]);
    match worst(pattern) {
        Some((seam, error)) if error > KEPT => Err(seam),
        _ => Ok(()),
    }
}

/// The seam with the largest error against its ratio, and that error, metres.
fn worst(pattern: &Pattern) -> Option<(SeamId, f64)> {
    let error = |(&id, seam): (&SeamId, &Seam)| {
        let length = |k: usize| seam.sides[k].length(pattern.pieces.get(&seam.sides[k].piece)?);
        Some((id, (length(0)? - seam.ratio? * length(1)?).abs()))
    };
    pattern.seams.iter().filter_map(error).max_by(|a, b| a.1.total_cmp(&b.1))
}

/// The contribution of an edge to the length of a seam side: its end points, and the signed length per metre of chord.
struct Term {
    ends: [EdgeRef; 2],
    factor: f64,
}

struct Constraint {
    seam: SeamId,
    terms: Vec<Term>,
}

fn solve(pattern: &mut Pattern, held: &BTreeSet<EdgeRef>) -> Result<(), SeamId> {
    let constraints: Vec<Constraint> = pattern
        .seams
        .iter()
        .filter_map(|(&id, seam)| {
            let ratio = seam.ratio?;
            let mut terms = Vec::new();
            side_terms(pattern, &seam.sides[0], 1.0, &mut terms)?;
            side_terms(pattern, &seam.sides[1], -ratio, &mut terms)?;
            Some(Constraint { seam: id, terms })
        })
        .collect();
    let dofs = Dofs::new(pattern);
    let mut x = dofs.start(pattern);
    let error = |x: &[DVec2]| -> Vec<f64> {
        let chord = |t: &Term| dofs.place(x, t.ends[0]).distance(dofs.place(x, t.ends[1]));
        constraints.iter().map(|c| c.terms.iter().map(|t| t.factor * chord(t)).sum()).collect()
    };
    let largest = |e: &[f64]| e.iter().fold(0.0f64, |m, e| m.max(e.abs()));
    let mut now = error(&x);
    if largest(&now) <= EQUAL {
        return Ok(());
    }
    faer::set_global_parallelism(faer::Par::Seq);
    let followers = followers(pattern, held);
    let weights = dofs.weights(|point| weight(held, &followers, point));
    for _ in 0..MOST_STEPS {
        let rows: Vec<BTreeMap<usize, DVec2>> = constraints.iter().map(|c| gradient(c, &dofs, &x)).collect();
        let Some(step) = step(&rows, &weights, &now) else { break };
        let shortest = constraints
            .iter()
            .flat_map(|c| &c.terms)
            .map(|t| dofs.place(&x, t.ends[0]).distance(dofs.place(&x, t.ends[1])))
            .fold(f64::INFINITY, f64::min);
        let longest = step.iter().map(|s| s.length()).fold(0.0, f64::max);
        let mut scale =
            if longest > LONGEST_STEP * shortest { LONGEST_STEP * shortest / longest } else { 1.0 };
        let before = largest(&now);
        let mut better = false;
        for _ in 0..30 {
            let tried: Vec<DVec2> = x.iter().zip(&step).map(|(x, s)| *x + *s * scale).collect();
            let error = error(&tried);
            if largest(&error) < before || largest(&error) <= EQUAL {
                (x, now, better) = (tried, error, true);
                break;
            }
            scale /= 2.0;
        }
        if !better || largest(&now) <= EQUAL {
            break;
        }
    }
    if largest(&now) > 100.0 * EQUAL || x.iter().any(|p| !p.is_finite()) {
        let worst = (0..now.len()).max_by(|&a, &b| now[a].abs().total_cmp(&now[b].abs()));
        return Err(constraints[worst.unwrap_or(0)].seam);
    }
    let before = pattern.clone();
    put(pattern, &dofs, &x);
    // Collapsing a piece also meets the lengths, but nobody wants that.
    let collapsed = |id: &PieceId| {
        let [old, new] = [&before, &*pattern].map(|p| p.pieces[id].signed_area());
        new / old < SMALLEST_AREA
    };
    let changed = |id: &&PieceId| !Arc::ptr_eq(&before.pieces[id], &pattern.pieces[id]);
    match pattern.pieces.keys().filter(changed).find(|id| collapsed(id)) {
        None => Ok(()),
        Some(id) => {
            let of_piece = |c: &&Constraint| c.terms.iter().any(|t| t.ends[0].piece == *id);
            Err(constraints.iter().find(of_piece).unwrap_or(&constraints[0]).seam)
        }
    }
}

/// Newton step of least weighted norm under linearised equality constraints: a move of each degree of freedom that makes
/// the errors `now` vanish to first order. `rows` are the gradients of the constraints. None where the system is singular.
fn step(rows: &[BTreeMap<usize, DVec2>], weights: &[f64], now: &[f64]) -> Option<Vec<DVec2>> {
    let n = rows.len();
    let mut matrix = faer::Mat::<f64>::zeros(n, n);
    for i in 0..n {
        for j in 0..=i {
            let (few, many) =
                if rows[i].len() < rows[j].len() { (&rows[i], &rows[j]) } else { (&rows[j], &rows[i]) };
            let dot = |(dof, g): (&usize, &DVec2)| many.get(dof).map_or(0.0, |h| weights[*dof] * g.dot(*h));
            let sum: f64 = few.iter().map(dot).sum();
            (matrix[(i, j)], matrix[(j, i)]) = (sum, sum);
        }
    }
    // Redundant seams leave the matrix singular: add a little to its diagonal.
    let top = (0..n).map(|i| matrix[(i, i)]).fold(0.0, f64::max);
    for i in 0..n {
        matrix[(i, i)] += matrix[(i, i)] * 1e-13 + top * 1e-15 + f64::MIN_POSITIVE;
    }
    let factor = matrix.llt(Side::Lower).ok()?;
    let right = faer::Mat::<f64>::from_fn(n, 1, |i, _| -now[i]);
    let forces = factor.solve(&right);
    let mut step = vec![DVec2::ZERO; weights.len()];
    for (i, row) in rows.iter().enumerate() {
        for (&dof, &g) in row {
            step[dof] += g * (weights[dof] * forces[(i, 0)]);
        }
    }
    Some(step)
}

/// The points in `held` and those that seams with a ratio tie to them, through any number of seams.
fn followers(pattern: &Pattern, held: &BTreeSet<EdgeRef>) -> BTreeSet<EdgeRef> {
    let ends = |side: &Stretch| -> Option<[Option<EdgeRef>; 2]> {
        let piece = pattern.pieces.get(&side.piece)?;
        let (last, ..) = *side.parts(piece)?.last()?;
        let point = |at_point: bool, edge| at_point.then_some(EdgeRef { piece: side.piece, edge });
        Some([point(side.from == 0.0, side.edge), point(side.to == 1.0, piece.next_edge(last))])
    };
    let mut pairs: Vec<[EdgeRef; 2]> = Vec::new();
    for seam in pattern.seams.values().filter(|seam| seam.ratio.is_some()) {
        let (Some(one), Some(mut other)) = (ends(&seam.sides[0]), ends(&seam.sides[1])) else { continue };
        if !seam.same_direction {
            other.reverse();
        }
        pairs.extend(one.into_iter().zip(other).filter_map(|(a, b)| Some([a?, b?])));
    }
    let mut found = held.clone();
    loop {
        let before = found.len();
        for [a, b] in &pairs {
            if found.contains(a) || found.contains(b) {
                found.extend([*a, *b]);
            }
        }
        if found.len() == before {
            return found;
        }
    }
}

fn weight(held: &BTreeSet<EdgeRef>, followers: &BTreeSet<EdgeRef>, point: EdgeRef) -> f64 {
    if held.contains(&point) {
        return HELD;
    }
    if followers.contains(&point) {
        return 1.0;
    }
    let edited = held.range(EdgeRef { edge: 0, ..point }..).next().is_some_and(|h| h.piece == point.piece);
    if edited { SAME_PIECE } else { BESIDE }
}

fn side_terms(pattern: &Pattern, side: &Stretch, sign: f64, terms: &mut Vec<Term>) -> Option<()> {
    let piece = pattern.pieces.get(&side.piece)?;
    for (edge, from, to) in side.parts(piece)? {
        let (a, b) = piece.edge_ends(edge);
        let chord = a.distance(b);
        if chord > 0.0 {
            let factor = sign * (to - from) * piece.exact_edge_length(edge) / chord;
            let ends = [edge, piece.next_edge(edge)].map(|edge| EdgeRef { piece: side.piece, edge });
            terms.push(Term { ends, factor });
        }
    }
    Some(())
}

fn gradient(constraint: &Constraint, dofs: &Dofs, x: &[DVec2]) -> BTreeMap<usize, DVec2> {
    let mut row = BTreeMap::new();
    for term in &constraint.terms {
        let [a, b] = term.ends.map(|end| dofs.place(x, end));
        let along = (b - a).normalize_or_zero() * term.factor;
        for (end, pull) in [(term.ends[0], -along), (term.ends[1], along)] {
            let (dof, pull) = dofs.pulled(end, pull);
            *row.entry(dof).or_insert(DVec2::ZERO) += pull;
        }
    }
    row
}

/// Moves all points to `x`; curves rotate and scale with their chords.
fn put(pattern: &mut Pattern, dofs: &Dofs, x: &[DVec2]) {
    let ids: Vec<PieceId> = pattern.pieces.keys().copied().collect();
    for id in ids {
        let Some(old) = pattern.pieces.get(&id).cloned() else { continue };
        let count = old.edge_count();
        let places: Vec<DVec2> = (0..count).map(|edge| dofs.place(x, EdgeRef { piece: id, edge })).collect();
        if (0..count).all(|i| places[i] == old.edge(i).start) {
            continue;
        }
        let mut new = Piece::clone(&old);
        points::put_all(&mut new, &places);
        pattern.pieces.insert(id, Arc::new(new));
    }
}
