//! Checks of every number and name that a command brings.

use glam::{DVec2, DVec3};

use crate::contact::Bone;
use crate::geometry::ids::{MarkId, PieceId};
use crate::io::words::readable;
use crate::pattern::edit::{MOST_BUTTONS, WIDEST_ALLOWANCE, is_symmetric};
use crate::pattern::{Button, Edge, EdgeShape, InternalLine, Pattern, Piece, PlanePose, SpacePose};
use crate::session::body_choice::BodyChoice;
use crate::session::command::Rejection;
use crate::session::document::Settings;
use crate::sim::ClothPlace;
use crate::wrap::Marks;

/// Most points of a stroke.
const MOST_POINTS: usize = 100_000;
/// Most edges of an outline.
const MOST_EDGES: usize = 10_000;
/// Most pieces of a pattern.
pub const MOST_PIECES: usize = 1_000;
/// Largest coordinate of points on the table and in pieces, metres.
const FARTHEST: f64 = 1e4;
/// Largest coordinate of points on a body or its cloth, metres; generous, since files may be in any unit.
const FARTHEST_BODY: f64 = 1e6;
/// Most characters of a name.
const LONGEST_NAME: usize = 200;

pub fn stroke_2d(points: &[DVec2]) -> Result<(), Rejection> {
    stroke(points.len(), points.iter().all(|&p| point_2d(p)), FARTHEST)
}

pub fn stroke_3d(points: &[DVec3]) -> Result<(), Rejection> {
    stroke(points.len(), points.iter().all(|&p| point_3d(p)), FARTHEST_BODY)
}

fn stroke(count: usize, all_good: bool, farthest: f64) -> Result<(), Rejection> {
    match count {
        0 => Err(Rejection::new("a stroke needs at least one point")),
        c if c > MOST_POINTS => {
            Err(Rejection(format!("a stroke may have {MOST_POINTS} points, this has {c}")))
        }
        _ if !all_good => {
            Err(Rejection(format!("a point of the stroke is not within {farthest} m of the origin")))
        }
        _ => Ok(()),
    }
}

/// Whether `p` is valid as a point of a body or of cloth on it.
pub fn point_3d(p: DVec3) -> bool {
    p.is_finite() && p.abs().max_element() <= FARTHEST_BODY
}

fn point_2d(p: DVec2) -> bool {
    p.is_finite() && p.abs().max_element() <= FARTHEST
}

pub fn name(name: &str) -> Result<(), Rejection> {
    if name.trim().is_empty() {
        return Err(Rejection::new("a name needs at least one visible character"));
    }
    name_or_none(name)
}

/// A name that may be empty.
pub fn name_or_none(name: &str) -> Result<(), Rejection> {
    if name.chars().count() > LONGEST_NAME {
        return Err(Rejection(format!("a name may have {LONGEST_NAME} characters")));
    }
    if name.chars().any(char::is_control) {
        return Err(Rejection::new("a name may not have control characters"));
    }
    Ok(())
}

pub fn pose(pose: &PlanePose) -> Result<(), Rejection> {
    if point_2d(pose.offset) && pose.rotation.is_finite() {
        return Ok(());
    }
    Err(Rejection::new("the place of the piece is not a finite number"))
}

pub fn outline(outline: &[Edge]) -> Result<(), Rejection> {
    if outline.len() < 2 {
        return Err(Rejection::new("an outline needs at least two edges"));
    }
    if outline.len() > MOST_EDGES {
        return Err(Rejection(format!("an outline may have {MOST_EDGES} edges, this has {}", outline.len())));
    }
    trims(outline)?;
    match outline.iter().position(|e| !edge(e)) {
        Some(i) => Err(Rejection(format!("edge {} of the outline has a number that means no place", i + 1))),
        None => Ok(()),
    }
}

/// Checks what is worked along the edges of a line.
fn trims(edges: &[Edge]) -> Result<(), Rejection> {
    edges.iter().find_map(|edge| edge.trims.problem()).map_or(Ok(()), |why| Err(Rejection(why)))
}

fn edge(edge: &Edge) -> bool {
    point_2d(edge.start) && is_shape(&edge.shape)
}

fn is_shape(shape: &EdgeShape) -> bool {
    match *shape {
        EdgeShape::Line => true,
        EdgeShape::Arc { radius, .. } => radius.is_finite() && radius > 0.0 && radius <= FARTHEST,
        EdgeShape::Quadratic { control } => point_2d(control),
        EdgeShape::Cubic { controls } => controls.into_iter().all(point_2d),
    }
}

pub fn piece(piece: &Piece) -> Result<(), Rejection> {
    name(&piece.name)?;
    pose(&piece.pose)?;
    outline(&piece.outline)?;
    piece.holes.iter().try_for_each(|hole| outline(hole))?;
    inside(piece)?;
    match &piece.placement {
        Some(p) => space(p),
        None => Ok(()),
    }
}

/// A placement in space.
pub fn space(pose: &SpacePose) -> Result<(), Rejection> {
    match pose.is_sound() && pose.translation.abs().max_element() <= FARTHEST {
        true => Ok(()),
        false => Err(Rejection::new("the placement of the piece has a number that means no place")),
    }
}

/// A line inside a piece.
pub fn line(line: &InternalLine) -> Result<(), Rejection> {
    name_or_none(&line.name)?;
    if line.edges.is_empty() || line.edges.len() > MOST_EDGES {
        return Err(Rejection(format!("a line inside a piece has 1 to {MOST_EDGES} edges")));
    }
    trims(&line.edges)?;
    if !point_2d(line.end) || !line.edges.iter().all(edge) {
        return Err(Rejection::new("a line inside a piece has a number that means no place"));
    }
    Ok(())
}

/// A point of the table or of a piece's plane.
pub fn place(p: DVec2) -> Result<(), Rejection> {
    if point_2d(p) {
        return Ok(());
    }
    Err(Rejection(format!("a place is not within {FARTHEST} m of the origin")))
}

/// The curve of an edge.
pub fn shape(shape: &EdgeShape) -> Result<(), Rejection> {
    if is_shape(shape) {
        return Ok(());
    }
    Err(Rejection::new("the curve has a number that means no place"))
}

/// Checks holes, lines, notches and all else drawn on a piece.
fn inside(piece: &Piece) -> Result<(), Rejection> {
    let lines = &piece.lines;
    if piece.holes.len() + lines.len() + piece.notches.len() > MOST_EDGES {
        return Err(Rejection(format!("a piece may have {MOST_EDGES} holes, lines and notches")));
    }
    lines.iter().try_for_each(line)?;
    if !piece.cut_line.is_empty() {
        outline(&piece.cut_line).map_err(|why| Rejection(format!("the cut line: {why}")))?;
    }
    let edges = piece.edge_count();
    if let Some(notch) = piece.notches.iter().find(|n| n.edge >= edges || !(0.0..=1.0).contains(&n.at)) {
        return Err(Rejection(format!(
            "there is no place for a notch on edge {}",
            notch.edge.saturating_add(1)
        )));
    }
    if piece.grainline.is_some_and(|[tail, head]| !point_2d(tail) || !point_2d(head) || tail == head) {
        return Err(Rejection::new("a grainline has two ends within the table"));
    }
    within("the seam allowance", piece.allowance, 0.0, WIDEST_ALLOWANCE)?;
    match piece.symmetric && !is_symmetric(&piece.outline) {
        true => Err(Rejection::new("it is called symmetric, but its halves differ")),
        false => Ok(()),
    }
}

/// Checks every piece of a pattern, and that its counter is not below its ids.
pub fn pattern(pattern: &Pattern) -> Result<(), Rejection> {
    if pattern.pieces.len() > MOST_PIECES {
        return Err(Rejection(format!("a pattern may have {MOST_PIECES} pieces")));
    }
    for p in pattern.pieces.values() {
        piece(p).map_err(|why| Rejection(readable(&format!("piece {:?}: {why}", p.name))))?;
    }
    if let Some(words) = pattern.sizes.problem().or_else(|| rule_problem(pattern)) {
        return Err(Rejection(readable(&words)));
    }
    if pattern.buttons.len() > MOST_BUTTONS {
        return Err(Rejection(format!("a pattern may have {MOST_BUTTONS} buttons")));
    }
    for (id, b) in &pattern.buttons {
        button(b).map_err(|why| Rejection(format!("{id}: {why}")))?;
        b.pieces().into_iter().try_for_each(|piece| find_piece(pattern, piece).map(|_| ()))?;
    }
    let mut zips = pattern.seams.iter().filter_map(|(id, seam)| Some((id, seam.zip?)));
    if let Some((id, words)) = zips.find_map(|(id, zip)| Some((id, zip.problem()?))) {
        return Err(Rejection(format!("{id}: {words}")));
    }
    let buttons = pattern.buttons.keys().map(|b| b.0);
    let ids = pattern.pieces.keys().map(|p| p.0).chain(pattern.seams.keys().map(|s| s.0)).chain(buttons);
    if ids.max().is_some_and(|last| last > pattern.next_id) {
        return Err(Rejection::new("the pattern's counter is behind its ids"));
    }
    Ok(())
}

/// The first grade rule that does not fit the pattern's sizes, in words.
fn rule_problem(pattern: &Pattern) -> Option<String> {
    let sizes = &pattern.sizes;
    pattern.pieces.values().find_map(|piece| {
        let closed = piece.loops().flatten().map(|edge| &edge.rule).enumerate();
        let open = piece.lines.iter().enumerate().flat_map(|(k, line)| {
            let rules = line.edges.iter().map(|edge| &edge.rule).chain([&line.end_rule]);
            rules.enumerate().map(move |(i, rule)| (k, i, rule))
        });
        let closed = closed.filter_map(|(i, rule)| {
            let words = rule.as_ref()?.problem(sizes.len(), sizes.base)?;
            Some(format!("piece {:?}, point {}: {words}", piece.name, i + 1))
        });
        let open = open.filter_map(|(k, i, rule)| {
            let words = rule.as_ref()?.problem(sizes.len(), sizes.base)?;
            Some(format!("piece {:?}, internal line {}, point {}: {words}", piece.name, k + 1, i + 1))
        });
        closed.chain(open).next()
    })
}

/// A button.
pub fn button(button: &Button) -> Result<(), Rejection> {
    place(button.button.at)?;
    place(button.hole.at)?;
    button.problem().map_or(Ok(()), |why| Err(Rejection(why)))
}

/// Checks every stroke, and that no id is used twice.
pub fn marks(marks: &Marks, pattern: &Pattern) -> Result<(), Rejection> {
    for mark in &marks.cloth {
        stroke_2d(&mark.points)?;
        find_piece(pattern, mark.piece)?;
    }
    for mark in &marks.body {
        stroke_3d(&mark.points)?;
    }
    marks.names.values().try_for_each(|given| name(given))?;
    if marks.ties.values().flatten().any(|tie| !tie.weights.is_finite()) {
        return Err(Rejection::new("a mark is tied to the body by what is no number"));
    }
    let mut ids: Vec<MarkId> = marks.ids().collect();
    ids.sort_unstable();
    let mut told = marks.names.keys().chain(marks.ties.keys());
    if let Some(nobody) = told.find(|id| ids.binary_search(id).is_err()) {
        return Err(Rejection(format!("{nobody} has a name or a place but is not there")));
    }
    match ids.windows(2).find(|w| w[0] == w[1]) {
        Some(w) => Err(Rejection(format!("{} is there twice", w[0]))),
        None => Ok(()),
    }
}

pub fn find_piece(pattern: &Pattern, id: PieceId) -> Result<&Piece, Rejection> {
    pattern.pieces.get(&id).map(|p| &**p).ok_or_else(|| Rejection(format!("there is no {id}")))
}

pub fn cloth_place(pattern: &Pattern, place: ClothPlace) -> Result<(), Rejection> {
    find_piece(pattern, place.piece)?;
    if point_2d(place.at) {
        return Ok(());
    }
    Err(Rejection::new("the place on the cloth is not a finite number"))
}

pub fn settings(settings: &Settings) -> Result<(), Rejection> {
    let Settings { edge_length, relax, strain } = settings;
    within("the strain that cloth may have", *strain, 0.001, 0.2)?;
    within("the mesh size", *edge_length, 0.002, 0.2)?;
    within("stretch", relax.stretch, 0.0, 1.0)?;
    within("flattening", relax.flatten, 0.0, 1.0)?;
    within("gravity", relax.gravity, 0.0, 0.1)?;
    within("friction", relax.friction, 0.0, 2.0)?;
    within("the distance from the skin", relax.offset, 0.0005, 0.05)
}

fn within(what: &str, value: f64, least: f64, most: f64) -> Result<(), Rejection> {
    if (least..=most).contains(&value) {
        return Ok(());
    }
    Err(Rejection(format!("{what} must be between {least} and {most}, not {value}")))
}

pub fn body(body: &BodyChoice) -> Result<(), Rejection> {
    match body {
        BodyChoice::Mannequin(measurements) => measurements.check().map_err(|e| Rejection(e.to_string())),
        BodyChoice::Posed { measurements, pose } => {
            measurements.check().map_err(|e| Rejection(e.to_string()))?;
            pose.problem().map_or(Ok(()), |why| Err(Rejection(why)))
        }
        BodyChoice::Imported { name: body_name, mesh } => {
            name(body_name)?;
            if !mesh.positions.iter().all(|&p| point_3d(p)) {
                let words = format!("a vertex of {body_name} is not within {FARTHEST_BODY} m of the origin");
                return Err(Rejection(words));
            }
            if mesh.triangles.iter().flatten().any(|&v| v as usize >= mesh.positions.len()) {
                return Err(Rejection(format!("a triangle of {body_name} names a vertex that is not there")));
            }
            Ok(())
        }
    }
}

/// Most bones of a body.
const MOST_BONES: usize = 200;

pub fn bones(bones: &[Bone]) -> Result<(), Rejection> {
    if bones.len() > MOST_BONES {
        return Err(Rejection(format!("a body may have {MOST_BONES} bones")));
    }
    if !bones.iter().flatten().all(|&p| point_3d(p)) {
        return Err(Rejection(format!("an end of a bone is not within {FARTHEST_BODY} m of the origin")));
    }
    if bones.iter().any(|[a, b]| a == b) {
        return Err(Rejection::new("a bone has two ends"));
    }
    Ok(())
}
