//! Straight trousers: two fronts, two backs, on a waistband.

use glam::DVec2;

use super::draft::{Outline, edge_length, mirrored, sew, sheet};
use super::form::Form;
use super::skirt::{band, band_strokes, face, sew_bands};
use super::strokes::Strokes;
use crate::geometry::ids::PieceId;
use crate::pattern::{Pattern, Piece};
use crate::wrap::Marks;

/// Ease added to the waist girth, metres.
const WAIST_EASE: f64 = 0.03;
/// Ease added to the hip girth, metres.
const HIP_EASE: f64 = 0.075;
/// Ease added to the girth of the knee, metres.
const KNEE_EASE: f64 = 0.085;
/// Girth of the leg at the hem minus the girth of the ankle, metres.
const HEM_EASE: f64 = 0.14;
/// Height of the hem above the ankle bone, metres: clear of the foot.
const HEM_HEIGHT: f64 = 0.07;
/// Ease added to the depth of the crotch, metres.
const CROTCH_EASE: f64 = 0.03;
/// Width moved from each front to each back, metres.
const BACK_SHARE: f64 = 0.018;

/// Depths below the waist, and shares of girths, that front and back have in common, metres.
struct Block {
    hip: f64,
    crotch: f64,
    knee: f64,
    hem: f64,
    waist_quarter: f64,
    hip_quarter: f64,
    knee_half: f64,
    hem_half: f64,
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
    /// Width added to the leg and the hip.
    wider: f64,
}

impl Block {
    fn new(form: &Form) -> Self {
        let m = &form.body.measurements;
        let waist = form.mark("waist_front").y;
        Self {
            hip: waist - form.mark("hip_front").y,
            crotch: waist - form.mark("crotch").y + CROTCH_EASE,
            knee: waist - form.mark("knee_left").y,
            hem: waist - form.mark("ankle_left").y - HEM_HEIGHT,
            waist_quarter: (m.waist + WAIST_EASE) / 4.0,
            hip_quarter: (m.hip + HIP_EASE) / 4.0,
            knee_half: (m.knee + KNEE_EASE) / 2.0,
            hem_half: (m.ankle + HEM_EASE) / 2.0,
        }
    }

    /// Half of the trousers' front or back, seen from outside: the body's middle at x = 0, the side at +x, the waist at y = 0.
    /// `drop` lowers the crotch point.
    fn leg(&self, name: &str, cut: &Cut, drop: f64) -> Piece {
        let at = |x: f64, below: f64| DVec2::new(x, -below);
        let towards = |from: DVec2, to: DVec2, t: f64| from + (to - from) * t;
        let hip_width = self.hip_quarter + cut.wider;
        let waist_width = cut.lean + self.waist_quarter + cut.dart[0];
        let crease = (hip_width - cut.fork) / 2.0 + 0.004;
        let [knee, hem] = [self.knee_half, self.hem_half].map(|w| (w + 1.5 * cut.wider) / 2.0);
        let (middle_top, side_top) = (at(cut.lean, -cut.rise), at(waist_width, 0.002));
        let (hip_side, fork) = (at(hip_width, self.hip), at(-cut.fork, self.crotch + drop));
        let middle_hip = at(0.0, self.hip + 0.40 * (self.crotch - self.hip));
        let [knee_side, knee_in] = [crease + knee, crease - knee].map(|x| at(x, self.knee));
        let [hem_side, hem_in] = [crease + hem, crease - hem].map(|x| at(x, self.hem));
        let along = side_top - middle_top;
        let dart = middle_top + along * 0.46;
        let half = along.normalize() * (cut.dart[0] / 2.0);
        let tip = dart - along.perp().normalize() * cut.dart[1];
        let thigh = self.knee - self.hip;
        Outline::from(hem_side)
            .line("out lower", knee_side)
            .curve(
                "out middle",
                towards(knee_side, hem_side, -0.35),
                at(hip_width, self.hip + 0.35 * thigh),
                hip_side,
            )
            .curve(
                "out upper",
                at(hip_width, 0.62 * self.hip),
                at(waist_width + 0.35 * (hip_width - waist_width), 0.25 * self.hip),
                side_top,
            )
            .line("waist outer", dart + half)
            .line("dart outer", tip)
            .line("dart inner", dart - half)
            .line("waist inner", middle_top)
            .line("middle", middle_hip)
            .curve(
                "fork",
                towards(middle_hip, middle_top, -0.28),
                at(-0.40 * cut.fork, self.crotch + 0.6 * drop),
                fork,
            )
            .curve(
                "in upper",
                at(-0.55 * cut.fork, self.crotch + 0.30 * (self.knee - self.crotch)),
                towards(knee_in, hem_in, -0.45),
                knee_in,
            )
            .line("in lower", hem_in)
            .line("hem", hem_side)
            .piece(name)
    }
}

/// Pattern and marks of the trousers.
pub fn trousers(form: &Form) -> (Pattern, Marks) {
    let block = Block::new(form);
    let front = Cut { fork: 0.042, lean: 0.010, rise: 0.0, dart: [0.018, 0.09], wider: -BACK_SHARE };
    let back = Cut { fork: 0.108, lean: 0.028, rise: 0.036, dart: [0.026, 0.12], wider: BACK_SHARE };
    let mut front_left = block.leg("front left", &front, 0.0);
    // The crotch point of the back is lowered until both inner seams have the same length.
    let inner = edge_length(&front_left, "in upper");
    let drop =
        (0..40).fold(0.0, |drop, _| drop + edge_length(&block.leg("", &back, drop), "in upper") - inner);
    let mut back_right = block.leg("back right", &back, drop);
    let y = form.mark("waist_front").y;
    face(&mut front_left, &mut back_right, y);
    let (front_right, back_left) = (mirrored(&front_left, "front right"), mirrored(&back_right, "back left"));
    let waist = |piece: &Piece| ["waist outer", "waist inner"].map(|label| edge_length(piece, label));
    let ([fo, fi], [bo, bi]) = (waist(&front_left), waist(&back_right));
    let mut front_band = band("waistband front", &[fo, fi, fi, fo]);
    let mut back_band = band("waistband back", &[bo, bi, bi, bo]);
    face(&mut front_band, &mut back_band, y);
    let total = 2.0 * (fo + fi + bo + bi);
    let mut pattern = Pattern::default();
    let rows = vec![vec![front_band, back_band], vec![front_right, front_left, back_left, back_right]];
    let ids: Vec<_> = sheet(rows).into_iter().map(|piece| pattern.add_piece(piece)).collect();
    let [front_band, back_band, front_right, front_left, back_left, back_right] = ids[..] else {
        unreachable!("six pieces were laid")
    };
    for piece in [front_right, front_left, back_left, back_right] {
        sew(&mut pattern, (piece, "dart inner"), (piece, "dart outer"));
    }
    for (one, other) in [(front_left, front_right), (back_left, back_right)] {
        for label in ["middle", "fork"] {
            sew(&mut pattern, (one, label), (other, label));
        }
    }
    for (front, back) in [(front_left, back_left), (front_right, back_right)] {
        for label in ["out upper", "out middle", "out lower", "in upper", "in lower"] {
            sew(&mut pattern, (front, label), (back, label));
        }
    }
    let edges = |pieces: [PieceId; 2]| {
        let named = |piece: PieceId, label: &str| (piece, label.to_owned());
        let [a, b] = pieces;
        [named(a, "waist outer"), named(a, "waist inner"), named(b, "waist inner"), named(b, "waist outer")]
    };
    sew_bands(
        &mut pattern,
        [front_band, back_band],
        [&edges([front_right, front_left]), &edges([back_left, back_right])],
    );
    let mut strokes = Strokes::default();
    band_strokes(form, front_band, back_band, total, &mut strokes);
    (pattern, strokes.finish())
}
