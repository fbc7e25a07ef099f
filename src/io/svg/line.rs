//! A subpath of an SVG drawing, and its conversion from user units to metres.

use glam::DVec2;

use super::clean::Shape;
use crate::pattern::{Edge, EdgeShape};

/// Largest distance between the two ends of a line that counts as closed, metres.
const MEETING: f64 = 1e-4;
/// Shortest edge that is kept, metres.
const SHORTEST: f64 = 1e-6;

/// One subpath of an SVG path.
#[derive(Clone, Debug)]
pub struct Line {
    /// Index of the path in the order of the file; subpaths of one path share it.
    pub path: usize,
    pub shape: Shape,
    pub edges: Vec<Edge>,
    pub end: DVec2,
    pub is_closed: bool,
}

impl Line {
    /// Converts coordinates from user units with y down to metres with y up. `origin` is added first: it is the corner of the
    /// view box, which usvg moves to zero.
    pub fn put_in_metres(&mut self, origin: DVec2, metres: f64) {
        let map = |p: DVec2| DVec2::new(p.x + origin.x, -(p.y + origin.y)) * metres;
        for edge in &mut self.edges {
            edge.start = map(edge.start);
            edge.shape = edge.shape.mapped(true, map);
        }
        self.end = map(self.end);
    }

    /// Removes edges of no length, and closes the line if its two ends meet.
    pub fn tidy(&mut self) {
        let ends: Vec<DVec2> = self.edges.iter().skip(1).map(|e| e.start).chain([self.end]).collect();
        let mut ends = ends.into_iter();
        self.edges.retain(|e| {
            let long = |c: DVec2| c.distance(e.start) > SHORTEST;
            ends.next().is_some_and(long)
                || match e.shape {
                    EdgeShape::Quadratic { control } => long(control),
                    EdgeShape::Cubic { controls } => controls.into_iter().any(long),
                    EdgeShape::Line | EdgeShape::Arc { .. } => false,
                }
        });
        if let Some(first) = self.edges.first()
            && self.edges.len() > 1
            && first.start.distance(self.end) < MEETING
        {
            self.end = first.start;
            self.is_closed = true;
        }
    }
}
