//! Moves a file's placement to another body: one of another height, with another origin, or with its arms elsewhere.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use glam::{DQuat, DVec3};

use crate::body::{Surface, Trunk};
use crate::contact::Bone;
use crate::geometry::ids::PieceId;
use crate::geometry::words::{Words, decimal, words};
use crate::pattern::{CutPattern, EdgeRef, Pattern, SpacePose};
use crate::place::limbs::{Part, limbs};
use crate::wrap::{RUNS_ALONG, Stand, stand};

/// How near to where it belongs something is left as it is; distances in metres on a body 1.5 m large.
struct Near {
    /// A garment.
    garment: f64,
    /// A garment that hangs from the shoulders and whose sleeves have to be turned.
    with_turned_sleeves: f64,
    /// A garment held by a ring round the trunk, from where it would rest: it slides, and may be meant to sit higher or lower.
    ring: f64,
    /// A sleeve: angle to its arm, radians.
    sleeve: f64,
}

/// Chosen by trial; what is farther off than this is taken to be placed for another body.
const NEAR: Near = Near { garment: 0.06, with_turned_sleeves: 0.01, ring: 0.15, sleeve: 0.3 };

/// Largest distance by which a garment cut in one with its sleeves is raised for its arms, metres on a body 1.5 m large. Chosen by
/// trial; it bounds what one point that lies far too low does to the whole garment.
const RAISED: f64 = 0.1;
/// Sine of the angle of an arm to the frontal plane above which it counts as stretched to the front or back. About 27°. Chosen by
/// trial.
const FORWARD: f64 = 0.45;
/// Distance from the middle beyond which pieces of an arm must be wholly, as a fraction of the trunk's half breadth. Chosen by
/// trial; the labels and names of pieces come first.
const BESIDE: f64 = 0.7;

/// New placements of pieces, and messages about what was done.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Moved {
    /// Placements of the pieces that move.
    pub placements: Vec<(PieceId, Option<SpacePose>)>,
    /// Messages such as "raised by 1.10 m" or "what is round the left arm turned by 47°".
    pub words: Vec<Words>,
}

impl Moved {
    /// Applies the placements to the pieces of `pattern`.
    pub fn carry_out(&self, pattern: &mut Pattern) {
        for (id, placement) in &self.placements {
            if let Some(piece) = pattern.pieces.get_mut(id) {
                Arc::make_mut(piece).placement = *placement;
            }
        }
    }
}

/// Moves the placement of `pattern` to the body with these bones. The whole garment is moved up or down and sideways
/// to where its support belongs (shoulder seams on the shoulders, those along the arms over them, a waistband where
/// it rests). Pieces sewn round an arm are turned and moved on to that arm (paper B, "initial positioning": the axis
/// of a piece is turned on to its bone). What is near enough is left.
/// `offset` is the height of the cloth above the skin, metres.
pub fn onto(pattern: &Pattern, surface: &Surface, bones: &[Bone], offset: f64) -> Moved {
    let Some(trunk) = Trunk::new(&surface.mesh) else { return Moved::default() };
    let (cut, _) = CutPattern::new(pattern);
    let mut poses: BTreeMap<PieceId, SpacePose> =
        pattern.pieces.iter().filter_map(|(&id, piece)| Some((id, piece.placement?))).collect();
    let before = poses.clone();
    let mut words = Vec::new();
    let (lower, upper) = surface.bounds();
    let arms = limbs(bones, upper.y - lower.y);
    let turned = |poses: &BTreeMap<PieceId, SpacePose>, left: bool| {
        let arm = *arms.iter().find(|limb| limb.part == Part::Arm { left })?;
        let group = sleeve(&cut, &trunk, poses, left)?;
        let goes = towards(group.along, arm.along());
        (group.along.angle_between(goes) > NEAR.sleeve).then_some((arm, group, goes))
    };
    // If sleeves are turned, there is less room for a garment that is too low.
    let is_other_pose = [true, false].into_iter().any(|left| turned(&poses, left).is_some());
    let near = if is_other_pose { NEAR.with_turned_sleeves } else { NEAR.garment };
    let by = stand(&cut, surface, &trunk, offset)
        .map_or(DVec3::ZERO, |found| shift(found, waist(&trunk), surface.scale(), near));
    if by != DVec3::ZERO {
        poses.values_mut().for_each(|pose| pose.translation += by);
        words.extend(told(by));
    }
    for left in [true, false] {
        let Some((arm, group, goes)) = turned(&poses, left) else { continue };
        let was = group.along;
        let angle = was.angle_between(goes);
        let turn = DQuat::from_rotation_arc(was, goes);
        let turned: Vec<DVec3> =
            group.outline(&cut, &poses).map(|p| turn * (p - group.armhole) + group.armhole).collect();
        // Round the arm: move the middle of the sleeve's extent across the arm to its bone.
        let across =
            [DVec3::Z, goes.cross(DVec3::Z)].map(|way| (way - goes * goes.dot(way)).normalize_or_zero());
        let by: DVec3 = across
            .iter()
            .map(|way| {
                let spans = turned.iter().map(|p| p.dot(*way));
                let (low, high) =
                    spans.fold((f64::MAX, f64::MIN), |(low, high), s| (low.min(s), high.max(s)));
                let up = *way * way.y.signum();
                // A sleeve wider than the arm hangs on it: more of it is above.
                let arm_is = surface.ray(arm.bone[0], up).map_or(0.0, |hit| hit.distance);
                let slack = ((high - low) / 2.0 - arm_is).max(0.0);
                *way * (arm.bone[0].dot(*way) - (low + high) / 2.0) + up * (slack / 2.0 * way.y.abs())
            })
            .sum();
        for id in &group.pieces {
            poses.entry(*id).and_modify(|pose| *pose = pose.moved(turn, group.armhole, by));
        }
        let n = decimal(angle.to_degrees(), 0);
        words.push(match left {
            true => words!("what is round the left arm turned by {n}°", n),
            false => words!("what is round the right arm turned by {n}°", n),
        });
    }
    let changed = poses.into_iter().filter(|(id, pose)| before.get(id) != Some(pose));
    Moved { placements: changed.map(|(id, pose)| (id, Some(pose))).collect(), words }
}

/// Direction for a sleeve that runs `along` on an arm that runs `arm`: in the frontal plane, so that its halves
/// before and behind stay upright, where the arm is not stretched far to the front or back.
fn towards(along: DVec3, arm: DVec3) -> DVec3 {
    let upright = (arm * DVec3::new(1.0, 1.0, 0.0)).normalize_or_zero();
    let is_upright = along.z.abs() < FORWARD && arm.z.abs() < FORWARD && upright != DVec3::ZERO;
    if is_upright { upright } else { arm }
}

/// Translation of the whole garment, metres; zero along axes along which it is near enough. One that hangs from the
/// shoulders may be `hung_near` from them, metres on a body 1.5 m large.
fn shift(stand: Stand, waist: DVec3, scale: f64, hung_near: f64) -> DVec3 {
    let Stand { placed, body, bounds, hangs, short_of_arms } = stand;
    let near = NEAR.garment * scale;
    let far = |by: f64| if by.abs() > near { by } else { 0.0 };
    // Sideways the garment stays where the waist is within the middle half of its extent, or where it has no extent.
    let sideways = |axis: usize| {
        let (low, high) = (bounds[0][axis], bounds[1][axis]);
        let (middle, breadth) = ((low + high) / 2.0, high - low);
        let is_round = breadth > near && (waist[axis] - middle).abs() > breadth / 4.0;
        if is_round { far(waist[axis] - middle) } else { 0.0 }
    };
    let up = body - placed;
    let stays = up.abs() <= scale * if hangs { hung_near } else { NEAR.ring };
    let up = if stays { 0.0 } else { up };
    // Sewn with the arms underneath, the garment falls on to the shoulders.
    let up = up.max(short_of_arms.min(up + RAISED * scale));
    DVec3::new(sideways(0), up, sideways(2))
}

/// Centre of the trunk half way up, metres.
fn waist(trunk: &Trunk) -> DVec3 {
    let Some(level) = trunk.levels.get(trunk.levels.len() / 2) else { return DVec3::X * trunk.middle };
    let spans =
        level.points.iter().fold((f64::MAX, f64::MIN), |(low, high), p| (low.min(p.z), high.max(p.z)));
    DVec3::new(trunk.middle, level.height, (spans.0 + spans.1) / 2.0)
}

fn told(by: DVec3) -> Vec<Words> {
    let way = |axis: usize| {
        let m = decimal(by[axis].abs(), 2);
        match (axis, by[axis] < 0.0) {
            _ if by[axis] == 0.0 => None,
            (0, true) => Some(words!("moved to the right by {m} m", m)),
            (0, false) => Some(words!("moved to the left by {m} m", m)),
            (1, true) => Some(words!("lowered by {m} m", m)),
            (1, false) => Some(words!("raised by {m} m", m)),
            (_, true) => Some(words!("moved back by {m} m", m)),
            (_, false) => Some(words!("moved forward by {m} m", m)),
        }
    };
    (0..3).filter_map(way).collect()
}

/// The pieces round one arm.
struct Sleeve {
    pieces: BTreeSet<PieceId>,
    /// Mean position of the seams by which they are sewn to the rest, metres.
    armhole: DVec3,
    /// Direction from the armhole to the other end, a unit vector.
    along: DVec3,
}

impl Sleeve {
    fn outline<'a>(
        &'a self,
        cut: &'a CutPattern,
        poses: &'a BTreeMap<PieceId, SpacePose>,
    ) -> impl Iterator<Item = DVec3> + 'a {
        self.pieces.iter().flat_map(move |id| {
            let pose = poses[id];
            cut.pieces[id].outline.iter().map(move |edge| pose.at(edge.start))
        })
    }
}

/// Adds placed pieces that are sewn to `pieces` and to nothing else, such as a cuff.
fn join_attached(pieces: &mut BTreeSet<PieceId>, cut: &CutPattern, poses: &BTreeMap<PieceId, SpacePose>) {
    let mut sewn_to: BTreeMap<PieceId, BTreeSet<PieceId>> = BTreeMap::new();
    for seam in cut.edge_seams() {
        let [a, b] = seam.sides.map(|edge| edge.piece);
        sewn_to.entry(a).or_default().insert(b);
        sewn_to.entry(b).or_default().insert(a);
    }
    loop {
        let is_attached = |id: &PieceId, others: &BTreeSet<PieceId>| {
            poses.contains_key(id)
                && others.iter().any(|other| pieces.contains(other))
                && others.iter().all(|other| other == id || pieces.contains(other))
        };
        let attached = sewn_to.iter().filter(|(id, others)| !pieces.contains(id) && is_attached(id, others));
        let attached: Vec<PieceId> = attached.map(|(id, _)| *id).collect();
        if attached.is_empty() {
            return;
        }
        pieces.extend(attached);
    }
}

/// The pieces of the left or right arm: those that are so by label or name, or that are wholly beside the trunk above
/// the waist, and what is sewn to those alone. None where there are none, or where they are sewn to nothing else.
fn sleeve(
    cut: &CutPattern,
    trunk: &Trunk,
    poses: &BTreeMap<PieceId, SpacePose>,
    left: bool,
) -> Option<Sleeve> {
    let waist = trunk.levels.get(trunk.levels.len() / 2)?;
    let beside = waist.points.iter().map(|p| (p.x - trunk.middle).abs()).fold(0.0, f64::max) * BESIDE;
    let side = if left { 1.0 } else { -1.0 };
    let is_arm = |id: &PieceId, pose: &SpacePose| {
        let piece = &cut.pieces[id];
        let corners: Vec<DVec3> = piece.outline.iter().map(|edge| pose.at(edge.start)).collect();
        let middle = corners.iter().sum::<DVec3>() / corners.len().max(1) as f64;
        let out = (middle.x - trunk.middle) * side;
        let name = piece.name.to_lowercase();
        let said = piece.label.as_deref() == Some("arm") || name.contains("sleeve") || name.contains("cuff");
        let stands = corners.iter().all(|p| (p.x - trunk.middle) * side > beside) && middle.y > waist.height;
        let elsewhere = piece.label.as_deref().is_some_and(|label| label != "arm");
        out > 0.0 && (said || stands && !elsewhere)
    };
    let mut pieces: BTreeSet<PieceId> =
        poses.iter().filter(|(id, pose)| is_arm(id, pose)).map(|(id, _)| *id).collect();
    join_attached(&mut pieces, cut, poses);
    let chord = |edge: &EdgeRef| {
        let (piece, pose) = (cut.pieces.get(&edge.piece)?, poses.get(&edge.piece)?);
        let (a, b) = (edge.edge < piece.edge_count()).then(|| piece.edge_ends(edge.edge))?;
        Some([pose.at(a), pose.at(b)])
    };
    let (mut armhole, mut lengths) = (Vec::new(), Vec::new());
    for seam in cut.edge_seams() {
        let ours = seam.sides.map(|edge| pieces.contains(&edge.piece));
        for (edge, ours_here) in seam.sides.iter().zip(ours) {
            if ours == [true, true] {
                lengths.extend(chord(edge));
            } else if ours_here {
                armhole.extend(chord(edge));
            }
        }
    }
    if armhole.is_empty() {
        return None;
    }
    let armhole = armhole.iter().flatten().sum::<DVec3>() / (2 * armhole.len()) as f64;
    let mut sleeve = Sleeve { pieces, armhole, along: DVec3::ZERO };
    let (sum, count) = sleeve.outline(cut, poses).fold((DVec3::ZERO, 0), |(sum, n), p| (sum + p, n + 1));
    let outward = sum / f64::from(count) - armhole;
    // Seams along the sleeve tell its direction better than its middle, which may be off where it is slanted.
    let outward_unit = outward.normalize_or_zero();
    let along: DVec3 = lengths
        .iter()
        .map(|[a, b]| (*b - *a, (*b - *a).normalize_or_zero().dot(outward_unit)))
        .filter(|(_, cosine)| cosine.abs() > RUNS_ALONG)
        .map(|(chord, cosine)| chord * cosine.signum())
        .sum();
    sleeve.along = along.try_normalize().or_else(|| outward.try_normalize())?;
    Some(sleeve)
}
