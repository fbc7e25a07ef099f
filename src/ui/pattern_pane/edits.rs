//! The pattern edits that each action makes, given the selection.

use std::collections::BTreeSet;

use glam::DVec2;

use crate::geometry::ids::{PieceId, SeamId};
use crate::pattern::activity::Activity;
use crate::pattern::edit::{LinePoint, PatternEdit, PointRef, TrimLine};
use crate::pattern::{
    EdgeRef, EdgeShape, Elastic, Fold, Hem, Pattern, Piece, Piping, PlanePose, RulePoint, SpacePose,
    Topstitch, Trims, Wrinkle, Zip, curve,
};
use crate::place::rolled_up;
use crate::ui::actions::Action;
use crate::ui::pattern_pane::shapes::cloth_is_left;
use crate::ui::selection::{LineRef, Selection};

/// Distance between a piece and its new twin, metres.
const BESIDE: f64 = 0.03;
/// Offset of a copy from its piece, metres.
const COPY: DVec2 = DVec2::new(0.02, -0.02);

/// The edits that `action` makes; empty when nothing selected is concerned.
pub fn edits(action: Action, pattern: &Pattern, selection: &Selection) -> Vec<PatternEdit> {
    let touched = selection.pieces_touched();
    let pieces: Vec<PieceId> = touched.iter().copied().collect();
    match action {
        Action::Delete => deletions(pattern, selection),
        Action::Duplicate if !pieces.is_empty() => vec![PatternEdit::Duplicate { pieces, offset: COPY }],
        Action::Twin => {
            let alone = pieces.into_iter().filter(|id| pattern.pieces[id].twin.is_none());
            let twin = |piece: PieceId| {
                let width =
                    pattern.pieces.get(&piece).map_or(0.0, |p| box_of(p).map_or(0.0, |[a, b]| b.x - a.x));
                PatternEdit::AddTwin { piece, offset: DVec2::new(width + BESIDE, 0.0) }
            };
            alone.map(twin).collect()
        }
        Action::MakeSymmetric => {
            let axis = |id: &PieceId| Some((*id, axis_of(pattern, selection, *id)?));
            let all = pieces.iter().filter_map(axis);
            all.map(|(piece, axis)| PatternEdit::MakeSymmetric { piece, axis }).collect()
        }
        Action::Unfold => selection
            .edges
            .iter()
            .filter(|edge| is_straight(pattern, **edge))
            .map(|&edge| PatternEdit::Unfold { edge })
            .collect(),
        Action::Fold => {
            of_each(&pieces, |id| pattern.pieces[&id].symmetric.then_some(PatternEdit::Fold { piece: id }))
        }
        Action::Unlink => of_each(&pieces, |id| {
            let piece = &pattern.pieces[&id];
            (piece.symmetric || piece.twin.is_some()).then_some(PatternEdit::Unlink { piece: id })
        }),
        Action::TurnOver => {
            let poses = pieces.iter().filter_map(|id| Some((*id, turned_over(pattern.pieces.get(id)?)?)));
            let poses: Vec<_> = poses.collect();
            if poses.is_empty() { Vec::new() } else { vec![PatternEdit::Place { poses }] }
        }
        Action::ToggleLock if !pieces.is_empty() => {
            let locked = !pieces.iter().all(|id| pattern.pieces[id].locked);
            vec![PatternEdit::SetLocked { pieces, locked }]
        }
        Action::ToggleFrozen => toggled(pattern, pieces, Activity::Frozen),
        Action::ToggleDeactivated => toggled(pattern, pieces, Activity::Deactivated),
        Action::Hide if !pieces.is_empty() => vec![PatternEdit::SetHidden { pieces, hidden: true }],
        Action::ShowPieces => {
            let hidden = pattern.pieces.iter().filter(|(_, piece)| piece.hidden);
            let pieces: Vec<PieceId> = hidden.map(|(&id, _)| id).collect();
            if pieces.is_empty() {
                Vec::new()
            } else {
                vec![PatternEdit::SetHidden { pieces, hidden: false }]
            }
        }
        Action::ToggleRolled => rolled(pattern, &touched),
        Action::Unplace => {
            let standing = touched.iter().filter(|id| pattern.pieces[id].placement.is_some());
            let placements: Vec<_> = standing.map(|id| (*id, None)).collect();
            if placements.is_empty() { Vec::new() } else { vec![PatternEdit::PlaceInSpace { placements }] }
        }
        Action::Untwist => vec![PatternEdit::UntwistSeams],
        Action::ToggleFold
        | Action::ToggleElastic
        | Action::ToggleTopstitch
        | Action::ToggleHem
        | Action::TogglePiping
        | Action::ToggleWrinkle
        | Action::ToggleZip
        | Action::ToggleFastened => edits_of_trims(action, pattern, selection),
        _ => edits_of_edges(action, pattern, selection),
    }
}

/// The edits that `action` makes to what is worked along the selected edges, lines and seams: all get it, or none where the first
/// has it.
fn edits_of_trims(action: Action, pattern: &Pattern, selection: &Selection) -> Vec<PatternEdit> {
    let edges: Vec<TrimLine> = selection.edges.iter().map(|&edge| TrimLine::Edge(edge)).collect();
    let inside = selection.lines.iter().map(|l| TrimLine::Line { piece: l.piece, line: l.line });
    let lines: Vec<TrimLine> = edges.iter().copied().chain(inside.clone()).collect();
    let first = lines.first().and_then(|line| line.of(pattern.pieces.get(&line.piece())?));
    let is_zipped = |id: &SeamId| pattern.seams.get(id).is_some_and(|seam| seam.zip.is_some());
    match (action, first) {
        (Action::ToggleFold, Some(Trims { fold, .. })) => {
            let fold = fold.is_none().then(|| Fold::pressed(std::f64::consts::PI));
            vec![PatternEdit::SetFold { lines, fold }]
        }
        (Action::ToggleElastic, Some(Trims { elastic, .. })) => {
            let elastic = elastic.is_none().then_some(Elastic::USUAL);
            vec![PatternEdit::SetElastic { lines, elastic }]
        }
        (Action::ToggleTopstitch, Some(Trims { topstitch, .. })) => {
            let topstitch = topstitch.is_none().then(Topstitch::default);
            vec![PatternEdit::SetTopstitch { lines, topstitch }]
        }
        (Action::ToggleHem, Some(Trims { hem, .. })) if !edges.is_empty() => {
            vec![PatternEdit::SetHem { lines: edges, hem: hem.is_none().then_some(Hem::USUAL) }]
        }
        (Action::TogglePiping, Some(Trims { piping, .. })) => {
            vec![PatternEdit::SetPiping { lines, piping: piping.is_none().then_some(Piping::USUAL) }]
        }
        (Action::ToggleWrinkle, _) => {
            let inside: Vec<TrimLine> = inside.collect();
            let first = inside.first().and_then(|line| line.of(pattern.pieces.get(&line.piece())?));
            let Some(Trims { wrinkle, .. }) = first else { return Vec::new() };
            let wrinkle = wrinkle.is_none().then_some(Wrinkle::USUAL);
            vec![PatternEdit::SetWrinkle { lines: inside, wrinkle }]
        }
        (Action::ToggleZip, _) => {
            let zip = (!selection.seams.iter().all(is_zipped)).then_some(Zip::CLOSED);
            selection.seams.iter().map(|&seam| PatternEdit::SetZip { seam, zip }).collect()
        }
        (Action::ToggleFastened, _) if !pattern.buttons.is_empty() => {
            let fastened = pattern.buttons.values().any(|button| button.open);
            vec![PatternEdit::Fasten { buttons: pattern.buttons.keys().copied().collect(), fastened }]
        }
        _ => Vec::new(),
    }
}

/// The edits that `action` makes to the selected points, edges and seams.
fn edits_of_edges(action: Action, pattern: &Pattern, selection: &Selection) -> Vec<PatternEdit> {
    match action {
        // From the last point to the first, so that the indices of the remaining ones stay valid.
        Action::InsertPoint => {
            let edges = selection.edges.iter().rev();
            edges.map(|&edge| PatternEdit::InsertPoint { edge, at: 0.5 }).collect()
        }
        Action::ToggleSmooth => {
            let of_point = |at: RulePoint| Some((at, pattern.pieces.get(&at.piece)?.is_smooth_at(&at)?));
            let points: Vec<(RulePoint, bool)> = selection.all_points().filter_map(of_point).collect();
            let smooth = !points.iter().all(|(_, is_smooth)| *is_smooth);
            points.into_iter().map(|(at, _)| PatternEdit::smooth_at(at, smooth)).collect()
        }
        Action::Straighten => {
            let straight = |&edge: &EdgeRef| PatternEdit::SetEdge { edge, shape: EdgeShape::Line };
            selection.edges.iter().map(straight).collect()
        }
        Action::Curve => selection.edges.iter().filter_map(|edge| curved(pattern, *edge)).collect(),
        Action::Arc => selection.edges.iter().filter_map(|edge| rounded(pattern, *edge)).collect(),
        Action::TurnSeam => selection.seams.iter().map(|&seam| PatternEdit::TurnSeam { seam }).collect(),
        Action::MakeEqual => {
            selection.seams.iter().map(|&seam| PatternEdit::SetRatio { seam, ratio: Some(1.0) }).collect()
        }
        Action::FreeLengths => {
            selection.seams.iter().map(|&seam| PatternEdit::SetRatio { seam, ratio: None }).collect()
        }
        _ => Vec::new(),
    }
}

/// Rolls the placed pieces of `pieces`, or makes them flat if all of them are rolled.
fn rolled(pattern: &Pattern, pieces: &BTreeSet<PieceId>) -> Vec<PatternEdit> {
    let flat = is_rolled(pattern, pieces);
    let turned = |id: &PieceId| {
        let piece = pattern.pieces.get(id)?;
        let pose = piece.placement?;
        let pose = if flat { SpacePose { roll: None, ..pose } } else { rolled_up(piece, pose) };
        Some((*id, Some(pose)))
    };
    let placements: Vec<_> = pieces.iter().filter_map(turned).collect();
    if placements.is_empty() { Vec::new() } else { vec![PatternEdit::PlaceInSpace { placements }] }
}

/// Whether some of `pieces` are placed around the body, and all of those are rolled.
pub fn is_rolled(pattern: &Pattern, pieces: &BTreeSet<PieceId>) -> bool {
    let mut standing = pieces.iter().filter_map(|id| pattern.pieces.get(id)?.placement).peekable();
    standing.peek().is_some() && standing.all(|pose| pose.roll.is_some())
}

/// Sets the activity of `pieces` to `activity`, or to active if all have it already.
fn toggled(pattern: &Pattern, pieces: Vec<PieceId>, activity: Activity) -> Vec<PatternEdit> {
    let all = pieces.iter().all(|id| pattern.pieces[id].activity == activity);
    let activity = if all { Activity::Active } else { activity };
    if pieces.is_empty() { Vec::new() } else { vec![PatternEdit::SetActivity { pieces, activity }] }
}

fn of_each(pieces: &[PieceId], edit: impl Fn(PieceId) -> Option<PatternEdit>) -> Vec<PatternEdit> {
    pieces.iter().filter_map(|&id| edit(id)).collect()
}

/// Deletions of the selected pieces, points, lines and seams; for a selected edge of a hole, of the whole hole.
pub fn deletions(pattern: &Pattern, selection: &Selection) -> Vec<PatternEdit> {
    let Selection { pieces, points, edges, seams, .. } = selection;
    let mut all = Vec::new();
    if !seams.is_empty() {
        all.push(PatternEdit::Unpick { seams: seams.iter().copied().collect() });
    }
    let is_left = |piece: &PieceId| !pieces.contains(piece) && pattern.pieces.contains_key(piece);
    all.extend(line_deletions(pattern, selection, is_left));
    let edges = edges.iter().filter(|edge| is_left(&edge.piece));
    let loops: BTreeSet<(PieceId, usize)> =
        edges.map(|edge| (edge.piece, pattern.pieces[&edge.piece].loop_of(edge.edge).0)).collect();
    let holes = || loops.iter().rev().filter_map(|&(piece, i)| Some((piece, i.checked_sub(1)?)));
    let goes = |point: &PointRef| {
        holes().any(|(piece, hole)| {
            piece == point.piece && pattern.pieces[&piece].loop_of(point.point).0 == hole + 1
        })
    };
    let points = points.iter().rev().filter(|point| is_left(&point.piece) && !goes(point));
    all.extend(points.map(|&point| PatternEdit::DeletePoint { point }));
    all.extend(holes().map(|(piece, hole)| PatternEdit::DeleteHole { piece, hole }));
    if !pieces.is_empty() {
        all.push(PatternEdit::DeletePieces { pieces: pieces.iter().copied().collect() });
    }
    all
}

/// Deletions of the selected internal lines and of the selected points of others, on pieces that stay. A line that would keep
/// less than two points goes as a whole.
fn line_deletions(
    pattern: &Pattern,
    selection: &Selection,
    is_left: impl Fn(&PieceId) -> bool,
) -> Vec<PatternEdit> {
    let (mut all, mut gone) = (Vec::new(), Vec::new());
    for line in selection.lines_touched().into_iter().filter(|line| is_left(&line.piece)) {
        let is_on = |at: &&LinePoint| LineRef { piece: at.piece, line: at.line } == line;
        let chosen: Vec<LinePoint> = selection.line_points.iter().filter(is_on).copied().collect();
        let edges = pattern.pieces[&line.piece].lines.get(line.line).map_or(0, |line| line.edges.len());
        if selection.lines.contains(&line) || chosen.len() >= edges {
            gone.push(line);
        } else {
            // From the last point to the first, so that the indices of the remaining ones stay valid; so with lines.
            all.extend(chosen.into_iter().rev().map(|point| PatternEdit::DeleteLinePoint { point }));
        }
    }
    let gone = gone.into_iter().rev();
    all.extend(gone.map(|LineRef { piece, line }| PatternEdit::DeleteLine { piece, line }));
    all
}

/// Whether an edge is straight and part of the outline, so that a piece can be mirrored in it.
pub fn is_straight(pattern: &Pattern, EdgeRef { piece, edge }: EdgeRef) -> bool {
    let found = pattern.pieces.get(&piece);
    found.is_some_and(|piece| edge < piece.outline.len() && piece.edge(edge).shape == EdgeShape::Line)
}

fn curved(pattern: &Pattern, edge: EdgeRef) -> Option<PatternEdit> {
    let piece = pattern.pieces.get(&edge.piece)?;
    let (a, b) = piece.edge_ends(edge.edge);
    let controls = match piece.edge(edge.edge).shape {
        EdgeShape::Cubic { .. } => return None,
        EdgeShape::Quadratic { control } => [a.lerp(control, 2.0 / 3.0), b.lerp(control, 2.0 / 3.0)],
        EdgeShape::Line => [a.lerp(b, 1.0 / 3.0), a.lerp(b, 2.0 / 3.0)],
        EdgeShape::Arc { .. } => {
            // The control points of the cubic through the arc's points at 1/3 and 2/3.
            let p = piece.edge_points(edge.edge, &[1.0 / 3.0, 2.0 / 3.0]);
            let control =
                |p: DVec2, q: DVec2, a: DVec2, b: DVec2| (18.0 * p - 9.0 * q - 5.0 * a + 2.0 * b) / 6.0;
            [control(p[0], p[1], a, b), control(p[1], p[0], b, a)]
        }
    };
    Some(PatternEdit::SetEdge { edge, shape: EdgeShape::Cubic { controls } })
}

/// The edit that makes an edge an arc: through the middle of a curve; for a straight edge one that bulges outward by a tenth of
/// its length.
fn rounded(pattern: &Pattern, edge: EdgeRef) -> Option<PatternEdit> {
    let piece = pattern.pieces.get(&edge.piece)?;
    let (a, b) = piece.edge_ends(edge.edge);
    let middle = match piece.edge(edge.edge).shape {
        EdgeShape::Arc { .. } => return None,
        EdgeShape::Line => {
            let out = if cloth_is_left(piece, edge.edge) { -0.1 } else { 0.1 };
            a.midpoint(b) + (b - a).perp() * out
        }
        _ => piece.edge_points(edge.edge, &[0.5])[0],
    };
    let shape = curve::arc_through(a, middle, b);
    (shape != EdgeShape::Line).then_some(PatternEdit::SetEdge { edge, shape })
}

/// The mirror line of a piece, in its own plane: through two of its selected points, along its selected edge, or vertical (on the
/// table) through its middle. The side that is on the left on the table is kept.
fn axis_of(pattern: &Pattern, selection: &Selection, id: PieceId) -> Option<[DVec2; 2]> {
    let piece = pattern.pieces.get(&id)?;
    let points: Vec<DVec2> =
        selection.points.iter().filter(|p| p.piece == id).map(|p| piece.edge(p.point).start).collect();
    let edges: Vec<&EdgeRef> = selection.edges.iter().filter(|e| e.piece == id).collect();
    let ends = match (&points[..], &edges[..]) {
        (&[a, b], _) => [a, b],
        (_, [edge]) => {
            let (a, b) = piece.edge_ends(edge.edge);
            [a, b]
        }
        _ => {
            let [lower, upper] = box_of(piece)?;
            let x = (lower.x + upper.x) / 2.0;
            [DVec2::new(x, lower.y), DVec2::new(x, upper.y)].map(|p| piece.pose.piece_from_plane(p))
        }
    };
    // If the line points up on the table, its left is the table's left; on a flipped piece it is the other side.
    let placed = ends.map(|p| piece.pose.plane_from_piece(p));
    let up = (placed[1] - placed[0]).y > 0.0;
    Some(if up != piece.pose.flipped { ends } else { [ends[1], ends[0]] })
}

/// Bounding box of a piece on the table: lower and upper corner.
fn box_of(piece: &Piece) -> Option<[DVec2; 2]> {
    let points = piece.flattened(1e-3).into_iter().map(|p| piece.pose.plane_from_piece(p));
    points.map(|p| [p, p]).reduce(|[a, b], [c, d]| [a.min(c), b.max(d)])
}

/// The pose of a piece that is flipped about the vertical line through its middle.
fn turned_over(piece: &Piece) -> Option<PlanePose> {
    let [lower, upper] = box_of(piece)?;
    let middle = (lower + upper) / 2.0;
    let own = piece.pose.piece_from_plane(middle);
    let turned =
        PlanePose { offset: DVec2::ZERO, rotation: -piece.pose.rotation, flipped: !piece.pose.flipped };
    Some(PlanePose { offset: middle - turned.plane_from_piece(own), ..turned })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Arc;

    fn square() -> (Pattern, PieceId) {
        let mut pattern = Pattern::default();
        let points = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(DVec2::from);
        let id = pattern.add_piece(Piece::polygon("p", &points));
        (pattern, id)
    }

    #[test]
    fn what_lies_left_on_the_table_stays() {
        let (mut pattern, id) = square();
        let selection = Selection::of_pieces([id]);
        for (rotation, flipped) in [(0.0, false), (0.0, true), (2.0, false), (2.5, true)] {
            let piece = Arc::make_mut(pattern.pieces.get_mut(&id).expect("the piece"));
            piece.pose = PlanePose { offset: DVec2::new(3.0, 4.0), rotation, flipped };
            let piece = piece.clone();
            let [a, b] = axis_of(&pattern, &selection, id).expect("an axis");
            let [lower, upper] = box_of(&piece).expect("a box");
            let west = piece.pose.piece_from_plane(DVec2::new(lower.x, (lower.y + upper.y) / 2.0));
            assert!((b - a).perp_dot(west - a) > 0.0, "{rotation} {flipped}");
        }
    }

    #[test]
    fn points_go_from_the_last_on() {
        let (pattern, piece) = square();
        let mut selection = Selection::default();
        selection.points.extend([0, 2].map(|point| PointRef { piece, point }));
        let found = edits(Action::Delete, &pattern, &selection);
        let point = |point| PatternEdit::DeletePoint { point: PointRef { piece, point } };
        assert_eq!(found, [point(2), point(0)]);
    }

    #[test]
    fn points_of_lines_go_and_the_line_with_its_last_but_one() {
        let (mut pattern, piece) = square();
        let edges = [0.2, 0.4].map(|x| crate::pattern::Edge { start: DVec2::splat(x), ..Default::default() });
        let (edges, end) = (edges.to_vec(), DVec2::splat(0.8));
        let line = crate::pattern::InternalLine { edges, end, ..Default::default() };
        Arc::make_mut(pattern.pieces.get_mut(&piece).expect("the piece")).lines.push(line);
        let at = |point| LinePoint { piece, line: 0, point };
        let gone = |points: &[usize]| {
            let line_points = points.iter().map(|&point| at(point)).collect();
            edits(Action::Delete, &pattern, &Selection { line_points, ..Selection::default() })
        };
        assert_eq!(gone(&[1]), [PatternEdit::DeleteLinePoint { point: at(1) }]);
        assert_eq!(gone(&[0, 2]), [PatternEdit::DeleteLine { piece, line: 0 }]);
    }

    #[test]
    fn points_of_outlines_and_lines_become_smooth_together_and_corners_again() {
        let (mut pattern, piece) = square();
        let line = |smooth| {
            let start = DVec2::splat(0.4);
            let edges = vec![
                crate::pattern::Edge::default(),
                crate::pattern::Edge { start, smooth, ..Default::default() },
            ];
            vec![crate::pattern::InternalLine { edges, end: DVec2::splat(0.8), ..Default::default() }]
        };
        let mut selection = Selection::default();
        selection.points.insert(PointRef { piece, point: 1 });
        // An end of a line is neither smooth nor a corner.
        selection.line_points.extend([1, 2].map(|point| LinePoint { piece, line: 0, point }));
        for (closed, inside, smooth) in [(false, false, true), (true, false, true), (true, true, false)] {
            let change = Arc::make_mut(pattern.pieces.get_mut(&piece).expect("the piece"));
            (change.outline[1].smooth, change.lines) = (closed, line(inside));
            let point = LinePoint { piece, line: 0, point: 1 };
            assert_eq!(
                edits(Action::ToggleSmooth, &pattern, &selection),
                [
                    PatternEdit::SetSmooth { point: PointRef { piece, point: 1 }, smooth },
                    PatternEdit::SetLineSmooth { point, smooth }
                ]
            );
        }
    }

    #[test]
    fn an_arc_as_a_curve_stays_where_it_is() {
        let (mut pattern, piece) = square();
        let arc = EdgeShape::Arc { radius: 0.7, large: false, sweep: true };
        Arc::make_mut(pattern.pieces.get_mut(&piece).expect("the piece")).outline[0].shape = arc;
        let edge = EdgeRef { piece, edge: 0 };
        let Some(PatternEdit::SetEdge { shape, .. }) = curved(&pattern, edge) else { panic!("a curve") };
        let (a, b) = pattern.pieces[&piece].edge_ends(0);
        for f in [0.2, 0.5, 0.9] {
            let [p, q] = [arc, shape].map(|shape| curve::points(a, shape, b, &[f])[0]);
            assert!(p.distance(q) < 2e-3, "{p} {q}");
        }
    }

    #[test]
    fn a_piece_turned_over_keeps_its_place() {
        let (mut pattern, id) = square();
        let piece = Arc::make_mut(pattern.pieces.get_mut(&id).expect("the piece"));
        piece.pose.rotation = 0.4;
        let before = box_of(piece).expect("a box");
        piece.pose = turned_over(piece).expect("a pose");
        assert!(piece.pose.flipped);
        let after = box_of(piece).expect("a box");
        assert!(before[0].distance(after[0]) < 1e-9 && before[1].distance(after[1]) < 1e-9);
    }
}
