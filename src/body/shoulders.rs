//! Shoulder tips and armpits of a standing body, and the measurements between and from them.
//!
//! A mannequin is built with them. On another body the armpit is the highest place below which the arm is separate
//! from the trunk, and the tip is the top of the shoulder straight above it: on the mean body of GarmentCode
//! (GarmentMeasurements, `landmarks_female.json`) both are within 5 mm of the points chosen by its makers. The
//! mannequin's own tips are farther out, across the arm from the joint, so that a mannequin written to a file and
//! read again has narrower shoulders than it was built with.

use glam::{DVec2, DVec3};

use crate::body::landmarks::Landmarks;
use crate::body::measure::{length, section, taut};
use crate::body::sections::trunk_at;
use crate::geometry::mesh::TriMesh;

/// Range of distances from the middle plane in which armpits are sought, as fractions of the height.
const BESIDE: [f64; 2] = [0.05, 0.16];
/// Step in the search for armpits, as a fraction of the height.
const STEP: f64 = 0.001;
/// Range of heights of a shoulder, as fractions of the body's height: the crown of the head is higher.
const SHOULDERS: [f64; 2] = [0.7, 0.9];
/// Smallest angle of an arm below the horizontal, radians; a higher arm moves its armpit out from below the tip.
const LEVEL: f64 = 0.35;
/// Position of the elbow on the way from tip to wrist, a fraction: the mannequin's.
const ELBOW: f64 = 0.547;

/// Both shoulders, the left one first.
pub struct Shoulders {
    /// Shoulder tips on the skin, metres.
    pub tips: [DVec3; 2],
    /// Armpits on the skin, metres.
    pub armpits: [DVec3; 2],
}

impl Shoulders {
    /// The shoulders that a figure was built with.
    pub fn own(marks: &Landmarks) -> Option<Self> {
        let pair =
            |name: &str| Some([marks.get(&format!("{name}_left"))?, marks.get(&format!("{name}_right"))?]);
        Some(Self { tips: pair("shoulder")?, armpits: pair("armpit")? })
    }

    /// Finds the shoulders of a standing mesh, y up, facing +z, with its landmarks. None where an arm is held level
    /// or higher, or is nowhere separate from the trunk.
    pub fn found(mesh: &TriMesh, marks: &Landmarks) -> Option<Self> {
        let middle = marks.get("crotch")?.x;
        let [(left, left_pit), (right, right_pit)] = [
            shoulder(mesh, middle, 1.0, marks.get("hand_left"))?,
            shoulder(mesh, middle, -1.0, marks.get("hand_right"))?,
        ];
        Some(Self { tips: [left, right], armpits: [left_pit, right_pit] })
    }

    /// Shoulder width: straight from tip to tip, metres. Twice the mannequin's `half_across_shoulder`, and
    /// GarmentCode's `shoulder_w`.
    pub fn width(&self) -> f64 {
        self.tips[0].distance(self.tips[1])
    }

    /// Across back, as tailors measure it: length of a taut string along the back from armhole to armhole,
    /// horizontal, half-way between tips and armpits, metres; and its height (y). GarmentCode's `back_width` is
    /// another measurement: the part of the bust behind the side seams.
    pub fn across_back(&self, mesh: &TriMesh, middle: f64) -> Option<(f64, f64)> {
        let folds: Vec<DVec3> =
            self.tips.iter().zip(&self.armpits).map(|(tip, pit)| tip.lerp(*pit, 0.5)).collect();
        let y = (folds[0].y + folds[1].y) / 2.0;
        let outline = trunk_at(mesh, y, middle)?.points;
        let (high, low) = (folds[0].x, folds[1].x);
        let behind = (folds[0].z + folds[1].z) / 2.0;
        let ends = [low, high].map(|x| back_at(&outline, x, behind));
        let between =
            outline.iter().filter(|p| p.x > low && p.x < high && p.z < behind).map(|p| DVec2::new(p.x, p.z));
        let mut line: Vec<DVec2> = between.collect();
        line.push(DVec2::new(low, ends[0]?));
        line.push(DVec2::new(high, ends[1]?));
        line.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        Some((length(&taut(line.into_iter())), y))
    }

    /// Arm length: from the left tip over the outside of the elbow to `wrist`, metres. The mannequin's `arm_length`,
    /// and for a straight arm GarmentCode's, which is the shortest path on the skin. `above` points out of the arm on
    /// the side of the tape.
    pub fn arm_length(&self, mesh: &TriMesh, wrist: DVec3, above: DVec3) -> Option<f64> {
        let tip = self.tips[0];
        let at = tip.lerp(wrist, ELBOW);
        let ring = ring(mesh, at, (wrist - tip).try_normalize()?)?;
        let elbow = outermost(&ring, above)?;
        Some(tip.distance(elbow) + elbow.distance(wrist))
    }
}

/// The closed line of the section through `at` whose centre is nearest to `at`.
pub fn ring(mesh: &TriMesh, at: DVec3, normal: DVec3) -> Option<Vec<DVec3>> {
    let off = |points: &Vec<DVec3>| (points.iter().sum::<DVec3>() / points.len() as f64).distance(at);
    section(mesh, at, normal).into_iter().min_by(|a, b| off(a).total_cmp(&off(b)))
}

/// The point that is farthest along `way`.
pub fn outermost(points: &[DVec3], way: DVec3) -> Option<DVec3> {
    points.iter().copied().max_by(|a, b| a.dot(way).total_cmp(&b.dot(way)))
}

/// The smallest z at which the outline crosses the given `x`, if it is less than `behind`.
fn back_at(outline: &[DVec3], x: f64, behind: f64) -> Option<f64> {
    let sides = outline.iter().zip(outline.iter().cycle().skip(1));
    let across = sides.filter(|(p, q)| (p.x < x) != (q.x < x));
    let z = across.map(|(p, q)| p.lerp(*q, (x - p.x) / (q.x - p.x)).z).filter(|z| *z < behind);
    z.min_by(f64::total_cmp)
}

/// Shoulder tip and armpit on the side of `sign` (1 left, -1 right).
fn shoulder(mesh: &TriMesh, middle: f64, sign: f64, hand: Option<DVec3>) -> Option<(DVec3, DVec3)> {
    let (floor, top) = (mesh.bounds().0.y, mesh.bounds().1.y);
    let tall = top - floor;
    let count = ((BESIDE[1] - BESIDE[0]) / STEP).round() as usize;
    let planes = (0..=count).map(|k| middle + sign * tall * (BESIDE[0] + STEP * k as f64));
    let ends = planes.filter_map(|x| {
        // The head may hang over the shoulder as a separate outline.
        let tops = section(mesh, DVec3::X * x, DVec3::X).into_iter();
        let part = tops.filter_map(|part| Some((outermost(&part, DVec3::Y)?, outermost(&part, -DVec3::Y)?)));
        let is_shoulder = |at: &DVec3| (SHOULDERS[0]..SHOULDERS[1]).contains(&((at.y - floor) / tall));
        part.filter(|(above, _)| is_shoulder(above)).max_by(|a, b| a.0.y.total_cmp(&b.0.y))
    });
    let (tip, armpit) = ends.max_by(|a, b| a.1.y.total_cmp(&b.1.y))?;
    let droops = |hand: DVec3| (tip.y - hand.y) >= LEVEL.sin() * tip.distance(hand);
    (armpit.y > floor + 0.6 * tall && hand.is_none_or(droops)).then_some((tip, armpit))
}
