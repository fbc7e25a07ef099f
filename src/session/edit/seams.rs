//! Seams.

use std::sync::Arc;

use crate::geometry::ids::SeamId;
use crate::pattern::{Pattern, Seam, Stretch};
use crate::session::command::Rejection;
use crate::session::document::Document;
use crate::session::edit::{Edit, checks};

/// Two stretches of one edge may have this much in common, metres.
const TOUCHING: f64 = 1e-6;

pub fn add(mut document: Document, seam: Seam) -> Result<Edit, Rejection> {
    checks::seam(&document.pattern, &seam)?;
    if overlap(&document.pattern, &seam.sides[0], &seam.sides[1]).is_some() {
        return Err(Rejection::new("an edge cannot be sewn to itself"));
    }
    let mut names = Vec::new();
    for side in seam.sides {
        let piece = checks::find_piece(&document.pattern, side.piece)?;
        let others = document.pattern.seams.values().flat_map(|s| &s.sides);
        if let Some(edge) = others.filter_map(|other| overlap(&document.pattern, &side, other)).next() {
            return Err(Rejection(format!("edge {} of {} is sewn already", edge + 1, piece.name)));
        }
        names.push(piece.name.clone());
    }
    Arc::make_mut(&mut document.pattern).add_seam(seam);
    Ok(Edit::new(format!("sew {} to {}", names[0], names[1]), document))
}

/// An edge that both stretches run over in part.
fn overlap(pattern: &Pattern, one: &Stretch, other: &Stretch) -> Option<usize> {
    if one.piece != other.piece {
        return None;
    }
    let piece = pattern.pieces.get(&one.piece)?;
    let (parts, others) = (one.parts(piece)?, other.parts(piece)?);
    let both = |(edge, from, to): &(usize, f64, f64)| {
        let length = piece.edge_length(*edge);
        others.iter().any(|(e, f, t)| e == edge && (to.min(*t) - from.max(*f)) * length > TOUCHING)
    };
    parts.iter().find(|part| both(part)).map(|part| part.0)
}

pub fn delete(mut document: Document, id: SeamId) -> Result<Edit, Rejection> {
    checks::find_seam(&document.pattern, id)?;
    Arc::make_mut(&mut document.pattern).seams.remove(&id);
    Ok(Edit::new(format!("unpick {id}"), document))
}

pub fn reverse(mut document: Document, id: SeamId) -> Result<Edit, Rejection> {
    checks::find_seam(&document.pattern, id)?;
    if let Some(seam) = Arc::make_mut(&mut document.pattern).seams.get_mut(&id) {
        seam.same_direction = !seam.same_direction;
    }
    Ok(Edit::new(format!("turn {id} round"), document))
}
