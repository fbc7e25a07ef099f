//! The single pieces of cloth that an order asks for, each with its cutting line.

use std::sync::Arc;

use glam::DVec2;

use crate::geometry::ids::PieceId;
use crate::geometry::polygon::signed_area;
use crate::geometry::words::Words;
use crate::io::cutting_line;
use crate::marker::order::{MOST_PIECES, MarkerError, Order};
use crate::pattern::grading::graded;
use crate::pattern::{Edge, EdgeShape, Pattern, Piece, Problem};

/// Largest distance of the cutting lines that are laid out from the true ones, metres.
pub const CHORDS: f64 = 2e-4;
/// Least area of a piece, square metres.
const LEAST_AREA: f64 = 1e-8;
/// Length of the grainline that a piece without one gets, as a share of its own.
const GRAIN: f64 = 0.4;

/// A piece of the pattern in one size.
#[derive(Clone, Debug)]
pub struct CutPiece {
    /// The piece that it is.
    pub id: PieceId,
    /// Its size; empty where the pattern has none.
    pub size: String,
    /// It as it is cut: in its size, with a grainline, without rules.
    pub piece: Arc<Piece>,
    /// The outlines it may have, one for each way in which it may be turned on the cloth: warp along x.
    pub turned: Vec<Vec<DVec2>>,
    /// The angles of those, radians.
    pub angles: Vec<f64>,
    /// Area within its cutting line, square metres.
    pub area: f64,
    /// Whether its outline is told by chords of curves.
    pub is_curved: bool,
}

/// What an order takes.
#[derive(Clone, Debug, Default)]
pub struct Cut {
    /// All pieces in all sizes, and how often each is cut.
    pub pieces: Vec<(CutPiece, usize)>,
    /// What grading made of them that cannot be cut, in words.
    pub problems: Vec<Words>,
}

/// All pieces that `order` takes of `pattern`.
pub fn cut_pieces(pattern: &Pattern, order: &Order) -> Result<Cut, MarkerError> {
    if pattern.pieces.is_empty() {
        return Err(MarkerError::Empty);
    }
    let wanted = order.garments.iter().map(|(_, count)| count.saturating_mul(pattern.pieces.len()));
    let count = wanted.fold(0_usize, usize::saturating_add);
    if count > MOST_PIECES {
        return Err(MarkerError::TooMany(count));
    }
    let mut cut = Cut::default();
    let mut sizes: Vec<(&str, usize)> = Vec::new();
    for (size, count) in &order.garments {
        match sizes.iter_mut().find(|known| known.0 == size) {
            Some(known) => known.1 += count,
            None => sizes.push((size, *count)),
        }
    }
    for (size, count) in sizes.into_iter().filter(|(_, count)| *count > 0) {
        let in_size = match size {
            "" => pattern.clone(),
            size => {
                let graded = graded(pattern, size).map_err(MarkerError::Size)?;
                cut.problems.extend(graded.problems.iter().map(Problem::in_words));
                graded.pattern
            }
        };
        for (&id, piece) in &in_size.pieces {
            cut.pieces.push((CutPiece::new(id, size, piece, order)?, count));
        }
    }
    Ok(cut)
}

impl CutPiece {
    fn new(id: PieceId, size: &str, piece: &Piece, order: &Order) -> Result<Self, MarkerError> {
        let mut piece = without_rules(piece);
        let line = cutting_line(&piece, CHORDS);
        let area = signed_area(&line).abs();
        if area < LEAST_AREA {
            return Err(MarkerError::NoArea(piece.name));
        }
        let grain = piece.grain();
        piece.grainline.get_or_insert_with(|| grain_through(&line, grain));
        // A piece drawn from its back is turned over: on the cloth all show their front.
        piece.pose.flipped = piece.signed_area() < 0.0;
        let flipped = |p: DVec2| if piece.pose.flipped { DVec2::new(-p.x, p.y) } else { p };
        let straight = -flipped(grain).to_angle();
        let ways: &[f64] = if order.nap { &[0.0] } else { &[0.0, std::f64::consts::PI] };
        let tilts: &[f64] = if order.tilt > 0.0 { &[0.0, -1.0, 1.0] } else { &[0.0] };
        let angles: Vec<f64> = ways
            .iter()
            .flat_map(|way| tilts.iter().map(move |tilt| straight + way + tilt * order.tilt))
            .collect();
        let turned = |angle: &f64| -> Vec<DVec2> {
            let turn = DVec2::from_angle(*angle);
            line.iter().map(|&p| turn.rotate(flipped(p))).collect()
        };
        let turned = angles.iter().map(turned).collect();
        let is_curved =
            !piece.cut_line.is_empty() || piece.outline.iter().any(|e| e.shape != EdgeShape::Line);
        Ok(Self { id, size: size.to_owned(), piece: Arc::new(piece), turned, angles, area, is_curved })
    }
}

/// A grainline through the middle of a piece that has none.
fn grain_through(line: &[DVec2], grain: DVec2) -> [DVec2; 2] {
    let lower = line.iter().copied().reduce(DVec2::min).unwrap_or_default();
    let upper = line.iter().copied().reduce(DVec2::max).unwrap_or_default();
    let (middle, half) = ((lower + upper) / 2.0, grain * ((upper - lower).dot(grain.abs()) * GRAIN / 2.0));
    [middle - half, middle + half]
}

/// The piece without grade rules and without what ties it to other pieces.
fn without_rules(piece: &Piece) -> Piece {
    let plain = |edges: &[Edge]| edges.iter().map(|edge| Edge { rule: None, ..edge.clone() }).collect();
    let mut own = piece.clone();
    own.outline = plain(&piece.outline);
    own.cut_line = plain(&piece.cut_line);
    own.holes = piece.holes.iter().map(|hole| plain(hole)).collect();
    for line in &mut own.lines {
        line.edges = plain(&line.edges);
        line.end_rule = None;
    }
    own.twin = None;
    own
}
