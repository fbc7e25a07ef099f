//! The contents of one block of a DXF drawing: lines, points and texts.

use glam::{DMat2, DVec2};

use crate::geometry::words::{decimal, words};
use crate::io::pattern_file::PatternFileError;
use crate::pattern::{Edge, EdgeShape};

/// A similarity transform of the plane: rotation, reflection, uniform scale and translation.
#[derive(Clone, Copy, Debug)]
pub struct Placing {
    pub matrix: DMat2,
    pub offset: DVec2,
}

impl Placing {
    fn apply(&self, p: DVec2) -> DVec2 {
        self.matrix * p + self.offset
    }
}

/// A line of the drawing, open or closed.
#[derive(Clone, Debug)]
pub struct DrawnLine {
    /// Layer number; None where the name of the layer holds no number.
    pub layer: Option<u32>,
    pub shape: LineShape,
    pub is_closed: bool,
}

/// The geometry of a line: a polyline, or, where it has arcs, its edges and the end of the last one.
#[derive(Clone, Debug)]
pub enum LineShape {
    Points(Vec<DVec2>),
    Edges(Vec<Edge>, DVec2),
}

impl LineShape {
    /// The points of the polyline, or the start of each edge.
    pub fn points(&self) -> Vec<DVec2> {
        match self {
            Self::Points(points) => points.clone(),
            Self::Edges(edges, _) => edges.iter().map(|e| e.start).collect(),
        }
    }
}

/// The contents of one block, which become one piece. Texts and points are given with their layer and position.
#[derive(Clone, Debug, Default)]
pub struct Drawn {
    pub name: String,
    pub texts: Vec<(Option<u32>, String, DVec2)>,
    pub lines: Vec<DrawnLine>,
    pub points: Vec<(Option<u32>, DVec2)>,
}

impl Drawn {
    pub fn transform(&mut self, placing: &Placing) {
        let turns = placing.matrix.determinant() < 0.0;
        let scale = placing.matrix.determinant().abs().sqrt();
        let shape = |shape: EdgeShape| match shape.mapped(turns, |p| placing.apply(p)) {
            EdgeShape::Arc { radius, large, sweep } => {
                EdgeShape::Arc { radius: radius * scale, large, sweep }
            }
            other => other,
        };
        for line in &mut self.lines {
            match &mut line.shape {
                LineShape::Points(points) => points.iter_mut().for_each(|p| *p = placing.apply(*p)),
                LineShape::Edges(edges, end) => {
                    for edge in edges {
                        edge.start = placing.apply(edge.start);
                        edge.shape = shape(edge.shape);
                    }
                    *end = placing.apply(*end);
                }
            }
        }
        self.points.iter_mut().for_each(|(_, p)| *p = placing.apply(*p));
        self.texts.iter_mut().for_each(|(_, _, p)| *p = placing.apply(*p));
    }

    pub fn check(&self, largest: f64) -> Result<(), PatternFileError> {
        let points = self.lines.iter().flat_map(|l| l.shape.points());
        match points
            .chain(self.points.iter().map(|(_, p)| *p))
            .find(|p| !p.is_finite() || p.abs().max_element() > largest)
        {
            None => Ok(()),
            Some(p) => {
                let (x, y) = (decimal(p.x, 3), decimal(p.y, 3));
                let words = words!("a point at {x} m, {y} m is beyond {most} m", x, y, most = largest);
                Err(PatternFileError::bad(words!("block {name}", name = self.name), words))
            }
        }
    }
}
