//! Commands that edit the pattern, and the strokes and pins on it.

use std::sync::Arc;

use glam::DVec2;

use crate::geometry::ids::PieceId;
use crate::geometry::polygon;
use crate::geometry::words::{Words, words};
use crate::pattern::edit::{self, Carried, PatternEdit};
use crate::pattern::{Edge, Pattern, Piece, PiecePoint, Seam};
use crate::session::command::Rejection;
use crate::session::document::Document;
use crate::session::edit::marks::remove_number;
use crate::session::edit::{ClothChange, Edit, artwork, checks};
use crate::wrap::Marks;

/// Most edits of one command.
const MOST_EDITS: usize = 10_000;

pub fn edit(mut document: Document, edits: &[PatternEdit]) -> Result<Edit, Rejection> {
    if edits.is_empty() || edits.len() > MOST_EDITS {
        return Err(Rejection(words!("a command holds 1 to {most} changes", most = MOST_EDITS)));
    }
    let before = Arc::clone(&document.pattern);
    let (mut label, mut carried) = (None, Vec::new());
    for edit in edits {
        check(edit)?;
        let edited = edit::apply(&document.pattern, edit).map_err(Rejection)?;
        carry(&mut document, &edited.carried);
        carried = Carried::then(&carried, edited.carried);
        document.pattern = Arc::new(edited.pattern);
        label.get_or_insert(edited.label);
    }
    checks::pattern(&document.pattern)?;
    forget_gone(&mut document);
    let edit = Edit::new(label.unwrap_or_default(), document);
    let after = &edit.document.pattern;
    let change = match is_cut_alike(&before, after) {
        false => ClothChange::Resew(carried),
        true if before.activities() != after.activities() => ClothChange::SetActivities,
        true => ClothChange::None,
    };
    Ok(edit.with(change))
}

/// Replaces the pattern and its strokes.
pub fn replace_all(
    mut document: Document,
    name: &str,
    pattern: &Arc<Pattern>,
    marks: &Arc<Marks>,
) -> Result<Edit, Rejection> {
    checks::name(name)?;
    checks::pattern(pattern)?;
    checks::marks(marks, pattern)?;
    document.pattern = Arc::clone(pattern);
    document.take_marks(Arc::clone(marks));
    document.drop_pins();
    artwork::forget_gone(&mut document.artwork, |_| false);
    Ok(Edit::new(words!("take {name}", name), document).with(ClothChange::Clear))
}

/// Checks the numbers and names of an edit by itself.
fn check(edit: &PatternEdit) -> Result<(), Rejection> {
    match edit {
        PatternEdit::AddPiece { piece } => checks::piece(piece),
        PatternEdit::SetOutline { outline, .. } => checks::outline(outline),
        PatternEdit::Rename { name, .. } => checks::name(name),
        PatternEdit::Place { poses } => poses.iter().try_for_each(|(_, pose)| checks::pose(pose)),
        PatternEdit::PlaceInSpace { placements } => {
            placements.iter().filter_map(|(_, pose)| pose.as_ref()).try_for_each(checks::space)
        }
        PatternEdit::MovePoints { points } => points.iter().try_for_each(|(_, to)| checks::place(*to)),
        PatternEdit::MoveLinePoints { points } => points.iter().try_for_each(|(_, to)| checks::place(*to)),
        PatternEdit::Duplicate { offset, .. } | PatternEdit::AddTwin { offset, .. } => checks::place(*offset),
        PatternEdit::Scale { about, factor, .. } => {
            checks::place(*about)?;
            checks::place(*factor)
        }
        PatternEdit::MakeSymmetric { axis, .. } => axis.iter().try_for_each(|&p| checks::place(p)),
        PatternEdit::SetGrainline { grainline, .. } => {
            grainline.iter().flatten().try_for_each(|&p| checks::place(p))
        }
        PatternEdit::SetEdge { shape, .. } => checks::shape(shape),
        PatternEdit::Cut { line, .. } | PatternEdit::AddLine { line, .. } => checks::line(line),
        PatternEdit::AddHole { edges, .. } => checks::outline(edges),
        PatternEdit::SetFold { fold, .. } => sound(fold.and_then(|fold| fold.problem())),
        PatternEdit::SetElastic { elastic, .. } => sound(elastic.and_then(|elastic| elastic.problem())),
        PatternEdit::SetTopstitch { topstitch, .. } => sound(topstitch.and_then(|stitch| stitch.problem())),
        PatternEdit::SetHem { hem, .. } => sound(hem.and_then(|hem| hem.problem())),
        PatternEdit::SetPiping { piping, .. } => sound(piping.and_then(|piping| piping.problem())),
        PatternEdit::SetWrinkle { wrinkle, .. } => sound(wrinkle.and_then(|wrinkle| wrinkle.problem())),
        PatternEdit::AddBow { at, bow } => {
            sound(bow.problem())?;
            checks::place(at.at)
        }
        PatternEdit::AddButtons { buttons } => buttons.iter().try_for_each(checks::button),
        PatternEdit::SetButton { button, .. } => checks::button(button),
        PatternEdit::SetZip { zip, .. } => sound(zip.and_then(|zip| zip.problem())),
        _ => Ok(()),
    }
}

fn sound(problem: Option<Words>) -> Result<(), Rejection> {
    problem.map_or(Ok(()), |words| Err(Rejection(words)))
}

/// Moves strokes and pins along with the places they are on.
fn carry(document: &mut Document, carried: &[Carried]) {
    if carried.is_empty() {
        return;
    }
    let place = |piece: PieceId, middle: glam::DVec2| {
        carried.iter().filter(|c| c.from == piece).find(|c| {
            let inside = |line: &Vec<glam::DVec2>| polygon::contains(line, c.map.transform_point2(middle));
            c.inside.as_ref().is_none_or(inside)
        })
    };
    artwork::carry(&mut document.artwork, |piece, at| place(piece, at).map(|found| (found.to, &found.map)));
    let marks = Arc::make_mut(&mut document.marks);
    for mark in &mut marks.cloth {
        if let Some(carried) = place(mark.piece, mark.points[mark.points.len() / 2]) {
            mark.piece = carried.to;
            mark.points.iter_mut().for_each(|p| *p = carried.map.transform_point2(*p));
        }
    }
    let pins = Arc::make_mut(&mut document.pins);
    for pin in pins {
        if let Some(carried) = place(pin.place.piece, pin.place.at) {
            pin.place.piece = carried.to;
            pin.place.at = carried.map.transform_point2(pin.place.at);
        }
    }
}

/// Deletes strokes on deleted pieces, with their partners, and pins.
fn forget_gone(document: &mut Document) {
    let pieces = &document.pattern.pieces;
    let gone = |piece: &PieceId| !pieces.contains_key(piece);
    artwork::forget_gone(&mut document.artwork, |piece| !gone(&piece));
    if document.marks.cloth.iter().any(|mark| gone(&mark.piece)) {
        let marks = Arc::make_mut(&mut document.marks);
        while let Some(i) = marks.cloth.iter().position(|m| gone(&m.piece)) {
            remove_number(marks, i + 1);
        }
    }
    if document.pins.iter().any(|pin| gone(&pin.place.piece)) {
        Arc::make_mut(&mut document.pins).retain(|pin| !gone(&pin.place.piece));
    }
}

/// Whether two patterns give the same cloth: nothing that is cut, sewn or worked along it differs.
fn is_cut_alike(one: &Pattern, other: &Pattern) -> bool {
    let alike = |a: &Arc<Piece>, b: &Arc<Piece>| Arc::ptr_eq(a, b) || is_piece_alike(a, b);
    let pieces = one.pieces.len() == other.pieces.len()
        && one.pieces.iter().zip(&other.pieces).all(|((i, a), (j, b))| i == j && alike(a, b));
    let seams = one.seams.len() == other.seams.len()
        && one.seams.iter().zip(&other.seams).all(|((i, a), (j, b))| i == j && is_seam_alike(a, b));
    let held = |pattern: &Pattern| -> Vec<[PiecePoint; 2]> {
        pattern.buttons.values().filter(|b| !b.open).map(|b| [b.button, b.hole]).collect()
    };
    pieces && seams && held(one) == held(other)
}

fn is_seam_alike(one: &Seam, other: &Seam) -> bool {
    let closed = |seam: &Seam| seam.zip.map_or(Some([0.0, 1.0]), |zip| zip.closed());
    one.sides == other.sides && one.same_direction == other.same_direction && closed(one) == closed(other)
}

fn is_piece_alike(one: &Piece, other: &Piece) -> bool {
    let worked = |piece: &Piece| -> Vec<Edge> {
        let lines = piece.lines.iter().filter(|line| line.needs_mesh());
        lines.flat_map(|line| line.edges.clone().into_iter().chain([ends_at(line.end)])).collect()
    };
    one.mesh_size == other.mesh_size
        && is_line_alike(&one.outline, &other.outline)
        && one.holes.len() == other.holes.len()
        && one.holes.iter().zip(&other.holes).all(|(a, b)| is_line_alike(a, b))
        && is_line_alike(&worked(one), &worked(other))
}

fn ends_at(start: DVec2) -> Edge {
    Edge { start, ..Edge::default() }
}

/// Whether two lines have the same shape, names and physical trims; grade rules do not count.
fn is_line_alike(one: &[Edge], other: &[Edge]) -> bool {
    let plain = |edge: &Edge| Edge { trims: edge.trims.physical(), rule: None, ..edge.clone() };
    one.len() == other.len() && one.iter().zip(other).all(|(a, b)| a == b || plain(a) == plain(b))
}
