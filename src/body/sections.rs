//! Where an upright body's trunk begins and ends, read off its horizontal sections.

use glam::{DVec2, DVec3};

use crate::body::Surface;
use crate::body::measure::{hull_perimeter, section};
use crate::geometry::mesh::TriMesh;

/// How many sections are made of a body's height.
const LEVELS: usize = 160;
/// At this share of the height a standing body is surely cut through its trunk.
const BELLY: f64 = 0.6;
/// Where the trunk's section grows by this factor from one level to the next, arms have joined it.
const ARMS_JOIN: f64 = 1.12;
/// Arms join no lower than this share of the height.
const LOWEST_ARMPIT: f64 = 0.65;
/// The head's crown, as a share of the height: no neck is looked for there.
const CROWN: f64 = 0.95;

/// A horizontal section of the trunk.
#[derive(Clone, Debug)]
pub struct Level {
    /// Metres.
    pub height: f64,
    /// Round the section, pulled taut, metres.
    pub girth: f64,
    /// The closed polyline, its last point not its first.
    pub points: Vec<DVec3>,
}

/// The trunk of an upright body that faces +z.
#[derive(Clone, Debug)]
pub struct Trunk {
    /// The plane between left and right, metres.
    pub middle: f64,
    /// Where the legs part: the lowest section that crosses the middle, metres.
    pub crotch: f64,
    /// Where the arms join, metres; none for a body without arms.
    pub armpit: Option<f64>,
    /// Where the body is thinnest above the arms, metres.
    pub neck: f64,
    /// From the crotch up to the armpit, or to the neck.
    pub levels: Vec<Level>,
}

impl Trunk {
    /// None when the body has no trunk to speak of: nothing crosses the middle at its belly.
    pub fn new(surface: &Surface) -> Option<Self> {
        let (lower, upper) = surface.bounds();
        let tall = upper.y - lower.y;
        let middle = middle(surface);
        let height = |k: usize| lower.y + tall * (k as f64 + 0.5) / LEVELS as f64;
        let levels: Vec<Option<Level>> =
            (0..LEVELS).map(|k| trunk_at(&surface.mesh, height(k), middle)).collect();
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

    /// Where something `girth` metres round comes to lie when it slides down from the waist.
    pub fn rest_of(&self, girth: f64) -> Option<f64> {
        self.levels[..=self.waist()?].iter().rev().find(|l| l.girth >= girth).map(|l| l.height)
    }

    /// The thinnest level above the hips, by its number.
    pub fn waist(&self) -> Option<usize> {
        (0..self.levels.len())
            .filter(|&k| self.levels[k].height > self.hips())
            .min_by(|&a, &b| self.levels[a].girth.total_cmp(&self.levels[b].girth))
    }

    /// Where the trunk is widest in its lower half.
    fn hips(&self) -> f64 {
        let half = self.levels.len() / 2;
        self.levels[..half]
            .iter()
            .max_by(|a, b| a.girth.total_cmp(&b.girth))
            .map_or(self.crotch, |l| l.height)
    }
}

/// The area's mean place between left and right.
fn middle(surface: &Surface) -> f64 {
    let (mut sum, mut area) = (0.0, 0.0);
    for t in 0..surface.mesh.triangles.len() {
        let [a, b, c] = surface.mesh.corners(t);
        let size = (b - a).cross(c - a).length();
        sum += size * (a.x + b.x + c.x) / 3.0;
        area += size;
    }
    if area > 0.0 { sum / area } else { 0.0 }
}

/// The largest section at `height` that crosses the middle.
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
        let surface = Surface::new(figure.mesh.clone()).expect("triangles");
        let trunk = Trunk::new(&surface).expect("a trunk");
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
