//! Threads between sewn edges, kept until a seam or one of its pieces changes.

use std::collections::BTreeMap;

use glam::DVec2;

use super::shapes::Shapes;
use crate::geometry::ids::{PieceId, SeamId};
use crate::pattern::{Pattern, Seam};

/// Distance between threads, metres, within limits.
const SPACING: f64 = 0.03;

/// Both ends of the threads of one seam, each in its own piece's plane.
#[derive(Clone, Debug)]
pub struct Ends {
    key: (Seam, [u64; 2]),
    pieces: [PieceId; 2],
    points: [Vec<DVec2>; 2],
}

impl Ends {
    /// Both ends on the table, paired.
    pub fn on_table(&self, pattern: &Pattern) -> Option<[Vec<DVec2>; 2]> {
        let side = |k: usize| {
            let pose = pattern.pieces.get(&self.pieces[k])?.pose;
            Some(self.points[k].iter().map(|&p| pose.plane_from_piece(p)).collect())
        };
        Some([side(0)?, side(1)?])
    }
}

/// The threads of all seams.
#[derive(Clone, Debug, Default)]
pub struct Threads {
    seams: BTreeMap<SeamId, Ends>,
}

impl Threads {
    /// Brings the threads up to date; `shapes` must be.
    pub fn update(&mut self, pattern: &Pattern, shapes: &Shapes) {
        self.seams.retain(|id, ends| pattern.seams.get(id).and_then(|s| key(s, shapes)) == Some(ends.key));
        for (&id, seam) in &pattern.seams {
            if !self.seams.contains_key(&id)
                && let Some(ends) = ends(pattern, seam, shapes)
            {
                self.seams.insert(id, ends);
            }
        }
    }

    /// All of them, in id order.
    pub fn all(&self) -> impl Iterator<Item = (SeamId, &Ends)> {
        self.seams.iter().map(|(&id, ends)| (id, ends))
    }

    /// The seam with an edge within `reach` metres of a point of the table.
    pub fn near(&self, pattern: &Pattern, table: DVec2, reach: f64) -> Option<SeamId> {
        let distance = |ends: &Ends| {
            let sides = ends.on_table(pattern)?;
            sides.iter().map(|points| to_polyline(table, points)).reduce(f64::min)
        };
        self.all()
            .filter_map(|(id, ends)| Some((id, distance(ends)?)))
            .filter(|(_, d)| *d <= reach)
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .map(|(id, _)| id)
    }
}

/// Distance from `p` to a polyline or a single point.
pub fn to_polyline(p: DVec2, points: &[DVec2]) -> f64 {
    let to_segment = |a: DVec2, b: DVec2| {
        let ab = b - a;
        let t = ((p - a).dot(ab) / ab.length_squared().max(1e-18)).clamp(0.0, 1.0);
        p.distance(a + ab * t)
    };
    match points {
        [] => f64::INFINITY,
        [only] => p.distance(*only),
        _ => points.windows(2).map(|w| to_segment(w[0], w[1])).fold(f64::INFINITY, f64::min),
    }
}

fn key(seam: &Seam, shapes: &Shapes) -> Option<(Seam, [u64; 2])> {
    let version = |k: usize| shapes.of(seam.sides[k].piece).map(|s| s.version);
    Some((*seam, [version(0)?, version(1)?]))
}

fn ends(pattern: &Pattern, seam: &Seam, shapes: &Shapes) -> Option<Ends> {
    let [a, b] = seam.sides;
    let (first, second) = (pattern.pieces.get(&a.piece)?, pattern.pieces.get(&b.piece)?);
    let count = (a.length(first)? / SPACING).ceil().clamp(2.0, 24.0) as usize;
    let at: Vec<f64> = (0..=count).map(|i| i as f64 / count as f64).collect();
    let from = a.points(first, &at)?;
    let mut to = b.points(second, &at)?;
    if !seam.same_direction {
        to.reverse();
    }
    Some(Ends { key: key(seam, shapes)?, pieces: [a.piece, b.piece], points: [from, to] })
}
