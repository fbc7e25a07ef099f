//! The marker: the pieces of an order placed on the cloth.

use std::sync::Arc;

use glam::DVec2;

use crate::geometry::ids::PieceId;
use crate::geometry::words::Words;
use crate::marker::cut::{CHORDS, Cut, CutPiece, cut_pieces};
use crate::marker::nest::{Nesting, NoLayout, Watch, nest};
use crate::marker::order::{MarkerError, Order};
use crate::pattern::{Pattern, Piece, PlanePose};

/// A piece of cloth on the marker.
#[derive(Clone, Debug)]
pub struct Placed {
    /// The piece of the pattern that it is.
    pub id: PieceId,
    /// Its size; empty where the pattern has none.
    pub size: String,
    /// Number of its garment among those of its size, from 1.
    pub garment: usize,
    /// Its cutting line on the cloth, metres.
    pub outline: Vec<DVec2>,
    /// It, named with its size, at its place on the cloth.
    pub piece: Arc<Piece>,
    /// How it is turned against the pattern's own way of its grain, radians.
    pub turn: f64,
}

/// A layout of all pieces of an order.
#[derive(Clone, Debug)]
pub struct Marker {
    pub order: Order,
    /// Length of cloth used, metres.
    pub length: f64,
    /// Length that the bounding boxes of the pieces take in columns, metres: the plain way.
    pub plain_length: f64,
    /// Area of all pieces within their cutting lines, square metres.
    pub area: f64,
    pub placed: Vec<Placed>,
    /// What cannot be cut as it is, in words.
    pub problems: Vec<Words>,
}

impl Marker {
    /// The share of the cloth that is in pieces, 0..=1.
    pub fn share(&self) -> f64 {
        self.area / (self.length * self.order.width)
    }

    /// Number of garments.
    pub fn garments(&self) -> usize {
        self.order.garments.iter().map(|(_, count)| count).sum()
    }

    /// The pieces as a pattern, each at its place on the cloth.
    pub fn pattern(&self) -> Pattern {
        let mut pattern = Pattern::default();
        for placed in &self.placed {
            pattern.add_piece((*placed.piece).clone());
        }
        pattern
    }
}

/// Lays out the pieces of an order. `watch` tells of its progress and may stop it.
///
/// # Errors
/// What cannot be laid out, in words, or a stop.
pub fn make(pattern: &Pattern, order: &Order, watch: &Watch) -> Result<Marker, MarkerError> {
    order.check()?;
    let Cut { pieces, problems } = cut_pieces(pattern, order)?;
    let wanted: Vec<(usize, usize)> =
        (0..pieces.len()).flat_map(|i| (1..=pieces[i].1).map(move |garment| (i, garment))).collect();
    // Chords of curves lie up to CHORDS within them.
    let slack = if pieces.iter().any(|(piece, _)| piece.is_curved) { CHORDS } else { 0.0 };
    let nesting = Nesting {
        width: order.width - 2.0 * slack,
        gap: order.gap + 2.0 * slack,
        shapes: pieces.iter().map(|(piece, _)| piece.turned.clone()).collect(),
        parts: wanted.iter().map(|&(i, _)| i).collect(),
    };
    let layout = nest(&nesting, order.effort, watch).map_err(|why| match why {
        NoLayout::TooWide { shape, needs } => MarkerError::TooWide {
            piece: pieces[shape].0.piece.name.clone(),
            needs: needs + 2.0 * slack,
            width: order.width,
        },
        NoLayout::Stopped => MarkerError::Stopped,
    })?;
    let several = |i: usize| pieces[i].1 > 1;
    let placed: Vec<Placed> = wanted
        .iter()
        .zip(&layout.places)
        .map(|(&(i, garment), place)| {
            let by = place.by + DVec2::splat(slack);
            put(&pieces[i].0, garment, several(i), place.turn, by)
        })
        .collect();
    Ok(Marker {
        length: layout.length + 2.0 * slack,
        plain_length: layout.plain_length + 2.0 * slack,
        area: wanted.iter().map(|&(i, _)| pieces[i].0.area).sum(),
        order: order.clone(),
        placed,
        problems,
    })
}

fn put(cut: &CutPiece, garment: usize, is_one_of_several: bool, turn: usize, by: DVec2) -> Placed {
    let mut piece = (*cut.piece).clone();
    if !cut.size.is_empty() {
        piece.name = format!("{} {}", piece.name, cut.size);
    }
    if is_one_of_several {
        piece.name = format!("{} ({garment})", piece.name);
    }
    piece.pose = PlanePose { offset: by, rotation: cut.angles[turn], flipped: piece.pose.flipped };
    Placed {
        id: cut.id,
        size: cut.size.clone(),
        garment,
        outline: cut.turned[turn].iter().map(|&p| p + by).collect(),
        piece: Arc::new(piece),
        turn: cut.angles[turn] - cut.angles[0],
    }
}
