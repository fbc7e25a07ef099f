//! A cape: hangs from the shoulders and over the arms, sewn shut at the throat and open in front below that.

use glam::{DVec2, DVec3};

use crate::draft::bodice::{CLEARANCE, OUTER, placed_height};
use crate::draft::form::{Form, Yoke};
use crate::draft::garment::{Facing, Garment, Part};
use crate::draft::neckline::Neckline;
use crate::draft::path::{Path, to_the_right};
use crate::pattern::{Pattern, Piece};

/// Height of the seam over the arm above the shoulder tip, metres: room for the roundness of the shoulder.
const ROOM: f64 = 0.015;
/// Length of the straight handle of the hem's curve, as a share of its chord.
const ROUND: f64 = 0.33;

/// Measures of a cape, metres.
#[derive(Clone, Copy, Debug)]
pub struct Cape {
    pub neckline: Neckline,
    /// Length from the neck down the middle, as a share of the shoulder's height above the ground.
    pub length: f64,
    /// Share of the arm that it covers.
    pub cover: f64,
    /// Length of the seam that closes it at the throat.
    pub closing: f64,
    /// Distance of each front edge from the middle at the hem.
    pub open: f64,
}

/// Drafts a cape for the body of `form`, places the pieces round it and sews them.
pub fn cape(form: &Form, cut: &Cape) -> Pattern {
    let mut garment = Garment::default();
    let yoke = form.yoke(form.neck_width(cut.neckline.width), 0.0);
    // Front and back are equal but for neckline and opening: loose cloth makes up for the difference.
    let level = |ends: [DVec2; 2]| [(ends[0] + ends[1]) / 2.0; 2];
    let yoke = Yoke { neck: level(yoke.neck), tip: level(yoke.tip) };
    let height = placed_height(form, &yoke, 0);
    let front = half(form, cut, &yoke, 0);
    let low = front.end();
    let left = front.line("closing", low - DVec2::Y * cut.closing).half("front left", "front edge");
    let right = to_the_right(&left);
    let back = half(form, cut, &yoke, 1).whole("back");
    let mut placed = |piece: Piece, side: usize| {
        let z = form.depth[side] + [CLEARANCE, -CLEARANCE][side];
        // Worn over everything. It is sewn from where it is placed, as marks that are suggested for sleeves do not fit it.
        let piece = Piece { layer: OUTER, ..piece };
        let facing = [Facing::Front, Facing::Back][side];
        garment.stand(piece, Part::Body, facing, DVec3::new(0.0, height, z))
    };
    let fronts = [left, right].map(|piece| placed(piece, 0));
    let back = [placed(back, 1)];
    let labels = ["shoulder left", "shoulder right", "overarm left", "overarm right"];
    garment.sew_alike(&fronts, &back, &labels, DVec3::X);
    garment.sew_alike(&fronts[..1], &fronts[1..], &["closing"], DVec3::Y);
    garment.pattern
}

/// The left half of the front (0) or back (1), from the hem round to the middle of the neckline.
fn half(form: &Form, cut: &Cape, yoke: &Yoke, side: usize) -> Path {
    let fall = form.arm.fall();
    let (along, up) = (DVec2::new(fall.cos(), -fall.sin()), DVec2::new(fall.sin(), fall.cos()));
    let (corner, tip) = (yoke.neck[side], yoke.tip[side] + up * ROOM);
    let end = tip + along * (cut.cover * form.measurements.arm_length);
    let middle = DVec2::new(0.0, corner.y - cut.length * form.shoulder_at(corner.x).y);
    let handle = ROUND * end.distance(middle);
    let start = middle + DVec2::X * [cut.open, 0.0][side];
    let path = Path::from(start)
        .curve("hem", middle + DVec2::X * handle, end - up * handle, end)
        .line("overarm", tip + along * 0.06)
        .curve("overarm", tip + along * 0.02, tip.lerp(corner, 0.15), tip.lerp(corner, 0.4))
        .line("shoulder", corner);
    cut.neckline.drawn(path, side)
}
