//! Suggested marks, from the placements that the pattern's file gives its pieces round the body.
//!
//! The file tells what is front, back, left and right, and which way is up; the body tells at what height a piece
//! goes. A garment that hangs from the shoulders is measured down from there over the skin; a waistband rests where
//! it is too tight to slide farther. Only those pieces get marks: sleeves and legs follow their seams better than
//! marks of their own. A ring of strokes goes round the trunk (under the arms, so that side seams close on the right
//! side of them), stretched as one so that its ends meet. Pieces of the trunk also get a stroke up and down through
//! them, by their own arc length, and those that are cut in one with their sleeves one along each arm.

use glam::{DVec2, DVec3};

use crate::body::{Surface, Trunk};
use crate::geometry::ids::MarkId;
use crate::pattern::{CutPattern, EdgeRef, Pattern};
use crate::wrap::placed::{
    Anchor, Crest, Over, Panel, anchor, besides, between_sides, ends_at, over, seams_among, sides,
};
use crate::wrap::{BodyMark, ClothMark, ClothSide, Marks};

/// Cosine between the skin's normal and the piece's below which a stroke ends. Chosen by trial: beyond some 70° a stroke would go
/// on to the side of the body.
const TURNED_AWAY: f64 = 0.3;
/// Step of the march over the skin, metres. Chosen by trial; it bounds how exactly strokes follow the skin.
const STEP: f64 = 0.005;
/// Distance of strokes from the sides of their piece, metres. Chosen by trial; it bounds how near strokes come to seams.
const INSET: f64 = 0.015;
/// Distance of a ring of strokes under what it must stay clear of, metres on a body 1.5 m large: the arms and the top of the side
/// seams, or the upper border of a garment that it carries. Chosen by trial.
const RING_UNDER: f64 = 0.02;
/// Largest distance from the middle at which paths down from the shoulders begin, as a fraction of the trunk's half
/// breadth: farther out they would run round an arm.
const INSIDE_ARMS: f64 = 0.75;
/// Distance beyond the start of the arm that a panel must reach to count as having sleeves, metres on a body 1.5 m large. Chosen by
/// trial; shorter ones follow their seams without marks of their own.
const SLEEVE: f64 = 0.1;
/// Distance of cloth and seams from the skin round a limb before they are sewn, metres on a body 1.5 m large. Chosen by trial; it
/// bounds how much of a limb's shape may lie outside of a tube round it.
pub const ROUND_LIMBS: f64 = 0.02;
/// Largest distance by which the ring is lowered below its first height under the arms, metres on a body 1.5 m large. Chosen by
/// trial; it bounds how deep armholes may be.
const LOWER: f64 = 0.2;

/// Marks for the pieces of `pattern` that have a placement; empty when none of them can anchor the garment.
/// `offset` is the height of the cloth above the skin, metres.
pub fn suggested(pattern: &Pattern, surface: &Surface, offset: f64) -> Marks {
    let trunk = Trunk::new(&surface.mesh);
    let mut strokes: Vec<Stroke> = Vec::new();
    let (cut, _) = CutPattern::new(pattern);
    match anchor(&cut) {
        Anchor::Shoulders(panels, crests) => {
            let hung = trunk.as_ref().and_then(|t| hung(&cut, surface, t, &panels, &crests, offset));
            let at = |p: &Panel| hung.map(|h| if p.is_front() { h.front } else { h.back });
            for panel in &panels {
                let height = at(panel).map(|cloth| (cloth, hung.map_or(cloth, |h| h.body)));
                strokes.extend(upright(panel, surface, trunk.as_ref(), height, offset));
            }
            if let (Some(trunk), Some(hung)) = (&trunk, hung) {
                let sides = sides(&cut, &panels);
                let level = |p| Line::level(p, at(p).unwrap_or(hung.body), &sides);
                let lines: Vec<Line> = panels.iter().map(level).collect();
                strokes.extend(ring(&lines, trunk, hung.body, 0.0));
                strokes.extend(along_arms(&cut, surface, trunk, &panels, offset));
            }
        }
        Anchor::Ring(panels) => {
            let depth = RING_UNDER * surface.scale();
            let beside: f64 = besides(&cut, &panels, depth).sum();
            let sewn = if beside > 0.0 { all_sewn(&cut) } else { seams_among(&cut, &panels) };
            let lines: Vec<Line> = panels.iter().map(|p| Line::under_top(p, depth, &sewn)).collect();
            if let Some(trunk) = &trunk
                && let Some(height) = rest_height(trunk, &lines, beside, offset)
            {
                strokes.extend(ring(&lines, trunk, height, beside / 2.0));
            }
            if strokes.is_empty() {
                strokes.extend(panels.iter().filter_map(|p| sideways(p, surface, offset)));
            }
        }
    }
    let mut marks = Marks::default();
    for (stroke, number) in strokes.into_iter().zip(1..) {
        let [id, on_body] = ids(pattern, number);
        let (piece, side) = (stroke.panel, ClothSide::Front);
        marks.cloth.push(ClothMark { id, piece, side, points: stroke.cloth });
        marks.body.push(BodyMark { id: on_body, points: stroke.body });
    }
    marks
}

/// Whether `marks` are those that [`suggested`] gives for `pattern`, which is told by their ids: nobody painted them.
pub fn are_suggested(marks: &Marks, pattern: &Pattern) -> bool {
    let mut pairs = marks.pairs().zip(1..).peekable();
    pairs.peek().is_some() && pairs.all(|((cloth, body), number)| [cloth.id, body.id] == ids(pattern, number))
}

/// Ids of the suggested pair with this number, from 1: on the cloth, and on the body.
fn ids(pattern: &Pattern, number: u32) -> [MarkId; 2] {
    let first = pattern.next_id.wrapping_add(2 * number);
    [MarkId(first), MarkId(first.wrapping_add(1))]
}

/// Height of a placed garment, and where it belongs on a body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stand {
    /// Height of the shoulder seams, or of a ring that is to rest where it is too tight to slide farther, as placed
    /// in the file, metres.
    pub placed: f64,
    /// Height of the skin where that belongs, metres.
    pub body: f64,
    /// Bounding box of the panels that carry the garment: lower and upper corner, metres.
    pub bounds: [DVec3; 2],
    /// Whether the garment hangs from the shoulders.
    pub hangs: bool,
    /// How far the garment must be raised for the arms to be under the seams that run along them, metres; negative
    /// where they are already, negative infinity where there are no such seams.
    pub short_of_arms: f64,
}

/// The height of a placed garment, and the height on `surface` where it belongs. None where neither can be found:
/// nothing is placed before or behind the body. `trunk` is that of `surface`, `offset` as for [`suggested`].
pub fn stand(cut: &CutPattern, surface: &Surface, trunk: &Trunk, offset: f64) -> Option<Stand> {
    let lifted = |panels: &[Panel]| panels.iter().map(|p| p.lifted).sum::<f64>() / panels.len() as f64;
    let bounds = |panels: &[Panel]| {
        let all = || panels.iter().flat_map(|panel| panel.outline.iter().map(|&p| panel.world(p)));
        [all().fold(DVec3::MAX, DVec3::min), all().fold(DVec3::MIN, DVec3::max)]
    };
    match anchor(cut) {
        Anchor::Shoulders(panels, crests) => {
            let limit = shoulder_breadth(trunk)?;
            let height = |crest: &Crest| {
                let panel = panels.iter().find(|p| p.id == crest.piece)?;
                let at = crest.within(panel, limit)?;
                Some((at.y - panel.lifted, on_shoulder(surface, trunk, at.x)?.y))
            };
            let heights: Vec<(f64, f64)> = crests.iter().filter_map(height).collect();
            let sum = heights.iter().fold((0.0, 0.0), |sum, at| (sum.0 + at.0, sum.1 + at.1));
            let count = heights.len() as f64;
            let [placed, body] = [sum.0 / count, sum.1 / count];
            let short_of_arms = short_of_arms(cut, surface, trunk, &panels);
            let stand = Stand { placed, body, bounds: bounds(&panels), hangs: true, short_of_arms };
            (!heights.is_empty()).then_some(stand)
        }
        Anchor::Ring(panels) => {
            let depth = RING_UNDER * surface.scale();
            // Panels at the sides are not part of the ring here, but their seams are side seams of those that are.
            let sewn = all_sewn(cut);
            let lines: Vec<Line> = panels.iter().map(|p| Line::under_top(p, depth, &sewn)).collect();
            let beside: f64 = besides(cut, &panels, depth).sum();
            let along: f64 = lines.iter().map(Line::length).sum();
            let girth = along + beside - std::f64::consts::TAU * offset;
            // A ring too wide to rest anywhere is put on at the waist.
            let waist = trunk.levels.get(trunk.waist()?)?.height;
            let body = trunk.rest_of(girth).filter(|_| girth > 0.0).unwrap_or(waist);
            let top = panels.iter().map(Panel::top).max_by(f64::total_cmp)?;
            let placed = placed_height(&lines).unwrap_or(top) - lifted(&panels);
            Some(Stand {
                placed,
                body,
                bounds: bounds(&panels),
                hangs: false,
                short_of_arms: f64::NEG_INFINITY,
            })
        }
    }
}

/// Upper edges of those `panels` that reach over the arms, being cut in one with their sleeves; and the distance from
/// the plane between left and right at which the arms begin, metres.
fn over_arms<'a>(
    cut: &CutPattern,
    surface: &Surface,
    trunk: &Trunk,
    panels: &'a [Panel<'a>],
) -> (Vec<Over<'a>>, f64) {
    let Some(inside) = shoulder_breadth(trunk) else { return (Vec::new(), 0.0) };
    let arms = inside / INSIDE_ARMS;
    let sleeve = SLEEVE * surface.scale();
    (over(cut, panels).into_iter().filter(|o| o.reach() > arms + sleeve).collect(), arms)
}

/// See [`Stand::short_of_arms`].
fn short_of_arms(cut: &CutPattern, surface: &Surface, trunk: &Trunk, panels: &[Panel]) -> f64 {
    let (over, arms) = over_arms(cut, surface, trunk, panels);
    let room = ROUND_LIMBS * surface.scale();
    let places = over.iter().flat_map(|o| o.points.iter().map(|(_, p)| *p - DVec3::Y * o.panel.lifted));
    let short = |p: DVec3| Some(on_shoulder(surface, trunk, p.x)?.y + room - p.y);
    places.filter(|p| p.x.abs() > arms).filter_map(short).fold(f64::NEG_INFINITY, f64::max)
}

/// Strokes beside the seam over each arm, along the top of the arm, for panels that are cut in one with their sleeves.
fn along_arms(
    cut: &CutPattern,
    surface: &Surface,
    trunk: &Trunk,
    panels: &[Panel],
    offset: f64,
) -> Vec<Stroke> {
    let (over, arms) = over_arms(cut, surface, trunk, panels);
    let along = |over: &Over| {
        let panel = over.panel;
        let up = panel.flat(DVec3::Y)?;
        let beside = DVec3::Z * if panel.is_front() { INSET } else { -INSET };
        let outer: Vec<(DVec2, DVec3)> =
            over.points.iter().copied().filter(|(_, p)| p.x.abs() > arms * INSIDE_ARMS).collect();
        let [(_, first), _, ..] = outer[..] else { return None };
        let start = on_shoulder(surface, trunk, first.x)?;
        let outward = |p: &DVec3| (p.x - trunk.middle) * first.x.signum();
        let hand = surface.mesh.positions.iter().max_by(|a, b| outward(a).total_cmp(&outward(b)))?;
        let way = (*hand - start).normalize_or_zero();
        let under_seam =
            Polyline::new(outer.iter().map(|(flat, _)| (*flat - up * INSET).extend(0.0)).collect());
        let length = under_seam.length() - INSET;
        let marched = march(surface, start + beside, way, DVec3::Y, length, offset, -2.0);
        let at = |s: f64| under_seam.at(s).truncate();
        let (cloth, body): (Vec<DVec2>, Vec<DVec3>) = marched.into_iter().map(|(p, s)| (at(s), p)).unzip();
        (cloth.len() > 3).then_some(Stroke { panel: panel.id, cloth, body })
    };
    over.iter().filter_map(along).collect()
}

/// The edges of all seams.
fn all_sewn(cut: &CutPattern) -> Vec<EdgeRef> {
    cut.edge_seams().flat_map(|seam| seam.sides).collect()
}

struct Stroke {
    panel: crate::geometry::ids::PieceId,
    cloth: Vec<DVec2>,
    body: Vec<DVec3>,
}

/// A path over the skin: points, each with the arc length up to it at the cloth's offset, metres.
type Way = Vec<(DVec3, f64)>;

/// Heights of the placed cloth, in front and behind, and the height of the body where they belong, metres.
#[derive(Clone, Copy, Debug)]
struct Hung {
    front: f64,
    back: f64,
    body: f64,
}

/// Hangs the garment from the shoulders: finds what comes to be under the arms by following the skin down from where the
/// shoulder seams are. Under deep armholes and beside darts a lower level is taken, where the pieces reach their sides.
fn hung(
    pattern: &CutPattern,
    surface: &Surface,
    trunk: &Trunk,
    panels: &[Panel],
    crests: &[Crest],
    offset: f64,
) -> Option<Hung> {
    let limit = shoulder_breadth(trunk)?;
    let ways: Vec<(bool, f64, Way)> = crests
        .iter()
        .filter_map(|crest| {
            let panel = panels.iter().find(|p| p.id == crest.piece)?;
            let at = crest.within(panel, limit)?;
            let way = down_from_shoulder(surface, trunk, at.x, panel.is_front(), offset)?;
            Some((panel.is_front(), at.y, way))
        })
        .collect();
    let cloth = |front: bool, body: f64| -> Option<f64> {
        let of_side = ways.iter().filter(|way| way.0 == front);
        let heights: Vec<f64> = of_side
            .filter_map(|(_, top, way)| Some(top - way.iter().find(|(p, _)| p.y <= body)?.1))
            .collect();
        (!heights.is_empty()).then(|| heights.iter().sum::<f64>() / heights.len() as f64)
    };
    let margin = RING_UNDER * surface.scale();
    let sides = sides(pattern, panels);
    let highest = trunk.armpit? - margin;
    let lowest = (highest - LOWER * surface.scale()).max(trunk.crotch);
    let hung = |body: f64| Some(Hung { front: cloth(true, body)?, back: cloth(false, body)?, body });
    let steps = ((highest - lowest) / STEP).max(0.0) as usize;
    (0..=steps).map(|k| highest - k as f64 * STEP).filter_map(hung).find(|h| {
        panels.iter().all(|p| {
            let height = if p.is_front() { h.front } else { h.back };
            [height, height + margin].iter().all(|&y| ends_at(p, &sides, &p.level(y)))
        })
    })
}

/// Largest distance from the middle at which paths down from the shoulders begin, metres; None for a body without arms.
fn shoulder_breadth(trunk: &Trunk) -> Option<f64> {
    let under_arm = trunk.nearest(trunk.armpit?)?;
    Some(under_arm.points.iter().map(|p| (p.x - trunk.middle).abs()).fold(0.0, f64::max) * INSIDE_ARMS)
}

/// The top of the shoulder `x` metres left of the middle.
fn on_shoulder(surface: &Surface, trunk: &Trunk, x: f64) -> Option<DVec3> {
    let (lower, upper) = surface.bounds();
    let x = x + trunk.middle;
    let steps = 40;
    (0..=steps)
        .filter_map(|k| {
            let z = lower.z + (upper.z - lower.z) * f64::from(k) / f64::from(steps);
            surface.ray(DVec3::new(x, trunk.neck, z), DVec3::NEG_Y).filter(|h| h.normal.y > 0.0)
        })
        .map(|hit| hit.point)
        .max_by(|a, b| a.y.total_cmp(&b.y))
}

/// The path over the skin from the top of the shoulder at `x` down the front or back of the body.
fn down_from_shoulder(surface: &Surface, trunk: &Trunk, x: f64, front: bool, offset: f64) -> Option<Way> {
    let ridge = on_shoulder(surface, trunk, x)?;
    let way = if front { DVec3::Z } else { DVec3::NEG_Z };
    // On a body 1.5 m large. Chosen by trial; it bounds how far under the shoulders a ring can come to be.
    let longest = 0.6 * surface.scale();
    Some(march(surface, ridge, way, DVec3::Y, longest, offset, -2.0))
}

/// A line over a piece from right to left that becomes a part of a ring round the trunk. Between its runs are darts, sewn shut.
struct Line<'a> {
    panel: &'a Panel<'a>,
    runs: Vec<Vec<DVec2>>,
}

impl<'a> Line<'a> {
    /// The horizontal line at `height` between the edges `sides`.
    fn level(panel: &'a Panel<'a>, height: f64, sides: &[EdgeRef]) -> Self {
        let points = |(a, b): (DVec2, DVec2)| {
            let count = (a.distance(b) / STEP).ceil().max(2.0) as usize;
            (0..=count).map(|k| a.lerp(b, k as f64 / count as f64)).collect()
        };
        let runs = between_sides(panel, sides, panel.level(height));
        Self { panel, runs: runs.into_iter().map(points).collect() }
    }

    /// The line `depth` metres under the upper border, whatever its curve, between the `sewn` edges.
    fn under_top(panel: &'a Panel<'a>, depth: f64, sewn: &[EdgeRef]) -> Self {
        let (right, left) = panel.reach();
        let count = ((left - right) / STEP).ceil().max(2.0) as usize;
        let x = |k: usize| right + (left - right) * (k as f64 + 0.5) / (count as f64 + 1.0);
        Self { panel, runs: vec![(0..=count).filter_map(|k| panel.under_top(x(k), depth, sewn)).collect()] }
    }

    fn length(&self) -> f64 {
        self.runs.iter().flat_map(|run| run.windows(2)).map(|w| w[0].distance(w[1])).sum()
    }

    /// The part of the line on one side of the body: runs from the middle outward, each point with its arc length on
    /// the cloth, metres.
    fn half(&self, left: bool) -> Vec<Vec<(DVec2, f64)>> {
        let side = |q: &DVec2| self.panel.world(*q).x * if left { 1.0 } else { -1.0 };
        let mut runs: Vec<Vec<DVec2>> = Vec::new();
        for run in &self.runs {
            let mut points: Vec<DVec2> = run.iter().copied().filter(|q| side(q) >= 0.0).collect();
            points.sort_by(|a, b| side(a).total_cmp(&side(b)));
            if points.len() > 3 {
                runs.push(points);
            }
        }
        runs.sort_by(|a, b| side(&a[0]).total_cmp(&side(&b[0])));
        let mut at = runs.first().map_or(0.0, |run| side(&run[0]));
        let mut halves = Vec::new();
        for run in runs {
            let mut last = run[0];
            halves.push(
                run.into_iter()
                    .map(|p| {
                        at += p.distance(last);
                        last = p;
                        (p, at)
                    })
                    .collect(),
            );
        }
        halves
    }
}

/// Height of the trunk at which a ring of pieces rests; `beside` metres of its girth are pieces at the sides.
fn rest_height(trunk: &Trunk, lines: &[Line], beside: f64, offset: f64) -> Option<f64> {
    let along: f64 = lines.iter().map(Line::length).sum();
    let girth = along + beside - std::f64::consts::TAU * offset;
    if girth <= 0.0 {
        return None;
    }
    trunk.rest_of(girth).or_else(|| placed_height(lines))
}

/// Mean height of the lines as placed, metres.
fn placed_height(lines: &[Line]) -> Option<f64> {
    let heights = lines.iter().flat_map(|l| l.runs.iter().flatten().map(|&p| l.panel.world(p).y));
    let (sum, count) = heights.fold((0.0, 0.0), |(sum, count), y| (sum + y, count + 1.0));
    (count > 0.0).then(|| sum / count)
}

/// A stroke for each side of each line along the trunk's section at `height`. All lines of a side, front and back, are
/// stretched alike, so that they meet, or leave room between them for `beside` metres of cloth that gets no stroke.
fn ring(lines: &[Line], trunk: &Trunk, height: f64, beside: f64) -> Vec<Stroke> {
    let Some(level) = trunk.nearest(height) else { return Vec::new() };
    let mut strokes = Vec::new();
    for left in [false, true] {
        let Some(way) = half(&level.points, trunk.middle, left) else { continue };
        let runs: Vec<(&Panel, Vec<(DVec2, f64)>)> =
            lines.iter().flat_map(|l| l.half(left).into_iter().map(|run| (l.panel, run))).collect();
        let reach = |front: bool| {
            let ends = runs.iter().filter(|r| r.0.is_front() == front).filter_map(|r| r.1.last());
            ends.map(|e| e.1).fold(0.0, f64::max)
        };
        let stretch = way.length() / (reach(true) + reach(false) + beside);
        for (panel, run) in runs {
            let along = |s: f64| if panel.is_front() { s * stretch } else { way.length() - s * stretch };
            strokes.push(Stroke {
                panel: panel.id,
                cloth: run.iter().map(|r| r.0).collect(),
                body: run.iter().map(|r| way.at(along(r.1))).collect(),
            });
        }
    }
    strokes
}

/// A polyline with the arc length at each point, metres.
struct Polyline {
    points: Vec<DVec3>,
    lengths: Vec<f64>,
}

impl Polyline {
    /// The polyline through two or more points.
    fn new(points: Vec<DVec3>) -> Self {
        let mut lengths = vec![0.0];
        for w in points.windows(2) {
            lengths.push(lengths[lengths.len() - 1] + w[0].distance(w[1]));
        }
        Self { points, lengths }
    }

    fn length(&self) -> f64 {
        *self.lengths.last().unwrap_or(&0.0)
    }

    fn at(&self, s: f64) -> DVec3 {
        let i = self.lengths.partition_point(|&l| l <= s).clamp(1, self.points.len() - 1);
        let span = self.lengths[i] - self.lengths[i - 1];
        let f = if span > 0.0 { ((s - self.lengths[i - 1]) / span).clamp(0.0, 1.0) } else { 0.0 };
        self.points[i - 1].lerp(self.points[i], f)
    }
}

/// Half a section, from its front in the middle over one side to its back in the middle. None when it does not cross
/// the middle twice.
fn half(section: &[DVec3], middle: f64, left: bool) -> Option<Polyline> {
    let side = |p: DVec3| if left { p.x - middle } else { middle - p.x };
    let n = section.len();
    let cut = |i: usize| {
        let (a, b) = (section[i], section[(i + 1) % n]);
        a.lerp(b, side(a) / (side(a) - side(b)))
    };
    let crosses = |i: &usize| (side(section[*i]) >= 0.0) != (side(section[(*i + 1) % n]) >= 0.0);
    let crossings: Vec<usize> = (0..n).filter(crosses).collect();
    let z = |i: usize| cut(i).z;
    let first = crossings.iter().copied().max_by(|&a, &b| z(a).total_cmp(&z(b)))?;
    let last = crossings.iter().copied().min_by(|&a, &b| z(a).total_cmp(&z(b)))?;
    // Go round in the direction that is on the wanted side.
    let onward = side(section[(first + 1) % n]) >= 0.0;
    let mut points = vec![cut(first)];
    let mut i = first;
    while i != last && points.len() <= n {
        if onward {
            points.push(section[(i + 1) % n]);
            i = (i + 1) % n;
        } else {
            points.push(section[i]);
            i = (i + n - 1) % n;
        }
    }
    points.push(cut(last));
    (first != last).then(|| Polyline::new(points))
}

/// A stroke up and down the piece near the body's middle. `height` pairs a height of the cloth with one of the body;
/// without it the middle of the stroke stays where the file placed it.
fn upright(
    panel: &Panel,
    surface: &Surface,
    trunk: Option<&Trunk>,
    height: Option<(f64, f64)>,
    offset: f64,
) -> Option<Stroke> {
    let along = panel.flat(DVec3::Y)?;
    let across = along.perp();
    let sides = panel.outline.iter().map(|p| p.dot(across));
    let (low, high) = (sides.clone().fold(f64::INFINITY, f64::min), sides.fold(f64::NEG_INFINITY, f64::max));
    let origin = panel.pose.rotation.inverse() * -panel.pose.translation;
    let inset = INSET.min((high - low) / 3.0);
    let at = DVec2::new(origin.x, origin.y).dot(across).clamp(low + inset, high - inset);
    let run = panel.run(along, at)?;
    let middle = run.0.midpoint(run.1);
    let aside = DVec3::X * trunk.map_or(0.0, |t| t.middle);
    let (anchor, on_body) = match height {
        Some((cloth, body)) => {
            let anchor = middle + along * (cloth - panel.world(middle).y);
            (anchor, panel.world(anchor) + aside + DVec3::Y * (body - cloth))
        }
        None => (middle, panel.world(middle) + aside),
    };
    stroke(panel, surface, run, anchor, on_body, TURNED_AWAY, offset)
}

/// A stroke along the piece from side to side, at the height where the file placed it.
fn sideways(panel: &Panel, surface: &Surface, offset: f64) -> Option<Stroke> {
    let along = panel.flat(DVec3::X)?;
    let across = along.perp();
    let sides = panel.outline.iter().map(|p| p.dot(across));
    let (low, high) = (sides.clone().fold(f64::INFINITY, f64::min), sides.fold(f64::NEG_INFINITY, f64::max));
    let run = panel.run(along, (low + high) / 2.0)?;
    let middle = run.0.midpoint(run.1);
    // Allow the skin to turn away: the stroke goes round the body.
    stroke(panel, surface, run, middle, panel.world(middle), -0.5, offset)
}

/// A stroke over the run `from`..`to` of a piece. Its point `anchor` goes to the skin in front of `on_body`; the rest
/// follows the skin from there.
fn stroke(
    panel: &Panel,
    surface: &Surface,
    (from, to): (DVec2, DVec2),
    anchor: DVec2,
    on_body: DVec3,
    turned_away: f64,
    offset: f64,
) -> Option<Stroke> {
    let far = 10.0 * surface.scale();
    let hit = surface.ray(on_body + panel.normal * far, -panel.normal)?;
    if hit.normal.dot(panel.normal) < TURNED_AWAY {
        return None;
    }
    let margin = 0.03 * (to - from).length();
    let step = (to - from).normalize_or_zero();
    let along = (panel.world(to) - panel.world(from)).normalize_or_zero();
    let march =
        |way: DVec3, length: f64| march(surface, hit.point, way, panel.normal, length, offset, turned_away);
    let back = march(-along, (anchor - from).dot(step) - margin);
    let ahead = march(along, (to - anchor).dot(step) - margin);
    let mut cloth = Vec::new();
    let mut body = Vec::new();
    for (p, s) in back.iter().rev() {
        cloth.push(anchor - step * *s);
        body.push(*p);
    }
    cloth.push(anchor);
    body.push(hit.point);
    for (p, s) in &ahead {
        cloth.push(anchor + step * *s);
        body.push(*p);
    }
    (cloth.len() > 3).then_some(Stroke { panel: panel.id, cloth, body })
}

/// A path over the skin from `start` in direction `way`, in the plane of `way` and `normal`, up to `length` metres at
/// the offset; shorter where the skin turns away.
fn march(
    surface: &Surface,
    start: DVec3,
    way: DVec3,
    normal: DVec3,
    length: f64,
    offset: f64,
    turned_away: f64,
) -> Way {
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
