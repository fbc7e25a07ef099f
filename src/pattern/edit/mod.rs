//! What an editor does to a pattern. Pure: a new pattern comes back, or words why not.

mod cutting;
mod holes;
mod lengths;
mod lines;
mod mirror;
mod pieces;
mod points;
mod sewing;
mod symmetry;
mod twists;

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::{DAffine2, DVec2};
use serde::{Deserialize, Serialize};

use crate::geometry::ids::{PieceId, SeamId};
use crate::pattern::activity::Activity;
use crate::pattern::layers::MOST_LAYER;
use crate::pattern::{
    Edge, EdgeRef, EdgeShape, InternalLine, Pattern, Piece, PlanePose, Seam, SpacePose, curve,
};
pub use cutting::nearest_on_edge;
pub use pieces::WIDEST_ALLOWANCE;
pub use sewing::{RATIOS, sound};
pub use twists::{Twists, twists, untwisted};

/// A corner or other point of a closed line: where the edge of the same number starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct PointRef {
    /// The piece.
    pub piece: PieceId,
    /// The edge that starts there, as [`Piece::edge`] counts.
    pub point: usize,
}

/// One change. Places are in the piece's own plane, metres, and absolute: a change given twice changes nothing the second
/// time, but for those that make something new.
///
/// After each change twins and symmetric halves are mirror images again, and every seam with a ratio has it again: points
/// beside those that were moved go as far as they must, the moved ones only where it cannot be had otherwise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PatternEdit {
    /// Put a new piece on the table.
    AddPiece { piece: Arc<Piece> },
    /// Take pieces away with their seams.
    DeletePieces { pieces: Vec<PieceId> },
    /// Copy pieces and the seams among them, moved by `offset` on the table.
    Duplicate { pieces: Vec<PieceId>, offset: DVec2 },
    /// Lay a mirror image of a piece on the table, moved by `offset`, sewn as the piece is where what it is sewn to has an
    /// image; the two stay mirror images.
    AddTwin { piece: PieceId, offset: DVec2 },
    /// Make a piece its own mirror image in the line through two points: what lies left of the line, seen from its first
    /// to its second point, is mirrored over it and replaces what lies right of it.
    MakeSymmetric { piece: PieceId, axis: [DVec2; 2] },
    /// Open a half piece out along a straight edge of its outline, which becomes the middle: it is symmetric from then on.
    Unfold { edge: EdgeRef },
    /// Fold a symmetric piece: only the half left of its middle stays, and its middle becomes an edge.
    Fold { piece: PieceId },
    /// A piece is no longer bound to its twin, nor to its own symmetry.
    Unlink { piece: PieceId },
    /// Lay pieces elsewhere on the table.
    Place { poses: Vec<(PieceId, PlanePose)> },
    /// Stand pieces round the body, or (none) take them from there. They are sewn from where they stand.
    PlaceInSpace { placements: Vec<(PieceId, Option<SpacePose>)> },
    /// Redraw the outline of a piece. A sewn piece keeps its number of edges.
    SetOutline { piece: PieceId, outline: Vec<Edge> },
    /// Scale pieces in their own planes by `factor` (x, y; over 0) about a point of the table.
    Scale { pieces: Vec<PieceId>, about: DVec2, factor: DVec2 },
    /// Give a piece another name.
    Rename { piece: PieceId, name: String },
    /// Lock pieces against the pointer, or not.
    SetLocked { pieces: Vec<PieceId>, locked: bool },
    /// Hide pieces in the pane, or not.
    SetHidden { pieces: Vec<PieceId>, hidden: bool },
    /// Wear pieces on another layer, 0..=15: over all pieces of lower ones. Counts when they are sewn the next time.
    SetLayer { pieces: Vec<PieceId>, layer: u8 },
    /// Freeze pieces where they lie on the body, deactivate them there, or let draping and relaxing move them again.
    SetActivity { pieces: Vec<PieceId>, activity: Activity },

    /// Move points. The curves beside them turn and scale with their chords.
    MovePoints { points: Vec<(PointRef, DVec2)> },
    /// Give an edge another curve. Where its ends are smooth, the tangents of its neighbours follow.
    SetEdge { edge: EdgeRef, shape: EdgeShape },
    /// Put a point on an edge, at a fraction of its arc length inside 0..1. The line stays as it is.
    InsertPoint { edge: EdgeRef, at: f64 },
    /// Take a point away: its two edges become one that starts and ends as they did.
    DeletePoint { point: PointRef },
    /// Make the line run on smoothly at a point, or break there. Straight edges beside a smooth point become curves.
    SetSmooth { point: PointRef, smooth: bool },

    /// Cut a piece in two along a line from edge to edge: a piece's outline is met at the line's ends and not between.
    /// `sew` joins the two again by a seam.
    Cut { piece: PieceId, line: InternalLine, sew: bool },
    /// Cut a dart into an edge: `width` on the edge with its middle at a fraction of the edge's length, its tip `depth`
    /// inside. Its legs are sewn.
    AddDart { edge: EdgeRef, at: f64, width: f64, depth: f64 },
    /// Mark a place of an edge, at a fraction of its arc length.
    AddNotch { edge: EdgeRef, at: f64 },
    /// Take a notch away, by its number from 0.
    DeleteNotch { piece: PieceId, notch: usize },
    /// Draw a line on a piece.
    AddLine { piece: PieceId, line: InternalLine },
    /// Take a line away, by its number from 0.
    DeleteLine { piece: PieceId, line: usize },
    /// Cut a hole into a piece.
    AddHole { piece: PieceId, edges: Vec<Edge> },
    /// Close a hole, by its number from 0, and undo the seams on its edge.
    DeleteHole { piece: PieceId, hole: usize },
    /// Draw the arrow along the warp, from tail to head, or none.
    SetGrainline { piece: PieceId, grainline: Option<[DVec2; 2]> },
    /// Cloth left outside the outline, metres.
    SetAllowance { pieces: Vec<PieceId>, width: f64 },

    /// Sew two stretches. A seam with a ratio gets it at once. Where both have an image, on twins or symmetric halves, and
    /// that is free, it is sewn too; this and the next three do to the image of a seam what they do to the seam.
    Sew { seam: Seam },
    /// Undo seams.
    Unpick { seams: Vec<SeamId> },
    /// Sew stretches the other way round.
    TurnSeam { seam: SeamId },
    /// Keep the first side this many times as long as the second from now on (1: equal), or let either change alone.
    SetRatio { seam: SeamId, ratio: Option<f64> },
    /// Turn over pieces that are drawn from their backs, and turn round every seam that joins the front of one piece to the
    /// back of another.
    UntwistSeams,
}

/// Where places of a piece went.
#[derive(Clone, Debug, PartialEq)]
pub struct Carried {
    /// The piece they were on.
    pub from: PieceId,
    /// The piece they are on.
    pub to: PieceId,
    /// From the old piece's plane to the new one's.
    pub map: DAffine2,
    /// Only those inside this closed polyline of the new plane; all where there is none.
    pub inside: Option<Vec<DVec2>>,
}

impl Carried {
    /// The ways of `first`, then those of `second`.
    pub fn then(first: &[Self], second: Vec<Self>) -> Vec<Self> {
        let untouched = first.iter().filter(|one| second.iter().all(|other| other.from != one.to));
        let mut all: Vec<Self> = untouched.cloned().collect();
        for other in second {
            match first.iter().find(|one| one.to == other.from) {
                Some(one) => all.push(Self { from: one.from, map: other.map * one.map, ..other }),
                None => all.push(other),
            }
        }
        all
    }

    /// The ways from where `before` leads to where `now` leads; both begin at one pattern.
    pub fn since(before: &[Self], now: &[Self]) -> Vec<Self> {
        let back = before.iter().map(|one| Self {
            from: one.to,
            to: one.from,
            map: one.map.inverse(),
            inside: None,
        });
        Self::then(&back.collect::<Vec<_>>(), now.to_vec())
    }
}

/// An edited pattern.
#[derive(Clone, Debug)]
pub struct Edited {
    /// The pattern afterwards.
    pub pattern: Pattern,
    /// For menus: "Undo LABEL".
    pub label: String,
    /// What is drawn on these pieces must be moved; on all others places are what they were.
    pub carried: Vec<Carried>,
}

/// What one change did, before lengths and images are seen to.
struct Change {
    label: String,
    /// Points that were put where they are.
    held: BTreeSet<EdgeRef>,
    carried: Vec<Carried>,
}

impl Change {
    fn new(label: impl Into<String>) -> Self {
        Self { label: label.into(), held: BTreeSet::new(), carried: Vec::new() }
    }
}

/// An edge shorter than this has no length, metres.
const SHORTEST_EDGE: f64 = 1e-5;

/// What `edit` does to `pattern`. Err: why not, for a person.
pub fn apply(pattern: &Pattern, edit: &PatternEdit) -> Result<Edited, String> {
    let mut new = pattern.clone();
    let change = carry_out(&mut new, edit)?;
    let named = pieces_named(edit);
    for twin_edit in named.iter().filter_map(|&id| for_twin(pattern, id, edit)) {
        carry_out(&mut new, &twin_edit)?;
    }
    if let Some(edit) = sewing::for_images(pattern, &new, edit) {
        carry_out(&mut new, &edit)?;
    }
    mirror::mend_all(&mut new, &named);
    lengths::keep(&mut new, &change.held).map_err(|seam| words_for(&new, seam))?;
    for (id, piece) in &new.pieces {
        let same = pattern.pieces.get(id).is_some_and(|old| Arc::ptr_eq(old, piece));
        if !same && (0..piece.edge_count()).any(|i| is_short(piece, i)) {
            return Err(format!("two points of {} would fall together", piece.name));
        }
    }
    Ok(Edited { pattern: new, label: change.label, carried: change.carried })
}

fn is_short(piece: &Piece, edge: usize) -> bool {
    let (a, b) = piece.edge_ends(edge);
    let chord = a.distance(b);
    !chord.is_finite() || chord < SHORTEST_EDGE
}

fn words_for(pattern: &Pattern, id: SeamId) -> String {
    let name = |k: usize| {
        let piece = pattern.seams.get(&id).and_then(|seam| pattern.pieces.get(&seam.sides[k].piece));
        piece.map_or("a piece", |p| &p.name).to_owned()
    };
    format!(
        "the sides of {id} ({} and {}) cannot be kept in their ratio: let its lengths change freely first",
        name(0),
        name(1)
    )
}

fn carry_out(pattern: &mut Pattern, edit: &PatternEdit) -> Result<Change, String> {
    match edit {
        PatternEdit::AddPiece { piece } => Ok(pieces::add(pattern, piece)),
        PatternEdit::DeletePieces { pieces } => pieces::delete(pattern, pieces),
        PatternEdit::Duplicate { pieces, offset } => pieces::duplicate(pattern, pieces, *offset),
        PatternEdit::AddTwin { piece, offset } => symmetry::add_twin(pattern, *piece, *offset),
        PatternEdit::MakeSymmetric { piece, axis } => symmetry::make_symmetric(pattern, *piece, *axis),
        PatternEdit::Unfold { edge } => symmetry::unfold(pattern, *edge),
        PatternEdit::Fold { piece } => symmetry::fold(pattern, *piece),
        PatternEdit::Unlink { piece } => symmetry::unlink(pattern, *piece),
        PatternEdit::Place { poses } => pieces::place(pattern, poses),
        PatternEdit::PlaceInSpace { placements } => pieces::place_in_space(pattern, placements),
        PatternEdit::SetOutline { piece, outline } => pieces::set_outline(pattern, *piece, outline),
        PatternEdit::Scale { pieces, about, factor } => pieces::scale(pattern, pieces, *about, *factor),
        PatternEdit::Rename { piece, name } => pieces::rename(pattern, *piece, name),
        PatternEdit::SetLocked { pieces, locked } => {
            let what = if *locked { "lock" } else { "unlock" };
            pieces::set_all(pattern, pieces, what, |p| p.locked = *locked)
        }
        PatternEdit::SetHidden { pieces, hidden } => {
            let what = if *hidden { "hide" } else { "show" };
            pieces::set_all(pattern, pieces, what, |p| p.hidden = *hidden)
        }
        PatternEdit::SetLayer { pieces, layer } => {
            if *layer > MOST_LAYER {
                return Err(format!("layer {layer} is none: there are 0 to {MOST_LAYER}"));
            }
            pieces::set_all(pattern, pieces, "wear on another layer", |p| p.layer = *layer)
        }
        PatternEdit::SetActivity { pieces, activity } => {
            let what = match activity {
                Activity::Active => "activate",
                Activity::Frozen => "freeze",
                Activity::Deactivated => "deactivate",
            };
            pieces::set_all(pattern, pieces, what, |p| p.activity = *activity)
        }
        PatternEdit::MovePoints { points } => points::move_points(pattern, points),
        PatternEdit::SetEdge { edge, shape } => points::set_edge(pattern, *edge, *shape),
        PatternEdit::InsertPoint { edge, at } => points::insert(pattern, *edge, *at),
        PatternEdit::DeletePoint { point } => points::delete(pattern, *point),
        PatternEdit::SetSmooth { point, smooth } => points::set_smooth(pattern, *point, *smooth),
        PatternEdit::Cut { piece, line, sew } => cutting::cut(pattern, *piece, line, *sew),
        PatternEdit::AddDart { edge, at, width, depth } => cutting::dart(pattern, *edge, *at, *width, *depth),
        PatternEdit::AddNotch { edge, at } => cutting::add_notch(pattern, *edge, *at),
        PatternEdit::DeleteNotch { piece, notch } => cutting::delete_notch(pattern, *piece, *notch),
        PatternEdit::AddLine { piece, line } => cutting::add_line(pattern, *piece, line),
        PatternEdit::DeleteLine { piece, line } => cutting::delete_line(pattern, *piece, *line),
        PatternEdit::AddHole { piece, edges } => holes::add_hole(pattern, *piece, edges),
        PatternEdit::DeleteHole { piece, hole } => holes::delete_hole(pattern, *piece, *hole),
        PatternEdit::SetGrainline { piece, grainline } => cutting::set_grainline(pattern, *piece, *grainline),
        PatternEdit::SetAllowance { pieces, width } => pieces::set_allowance(pattern, pieces, *width),
        PatternEdit::Sew { seam } => sewing::sew(pattern, *seam),
        PatternEdit::Unpick { seams } => sewing::unpick(pattern, seams),
        PatternEdit::TurnSeam { seam } => sewing::turn(pattern, *seam),
        PatternEdit::SetRatio { seam, ratio } => sewing::set_ratio(pattern, *seam, *ratio),
        PatternEdit::UntwistSeams => twists::untwist_all(pattern),
    }
}

/// The pieces whose shape an edit changes, as far as their twins must follow.
fn pieces_named(edit: &PatternEdit) -> Vec<PieceId> {
    match edit {
        PatternEdit::Scale { pieces, .. } | PatternEdit::SetAllowance { pieces, .. } => pieces.clone(),
        PatternEdit::MovePoints { points } => points.iter().map(|(point, _)| point.piece).collect(),
        PatternEdit::SetEdge { edge, .. }
        | PatternEdit::InsertPoint { edge, .. }
        | PatternEdit::AddDart { edge, .. }
        | PatternEdit::AddNotch { edge, .. } => vec![edge.piece],
        PatternEdit::DeletePoint { point } | PatternEdit::SetSmooth { point, .. } => vec![point.piece],
        PatternEdit::DeleteNotch { piece, .. }
        | PatternEdit::AddLine { piece, .. }
        | PatternEdit::DeleteLine { piece, .. }
        | PatternEdit::AddHole { piece, .. }
        | PatternEdit::DeleteHole { piece, .. }
        | PatternEdit::SetGrainline { piece, .. }
        | PatternEdit::SetOutline { piece, .. } => vec![*piece],
        _ => Vec::new(),
    }
}

/// The same change on the twin of `id`, where it changes how edges are numbered.
fn for_twin(before: &Pattern, id: PieceId, edit: &PatternEdit) -> Option<PatternEdit> {
    let piece = before.pieces.get(&id)?;
    let twin = piece.twin?;
    let image = |edge: &EdgeRef| {
        (edge.edge < piece.edge_count())
            .then(|| EdgeRef { piece: twin, edge: mirror::image_edge(piece, edge.edge) })
    };
    Some(match edit {
        PatternEdit::InsertPoint { edge, at } => {
            PatternEdit::InsertPoint { edge: image(edge)?, at: 1.0 - at }
        }
        PatternEdit::AddDart { edge, at, width, depth } => {
            PatternEdit::AddDart { edge: image(edge)?, at: 1.0 - at, width: *width, depth: *depth }
        }
        PatternEdit::DeletePoint { point } => PatternEdit::DeletePoint {
            point: PointRef { piece: twin, point: mirror::image_point(piece, point.point) },
        },
        PatternEdit::DeleteHole { hole, .. } => PatternEdit::DeleteHole { piece: twin, hole: *hole },
        _ => return None,
    })
}

/// The image of an edge of a symmetric piece's outline.
fn symmetric_image(piece: &Piece, edge: usize) -> Option<usize> {
    let n = piece.outline.len();
    (piece.symmetric && edge < n).then(|| n - 1 - edge)
}

fn find(pattern: &Pattern, id: PieceId) -> Result<&Arc<Piece>, String> {
    pattern.pieces.get(&id).ok_or_else(|| format!("there is no {id}"))
}

/// Whether a closed line is its own mirror image as [`Piece::symmetric`] asks, to the last bit.
pub fn is_symmetric(edges: &[Edge]) -> bool {
    let half = edges.len() / 2;
    let drawn = |e: &Edge| (e.start, e.shape, e.smooth);
    !edges.is_empty()
        && edges.len().is_multiple_of(2)
        && edges[0].start.x == 0.0
        && edges[half].start.x == 0.0
        && curve::mirrored(edges).iter().map(drawn).eq(edges.iter().map(drawn))
}
