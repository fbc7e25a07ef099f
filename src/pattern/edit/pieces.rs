//! Edits of whole pieces: adding, deleting, copying, placing, scaling, naming.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use glam::{DAffine2, DMat2, DVec2};

use crate::geometry::ids::PieceId;
use crate::geometry::words::{Words, words};
use crate::pattern::activity::Activity;
use crate::pattern::edit::grading::drop_foreign;
use crate::pattern::edit::labels::{self, Label, named};
use crate::pattern::edit::lines::{self, Part};
use crate::pattern::edit::{Carried, Change, find, is_symmetric, points};
use crate::pattern::layers::MOST_LAYER;
use crate::pattern::{
    Bow, Edge, EdgeRef, EdgeShape, GradeRule, InternalLine, Pattern, Piece, PiecePoint, PlanePose, Seam,
    SpacePose, curve,
};

/// Widest seam allowance, metres.
pub const WIDEST_ALLOWANCE: f64 = 0.2;
/// Largest angle of an arc that one cubic replaces, radians; the error is 3e-5 of the radius.
const LONGEST_ARC: f64 = std::f64::consts::FRAC_PI_4;
/// Range of the factors of one scaling.
const SCALES: std::ops::RangeInclusive<f64> = 1e-3..=1e3;

pub(super) fn add(pattern: &mut Pattern, piece: &Arc<Piece>) -> Change {
    let mut piece = Piece::clone(piece);
    piece.twin = None;
    drop_foreign(&mut piece, &pattern.sizes);
    let label = words!("add {name}", name = piece.name);
    pattern.add_piece(piece);
    Change::new(label)
}

pub(super) fn add_bow(pattern: &mut Pattern, at: PiecePoint, bow: &Bow) -> Result<Change, Words> {
    let taken: BTreeSet<String> = pattern.pieces.values().map(|piece| piece.name.clone()).collect();
    for id in pattern.add_bow(at, bow)? {
        let name = find(pattern, id)?.name.clone();
        if taken.contains(&name) {
            let name = fresh_name(pattern, &name);
            change(pattern, id, |piece| piece.name = name);
        }
    }
    Ok(Change::new(words!("add a bow")))
}

pub(super) fn delete(pattern: &mut Pattern, ids: &[PieceId]) -> Result<Change, Words> {
    let label = named(pattern, labels::DELETE, ids)?;
    for id in ids {
        if let Some(twin) = pattern.pieces.get(id).and_then(|p| p.twin) {
            change(pattern, twin, |p| p.twin = None);
        }
        pattern.pieces.remove(id);
        pattern.seams.retain(|_, seam| seam.sides.iter().all(|side| side.piece != *id));
    }
    Ok(Change::new(label))
}

pub(super) fn duplicate(pattern: &mut Pattern, ids: &[PieceId], offset: DVec2) -> Result<Change, Words> {
    let label = named(pattern, labels::DUPLICATE, ids)?;
    let originals: BTreeSet<PieceId> = ids.iter().copied().collect();
    let mut copies: BTreeMap<PieceId, PieceId> = BTreeMap::new();
    for &id in &originals {
        let mut copy = Piece::clone(find(pattern, id)?);
        copy.pose.offset += offset;
        copy.name = fresh_name(pattern, &copy.name);
        copies.insert(id, pattern.add_piece(copy));
    }
    for &copy in copies.values() {
        // Copies of twins are twins of each other; the copy of one twin alone has none.
        change(pattern, copy, |p| p.twin = p.twin.and_then(|twin| copies.get(&twin).copied()));
    }
    let inner: Vec<Seam> = pattern.seams.values().copied().collect();
    for seam in inner {
        if let [Some(&a), Some(&b)] = seam.sides.map(|side| copies.get(&side.piece)) {
            let [mut one, mut other] = seam.sides;
            (one.piece, other.piece) = (a, b);
            pattern.add_seam(Seam { sides: [one, other], ..seam });
        }
    }
    Ok(Change::new(label))
}

pub(super) fn place(pattern: &mut Pattern, poses: &[(PieceId, PlanePose)]) -> Result<Change, Words> {
    let ids: Vec<PieceId> = poses.iter().map(|(id, _)| *id).collect();
    let label = named(pattern, labels::MOVE, &ids)?;
    for &(id, pose) in poses {
        change(pattern, id, |p| p.pose = pose);
    }
    Ok(Change::new(label))
}

pub(super) fn place_in_space(
    pattern: &mut Pattern,
    placements: &[(PieceId, Option<SpacePose>)],
) -> Result<Change, Words> {
    let ids: Vec<PieceId> = placements.iter().map(|(id, _)| *id).collect();
    let what = if placements.iter().any(|(_, pose)| pose.is_some()) { labels::PLACE } else { labels::TAKE };
    let label = named(pattern, what, &ids)?;
    for &(id, placement) in placements {
        change(pattern, id, |p| p.placement = placement);
    }
    Ok(Change::new(label))
}

pub(super) fn set_outline(pattern: &mut Pattern, id: PieceId, outline: &[Edge]) -> Result<Change, Words> {
    let piece = find(pattern, id)?.clone();
    let is_sewn = |id| pattern.seams.values().any(|s| s.sides.iter().any(|side| side.piece == id));
    let (old, new) = (piece.outline.len(), outline.len());
    if old != new && (is_sewn(id) || piece.twin.is_some_and(is_sewn)) {
        return Err(words!(
            "{name} is sewn by its {old} edges: undo its seams before giving it {new}",
            name = piece.name,
            old,
            new
        ));
    }
    if piece.symmetric && !is_symmetric(outline) {
        return Err(words!(
            "{name} is symmetric, this outline is not: unlink its halves first",
            name = piece.name
        ));
    }
    // Edges keep their numbers where they still exist; those of holes come after them.
    let map = (0..old).map(|i| if i < new { vec![Part::whole(i)] } else { Vec::new() }).collect();
    lines::replace(pattern, id, 0, outline.to_vec(), &map);
    let held = (0..new).map(|edge| EdgeRef { piece: id, edge }).collect();
    Ok(Change { held, ..Change::new(words!("redraw {name}", name = piece.name)) })
}

pub(super) fn scale(
    pattern: &mut Pattern,
    ids: &[PieceId],
    about: DVec2,
    factor: DVec2,
) -> Result<Change, Words> {
    let label = named(pattern, labels::SCALE, ids)?;
    if !SCALES.contains(&factor.x) || !SCALES.contains(&factor.y) {
        return Err(words!(
            "a piece is scaled by {least} to {most}",
            least = SCALES.start(),
            most = SCALES.end()
        ));
    }
    let ids: BTreeSet<PieceId> = ids.iter().copied().collect();
    let mut result = Change::new(label);
    for &id in &ids {
        if factor.x != factor.y {
            let twin = find(pattern, id)?.twin;
            [Some(id), twin].into_iter().flatten().for_each(|id| split_arcs(pattern, id));
        }
        let piece = find(pattern, id)?;
        if piece.twin.is_some_and(|twin| twin < id && ids.contains(&twin)) {
            continue; // It follows its twin.
        }
        let mut new = Piece::clone(piece);
        let centre = piece.pose.piece_from_plane(about);
        // A symmetric piece must stay so: keep its axis in place.
        let fixed = if piece.symmetric { DVec2::new(0.0, centre.y) } else { centre };
        let map = DAffine2::from_mat2_translation(DMat2::from_diagonal(factor), fixed - factor * fixed);
        map_piece(&mut new, map);
        new.pose.offset += new.pose.plane_from_piece(fixed) - new.pose.plane_from_piece(centre);
        let moved = new.pose.plane_from_piece(map.transform_point2(centre)) - about;
        new.pose.offset -= moved;
        result.held.extend((0..new.edge_count()).map(|edge| EdgeRef { piece: id, edge }));
        result.carried.push(Carried { from: id, to: id, map, inside: None });
        if let Some(twin) = piece.twin {
            let image = DAffine2::from_mat2_translation(
                DMat2::from_diagonal(factor),
                curve::mirror(fixed - factor * fixed),
            );
            result.carried.push(Carried { from: twin, to: twin, map: image, inside: None });
        }
        pattern.pieces.insert(id, Arc::new(new));
    }
    Ok(result)
}

/// Splits long arcs into several, each short enough to be replaced by a cubic.
fn split_arcs(pattern: &mut Pattern, id: PieceId) {
    let Some(piece) = pattern.pieces.get(&id).cloned() else { return };
    for edge in (0..piece.edge_count()).rev() {
        let (a, b) = piece.edge_ends(edge);
        if let Some(arc) = curve::arc(a, piece.edge(edge).shape, b) {
            let parts = (arc.turn.abs() / LONGEST_ARC).ceil().max(1.0) as usize;
            let fractions: Vec<f64> = (1..parts).map(|k| k as f64 / parts as f64).collect();
            lines::insert_points(pattern, EdgeRef { piece: id, edge }, &fractions);
        }
    }
}

/// Maps a piece and everything drawn on it by `map`.
pub(super) fn map_piece(piece: &mut Piece, map: DAffine2) {
    let scale = DVec2::new(map.matrix2.x_axis.length(), map.matrix2.y_axis.length());
    let alike = (scale.x / scale.y - 1.0).abs() < 1e-12;
    // Rules turn with the piece, but keep their lengths.
    let turn = map.matrix2.y_axis / scale.y;
    let turned = |rule: &GradeRule| rule.from_grain(turn);
    let edges = |edges: &mut Vec<Edge>, end: Option<DVec2>| {
        let ends: Vec<DVec2> = (0..edges.len())
            .map(|i| edges.get(i + 1).map_or(end.unwrap_or(edges[0].start), |next| next.start))
            .collect();
        for (edge, end) in edges.iter_mut().zip(ends) {
            edge.shape = match edge.shape {
                EdgeShape::Arc { radius, large, sweep } if alike => {
                    EdgeShape::Arc { radius: radius * scale.x, large, sweep }
                }
                // An arc scaled into an ellipse is no arc any more.
                EdgeShape::Arc { .. } => {
                    EdgeShape::Cubic { controls: points::as_cubic(edge.start, edge.shape, end) }
                        .mapped(false, |p| map.transform_point2(p))
                }
                shape => shape.mapped(false, |p| map.transform_point2(p)),
            };
            edge.start = map.transform_point2(edge.start);
            edge.rule = edge.rule.as_ref().map(&turned);
        }
    };
    edges(&mut piece.outline, None);
    piece.holes.iter_mut().for_each(|hole| edges(hole, None));
    edges(&mut piece.cut_line, None);
    for InternalLine { edges: own, end, end_rule, .. } in &mut piece.lines {
        edges(own, Some(*end));
        *end = map.transform_point2(*end);
        *end_rule = end_rule.as_ref().map(&turned);
    }
    piece.grainline = piece.grainline.map(|ends| ends.map(|p| map.transform_point2(p)));
}

pub(super) fn rename(pattern: &mut Pattern, id: PieceId, name: &str) -> Result<Change, Words> {
    let label = words!("rename {old} to {name}", old = find(pattern, id)?.name, name);
    change(pattern, id, |p| name.clone_into(&mut p.name));
    Ok(Change::new(label))
}

pub(super) fn set_all(
    pattern: &mut Pattern,
    ids: &[PieceId],
    what: Label,
    set: impl Fn(&mut Piece),
) -> Result<Change, Words> {
    let label = named(pattern, what, ids)?;
    for &id in ids {
        change(pattern, id, &set);
    }
    Ok(Change::new(label))
}

pub(super) fn set_layer(pattern: &mut Pattern, ids: &[PieceId], layer: u8) -> Result<Change, Words> {
    if layer > MOST_LAYER {
        return Err(words!("layer {layer} is none: there are 0 to {most}", layer, most = MOST_LAYER));
    }
    set_all(pattern, ids, labels::LAYER, |p| p.layer = layer)
}

pub(super) fn set_activity(
    pattern: &mut Pattern,
    ids: &[PieceId],
    activity: Activity,
) -> Result<Change, Words> {
    let what = match activity {
        Activity::Active => labels::ACTIVATE,
        Activity::Frozen => labels::FREEZE,
        Activity::Deactivated => labels::DEACTIVATE,
    };
    set_all(pattern, ids, what, |p| p.activity = activity)
}

pub(super) fn set_locked(pattern: &mut Pattern, ids: &[PieceId], locked: bool) -> Result<Change, Words> {
    let what = if locked { labels::LOCK } else { labels::UNLOCK };
    set_all(pattern, ids, what, |piece| piece.locked = locked)
}

pub(super) fn set_allowance(pattern: &mut Pattern, ids: &[PieceId], width: f64) -> Result<Change, Words> {
    if !(0.0..=WIDEST_ALLOWANCE).contains(&width) {
        return Err(words!("a seam allowance is 0 to {most} m wide", most = WIDEST_ALLOWANCE));
    }
    let set = |p: &mut Piece| {
        p.allowance = width;
        p.cut_line.clear();
    };
    set_all(pattern, ids, labels::ALLOWANCE, set)
}

/// Changes a piece, if it exists, by `set`.
pub(super) fn change(pattern: &mut Pattern, id: PieceId, set: impl FnOnce(&mut Piece)) {
    if let Some(piece) = pattern.pieces.get_mut(&id) {
        set(Arc::make_mut(piece));
    }
}

/// `name` with the lowest number that makes it new: "sleeve 2".
pub(super) fn fresh_name(pattern: &Pattern, name: &str) -> String {
    let stem = match name.rsplit_once(' ') {
        Some((stem, number)) if !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit()) => stem,
        _ => name,
    };
    let taken = |name: &String| pattern.pieces.values().any(|p| p.name == *name);
    (2..).map(|n| format!("{stem} {n}")).find(|name| !taken(name)).unwrap_or_default()
}
