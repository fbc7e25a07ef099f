//! Dolman (kimono) tops: front and back with their sleeves in one piece.

use glam::{DVec2, DVec3};
use serde::Serialize;

use crate::draft::bodice::{Hem, placed_height, sew_trunk, stand_side};
use crate::draft::form::{Form, Yoke};
use crate::draft::garment::Garment;
use crate::draft::neckline::Neckline;
use crate::draft::path::Path;
use crate::geometry::random::Random;

/// Largest slope of the sleeve below the horizontal, radians: where the arm hangs lower, cloth folds under it.
const STEEPEST: f64 = 0.42;

/// Measures of a dolman top, metres.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Dolman {
    /// Length: down to the waist or the hip.
    pub hem: Hem,
    /// Ease added to the bust girth.
    pub ease: f64,
    /// Ease added to the girth at the hem.
    pub hem_ease: f64,
    /// Length of the sleeve from the shoulder tip, as a share of the arm's.
    pub length: f64,
    /// Girth of the sleeve's hem minus that of the upper arm.
    pub sleeve_ease: f64,
    /// Distance from the armpit down to where the sleeve leaves the side.
    pub depth: f64,
}

impl Dolman {
    /// A loose top with sleeves of any length, drawn at random.
    pub fn drawn(random: &mut Random) -> Self {
        let length = random.one_of([0.30, 0.42, 0.65, 0.85]) + random.between(-0.03, 0.03);
        Self {
            hem: random.one_of([Hem::Hip, Hem::Hip, Hem::Waist]),
            ease: random.between(0.12, 0.22),
            hem_ease: random.between(0.08, 0.16),
            length,
            sleeve_ease: if length > 0.6 { random.between(-0.03, 0.04) } else { random.between(0.05, 0.10) },
            depth: random.between(0.06, 0.10),
        }
    }
}

/// Drafts front and back, places and sews them.
pub fn dolman(garment: &mut Garment, form: &Form, cut: &Dolman, neck: &Neckline) {
    let m = &form.measurements;
    let yoke = form.yoke(form.neck_width(neck.width), 0.0);
    // Front and back are equal but for the neckline: loose cloth makes up for the difference.
    let level = |ends: [DVec2; 2]| [(ends[0] + ends[1]) / 2.0; 2];
    let yoke = Yoke { neck: level(yoke.neck), tip: level(yoke.tip) };
    let (hem, hip) = match cut.hem {
        Hem::Waist => (form.waist - form.bust, m.waist.max(m.hip - 0.08)),
        _ => (form.hip - form.bust, m.hip),
    };
    let fall = form.arm.fall().clamp(0.0, STEEPEST);
    let (along, up) = (DVec2::new(fall.cos(), -fall.sin()), DVec2::new(fall.sin(), fall.cos()));
    let (corner, tip) = (yoke.neck[0], yoke.tip[0]);
    let wrist = tip + along * (cut.length * m.arm_length);
    let below = wrist - up * ((m.upper_arm + cut.sleeve_ease) / 2.0);
    let side = DVec2::new((m.bust + cut.ease) / 4.0, form.armpit.y - cut.depth - form.bust);
    let hem_end = DVec2::new((hip + cut.hem_ease) / 4.0, hem);
    let reach = side.distance(below);
    let sides = [0, 1].map(|half| {
        let path = Path::from(DVec2::new(0.0, hem))
            .line("hem", hem_end)
            .line("side", side)
            .curve("underarm", side + DVec2::Y * (0.30 * reach), below - along * (0.40 * reach), below)
            .line("sleeve hem", wrist)
            .line("overarm", tip + along * 0.05)
            .curve("overarm", tip + along * 0.015, tip + (corner - tip) * 0.15, tip + (corner - tip) * 0.4)
            .line("shoulder", corner);
        let path = neck.drawn(path, half);
        stand_side(garment, form, path, half, false, placed_height(form, &yoke, half))
    });
    let [front, back] = &sides;
    sew_trunk(garment, front, back);
    for label in ["overarm left", "overarm right", "underarm left", "underarm right"] {
        garment.sew_alike(front, back, &[label], DVec3::X);
    }
}
