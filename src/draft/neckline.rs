//! Necklines: width and depth of a bodice's opening at the neck.

use glam::DVec2;
use serde::Serialize;

use crate::draft::path::Path;
use crate::geometry::random::Random;

/// Shape of the line between shoulder seam and middle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    Round,
    V,
    Square,
    Boat,
}

/// A neckline on the default figure, metres.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Neckline {
    /// Shape in front; the back is round.
    pub shape: Shape,
    /// Distance from the middle to the shoulder seam.
    pub width: f64,
    /// Drop below the neck end of the shoulder seam, in front and at the back.
    pub drops: [f64; 2],
}

impl Neckline {
    /// An open neckline, well off the neck, drawn at random.
    pub fn open(random: &mut Random) -> Self {
        let shape = random.one_of([Shape::Round, Shape::Round, Shape::V, Shape::Square, Shape::Boat]);
        let (width, front) = match shape {
            Shape::Round => (random.between(0.083, 0.108), random.between(0.085, 0.15)),
            Shape::V => (random.between(0.080, 0.100), random.between(0.12, 0.19)),
            Shape::Square => (random.between(0.085, 0.110), random.between(0.09, 0.14)),
            Shape::Boat => (random.between(0.100, 0.125), random.between(0.065, 0.085)),
        };
        Self { shape, width, drops: [front, random.between(0.022, 0.045)] }
    }

    /// A round neckline near the neck, for a collar or a hood, drawn at random.
    pub fn close(random: &mut Random) -> Self {
        let (width, front) = (random.between(0.078, 0.088), random.between(0.075, 0.095));
        Self { shape: Shape::Round, width, drops: [front, random.between(0.020, 0.028)] }
    }

    /// Appends the front's (0) or back's (1) neckline, labelled "neck", from the shoulder seam to the middle at x = 0.
    pub fn drawn(&self, path: Path, side: usize) -> Path {
        let neck = path.end();
        let drop = self.drops[side];
        self.drawn_down_to(path, side, DVec2::new(0.0, neck.y - drop))
    }

    /// Appends the neckline from the end of the path down to `low`.
    pub fn drawn_down_to(&self, path: Path, side: usize, low: DVec2) -> Path {
        let neck = path.end();
        let drop = neck.y - low.y;
        let shape = if side == 1 { Shape::Round } else { self.shape };
        match shape {
            Shape::Round => {
                let first = DVec2::new(0.96 * neck.x, neck.y - 0.60 * drop);
                path.curve("neck", first, DVec2::new(0.60 * neck.x, low.y), low)
            }
            Shape::Boat => {
                let first = DVec2::new(0.80 * neck.x, neck.y - 0.70 * drop);
                path.curve("neck", first, DVec2::new(0.50 * neck.x, low.y), low)
            }
            Shape::V => path.line("neck", low),
            Shape::Square => path.line("neck", DVec2::new(0.90 * neck.x, low.y)).line("neck", low),
        }
    }
}
