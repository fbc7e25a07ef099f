//! The pieces of a pattern where its file placed them round a body.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use crate::geometry::ids::PieceId;
use crate::pattern::{CutPattern, EdgeRef, Piece, SpacePose};

/// Pieces whose outer side looks this far (cosine) to the front or back are candidates for marks.
const FRONT_OR_BACK: f64 = 0.7;
/// A piece that comes this near to the plane between left and right belongs to the trunk, metres.
const AT_THE_MIDDLE: f64 = 0.08;
/// What reaches as high as the highest, but for so much, is uppermost with it, metres.
const AS_HIGH: f64 = 0.1;
/// Seams that climb less than this cosine lie across, those that climb more than its complement run up and down.
const ACROSS: f64 = 0.6;

/// A point this near an edge lies on it, metres.
const AT_AN_EDGE: f64 = 1e-3;
/// Edges are looked at as so many straight pieces.
const EDGE_SAMPLES: u32 = 16;

pub(super) struct Panel<'a> {
    pub id: PieceId,
    pub piece: &'a Piece,
    pub pose: SpacePose,
    /// How far above where the file placed it that is, metres.
    pub lifted: f64,
    /// Unit, the way its outer side looks.
    pub normal: DVec3,
    pub outline: Vec<DVec2>,
}

impl Panel<'_> {
    pub fn facing(&self) -> bool {
        self.normal.z.abs() > FRONT_OR_BACK
    }

    pub fn is_front(&self) -> bool {
        self.normal.z > 0.0
    }

    pub fn world(&self, p: DVec2) -> DVec3 {
        self.pose.rotation * p.extend(0.0) + self.pose.translation
    }

    /// The direction `d` in the piece's own plane, unit; none when it stands across it.
    pub fn flat(&self, d: DVec3) -> Option<DVec2> {
        let d = self.pose.rotation.inverse() * d;
        DVec2::new(d.x, d.y).try_normalize()
    }

    pub fn top(&self) -> f64 {
        self.outline.iter().map(|&p| self.world(p).y).fold(f64::NEG_INFINITY, f64::max)
    }

    /// From where to where it reaches between right and left in the world, metres.
    pub fn reach(&self) -> (f64, f64) {
        let xs = self.outline.iter().map(|&p| self.world(p).x);
        (xs.clone().fold(f64::INFINITY, f64::min), xs.fold(f64::NEG_INFINITY, f64::max))
    }

    fn at_the_middle(&self) -> bool {
        let sides = || self.outline.iter().map(|&p| self.world(p).x);
        sides().any(|x| x < AT_THE_MIDDLE) && sides().any(|x| x > -AT_THE_MIDDLE)
    }

    /// The longest run of the piece along `along` (unit, in its plane) at `at` metres across it.
    pub fn run(&self, along: DVec2, at: f64) -> Option<(DVec2, DVec2)> {
        self.runs(along, at).into_iter().max_by(|a, b| a.0.distance(a.1).total_cmp(&b.0.distance(b.1)))
    }

    /// Every run of the piece along `along` at `at` metres across it, in order.
    fn runs(&self, along: DVec2, at: f64) -> Vec<(DVec2, DVec2)> {
        let across = along.perp();
        // Aside of the outline's own corners.
        let at = at + 1e-5;
        let mut cuts: Vec<f64> = (0..self.outline.len())
            .filter_map(|i| {
                let (a, b) = (self.outline[i], self.outline[(i + 1) % self.outline.len()]);
                let (sa, sb) = (a.dot(across), b.dot(across));
                ((sa <= at) != (sb <= at)).then(|| (a + (b - a) * ((at - sa) / (sb - sa))).dot(along))
            })
            .collect();
        cuts.sort_by(f64::total_cmp);
        let point = |s: f64| along * s + across * at;
        cuts.chunks_exact(2).map(|c| (point(c[0]), point(c[1]))).collect()
    }

    /// The place `depth` under the upper border at `x` metres of the world, or half way down where that is nearer; none
    /// where one of the `sewn` edges is uppermost.
    pub fn under_top(&self, x: f64, depth: f64, sewn: &[EdgeRef]) -> Option<DVec2> {
        let up = self.flat(DVec3::Y)?;
        let right = self.flat(DVec3::X)?;
        let point = right * ((x - self.pose.translation.x) / (self.pose.rotation * right.extend(0.0)).x);
        let (low, high) = self.runs(up, point.dot(up.perp())).pop()?;
        if sewn.iter().any(|e| e.piece == self.id && self.is_near(e.edge, high)) {
            return None;
        }
        Some(high - up * depth.min((high - low).length() / 2.0))
    }

    /// Whether edge `edge` passes `p`.
    fn is_near(&self, edge: usize, p: DVec2) -> bool {
        let fractions: Vec<f64> =
            (0..=EDGE_SAMPLES).map(|k| f64::from(k) / f64::from(EDGE_SAMPLES)).collect();
        let points = self.piece.edge_points(edge, &fractions);
        points.windows(2).any(|w| distance_to(p, w[0], w[1]) < AT_AN_EDGE)
    }

    /// The horizontal runs at height `y` of the world, from right to left.
    pub fn level(&self, y: f64) -> Vec<(DVec2, DVec2)> {
        let (Some(along), Some(up)) = (self.flat(DVec3::X), self.flat(DVec3::Y)) else { return Vec::new() };
        let rise = (self.pose.rotation * up.extend(0.0)).y;
        let point = up * ((y - self.pose.translation.y) / rise);
        self.runs(along, point.dot(along.perp()))
    }
}

/// Whether a run of `panel` ends at one of its edges among `edges`, or it has none among them.
pub(super) fn ends_at(panel: &Panel, edges: &[EdgeRef], runs: &[(DVec2, DVec2)]) -> bool {
    let mut own = edges.iter().filter(|e| e.piece == panel.id).peekable();
    own.peek().is_none()
        || own.any(|e| runs.iter().any(|&(a, b)| panel.is_near(e.edge, a) || panel.is_near(e.edge, b)))
}

fn distance_to(p: DVec2, a: DVec2, b: DVec2) -> f64 {
    let along = b - a;
    let t = ((p - a).dot(along) / along.length_squared().max(1e-12)).clamp(0.0, 1.0);
    p.distance(a + along * t)
}

fn is_band(piece: &Piece) -> bool {
    let name = piece.name.to_lowercase();
    name.starts_with("wb") || name.contains("waist") || name.contains("band")
}

fn is_elsewhere(piece: &Piece) -> bool {
    let name = piece.name.to_lowercase();
    ["sleeve", "hood", "cuff", "collar", "skirt", "pant", "leg"].iter().any(|w| name.contains(w))
}

/// What of a garment is best anchored, and how it hangs there.
pub(super) enum Anchor<'a> {
    /// Its trunk hangs from the shoulders, by the seams that run over them.
    Shoulders(Vec<Panel<'a>>, Vec<[EdgeRef; 2]>),
    /// Its topmost ring holds where it is too tight to slide farther down.
    Ring(Vec<Panel<'a>>),
}

/// The anchor of a placed garment.
pub(super) fn anchor(pattern: &CutPattern) -> Anchor<'_> {
    let panels: Vec<Panel> = placed_panels(pattern).into_iter().filter(Panel::facing).collect();
    let by_id: BTreeMap<PieceId, &Panel> = panels.iter().map(|p| (p.id, p)).collect();
    let shoulders: Vec<[EdgeRef; 2]> = front_to_back(pattern, &by_id)
        .filter(|sides| {
            sides.iter().all(|s| {
                let panel = by_id[&s.piece];
                panel.at_the_middle() && !is_elsewhere(panel.piece) && climb(panel, s.edge) < ACROSS
            })
        })
        .collect();
    // Only what lies at the top is a shoulder; a seam between the legs also runs across.
    let height = |sides: &[EdgeRef; 2]| edge_middle(by_id[&sides[0].piece], sides[0].edge).y;
    let highest = shoulders.iter().map(height).fold(f64::NEG_INFINITY, f64::max);
    let shoulders: Vec<[EdgeRef; 2]> =
        shoulders.iter().filter(|s| height(s) > highest - AS_HIGH).copied().collect();
    let shouldered = |p: &Panel| shoulders.iter().flatten().any(|s| s.piece == p.id);
    if !shoulders.is_empty() {
        return Anchor::Shoulders(panels.into_iter().filter(|p| shouldered(p)).collect(), shoulders);
    }
    let bands = panels.iter().filter(|p| is_band(p.piece)).count();
    if bands > 0 {
        return Anchor::Ring(panels.into_iter().filter(|p| is_band(p.piece)).collect());
    }
    let middle: Vec<Panel> = panels.into_iter().filter(Panel::at_the_middle).collect();
    let top = middle.iter().map(Panel::top).fold(f64::NEG_INFINITY, f64::max);
    Anchor::Ring(middle.into_iter().filter(|p| p.top() > top - AS_HIGH).collect())
}

/// Seams from a piece before the body to one behind it.
fn front_to_back<'a>(
    pattern: &'a CutPattern,
    by_id: &'a BTreeMap<PieceId, &Panel>,
) -> impl Iterator<Item = [EdgeRef; 2]> + 'a {
    pattern.edge_seams().map(|s| s.sides).filter(|sides| {
        let fronts = sides.map(|s| by_id.get(&s.piece).map(|p| p.is_front()));
        let edges = sides.iter().all(|s| by_id.get(&s.piece).is_some_and(|p| s.edge < p.piece.outline.len()));
        edges && matches!(fronts, [Some(a), Some(b)] if a != b)
    })
}

/// The edges by which `panels` are sewn together at the sides, front to back, with their pieces.
pub(super) fn sides(pattern: &CutPattern, panels: &[Panel]) -> Vec<EdgeRef> {
    let by_id: BTreeMap<PieceId, &Panel> = panels.iter().map(|p| (p.id, p)).collect();
    front_to_back(pattern, &by_id).flatten().filter(|s| climb(by_id[&s.piece], s.edge) > ACROSS).collect()
}

/// All edges by which `panels` are sewn to one another.
pub(super) fn seams_among(pattern: &CutPattern, panels: &[Panel]) -> Vec<EdgeRef> {
    let has = |s: &EdgeRef| panels.iter().any(|p| p.id == s.piece && s.edge < p.piece.outline.len());
    pattern.edge_seams().map(|s| s.sides).filter(|sides| sides.iter().all(has)).flatten().collect()
}

/// Cosine between an edge and the vertical.
fn climb(panel: &Panel, edge: usize) -> f64 {
    let (a, b) = panel.piece.edge_ends(edge);
    (panel.world(b) - panel.world(a)).normalize_or_zero().y.abs()
}

fn edge_middle(panel: &Panel, edge: usize) -> DVec3 {
    panel.piece.edge_points(edge, &[0.5]).first().map_or(DVec3::ZERO, |&p| panel.world(p))
}

/// The place on an edge nearest to its middle that is no farther than `limit` metres from the plane between left and right;
/// else its innermost.
pub(super) fn edge_within(panel: &Panel, edge: usize, limit: f64) -> Option<DVec3> {
    let fractions: Vec<f64> = (0..=EDGE_SAMPLES).map(|k| f64::from(k) / f64::from(EDGE_SAMPLES)).collect();
    let points: Vec<DVec3> =
        panel.piece.edge_points(edge, &fractions).into_iter().map(|p| panel.world(p)).collect();
    let middle = points.get(points.len() / 2)?;
    let wanted = middle.x.abs().min(limit);
    points.iter().copied().min_by(|a, b| (a.x.abs() - wanted).abs().total_cmp(&(b.x.abs() - wanted).abs()))
}

/// How broad those pieces are `depth` metres under their tops that look sideways and reach as high as `panels`, metres.
pub(super) fn besides(pattern: &CutPattern, panels: &[Panel], depth: f64) -> impl Iterator<Item = f64> {
    let top = panels.iter().map(Panel::top).fold(f64::NEG_INFINITY, f64::max);
    let broad = move |panel: Panel| -> Option<f64> {
        let along = panel.flat(DVec3::Y.cross(panel.normal))?;
        let up = along.perp() * panel.flat(DVec3::Y)?.dot(along.perp()).signum();
        let highest = panel.outline.iter().map(|p| p.dot(up)).fold(f64::NEG_INFINITY, f64::max);
        let (a, b) = panel.run(along, (up * (highest - depth)).dot(along.perp()))?;
        Some(a.distance(b))
    };
    let beside = placed_panels(pattern).into_iter().filter(|panel| !panel.facing());
    let reaching = beside.filter(|panel| panel.top() > top - AS_HIGH);
    reaching.filter_map(broad).collect::<Vec<_>>().into_iter()
}

fn placed_panels(pattern: &CutPattern) -> Vec<Panel<'_>> {
    let shifts = seam_shifts(pattern);
    pattern
        .pieces
        .iter()
        .filter_map(|(&id, piece)| {
            let mut pose = piece.placement?;
            let lifted = shifts.get(&id).copied().unwrap_or(0.0);
            pose.translation.y += lifted;
            let side = if piece.signed_area() < 0.0 { DVec3::NEG_Z } else { DVec3::Z };
            Some(Panel {
                id,
                piece,
                pose,
                lifted,
                normal: pose.rotation * side,
                outline: piece.flattened(1e-3),
            })
        })
        .collect()
}

/// How far up each piece goes so that seams lie at one height: least squares, held lightly to the file's placement.
fn seam_shifts(pattern: &CutPattern) -> BTreeMap<PieceId, f64> {
    let mut equations: Vec<(PieceId, PieceId, f64, f64)> = Vec::new();
    let fractions: Vec<f64> = (0..=8).map(|k| f64::from(k) / 8.0).collect();
    for seam in pattern.edge_seams() {
        let mean_height = |side: &EdgeRef| -> Option<(f64, f64)> {
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
