//! Tops that hang from the right shoulder alone.

use glam::{DVec2, DVec3};
use serde::Serialize;

use crate::draft::bodice::{CLEARANCE, placed_height, sew_trunk};
use crate::draft::form::{Form, Yoke};
use crate::draft::garment::{Facing, Garment, Part};
use crate::draft::path::Path;
use crate::geometry::random::Random;

/// Distance from the armpit down to the underarm points, metres.
const UNDERARM_DROP: f64 = 0.025;

/// Measures of a one-shoulder top, metres.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct OneShoulder {
    /// Ease added to the bust girth: little, as it holds the left side up.
    pub ease: f64,
    /// Ease added to the hip girth at the hem.
    pub hem_ease: f64,
    /// Height of the hem above the hip.
    pub hem_above_hip: f64,
    /// Distance from the middle to the neck end of the shoulder seam.
    pub neck_width: f64,
    /// Largest distance of the slanting edge below the straight line.
    pub sag: f64,
}

impl OneShoulder {
    /// A top close round the bust, drawn at random.
    pub fn drawn(random: &mut Random) -> Self {
        Self {
            ease: random.between(0.03, 0.06),
            hem_ease: random.between(0.05, 0.12),
            hem_above_hip: random.between(0.0, 0.08),
            neck_width: random.between(0.088, 0.115),
            sag: random.between(0.01, 0.035),
        }
    }
}

/// Drafts front and back, places and sews them.
pub fn one_shoulder(garment: &mut Garment, form: &Form, cut: &OneShoulder) {
    let m = &form.measurements;
    let yoke = form.yoke(form.neck_width(cut.neck_width), 0.02);
    // Mirrored to the right shoulder: the yoke is drawn at the left.
    let level = |ends: [DVec2; 2]| [(ends[0] + ends[1]) / 2.0; 2];
    let yoke = Yoke { neck: level(yoke.neck), tip: level(yoke.tip) };
    let flip = |p: DVec2| DVec2::new(-p.x, p.y);
    let under = form.armpit.y - UNDERARM_DROP - form.bust;
    let side = DVec2::new((m.bust + cut.ease) / 4.0, under);
    let low = form.hip + cut.hem_above_hip - form.bust;
    let hem = DVec2::new((m.hip + cut.hem_ease) / 4.0, low);
    let (corner, tip) = (yoke.neck[0], yoke.tip[0]);
    let chest = tip.x - 0.020;
    let depth = tip.y - under;
    let controls = [DVec2::new(chest, tip.y - 0.45 * depth), DVec2::new(chest + 0.006, under)];
    let sides = [0, 1].map(|half| {
        let (name, facing) = [("front", Facing::Front), ("back", Facing::Back)][half];
        // The slanting edge sags in its middle, more so in front.
        let slant = flip(corner) - side;
        let sag = -DVec2::Y * (cut.sag * if half == 0 { 1.0 } else { 0.6 });
        let path = Path::from(flip(hem))
            .line("hem", hem)
            .line("side left", side)
            .curve("neck", side + slant * 0.30 + sag, side + slant * 0.72 + sag, flip(corner))
            .line("shoulder right", flip(tip))
            .curve("armhole right", flip(controls[0]), flip(controls[1]), flip(side));
        let z = form.depth[half] + [CLEARANCE, -CLEARANCE][half];
        let at = DVec3::new(0.0, placed_height(form, &yoke, half), z);
        vec![garment.stand(path.closed(name, "side right"), Part::Body, facing, at)]
    });
    let [front, back] = &sides;
    sew_trunk(garment, front, back);
}
