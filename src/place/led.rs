//! Leads sleeves to their arms before they are sewn. Pieces placed before and behind an arm, but too high, too low or
//! at an angle to it, would be sewn together beside the arm.
//!
//! Such a sleeve need not keep its shape: it is bent in its plane towards the arm, from its cuff on up, and relaxes
//! when it is sewn.

use glam::{DQuat, DVec3};

use crate::body::{Surface, bones};
use crate::cloth::{EdgeMetric, Garment};
use crate::contact::Bone;
use crate::geometry::borders::border_loops;
use crate::geometry::mesh::TriMesh;
use crate::place::limbs::{Limb, Part, limbs};

/// `places` (metres, one for each flat corner of `garment`) with sleeves led to the arms of the body. They are
/// unchanged where the body does not look human, or where the arms run between the edges of the sleeves already, as legs do between
/// those of trousers.
pub fn led(garment: &Garment, surface: &Surface, places: &[Option<DVec3>]) -> Vec<Option<DVec3>> {
    let mut places = places.to_vec();
    let Some(marks) = surface.landmarks() else { return places };
    let (lower, upper) = surface.bounds();
    let all = limbs(&bones::extracted(surface, marks), upper.y - lower.y);
    let legs: Vec<Bone> =
        all.iter().filter(|limb| matches!(limb.part, Part::Leg { .. })).map(|limb| limb.bone).collect();
    let cloth =
        TriMesh { positions: vec![DVec3::ZERO; garment.vertex_count], triangles: garment.triangles.clone() };
    let borders = border_loops(&cloth);
    let metric = EdgeMetric::new(garment);
    for limb in &all {
        let Part::Arm { left } = limb.part else { continue };
        let side = if left { "left" } else { "right" };
        let Some(arm) =
            marks.get(&format!("shoulder_{side}")).and_then(|shoulder| Arm::new(limb, shoulder, surface))
        else {
            continue;
        };
        let mut seen = vec![false; garment.vertex_count];
        for cuff in arm.cuffs(garment, &borders, &places) {
            if seen[cuff.border[0] as usize] || legs.iter().any(|leg| cuff.is_round(leg)) {
                continue;
            }
            let sources: Vec<(u32, f64)> = cuff.border.iter().map(|&v| (v, 0.0)).collect();
            let away = metric.from(&sources, |_| true);
            away.order.iter().for_each(|&v| seen[v as usize] = true);
            if !arm.runs_through(&cuff) {
                arm.turn(&cuff, garment, &away.distance, &mut places);
            }
        }
    }
    places
}

/// The cuff: the opening at the end of a sleeve.
struct Cuff<'a> {
    border: &'a [u32],
    /// Positions of the corners at the opening, metres.
    points: Vec<DVec3>,
    /// From the shoulder to the middle of the opening, in the frontal plane, metres.
    from: DVec3,
}

impl Cuff<'_> {
    /// Whether the opening is that of a leg, as of short trousers, which end beside the arm: `leg` runs between its edges before
    /// and behind.
    fn is_round(&self, [hip, knee]: &Bone) -> bool {
        let middle = self.points.iter().sum::<DVec3>() / self.points.len() as f64;
        let share = (middle.y - hip.y) / (knee.y - hip.y);
        let at = hip.lerp(*knee, if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 });
        [false, true].into_iter().all(|is_behind| {
            let part = self.points.iter().filter(|p| (p.z < at.z) == is_behind);
            let [low, high] = part.fold([f64::MAX, f64::MIN], |[low, high], p| [low.min(p.x), high.max(p.x)]);
            (low..high).contains(&at.x)
        })
    }
}

/// An arm, seen from the front.
struct Arm<'a> {
    surface: &'a Surface,
    /// Point of the arm's line nearest to the shoulder, metres.
    root: DVec3,
    /// Direction of the arm in the frontal plane, a unit vector.
    along: DVec3,
}

impl<'a> Arm<'a> {
    /// The arm of `limb`. None where it points straight to the front or back.
    fn new(limb: &Limb, shoulder: DVec3, surface: &'a Surface) -> Option<Self> {
        let (from, way) = (limb.bone[0], limb.along());
        let root = from + way * (shoulder - from).dot(way);
        Some(Self { surface, root, along: upright(way).try_normalize()? })
    }

    /// The openings that may be a cuff of this arm, the outermost first.
    fn cuffs<'b>(
        &self,
        garment: &Garment,
        borders: &'b [Vec<u32>],
        places: &[Option<DVec3>],
    ) -> Vec<Cuff<'b>> {
        let mut of_vertex = vec![usize::MAX; garment.vertex_count];
        for (k, border) in borders.iter().enumerate() {
            border.iter().for_each(|&v| of_vertex[v as usize] = k);
        }
        let mut points = vec![Vec::new(); borders.len()];
        for (corner, place) in garment.corners.iter().zip(places) {
            if let (Some(points), Some(p)) = (points.get_mut(of_vertex[corner.vertex as usize]), place) {
                points.push(*p);
            }
        }
        let scale = self.surface.scale();
        let outward = |from: DVec3| from.x * self.along.x.signum();
        let cuff = |(border, points): (&'b Vec<u32>, Vec<DVec3>)| {
            let middle = points.iter().sum::<DVec3>() / points.len() as f64;
            Cuff { border, from: upright(middle - self.root), points }
        };
        let stands = |cuff: &Cuff<'_>| {
            let length = cuff.from.length();
            // On a body 1.5 m large: at least 4 cm out from the shoulder, else there is no sleeve; nearer than 75 cm, else it is not a
            // sleeve's; and roughly in the direction of the arm.
            let is_aside = cuff.from.dot(self.along) > 0.4 * length;
            outward(cuff.from) > 0.04 * scale && length < 0.75 * scale && is_aside
        };
        let placed = borders.iter().zip(points).filter(|(_, points)| !points.is_empty());
        let mut cuffs: Vec<Cuff<'b>> = placed.map(cuff).filter(stands).collect();
        cuffs.sort_by(|a, b| outward(b.from).total_cmp(&outward(a.from)));
        cuffs
    }

    /// Whether the arm has room between the edges of `cuff` before it and those behind it: 1.5 cm on a body 1.5 m large.
    fn runs_through(&self, cuff: &Cuff<'_>) -> bool {
        let Some(across) = upright(DVec3::Y - self.along * self.along.y).try_normalize() else { return true };
        let at = self.root + self.along * cuff.from.dot(self.along);
        let span = |is_behind: bool| {
            let part =
                cuff.points.iter().filter(|p| (p.z < at.z) == is_behind).map(|p| (*p - at).dot(across));
            part.fold([f64::MAX, f64::MIN], |[low, high], v| [low.min(v), high.max(v)])
        };
        let (before, behind) = (span(false), span(true));
        if before[0] > before[1] || behind[0] > behind[1] {
            return true;
        }
        let clear = 0.015 * self.surface.scale();
        let skin = |way: DVec3| self.surface.ray(at, way).map_or(0.0, |hit| hit.distance) + clear;
        before[0].max(behind[0]) <= -skin(-across) && skin(across) <= before[1].min(behind[1])
    }

    /// Turns the cloth sewn to `cuff` about the shoulder until the cuff is round the arm. The turn fades with the
    /// distance `away` from the cuff (metres, for each vertex); no point moves farther than the cuff.
    fn turn(&self, cuff: &Cuff<'_>, garment: &Garment, away: &[f64], places: &mut [Option<DVec3>]) {
        let length = cuff.from.length();
        let angle = cuff.from.cross(self.along).z.atan2(cuff.from.dot(self.along));
        let turn = DQuat::from_rotation_z(angle);
        // The half nearer to the cuff is turned wholly. Over less than twice the cuff's path, the cloth would be turned over where
        // the turn fades out.
        let near = 0.5 * length;
        let over = length * (2.0 * angle.abs()).max(0.6);
        for (place, corner) in places.iter_mut().zip(&garment.corners) {
            let t = (1.0 - (away[corner.vertex as usize] - near) / over).clamp(0.0, 1.0);
            let share = t * t * (3.0 - 2.0 * t);
            *place = place.map(|p| {
                let from = upright(p - self.root).clamp_length_max(length);
                p + (turn * from - from) * share
            });
        }
    }
}

fn upright(v: DVec3) -> DVec3 {
    v * DVec3::new(1.0, 1.0, 0.0)
}
