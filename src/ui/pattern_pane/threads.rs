//! Threads between sewn edges, cached until a seam or one of its pieces changes.

use std::collections::BTreeMap;

use glam::DVec2;

use super::shapes::Shapes;
use crate::geometry::ids::{PieceId, SeamId};
use crate::pattern::edit::twists;
use crate::pattern::{Pattern, Seam};

/// Distance between threads, metres; the number of threads of a seam is limited.
const SPACING: f64 = 0.03;

/// The threads of a seam: their ends on both sides, each in its own piece's plane.
#[derive(Clone, Debug)]
pub struct Ends {
    key: (Seam, [u64; 2]),
    pieces: [PieceId; 2],
    points: [Vec<DVec2>; 2],
    /// Lengths of both sides, metres.
    pub lengths: [f64; 2],
    /// Whether the seam is twisted: it joins the front of one piece to the back of another.
    pub is_twisted: bool,
}

impl Ends {
    /// Ends of the threads on the table, in pairs.
    pub fn on_table(&self, pattern: &Pattern) -> Option<[Vec<DVec2>; 2]> {
        let side = |k: usize| {
            let pose = pattern.pieces.get(&self.pieces[k])?.pose;
            Some(self.points[k].iter().map(|&p| pose.plane_from_piece(p)).collect())
        };
        Some([side(0)?, side(1)?])
    }

    /// Whether the seam is drawn: none of its pieces is hidden.
    pub fn is_seen(&self, pattern: &Pattern) -> bool {
        self.pieces.iter().all(|id| pattern.pieces.get(id).is_some_and(|piece| !piece.hidden))
    }
}

/// Cache of the threads of all seams.
#[derive(Clone, Debug, Default)]
pub struct Threads {
    seams: BTreeMap<SeamId, Ends>,
}

impl Threads {
    /// Updates the threads; `shapes` must be up to date.
    pub fn update(&mut self, pattern: &Pattern, shapes: &Shapes) {
        let before = self.seams.len();
        self.seams.retain(|id, ends| pattern.seams.get(id).and_then(|s| key(s, shapes)) == Some(ends.key));
        let kept = self.seams.len();
        for (&id, seam) in &pattern.seams {
            if !self.seams.contains_key(&id)
                && let Some(ends) = ends(pattern, seam, shapes)
            {
                self.seams.insert(id, ends);
            }
        }
        if self.seams.len() != kept || kept != before {
            let found = twists(pattern);
            for (id, ends) in &mut self.seams {
                ends.is_twisted = found.seams.contains(id);
            }
        }
    }

    /// The threads of all seams, in id order.
    pub fn all(&self) -> impl Iterator<Item = (SeamId, &Ends)> {
        self.seams.iter().map(|(&id, ends)| (id, ends))
    }

    /// The threads of one seam.
    pub fn of(&self, id: SeamId) -> Option<&Ends> {
        self.seams.get(&id)
    }

    /// Twisted seams, in id order.
    pub fn twisted(&self) -> impl Iterator<Item = SeamId> {
        self.all().filter(|(_, ends)| ends.is_twisted).map(|(id, _)| id)
    }

    /// The seam with a thread within `reach` metres of a point of the table.
    pub fn thread_near(&self, pattern: &Pattern, table: DVec2, reach: f64) -> Option<SeamId> {
        self.nearest(pattern, reach, |[from, to]| {
            from.iter().zip(to).map(|(&p, &q)| to_polyline(table, &[p, q])).reduce(f64::min)
        })
    }

    /// The seam with a sewn edge within `reach` metres of a point of the table.
    pub fn side_near(&self, pattern: &Pattern, table: DVec2, reach: f64) -> Option<SeamId> {
        self.nearest(pattern, reach, |sides| {
            sides.iter().map(|side| to_polyline(table, side)).reduce(f64::min)
        })
    }

    /// The seam that is seen at the least `distance` of its ends on the table, if that is within `reach` metres.
    fn nearest(
        &self,
        pattern: &Pattern,
        reach: f64,
        distance: impl Fn(&[Vec<DVec2>; 2]) -> Option<f64>,
    ) -> Option<SeamId> {
        let distance = |ends: &Ends| distance(&ends.on_table(pattern)?);
        let seen = self.all().filter(|(_, ends)| ends.is_seen(pattern));
        let near = seen.filter_map(|(id, ends)| Some((id, distance(ends)?))).filter(|(_, d)| *d <= reach);
        near.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(id, _)| id)
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
    let lengths = [a.length(first)?, b.length(second)?];
    Some(Ends {
        key: key(seam, shapes)?,
        pieces: [a.piece, b.piece],
        points: threads(pattern, seam)?,
        lengths,
        is_twisted: false,
    })
}

/// Ends of the threads of a seam in pairs, each side in its own piece's plane.
pub fn threads(pattern: &Pattern, seam: &Seam) -> Option<[Vec<DVec2>; 2]> {
    let [a, b] = seam.sides;
    let (first, second) = (pattern.pieces.get(&a.piece)?, pattern.pieces.get(&b.piece)?);
    let count = (a.length(first)? / SPACING).ceil().clamp(2.0, 24.0) as usize;
    let at: Vec<f64> = (0..=count).map(|i| i as f64 / count as f64).collect();
    let from = a.points(first, &at)?;
    let mut to = b.points(second, &at)?;
    if !seam.same_direction {
        to.reverse();
    }
    Some([from, to])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::{EdgeRef, Piece};

    #[test]
    fn a_seam_is_found_at_its_sewn_edges_and_at_its_threads() {
        let mut pattern = Pattern::default();
        let square = [[0.0, 0.0], [0.2, 0.0], [0.2, 0.2], [0.0, 0.2]].map(DVec2::from);
        let [one, other] = ["Front", "Back"].map(|name| pattern.add_piece(Piece::polygon(name, &square)));
        let moved = pattern.pieces.get_mut(&other).expect("a piece");
        std::sync::Arc::make_mut(moved).pose.offset = DVec2::new(0.5, 0.0);
        let sides = [(one, 1), (other, 3)].map(|(piece, edge)| EdgeRef { piece, edge });
        let seam = pattern.add_seam(Seam::of_edges(sides, false));
        let (mut shapes, mut threads) = (Shapes::default(), Threads::default());
        shapes.update(&pattern);
        threads.update(&pattern, &shapes);
        let side = |x, y| threads.side_near(&pattern, DVec2::new(x, y), 0.01);
        assert_eq!([side(0.195, 0.1), side(0.505, 0.1)], [Some(seam); 2]);
        assert_eq!(
            [side(0.1, 0.1), side(0.35, 0.1), side(0.1, 0.0)],
            [None; 3],
            "cloth, table, another edge"
        );
        assert_eq!(threads.thread_near(&pattern, DVec2::new(0.35, 0.1), 0.03), Some(seam));
    }
}
