//! Skirts: straight with darts, flared, circular, gathered, with godets, in tiers.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use glam::{DQuat, DVec2, DVec3};
use serde::Serialize;

use crate::draft::form::Form;
use crate::draft::garment::{Facing, Garment, Part, Run, UPWARDS};
use crate::draft::path::{Dart, Path, to_the_right};
use crate::geometry::ids::PieceId;
use crate::geometry::random::Random;
use crate::pattern::Piece;

/// Distance at which panels are placed in front of and behind the skin of the hip, metres.
pub const CLEARANCE: f64 = 0.12;
/// Gap between tiers as placed, metres.
const LEVEL_GAP: f64 = 0.01;
/// Distance at which godets are placed beside the lower side seams, metres.
const GODET_OUT: f64 = 0.08;

/// Shape of a skirt; metres.
#[derive(Clone, Copy, Debug, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// Fitted by a dart in each quarter; the side seams may end in slits of length `slit`.
    Straight { ease: f64, dart: f64, slit: f64 },
    /// Straight sides that clear the hip by `ease`; the hem slants by `slant` from left to right.
    Flared { ease: f64, slant: f64 },
    /// A ring sector of this share of a full circle.
    Circle { share: f64 },
    /// Rectangles gathered into the waist by this ratio.
    Gathered { ratio: f64 },
    /// Flared, with godets (wedges) in the lower side seams, and in the middle of front and back where `middles`.
    Godets { ease: f64, depth: f64, angle: f64, middles: bool },
    /// Tiers: strips, each longer than the one above by this ratio and gathered to it.
    Levels { ratio: f64, count: u32 },
}

/// Measures of a skirt.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Skirt {
    pub shape: Shape,
    /// Length from the waist down, as a share of the waist's height above the ground.
    pub length: f64,
}

impl Skirt {
    /// A straight skirt with darts, drawn at random.
    pub fn straight(random: &mut Random) -> Self {
        let length = random.between(0.45, 0.66);
        let slit = if random.chance(0.4) { random.between(0.10, 0.22) } else { 0.0 };
        let shape =
            Shape::Straight { ease: random.between(0.04, 0.08), dart: random.between(0.018, 0.028), slit };
        Self { shape, length }
    }

    /// A flared skirt with a level or slanting hem, drawn at random.
    pub fn flared(random: &mut Random) -> Self {
        let slant = if random.chance(0.3) { random.between(0.08, 0.20) } else { 0.0 };
        let shape = Shape::Flared { ease: random.between(0.05, 0.16), slant };
        Self { shape, length: random.between(0.40, 0.72) }
    }

    /// A circle skirt from 0.4 of a circle to a whole one, drawn at random.
    pub fn circle(random: &mut Random) -> Self {
        let share = random.one_of([0.4, 0.5, 0.5, 0.75, 1.0]);
        Self { shape: Shape::Circle { share }, length: random.between(0.38, 0.60) }
    }

    /// A skirt gathered at the waist, drawn at random.
    pub fn gathered(random: &mut Random) -> Self {
        let shape = Shape::Gathered { ratio: random.between(1.45, 1.9) };
        Self { shape, length: random.between(0.40, 0.70) }
    }

    /// A skirt with two or four godets, drawn at random.
    pub fn godets(random: &mut Random) -> Self {
        let shape = Shape::Godets {
            ease: random.between(0.05, 0.10),
            depth: random.between(0.40, 0.60),
            angle: random.between(0.30, 0.60),
            middles: random.chance(0.5),
        };
        Self { shape, length: random.between(0.50, 0.70) }
    }

    /// A skirt of two or three tiers, drawn at random.
    pub fn levels(random: &mut Random) -> Self {
        let shape = Shape::Levels { ratio: random.between(1.25, 1.5), count: random.one_of([2, 3]) };
        Self { shape, length: random.between(0.45, 0.72) }
    }

    /// A skirt of any shape, drawn at random.
    pub fn any(random: &mut Random) -> Self {
        let make = random.one_of([
            Self::straight,
            Self::flared,
            Self::flared,
            Self::circle,
            Self::gathered,
            Self::godets,
            Self::levels,
        ]);
        make(random)
    }
}

/// Measures that a skirt is drafted to, metres.
#[derive(Clone, Copy, Debug)]
struct Frame {
    /// Quarter of the finished waist girth.
    waist: f64,
    /// Distance from the waist down to the hip.
    hip_depth: f64,
    /// Quarter of the body's hip girth.
    hip: f64,
    length: f64,
    /// Height of the waist as placed.
    level: f64,
}

/// Drafts front and back for a finished waist `girth` metres round, places them with their waist `level` metres above the ground
/// and sews sides and darts. Returns their upper edges, from the right of the body to the left.
pub fn skirt(garment: &mut Garment, form: &Form, cut: &Skirt, girth: f64, level: f64) -> [Run; 2] {
    let frame = Frame {
        waist: girth / 4.0,
        hip_depth: form.waist - form.hip,
        hip: form.measurements.hip / 4.0,
        length: cut.length * form.waist,
        level,
    };
    let whole = |garment: &mut Garment, panel: &dyn Fn(&str) -> Piece| {
        let sides = stand(garment, form, frame.level, panel);
        sew_sides(garment, &sides, &["side left", "side right"]);
        sides
    };
    let sides = match cut.shape {
        Shape::Straight { ease, dart, slit } => {
            whole(garment, &|name| straight(&frame, ease, dart, slit).whole(name))
        }
        Shape::Flared { ease, slant } => {
            whole(garment, &|name| flared(&frame, ease, slant).closed(name, "side right"))
        }
        Shape::Circle { share } => whole(garment, &|name| circle(&frame, share).closed(name, "side right")),
        Shape::Gathered { ratio } => whole(garment, &|name| {
            strip(frame.waist * ratio, frame.waist * ratio, frame.length, "hem").whole(name)
        }),
        Shape::Godets { ease, depth, angle, middles } => {
            godets(garment, form, &frame, Godet { ease, length: depth * frame.length, angle }, middles)
        }
        Shape::Levels { ratio, count } => levels(garment, form, &frame, ratio, count),
    };
    for pieces in &sides {
        garment.sew_darts(pieces);
    }
    sides.map(|pieces| garment.run(&pieces, "waist", DVec3::X))
}

/// Places front and back, each drawn by `panel` with the waist at y = 0, with the waist at height `level`.
fn stand(garment: &mut Garment, form: &Form, level: f64, panel: &dyn Fn(&str) -> Piece) -> [Vec<PieceId>; 2] {
    [0, 1].map(|side| {
        let (name, facing) = [("skirt front", Facing::Front), ("skirt back", Facing::Back)][side];
        vec![garment.stand(panel(name), Part::Leg, facing, DVec3::new(0.0, level, depth(form, side)))]
    })
}

/// z at which the front (0) or back (1) is placed, metres.
fn depth(form: &Form, side: usize) -> f64 {
    form.hip_depth[side] + [CLEARANCE, -CLEARANCE][side]
}

fn sew_sides(garment: &mut Garment, [front, back]: &[Vec<PieceId>; 2], labels: &[&str]) {
    for label in labels {
        // The sides of a full circle are level: their runs are ordered inwards.
        let inwards = if label.ends_with("left") { -0.3 } else { 0.3 };
        garment.sew_alike(front, back, &[label], UPWARDS + DVec3::X * inwards);
    }
}

/// The left half of a fitted panel.
fn straight(frame: &Frame, ease: f64, dart: f64, slit: f64) -> Path {
    const RAISE: f64 = 0.012;
    let hip = DVec2::new(frame.hip + ease / 4.0, -frame.hip_depth);
    let hem = DVec2::new(hip.x + 0.004, -frame.length);
    let with_dart = frame.waist + dart;
    let side = DVec2::new((with_dart * with_dart - RAISE * RAISE).sqrt(), RAISE);
    let first = hip + DVec2::Y * (0.45 * frame.hip_depth);
    let second = side + DVec2::new(0.3 * (hip.x - side.x), -0.30 * frame.hip_depth);
    let mut path = Path::from(DVec2::new(0.0, hem.y)).line("hem", hem);
    if slit > 0.0 {
        path = path.line("slit", hem.lerp(hip, slit / hem.distance(hip)));
    }
    let dart = Dart { at: 0.5 * with_dart, width: dart, depth: 0.55 * frame.hip_depth };
    path.line("side", hip).curve("side", first, second, side).darted("waist", DVec2::ZERO, dart)
}

/// The outline of a flared panel, from the right end of its hem round to the right end of its waist and back.
fn flared(frame: &Frame, ease: f64, slant: f64) -> Path {
    let at_hip = frame.hip.max(frame.waist) + ease / 4.0;
    let slope = (at_hip - frame.waist) / frame.hip_depth;
    let corner = |sign: f64| {
        let length = frame.length + sign * slant / 2.0;
        DVec2::new(-sign * (frame.waist + slope * length), -length)
    };
    let (right, left) = (corner(1.0), corner(-1.0));
    let waist = DVec2::new(frame.waist, 0.0);
    // The hem hangs a little in its middle, as it does where sides slope.
    let sag = DVec2::NEG_Y * (0.25 * slope * left.x);
    Path::from(right)
        .curve("hem", right.lerp(left, 0.33) + sag, right.lerp(left, 0.67) + sag, left)
        .line("side left", waist)
        .line("waist", DVec2::new(-frame.waist, 0.0))
        .line("side right", right)
}

/// The outline of a ring sector.
fn circle(frame: &Frame, share: f64) -> Path {
    let inner = 4.0 * frame.waist / (TAU * share);
    let outer = inner + frame.length;
    let half = PI * share / 2.0;
    let at = |radius: f64, sign: f64| {
        // The ends of the waist are at y = 0.
        let centre = inner * half.cos();
        DVec2::new(sign * radius * half.sin(), centre - radius * half.cos())
    };
    Path::from(at(outer, -1.0))
        .arc("hem", outer, true, at(outer, 1.0))
        .line("side left", at(inner, 1.0))
        .arc("waist", inner, false, at(inner, -1.0))
        .line("side right", at(outer, -1.0))
}

/// The left half of a strip with half widths `top` and `bottom`, from y = 0 down by `height`.
fn strip(top: f64, bottom: f64, height: f64, below: &str) -> Path {
    Path::from(DVec2::new(0.0, -height))
        .line(below, DVec2::new(bottom, -height))
        .line("side", DVec2::new(top, 0.0))
        .line("waist", DVec2::ZERO)
}

/// Tiers one below the other; returns the uppermost, which has the waist.
fn levels(garment: &mut Garment, form: &Form, frame: &Frame, ratio: f64, count: u32) -> [Vec<PieceId>; 2] {
    let height = frame.length / f64::from(count);
    let mut width = frame.waist;
    let mut all: Vec<[Vec<PieceId>; 2]> = Vec::new();
    for k in 0..count {
        width *= ratio;
        // Every tier is wide enough to clear the hip.
        width = width.max(frame.hip + 0.02);
        let below = f64::from(k) * (height + LEVEL_GAP);
        let panel = |name: &str| strip(width, width, height, "hem").whole(&format!("{name} level {}", k + 1));
        let sides = stand(garment, form, frame.level - below, &panel);
        sew_sides(garment, &sides, &["side left", "side right"]);
        if let Some(above) = all.last() {
            let runs: Vec<[Run; 2]> = (0..2)
                .map(|side| {
                    let upper = garment.run(&above[side], "hem", DVec3::X);
                    [upper, garment.run(&sides[side], "waist", DVec3::X)]
                })
                .collect();
            runs.iter().for_each(|[upper, lower]| garment.sew(upper, lower));
        }
        all.push(sides);
    }
    all.swap_remove(0)
}

/// A godet: a wedge let into a seam; metres and radians.
#[derive(Clone, Copy)]
struct Godet {
    ease: f64,
    /// Length from its tip to its hem.
    length: f64,
    /// Angle between its sides.
    angle: f64,
}

impl Godet {
    fn piece(&self, name: &str) -> Piece {
        let (sin, cos) = (self.angle / 2.0).sin_cos();
        let [right, left] = [-1.0, 1.0].map(|sign| DVec2::new(sign * sin, -cos) * self.length);
        Path::from(DVec2::ZERO)
            .line("godet right", right)
            .arc("hem", self.length, true, left)
            .closed(name, "godet left")
    }
}

/// A flared skirt with godets at the sides, and in the middle of front and back where `middles`.
fn godets(
    garment: &mut Garment,
    form: &Form,
    frame: &Frame,
    godet: Godet,
    middles: bool,
) -> [Vec<PieceId>; 2] {
    let at_hip = frame.hip.max(frame.waist) + godet.ease / 4.0;
    let slope = (at_hip - frame.waist) / frame.hip_depth;
    let waist = DVec2::new(frame.waist, 0.0);
    let hem = DVec2::new(frame.waist + slope * frame.length, -frame.length);
    let split = hem.lerp(waist, godet.length / hem.distance(waist));
    let half = || {
        Path::from(DVec2::new(0.0, -frame.length))
            .line("hem", hem)
            .line("godet side", split)
            .line("side", waist)
            .line("waist", DVec2::ZERO)
    };
    let tip = DVec2::new(0.0, godet.length - frame.length);
    let sides = [0, 1].map(|side| {
        let (name, facing) = [("skirt front", Facing::Front), ("skirt back", Facing::Back)][side];
        let at = DVec3::new(0.0, frame.level, depth(form, side));
        match middles {
            false => vec![garment.stand(half().whole(name), Part::Leg, facing, at)],
            true => {
                let left = half().line("centre", tip).line("godet middle", DVec2::new(0.0, -frame.length));
                let left = left.half(&format!("{name} left"), "centre");
                let right = to_the_right(&left);
                [left, right].map(|piece| garment.stand(piece, Part::Leg, facing, at)).into()
            }
        }
    });
    sew_sides(garment, &sides, &["side left", "side right"]);
    for (hand, sign) in [("left", 1.0), ("right", -1.0)] {
        let at = DVec3::new(sign * (split.x + GODET_OUT), frame.level + split.y, 0.0);
        let turn = DQuat::from_rotation_y(sign * FRAC_PI_2);
        let piece = godet.piece(&format!("godet {hand}"));
        let wedge = garment.stand_turned(piece, Part::Leg, Facing::Front, at, turn);
        // The left godet, rotated to the left, has its own right side to the front.
        for (side, own) in [(0, ["right", "left"]), (1, ["left", "right"])] {
            let own = own[usize::from(hand == "right")];
            let runs = [
                garment.run(&sides[side], &format!("godet side {hand}"), UPWARDS),
                garment.run(&[wedge], &format!("godet {own}"), UPWARDS),
            ];
            garment.sew(&runs[0], &runs[1]);
        }
    }
    if middles {
        for (side, pieces) in sides.iter().enumerate() {
            garment.sew_alike(&pieces[..1], &pieces[1..], &["centre"], UPWARDS);
            let (name, facing) = [("godet front", Facing::Front), ("godet back", Facing::Back)][side];
            let z = depth(form, side) + [0.04, -0.04][side];
            let at = DVec3::new(0.0, frame.level + tip.y, z);
            let wedge = garment.stand(godet.piece(name), Part::Leg, facing, at);
            for (k, hand) in ["left", "right"].into_iter().enumerate() {
                let runs = [
                    garment.run(&pieces[k..=k], "godet middle", UPWARDS),
                    garment.run(&[wedge], &format!("godet {hand}"), UPWARDS),
                ];
                garment.sew(&runs[0], &runs[1]);
            }
        }
    }
    sides
}
