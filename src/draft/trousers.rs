//! Trousers and shorts: two fronts and two backs, with a dart in each.

use glam::{DVec2, DVec3};
use serde::Serialize;

use crate::draft::form::Form;
use crate::draft::garment::{Facing, Garment, Part, Run, UPWARDS};
use crate::draft::path::{Dart, Path, solved};
use crate::draft::skirt::CLEARANCE;
use crate::draft::turn_up::turn_up;
use crate::geometry::ids::PieceId;
use crate::geometry::random::Random;
use crate::pattern::Piece;

/// Gap between left and right half at the fork as placed, metres.
const APART: f64 = 0.01;
/// Width moved from each front to each back, metres.
const BACK_SHARE: f64 = 0.016;

/// Measures of trousers, metres.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Trousers {
    /// Level of the hem: 0 at the crotch, 1 at the knee, 2 at the ankle bone.
    pub length: f64,
    /// Ease added to the hip girth.
    pub hip_ease: f64,
    /// Ease added to the depth of the crotch below the waist.
    pub crotch_ease: f64,
    /// Ease added to the girth of the knee, where the legs reach it.
    pub knee_ease: f64,
    /// Ease added to the girth of the leg at the hem.
    pub hem_ease: f64,
    /// Height of turn-ups at the hems; None: there are none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turn_up: Option<f64>,
}

impl Trousers {
    /// Trousers down to the calf or ankle: narrow, straight, wide or flared, drawn at random.
    pub fn long(random: &mut Random) -> Self {
        let [knee_ease, hem_ease] = random.one_of([[0.07, 0.09], [0.09, 0.16], [0.18, 0.30], [0.09, 0.28]]);
        Self {
            length: random.one_of([1.5, 1.8, 1.86]),
            hip_ease: random.between(0.05, 0.10),
            crotch_ease: random.between(0.025, 0.045),
            knee_ease: knee_ease + random.between(0.0, 0.03),
            hem_ease: hem_ease + random.between(0.0, 0.03),
            turn_up: None,
        }
    }

    /// Shorts that end above the knee, drawn at random.
    pub fn shorts(random: &mut Random) -> Self {
        Self {
            length: random.between(0.35, 0.85),
            hip_ease: random.between(0.05, 0.11),
            crotch_ease: random.between(0.025, 0.045),
            knee_ease: 0.0,
            hem_ease: random.between(0.06, 0.14),
            turn_up: None,
        }
    }
}

/// Depths below the waist, and shares of girths, that front and back have in common; metres.
struct Block {
    hip: f64,
    crotch: f64,
    knee: Option<[f64; 2]>,
    hem: [f64; 2],
    waist_quarter: f64,
    hip_quarter: f64,
}

/// Measures in which front and back differ, metres.
struct Cut {
    /// Distance from the middle line out to the point between the legs.
    fork: f64,
    /// Distance by which the middle seam leans in at the waist.
    lean: f64,
    /// Extra height of the waist at the middle.
    rise: f64,
    /// Width and length of the dart.
    dart: [f64; 2],
    /// Width added to half widths of the leg and the hip.
    wider: f64,
    /// Extra depth of the fork.
    drop: f64,
    /// Height of the side's upper end above the waist.
    side: f64,
}

/// Girth of the leg at a level (0 crotch, 1 knee, 2 ankle), metres, interpolated between the body's measurements.
fn leg_girth(form: &Form, level: f64) -> f64 {
    let m = &form.measurements;
    let knots = [(0.0, m.upper_thigh), (0.5, m.mid_thigh), (1.0, m.knee), (1.4, m.calf), (2.0, m.ankle)];
    let between = knots.windows(2).find(|w| level <= w[1].0).unwrap_or(&knots[3..]);
    let t = ((level - between[0].0) / (between[1].0 - between[0].0)).clamp(0.0, 1.0);
    between[0].1 + (between[1].1 - between[0].1) * t
}

impl Block {
    fn new(form: &Form, cut: &Trousers, girth: f64) -> Self {
        let m = &form.measurements;
        let height = |level: f64| match level > 1.0 {
            true => form.knee + (form.ankle - form.knee) * (level - 1.0),
            false => form.crotch + (form.knee - form.crotch) * level,
        };
        let hem = [form.waist - height(cut.length), (leg_girth(form, cut.length) + cut.hem_ease) / 2.0];
        let knee = [form.waist - form.knee, (m.knee + cut.knee_ease) / 2.0];
        Self {
            hip: form.waist - form.hip,
            crotch: form.waist - form.crotch + cut.crotch_ease,
            knee: (cut.length > 1.25).then_some(knee),
            hem,
            waist_quarter: girth / 4.0,
            hip_quarter: (m.hip + cut.hip_ease) / 4.0,
        }
    }

    /// The left front or back, with the body's middle at x = 0, the side at +x and the waist at y = 0.
    fn leg(&self, name: &str, cut: &Cut) -> Piece {
        let at = |x: f64, below: f64| DVec2::new(x, -below);
        let hip_width = self.hip_quarter + cut.wider;
        let crease = (hip_width - cut.fork) / 2.0 + 0.004;
        let with_dart = self.waist_quarter + cut.dart[0];
        let climb = cut.rise - cut.side;
        let middle_top = DVec2::new(cut.lean, cut.rise);
        let side_top = DVec2::new(cut.lean + (with_dart * with_dart - climb * climb).sqrt(), cut.side);
        let hip_side = at(hip_width, self.hip);
        let fork = at(-cut.fork, self.crotch + cut.drop);
        let middle_hip = at(0.0, self.hip + 0.40 * (self.crotch - self.hip));
        let ends = |[below, half]: [f64; 2]| {
            let half = (half + 1.5 * cut.wider) / 2.0;
            [at(crease + half, below), at(crease - half, below)]
        };
        let [hem_side, hem_in] = ends(self.hem);
        let mut path = Path::from(hem_side);
        let (below_hip, below_side) = match self.knee {
            Some(knee) => {
                let [knee_side, _] = ends(knee);
                path = path.line("out", knee_side);
                (knee[0], knee_side + (knee_side - hem_side) * 0.35)
            }
            None => (self.hem[0], hem_side + (hip_side - hem_side) * 0.3),
        };
        let thigh = below_hip - self.hip;
        path = path
            .curve("out", below_side, at(hip_width, self.hip + 0.35 * thigh), hip_side)
            .curve(
                "out",
                at(hip_width, 0.62 * self.hip),
                at(side_top.x + 0.35 * (hip_width - side_top.x), 0.25 * self.hip),
                side_top,
            )
            .darted(
                "waist",
                middle_top,
                Dart { at: 0.54 * with_dart, width: cut.dart[0], depth: cut.dart[1] },
            )
            .line("middle", middle_hip)
            .curve(
                "middle",
                middle_hip + (middle_hip - middle_top) * 0.28,
                at(-0.40 * cut.fork, self.crotch + 0.6 * cut.drop),
                fork,
            );
        path = match self.knee {
            Some(knee) => {
                let [_, knee_in] = ends(knee);
                let first = at(-0.55 * cut.fork, self.crotch + 0.30 * (knee[0] - self.crotch));
                path.curve("in", first, knee_in + (knee_in - hem_in) * 0.45, knee_in).line("in", hem_in)
            }
            None => path.line("in", hem_in),
        };
        path.closed(name, "hem")
    }
}

/// Total length of all edges of `piece` called `label`, metres.
fn length(piece: &Piece, label: &str) -> f64 {
    let own = (0..piece.outline.len()).filter(|&i| piece.outline[i].label.as_deref() == Some(label));
    own.map(|i| piece.exact_edge_length(i)).sum()
}

/// Drafts trousers for a finished waist `girth` metres round, places them with their waist `level` metres above the ground and
/// sews them. Returns their upper edges in front and at the back, from the right of the body to the left.
pub fn trousers(garment: &mut Garment, form: &Form, cut: &Trousers, girth: f64, level: f64) -> [Run; 2] {
    let block = Block::new(form, cut, girth);
    let larger = form.measurements.hip / 0.98;
    let front = Cut {
        fork: 0.042 * larger,
        lean: 0.010,
        rise: 0.0,
        dart: [0.024, 0.09],
        wider: -BACK_SHARE,
        drop: 0.0,
        side: 0.004,
    };
    let back = |drop: f64, side: f64| Cut {
        fork: 0.105 * larger,
        lean: 0.028,
        rise: 0.034,
        dart: [0.034, 0.12],
        wider: BACK_SHARE,
        drop,
        side,
    };
    let front_left = block.leg("trousers front left", &front);
    let [inner, outer] = ["in", "out"].map(|label| length(&front_left, label));
    let name = "trousers back left";
    // The back's fork and side are moved until both its seams have the lengths of the front's.
    let drop = solved(-0.03, 0.08, |drop| length(&block.leg(name, &back(drop, 0.0)), "in") - inner);
    let side = solved(-0.03, 0.03, |side| length(&block.leg(name, &back(drop, side)), "out") - outer);
    let back_left = block.leg(name, &back(drop, side));
    let mut pairs = [[PieceId(0); 2]; 2];
    for (half, (piece, fork)) in
        [(front_left, front.fork), (back_left, 0.105 * larger)].into_iter().enumerate()
    {
        let z = form.hip_depth[half] + [CLEARANCE, -CLEARANCE][half];
        let at = DVec3::new(fork + APART / 2.0, level, z);
        pairs[half] = garment.stand_pair(piece, Part::Leg, [Facing::Front, Facing::Back][half], at, 0.0);
    }
    let [front, back] = pairs;
    for pieces in [&front, &back] {
        garment.sew_darts(pieces);
        garment.sew_alike(&pieces[..1], &pieces[1..], &["middle"], UPWARDS);
    }
    for hand in 0..2 {
        garment.sew_alike(&front[hand..=hand], &back[hand..=hand], &["out", "in"], UPWARDS);
        if let Some(height) = cut.turn_up {
            turn_up(garment, height, [front[hand], back[hand]], "hem", ["out", "in"]);
        }
    }
    pairs.map(|pieces| garment.run(&pieces, "waist", DVec3::X))
}
