//! Landmarks: named points of a body, and how to find them on a mesh that comes without.
//!
//! They are read off horizontal sections of a standing human with y up, facing +z, arms down, half up or sideways: the
//! crotch is where the legs meet, the hip the level of largest girth above it, the waist the level of smallest girth
//! above that, the armpits where the arms join, the throat the level of smallest girth between shoulders and head.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use crate::body::measure::{hull_perimeter, section};
use crate::geometry::mesh::TriMesh;
use crate::geometry::polygon::signed_area;

/// Step between levels, as a fraction of the height.
const STEP: f64 = 0.005;
/// Growth of the trunk's width within two steps that shows that the arms have joined.
const ARMS_JOIN: f64 = 1.25;

/// Distance of the hand from the middle plane beyond which an arm counts as spread, as a fraction of the height.
const SPREAD: f64 = 0.22;

/// Largest distance of an arm's middle from the line between shoulder and hand, as a fraction of that line's length.
const ARM_OFF_LINE: f64 = 0.2;

/// Landmarks: named points on the skin, metres. Names end in `_left` (x > 0) or `_right` where there are two.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Landmarks {
    points: BTreeMap<String, DVec3>,
}

impl Landmarks {
    /// The landmark called `name`.
    pub fn get(&self, name: &str) -> Option<DVec3> {
        self.points.get(name).copied()
    }

    /// All landmarks in the order of their names.
    pub fn iter(&self) -> impl Iterator<Item = (&str, DVec3)> {
        self.points.iter().map(|(name, &p)| (name.as_str(), p))
    }

    /// These landmarks with every point mapped by `f`.
    pub fn map(self, f: impl Fn(DVec3) -> DVec3) -> Self {
        Self { points: self.points.into_iter().map(|(name, p)| (name, f(p))).collect() }
    }

    /// The name of the landmark nearest to `p`, if there is one within `reach` metres.
    pub fn near(&self, p: DVec3, reach: f64) -> Option<&str> {
        let distances = self.iter().map(|(name, q)| (name, q.distance(p)));
        let nearest = distances.min_by(|a, b| a.1.total_cmp(&b.1));
        nearest.filter(|(_, distance)| *distance <= reach).map(|(name, _)| name)
    }

    pub(super) fn add(&mut self, name: impl Into<String>, p: DVec3) {
        self.points.insert(name.into(), p);
    }
}

/// Finds the landmarks of a human mesh; None where it does not look like one. On the mannequin crown, crotch, waist
/// and hip are within 3 cm of where it was built with them, and shoulders within 8 cm, because the top of the
/// shoulder is found and not its tip.
pub fn found(mesh: &TriMesh) -> Option<Landmarks> {
    Levels { mesh, middle: 0.0, floor: mesh.bounds().0.y, height: mesh.bounds().1.y - mesh.bounds().0.y }
        .landmarks()
}

/// Outline of a horizontal section, in the xz plane, metres.
type Outline = Vec<DVec2>;

/// Horizontal sections of a mesh. A level is a fraction of its height.
struct Levels<'a> {
    mesh: &'a TriMesh,
    /// x of the plane between left and right, metres.
    middle: f64,
    floor: f64,
    height: f64,
}

impl Levels<'_> {
    fn landmarks(mut self) -> Option<Landmarks> {
        let widest = self.outlines(0.62).into_iter().max_by(|a, b| area(a).total_cmp(&area(b)))?;
        let (low, high) = span(&widest, 0);
        self.middle = (low + high) / 2.0;
        let crotch = self.crotch()?;
        let hip = self.extreme(crotch + 0.01, crotch + 0.12, |a, b| a > b)?;
        let waist = self.extreme(crotch + 0.12, crotch + 0.25, |a, b| a < b)?;
        let armpit = self.armpit(waist)?;
        let throat = self.extreme(armpit + 0.05, 0.92, |a, b| a < b)?;
        let chest = armpit - 0.02;
        let mut marks = Landmarks::default();
        for (name, level) in [("hip", hip), ("waist", waist), ("chest", chest), ("throat", throat)] {
            let trunk = self.trunk(level)?;
            self.four(&mut marks, name, &trunk, level, ["side_left", "side_right"])?;
        }
        let above = self.trunk(crotch + STEP)?;
        let (back, front) = across(&above, 0, self.middle)?;
        marks.add("crotch", DVec3::new(self.middle, self.y(crotch), (back + front) / 2.0));
        let top = self.mesh.positions.iter().copied().max_by(|a, b| a.y.total_cmp(&b.y))?;
        marks.add("crown", top);
        for (side, sign) in [("left", 1.0), ("right", -1.0)] {
            self.leg(&mut marks, side, sign, crotch)?;
            self.shoulder(&mut marks, side, chest)?;
            self.arm(&mut marks, side, sign, [chest, waist]);
        }
        Some(marks)
    }

    fn y(&self, level: f64) -> f64 {
        self.floor + level * self.height
    }

    fn outlines(&self, level: f64) -> Vec<Outline> {
        let loops = section(self.mesh, DVec3::Y * self.y(level), DVec3::Y);
        loops.into_iter().map(|points| points.into_iter().map(|p| DVec2::new(p.x, p.z)).collect()).collect()
    }

    /// The largest outline at `level` that crosses the middle plane.
    fn trunk(&self, level: f64) -> Option<Outline> {
        let outlines = self.outlines(level).into_iter().filter(|o| across(o, 0, self.middle).is_some());
        outlines.max_by(|a, b| area(a).total_cmp(&area(b)))
    }

    /// The lowest level at which one outline crosses the middle plane, going down from the trunk.
    fn crotch(&self) -> Option<f64> {
        // Something that joins the legs further down (skirt, plinth, animal) makes no crotch.
        let (mut one, mut two) = (0.62, 0.30);
        self.trunk(one)?;
        let mut level = one;
        while level > two {
            if self.trunk(level).is_none() {
                two = level;
                break;
            }
            one = level;
            level -= STEP;
        }
        if one - two > 1.5 * STEP {
            return None;
        }
        for _ in 0..6 {
            let level = (one + two) / 2.0;
            if self.trunk(level).is_some() { one = level } else { two = level }
        }
        (0.38..0.56).contains(&one).then_some(one)
    }

    /// The level in a range whose girth of the trunk is `best` against the best before.
    fn extreme(&self, from: f64, to: f64, best: impl Fn(f64, f64) -> bool) -> Option<f64> {
        let mut found: Option<(f64, f64)> = None;
        for i in 0..=((to - from) / STEP).round() as usize {
            let level = from + i as f64 * STEP;
            let tape = hull_perimeter(self.trunk(level)?);
            if found.is_none_or(|(known, _)| best(tape, known)) {
                found = Some((tape, level));
            }
        }
        found.map(|(_, level)| level)
    }

    /// The highest level below which the arms are still separate from the trunk.
    fn armpit(&self, waist: f64) -> Option<f64> {
        let width = |level: f64| self.trunk(level).map(|o| span(&o, 0)).map(|(low, high)| high - low);
        let levels = (0..).map(|i| waist + f64::from(i) * STEP).take_while(|level| *level < 0.88);
        let widths = levels.map(|level| Some((level, width(level)?))).collect::<Option<Vec<_>>>()?;
        let joined = widths.windows(3).find(|w| w[2].1 > ARMS_JOIN * w[0].1)?;
        Some(joined[0].0)
    }

    /// Adds four landmarks of an outline: front, back and both sides, straight out from its middle.
    fn four(
        &self,
        marks: &mut Landmarks,
        name: &str,
        outline: &Outline,
        level: f64,
        [left, right]: [&str; 2],
    ) -> Option<()> {
        let x = if across(outline, 0, self.middle).is_some() { self.middle } else { centre(outline).x };
        let (back, front) = across(outline, 0, x)?;
        let z = (back + front) / 2.0;
        let (low, high) = across(outline, 1, z)?;
        let y = self.y(level);
        marks.add(format!("{name}_front"), DVec3::new(x, y, front));
        marks.add(format!("{name}_back"), DVec3::new(x, y, back));
        marks.add(format!("{name}_{left}"), DVec3::new(high, y, z));
        marks.add(format!("{name}_{right}"), DVec3::new(low, y, z));
        Some(())
    }

    fn leg(&self, marks: &mut Landmarks, side: &str, sign: f64, crotch: f64) -> Option<()> {
        for (name, share) in [("knee", 0.585), ("ankle", 0.17)] {
            let level = crotch * share;
            let legs = self.outlines(level);
            let [a, b] = &legs[..] else { return None };
            let leg = if (centre(a).x - centre(b).x) * sign > 0.0 { a } else { b };
            self.four(marks, &format!("{name}_{side}"), leg, level, ["high_x", "low_x"])?;
        }
        Some(())
    }

    /// Adds the shoulder: the top of the trunk above a point a little inward of the chest's side.
    fn shoulder(&self, marks: &mut Landmarks, side: &str, chest: f64) -> Option<()> {
        let chest_side = marks.get(&format!("chest_side_{side}"))?;
        let x = self.middle + 0.9 * (chest_side.x - self.middle);
        let trunk = |level: f64| self.trunk(level).and_then(|o| across(&o, 0, x)).map(|(a, b)| (a + b) / 2.0);
        let levels = (0..).map(|i| chest + f64::from(i) * STEP).take_while(|level| *level < 0.95);
        let top = levels.map_while(|level| Some((level, trunk(level)?))).last()?;
        marks.add(format!("shoulder_{side}"), DVec3::new(x, self.y(top.0 + STEP / 2.0), top.1));
        Some(())
    }

    /// Adds landmarks of one arm where they are found: round it at chest and waist where it hangs there, and at the
    /// hand where it is spread.
    fn arm(&self, marks: &mut Landmarks, side: &str, sign: f64, levels: [f64; 2]) {
        for (name, level) in ["upper_arm", "forearm"].into_iter().zip(levels) {
            let Some(trunk) = self.trunk(level) else { continue };
            let outward = |o: &Outline| (centre(o).x - centre(&trunk).x) * sign;
            let beside = (span(&trunk, 0).1 - span(&trunk, 0).0) / 2.0;
            let arms = self.outlines(level).into_iter().filter(|o| outward(o) > beside);
            if let Some(arm) = arms.max_by(|a, b| area(a).total_cmp(&area(b))) {
                self.four(marks, &format!("{name}_{side}"), &arm, level, ["high_x", "low_x"]);
            }
        }
        let out = |p: &DVec3| (p.x - self.middle) * sign;
        let hand = self.mesh.positions.iter().copied().max_by(|a, b| out(a).total_cmp(&out(b)));
        if let Some(hand) = hand.filter(|p| out(p) > SPREAD * self.height) {
            marks.add(format!("hand_{side}"), hand);
            let shoulder = marks.get(&format!("shoulder_{side}"));
            if let Some(rings) = shoulder.and_then(|shoulder| arm_rings(self.mesh, shoulder, hand)) {
                rings.into_iter().for_each(|(name, p)| marks.add(format!("{name}_{side}"), p));
            }
        }
    }
}

/// Four landmarks round the arm (above, below, front, back) at each of three places between shoulder and hand, in
/// sections across the arm. None where a section is not near the line from shoulder to hand.
fn arm_rings(mesh: &TriMesh, shoulder: DVec3, hand: DVec3) -> Option<Vec<(String, DVec3)>> {
    let along = (hand - shoulder).try_normalize()?;
    let front = (DVec3::Z - along * along.z).try_normalize()?;
    let above = if along.x > 0.0 { front.cross(along) } else { along.cross(front) };
    let mut rings = Vec::new();
    for (name, share) in [("arm_upper", 0.38), ("arm_middle", 0.55), ("arm_lower", 0.72)] {
        let on_line = shoulder.lerp(hand, share);
        let middle = |points: &Vec<DVec3>| points.iter().sum::<DVec3>() / points.len() as f64;
        let near = |points: &Vec<DVec3>| middle(points).distance(on_line);
        let ring = section(mesh, on_line, along).into_iter().min_by(|a, b| near(a).total_cmp(&near(b)))?;
        if near(&ring) > ARM_OFF_LINE * shoulder.distance(hand) {
            return None;
        }
        for (place, way) in [("above", above), ("below", -above), ("front", front), ("back", -front)] {
            let far = |p: &DVec3| (*p - middle(&ring)).dot(way);
            let p = ring.iter().copied().max_by(|a, b| far(a).total_cmp(&far(b)))?;
            rings.push((format!("{name}_{place}"), p));
        }
    }
    Some(rings)
}

fn area(outline: &[DVec2]) -> f64 {
    signed_area(outline).abs()
}

fn centre(outline: &[DVec2]) -> DVec2 {
    let (x, z) = (span(outline, 0), span(outline, 1));
    DVec2::new(x.0 + x.1, z.0 + z.1) / 2.0
}

/// Smallest and largest coordinate along `axis`.
fn span(outline: &[DVec2], axis: usize) -> (f64, f64) {
    let all = outline.iter().map(|p| p[axis]);
    all.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), c| (low.min(c), high.max(c)))
}

/// Smallest and largest other coordinate where the outline crosses the line on which the coordinate `axis` is `at`.
/// None where it does not cross.
fn across(outline: &[DVec2], axis: usize, at: f64) -> Option<(f64, f64)> {
    let n = outline.len();
    let crossings = (0..n).filter_map(|i| {
        let (a, b) = (outline[i], outline[(i + 1) % n]);
        let t = (at - a[axis]) / (b[axis] - a[axis]);
        ((a[axis] > at) != (b[axis] > at)).then(|| a.lerp(b, t)[1 - axis])
    });
    crossings.fold(None, |found, c| {
        let (low, high) = found.unwrap_or((c, c));
        Some((c.min(low), c.max(high)))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::mannequin;

    #[test]
    fn the_mannequin_is_read_as_it_was_built() {
        let figure = mannequin::default();
        let found = found(&figure.mesh).expect("a human");
        let names = ["crown", "crotch", "waist_front", "waist_back", "waist_side_left", "waist_side_right"];
        for name in names.into_iter().chain(["hip_front", "hip_back", "hip_side_left", "hip_side_right"]) {
            let [there, here] = [&figure.landmarks, &found].map(|l| l.get(name).expect(name));
            assert!(there.distance(here) < 0.03, "{name}: built {there}, read {here}");
        }
        let level = |name: &str| figure.tapes.iter().find(|t| t.name == name).expect(name).origin.y;
        assert!((found.get("throat_front").expect("throat").y - level("neck")).abs() < 0.03);
        let armpit = figure.landmarks.get("armpit_left").expect("armpit");
        assert!((0.0..0.08).contains(&(armpit.y - found.get("chest_front").expect("chest").y)));
        for side in ["left", "right"] {
            let name = format!("shoulder_{side}");
            let [there, here] = [&figure.landmarks, &found].map(|l| l.get(&name).expect("shoulder"));
            assert!(there.distance(here) < 0.08, "{name}: built {there}, read {here}");
            let wrist = figure.landmarks.get(&format!("wrist_{side}")).expect("wrist");
            assert!(found.get(&format!("hand_{side}")).expect("hand").distance(wrist) < 0.25);
        }
    }

    #[test]
    fn what_is_no_human_has_none() {
        assert!(found(&TriMesh::default()).is_none());
        let tetrahedron = TriMesh {
            positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z],
            triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        };
        assert!(found(&tetrahedron).is_none());
    }

    #[test]
    fn a_landmark_is_near_within_reach_only() {
        let mut marks = Landmarks::default();
        assert_eq!(marks.near(DVec3::ZERO, 1.0), None);
        marks.add("a", DVec3::X);
        marks.add("b", DVec3::Y * 0.5);
        assert_eq!(marks.near(DVec3::ZERO, 0.6), Some("b"));
        assert_eq!(marks.near(DVec3::ZERO, 0.4), None);
    }
}
