//! Edits of a pattern. Pure functions: they return a new pattern, or a message that says why not.

mod cutting;
mod fastenings;
pub(in crate::pattern) mod grading;
mod holes;
mod internal_lines;
mod labels;
mod lengths;
mod lines;
mod mirror;
mod pieces;
mod points;
mod sewing;
mod symmetry;
mod trims;
mod twists;

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::{DAffine2, DVec2};
use serde::{Deserialize, Serialize};

use crate::geometry::ids::{ButtonId, PieceId, SeamId};
use crate::geometry::words::{Words, words};
use crate::pattern::activity::Activity;
use crate::pattern::{
    AllowanceCorner, Bow, Button, Edge, EdgeRef, EdgeShape, Elastic, Fold, GradeRule, Hem, InternalLine,
    Pattern, Piece, PiecePoint, Piping, PlanePose, RulePoint, Seam, SizeRun, SpacePose, Topstitch, Wrinkle,
    Zip, curve,
};
pub use cutting::nearest_on_edge;
pub use fastenings::MOST_BUTTONS;
pub use pieces::WIDEST_ALLOWANCE;
pub use sewing::{RATIOS, sound};
pub use trims::TrimLine;
pub use twists::{Twists, twists, untwisted};

/// A point of a closed line: the start of the edge with the same number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct PointRef {
    /// The piece.
    pub piece: PieceId,
    /// The edge that starts at the point, as [`Piece::edge`] counts.
    pub point: usize,
}

/// A point of an internal line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LinePoint {
    /// The piece.
    pub piece: PieceId,
    /// The internal line, from 0.
    pub line: usize,
    /// The edge of the line that starts at the point; on a line of n edges point n is its end.
    pub point: usize,
}

impl From<PointRef> for RulePoint {
    fn from(PointRef { piece, point }: PointRef) -> Self {
        Self { piece, line: None, point }
    }
}

impl From<LinePoint> for RulePoint {
    fn from(LinePoint { piece, line, point }: LinePoint) -> Self {
        Self { piece, line: Some(line), point }
    }
}

/// One edit. Positions are in the piece's own plane, metres, and absolute: an edit applied twice has no effect the
/// second time, unless it adds something new.
///
/// After each edit twins and symmetric halves are mirror images again, and every seam with a ratio has it again: points
/// near the moved ones move as far as needed; the moved points themselves only where it is not possible otherwise.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PatternEdit {
    /// Add a new piece to the table.
    AddPiece { piece: Arc<Piece> },
    /// Delete pieces and their seams.
    DeletePieces { pieces: Vec<PieceId> },
    /// Copy pieces and the seams among them, moved by `offset` on the table.
    Duplicate { pieces: Vec<PieceId>, offset: DVec2 },
    /// Add a mirror image of a piece, moved by `offset` on the table, which is kept its twin. The seams of the piece
    /// are copied where their other side has an image too.
    AddTwin { piece: PieceId, offset: DVec2 },
    /// Make a piece symmetric about the line through two points: the part left of the line, seen from the first point
    /// to the second, is mirrored and replaces the part right of it.
    MakeSymmetric { piece: PieceId, axis: [DVec2; 2] },
    /// Unfold a half piece along a straight edge of its outline, which becomes the axis of symmetry.
    Unfold { edge: EdgeRef },
    /// Fold a symmetric piece: only the half left of its axis stays, and the axis becomes an edge.
    Fold { piece: PieceId },
    /// Unlink a piece from its twin and from its own symmetry.
    Unlink { piece: PieceId },
    /// Move, rotate or flip pieces on the table.
    Place { poses: Vec<(PieceId, PlanePose)> },
    /// Set the placements of pieces round the body, from which they are sewn, or remove them (None).
    PlaceInSpace { placements: Vec<(PieceId, Option<SpacePose>)> },
    /// Redraw the outline of a piece. A sewn piece must keep its number of edges.
    SetOutline { piece: PieceId, outline: Vec<Edge> },
    /// Scale pieces in their own planes by `factor` (x and y, more than 0) about a point of the table.
    Scale { pieces: Vec<PieceId>, about: DVec2, factor: DVec2 },
    /// Rename a piece.
    Rename { piece: PieceId, name: String },
    /// Lock pieces against the pointer, or unlock them.
    SetLocked { pieces: Vec<PieceId>, locked: bool },
    /// Hide pieces in the pattern pane, or show them.
    SetHidden { pieces: Vec<PieceId>, hidden: bool },
    /// Set the layer of pieces, 0..=15: they are worn over all pieces of lower layers. Takes effect when they are
    /// sewn the next time.
    SetLayer { pieces: Vec<PieceId>, layer: u8 },
    /// Freeze or deactivate pieces where they are on the body, or let draping and relaxing move them again.
    SetActivity { pieces: Vec<PieceId>, activity: Activity },

    /// Move points. The curves beside them rotate and scale with their chords.
    MovePoints { points: Vec<(PointRef, DVec2)> },
    /// Set the curve of an edge. Where its ends are smooth, the tangents of its neighbours follow.
    SetEdge { edge: EdgeRef, shape: EdgeShape },
    /// Insert a point on an edge, at a fraction of its arc length inside 0..1. The line keeps its shape.
    InsertPoint { edge: EdgeRef, at: f64 },
    /// Delete a point: its two edges become one with the same tangents at its ends.
    DeletePoint { point: PointRef },
    /// Make the line smooth at a point, or let it have a corner there. Straight edges beside a smooth point become curves.
    SetSmooth { point: PointRef, smooth: bool },

    /// Cut a piece in two along a line that touches the outline at its ends and nowhere between. `sew` joins the two
    /// parts again by a seam.
    Cut { piece: PieceId, line: InternalLine, sew: bool },
    /// Cut a dart into an edge: `width` (m) along the edge, its middle at a fraction of the edge's length, its tip
    /// `depth` (m) inside. Its legs are sewn together.
    AddDart { edge: EdgeRef, at: f64, width: f64, depth: f64 },
    /// Add a notch to an edge, at a fraction of its arc length.
    AddNotch { edge: EdgeRef, at: f64 },
    /// Delete a notch, by its number from 0.
    DeleteNotch { piece: PieceId, notch: usize },
    /// Add an internal line to a piece.
    AddLine { piece: PieceId, line: InternalLine },
    /// Delete an internal line, by its number from 0.
    DeleteLine { piece: PieceId, line: usize },
    /// Move points of internal lines. The curves beside them rotate and scale with their chords.
    MoveLinePoints { points: Vec<(LinePoint, DVec2)> },
    /// Insert a point on the edge of an internal line that starts at `edge`, at a fraction of its arc length inside 0..1. The
    /// line keeps its shape.
    InsertLinePoint { edge: LinePoint, at: f64 },
    /// Delete a point of an internal line: two edges become one with the same tangents at its ends; at an end an edge goes.
    DeleteLinePoint { point: LinePoint },
    /// Make an internal line smooth at a point between its ends, or let it have a corner there. Straight edges beside a smooth
    /// point become curves.
    SetLineSmooth { point: LinePoint, smooth: bool },
    /// Cut a hole into a piece.
    AddHole { piece: PieceId, edges: Vec<Edge> },
    /// Close a hole, by its number from 0, and remove the seams on its edges.
    DeleteHole { piece: PieceId, hole: usize },
    /// Set the grainline, from tail to head of the arrow, or remove it.
    SetGrainline { piece: PieceId, grainline: Option<[DVec2; 2]> },
    /// Set the seam allowance, metres.
    SetAllowance { pieces: Vec<PieceId>, width: f64 },
    /// Set how the seam allowance goes round a point of an outline. The image of the point on a twin or the other half follows.
    SetCorner { point: PointRef, corner: AllowanceCorner },

    /// Crease edges or internal lines, or (None) let them be flat.
    SetFold { lines: Vec<TrimLine>, fold: Option<Fold> },
    /// Sew elastic along edges or internal lines, or (None) take it off.
    SetElastic { lines: Vec<TrimLine>, elastic: Option<Elastic> },

    /// Topstitch edges or internal lines, or (None) unpick that.
    SetTopstitch { lines: Vec<TrimLine>, topstitch: Option<Topstitch> },
    /// Hem edges, or (None) unpick the hem.
    SetHem { lines: Vec<TrimLine>, hem: Option<Hem> },
    /// Sew piping in along edges or internal lines, or (None) take it out.
    SetPiping { lines: Vec<TrimLine>, piping: Option<Piping> },
    /// Raise cloth to a wrinkle along internal lines, or (None) smooth it out.
    SetWrinkle { lines: Vec<TrimLine>, wrinkle: Option<Wrinkle> },

    /// Tack a bow to a place of a piece ([`Pattern::add_bow`]).
    AddBow { at: PiecePoint, bow: Bow },
    /// Sew on buttons, each with its buttonhole.
    AddButtons { buttons: Vec<Button> },
    /// Change place, size, colour or state of a button.
    SetButton { id: ButtonId, button: Button },
    /// Take buttons off.
    DeleteButtons { buttons: Vec<ButtonId> },
    /// Fasten buttons, or unfasten them.
    Fasten { buttons: Vec<ButtonId>, fastened: bool },
    /// Put a zip into a seam, open or close it, or (None) take it out: the seam is then sewn.
    SetZip { seam: SeamId, zip: Option<Zip> },

    /// Sew two stretches. A seam with a ratio reaches it at once. The mirror image of the seam, on twins or symmetric
    /// halves, is sewn too where its stretches are free. This edit and the next three apply to the image of a seam as well.
    Sew { seam: Seam },
    /// Delete seams.
    Unpick { seams: Vec<SeamId> },
    /// Reverse the direction in which the stretches of a seam are joined.
    TurnSeam { seam: SeamId },
    /// Keep the length of the first side this many times that of the second from now on (1: equal), or (None) let
    /// either side change alone.
    SetRatio { seam: SeamId, ratio: Option<f64> },
    /// Turn over pieces that are drawn from their backs, then reverse every seam that still joins the front of one
    /// piece to the back of another.
    UntwistSeams,

    /// Set the sizes of the pattern. Rules keep what they say of sizes of the same name, or where no name stays, of those as far
    /// from the base; new sizes go on in even steps. What is drawn is then the new base size. No sizes: all rules go.
    SetSizes { sizes: SizeRun },
    /// Set or remove (None) the grade rules of points. The images of points on twins and symmetric halves follow.
    SetRules { rules: Vec<(RulePoint, Option<GradeRule>)> },
}

impl PatternEdit {
    /// Makes a closed or an internal line smooth at a point, or lets it have a corner there.
    pub fn smooth_at(at: RulePoint, smooth: bool) -> Self {
        let RulePoint { piece, line, point } = at;
        match line {
            None => Self::SetSmooth { point: PointRef { piece, point }, smooth },
            Some(line) => Self::SetLineSmooth { point: LinePoint { piece, line, point }, smooth },
        }
    }
}

/// How points of a piece moved in an edit, so that what is drawn there can follow.
#[derive(Clone, Debug, PartialEq)]
pub struct Carried {
    /// The piece on which the points were.
    pub from: PieceId,
    /// The piece on which the points are now.
    pub to: PieceId,
    /// Maps points from the old piece's plane to the new one's.
    pub map: DAffine2,
    /// Closed polyline in the new plane: only points that arrive inside it moved this way. None: all points.
    pub inside: Option<Vec<DVec2>>,
}

impl Carried {
    /// The moves of `first` followed by those of `second`.
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

    /// The moves from the result of `before` to the result of `now`; both start from the same pattern.
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

/// The result of an edit.
#[derive(Clone, Debug)]
pub struct Edited {
    /// The pattern afterwards.
    pub pattern: Pattern,
    /// Name of the edit for menus: "Undo LABEL".
    pub label: Words,
    /// How points moved. On pieces that are not listed they stayed where they were.
    pub carried: Vec<Carried>,
}

/// The result of one edit before seam lengths and mirror images are restored.
struct Change {
    label: Words,
    /// Points that the person moved.
    held: BTreeSet<EdgeRef>,
    carried: Vec<Carried>,
}

impl Change {
    fn new(label: Words) -> Self {
        Self { label, held: BTreeSet::new(), carried: Vec::new() }
    }
}

/// Length below which an edge counts as collapsed, metres.
const SHORTEST_EDGE: f64 = 1e-5;

/// Applies `edit` to `pattern`. Err: why not, for a person.
pub fn apply(pattern: &Pattern, edit: &PatternEdit) -> Result<Edited, Words> {
    let mut new = pattern.clone();
    let change = carry_out(&mut new, edit)?;
    fastenings::carry(&mut new, &change.carried);
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
            return Err(words!("two points of {name} would fall together", name = piece.name));
        }
    }
    Ok(Edited { pattern: new, label: change.label, carried: change.carried })
}

fn is_short(piece: &Piece, edge: usize) -> bool {
    let (a, b) = piece.edge_ends(edge);
    let chord = a.distance(b);
    !chord.is_finite() || chord < SHORTEST_EDGE
}

fn words_for(pattern: &Pattern, id: SeamId) -> Words {
    let name = |k: usize| {
        let piece = pattern.seams.get(&id).and_then(|seam| pattern.pieces.get(&seam.sides[k].piece));
        piece.map_or_else(|| words!("a piece"), |p| Words::plain(&*p.name))
    };
    words!(
        "the sides of {id} ({one} and {other}) cannot be kept in their ratio: let its lengths change freely first",
        id,
        one = name(0),
        other = name(1)
    )
}

fn carry_out(pattern: &mut Pattern, edit: &PatternEdit) -> Result<Change, Words> {
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
        PatternEdit::SetLocked { pieces, locked } => pieces::set_locked(pattern, pieces, *locked),
        PatternEdit::SetHidden { pieces, hidden } => {
            let what = if *hidden { labels::HIDE } else { labels::SHOW };
            pieces::set_all(pattern, pieces, what, |p| p.hidden = *hidden)
        }
        PatternEdit::SetLayer { pieces, layer } => pieces::set_layer(pattern, pieces, *layer),
        PatternEdit::SetActivity { pieces, activity } => pieces::set_activity(pattern, pieces, *activity),
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
        PatternEdit::MoveLinePoints { points } => internal_lines::move_points(pattern, points),
        PatternEdit::InsertLinePoint { edge, at } => internal_lines::insert(pattern, *edge, *at),
        PatternEdit::DeleteLinePoint { point } => internal_lines::delete(pattern, *point),
        PatternEdit::SetLineSmooth { point, smooth } => internal_lines::set_smooth(pattern, *point, *smooth),
        PatternEdit::AddHole { piece, edges } => holes::add_hole(pattern, *piece, edges),
        PatternEdit::DeleteHole { piece, hole } => holes::delete_hole(pattern, *piece, *hole),
        PatternEdit::SetGrainline { piece, grainline } => cutting::set_grainline(pattern, *piece, *grainline),
        PatternEdit::SetAllowance { pieces, width } => pieces::set_allowance(pattern, pieces, *width),
        PatternEdit::SetCorner { point, corner } => points::set_corner(pattern, *point, *corner),
        PatternEdit::SetFold { lines, fold } => {
            let what = if fold.is_some() { words!("fold") } else { words!("unfold a crease") };
            trims::set(pattern, lines, what, |trims| trims.fold = *fold)
        }
        PatternEdit::SetElastic { lines, elastic } => {
            let what = if elastic.is_some() { words!("sew on elastic") } else { words!("take elastic off") };
            trims::set(pattern, lines, what, |trims| trims.elastic = *elastic)
        }
        PatternEdit::SetTopstitch { lines, topstitch } => {
            let what = if topstitch.is_some() { words!("topstitch") } else { words!("unpick topstitching") };
            trims::set(pattern, lines, what, |trims| trims.topstitch = *topstitch)
        }
        PatternEdit::SetHem { lines, hem } => {
            let what = if hem.is_some() { words!("hem") } else { words!("unpick a hem") };
            trims::set(pattern, lines, what, |trims| trims.hem = *hem)
        }
        PatternEdit::SetPiping { lines, piping } => {
            let what = if piping.is_some() { words!("sew piping in") } else { words!("take piping out") };
            trims::set(pattern, lines, what, |trims| trims.piping = *piping)
        }
        PatternEdit::SetWrinkle { lines, wrinkle } => trims::set_wrinkle(pattern, lines, *wrinkle),
        PatternEdit::AddBow { at, bow } => pieces::add_bow(pattern, *at, bow),
        PatternEdit::AddButtons { buttons } => fastenings::add_buttons(pattern, buttons),
        PatternEdit::SetButton { id, button } => fastenings::set_button(pattern, *id, button),
        PatternEdit::DeleteButtons { buttons } => fastenings::delete_buttons(pattern, buttons),
        PatternEdit::Fasten { buttons, fastened } => fastenings::fasten(pattern, buttons, *fastened),
        PatternEdit::SetZip { seam, zip } => fastenings::set_zip(pattern, *seam, *zip),
        PatternEdit::Sew { seam } => sewing::sew(pattern, *seam),
        PatternEdit::Unpick { seams } => sewing::unpick(pattern, seams),
        PatternEdit::TurnSeam { seam } => sewing::turn(pattern, *seam),
        PatternEdit::SetRatio { seam, ratio } => sewing::set_ratio(pattern, *seam, *ratio),
        PatternEdit::UntwistSeams => twists::untwist_all(pattern),
        PatternEdit::SetSizes { sizes } => grading::set_sizes(pattern, sizes),
        PatternEdit::SetRules { rules } => grading::set_rules(pattern, rules),
    }
}

/// The pieces whose shape an edit changes, so that their twins must follow.
fn pieces_named(edit: &PatternEdit) -> Vec<PieceId> {
    match edit {
        PatternEdit::Scale { pieces, .. } | PatternEdit::SetAllowance { pieces, .. } => pieces.clone(),
        PatternEdit::MovePoints { points } => points.iter().map(|(point, _)| point.piece).collect(),
        PatternEdit::MoveLinePoints { points } => points.iter().map(|(point, _)| point.piece).collect(),
        PatternEdit::InsertLinePoint { edge: point, .. }
        | PatternEdit::DeleteLinePoint { point }
        | PatternEdit::SetLineSmooth { point, .. } => vec![point.piece],
        PatternEdit::SetRules { rules } => rules.iter().map(|(point, _)| point.piece).collect(),
        PatternEdit::SetEdge { edge, .. }
        | PatternEdit::InsertPoint { edge, .. }
        | PatternEdit::AddDart { edge, .. }
        | PatternEdit::AddNotch { edge, .. } => vec![edge.piece],
        PatternEdit::DeletePoint { point }
        | PatternEdit::SetSmooth { point, .. }
        | PatternEdit::SetCorner { point, .. } => vec![point.piece],
        PatternEdit::DeleteNotch { piece, .. }
        | PatternEdit::AddLine { piece, .. }
        | PatternEdit::DeleteLine { piece, .. }
        | PatternEdit::AddHole { piece, .. }
        | PatternEdit::DeleteHole { piece, .. }
        | PatternEdit::SetGrainline { piece, .. }
        | PatternEdit::SetOutline { piece, .. } => vec![*piece],
        PatternEdit::SetFold { lines, .. }
        | PatternEdit::SetElastic { lines, .. }
        | PatternEdit::SetTopstitch { lines, .. }
        | PatternEdit::SetHem { lines, .. }
        | PatternEdit::SetPiping { lines, .. }
        | PatternEdit::SetWrinkle { lines, .. } => lines.iter().map(TrimLine::piece).collect(),
        _ => Vec::new(),
    }
}

/// The same edit on the twin of `id`, for edits that change the numbering of edges; None for the others.
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

/// The mirror image of an edge of a symmetric piece's outline.
fn symmetric_image(piece: &Piece, edge: usize) -> Option<usize> {
    let n = piece.outline.len();
    (piece.symmetric && edge < n).then(|| n - 1 - edge)
}

fn find(pattern: &Pattern, id: PieceId) -> Result<&Arc<Piece>, Words> {
    pattern.pieces.get(&id).ok_or_else(|| words!("there is no {what}", what = id))
}

/// Whether a closed line is exactly its own mirror image, as [`Piece::symmetric`] requires.
pub fn is_symmetric(edges: &[Edge]) -> bool {
    let half = edges.len() / 2;
    let drawn = |e: &Edge| (e.start, e.shape, e.smooth);
    !edges.is_empty()
        && edges.len().is_multiple_of(2)
        && edges[0].start.x == 0.0
        && edges[half].start.x == 0.0
        && curve::mirrored(edges).iter().map(drawn).eq(edges.iter().map(drawn))
}
