//! Sleeves of a front and a back half: set-in or raglan, with cuffs, turn-ups or neither.

use glam::{DVec2, DVec3};
use serde::Serialize;

use crate::draft::bodice::Trunk;
use crate::draft::form::Form;
use crate::draft::garment::{Facing, Garment, Part};
use crate::draft::path::{Path, cubic_length, solved};
use crate::draft::turn_up::turn_up;
use crate::geometry::ids::PieceId;
use crate::geometry::random::Random;
use crate::pattern::Piece;

/// Distance at which the two halves are placed in front of and behind the middle of the arm, metres.
const BESIDE: f64 = 0.12;
/// Distance along x at which the sleeve is placed outside of the armpit and of the shoulder tip, metres.
const OUT: f64 = 0.02;
/// Gap between a sleeve and its cuff as placed, metres.
const CUFF_GAP: f64 = 0.03;
/// Smallest length of a sleeve below its cap, metres.
const SHORTEST: f64 = 0.04;
/// Bend of a raglan sleeve's upper seam at the shoulder, radians.
const SHOULDER_BEND: f64 = 0.30;

/// Measures of a sleeve, metres.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Sleeve {
    /// Length of its upper seam from the shoulder tip, as a share of the arm's length.
    pub length: f64,
    /// Ease added to the girth of the upper arm.
    pub ease: f64,
    /// Ease added to the girth of the arm at the hem; more than `ease` makes a bell.
    pub hem_ease: f64,
    /// Length of the cap over that of the armhole: above 1 it is gathered.
    pub puff: f64,
    /// Height of a cuff, into which the hem is gathered by `gather`; None: no cuff.
    pub cuff: Option<f64>,
    /// Length of the hem over that of the cuff.
    pub gather: f64,
    /// Height of a turn-up at the hem of a sleeve without cuff; None: there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turn_up: Option<f64>,
}

impl Sleeve {
    /// A sleeve of any length, plain or with cuffs, drawn at random; the cap may be gathered where `may_puff`.
    pub fn drawn(random: &mut Random, may_puff: bool) -> Self {
        let length = random.one_of([0.32, 0.40, 0.52, 0.72, 0.90]) + random.between(-0.03, 0.03);
        let ease = random.between(0.075, 0.13);
        let cuff = (length > 0.6 && random.chance(0.4)).then(|| random.between(0.03, 0.06));
        let bell = random.chance(0.2);
        let hem_ease = if bell { random.between(0.14, 0.20) } else { random.between(0.06, 0.11) };
        let puff = if may_puff && random.chance(0.25) { random.between(1.12, 1.30) } else { 1.0 };
        Self { length, ease, hem_ease, puff, cuff, gather: random.between(1.1, 1.4), turn_up: None }
    }

    /// Girth of the arm at a share of its length from the shoulder, metres.
    fn arm_girth(form: &Form, share: f64) -> f64 {
        let m = &form.measurements;
        let t = ((share - 0.25) / 0.75).clamp(0.0, 1.0);
        m.upper_arm + (m.wrist - m.upper_arm) * t
    }

    /// Girth of the sleeve's hem, metres: at least 24 cm where it is gathered into a cuff.
    fn hem_girth(&self, form: &Form) -> f64 {
        let plain = Self::arm_girth(form, self.length) + self.hem_ease;
        if self.cuff.is_some() { plain.max(0.24) } else { plain }
    }
}

/// Measures of the two halves of a sleeve, metres, in the frame of the arm: u along it from the shoulder tip, v up.
struct Halves {
    /// u of the underarm point.
    cap: f64,
    /// Widths of the front and the back half at the underarm point.
    widths: [f64; 2],
    /// Widths of the front and the back half at the hem.
    hems: [f64; 2],
    /// Length of the upper seam.
    length: f64,
}

impl Halves {
    /// Halves whose caps have the lengths `caps`, metres; `length_of(half, cap, width)` is the length of the cap of a half.
    fn new(cut: &Sleeve, form: &Form, caps: [f64; 2], length_of: impl Fn(usize, f64, f64) -> f64) -> Self {
        // A gathered cap is both wider and higher.
        let girth = (form.measurements.upper_arm + cut.ease) * cut.puff;
        let width =
            |half: usize, cap: f64| solved(0.01, 0.6, |width| length_of(half, cap, width) - caps[half]);
        let most = 0.95 * caps[0].min(caps[1]);
        let cap = solved(0.005, most, |cap| width(0, cap) + width(1, cap) - girth);
        let widths = [0, 1].map(|half| width(half, cap));
        let (hem, apart) = (cut.hem_girth(form) / 2.0, (widths[0] - widths[1]) / 2.0);
        let length = (cut.length * form.measurements.arm_length).max(cap + SHORTEST);
        Self { cap, widths, hems: [hem + apart, hem - apart], length }
    }

    fn underarm(&self, half: usize) -> DVec2 {
        DVec2::new(self.cap, -self.widths[half])
    }

    /// Appends the edges from the underarm point round the lower end to `(length, 0)` on the upper seam.
    fn lower(&self, path: Path, half: usize) -> Path {
        path.line("underarm", DVec2::new(self.length, -self.hems[half]))
            .line("sleeve hem", DVec2::new(self.length, 0.0))
    }

    /// Position (x, y) of the left sleeve's shoulder tip, metres, such that the sleeve is round the arm and clear of the armpit.
    fn stands(&self, form: &Form) -> DVec2 {
        let arm = &form.arm;
        let fall = arm.fall();
        let (along, up) = (DVec2::new(fall.cos(), -fall.sin()), DVec2::new(fall.sin(), fall.cos()));
        let half = (self.widths[0] + self.widths[1]) / 4.0;
        // A sleeve wider than the arm hangs on it: more of it is below the arm.
        let on_arm = arm.joint.truncate() + up * (half - 0.01);
        let underarm = on_arm + along * self.cap - up * (2.0 * half);
        let short = (arm.armpit.x - underarm.x).max(arm.tip.x - on_arm.x);
        on_arm + along * ((short + OUT) / along.x.max(0.3)).max(0.0)
    }
}

/// Control points of a cap from the shoulder tip at the origin down to the underarm point.
fn cap_controls(underarm: DVec2) -> [DVec2; 2] {
    [DVec2::new(0.0, 0.45 * underarm.y), DVec2::new(underarm.x, 0.55 * underarm.y)]
}

/// Drafts both sleeves and sews them into the armholes of `trunk`.
pub fn set_in(garment: &mut Garment, form: &Form, cut: &Sleeve, trunk: &Trunk) {
    let caps = trunk.armhole_lengths.map(|length| length * cut.puff);
    let halves = Halves::new(cut, form, caps, |_, cap, width| {
        let underarm = DVec2::new(cap, -width);
        cubic_length(DVec2::ZERO, cap_controls(underarm), underarm)
    });
    let pieces = [0, 1].map(|half| {
        let underarm = halves.underarm(half);
        let [first, second] = cap_controls(underarm);
        let path = Path::from(DVec2::ZERO).curve("cap", first, second, underarm);
        halves.lower(path, half).closed(NAMES[half], "overarm")
    });
    finish(garment, form, cut, trunk, &halves, pieces);
}

/// Names of the halves of a left sleeve.
const NAMES: [&str; 2] = ["sleeve front left", "sleeve back left"];

/// Drafts both raglan sleeves, which reach up to the neckline, and sews them to `trunk`.
pub fn raglan(garment: &mut Garment, form: &Form, cut: &Sleeve, trunk: &Trunk) {
    // The part of the yoke that belongs to the sleeve, rotated so that the shoulder seam continues into the upper seam.
    let yokes = [0, 1].map(|half| {
        let (neck, tip) = (trunk.yoke.neck[half], trunk.yoke.tip[half]);
        let shoulder = DVec2::from_angle(SHOULDER_BEND) * neck.distance(tip);
        let turn = shoulder.to_angle() - (tip - neck).to_angle();
        let top = trunk.raglan[half] - neck;
        [-shoulder, -shoulder + DVec2::from_angle(turn).rotate(top)]
    });
    let controls = |half: usize, underarm: DVec2| {
        let top = yokes[half][1];
        let along = underarm - top;
        let inward = along.perp().normalize_or_zero();
        [top + along * 0.40 + inward * 0.006, top + along * 0.75 + inward * 0.030]
    };
    let halves = Halves::new(cut, form, trunk.armhole_lengths, |half, cap, width| {
        let underarm = DVec2::new(cap, -width);
        cubic_length(yokes[half][1], controls(half, underarm), underarm)
    });
    let pieces = [0, 1].map(|half| {
        let [neck, top] = yokes[half];
        let underarm = halves.underarm(half);
        let [first, second] = controls(half, underarm);
        let path = Path::from(top).curve("cap", first, second, underarm);
        let past = DVec2::new(halves.length.min(0.06), 0.0);
        let path = halves.lower(path, half).line("overarm", past);
        path.curve("overarm", DVec2::new(-0.01, 0.0), neck * 0.4, neck).closed(NAMES[half], "neck")
    });
    finish(garment, form, cut, trunk, &halves, pieces);
}

/// Places the halves of the left sleeve and their mirror images beside the arms, and sews them.
fn finish(
    garment: &mut Garment,
    form: &Form,
    cut: &Sleeve,
    trunk: &Trunk,
    halves: &Halves,
    pieces: [Piece; 2],
) {
    let at = halves.stands(form);
    let angle = -form.arm.fall();
    let middle = (form.arm.joint.z + form.arm.wrist.z) / 2.0;
    let places = [(Facing::Front, BESIDE), (Facing::Back, -BESIDE)];
    let mut stood = [[PieceId(0); 2]; 2];
    for (half, piece) in pieces.into_iter().enumerate() {
        let (facing, z) = places[half];
        stood[half] = garment.stand_pair(piece, Part::Arm, facing, at.extend(middle + z), angle);
    }
    let cuffs = cut.cuff.map(|height| {
        let lengths = halves.hems.map(|hem| hem / cut.gather);
        // In proportion to the halves of the hem, so that neither is small enough to fold.
        let along = DVec2::from_angle(angle);
        [0, 1].map(|half| {
            let (facing, z) = places[half];
            let down = (halves.hems[half] - lengths[half]) / 2.0;
            let place = at + along * (halves.length + CUFF_GAP) + along.perp() * -down;
            let piece = cuff(["cuff front left", "cuff back left"][half], height, lengths[half]);
            garment.stand_pair(piece, Part::Arm, facing, place.extend(middle + z), angle)
        })
    });
    for (hand, side) in ["left", "right"].into_iter().enumerate() {
        let [front, back] = [stood[0][hand], stood[1][hand]];
        for (half, piece) in [front, back].into_iter().enumerate() {
            let runs = [garment.run(&[piece], "cap", DVec3::Y), trunk.armhole(garment, half, side)];
            garment.sew(&runs[0], &runs[1]);
        }
        garment.sew_alike(&[front], &[back], &["overarm", "underarm"], DVec3::X);
        if let Some(cuffs) = &cuffs {
            let [cuff_front, cuff_back] = [cuffs[0][hand], cuffs[1][hand]];
            for (sleeve, cuff) in [(front, cuff_front), (back, cuff_back)] {
                let runs = [
                    garment.run(&[sleeve], "sleeve hem", DVec3::Y),
                    garment.run(&[cuff], "cuff top", DVec3::Y),
                ];
                garment.sew(&runs[0], &runs[1]);
            }
            garment.sew_alike(&[cuff_front], &[cuff_back], &["overarm", "underarm"], DVec3::X);
        } else if let Some(height) = cut.turn_up {
            turn_up(garment, height, [front, back], "sleeve hem", ["overarm", "underarm"]);
        }
    }
}

/// Half a cuff: `height` metres wide along the arm and `length` metres round it.
fn cuff(name: &str, height: f64, length: f64) -> Piece {
    Path::from(DVec2::ZERO)
        .line("cuff top", DVec2::new(0.0, -length))
        .line("underarm", DVec2::new(height, -length))
        .line("cuff hem", DVec2::new(height, 0.0))
        .closed(name, "overarm")
}
