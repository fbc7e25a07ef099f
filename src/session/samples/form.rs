//! The dress form that samples are drafted on: lengths and strokes read off a mannequin.

use glam::{DVec2, DVec3};

use crate::body::measure::{length, taut};
use crate::body::{Mannequin, Surface};
use crate::relax::RelaxSettings;

/// Spacing of strokes on the body, metres.
const STEP: f64 = 0.01;

/// Share of the bust's extra length that a front without a dart gets.
const FRONT_BALANCE: f64 = 1.0;

/// Shoulder seams fall a little less steeply than the shoulder: room for its roundness.
const SLOPE_EASE: f64 = 0.85;

/// A mannequin with its surface.
pub struct Form<'a> {
    /// The body.
    pub body: &'a Mannequin,
    surface: Surface,
    offset: f64,
}

impl<'a> Form<'a> {
    /// Over `body`. Panics when the mannequin has no triangles: it is built by us.
    pub fn new(body: &'a Mannequin) -> Self {
        let surface = Surface::new(body.mesh.clone()).expect("a mannequin has a surface");
        let offset = RelaxSettings::default().offset * surface.scale();
        Self { body, surface, offset }
    }

    /// A named point. Panics when there is none: names are written in code.
    pub fn mark(&self, name: &str) -> DVec3 {
        self.body.landmarks.get(name).unwrap_or_else(|| panic!("no landmark {name}"))
    }

    /// The skin at `x`, `y`: in front (`side` 1) or behind (`side` -1).
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

    /// The skin straight out from the middle of the trunk at height `y`, the way of `angle` from the front towards +x.
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
        // The body lies to the left of a tape that runs up its front seen with the front to the right.
        length(&taut(points.into_iter()))
    }

    /// A stroke on the skin through `points` (any spacing), with its length where the cloth lies.
    pub fn lengths(&self, points: &[DVec3]) -> Vec<f64> {
        let lifted: Vec<DVec3> = points.iter().map(|&p| p + self.smooth_normal(p) * self.offset).collect();
        let mut lengths = vec![0.0];
        for w in lifted.windows(2) {
            lengths.push(lengths[lengths.len() - 1] + w[0].distance(w[1]));
        }
        lengths
    }

    /// The vertices' normals mixed at the point of the skin nearest to `p`: the faces' own make strokes along an edge
    /// zigzag.
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

    /// The part of the stroke `path` that runs from `from` to `to` metres (where the cloth lies) after the point of it
    /// nearest to `anchor`; as much of it as there is.
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

    /// A stroke straight up the middle of front (`side` 1) or back (-1) from height `low` to `high`.
    pub fn upright(&self, x: f64, low: f64, high: f64, side: f64) -> Vec<DVec3> {
        let count = ((high - low) / STEP).ceil().max(1.0) as usize;
        (0..=count).filter_map(|i| self.skin(x, low + (high - low) * i as f64 / count as f64, side)).collect()
    }

    /// A stroke on the skin below the straight line from `a` to `b`.
    pub fn straight(&self, a: DVec3, b: DVec3) -> Vec<DVec3> {
        let count = (a.distance(b) / STEP).ceil().max(1.0) as usize;
        (0..=count).map(|i| self.surface.nearest(a.lerp(b, i as f64 / count as f64)).point).collect()
    }

    /// A stroke round the trunk at height `y` from `from` to `to` radians, as `round` counts them.
    pub fn level(&self, y: f64, from: f64, to: f64) -> Vec<DVec3> {
        (0..=60).filter_map(|i| self.round(y, from + (to - from) * f64::from(i) / 60.0)).collect()
    }
}

/// Where neck and shoulder of a bodice lie.
pub struct Yoke {
    /// From the middle to where the shoulder seam meets the neckline.
    pub neck_width: f64,
    /// Length of the shoulder seam.
    pub shoulder: f64,
    /// How steeply it falls, radians.
    pub slope: f64,
    /// Height of the neck end above the bust line by the tape, in front and behind.
    pub heights: [f64; 2],
}

impl Yoke {
    /// With the neckline `neck_width` from the middle on the default figure, and a seam `short` metres shorter than the
    /// shoulder.
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
            // Most of what the bust asks for in length goes in at the front.
            heights: [back + FRONT_BALANCE * (front - back), back],
        }
    }

    /// Neck and tip ends of the shoulder seam, drawn at +x, in front (0) or behind (1).
    pub fn seam(&self, side: usize) -> [DVec2; 2] {
        let neck = DVec2::new(self.neck_width, self.heights[side]);
        [neck, neck + DVec2::new(self.slope.cos(), -self.slope.sin()) * self.shoulder]
    }
}
