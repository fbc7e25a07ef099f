//! Measures a garment on a body.

use std::collections::{BTreeMap, BTreeSet};

use crate::cloth::{ClothState, Garment};
use crate::fit::causes::{causes, edges, flat_lengths, smaller, uneased_p99};
use crate::fit::fastenings::fastenings;
use crate::fit::laid::Laid;
use crate::fit::on_body::{BodyIndex, on_body};
use crate::fit::openings::Opening;
use crate::fit::report::{Report, Seams};
use crate::fit::shape;
use crate::fit::verdict::verdict;
use crate::geometry::crossings::self_crossings;
use crate::geometry::ids::{PieceId, SeamId};
use crate::geometry::words::{Words, words};
use crate::pattern::{Pattern, Seam};

/// Largest gap of a closed seam, metres.
pub(super) const CLOSED: f64 = 1e-4;

/// The report of a garment on a body. Same input, same figures, on any number of threads.
pub fn measure(pattern: &Pattern, garment: &Garment, state: &ClothState, body: &BodyIndex<'_>) -> Report {
    let laid = Laid::new(garment, state);
    let tree = laid.mesh.tree();
    let (strain, pieces) = shape::strain_and_pieces(garment, &laid);
    let (interior_edges, folded_edges) = shape::interior_and_folded_edges(&laid);
    let edges = edges(garment, &laid);
    let sits = on_body(&laid, &tree, body, &applied(pattern), flat_lengths(&edges));
    let unmapped = (0..garment.vertex_count).filter(|&v| state.mapped.get(v) != Some(&true)).count();
    let mut report = Report {
        triangles: laid.mesh.triangles.len(),
        vertices: laid.used.len(),
        unmapped_vertices: unmapped,
        not_finite_vertices: not_finite(garment, state),
        strain,
        uneased_p99: uneased_p99(garment, &edges),
        strain_causes: causes(garment, &laid, body, &edges),
        pieces,
        seams: seams(pattern, garment, state),
        open_seams: open_seams(pattern, garment, state),
        fastenings: fastenings(pattern, garment, state),
        vertices_shared_by_pieces: shape::vertices_shared_by_pieces(&laid),
        pieces_in_space: shape::pieces_in_space(&laid),
        pieces_expected: pieces_expected(pattern),
        degenerate_faces: shape::degenerate_faces(&laid),
        interior_edges,
        folded_edges,
        self_crossings: self_crossings(&laid.mesh, &laid.edges, &tree).len(),
        penetration: sits.penetration,
        edges_through_body: sits.edges_through_body,
        body_edges_through_garment: sits.body_edges_through_garment,
        cuts_at_body_overlaps: sits.cuts_at_body_overlaps,
        faces_near_body: sits.faces_near_body,
        flipped_faces: sits.flipped_faces,
        faces_in_folds: sits.faces_in_folds,
        faces_between: sits.faces_between,
        faces_beside: sits.faces_beside,
        clearance: sits.clearance,
        openings: sits.openings,
    };
    // Measuring the body takes longer than all else, so it is done only for garments with faults.
    let is_tight = report.strain_causes.is_tight(report.strain.edges);
    let missed: Vec<Opening> = report.missed_openings().map(|(_, opening)| *opening).collect();
    if (is_tight || !missed.is_empty()) && !verdict(&report).is_empty() {
        report.strain_causes.smaller = smaller(garment, state, body, &missed);
    }
    report
}

fn not_finite(garment: &Garment, state: &ClothState) -> usize {
    (0..garment.vertex_count)
        .filter(|&v| {
            state.mapped.get(v) == Some(&true) && !state.positions.get(v).is_some_and(|p| p.is_finite())
        })
        .count()
}

fn seams(pattern: &Pattern, garment: &Garment, state: &ClothState) -> Seams {
    let mut found = Seams::default();
    for gap in garment.seam_pairs.iter().filter_map(|(_, pairs)| widest_gap(garment, state, pairs)) {
        found.max_gap = found.max_gap.max(gap);
        found.closed += usize::from(gap <= CLOSED);
    }
    let sewn = pattern.seams.values().filter(|seam| !is_wide_open(seam)).count();
    found.open = sewn.max(garment.seam_pairs.len()) - found.closed;
    found
}

/// Whether a seam is a zip that is open from end to end: its sides are not sewn.
fn is_wide_open(seam: &Seam) -> bool {
    seam.zip.is_some_and(|zip| zip.closed().is_none())
}

/// Names such as "seam 2 (front and back)" of the pattern's seams that are open anywhere.
fn open_seams(pattern: &Pattern, garment: &Garment, state: &ClothState) -> Vec<Words> {
    let holds = |pairs: &[[u32; 2]]| widest_gap(garment, state, pairs).is_some_and(|gap| gap <= CLOSED);
    let is_closed = |id: &SeamId| {
        let mut parts = garment.seam_pairs.iter().filter(|(of, _)| of == id).peekable();
        parts.peek().is_some() && parts.all(|(_, pairs)| holds(pairs))
    };
    let name = |id: PieceId| pattern.pieces.get(&id).map_or_else(|| id.into(), |p| Words::plain(&*p.name));
    let open = pattern.seams.iter().filter(|(id, seam)| !is_wide_open(seam) && !is_closed(id));
    open.map(|(&seam, Seam { sides: [one, other], .. })| {
        words!("{seam} ({one} and {other})", seam, one = name(one.piece), other = name(other.piece))
    })
    .collect()
}

/// Largest gap of a seam, metres; None when one of its points has no position.
pub(super) fn widest_gap(garment: &Garment, state: &ClothState, pairs: &[[u32; 2]]) -> Option<f64> {
    pairs.iter().try_fold(0.0, |widest: f64, pair| {
        let [a, b] = pair.map(|c| garment.corners[c as usize].vertex as usize);
        let lie = [a, b].iter().all(|&v| state.mapped.get(v) == Some(&true));
        let gap = state.positions.get(a)?.distance(*state.positions.get(b)?);
        (lie && gap.is_finite()).then_some(widest.max(gap))
    })
}

/// Number of groups of pieces that the seams join.
fn pieces_expected(pattern: &Pattern) -> usize {
    groups(pattern).iter().filter(|(id, g)| id == g).count()
}

/// For each piece the lowest id of the pieces that the seams join it to; without deactivated pieces.
pub(super) fn groups(pattern: &Pattern) -> BTreeMap<PieceId, PieceId> {
    let mut group: BTreeMap<PieceId, PieceId> = {
        let pieces = pattern.pieces.iter().filter(|(_, piece)| !piece.activity.is_deactivated());
        pieces.map(|(&id, _)| (id, id)).collect()
    };
    for seam in pattern.seams.values().filter(|seam| !is_wide_open(seam)) {
        let [Some(&a), Some(&b)] = seam.sides.map(|side| group.get(&side.piece)) else { continue };
        let (low, high) = (a.min(b), a.max(b));
        for g in group.values_mut().filter(|g| **g == high) {
            *g = low;
        }
    }
    group
}

/// Pieces that seams join to others only as a part that is tacked on to the rest, as a bow is.
fn applied(pattern: &Pattern) -> BTreeSet<PieceId> {
    let groups = groups(pattern);
    let tacked = pattern.buttons.values().filter(|button| button.tack && !button.open);
    let parts: BTreeSet<PieceId> = tacked
        .filter_map(|tack| {
            let [Some(rest), Some(own)] = tack.pieces().map(|piece| groups.get(&piece)) else { return None };
            (own != rest).then_some(*own)
        })
        .collect();
    groups.into_iter().filter(|(_, group)| parts.contains(group)).map(|(piece, _)| piece).collect()
}

#[cfg(test)]
#[path = "tests.rs"]
mod tests;
