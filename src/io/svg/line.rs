//! A line of a drawing, from its own units to tidy metres.

use glam::DVec2;

use super::clean::Shape;
use crate::pattern::{Edge, EdgeShape};

/// Ends nearer than this meet, metres.
const MEETING: f64 = 1e-4;
/// Edges shorter than this are left out, metres.
const SHORTEST: f64 = 1e-6;

/// One line of a path.
#[derive(Clone, Debug)]
pub struct Line {
    /// In the order of the file: lines of one path have one number.
    pub path: usize,
    pub shape: Shape,
    pub edges: Vec<Edge>,
    pub end: DVec2,
    pub is_closed: bool,
}

impl Line {
    /// From user units with y down, the box's corner at zero, to metres with y up.
    pub fn put_in_metres(&mut self, origin: DVec2, metres: f64) {
        let map = |p: DVec2| DVec2::new(p.x + origin.x, -(p.y + origin.y)) * metres;
        for edge in &mut self.edges {
            edge.start = map(edge.start);
            edge.shape = edge.shape.mapped(true, map);
        }
        self.end = map(self.end);
    }

    /// Takes away edges of no length; closes lines whose ends meet.
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
