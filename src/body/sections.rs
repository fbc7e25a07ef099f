//! The trunk of an upright body, read off its horizontal sections.

use glam::{DVec2, DVec3};

use crate::body::measure::{hull_perimeter, section};
use crate::geometry::mesh::TriMesh;

/// Number of sections over the body's height.
const LEVELS: usize = 160;
/// A height at which a standing body is surely cut through its trunk, as a fraction of its height.
const BELLY: f64 = 0.6;
/// Growth of the trunk's girth from one section to the next that shows that the arms have joined.
const ARMS_JOIN: f64 = 1.12;
/// Lowest height at which arms may join, as a fraction of the body's height.
const LOWEST_ARMPIT: f64 = 0.65;
/// Highest height at which the neck is sought, as a fraction of the body's height: above is the crown of the head.
const CROWN: f64 = 0.95;

/// A horizontal section of the trunk.
#[derive(Clone, Debug)]
pub struct Level {
    /// Height (y) of the section, metres.
    pub height: f64,
    /// Girth: length of a tape round the section, metres.
    pub girth: f64,
    /// The section as a closed polyline; the first point is not repeated.
    pub points: Vec<DVec3>,
}

/// The trunk of an upright body that faces +z.
#[derive(Clone, Debug)]
pub struct Trunk {
    /// x of the plane between left and right, metres.
    pub middle: f64,
    /// Height (y) of the crotch: the lowest section that crosses the middle plane, metres.
    pub crotch: f64,
    /// Height (y) at which the arms join, metres; None for a body without arms.
    pub armpit: Option<f64>,
    /// Height (y) of the neck: where the body is thinnest above the arms, metres.
    pub neck: f64,
    /// Sections from the crotch up to the armpit, or to the neck where there are no arms.
    pub levels: Vec<Level>,
}

impl Trunk {
    /// Reads the trunk of a body. None when no section crosses the middle plane at the belly.
    pub fn new(mesh: &TriMesh) -> Option<Self> {
        let (lower, upper) = mesh.bounds();
        let tall = upper.y - lower.y;
        let middle = middle(mesh);
        let height = |k: usize| lower.y + tall * (k as f64 + 0.5) / LEVELS as f64;
        let levels: Vec<Option<Level>> = (0..LEVELS).map(|k| trunk_at(mesh, height(k), middle)).collect();
        let start = (BELLY * LEVELS as f64) as usize;
        let bottom = (0..=start).rev().take_while(|&k| levels[k].is_some()).last()?;
        let top = (start..LEVELS).take_while(|&k| levels[k].is_some()).last()?;
        let girth = |k: usize| levels[k].as_ref().map_or(0.0, |l| l.girth);
        let lowest_armpit = (LOWEST_ARMPIT * LEVELS as f64) as usize;
        let join = (lowest_armpit..top).find(|&k| girth(k + 1) > ARMS_JOIN * girth(k));
        let crown = top.min((CROWN * LEVELS as f64) as usize);
        let neck = (join.map_or(lowest_armpit, |k| k + 1)..=crown)
            .min_by(|&a, &b| girth(a).total_cmp(&girth(b)))
            .unwrap_or(crown);
        let last = join.unwrap_or(neck);
        Some(Self {
            middle,
            crotch: height(bottom),
            armpit: join.map(height),
            neck: height(neck),
            levels: levels.into_iter().take(last + 1).skip(bottom).flatten().collect(),
        })
    }

    /// The section nearest to `height`.
    pub fn nearest(&self, height: f64) -> Option<&Level> {
        self.levels.iter().min_by(|a, b| (a.height - height).abs().total_cmp(&(b.height - height).abs()))
    }

    /// Height (y) at which a loop of `girth` metres comes to rest when it slides down from the waist. None where it fits
    /// over the hips and falls.
    pub fn rest_of(&self, girth: f64) -> Option<f64> {
        self.levels[..=self.waist()?].iter().rev().find(|l| l.girth >= girth).map(|l| l.height)
    }

    /// The index in `levels` of the waist: the thinnest section above the hips.
    pub fn waist(&self) -> Option<usize> {
        (0..self.levels.len())
            .filter(|&k| self.levels[k].height > self.hips())
            .min_by(|&a, &b| self.levels[a].girth.total_cmp(&self.levels[b].girth))
    }

    /// Height (y) of the hips: where the lower half of the trunk is widest, metres.
    fn hips(&self) -> f64 {
        let half = self.levels.len() / 2;
        self.levels[..half]
            .iter()
            .max_by(|a, b| a.girth.total_cmp(&b.girth))
            .map_or(self.crotch, |l| l.height)
    }
}

/// Mean x of a surface, weighted by area, metres.
fn middle(mesh: &TriMesh) -> f64 {
    let (mut sum, mut area) = (0.0, 0.0);
    for t in 0..mesh.triangles.len() {
        let [a, b, c] = mesh.corners(t);
        let size = (b - a).cross(c - a).length();
        sum += size * (a.x + b.x + c.x) / 3.0;
        area += size;
    }
    if area > 0.0 { sum / area } else { 0.0 }
}

/// The section of largest girth at `height` that crosses the middle plane.
pub(super) fn trunk_at(mesh: &TriMesh, height: f64, middle: f64) -> Option<Level> {
    section(mesh, DVec3::Y * height, DVec3::Y)
        .into_iter()
        .filter(|points| {
            points.iter().any(|p| p.x < middle) && points.iter().any(|p| p.x > middle) && points.len() > 3
        })
        .map(|points| {
            let girth = hull_perimeter(points.iter().map(|p| DVec2::new(p.x, p.z)).collect());
            Level { height, girth, points }
        })
        .max_by(|a, b| a.girth.total_cmp(&b.girth))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::mannequin;

    #[test]
    fn the_mannequins_trunk_is_where_its_landmarks_are() {
        let figure = mannequin::default();
        let trunk = Trunk::new(&figure.mesh).expect("a trunk");
        let mark = |name| figure.landmarks.get(name).expect("a landmark").y;
        assert!(trunk.middle.abs() < 0.005, "{}", trunk.middle);
        assert!((trunk.crotch - mark("crotch")).abs() < 0.02, "{} {}", trunk.crotch, mark("crotch"));
        let armpit = trunk.armpit.expect("arms");
        assert!((armpit - mark("armpit_left")).abs() < 0.03, "{armpit} {}", mark("armpit_left"));
        assert!(trunk.neck > armpit && trunk.neck < mark("crown"));
        // A belt as long as the trunk is round at some height rests there, or above where the body is as wide.
        let hips = trunk.nearest(mark("hip_front")).expect("a section");
        let rest = trunk.rest_of(hips.girth - 0.02).expect("a height");
        assert!(rest >= hips.height && rest < hips.height + 0.1, "{rest} {}", hips.height);
    }
}
