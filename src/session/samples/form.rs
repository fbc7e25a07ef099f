//! The dress form that samples are drafted on: lengths and strokes measured on a mannequin.

use glam::{DVec2, DVec3};

use crate::body::measure::{length, taut};
use crate::body::{Mannequin, Surface};
use crate::relax::RelaxSettings;

/// Spacing of points in strokes on the body, metres.
const STEP: f64 = 0.01;

/// Share of the extra length over the bust that a front without a dart gets.
const FRONT_BALANCE: f64 = 1.0;

/// Slope of the shoulder seam as a share of the shoulder's slope: less steep, to leave room for its roundness.
const SLOPE_EASE: f64 = 0.85;

/// A mannequin with its surface.
pub struct Form<'a> {
    /// The body.
    pub body: &'a Mannequin,
    surface: Surface,
    offset: f64,
}

impl<'a> Form<'a> {
    /// The form of `body`. Panics when the mannequin has no triangles, which cannot happen: this program builds it.
    pub fn new(body: &'a Mannequin) -> Self {
        let surface = Surface::new(body.mesh.clone()).expect("a mannequin has a surface");
        let offset = RelaxSettings::default().offset * surface.scale();
        Self { body, surface, offset }
    }

    /// A landmark. Panics when there is none: names are written in code.
    pub fn mark(&self, name: &str) -> DVec3 {
        self.body.landmarks.get(name).unwrap_or_else(|| panic!("no landmark {name}"))
    }

    /// The point of the skin at `x`, `y`, in front (`side` 1) or behind (`side` -1).
    pub fn skin(&self, x: f64, y: f64, side: f64) -> Option<DVec3> {
        // The mannequin has edges along its plane of symmetry, and a ray just along an edge may slip through.
        let hit = self.surface.ray(DVec3::new(x + 3e-4, y, side), DVec3::new(0.0, 0.0, -side))?;
        Some(self.surface.nearest(hit.point.with_x(x)).point)
    }

    /// The top of the shoulder at `x`.
    pub fn shoulder(&self, x: f64) -> DVec3 {
        let z = self.mark("shoulder_left").z;
        self.surface.ray(DVec3::new(x, 1.0e3, z), DVec3::NEG_Y).map_or(DVec3::ZERO, |hit| hit.point)
    }

    /// The point of the skin at height `y` in the direction `angle` (radians from the front towards +x) from the middle of the
    /// trunk.
    pub fn round(&self, y: f64, angle: f64) -> Option<DVec3> {
        let middle = (self.skin(0.0, y, 1.0)? + self.skin(0.0, y, -1.0)?) / 2.0;
        let way = DVec3::new((angle + 1e-3).sin(), 0.0, (angle + 1e-3).cos());
        self.surface.ray(middle, way).map(|hit| hit.point)
    }

    /// Length of a tape from the top of the shoulder at `x` down the front (`side` 1) or back (-1) to height `y`.
    pub fn shoulder_drop(&self, x: f64, y: f64, side: f64) -> f64 {
        let top = self.shoulder(x);
        let lifted = |p: DVec3| DVec2::new(side * p.z, p.y) + DVec2::new(self.offset, self.offset / 2.0);
        let steps = ((top.y - y) / STEP).ceil().max(1.0);
        let down = (0..steps as usize).filter_map(|i| {
            let at = y + (top.y - y) * i as f64 / steps;
            self.skin(x, at, side).map(lifted)
        });
        let points: Vec<DVec2> = down.chain([lifted(top)]).collect();
        // Seen with the front to the right, the body is to the left of a tape that runs up its front.
        length(&taut(points.into_iter()))
    }

    /// Cumulative lengths of a stroke on the skin through `points` (any spacing), measured at the offset where the cloth is,
    /// metres.
    pub fn lengths(&self, points: &[DVec3]) -> Vec<f64> {
        let lifted: Vec<DVec3> = points.iter().map(|&p| p + self.smooth_normal(p) * self.offset).collect();
        let mut lengths = vec![0.0];
        for w in lifted.windows(2) {
            lengths.push(lengths[lengths.len() - 1] + w[0].distance(w[1]));
        }
        lengths
    }

    /// Unit normal near `p`, blended from vertex normals: with face normals strokes along an edge would zigzag.
    fn smooth_normal(&self, p: DVec3) -> DVec3 {
        let near = self.surface.nearest(p);
        let corners = self.surface.mesh.triangles[near.triangle as usize];
        corners
            .iter()
            .map(|&v| {
                let away = self.surface.mesh.positions[v as usize].distance(near.point).max(1e-6);
                self.surface.vertex_normals[v as usize] / away
            })
            .sum::<DVec3>()
            .normalize_or_zero()
    }

    /// The part of the stroke `path` between `from` and `to` metres (measured at the cloth's offset) after its point nearest to
    /// `anchor`; shortened where the stroke ends.
    pub fn part(&self, path: &[DVec3], anchor: DVec3, from: f64, to: f64) -> Vec<DVec3> {
        let lengths = self.lengths(path);
        let nearest = (0..path.len())
            .min_by(|&i, &j| path[i].distance_squared(anchor).total_cmp(&path[j].distance_squared(anchor)))
            .unwrap_or(0);
        let zero = lengths[nearest];
        let at = |s: f64| {
            let i = lengths.partition_point(|&l| l <= s).clamp(1, lengths.len() - 1);
            let t = ((s - lengths[i - 1]) / (lengths[i] - lengths[i - 1]).max(1e-12)).clamp(0.0, 1.0);
            let p = path[i - 1].lerp(path[i], t);
            self.surface.nearest(p).point
        };
        let (low, high) = ((zero + from).max(0.0), (zero + to).min(lengths[lengths.len() - 1]));
        let count = ((high - low) / STEP).ceil().max(1.0) as usize;
        (0..=count).map(|k| at(low + (high - low) * k as f64 / count as f64)).collect()
    }

    /// A vertical stroke at `x` on the front (`side` 1) or back (-1) from height `low` to `high`.
    pub fn upright(&self, x: f64, low: f64, high: f64, side: f64) -> Vec<DVec3> {
        let count = ((high - low) / STEP).ceil().max(1.0) as usize;
        (0..=count).filter_map(|i| self.skin(x, low + (high - low) * i as f64 / count as f64, side)).collect()
    }

    /// A stroke on the skin along the straight line from `a` to `b`.
    pub fn straight(&self, a: DVec3, b: DVec3) -> Vec<DVec3> {
        let count = (a.distance(b) / STEP).ceil().max(1.0) as usize;
        (0..=count).map(|i| self.surface.nearest(a.lerp(b, i as f64 / count as f64)).point).collect()
    }

    /// A horizontal stroke round the trunk at height `y` between the angles `from` and `to`, as in [`Self::round`].
    pub fn level(&self, y: f64, from: f64, to: f64) -> Vec<DVec3> {
        (0..=60).filter_map(|i| self.round(y, from + (to - from) * f64::from(i) / 60.0)).collect()
    }
}

/// Neck and shoulder measures of a bodice, metres.
pub struct Yoke {
    /// Distance from the middle to where the shoulder seam meets the neckline.
    pub neck_width: f64,
    /// Length of the shoulder seam.
    pub shoulder: f64,
    /// Slope of the shoulder seam, radians.
    pub slope: f64,
    /// Height of the neck end above the bust line, measured by tape along the front and the back.
    pub heights: [f64; 2],
}

impl Yoke {
    /// A yoke with the neckline `neck_width` metres from the middle on the default figure, scaled to this one, and a seam `short`
    /// metres shorter than the shoulder.
    pub fn new(form: &Form, neck_width: f64, short: f64) -> Self {
        let m = &form.body.measurements;
        let neck_width = neck_width * m.half_across_shoulder / 0.2009;
        let (neck, tip) = (form.shoulder(neck_width), form.mark("shoulder_left"));
        let bust = form.mark("bust_front").y;
        let [front, back] = [1.0, -1.0].map(|side| form.shoulder_drop(neck_width, bust, side));
        Self {
            neck_width,
            shoulder: neck.distance(tip) - short,
            slope: SLOPE_EASE * ((neck.y - tip.y) / (tip.x - neck.x)).atan(),
            // The extra length over the bust is added at the front.
            heights: [back + FRONT_BALANCE * (front - back), back],
        }
    }

    /// Neck and tip ends of the shoulder seam at +x, in front (0) or behind (1).
    pub fn seam(&self, side: usize) -> [DVec2; 2] {
        let neck = DVec2::new(self.neck_width, self.heights[side]);
        [neck, neck + DVec2::new(self.slope.cos(), -self.slope.sin()) * self.shoulder]
    }
}
