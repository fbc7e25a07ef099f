//! Root edges: cloth edges that cross a mark are pasted along the mark's partner on the body (paper A, Figure 11).

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use crate::body::Surface;
use crate::cloth::{FlatPiece, Garment};
use crate::geometry::ids::PieceId;
use crate::geometry::walk::straightest;
use crate::geometry::words::{Words, words};
use crate::pattern::{Problem, ProblemKind};
use crate::wrap::{BodyMark, ClothMark, ClothSide, Marks};

/// Length below which a stroke counts as a point, metres on a body 1.5 m large. A tenth of a millimetre: what is shorter tells no
/// direction.
const POINT_MARK: f64 = 1e-4;

/// A root: a vertex placed by a mark.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Root {
    /// The vertex.
    pub vertex: u32,
    /// Position of the vertex, metres, at the offset above the skin.
    pub position: DVec3,
    /// Distance of the vertex from its mark in the pattern, metres.
    pub distance: f64,
}

/// Lengths of a pair of marks on cloth and body; zero for point marks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairStretch {
    /// Number of the pair, from 1.
    pub number: usize,
    /// Length on the cloth, metres.
    pub cloth: f64,
    /// Length on the offset surface of the body, metres.
    pub body: f64,
}

impl PairStretch {
    /// Relative stretch, body / cloth - 1: strain that no solver can remove. Zero for point marks.
    pub fn stretch(&self) -> f64 {
        if self.cloth > 0.0 { self.body / self.cloth - 1.0 } else { 0.0 }
    }

    /// Whether the two strokes differ so much in length, by over 5 %, that it shows in the garment and one of them should be painted
    /// again.
    pub fn is_large(&self) -> bool {
        self.stretch().abs() > 0.05
    }
}

/// A polyline with its arc lengths.
pub(super) struct Stroke<P> {
    points: Vec<P>,
    lengths: Vec<f64>,
}

impl<P: Copy + std::ops::Sub<Output = P> + std::ops::Add<Output = P> + std::ops::Mul<f64, Output = P>>
    Stroke<P>
{
    pub(super) fn new(points: Vec<P>, norm: impl Fn(P) -> f64) -> Self {
        let mut lengths = vec![0.0];
        for w in points.windows(2) {
            lengths.push(lengths[lengths.len() - 1] + norm(w[1] - w[0]));
        }
        Self { points, lengths }
    }

    pub(super) fn length(&self) -> f64 {
        *self.lengths.last().unwrap_or(&0.0)
    }

    /// The segment at arc length `s`, and the fraction along it.
    fn segment(&self, s: f64) -> (usize, f64) {
        let last = self.points.len().saturating_sub(2);
        let i = self.lengths.partition_point(|&l| l <= s).saturating_sub(1).min(last);
        let span = self.lengths[i + 1] - self.lengths[i];
        (i, if span > 0.0 { ((s - self.lengths[i]) / span).clamp(0.0, 1.0) } else { 0.0 })
    }

    pub(super) fn at(&self, s: f64) -> P {
        if self.points.len() == 1 {
            return self.points[0];
        }
        let (i, f) = self.segment(s);
        self.points[i] + (self.points[i + 1] - self.points[i]) * f
    }
}

/// Both strokes of a pair; the body's is raised to the offset above the skin, where the cloth will be and its length counts.
struct Strokes {
    cloth: Stroke<DVec2>,
    body: Stroke<DVec3>,
    is_point: bool,
}

impl Strokes {
    /// Err: a message that says why a stroke cannot be used.
    fn new(cloth: &ClothMark, body: &BodyMark, surface: &Surface, offset: f64) -> Result<Self, Words> {
        if cloth.points.is_empty() || body.points.is_empty() {
            return Err(words!("it has no points"));
        }
        if cloth.points.iter().any(|p| !p.is_finite()) || body.points.iter().any(|p| !p.is_finite()) {
            return Err(words!("it has coordinates that are not numbers"));
        }
        let lifted = body.points.iter().map(|&p| lifted(surface, p, offset)).collect();
        let (cloth, body) =
            (Stroke::new(cloth.points.clone(), DVec2::length), Stroke::new(lifted, DVec3::length));
        let shortest = POINT_MARK * surface.scale();
        let is_point = cloth.length() < shortest || body.length() < shortest;
        Ok(Self { cloth, body, is_point })
    }

    fn stretch(&self, number: usize) -> PairStretch {
        let [cloth, body] = if self.is_point { [0.0; 2] } else { [self.cloth.length(), self.body.length()] };
        PairStretch { number, cloth, body }
    }
}

/// Lengths of each pair of `marks`, without a mesh; `offset` is the height of the cloth above the skin, metres. Pairs
/// without points are left out.
pub fn stretches(marks: &Marks, surface: &Surface, offset: f64) -> Vec<PairStretch> {
    let pairs = marks.pairs().zip(1..);
    pairs
        .filter_map(|((cloth, body), number)| {
            Some(Strokes::new(cloth, body, surface, offset).ok()?.stretch(number))
        })
        .collect()
}

/// Computes the roots of all marks, sorted by vertex, one per vertex; also the lengths of the pairs, and problems of marks.
pub fn roots(
    garment: &Garment,
    surface: &Surface,
    marks: &Marks,
    offset: f64,
) -> (Vec<Root>, Vec<PairStretch>, Vec<Problem>) {
    let mut problems = Vec::new();
    let mut found: BTreeMap<u32, (DVec3, f64, f64)> = BTreeMap::new();
    let mut stretches = Vec::new();
    for (i, (cloth, body)) in marks.pairs().enumerate() {
        let number = i + 1;
        let pair = Pair::new(garment, surface, cloth, body, offset);
        match pair.and_then(|pair| Ok((pair.roots()?, pair.strokes.stretch(number)))) {
            Ok((roots, stretch)) => {
                stretches.push(stretch);
                for root in roots {
                    let sum = found.entry(root.vertex).or_insert((DVec3::ZERO, 0.0, f64::INFINITY));
                    sum.0 += root.position;
                    sum.1 += 1.0;
                    sum.2 = sum.2.min(root.distance);
                }
            }
            Err(words) => problems.push(Problem {
                kind: ProblemKind::Mark,
                place: words!("mark {n}", n = number),
                words,
            }),
        }
    }
    for number in marks.cloth.len().min(marks.body.len()) + 1..=marks.cloth.len().max(marks.body.len()) {
        let words = match marks.cloth.len() > marks.body.len() {
            true => words!("it is on the cloth but not on the body; paint its partner or delete it"),
            false => words!("it is on the body but not on the cloth; paint its partner or delete it"),
        };
        problems.push(Problem { kind: ProblemKind::Mark, place: words!("mark {n}", n = number), words });
    }
    let roots = found
        .into_iter()
        .map(|(vertex, (sum, count, distance))| {
            // Averaged in space, then back to the surface (paper A, footnote 4).
            let mean = sum / count;
            let position = if count > 1.0 { lifted(surface, mean, offset) } else { mean };
            Root { vertex, position, distance }
        })
        .collect();
    (roots, stretches, problems)
}

/// The point at `offset` metres above the skin point nearest to `p`.
pub(super) fn lifted(surface: &Surface, p: DVec3, offset: f64) -> DVec3 {
    let n = surface.nearest(p);
    n.point + n.normal * offset
}

/// A pair of marks, with what is needed to compute its roots.
struct Pair<'a> {
    garment: &'a Garment,
    surface: &'a Surface,
    cloth: &'a ClothMark,
    strokes: Strokes,
    /// Height of the cloth above the skin, metres.
    offset: f64,
}

impl<'a> Pair<'a> {
    fn new(
        garment: &'a Garment,
        surface: &'a Surface,
        cloth: &'a ClothMark,
        body: &BodyMark,
        offset: f64,
    ) -> Result<Self, Words> {
        let strokes = Strokes::new(cloth, body, surface, offset)?;
        if !garment.pieces.iter().any(|&(id, _)| id == cloth.piece) {
            return Err(words!("its {piece} is not in the garment", piece = cloth.piece));
        }
        Ok(Self { garment, surface, cloth, strokes, offset })
    }

    fn roots(&self) -> Result<Vec<Root>, Words> {
        let crossing = if self.strokes.is_point { Vec::new() } else { self.crossing_roots() };
        if !crossing.is_empty() {
            return Ok(crossing);
        }
        self.point_roots().ok_or_else(|| words!("it lies off its piece; paint it on the cloth"))
    }

    /// The frame at fraction `t` of the arc length of both strokes.
    fn frame(&self, t: f64) -> Frame {
        let Strokes { cloth, body, .. } = &self.strokes;
        let at = body.at(t * body.length());
        let near = self.surface.nearest(at);
        // Take the tangent over a short stretch of the stroke on the body: single segments of a painted stroke are noisy.
        let (length, window) = (body.length(), 0.01 * self.surface.scale());
        let s = t * length;
        let ahead = body.at((s + window).min(length)) - body.at((s - window).max(0.0));
        let flat_length = cloth.length();
        let flat_window = window.min(flat_length);
        let f = t * flat_length;
        let flat = cloth.at((f + flat_window).min(flat_length)) - cloth.at((f - flat_window).max(0.0));
        let normal = near.normal;
        let tangent = ahead - normal * ahead.dot(normal);
        let tangent = tangent
            .try_normalize()
            .or_else(|| (DVec3::Y - normal * normal.y).try_normalize())
            .unwrap_or_else(|| normal.any_orthonormal_vector());
        let drawn_from_front = if front_is_far(self.garment, self.cloth.piece) { -1.0 } else { 1.0 };
        let side = if self.cloth.side == ClothSide::Front { 1.0 } else { -1.0 };
        Frame {
            point: near.point,
            triangle: near.triangle,
            tangent,
            normal,
            flat_tangent: flat.try_normalize().unwrap_or(DVec2::Y),
            handed: drawn_from_front * side,
        }
    }

    fn crossing_roots(&self) -> Vec<Root> {
        let Self { garment, surface, cloth, offset, .. } = *self;
        let stroke = &self.strokes.cloth;
        let mut roots = Vec::new();
        let total = stroke.length();
        let mut seen = std::collections::BTreeSet::new();
        for (t, corners) in garment.triangle_corners.iter().enumerate() {
            if garment.triangle_pieces[t] != cloth.piece {
                continue;
            }
            for k in 0..3 {
                let (ca, cb) = (corners[k], corners[(k + 1) % 3]);
                if !seen.insert((ca.min(cb), ca.max(cb))) {
                    continue;
                }
                let (a, b) = (garment.corners[ca as usize], garment.corners[cb as usize]);
                for (s, p) in crossings(stroke, a.uv, b.uv) {
                    let frame = self.frame(s / total);
                    for end in [a, b] {
                        let step = end.uv - p;
                        roots.push(Root {
                            vertex: end.vertex,
                            position: frame.carried(surface, step, offset),
                            distance: distance_to_stroke(stroke, end.uv),
                        });
                    }
                }
            }
        }
        roots
    }

    /// Roots of a point mark, or of a stroke inside one triangle: the corners of that triangle.
    fn point_roots(&self) -> Option<Vec<Root>> {
        let Self { garment, surface, cloth, offset, .. } = *self;
        let stroke = &self.strokes.cloth;
        let middle = stroke.at(stroke.length() / 2.0);
        let holding = FlatPiece::new(garment, cloth.piece).inside(garment, middle)?.triangle as usize;
        let mut frame = self.frame(0.5);
        if stroke.length() < POINT_MARK * surface.scale() {
            // A point has no direction: the pattern's up becomes the body's up.
            frame.flat_tangent = DVec2::Y;
            frame.tangent = (DVec3::Y - frame.normal * frame.normal.y)
                .try_normalize()
                .unwrap_or_else(|| frame.normal.any_orthonormal_vector());
        }
        let corners = garment.triangle_corners[holding].map(|c| garment.corners[c as usize]);
        let root = |corner: crate::cloth::Corner| Root {
            vertex: corner.vertex,
            position: frame.carried(surface, corner.uv - middle, offset),
            distance: (corner.uv - middle).length(),
        };
        Some(corners.map(root).to_vec())
    }
}

fn front_is_far(garment: &Garment, piece: PieceId) -> bool {
    garment.triangle_pieces.iter().position(|&p| p == piece).is_some_and(|t| {
        let [a, b, c] = garment.triangle_corners[t].map(|c| garment.corners[c as usize].uv);
        (b - a).perp_dot(c - a) < 0.0
    })
}

/// A frame that maps directions of the pattern plane to the tangent plane at a point of the body.
struct Frame {
    point: DVec3,
    triangle: u32,
    /// Image of the cloth mark's tangent, a unit vector.
    tangent: DVec3,
    /// Outward normal of the skin, a unit vector.
    normal: DVec3,
    /// Tangent of the cloth mark in the pattern plane, a unit vector.
    flat_tangent: DVec2,
    /// +1 when a counter-clockwise turn in the drawing is counter-clockwise on the side of the cloth that faces
    /// outward; else -1.
    handed: f64,
}

impl Frame {
    /// Position at `offset` metres above the skin of a corner that is at `step` (m) from the mark's point in the pattern.
    fn carried(&self, surface: &Surface, step: DVec2, offset: f64) -> DVec3 {
        let along = self.flat_tangent.dot(step);
        let across = self.flat_tangent.perp_dot(step) * self.handed;
        let direction = self.tangent * along + self.normal.cross(self.tangent) * across;
        let end = straightest(
            &surface.mesh,
            &surface.adjacency,
            self.point,
            self.triangle,
            direction,
            step.length(),
        );
        lifted(surface, end.point, offset)
    }
}

/// Crossings of a stroke with segment `ab`: arc length on the stroke, and the point.
fn crossings(stroke: &Stroke<DVec2>, a: DVec2, b: DVec2) -> Vec<(f64, DVec2)> {
    let (lower, upper) = (a.min(b), a.max(b));
    let mut found = Vec::new();
    for (i, w) in stroke.points.windows(2).enumerate() {
        let (p, q) = (w[0], w[1]);
        if p.max(q).cmplt(lower).any() || p.min(q).cmpgt(upper).any() {
            continue;
        }
        let (d, e) = (q - p, b - a);
        let det = d.perp_dot(e);
        if det.abs() < 1e-18 {
            continue;
        }
        let s = (a - p).perp_dot(e) / det;
        let u = (a - p).perp_dot(d) / det;
        if (0.0..=1.0).contains(&s) && (0.0..=1.0).contains(&u) {
            found.push((stroke.lengths[i] + s * d.length(), p + d * s));
        }
    }
    found
}

fn distance_to_stroke(stroke: &Stroke<DVec2>, p: DVec2) -> f64 {
    let to_segment = |w: &[DVec2]| {
        let d = w[1] - w[0];
        let t = ((p - w[0]).dot(d) / d.length_squared().max(1e-300)).clamp(0.0, 1.0);
        (p - w[0] - d * t).length()
    };
    stroke.points.windows(2).map(to_segment).fold((p - stroke.points[0]).length(), f64::min)
}
