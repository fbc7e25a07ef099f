//! Pieces of a pattern at the placements that its file gives them round a body, and how the garment is anchored.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use crate::geometry::ids::PieceId;
use crate::geometry::polygon::contains;
use crate::pattern::fineness::CHORDS;
use crate::pattern::{CutPattern, EdgeRef, Piece, SpacePose};

/// Distance from the plane between left and right within which a piece belongs to the trunk, metres. Chosen by trial.
const AT_THE_MIDDLE: f64 = 0.08;
/// Height below the highest within which something counts as uppermost too, metres. Chosen by trial.
const AS_HIGH: f64 = 0.1;
/// Cosine between a seam and a direction (the vertical, that of a sleeve) above which it runs along that; below, across. Chosen by
/// trial; it is that of about 53°.
pub const RUNS_ALONG: f64 = 0.6;

/// Distance within which a point is on an edge, metres. That with which outlines are flattened where they are measured.
pub const AT_AN_EDGE: f64 = 1e-3;
/// Number of straight segments by which an edge is approximated. Chosen by trial; an arc is then off by a 256th of its height.
pub const EDGE_SAMPLES: u32 = 16;

#[derive(Clone)]
pub(super) struct Panel<'a> {
    pub id: PieceId,
    pub piece: &'a Piece,
    pub pose: SpacePose,
    /// Height by which `pose` is above the placement in the file, metres.
    pub lifted: f64,
    /// Normal of the piece's outer side, a unit vector.
    pub normal: DVec3,
    pub outline: Vec<DVec2>,
}

impl Panel<'_> {
    /// Whether it is more before or behind the body than beside it, turned away by less than about 45°; only such pieces may get marks.
    pub fn facing(&self) -> bool {
        self.normal.z.abs() > 0.7
    }

    pub fn is_front(&self) -> bool {
        self.normal.z > 0.0
    }

    pub fn world(&self, p: DVec2) -> DVec3 {
        self.pose.rotation * p.extend(0.0) + self.pose.translation
    }

    /// The direction `d` projected to the piece's own plane, a unit vector; None when it is perpendicular to that.
    pub fn flat(&self, d: DVec3) -> Option<DVec2> {
        let d = self.pose.rotation.inverse() * d;
        DVec2::new(d.x, d.y).try_normalize()
    }

    pub fn top(&self) -> f64 {
        self.outline.iter().map(|&p| self.world(p).y).fold(f64::NEG_INFINITY, f64::max)
    }

    /// Smallest and largest x of the piece in the world, metres.
    pub fn reach(&self) -> (f64, f64) {
        let xs = self.outline.iter().map(|&p| self.world(p).x);
        (xs.clone().fold(f64::INFINITY, f64::min), xs.fold(f64::NEG_INFINITY, f64::max))
    }

    fn at_the_middle(&self) -> bool {
        let sides = || self.outline.iter().map(|&p| self.world(p).x);
        sides().any(|x| x < AT_THE_MIDDLE) && sides().any(|x| x > -AT_THE_MIDDLE)
    }

    /// The longest segment of the line in direction `along` (unit, in the piece's plane), `at` metres across it, that
    /// is on the piece.
    pub fn run(&self, along: DVec2, at: f64) -> Option<(DVec2, DVec2)> {
        self.runs(along, at).into_iter().max_by(|a, b| a.0.distance(a.1).total_cmp(&b.0.distance(b.1)))
    }

    /// All segments on the piece of the line in direction `along`, `at` metres across it, in order.
    fn runs(&self, along: DVec2, at: f64) -> Vec<(DVec2, DVec2)> {
        let across = along.perp();
        // Avoid passing exactly through corners of the outline.
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

    /// The point `depth` metres under the upper border at the given `x` (m) of the world, or half way down where the
    /// piece is shorter. None where one of the `sewn` edges is uppermost.
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

    /// Whether edge `edge` passes within [`AT_AN_EDGE`] of `p`.
    fn is_near(&self, edge: usize, p: DVec2) -> bool {
        edge_places(self, edge).windows(2).any(|w| distance_to(p, w[0].0, w[1].0) < AT_AN_EDGE)
    }

    /// Horizontal segments on the piece at height `y` of the world, from right to left.
    pub fn level(&self, y: f64) -> Vec<(DVec2, DVec2)> {
        let (Some(along), Some(up)) = (self.flat(DVec3::X), self.flat(DVec3::Y)) else { return Vec::new() };
        let rise = (self.pose.rotation * up.extend(0.0)).y;
        let point = up * ((y - self.pose.translation.y) / rise);
        self.runs(along, point.dot(along.perp()))
    }
}

/// Whether one of `runs` ends at an edge of `panel` among `edges`; also true when it has none among them.
pub(super) fn ends_at(panel: &Panel, edges: &[EdgeRef], runs: &[(DVec2, DVec2)]) -> bool {
    let mut own = edges.iter().filter(|e| e.piece == panel.id).peekable();
    own.peek().is_none()
        || own.any(|e| runs.iter().any(|&(a, b)| panel.is_near(e.edge, a) || panel.is_near(e.edge, b)))
}

/// The `runs` of `panel` (from right to left) between its side seams: what is beyond an edge among `sides` is a sleeve.
pub(super) fn between_sides(
    panel: &Panel,
    sides: &[EdgeRef],
    runs: Vec<(DVec2, DVec2)>,
) -> Vec<(DVec2, DVec2)> {
    let is_side = |p: DVec2| sides.iter().any(|e| e.piece == panel.id && panel.is_near(e.edge, p));
    let x = |p: DVec2| panel.world(p).x;
    let right = runs.iter().filter(|r| x(r.0) < 0.0 && is_side(r.0)).map(|r| x(r.0));
    let left = runs.iter().filter(|r| x(r.1) > 0.0 && is_side(r.1)).map(|r| x(r.1));
    let (right, left) = (right.fold(f64::NEG_INFINITY, f64::max), left.fold(f64::INFINITY, f64::min));
    runs.into_iter().filter(|&(a, b)| x(b) > right && x(a) < left).collect()
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

/// Whether a piece leads over the shoulder from front to back, by its label or name: raglan sleeve, strap, yoke.
fn leads_over(piece: &Piece) -> bool {
    let name = piece.name.to_lowercase();
    piece.label.as_deref() == Some("arm") || ["sleeve", "strap", "yoke"].iter().any(|w| name.contains(w))
}

/// Where a panel of the trunk reaches the top of a shoulder.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crest {
    /// The panel.
    pub piece: PieceId,
    at: CrestAt,
}

#[derive(Clone, Copy, Debug)]
enum CrestAt {
    /// At an edge, the shoulder seam.
    Edge(usize),
    /// Above a point at which another piece continues over the shoulder, by a height in metres.
    Above(DVec3, f64),
}

impl Crest {
    /// Position of the crest on `panel` as placed flat, metres, no farther than `limit` metres from the plane between
    /// left and right.
    pub fn within(&self, panel: &Panel, limit: f64) -> Option<DVec3> {
        match self.at {
            CrestAt::Edge(edge) => edge_within(panel, edge, limit),
            CrestAt::Above(end, by) => Some((end + DVec3::Y * by).with_x(end.x.clamp(-limit, limit))),
        }
    }
}

/// The panels by which a garment is anchored to the body, and how.
pub(super) enum Anchor<'a> {
    /// Panels of the trunk that hang from the shoulders, by shoulder seams or by pieces that lead over the shoulders.
    Shoulders(Vec<Panel<'a>>, Vec<Crest>),
    /// Panels of the topmost ring, which holds where it is too tight to slide farther down.
    Ring(Vec<Panel<'a>>),
}

/// The anchor of a garment with placed pieces.
pub(super) fn anchor(pattern: &CutPattern) -> Anchor<'_> {
    let placed = placed_panels(pattern);
    let panels: Vec<Panel> = placed.iter().filter(|p| p.facing()).cloned().collect();
    let by_id: BTreeMap<PieceId, &Panel> = panels.iter().map(|p| (p.id, p)).collect();
    let shoulders: Vec<[EdgeRef; 2]> = front_to_back(pattern, &by_id)
        .filter(|sides| {
            sides.iter().all(|s| {
                let panel = by_id[&s.piece];
                panel.at_the_middle() && !is_elsewhere(panel.piece) && climb(panel, s.edge) < RUNS_ALONG
            })
        })
        .collect();
    // Only seams at the top are shoulder seams; a seam between the legs also runs across.
    let height = |sides: &[EdgeRef; 2]| edge_middle(by_id[&sides[0].piece], sides[0].edge).y;
    let highest = shoulders.iter().map(height).fold(f64::NEG_INFINITY, f64::max);
    let shoulders: Vec<[EdgeRef; 2]> =
        shoulders.iter().filter(|s| height(s) > highest - AS_HIGH).copied().collect();
    let seams = shoulders.iter().flatten();
    let mut crests: Vec<Crest> = seams.map(|s| Crest { piece: s.piece, at: CrestAt::Edge(s.edge) }).collect();
    if crests.is_empty() {
        crests = led_over(pattern, &placed);
    }
    let shouldered = |p: &Panel| crests.iter().any(|crest| crest.piece == p.id);
    if !crests.is_empty() {
        return Anchor::Shoulders(panels.into_iter().filter(|p| shouldered(p)).collect(), crests);
    }
    let bands = panels.iter().filter(|p| is_band(p.piece)).count();
    if bands > 0 {
        return Anchor::Ring(panels.into_iter().filter(|p| is_band(p.piece)).collect());
    }
    let middle: Vec<Panel> = panels.into_iter().filter(Panel::at_the_middle).collect();
    let top = middle.iter().map(Panel::top).fold(f64::NEG_INFINITY, f64::max);
    Anchor::Ring(middle.into_iter().filter(|p| p.top() > top - AS_HIGH).collect())
}

/// Upper end of the seam between a panel of the trunk and a piece that leads over the shoulder.
struct Lead<'a> {
    trunk: &'a Panel<'a>,
    over: PieceId,
    /// Position in the world with the trunk's panel as placed, metres.
    end: DVec3,
    /// The same point in the plane of the piece that leads over.
    flat: DVec2,
}

/// Crests of panels of the trunk that have no shoulder seam: half way over the piece that leads from the front panel
/// to the back one, or at the seam of the two pieces that do.
fn led_over(pattern: &CutPattern, placed: &[Panel]) -> Vec<Crest> {
    let by_id: BTreeMap<PieceId, &Panel> = placed.iter().map(|p| (p.id, p)).collect();
    let mut leads: BTreeMap<(PieceId, PieceId), Lead> = BTreeMap::new();
    for (ours, other, ends) in paired_ends(pattern) {
        let (Some(trunk), Some(over)) = (by_id.get(&ours), by_id.get(&other)) else { continue };
        let is_trunk = trunk.facing() && trunk.at_the_middle() && !leads_over(trunk.piece);
        if !is_trunk || is_elsewhere(trunk.piece) || !leads_over(over.piece) {
            continue;
        }
        for [own, flat] in ends {
            let end = trunk.world(own);
            let lead = Lead { trunk, over: over.id, end, flat };
            match leads.get(&(ours, other)) {
                Some(known) if known.end.y >= end.y => {}
                _ => _ = leads.insert((ours, other), lead),
            }
        }
    }
    let leads: Vec<Lead> = leads.into_values().filter(|l| l.end.y > l.trunk.top() - AS_HIGH).collect();
    let mut crests = Vec::new();
    for front in leads.iter().filter(|lead| lead.trunk.is_front()) {
        for back in leads.iter().filter(|lead| !lead.trunk.is_front()) {
            let Some(ways) = ways_over(pattern, front, back) else { continue };
            for (lead, by) in [front, back].into_iter().zip(ways) {
                crests.push(Crest { piece: lead.trunk.id, at: CrestAt::Above(lead.end, by) });
            }
        }
    }
    crests
}

/// Distances from the front and the back panel to the top of the shoulder over the pieces that lead over it, metres.
/// None where nothing connects the two.
fn ways_over(pattern: &CutPattern, front: &Lead, back: &Lead) -> Option<[f64; 2]> {
    if front.over == back.over {
        return Some([front.flat.distance(back.flat) / 2.0; 2]);
    }
    let seams = paired_ends(pattern).filter(|(one, other, _)| (*one, *other) == (front.over, back.over));
    let ways = seams
        .flat_map(|(_, _, ends)| ends)
        .map(|[one, other]| [front.flat.distance(one), back.flat.distance(other)]);
    ways.min_by(|a, b| (a[0] + a[1]).total_cmp(&(b[0] + b[1])))
}

/// Every seam between two outlines, in both directions: the one piece, the other, and the ends of the seam on both.
fn paired_ends(pattern: &CutPattern) -> impl Iterator<Item = (PieceId, PieceId, [[DVec2; 2]; 2])> {
    pattern.edge_seams().flat_map(|seam| {
        let ends = seam.sides.map(|side| {
            let piece = pattern.pieces.get(&side.piece)?;
            (side.edge < piece.outline.len()).then(|| piece.edge_ends(side.edge))
        });
        let [Some((a, b)), Some((mut c, mut d))] = ends else { return Vec::new() };
        if !seam.same_direction {
            (c, d) = (d, c);
        }
        let [one, other] = seam.sides.map(|side| side.piece);
        vec![(one, other, [[a, c], [b, d]]), (other, one, [[c, a], [d, b]])]
    })
}

/// Seams between a piece in front of the body and one behind it.
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

/// The edges of side seams: by which `panels` in front and behind are sewn together, running up and down.
pub(super) fn sides(pattern: &CutPattern, panels: &[Panel]) -> Vec<EdgeRef> {
    let by_id: BTreeMap<PieceId, &Panel> = panels.iter().map(|p| (p.id, p)).collect();
    front_to_back(pattern, &by_id).flatten().filter(|s| climb(by_id[&s.piece], s.edge) > RUNS_ALONG).collect()
}

/// The part of a panel's upper edge on one side of the body that is sewn to a panel on the other side (front or back).
pub(super) struct Over<'a> {
    pub panel: &'a Panel<'a>,
    /// Points from the middle of the body outward: in the panel's plane, and in the world.
    pub points: Vec<(DVec2, DVec3)>,
}

impl Over<'_> {
    /// Distance of its outer end from the plane between left and right, metres.
    pub fn reach(&self) -> f64 {
        self.points.last().map_or(0.0, |(_, p)| p.x.abs())
    }
}

/// The upper edges of `panels` over the shoulders, and over the arms where sleeves are cut in one with them.
pub(super) fn over<'a>(pattern: &CutPattern, panels: &'a [Panel<'a>]) -> Vec<Over<'a>> {
    let by_id: BTreeMap<PieceId, &Panel> = panels.iter().map(|p| (p.id, p)).collect();
    let edges: Vec<EdgeRef> = front_to_back(pattern, &by_id).flatten().collect();
    let mut found = Vec::new();
    for (panel, left) in panels.iter().flat_map(|panel| [(panel, true), (panel, false)]) {
        let own = edges.iter().filter(|e| e.piece == panel.id && climb(panel, e.edge) < RUNS_ALONG);
        let upper = own.filter(|e| is_upper(panel, e.edge));
        let places = upper.flat_map(|e| edge_places(panel, e.edge));
        let mut points: Vec<(DVec2, DVec3)> = places.filter(|(_, p)| (p.x > 0.0) == left).collect();
        points.sort_by(|a, b| a.1.x.abs().total_cmp(&b.1.x.abs()));
        if !points.is_empty() {
            found.push(Over { panel, points });
        }
    }
    found
}

/// Whether the panel is below the edge and not above it, by a point on either side: half a centimetre away, clear of the chords of the
/// outline.
fn is_upper(panel: &Panel, edge: usize) -> bool {
    let places = edge_places(panel, edge);
    let (Some(up), Some((middle, _))) = (panel.flat(DVec3::Y), places.get(places.len() / 2)) else {
        return false;
    };
    let aside = up * 5e-3;
    contains(&panel.outline, *middle - aside) && !contains(&panel.outline, *middle + aside)
}

/// The edges of all seams among `panels`.
pub(super) fn seams_among(pattern: &CutPattern, panels: &[Panel]) -> Vec<EdgeRef> {
    let has = |s: &EdgeRef| panels.iter().any(|p| p.id == s.piece && s.edge < p.piece.outline.len());
    pattern.edge_seams().map(|s| s.sides).filter(|sides| sides.iter().all(has)).flatten().collect()
}

/// Cosine of the angle between an edge and the vertical.
fn climb(panel: &Panel, edge: usize) -> f64 {
    let (a, b) = panel.piece.edge_ends(edge);
    (panel.world(b) - panel.world(a)).normalize_or_zero().y.abs()
}

fn edge_middle(panel: &Panel, edge: usize) -> DVec3 {
    panel.piece.edge_points(edge, &[0.5]).first().map_or(DVec3::ZERO, |&p| panel.world(p))
}

/// The point of an edge nearest to its middle that is no farther than `limit` metres from the plane between left and
/// right; else its innermost point.
fn edge_within(panel: &Panel, edge: usize, limit: f64) -> Option<DVec3> {
    let points: Vec<DVec3> = edge_places(panel, edge).into_iter().map(|(_, p)| p).collect();
    let middle = points.get(points.len() / 2)?;
    let wanted = middle.x.abs().min(limit);
    points.iter().copied().min_by(|a, b| (a.x.abs() - wanted).abs().total_cmp(&(b.x.abs() - wanted).abs()))
}

/// Points at even fractions of an edge: in the panel's plane, and in the world.
fn edge_places(panel: &Panel, edge: usize) -> Vec<(DVec2, DVec3)> {
    let fractions: Vec<f64> = (0..=EDGE_SAMPLES).map(|k| f64::from(k) / f64::from(EDGE_SAMPLES)).collect();
    panel.piece.edge_points(edge, &fractions).into_iter().map(|p| (p, panel.world(p))).collect()
}

/// Widths, `depth` metres under their tops, of pieces that face sideways and reach as high as `panels`, metres.
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
                outline: piece.flattened(CHORDS),
            })
        })
        .collect()
}

/// For each piece how far it is raised so that its seams are at one height, metres: a least squares fit, weakly held
/// to the placement in the file.
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
