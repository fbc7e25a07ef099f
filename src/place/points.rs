//! Arrangement points: places round the body at which a piece can be put, and its placement there.

use glam::{DMat3, DQuat, DVec2, DVec3};

use crate::body::Surface;
use crate::contact::Bone;
use crate::pattern::fineness::CHORDS;
use crate::pattern::{Piece, Roll, SpacePose};
use crate::place::limbs::{Limb, Part, limbs};
use crate::wrap::ROUND_LIMBS;

/// Distance between skin and flat pieces before and behind the body, metres on a body 1.5 m large. Chosen by trial.
const BEFORE: f64 = 0.05;
/// Largest protrusion of the body that flat pieces before and behind it are moved out for, metres on a body 1.5 m large. Chosen by
/// trial: what stands out farther, as a stretched arm, is not the trunk.
const STANDS_OUT: f64 = 0.25;
/// Fraction of a limb's circumference above which a piece at the limb is rolled. Chosen by trial.
const ROLLED: f64 = 0.55;

/// An arrangement point: a place on the skin, with the directions in which cloth is placed there.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Name, such as "left upper arm, front".
    pub name: String,
    pub part: Part,
    /// Position on the skin, metres.
    pub at: DVec3,
    /// Direction away from the bone, a unit vector.
    pub out: DVec3,
    /// Direction along the bone in which the upper end of a piece points: towards the trunk, at trunk and head
    /// upward; a unit vector.
    pub up: DVec3,
    /// Distance from the bone to the skin at the point, metres.
    pub reach: f64,
    /// Distance from the bone to the farthest of the points round it at this height, metres.
    pub girth_radius: f64,
}

/// The places along a bone that have points: their names, and their positions as fractions of the bone's length.
fn heights(part: Part, halves: bool) -> &'static [(&'static str, f64)] {
    match part {
        Part::Trunk => &[("hips", 0.1), ("waist", 0.4), ("chest", 0.62)],
        Part::Head => &[("head", 0.6)],
        Part::Arm { .. } => &[("upper arm", 0.15), ("forearm", 0.9)],
        Part::Leg { .. } if halves => &[("", 0.45)],
        Part::Leg { .. } => &[("thigh", 0.2), ("shin", 0.75)],
        Part::Other(_) => &[("near end", 0.15), ("middle", 0.5), ("far end", 0.85)],
    }
}

/// The arrangement points of a body with these bones: four round each of some places along each bone. Points without
/// skin (where a bone leaves the body) are left out.
pub fn points(surface: &Surface, bones: &[Bone]) -> Vec<Point> {
    let (lower, upper) = surface.bounds();
    let limbs = limbs(bones, upper.y - lower.y);
    let mut all = Vec::new();
    for (k, limb) in limbs.iter().enumerate() {
        let alike = |other: &&Limb| other.part == limb.part;
        let halves = matches!(limb.part, Part::Leg { .. }) && limbs.iter().filter(alike).count() > 1;
        let is_second = limbs[..k].iter().any(|other| other.part == limb.part);
        for &(height, share) in heights(limb.part, halves) {
            let height = if halves { if is_second { "shin" } else { "thigh" } } else { height };
            all.extend(ring(surface, limb, height, share));
        }
    }
    all
}

fn ring(surface: &Surface, limb: &Limb, height: &str, share: f64) -> Vec<Point> {
    let on_bone = limb.bone[0].lerp(limb.bone[1], share);
    let along = limb.along();
    let up = if matches!(limb.part, Part::Trunk | Part::Head) { along } else { -along };
    let Some(front) = (DVec3::Z - along * along.z).try_normalize() else { return Vec::new() };
    // Right-handed, seen with the body facing the reader: the body's left is at +x.
    let left = up.cross(front);
    let sides = match limb.part {
        Part::Arm { left: true } | Part::Leg { left: true } => ["outside", "inside"],
        Part::Arm { left: false } | Part::Leg { left: false } => ["inside", "outside"],
        _ => ["left", "right"],
    };
    let ways = [("front", front), ("back", -front), (sides[0], left), (sides[1], -left)];
    let hits: Vec<_> = ways
        .into_iter()
        .filter_map(|(name, out)| Some((name, out, surface.ray(on_bone, out)?.distance)))
        .collect();
    let girth_radius = hits.iter().map(|hit| hit.2).fold(0.0, f64::max);
    let place = match limb.part {
        Part::Arm { left } | Part::Leg { left } => {
            format!("{} {height}", if left { "left" } else { "right" })
        }
        Part::Other(_) => format!("{}, {height}", limb.part),
        _ => height.to_owned(),
    };
    let point = |(name, out, reach): (&str, DVec3, f64)| Point {
        name: format!("{place}, {name}"),
        part: limb.part,
        at: on_bone + out * reach,
        out,
        up,
        reach,
        girth_radius,
    };
    hits.into_iter().map(point).collect()
}

/// Placement of `piece` at `point`: its middle there, its outer side facing away from the body, its upper end on the
/// table along the bone's `up`. Before, behind and beside the trunk it is flat, clear of whatever protrudes from the
/// body behind it. At a limb it is rolled where it goes round most of it, with the radius of paper B's self-rolling,
/// or that of the limb where that is larger.
pub fn stood_at(piece: &Piece, point: &Point, surface: &Surface) -> SpacePose {
    let scale = surface.scale();
    let Frame { up, across, left, right, bottom, top, centre, outer } = Frame::new(piece);
    let width = right - left;
    // Columns: the images of `across`, `up` and the plane's +z.
    let z = point.out * outer;
    let to_world = DMat3::from_cols(point.up.cross(z), point.up, z);
    let to_frame = DQuat::from_rotation_z(-across.to_angle());
    let rotation = (DQuat::from_mat3(&to_world) * to_frame).normalize();
    let standing = |distance: f64, roll: Option<Roll>| {
        let target = point.at + point.out * distance;
        SpacePose { translation: target - rotation * centre.extend(0.0), rotation, roll }
    };
    let is_limb = !matches!(point.part, Part::Trunk | Part::Head);
    let least = point.girth_radius + ROUND_LIMBS * scale;
    if is_limb && width > ROLLED * std::f64::consts::TAU * least {
        let radius = least.max(width / std::f64::consts::TAU + ROUND_LIMBS * scale / 4.0);
        let roll = Roll { centre, along: up, radius: radius * outer };
        return standing(radius - point.reach, Some(roll));
    }
    if is_limb {
        return standing(ROUND_LIMBS * scale, None);
    }
    let flat = standing(0.0, None);
    let back = flat.rotation.inverse();
    let most = STANDS_OUT * scale;
    let stands_out = surface.mesh.positions.iter().filter_map(|&p| {
        let local = back * (p - flat.translation);
        let (s, t) = (local.truncate().dot(across), local.truncate().dot(up));
        let before = (left..=right).contains(&s) && (bottom..=top).contains(&t);
        Some(local.z * outer).filter(|&by| before && by < most)
    });
    standing(stands_out.fold(0.0, f64::max) + BEFORE * scale, None)
}

/// A piece as it lies on the table: its directions and extent, metres in its own plane.
struct Frame {
    up: DVec2,
    across: DVec2,
    left: f64,
    right: f64,
    bottom: f64,
    top: f64,
    /// Centre of its extent.
    centre: DVec2,
    /// 1 when its outer side faces +z of its own plane, else -1.
    outer: f64,
}

impl Frame {
    fn new(piece: &Piece) -> Self {
        let up = piece.pose.piece_from_plane(piece.pose.offset + DVec2::Y).normalize_or(DVec2::Y);
        let across = -up.perp();
        let outline = piece.flattened(CHORDS);
        let span = |way: DVec2| {
            let all = outline.iter().map(|p| p.dot(way));
            all.fold((f64::MAX, f64::MIN), |(low, high), s| (low.min(s), high.max(s)))
        };
        let [(left, right), (bottom, top)] = [span(across), span(up)];
        let centre = across * ((left + right) / 2.0) + up * ((bottom + top) / 2.0);
        let outer = if piece.signed_area() < 0.0 { -1.0 } else { 1.0 };
        Self { up, across, left, right, bottom, top, centre, outer }
    }
}

/// The placement `pose` rolled about its middle into a tube that just closes, to a gap of 1 cm, its outer side out (paper B, "self-rolling").
pub fn rolled_up(piece: &Piece, pose: SpacePose) -> SpacePose {
    let Frame { up, left, right, centre, outer, .. } = Frame::new(piece);
    let radius = ((right - left) + 0.01) / std::f64::consts::TAU;
    SpacePose { roll: Some(Roll { centre, along: up, radius: radius * outer }), ..pose }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::mannequin;
    use crate::pattern::PlanePose;

    fn body() -> (Surface, Vec<Point>) {
        let figure = mannequin::default();
        let surface = Surface::new(figure.mesh.clone()).expect("a body");
        let points = points(&surface, &figure.skeleton.six_segments());
        (surface, points)
    }

    fn called<'a>(points: &'a [Point], name: &str) -> &'a Point {
        points.iter().find(|p| p.name == name).unwrap_or_else(|| panic!("{name}"))
    }

    fn panel(width: f64, height: f64, pose: PlanePose) -> Piece {
        let corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)].map(DVec2::from);
        Piece { pose, ..Piece::polygon("panel", &corners) }
    }

    #[test]
    fn points_lie_on_the_skin_all_round_and_have_names_of_their_own() {
        let (surface, points) = body();
        assert_eq!(points.len(), 48);
        let mut names: Vec<&str> = points.iter().map(|p| &*p.name).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), points.len());
        for point in &points {
            assert!(surface.nearest(point.at).distance.abs() < 1e-5, "{}", point.name);
            assert!(point.out.dot(point.up).abs() < 1e-12 && point.reach <= point.girth_radius);
        }
        assert!(called(&points, "chest, front").out.z > 0.9);
        let beside = called(&points, "chest, left").at;
        assert!(
            beside.x < called(&points, "left upper arm, inside").at.x,
            "under the arm, not beyond it: {beside}"
        );
        assert!(called(&points, "waist, left").out.x > 0.9);
        assert!(called(&points, "left upper arm, outside").out.x > 0.3);
        assert!(called(&points, "right thigh, outside").out.x < -0.9);
        assert!(called(&points, "left forearm, front").up.y > 0.3);
    }

    #[test]
    fn a_piece_stands_upright_with_its_outer_side_out_however_it_lies_on_the_table() {
        let (surface, points) = body();
        let point = called(&points, "waist, back");
        for (turn, flipped) in [(0.0, false), (0.8, false), (-2.0, true), (0.0, true)] {
            let pose = PlanePose { offset: DVec2::new(3.0, 1.0), rotation: turn, flipped };
            for mirrored in [false, true] {
                let mut piece = panel(0.5, 0.6, pose);
                if mirrored {
                    let corners: Vec<DVec2> = piece.flattened(1e-3).into_iter().rev().collect();
                    piece = Piece { pose, ..Piece::polygon("mirrored", &corners) };
                }
                let placed = stood_at(&piece, point, &surface);
                assert!(placed.is_sound() && placed.roll.is_none());
                let outer = if piece.signed_area() < 0.0 { DVec3::NEG_Z } else { DVec3::Z };
                assert!((placed.rotation * outer).distance(point.out) < 1e-12);
                let on_table = |p: DVec2| placed.at(piece.pose.piece_from_plane(p));
                let rise = on_table(DVec2::Y) - on_table(DVec2::ZERO);
                assert!(rise.distance(point.up) < 1e-12, "{rise} at {turn} {flipped}");
                for p in piece.flattened(1e-3) {
                    assert!(surface.nearest(placed.at(p)).distance > 0.03, "{p}");
                }
            }
        }
    }

    #[test]
    fn a_wide_piece_goes_round_a_limb_and_closes_there() {
        let (surface, points) = body();
        let point = called(&points, "left upper arm, outside");
        let placed = stood_at(&panel(0.5, 0.2, PlanePose::default()), point, &surface);
        let roll = placed.roll.expect("a tube");
        let gap = placed.at(DVec2::new(0.0, 0.1)).distance(placed.at(DVec2::new(0.5, 0.1)));
        assert!(gap < 0.06, "{gap} of a turn of {}", std::f64::consts::TAU * roll.radius);
        for k in 0..=20 {
            let p = placed.at(DVec2::new(0.5 * f64::from(k) / 20.0, 0.1));
            assert!(!surface.contains(p) && surface.nearest(p).distance < 0.12, "{k}");
        }
        assert!(stood_at(&panel(0.1, 0.2, PlanePose::default()), point, &surface).roll.is_none());
    }
}
