//! Tape measurements of a standing human body of any origin: girths, heights, lengths, widths and depths.
//!
//! The places are those of dressmaking: waist where the trunk is thinnest, hip where it is fullest below, bust
//! through the foremost point of the chest, neck where it is thinnest, nape where the neck runs into the back, thigh
//! just below the crotch, calf where the lower leg is fullest, ankle and wrist where they are thinnest.

use glam::{DVec2, DVec3};

use crate::body::landmarks::{self, Landmarks};
use crate::body::measure::{Tape, girth, hull_perimeter, length, section};
use crate::body::sections::{Level, trunk_at};
use crate::body::shoulders::{Shoulders, outermost, ring};
use crate::geometry::mesh::TriMesh;

/// Step between levels, as a fraction of the height.
const STEP: f64 = 0.004;
/// Distance of the thigh measurement below the crotch, as a fraction of the height.
const BELOW_CROTCH: f64 = 0.008;

/// Step along the middle of the back, as a fraction of the height.
const BACK_STEP: f64 = 0.002;
/// Height above the throat up to which the back is followed, as a fraction of the height.
const ABOVE_THROAT: f64 = 0.015;
/// Steps to either side of a place over which the forward lean of the back is taken; the nape is where it is largest.
/// They span 3 % of the height, the length of a vertebra or two, so that neither a crease of the neck nor the bend of
/// the whole back moves the nape.
const NAPE: usize = 7;

/// Height of the knee, as a fraction of the inside leg length.
const KNEE: f64 = 0.595;

/// One measurement of a body.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
pub struct Reading {
    /// Name, such as `bust` or `inside leg`.
    pub name: &'static str,
    /// The value, metres.
    pub metres: f64,
    /// Height above the floor at which it was taken, metres; None where that says nothing.
    pub height: Option<f64>,
    /// The tape of a girth, with its origin inside the body; None for other measurements.
    #[serde(skip)]
    pub tape: Option<Tape>,
}

impl Reading {
    /// A measurement without a height and a tape.
    fn plain(name: &'static str, metres: f64) -> Self {
        Self { name, metres, ..Self::default() }
    }

    /// A horizontal girth round `points`, a section of the body; the floor is at y = `floor`.
    fn round(name: &'static str, points: &[DVec3], floor: f64) -> Self {
        let origin = points.iter().sum::<DVec3>() / points.len().max(1) as f64;
        let tape = Some(Tape { name, origin, normal: DVec3::Y });
        Self { name, metres: round(points), height: Some(origin.y - floor), tape }
    }
}

/// All measurements that can be read on `mesh`: closed, y up, facing +z, arms down or spread. None when it does not
/// look human. Where a figure's `own` landmarks are given, its shoulders, elbow and wrist are used for lengths.
pub fn readings(mesh: &TriMesh, own: Option<&Landmarks>) -> Option<Vec<Reading>> {
    read(mesh, &landmarks::found(mesh)?, own)
}

/// The same where the landmarks `marks` were found on `mesh`.
pub(super) fn read(mesh: &TriMesh, marks: &Landmarks, own: Option<&Landmarks>) -> Option<Vec<Reading>> {
    let (low, high) = mesh.bounds();
    let reader = Reader { mesh, floor: low.y, tall: high.y - low.y, middle: marks.get("crotch")?.x };
    let shoulders = own.and_then(Shoulders::own).or_else(|| Shoulders::found(mesh, marks));
    let mut all = vec![Reading::plain("height", reader.tall)];
    reader.trunk(marks, &mut all)?;
    reader.leg(marks, &mut all)?;
    let wrist = reader.arm(marks, &mut all);
    if let Some(shoulders) = shoulders {
        reader.shoulders(&shoulders, &mut all);
        let own = own.and_then(|own| Some([own.get("elbow_left")?, own.get("wrist_left")?]));
        let length = match own {
            Some([elbow, wrist]) => Some(shoulders.tips[0].distance(elbow) + elbow.distance(wrist)),
            None => wrist.and_then(|(wrist, above)| shoulders.arm_length(mesh, wrist, above)),
        };
        all.extend(length.map(|metres| Reading::plain("arm length", metres)));
    }
    Some(all)
}

/// Girth of the trunk `height` metres above the floor; `middle` is x of the plane between left and right. None where
/// nothing crosses that plane.
pub fn round_at(mesh: &TriMesh, height: f64, middle: f64) -> Option<Reading> {
    let floor = mesh.bounds().0.y;
    let level = trunk_at(mesh, floor + height, middle)?;
    Some(Reading::round("girth", &level.points, floor))
}

struct Reader<'a> {
    mesh: &'a TriMesh,
    floor: f64,
    tall: f64,
    middle: f64,
}

impl Reader<'_> {
    fn trunk_at(&self, y: f64) -> Option<Level> {
        trunk_at(self.mesh, y, self.middle)
    }

    /// The level in a range at which `worth` is largest, and that value.
    fn best(&self, from: f64, to: f64, worth: impl Fn(f64) -> Option<f64>) -> Option<(f64, f64)> {
        let count = ((to - from) / (STEP * self.tall)).ceil().max(1.0) as usize;
        let levels = (0..=count).map(|k| from + (to - from) * k as f64 / count as f64);
        levels.filter_map(|y| Some((y, worth(y)?))).max_by(|a, b| a.1.total_cmp(&b.1))
    }

    fn trunk(&self, marks: &Landmarks, all: &mut Vec<Reading>) -> Option<()> {
        let y = |name: &str| marks.get(name).map(|p| p.y);
        let (crotch, hip, waist, chest) =
            (y("crotch")?, y("hip_front")?, y("waist_front")?, y("chest_front")?);
        let near = 0.02 * self.tall;
        let tape = |y: f64| self.trunk_at(y).map(|level| level.girth);
        let (waist, _) = self.best(waist - near, waist + near, |y| tape(y).map(|l| -l))?;
        let (hip, _) = self.best(hip - near, hip + near, tape)?;
        let front = |y: f64| self.trunk_at(y)?.points.iter().map(|p| p.z).max_by(f64::total_cmp);
        let (bust, _) = self.best((waist + chest) / 2.0, chest + 2.0 * near, front)?;
        let neck = y("throat_front")?;
        let (neck, _) = self.best(neck - near, neck + near, |y| tape(y).map(|l| -l))?;
        // Underbust: where the chest begins to come forward, the girth bends most from level to level.
        let d = 2.0 * STEP * self.tall;
        let hollow = |y: f64| Some(tape(y + d)? + tape(y - d)? - 2.0 * tape(y)?);
        let (under, _) = self.best(waist + near, bust - near, hollow)?;
        let names = [("neck", neck), ("bust", bust), ("underbust", under), ("waist", waist), ("hip", hip)];
        for (name, y) in names {
            all.push(Reading::round(name, &self.trunk_at(y)?.points, self.floor));
        }
        for (width, depth, y) in [
            ("bust width", "bust depth", bust),
            ("waist width", "waist depth", waist),
            ("hip width", "hip depth", hip),
        ] {
            let points = self.trunk_at(y)?.points;
            let span = |of: fn(&DVec3) -> f64| {
                let all = points.iter().map(of);
                all.clone().fold(f64::MIN, f64::max) - all.fold(f64::MAX, f64::min)
            };
            let height = Some(y - self.floor);
            all.push(Reading { height, ..Reading::plain(width, span(|p| p.x)) });
            all.push(Reading { height, ..Reading::plain(depth, span(|p| p.z)) });
        }
        let heights = [("waist height", waist), ("hip height", hip), ("inside leg", crotch)];
        all.extend(heights.map(|(name, y)| Reading::plain(name, y - self.floor)));
        self.back([waist, bust, y("throat_front")?], all);
        Some(())
    }

    /// Reads the nape height and the back length from nape to waist, along the middle of the back. The nape is sought
    /// above the bust.
    fn back(&self, [waist, bust, throat]: [f64; 3], all: &mut Vec<Reading>) -> Option<()> {
        let step = BACK_STEP * self.tall;
        let top = throat + ABOVE_THROAT * self.tall;
        let levels = (0..).map(|k| waist + f64::from(k) * step).take_while(|y| *y <= top);
        let line: Vec<DVec2> = levels.map_while(|y| Some(DVec2::new(y, self.back_at(y)?))).collect();
        let forward = |k: &usize| line[k + NAPE].y - line[k - NAPE].y;
        let above_bust = (NAPE..line.len().checked_sub(NAPE)?).filter(|&k| line[k].x > bust);
        let nape = above_bust.max_by(|a, b| forward(a).total_cmp(&forward(b)))?;
        all.push(Reading::plain("nape height", line[nape].x - self.floor));
        all.push(Reading::plain("back neck to waist", length(&line[..=nape])));
        Some(())
    }

    /// z of the trunk's back in the middle plane at height `y`, metres.
    fn back_at(&self, y: f64) -> Option<f64> {
        let points = self.trunk_at(y)?.points;
        let sides = points.iter().zip(points.iter().cycle().skip(1));
        let across = sides.filter(|(p, q)| (p.x < self.middle) != (q.x < self.middle));
        across.map(|(p, q)| p.lerp(*q, (self.middle - p.x) / (q.x - p.x)).z).min_by(f64::total_cmp)
    }

    /// Reads the girths of the left leg.
    fn leg(&self, marks: &Landmarks, all: &mut Vec<Reading>) -> Option<()> {
        let crotch = marks.get("crotch")?.y;
        let line = |y: f64| {
            let beside = |points: &Vec<DVec3>| points.iter().all(|p| p.x > self.middle);
            let loops = section(self.mesh, DVec3::Y * y, DVec3::Y).into_iter().filter(beside);
            // The leg is the innermost outline; a hand hangs farther out.
            loops.min_by(|a, b| out(a, self.middle).total_cmp(&out(b, self.middle)))
        };
        let tape = |y: f64| line(y).map(|points| round(&points));
        let leg = crotch - self.floor;
        let at = |share: f64| self.floor + share * leg;
        let (calf, _) = self.best(at(0.3), at(0.52), tape)?;
        let (ankle, _) = self.best(at(0.165), at(0.25), |y| tape(y).map(|l| -l))?;
        let knee = at(KNEE);
        let thigh = crotch - BELOW_CROTCH * self.tall;
        for (name, y) in [
            ("thigh", thigh),
            ("mid thigh", (crotch + knee) / 2.0),
            ("knee", knee),
            ("calf", calf),
            ("ankle", ankle),
        ] {
            all.push(Reading::round(name, &line(y)?, self.floor));
        }
        Some(())
    }

    fn shoulders(&self, shoulders: &Shoulders, all: &mut Vec<Reading>) {
        all.push(Reading::plain("shoulder width", shoulders.width()));
        if let Some((metres, y)) = shoulders.across_back(self.mesh, self.middle) {
            let height = Some(y - self.floor);
            all.push(Reading { height, ..Reading::plain("across back", metres) });
        }
    }

    /// Reads the girths of the left arm where it is spread. Returns a point on the outside of its wrist and the
    /// direction outward there; None where the arm is not spread.
    fn arm(&self, marks: &Landmarks, all: &mut Vec<Reading>) -> Option<(DVec3, DVec3)> {
        let (below, lower) = (marks.get("arm_upper_below_left")?, marks.get("arm_lower_below_left")?);
        let (above, lower_above) = (marks.get("arm_upper_above_left")?, marks.get("arm_lower_above_left")?);
        let (from, to) = ((below + above) / 2.0, (lower + lower_above) / 2.0);
        let along = (to - from).try_normalize()?;
        let hand = (marks.get("hand_left")? - from).dot(along);
        let tape = |name, s: f64| Tape { name, origin: from + along * s, normal: along };
        let round = |s: f64| girth(self.mesh, &tape("arm", s));
        let (upper, fullest) = self.best(-0.06 * self.tall, 0.04 * self.tall, round)?;
        let (wrist, thinnest) = self.best(0.45 * hand, 0.8 * hand, |s| round(s).map(|l| -l))?;
        for (name, s, metres) in [("upper arm", upper, fullest), ("wrist", wrist, -thinnest)] {
            all.push(Reading { tape: Some(tape(name, s)), ..Reading::plain(name, metres) });
        }
        let above = (lower_above - lower).reject_from(along).try_normalize()?;
        let ring = ring(self.mesh, from + along * wrist, along)?;
        Some((outermost(&ring, above)?, above))
    }
}

/// Girth of `points` in a horizontal plane, metres.
fn round(points: &[DVec3]) -> f64 {
    hull_perimeter(points.iter().map(|p| DVec2::new(p.x, p.z)).collect())
}

fn out(points: &[DVec3], middle: f64) -> f64 {
    points.iter().map(|p| p.x - middle).fold(f64::MAX, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::body::mannequin;

    #[test]
    fn the_mannequin_reads_as_it_was_built() {
        let figure = mannequin::default();
        let found = readings(&figure.mesh, Some(&figure.landmarks)).expect("a human");
        let m = &figure.measurements;
        for (name, built, share) in [
            ("height", m.height, 0.01),
            ("neck", m.neck, 0.01),
            ("bust", m.bust, 0.01),
            ("waist", m.waist, 0.01),
            ("hip", m.hip, 0.01),
            ("thigh", m.upper_thigh, 0.01),
            // Its own crotch lies where the legs' axes part, a little above where the skin does.
            ("mid thigh", m.mid_thigh, 0.02),
            ("knee", m.knee, 0.01),
            ("calf", m.calf, 0.01),
            // Built at the ankle bone; thinnest a little below.
            ("ankle", m.ankle, 0.015),
            ("upper arm", m.upper_arm, 0.01),
            ("wrist", m.wrist, 0.01),
            ("shoulder width", 2.0 * m.half_across_shoulder, 0.01),
            ("arm length", m.arm_length, 0.01),
        ] {
            let read = found.iter().find(|r| r.name == name).expect(name).metres;
            assert!((read / built - 1.0).abs() < share, "{name}: built {built} m, read {read} m");
        }
    }

    #[test]
    fn shoulders_are_found_where_none_are_given() {
        let figure = mannequin::default();
        let of = |own: Option<&Landmarks>| {
            let found = readings(&figure.mesh, own).expect("a human");
            ["shoulder width", "across back", "arm length"]
                .map(|name| found.iter().find(|r| r.name == name).expect(name).metres)
        };
        let ([width, back, arm], [found_width, found_back, found_arm]) =
            (of(Some(&figure.landmarks)), of(None));
        assert!((0.9..1.0).contains(&(back / width)), "{back} {width}");
        // Straight above the armpits, which lie farther in than its own tips; the arm begins there.
        let armpits = figure.landmarks.get("armpit_left").expect("an armpit").x * 2.0;
        assert!((found_width - armpits).abs() < 0.02, "{found_width} {armpits}");
        assert!(found_width < width && found_back < back, "{found_width} {found_back}");
        assert!((0.0..0.06).contains(&(found_arm - arm)), "{found_arm} {arm}");
    }

    #[test]
    fn the_back_is_followed_up_to_the_nape() {
        let figure = mannequin::default();
        let found = readings(&figure.mesh, Some(&figure.landmarks)).expect("a human");
        let read = |name: &str| found.iter().find(|r| r.name == name).expect(name).metres;
        let [nape, waist, back] = ["nape height", "waist height", "back neck to waist"].map(read);
        let mark = |name: &str| figure.landmarks.get(name).expect(name).y;
        // Below the tape round the neck, above the tips of the shoulders.
        assert!(mark("shoulder_left") < nape && nape < mark("neck_back"), "{nape}");
        // A little longer than straight down.
        assert!((1.0..1.05).contains(&(back / (nape - waist))), "{back} over {}", nape - waist);
    }

    #[test]
    fn the_tape_reads_at_any_height() {
        let figure = mannequin::default();
        let found = readings(&figure.mesh, Some(&figure.landmarks)).expect("a human");
        for name in ["bust", "waist", "hip"] {
            let reading = found.iter().find(|r| r.name == name).expect(name);
            let there = round_at(&figure.mesh, reading.height.expect("a level"), 0.0).expect("a trunk");
            assert!((there.metres - reading.metres).abs() < 1e-9, "{name}: {there:?}");
        }
        assert_eq!(round_at(&figure.mesh, 0.3, 0.0), None, "legs");
    }

    #[test]
    fn a_box_is_no_human() {
        assert!(readings(&TriMesh::default(), None).is_none());
    }
}
