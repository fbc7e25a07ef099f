//! Marks proposed from where the pattern's file placed its pieces round the body.
//!
//! One tier only: pieces of the torso get a vertical stroke each, else a waistband gets strokes along it; sleeves and legs
//! follow their seams better than marks of their own. A stroke starts where a ray through its middle meets the body and is
//! marched both ways over the skin's offset, by the pattern's own arc length, so that it is as long as its partner.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use crate::body::Surface;
use crate::geometry::ids::{MarkId, PieceId};
use crate::pattern::{Pattern, Piece, SpacePose};
use crate::wrap::{BodyMark, ClothMark, ClothSide, Marks};

/// Pieces whose outer side looks this far (cosine) to the front or back are candidates.
const FRONT_OR_BACK: f64 = 0.7;
/// A stroke ends where the skin turns away from its piece by more than this cosine.
const TURNED_AWAY: f64 = 0.3;
/// Marching step, metres.
const STEP: f64 = 0.005;
/// Strokes keep this far from the sides of their piece, metres.
const INSET: f64 = 0.015;

/// Marks for the pieces of `pattern` that have a placement; empty when none of them can anchor the garment.
/// `offset` is the height of the cloth above the skin, metres.
pub fn suggested(pattern: &Pattern, surface: &Surface, offset: f64) -> Marks {
    let panels = placed_panels(pattern);
    let torso: Vec<&Panel> = panels.iter().filter(|p| p.facing() && is_torso(p.piece)).collect();
    let band: Vec<&Panel> = panels.iter().filter(|p| p.facing() && is_band(p.piece)).collect();
    let mut marks = Marks::default();
    let (chosen, direction) = if !torso.is_empty() {
        (torso, DVec2::Y)
    } else if !band.is_empty() {
        (band, DVec2::X)
    } else {
        (topmost(&panels), DVec2::X)
    };
    for panel in chosen {
        if let Some((cloth, body)) = stroke(panel, surface, direction, offset) {
            let number = marks.cloth.len() as u32 + 1;
            marks.cloth.push(ClothMark {
                id: MarkId(pattern.next_id + 2 * number),
                piece: panel.id,
                side: ClothSide::Front,
                points: cloth,
            });
            marks.body.push(BodyMark { id: MarkId(pattern.next_id + 2 * number + 1), points: body });
        }
    }
    marks
}

struct Panel<'a> {
    id: PieceId,
    piece: &'a Piece,
    pose: SpacePose,
    /// Unit, the way its outer side looks.
    normal: DVec3,
    outline: Vec<DVec2>,
}

impl Panel<'_> {
    fn facing(&self) -> bool {
        self.normal.z.abs() > FRONT_OR_BACK
    }

    fn world(&self, p: DVec2) -> DVec3 {
        self.pose.rotation * p.extend(0.0) + self.pose.translation
    }

    fn top(&self) -> f64 {
        self.outline.iter().map(|&p| self.world(p).y).fold(f64::NEG_INFINITY, f64::max)
    }

    fn nearest_to_middle(&self) -> f64 {
        self.outline.iter().map(|&p| self.world(p).x.abs()).fold(f64::INFINITY, f64::min)
    }
}

fn is_band(piece: &Piece) -> bool {
    let name = piece.name.to_lowercase();
    name.starts_with("wb") || name.contains("waist") || name.contains("band")
}

fn is_torso(piece: &Piece) -> bool {
    let name = piece.name.to_lowercase();
    let elsewhere = ["sleeve", "hood", "cuff", "collar", "skirt", "pant", "leg"];
    !is_band(piece)
        && !elsewhere.iter().any(|w| name.contains(w))
        && (name.contains("torso") || name.contains("bodice") || piece.label.as_deref() == Some("body"))
}

/// Without names: the highest pieces that reach the body's middle.
fn topmost<'a, 'b>(panels: &'b [Panel<'a>]) -> Vec<&'b Panel<'a>> {
    let middle: Vec<&Panel> = panels.iter().filter(|p| p.facing() && p.nearest_to_middle() < 0.05).collect();
    let top = middle.iter().map(|p| p.top()).fold(f64::NEG_INFINITY, f64::max);
    middle.into_iter().filter(|p| p.top() > top - 0.1).collect()
}

fn placed_panels(pattern: &Pattern) -> Vec<Panel<'_>> {
    let shifts = seam_shifts(pattern);
    pattern
        .pieces
        .iter()
        .filter_map(|(&id, piece)| {
            let mut pose = piece.placement?;
            pose.translation.y += shifts.get(&id).copied().unwrap_or(0.0);
            let side = if piece.signed_area() < 0.0 { DVec3::NEG_Z } else { DVec3::Z };
            Some(Panel { id, piece, pose, normal: pose.rotation * side, outline: piece.flattened(1e-3) })
        })
        .collect()
}

/// How far up each piece goes so that seams lie at one height: least squares, held lightly to the file's placement.
fn seam_shifts(pattern: &Pattern) -> BTreeMap<PieceId, f64> {
    let mut equations: Vec<(PieceId, PieceId, f64, f64)> = Vec::new();
    let fractions: Vec<f64> = (0..=8).map(|k| f64::from(k) / 8.0).collect();
    for seam in pattern.seams.values() {
        let mean_height = |side: &crate::pattern::EdgeRef| -> Option<(f64, f64)> {
            let piece = pattern.pieces.get(&side.piece)?;
            let pose = piece.placement?;
            if side.edge >= piece.outline.len() {
                return None;
            }
            let points = piece.edge_points(side.edge, &fractions);
            let sum: f64 = points.iter().map(|p| (pose.rotation * p.extend(0.0) + pose.translation).y).sum();
            Some((sum / points.len() as f64, piece.edge_length(side.edge)))
        };
        if let (Some((a, length)), Some((b, _))) = (mean_height(&seam.sides[0]), mean_height(&seam.sides[1]))
        {
            equations.push((seam.sides[0].piece, seam.sides[1].piece, b - a, length));
        }
    }
    let mut shifts: BTreeMap<PieceId, f64> = pattern.pieces.keys().map(|&id| (id, 0.0)).collect();
    for _ in 0..200 {
        for &id in pattern.pieces.keys() {
            let (mut sum, mut weight) = (0.0, 0.02);
            for &(a, b, gap, length) in &equations {
                if a != b && a == id {
                    sum += length * (shifts[&b] + gap);
                    weight += length;
                } else if a != b && b == id {
                    sum += length * (shifts[&a] - gap);
                    weight += length;
                }
            }
            shifts.insert(id, sum / weight);
        }
    }
    shifts
}

/// A stroke along `direction` of the world's front plane, in the piece and on the skin.
fn stroke(
    panel: &Panel,
    surface: &Surface,
    direction: DVec2,
    offset: f64,
) -> Option<(Vec<DVec2>, Vec<DVec3>)> {
    let (from, to) = chord(panel, direction)?;
    let middle = (from + to) / 2.0;
    let anchor = panel.world(middle);
    let hit = surface.ray(anchor + panel.normal * 10.0, -panel.normal)?;
    if hit.normal.dot(panel.normal) < TURNED_AWAY {
        return None;
    }
    let along = (panel.world(to) - panel.world(from)).normalize_or_zero();
    let half = (to - from).length() / 2.0;
    // Along a band the skin turns away on purpose: it goes round.
    let turned_away = if direction == DVec2::Y { TURNED_AWAY } else { -0.5 };
    let march = |way: DVec3| march(surface, hit.point, way, panel.normal, half, offset, turned_away);
    let (back, ahead) = (march(-along), march(along));
    let step = (to - from).normalize_or_zero();
    let mut cloth = Vec::new();
    let mut body = Vec::new();
    for (p, s) in back.iter().rev() {
        cloth.push(middle - step * *s);
        body.push(*p);
    }
    cloth.push(middle);
    body.push(hit.point);
    for (p, s) in &ahead {
        cloth.push(middle + step * *s);
        body.push(*p);
    }
    (cloth.len() > 3).then_some((cloth, body))
}

/// The longest run of the piece along `direction`, as near to the body's middle (or the piece's own) as it can be, in the
/// piece's plane and shortened at both ends.
fn chord(panel: &Panel, direction: DVec2) -> Option<(DVec2, DVec2)> {
    let inverse = panel.pose.rotation.inverse();
    let flat = |d: DVec3| {
        let d = inverse * d;
        DVec2::new(d.x, d.y).try_normalize()
    };
    let along = flat(direction.extend(0.0))?;
    let across = along.perp();
    let sides = panel.outline.iter().map(|p| p.dot(across));
    let (low, high) = (sides.clone().fold(f64::INFINITY, f64::min), sides.fold(f64::NEG_INFINITY, f64::max));
    let wanted = if direction == DVec2::Y {
        let origin = inverse * -panel.pose.translation;
        DVec2::new(origin.x, origin.y).dot(across)
    } else {
        (low + high) / 2.0
    };
    let inset = INSET.min((high - low) / 3.0);
    let at = wanted.clamp(low + inset, high - inset) + 1e-5;
    let mut cuts: Vec<f64> = (0..panel.outline.len())
        .filter_map(|i| {
            let (a, b) = (panel.outline[i], panel.outline[(i + 1) % panel.outline.len()]);
            let (sa, sb) = (a.dot(across), b.dot(across));
            ((sa <= at) != (sb <= at)).then(|| (a + (b - a) * ((at - sa) / (sb - sa))).dot(along))
        })
        .collect();
    cuts.sort_by(f64::total_cmp);
    let (from, to) =
        cuts.chunks_exact(2).map(|c| (c[0], c[1])).max_by(|a, b| (a.1 - a.0).total_cmp(&(b.1 - b.0)))?;
    let margin = 0.03 * (to - from);
    let point = |s: f64| along * s + across * at;
    Some((point(from + margin), point(to - margin)))
}

/// Points of the skin from `start` the way of `way`, inside the plane of `way` and `normal`, each with its arc length at
/// the offset, up to `length`; shorter where the skin turns away.
fn march(
    surface: &Surface,
    start: DVec3,
    way: DVec3,
    normal: DVec3,
    length: f64,
    offset: f64,
    turned_away: f64,
) -> Vec<(DVec3, f64)> {
    let side = way.cross(normal).normalize_or_zero();
    let flatten = |p: DVec3| p - side * (p - start).dot(side);
    let mut points = Vec::new();
    let near = surface.nearest(start + normal * offset);
    let mut at = flatten(near.point + near.normal * offset);
    let mut heading = way;
    let mut travelled = 0.0;
    while travelled < length {
        let n = surface.nearest(at).normal;
        let tangent = heading - n * heading.dot(n);
        let tangent = (tangent - side * tangent.dot(side)).normalize_or_zero();
        if tangent == DVec3::ZERO {
            break;
        }
        let step = STEP.min(length - travelled).max(1e-6);
        let near = surface.nearest(at + tangent * step);
        let next = flatten(near.point + near.normal * offset);
        let moved = (next - at).length();
        if moved < 0.2 * step || near.normal.dot(normal) < turned_away {
            break;
        }
        heading = (next - at) / moved;
        travelled += moved;
        at = next;
        points.push((near.point, travelled.min(length)));
    }
    points
}
