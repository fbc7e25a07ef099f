//! Bodices: front and back of the trunk, boxy or fitted by darts, whole or seamed down the middle.

use glam::{DVec2, DVec3};
use serde::Serialize;

use crate::draft::form::{Form, Yoke};
use crate::draft::garment::{Facing, Garment, Part, Run};
use crate::draft::neckline::Neckline;
use crate::draft::path::{Dart, Path, cubic_length, to_the_right};
use crate::geometry::ids::PieceId;
use crate::geometry::random::Random;
use crate::pattern::{Button, Piece, PiecePoint};

/// Width moved from each quarter of the back to the front, metres: the bust takes more of the girth in front.
const FRONT_SHARE: f64 = 0.008;
/// Distance at which pieces are placed in front of and behind the skin, metres.
pub const CLEARANCE: f64 = 0.12;
/// Distance from the armpit down to the underarm point of a bodice with set-in sleeves or none, metres.
const UNDERARM_DROP: f64 = 0.030;
/// Layer of the outer half of a front that opens, and of its collar.
pub const OUTER: u8 = 1;
/// Distance at which one half of a front that opens is placed before the other, metres.
pub const OVERLAP: f64 = 0.06;

/// Length of a bodice: where its hem is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Hem {
    /// At the waist, to be sewn to a skirt or trousers, or left free.
    Waist,
    /// At the hip.
    Hip,
    /// A third of the way from hip to knee.
    Tunic,
    /// Below the knee.
    Coat,
}

/// An opening from the neckline to the hem down the middle of the front, closed by buttons.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Opening {
    /// Distance by which each half reaches over the middle, metres.
    pub stand: f64,
    /// Number of buttons, from the neckline to the hip.
    pub buttons: u32,
    /// Diameter of the buttons, metres.
    pub diameter: f64,
    /// Colour of the buttons, sRGB.
    pub colour: [u8; 3],
}

/// Measures of a bodice, metres.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Bodice {
    pub hem: Hem,
    /// Ease added to the bust girth.
    pub bust_ease: f64,
    /// Ease added to the girth at the hem (at the waist: of the waist after darts).
    pub hem_ease: f64,
    /// Width of the waist dart of each quarter; only where the hem is at the waist.
    pub waist_dart: f64,
    /// Whether a dart in the front's side seam takes the extra length over the bust.
    pub bust_dart: bool,
    /// Whether the front and the back have a centre seam.
    pub centre_seams: [bool; 2],
    /// Extra length below the waist line, for a hem at the waist.
    pub blouse: f64,
    /// Difference between the length of the shoulder and that of its seam: armholes without sleeves are further in.
    pub short_shoulder: f64,
    /// An opening in the front, which then has two halves.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub opening: Option<Opening>,
}

impl Bodice {
    /// A straight or widening bodice without darts, drawn at random.
    pub fn boxy(random: &mut Random, hem: Hem) -> Self {
        let bust_ease = random.between(0.08, 0.20);
        Self {
            hem,
            bust_ease,
            hem_ease: random.between(0.06, 0.16),
            waist_dart: 0.0,
            bust_dart: false,
            centre_seams: [random.chance(0.25), random.chance(0.3)],
            blouse: 0.0,
            short_shoulder: 0.0,
            opening: None,
        }
    }

    /// A bodice down to the waist with darts, drawn at random.
    pub fn fitted(random: &mut Random) -> Self {
        Self {
            hem: Hem::Waist,
            bust_ease: random.between(0.05, 0.09),
            hem_ease: random.between(0.035, 0.06),
            waist_dart: random.between(0.018, 0.032),
            bust_dart: random.chance(0.6),
            centre_seams: [random.chance(0.3), random.chance(0.4)],
            blouse: 0.0,
            short_shoulder: 0.0,
            opening: None,
        }
    }

    /// Distance of the hem below the bust line, metres.
    fn length(&self, form: &Form) -> f64 {
        match self.hem {
            Hem::Waist => form.bust - form.waist + self.blouse,
            Hem::Hip => form.bust - form.hip + 0.01,
            Hem::Tunic => form.bust - form.hip + (form.hip - form.knee) / 3.0,
            Hem::Coat => form.bust - form.knee + 0.12 * (form.knee - form.ankle),
        }
    }

    /// Half the width of the front or back at the hem after darts, metres.
    fn hem_quarter(&self, form: &Form) -> f64 {
        let m = &form.measurements;
        let girth = match self.hem {
            Hem::Waist => m.waist,
            Hem::Hip => m.hip,
            Hem::Tunic | Hem::Coat => m.hip + 0.04,
        };
        (girth + self.hem_ease) / 4.0
    }
}

/// Kind of armhole.
#[derive(Clone, Copy, Debug)]
pub enum Armhole {
    /// An armhole for a set-in sleeve, or for none.
    SetIn,
    /// A raglan line up to the neckline.
    Raglan,
}

/// Front and back of a bodice, with the edges to which more is sewn.
pub struct Trunk {
    /// Pieces of the front and of the back: one each, or a left and a right one.
    pub sides: [Vec<PieceId>; 2],
    /// Lengths of one armhole in the front and in the back, metres.
    pub armhole_lengths: [f64; 2],
    /// The yoke it was drafted with.
    pub yoke: Yoke,
    /// Height of the hem of front and back as placed, metres.
    pub hem_height: [f64; 2],
    /// End points of the raglan line on front and back, in the plane of the piece, metres.
    pub raglan: [DVec2; 2],
    /// Whether the front opens down its middle.
    pub opens: bool,
}

impl Trunk {
    /// The waist or hem edges, from the right of the body to the left.
    pub fn hem(&self, garment: &Garment, side: usize) -> Run {
        garment.run(&self.sides[side], "hem", DVec3::X)
    }

    /// The neckline edges, from the right of the body to the left.
    pub fn neckline(&self, garment: &Garment, side: usize) -> Run {
        garment.run(&self.sides[side], "neck", DVec3::X)
    }

    /// The armhole edges of the `hand` ("left" or "right"), from below upwards.
    pub fn armhole(&self, garment: &Garment, side: usize, hand: &str) -> Run {
        garment.run(&self.sides[side], &format!("armhole {hand}"), DVec3::Y)
    }
}

/// End of the raglan line on the neckline, relative to the neck end of the shoulder seam, in front and at the back, metres.
const RAGLAN_NECK: [DVec2; 2] = [DVec2::new(-0.010, -0.038), DVec2::new(-0.026, -0.010)];

/// Drafts front and back, places them round the body and sews shoulders, sides, centre seams and darts.
pub fn bodice(garment: &mut Garment, form: &Form, cut: &Bodice, neck: &Neckline, armhole: Armhole) -> Trunk {
    let yoke = form.yoke(form.neck_width(neck.width), cut.short_shoulder);
    let hem = -cut.length(form);
    let under = form.armpit.y - UNDERARM_DROP - form.bust;
    let bust_dart = if cut.bust_dart { dart_intake(&yoke) } else { 0.0 };
    let mut lengths = [0.0; 2];
    let mut raglan = [DVec2::ZERO; 2];
    let mut paths = Vec::new();
    let mut side_length: Option<f64> = None;
    for side in 0..2 {
        let wider = if side == 0 { FRONT_SHARE } else { -FRONT_SHARE };
        let quarter = (form.measurements.bust + cut.bust_ease) / 4.0 + wider;
        let raised = if side == 0 { bust_dart } else { 0.0 };
        let hem_end = DVec2::new(cut.hem_quarter(form) + cut.waist_dart, hem);
        // Both edges of the side seam have the length of the front's without its dart.
        let rise = match side_length {
            None => under + raised - hem,
            Some(length) => (length * length - (quarter - hem_end.x).powi(2)).sqrt(),
        };
        let underarm = DVec2::new(quarter, hem + rise);
        side_length = Some(underarm.distance(hem_end) - raised);
        let stand = if side == 0 { cut.opening.map_or(0.0, |opening| opening.stand) } else { 0.0 };
        // A difference, so that no opening is 0 and not -0.
        let mut path = Path::from(DVec2::new(0.0 - stand, hem));
        path = match cut.waist_dart > 0.0 {
            true => {
                let depth = (0.72 * -hem).min(if side == 0 { -hem - 0.025 } else { -hem });
                let at = form.bust_point.x.min(0.5 * hem_end.x);
                path.darted("hem", hem_end, Dart { at, width: cut.waist_dart, depth })
            }
            false => path.line("hem", hem_end),
        };
        path = match raised > 0.0 {
            true => {
                let length = hem_end.distance(underarm);
                let at = length - (under + raised / 2.0 + 0.012).max(0.06);
                let depth = (underarm.x - form.bust_point.x - 0.025).max(0.03);
                path.darted("side", underarm, Dart { at, width: raised, depth })
            }
            false => path.line("side", underarm),
        };
        let tip = yoke.tip[side];
        let corner = yoke.neck[side];
        path = match armhole {
            Armhole::SetIn => {
                let depth = tip.y - underarm.y;
                let chest = tip.x - 0.020 + wider;
                let first = DVec2::new(chest + 0.006, underarm.y);
                let second = DVec2::new(chest, tip.y - 0.45 * depth);
                lengths[side] = cubic_length(underarm, [first, second], tip);
                path.curve("armhole", first, second, tip).line("shoulder", corner)
            }
            Armhole::Raglan => {
                let top = corner + RAGLAN_NECK[side];
                raglan[side] = top;
                let controls = raglan_controls(underarm, top);
                lengths[side] = cubic_length(underarm, controls, top);
                path.curve("armhole", controls[0], controls[1], top)
            }
        };
        let low = DVec2::new(0.0, corner.y - neck.drops[side]);
        let path = neck.drawn_down_to(path, side, low);
        paths.push(if stand > 0.0 { path.line("stand", low - DVec2::X * stand) } else { path });
    }
    let placed = [0, 1].map(|side| placed_height(form, &yoke, side));
    let mut sides = [Vec::new(), Vec::new()];
    for (side, path) in paths.into_iter().enumerate() {
        sides[side] = match cut.opening.filter(|_| side == 0) {
            Some(opening) => opened(garment, form, path, &opening, placed[side]),
            None => stand_side(garment, form, path, side, cut.centre_seams[side], placed[side]),
        };
    }
    let [front, back] = &sides;
    sew_trunk(garment, front, back);
    let hem_height = placed.map(|bust| bust + hem);
    Trunk { sides, armhole_lengths: lengths, yoke, hem_height, raglan, opens: cut.opening.is_some() }
}

/// Sews shoulders, sides, centre seams and darts of a trunk.
pub fn sew_trunk(garment: &mut Garment, front: &[PieceId], back: &[PieceId]) {
    garment.sew_darts(front);
    garment.sew_darts(back);
    garment.sew_alike(front, back, &["shoulder left", "shoulder right"], DVec3::X);
    garment.sew_alike(front, back, &["side left", "side right"], DVec3::Y);
    for pieces in [front, back] {
        if let [left, right] = pieces {
            garment.sew_alike(&[*left], &[*right], &["centre"], DVec3::Y);
        }
    }
}

/// Places the front (0) or back (1), drawn with the bust line at y = 0, whole or in two halves.
pub fn stand_side(
    garment: &mut Garment,
    form: &Form,
    half: Path,
    side: usize,
    in_halves: bool,
    height: f64,
) -> Vec<PieceId> {
    let (name, facing) = [("front", Facing::Front), ("back", Facing::Back)][side];
    let z = form.depth[side] + [CLEARANCE, -CLEARANCE][side];
    let at = DVec3::new(0.0, height, z);
    if !in_halves {
        return vec![garment.stand(half.whole(name), Part::Body, facing, at)];
    }
    let left = half.half(&format!("{name} left"), "centre");
    let right = to_the_right(&left);
    [left, right].map(|piece| garment.stand(piece, Part::Body, facing, at)).into()
}

/// Places both halves of a front that opens, the right one over the left one, and sews its buttons on.
fn opened(garment: &mut Garment, form: &Form, left: Path, opening: &Opening, height: f64) -> Vec<PieceId> {
    let neck = left.end().y;
    let left = left.half("front left", "front edge");
    // Suggested marks do not tell which half is outside: with a layer of its own the coat is sewn from where it is placed.
    let right = Piece { layer: OUTER, ..to_the_right(&left) };
    let z = form.depth[0] + CLEARANCE;
    let halves = [(left, 0.0), (right, OVERLAP)].map(|(piece, over)| {
        garment.stand(piece, Part::Body, Facing::Front, DVec3::new(0.0, height, z + over))
    });
    let (top, low) = (neck - opening.stand, form.hip - form.bust);
    let gaps = f64::from(opening.buttons.max(2) - 1);
    for i in 0..opening.buttons {
        let at = DVec2::new(0.0, top + (low - top) * f64::from(i) / gaps);
        let [button, hole] = halves.map(|piece| PiecePoint { piece, at });
        garment.pattern.add_button(Button {
            button,
            hole,
            diameter: opening.diameter,
            colour: opening.colour,
            open: false,
            tack: false,
        });
    }
    halves.into()
}

/// Height at which the bust line of front or back is placed so that the shoulder seam is on the shoulder, metres.
pub fn placed_height(form: &Form, yoke: &Yoke, side: usize) -> f64 {
    let middle = (yoke.neck[side] + yoke.tip[side]) / 2.0;
    form.shoulder_at(middle.x).y + 0.01 - middle.y
}

/// Width of a bust dart, metres: how much longer the front is than the back, within what can be sewn flat.
fn dart_intake(yoke: &Yoke) -> f64 {
    (yoke.neck[0].y - yoke.neck[1].y).clamp(0.012, 0.035)
}

/// Controls of the raglan line from the underarm point up to the neckline.
fn raglan_controls(underarm: DVec2, top: DVec2) -> [DVec2; 2] {
    let along = top - underarm;
    let inward = along.perp().normalize_or_zero();
    [underarm + along * 0.25 + inward * 0.030, underarm + along * 0.60 + inward * 0.006]
}
