//! Checks of every number and name that a command brings.

use glam::{DVec2, DVec3};

use crate::contact::Bone;
use crate::geometry::ids::{MarkId, PieceId};
use crate::geometry::words::{Words, within_quotes, words};
use crate::io::words::readable_words;
use crate::pattern::edit::{MOST_BUTTONS, WIDEST_ALLOWANCE, is_symmetric};
use crate::pattern::fineness::MESH_SIZES;
use crate::pattern::{Button, Edge, EdgeShape, InternalLine, Pattern, Piece, PlanePose, SpacePose};
use crate::session::body_choice::BodyChoice;
use crate::session::command::Rejection;
use crate::session::document::{EDGE_LENGTHS, Settings};
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
        0 => Err(Rejection(words!("a stroke needs at least one point"))),
        c if c > MOST_POINTS => Err(Rejection(words!(
            "a stroke may have {most} points, this has {count}",
            most = MOST_POINTS,
            count = c
        ))),
        _ if !all_good => Err(Rejection(words!(
            "a point of the stroke is not within {most} m of the origin",
            most = farthest
        ))),
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
        return Err(Rejection(words!("a name needs at least one visible character")));
    }
    name_or_none(name)
}

/// A name that may be empty.
pub fn name_or_none(name: &str) -> Result<(), Rejection> {
    if name.chars().count() > LONGEST_NAME {
        return Err(Rejection(words!("a name may have {most} characters", most = LONGEST_NAME)));
    }
    if name.chars().any(char::is_control) {
        return Err(Rejection(words!("a name may not have control characters")));
    }
    Ok(())
}

pub fn pose(pose: &PlanePose) -> Result<(), Rejection> {
    if point_2d(pose.offset) && pose.rotation.is_finite() {
        return Ok(());
    }
    Err(Rejection(words!("the place of the piece is not a finite number")))
}

pub fn outline(outline: &[Edge]) -> Result<(), Rejection> {
    if outline.len() < 2 {
        return Err(Rejection(words!("an outline needs at least two edges")));
    }
    if outline.len() > MOST_EDGES {
        return Err(Rejection(words!(
            "an outline may have {most} edges, this has {count}",
            most = MOST_EDGES,
            count = outline.len()
        )));
    }
    trims(outline)?;
    match outline.iter().position(|e| !edge(e)) {
        Some(i) => {
            Err(Rejection(words!("edge {n} of the outline has a number that means no place", n = i + 1)))
        }
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
        false => Err(Rejection(words!("the placement of the piece has a number that means no place"))),
    }
}

/// A line inside a piece.
pub fn line(line: &InternalLine) -> Result<(), Rejection> {
    name_or_none(&line.name)?;
    if line.edges.is_empty() || line.edges.len() > MOST_EDGES {
        return Err(Rejection(words!("a line inside a piece has 1 to {most} edges", most = MOST_EDGES)));
    }
    trims(&line.edges)?;
    if !point_2d(line.end) || !line.edges.iter().all(edge) {
        return Err(Rejection(words!("a line inside a piece has a number that means no place")));
    }
    Ok(())
}

/// A point of the table or of a piece's plane.
pub fn place(p: DVec2) -> Result<(), Rejection> {
    if point_2d(p) {
        return Ok(());
    }
    Err(Rejection(words!("a place is not within {most} m of the origin", most = FARTHEST)))
}

/// The curve of an edge.
pub fn shape(shape: &EdgeShape) -> Result<(), Rejection> {
    if is_shape(shape) {
        return Ok(());
    }
    Err(Rejection(words!("the curve has a number that means no place")))
}

/// Checks holes, lines, notches and all else drawn on a piece.
fn inside(piece: &Piece) -> Result<(), Rejection> {
    let lines = &piece.lines;
    if piece.holes.len() + lines.len() + piece.notches.len() > MOST_EDGES {
        return Err(Rejection(words!("a piece may have {most} holes, lines and notches", most = MOST_EDGES)));
    }
    lines.iter().try_for_each(line)?;
    if !piece.cut_line.is_empty() {
        outline(&piece.cut_line).map_err(|why| Rejection(words!("the cut line: {why}", why = why.0)))?;
    }
    let edges = piece.edge_count();
    if let Some(notch) = piece.notches.iter().find(|n| n.edge >= edges || !(0.0..=1.0).contains(&n.at)) {
        return Err(Rejection(words!(
            "there is no place for a notch on edge {n}",
            n = notch.edge.saturating_add(1)
        )));
    }
    if piece.grainline.is_some_and(|[tail, head]| !point_2d(tail) || !point_2d(head) || tail == head) {
        return Err(Rejection(words!("a grainline has two ends within the table")));
    }
    within(words!("the seam allowance"), piece.allowance, 0.0, WIDEST_ALLOWANCE)?;
    if let Some(size) = piece.mesh_size {
        within(words!("the mesh size of a piece (m)"), size, *MESH_SIZES.start(), *MESH_SIZES.end())?;
    }
    match piece.symmetric && !is_symmetric(&piece.outline) {
        true => Err(Rejection(words!("it is called symmetric, but its halves differ"))),
        false => Ok(()),
    }
}

/// Checks every piece of a pattern, and that its counter is not below its ids.
pub fn pattern(pattern: &Pattern) -> Result<(), Rejection> {
    if pattern.pieces.len() > MOST_PIECES {
        return Err(Rejection(words!("a pattern may have {most} pieces", most = MOST_PIECES)));
    }
    for p in pattern.pieces.values() {
        piece(p).map_err(|why| {
            Rejection(readable_words(words!(
                "piece \"{name}\": {why}",
                name = within_quotes(&p.name),
                why = why.0
            )))
        })?;
    }
    if let Some(words) = pattern.sizes.problem().or_else(|| rule_problem(pattern)) {
        return Err(Rejection(readable_words(words)));
    }
    if pattern.buttons.len() > MOST_BUTTONS {
        return Err(Rejection(words!("a pattern may have {most} buttons", most = MOST_BUTTONS)));
    }
    for (id, b) in &pattern.buttons {
        button(b).map_err(|why| Rejection(Words::from(*id).and(": ", why.0)))?;
        b.pieces().into_iter().try_for_each(|piece| find_piece(pattern, piece).map(|_| ()))?;
    }
    let mut zips = pattern.seams.iter().filter_map(|(id, seam)| Some((id, seam.zip?)));
    if let Some((id, words)) = zips.find_map(|(id, zip)| Some((id, zip.problem()?))) {
        return Err(Rejection(Words::from(*id).and(": ", words)));
    }
    let buttons = pattern.buttons.keys().map(|b| b.0);
    let ids = pattern.pieces.keys().map(|p| p.0).chain(pattern.seams.keys().map(|s| s.0)).chain(buttons);
    if ids.max().is_some_and(|last| last > pattern.next_id) {
        return Err(Rejection(words!("the pattern's counter is behind its ids")));
    }
    Ok(())
}

/// The first grade rule that does not fit the pattern's sizes, in words.
fn rule_problem(pattern: &Pattern) -> Option<Words> {
    let sizes = &pattern.sizes;
    pattern.pieces.values().find_map(|piece| {
        let closed = piece.loops().flatten().map(|edge| &edge.rule).enumerate();
        let open = piece.lines.iter().enumerate().flat_map(|(k, line)| {
            let rules = line.edges.iter().map(|edge| &edge.rule).chain([&line.end_rule]);
            rules.enumerate().map(move |(i, rule)| (k, i, rule))
        });
        let closed = closed.filter_map(|(i, rule)| {
            let words = rule.as_ref()?.problem(sizes.len(), sizes.base)?;
            Some(words!(
                "piece \"{name}\", point {n}: {words}",
                name = within_quotes(&piece.name),
                n = i + 1,
                words
            ))
        });
        let open = open.filter_map(|(k, i, rule)| {
            let words = rule.as_ref()?.problem(sizes.len(), sizes.base)?;
            Some(words!(
                "piece \"{name}\", internal line {line}, point {n}: {words}",
                name = within_quotes(&piece.name),
                line = k + 1,
                n = i + 1,
                words
            ))
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
        return Err(Rejection(words!("a mark is tied to the body by what is no number")));
    }
    let mut ids: Vec<MarkId> = marks.ids().collect();
    ids.sort_unstable();
    let mut told = marks.names.keys().chain(marks.ties.keys());
    if let Some(nobody) = told.find(|id| ids.binary_search(id).is_err()) {
        return Err(Rejection(words!("{what} has a name or a place but is not there", what = nobody)));
    }
    match ids.windows(2).find(|w| w[0] == w[1]) {
        Some(w) => Err(Rejection(words!("{what} is there twice", what = w[0]))),
        None => Ok(()),
    }
}

pub fn find_piece(pattern: &Pattern, id: PieceId) -> Result<&Piece, Rejection> {
    pattern.pieces.get(&id).map(|p| &**p).ok_or_else(|| Rejection(words!("there is no {what}", what = id)))
}

pub fn cloth_place(pattern: &Pattern, place: ClothPlace) -> Result<(), Rejection> {
    find_piece(pattern, place.piece)?;
    if point_2d(place.at) {
        return Ok(());
    }
    Err(Rejection(words!("the place on the cloth is not a finite number")))
}

pub fn settings(settings: &Settings) -> Result<(), Rejection> {
    let Settings { edge_length, relax, strain } = settings;
    within(words!("the strain that cloth may have"), *strain, 0.001, 0.2)?;
    within(words!("the mesh size"), *edge_length, *EDGE_LENGTHS.start(), *EDGE_LENGTHS.end())?;
    within(words!("stretch"), relax.stretch, 0.0, 1.0)?;
    within(words!("flattening"), relax.flatten, 0.0, 1.0)?;
    within(words!("gravity"), relax.gravity, 0.0, 0.1)?;
    within(words!("friction"), relax.friction, 0.0, 2.0)?;
    within(words!("the distance from the skin"), relax.offset, 0.0005, 0.05)
}

fn within(what: Words, value: f64, least: f64, most: f64) -> Result<(), Rejection> {
    if (least..=most).contains(&value) {
        return Ok(());
    }
    Err(Rejection(words!("{what} must be between {least} and {most}, not {value}", what, least, most, value)))
}

pub fn body(body: &BodyChoice) -> Result<(), Rejection> {
    match body {
        BodyChoice::Mannequin(measurements) => measurements.check().map_err(|e| Rejection(e.words())),
        BodyChoice::Posed { measurements, pose } => {
            measurements.check().map_err(|e| Rejection(e.words()))?;
            pose.problem().map_or(Ok(()), |why| Err(Rejection(why)))
        }
        BodyChoice::Imported { name: body_name, mesh } => {
            name(body_name)?;
            if !mesh.positions.iter().all(|&p| point_3d(p)) {
                let words = words!(
                    "a vertex of {name} is not within {most} m of the origin",
                    name = body_name,
                    most = FARTHEST_BODY
                );
                return Err(Rejection(words));
            }
            if mesh.triangles.iter().flatten().any(|&v| v as usize >= mesh.positions.len()) {
                return Err(Rejection(words!(
                    "a triangle of {name} names a vertex that is not there",
                    name = body_name
                )));
            }
            Ok(())
        }
    }
}

/// Most bones of a body.
const MOST_BONES: usize = 200;

pub fn bones(bones: &[Bone]) -> Result<(), Rejection> {
    if bones.len() > MOST_BONES {
        return Err(Rejection(words!("a body may have {most} bones", most = MOST_BONES)));
    }
    if !bones.iter().flatten().all(|&p| point_3d(p)) {
        return Err(Rejection(words!(
            "an end of a bone is not within {most} m of the origin",
            most = FARTHEST_BODY
        )));
    }
    if bones.iter().any(|[a, b]| a == b) {
        return Err(Rejection(words!("a bone has two ends")));
    }
    Ok(())
}
