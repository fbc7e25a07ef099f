//! Wrinkles along internal lines: the shape of the cloth there at rest, how hard it bends, and the points of a finer mesh.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use crate::geometry::polygon::distance_to_segment;
use crate::pattern::trims::Wrinkle;
use crate::pattern::{Fold, InternalLine, Piece};

/// Edges of the mesh across a wrinkle: three to each side of its crest follow the curve of the profile, which turns twice there.
pub const EDGES_ACROSS: f64 = 6.0;
/// Chords by which lines are flattened, metres.
const CHORDS: f64 = 1e-4;
/// Half the number of intervals of Simpson's rule over half a profile; what is left is below 1e-9 of the width.
const HALF_INTERVALS: usize = 16;
/// Least distance of two points of the finer mesh, in distances of its rows.
const LEAST_APART: f64 = 0.62;
/// Deviation from its row by which a point counts as one of another part of the line, in distances of the rows.
const OFF_ROW: f64 = 0.25;

impl Wrinkle {
    /// Distance of rows of points along the line, metres.
    pub fn row(&self) -> f64 {
        self.width / EDGES_ACROSS
    }

    /// Distance of points in a row, metres: with [`Self::row`] they form an equilateral lattice.
    pub fn spacing(&self) -> f64 {
        self.row() / 0.75f64.sqrt()
    }

    /// Bending stiffness of the cloth in the wrinkle besides its own, N·m: that of half its width, which bends one way, is then
    /// as stiff against one radian as a pressed fold, as the turns of all its edges add up. Cotton alone (1e-5 N·m) bends under its
    /// own weight within 2 cm, and a wrinkle 4 cm wide would lie down; with this (4e-4 N·m) one 8 mm high keeps 5 to 6 mm in the
    /// middle of a panel that hangs.
    pub fn stiffness(&self) -> f64 {
        Fold::PRESSED * self.width / 2.0
    }

    /// Where the cloth is that lies flat at `distance` (m, from 0) beside the line: how far across, and how high, metres. It is
    /// bent by the curvature of the profile and not stretched: its slope is the sine of h'(d). Beyond half the width it is flat.
    pub fn risen(&self, distance: f64) -> [f64; 2] {
        let half = self.width / 2.0;
        let turn = |d: f64| -PI * self.height / self.width * (TAU * d / self.width).sin();
        let at = distance.min(half);
        let across = simpson(0.0, at, |d| turn(d).cos());
        let height = -simpson(at, half, |d| turn(d).sin());
        [across + distance - at, height]
    }
}

/// The integral of `f` from `a` to `b` by Simpson's rule.
fn simpson(a: f64, b: f64, f: impl Fn(f64) -> f64) -> f64 {
    let step = (b - a) / (2 * HALF_INTERVALS) as f64;
    let is_end = |i: usize| i == 0 || i == 2 * HALF_INTERVALS;
    let weight = |i: usize| if is_end(i) { 1.0 } else { 2.0 + 2.0 * (i % 2) as f64 };
    (0..=2 * HALF_INTERVALS).map(|i| weight(i) * f(a + i as f64 * step)).sum::<f64>() * step / 3.0
}

/// A wrinkle and the part of a line that it follows.
#[derive(Clone, Debug, PartialEq)]
pub struct Ridge {
    /// The part of the line as a polyline, metres in the piece's own plane; at least two points.
    points: Vec<DVec2>,
    /// The wrinkle.
    pub wrinkle: Wrinkle,
}

/// The wrinkles of `piece`; edges of a line that follow each other with the same wrinkle have one.
pub fn ridges(piece: &Piece) -> Vec<Ridge> {
    piece.lines.iter().flat_map(of_line).collect()
}

fn of_line(line: &InternalLine) -> Vec<Ridge> {
    let mut found: Vec<Ridge> = Vec::new();
    let mut before = None;
    for (i, edge) in line.edges.iter().enumerate() {
        let (wrinkle, end) = (edge.trims.wrinkle, line.edge_end(i));
        if let Some(wrinkle) = wrinkle {
            match found.last_mut().filter(|_| before == Some(wrinkle)) {
                Some(ridge) => {
                    ridge.points.pop();
                }
                None => found.push(Ridge { points: Vec::new(), wrinkle }),
            }
            if let Some(ridge) = found.last_mut() {
                crate::pattern::curve::flatten(edge.start, edge.shape, end, CHORDS, &mut ridge.points);
                ridge.points.push(end);
            }
        }
        before = wrinkle;
    }
    found
}

impl Ridge {
    /// Distance of `p` from the line, metres.
    pub fn distance(&self, p: DVec2) -> f64 {
        self.points.windows(2).map(|w| distance_to_segment(p, w[0], w[1])).fold(f64::INFINITY, f64::min)
    }

    /// Whether `p` is in the wrinkle. Beyond the ends of the line the wrinkle ends in half a dome.
    pub fn holds(&self, p: DVec2) -> bool {
        self.distance(p) < self.wrinkle.width / 2.0
    }

    /// Whether edges `edge_length` metres long are too long for the wrinkle.
    pub fn is_fine(&self, edge_length: f64) -> bool {
        self.wrinkle.spacing() < edge_length
    }

    /// By how much the wrinkle moves the cloth at `p`: in its plane and, z, towards its front, metres.
    fn way(&self, p: DVec2) -> DVec3 {
        let nearest = |w: &[DVec2]| {
            let along = w[1] - w[0];
            let share = ((p - w[0]).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            // A segment without length has no share.
            p - if share.is_nan() { w[0] } else { w[0] + along * share }
        };
        let from = self.points.windows(2).map(nearest);
        let Some(from) = from.min_by(|a, b| a.length_squared().total_cmp(&b.length_squared())) else {
            return DVec3::ZERO;
        };
        let distance = from.length();
        let [across, height] = self.wrinkle.risen(distance);
        (from.normalize_or_zero() * (across - distance)).extend(height)
    }

    /// The line, longer by half the width of the wrinkle at both ends, unless it is closed.
    fn extended(&self) -> Vec<DVec2> {
        let mut points = self.points.clone();
        points.dedup();
        let last = points.len() - 1;
        if last > 0 && points[0] != points[last] {
            let by = self.wrinkle.width / 2.0;
            let ways = [points[0] - points[1], points[last] - points[last - 1]];
            points[0] += ways[0].normalize_or_zero() * by;
            points[last] += ways[1].normalize_or_zero() * by;
        }
        points
    }

    /// Number of points of the finer mesh, about.
    pub fn count(&self) -> f64 {
        let long: f64 = self.points.windows(2).map(|w| w[0].distance(w[1])).sum();
        (EDGES_ACROSS + 1.0) * (long + self.wrinkle.width) / self.wrinkle.spacing()
    }

    /// Points in rows along the line.
    fn rows(&self) -> Vec<DVec2> {
        let (row, spacing, half) = (self.wrinkle.row(), self.wrinkle.spacing(), self.wrinkle.width / 2.0);
        let line = self.extended();
        let each = (EDGES_ACROSS / 2.0) as i32;
        let mut found = Vec::new();
        for k in -each..=each {
            let shift = if k % 2 == 0 { 0.0 } else { 0.5 * spacing };
            for (at, along) in walked(&line, shift, spacing) {
                let p = at + along.perp() * (f64::from(k) * row);
                let distance = self.distance(p);
                // Where the line bends, points on its inner side may be nearer to another part of it.
                if distance > (f64::from(k.abs()) - OFF_ROW) * row && distance < half + OFF_ROW * row {
                    found.push(p);
                }
            }
        }
        found
    }
}

/// Points on a polyline at `from`, `from + step` and so on, metres, each with the unit vector along the line.
fn walked(line: &[DVec2], from: f64, step: f64) -> Vec<(DVec2, DVec2)> {
    let (mut found, mut next) = (Vec::new(), from);
    for w in line.windows(2) {
        let long = w[0].distance(w[1]);
        let along = (w[1] - w[0]).normalize_or_zero();
        while next <= long {
            found.push((w[0] + along * next, along));
            next += step;
        }
        next -= long;
    }
    found
}

/// Where the wrinkles `ridges` move a point of the flat cloth: in the piece's own plane, and z towards its front, metres.
pub fn risen(ridges: &[Ridge], p: DVec2) -> DVec3 {
    p.extend(0.0) + ridges.iter().map(|ridge| ridge.way(p)).sum::<DVec3>()
}

/// Points of a finer mesh in `ridges`; where wrinkles meet, those of the narrower one. `is_free` tells whether a point of rows at
/// this distance (m) has room.
pub fn points(ridges: &[Ridge], is_free: impl Fn(DVec2, f64) -> bool) -> Vec<DVec2> {
    let mut fine: Vec<&Ridge> = ridges.iter().collect();
    fine.sort_by(|a, b| a.wrinkle.width.total_cmp(&b.wrinkle.width));
    let Some(widest) = fine.last().map(|ridge| ridge.wrinkle.row()) else { return Vec::new() };
    let cell = |p: DVec2| (p / widest).floor().as_i64vec2();
    let mut cells: BTreeMap<[i64; 2], Vec<DVec2>> = BTreeMap::new();
    let mut found = Vec::new();
    for ridge in fine {
        let row = ridge.wrinkle.row();
        for p in ridge.rows().into_iter().filter(|&p| is_free(p, row)) {
            let at = cell(p);
            let around = (-1..=1).flat_map(|i| (-1..=1).map(move |j| [at.x + i, at.y + j]));
            let mut near = around.filter_map(|key| cells.get(&key)).flatten();
            if near.all(|other| other.distance(p) >= LEAST_APART * row) {
                cells.entry(at.into()).or_default().push(p);
                found.push(p);
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::{Edge, Trims};

    fn line(points: &[(f64, f64)], wrinkles: &[Option<Wrinkle>]) -> InternalLine {
        let edge = |(p, wrinkle): (&(f64, f64), &Option<Wrinkle>)| Edge {
            start: DVec2::from(*p),
            trims: Trims { wrinkle: *wrinkle, ..Trims::default() },
            ..Edge::default()
        };
        let edges = points.iter().zip(wrinkles).map(edge).collect();
        InternalLine { edges, end: points[points.len() - 1].into(), ..InternalLine::default() }
    }

    #[test]
    fn a_low_wrinkle_has_its_profile_and_a_steep_one_is_bent_not_stretched() {
        let low = Wrinkle { width: 0.04, height: 0.0004 };
        for d in [0.0, 0.003, 0.01, 0.017, 0.02, 0.05] {
            let exact = if d < 0.02 { 0.0004 * (PI * d / 0.04).cos().powi(2) } else { 0.0 };
            let [across, height] = low.risen(d);
            // Of third order in the slope, which is 0.03.
            assert!(
                (height - exact).abs() < 4e-4 * 0.0004 && (across - d).abs() <= 3e-4 * d,
                "{d}: {height}"
            );
            let sunk = Wrinkle { height: -low.height, ..low }.risen(d);
            assert_eq!(sunk, [across, -height], "a valley is the mirror image");
        }
        let steep = Wrinkle { width: 0.04, height: 0.02 };
        let at = |d: f64| DVec2::from(steep.risen(d));
        // The Struve function H₀(π/2).
        assert!((at(0.0).y / 0.02 - 0.7516).abs() < 1e-3, "{}", at(0.0));
        let long: f64 =
            (0..2000).map(|i| at(f64::from(i) * 1e-5).distance(at(f64::from(i + 1) * 1e-5))).sum();
        assert!((long - 0.02).abs() < 1e-6, "{long} m of cloth");
    }

    #[test]
    fn edges_with_one_wrinkle_have_one_ridge() {
        let (one, other) = (Wrinkle::USUAL, Wrinkle { width: 0.02, height: 0.004 });
        let places = [(0.0, 0.0), (0.1, 0.0), (0.2, 0.0), (0.3, 0.0), (0.4, 0.0), (0.5, 0.0)];
        let wrinkles = [Some(one), Some(one), Some(other), None, Some(other)];
        let piece = Piece { lines: vec![line(&places, &wrinkles)], ..Piece::default() };
        let found: Vec<(f64, f64, f64)> = ridges(&piece)
            .iter()
            .map(|ridge| (ridge.points[0].x, ridge.points[ridge.points.len() - 1].x, ridge.wrinkle.width))
            .collect();
        assert_eq!(found, [(0.0, 0.2, 0.04), (0.2, 0.3, 0.02), (0.4, 0.5, 0.02)]);
    }

    #[test]
    fn a_wrinkle_fades_beyond_the_ends_of_its_line() {
        let piece = Piece {
            lines: vec![line(&[(0.0, 0.0), (0.1, 0.0)], &[Some(Wrinkle::USUAL)])],
            ..Piece::default()
        };
        let ridges = ridges(&piece);
        let height = |x: f64, y: f64| risen(&ridges, DVec2::new(x, y)).z;
        let crest = height(0.05, 0.0);
        assert!(crest > 0.9 * 0.008 && crest <= 0.008, "{crest}");
        assert!((height(0.0, 0.0) - crest).abs() < 1e-12);
        assert!(height(-0.01, 0.0) < 0.6 * crest && height(-0.01, 0.0) > 0.4 * crest);
        assert_eq!([height(-0.0201, 0.0), height(0.121, 0.001), height(0.05, -0.02)], [0.0; 3]);
        assert!(!ridges[0].holds(DVec2::new(0.121, 0.0)) && ridges[0].holds(DVec2::new(0.05, 0.019)));
    }

    #[test]
    fn points_of_the_finer_mesh_keep_apart_where_wrinkles_cross() {
        let narrow = Wrinkle { width: 0.02, height: 0.004 };
        let lines = vec![
            line(&[(0.0, 0.0), (0.2, 0.0), (0.3, 0.08)], &[Some(Wrinkle::USUAL); 2]),
            line(&[(0.1, -0.1), (0.11, 0.1)], &[Some(narrow)]),
        ];
        let ridges = ridges(&Piece { lines, ..Piece::default() });
        let found = points(&ridges, |_, _| true);
        let least = |p: &DVec2| if ridges[1].distance(*p) < 0.012 { narrow.row() } else { 0.04 / 6.0 };
        for (i, p) in found.iter().enumerate() {
            for q in &found[..i] {
                assert!(p.distance(*q) > 0.6 * least(p).min(least(q)), "{p} and {q}");
            }
        }
        let about: f64 = ridges.iter().map(Ridge::count).sum();
        let count = found.len() as f64;
        assert!(count > 0.7 * about && count < 1.1 * about, "{count} of about {about}");
        assert!(
            ridges.iter().all(|ridge| ridge.is_fine(0.02) && !ridge.is_fine(0.003)),
            "the mesh is fine enough"
        );
    }
}
