//! Lays imported pieces out in the pattern plane so that they can be read like a pattern sheet.
//!
//! Each piece shows its front. Pieces placed in front of the body are on the left, as seen from the front; pieces placed behind
//! it are on the right, as seen from behind. Where two would overlap, the smaller one is pushed aside.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::geometry::ids::PieceId;
use crate::pattern::{Pattern, Piece, PlanePose};

/// Distance between the bounding boxes of two pieces, metres.
const GAP: f64 = 0.03;
/// Distance between the front half and the back half of the sheet, metres.
const HALVES_GAP: f64 = 0.12;
/// Flattening tolerance of curved outlines, metres.
const TOLERANCE: f64 = 1e-3;

/// Sets `pose` of every piece so that no two boxes overlap; the sheet is centred on the origin.
pub fn lay_out(pattern: &mut Pattern) {
    let mut halves: [Vec<Placed>; 2] = [Vec::new(), Vec::new()];
    for (&id, piece) in &pattern.pieces {
        let placed = Placed::new(id, piece);
        halves[usize::from(placed.behind)].push(placed);
    }
    let [mut front, mut back] = halves.map(spread);
    let shift = match (bounds(&front), bounds(&back)) {
        (Some(f), Some(b)) => f.1.x + HALVES_GAP - b.0.x,
        _ => 0.0,
    };
    for placed in &mut back {
        placed.shift(DVec2::new(shift, 0.0));
    }
    front.append(&mut back);
    let centre = bounds(&front).map_or(DVec2::ZERO, |(lo, hi)| (lo + hi) / 2.0);
    for mut placed in front {
        placed.shift(-centre);
        if let Some(piece) = pattern.pieces.get_mut(&placed.id) {
            Arc::make_mut(piece).pose = placed.pose;
        }
    }
}

/// A piece with its pose on the sheet and its bounding box there.
struct Placed {
    id: PieceId,
    behind: bool,
    pose: PlanePose,
    lower: DVec2,
    upper: DVec2,
}

impl Placed {
    fn new(id: PieceId, piece: &Piece) -> Self {
        let outline = piece.flattened(TOLERANCE);
        let centre = outline.iter().sum::<DVec2>() / outline.len().max(1) as f64;
        let flipped = piece.signed_area() < 0.0;
        let mut pose = PlanePose { flipped, ..PlanePose::default() };
        let (mut behind, mut target) = (false, DVec2::ZERO);
        if let Some(space) = piece.placement {
            let world = space.rotation * centre.extend(0.0) + space.translation;
            behind = world.z < -1e-6;
            let seen = |v: DVec3| DVec2::new(if behind { -v.x } else { v.x }, v.y);
            target = seen(world);
            pose.rotation = upright(seen(space.rotation * DVec3::Y));
        }
        pose.offset = target - pose.plane_from_piece(centre);
        let on_sheet = outline.iter().map(|&p| pose.plane_from_piece(p));
        let lower = on_sheet.clone().fold(target, DVec2::min);
        let upper = on_sheet.fold(target, DVec2::max);
        Self { id, behind, pose, lower, upper }
    }

    fn shift(&mut self, by: DVec2) {
        self.pose.offset += by;
        self.lower += by;
        self.upper += by;
    }

    fn area(&self) -> f64 {
        (self.upper - self.lower).element_product()
    }
}

/// The multiple of a quarter turn (radians) nearest to the direction in which the piece's y axis is seen; 0 when that axis points
/// at the viewer.
fn upright(y_seen: DVec2) -> f64 {
    use std::f64::consts::FRAC_PI_2;
    if y_seen.length() < 0.5 {
        return 0.0;
    }
    // Sleeves are often placed at exactly half a quarter turn; the factor rounds both of them to no turn.
    let quarters = (DVec2::Y.angle_to(y_seen) / FRAC_PI_2 * 0.9).round();
    quarters * FRAC_PI_2
}

/// Moves pieces apart, in order of decreasing size: the largest stays, and each next one moves the shortest way out of those
/// before it.
fn spread(mut pieces: Vec<Placed>) -> Vec<Placed> {
    pieces.sort_by(|a, b| b.area().total_cmp(&a.area()).then(a.id.cmp(&b.id)));
    let mut done: Vec<Placed> = Vec::with_capacity(pieces.len());
    for mut piece in pieces {
        let ways = [DVec2::X, DVec2::NEG_X, DVec2::Y, DVec2::NEG_Y].map(|way| way_out(&piece, &done, way));
        let shortest = ways.into_iter().min_by(|a, b| a.length().total_cmp(&b.length()));
        piece.shift(shortest.unwrap_or_default());
        done.push(piece);
    }
    done
}

/// The shift of `piece` along the axis direction `way` that clears all of `others`.
fn way_out(piece: &Placed, others: &[Placed], way: DVec2) -> DVec2 {
    let mut shift = DVec2::ZERO;
    loop {
        let (lower, upper) = (piece.lower + shift, piece.upper + shift);
        let blocking = others.iter().find(|o| {
            let clear = lower.cmpge(o.upper + GAP * 0.999) | upper.cmple(o.lower - GAP * 0.999);
            !clear.any()
        });
        let Some(other) = blocking else {
            return shift;
        };
        let far = if way.max_element() > 0.0 { other.upper + GAP - lower } else { upper - other.lower + GAP };
        shift += way * (far * way.abs()).element_sum();
    }
}

fn bounds(pieces: &[Placed]) -> Option<(DVec2, DVec2)> {
    let lower = pieces.iter().map(|p| p.lower).reduce(DVec2::min)?;
    let upper = pieces.iter().map(|p| p.upper).reduce(DVec2::max)?;
    Some((lower, upper))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(pattern: &mut Pattern, size: f64) {
        let p = [DVec2::ZERO, DVec2::X * size, DVec2::splat(size), DVec2::Y * size];
        pattern.add_piece(Piece::polygon("square", &p));
    }

    #[test]
    fn pieces_without_a_place_do_not_overlap() {
        let mut pattern = Pattern::default();
        for size in [0.1, 0.4, 0.2, 0.2, 0.3] {
            square(&mut pattern, size);
        }
        lay_out(&mut pattern);
        let boxes: Vec<Placed> = pattern.pieces.iter().map(|(&id, p)| boxed(id, p)).collect();
        for (i, a) in boxes.iter().enumerate() {
            for b in &boxes[..i] {
                assert!((a.lower.cmpge(b.upper) | a.upper.cmple(b.lower)).any(), "{} and {}", a.id, b.id);
            }
        }
    }

    fn boxed(id: PieceId, piece: &Piece) -> Placed {
        let points = piece.flattened(TOLERANCE).into_iter().map(|p| piece.pose.plane_from_piece(p));
        let lower = points.clone().reduce(DVec2::min).expect("a point");
        let upper = points.reduce(DVec2::max).expect("a point");
        Placed { id, behind: false, pose: piece.pose, lower, upper }
    }
}
