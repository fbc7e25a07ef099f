//! A T-shirt: front, back, two short set-in sleeves.

use glam::{DVec2, DVec3};

use super::draft::{Outline, edge_length, mirrored, sew, sheet, standing};
use super::form::{Form, Yoke};
use super::strokes::Strokes;
use crate::pattern::{Pattern, Piece};
use crate::wrap::Marks;

/// Ease added to the bust girth, metres.
const BUST_EASE: f64 = 0.12;
/// Width moved from each quarter of the back to the front, metres.
const FRONT_SHARE: f64 = 0.008;
/// Ease added to the hip girth at the hem, metres.
const HEM_EASE: f64 = 0.09;
/// Ease added to the girth of the upper arm, metres.
const ARM_EASE: f64 = 0.085;
/// Length of the sleeve cap over the length of the armhole.
const CAP_EASE: f64 = 1.01;
/// Distance from the armpit down to the shirt's underarm point, metres.
const UNDERARM_DROP: f64 = 0.032;
/// Length of the sleeve's underarm seam, metres.
const SLEEVE_SEAM: f64 = 0.11;

/// Lengths that front and back have in common, metres. Heights are measured from the bust line.
struct Block {
    quarter: f64,
    hem_quarter: f64,
    hem: f64,
    underarm: f64,
    yoke: Yoke,
}

impl Block {
    fn new(form: &Form) -> Self {
        let m = &form.body.measurements;
        let bust = form.mark("bust_front").y;
        Self {
            quarter: (m.bust + BUST_EASE) / 4.0,
            hem_quarter: (m.hip + HEM_EASE) / 4.0,
            hem: form.mark("hip_front").y - 0.01 - bust,
            underarm: form.mark("armpit_left").y - UNDERARM_DROP - bust,
            yoke: Yoke::new(form, 0.088, -0.004),
        }
    }

    /// Front or back, seen from its outer side; `left` tells whether the wearer's left is at +x.
    fn body_piece(&self, name: &str, neck_drop: f64, left: bool) -> Piece {
        // The front is wider: the bust takes more of the girth there.
        let wider = if left { FRONT_SHARE } else { -FRONT_SHARE };
        let [neck, tip] = self.yoke.seam(usize::from(!left));
        let under = DVec2::new(self.quarter + wider, self.underarm);
        let hem = DVec2::new(self.hem_quarter + 0.5 * wider, self.hem);
        let drop = DVec2::new(0.0, neck.y - neck_drop);
        let depth = tip.y - under.y;
        let chest = tip.x - 0.020 + wider;
        let (first, second) = (DVec2::new(chest, tip.y - 0.45 * depth), DVec2::new(chest + 0.006, under.y));
        let flip = |p: DVec2| DVec2::new(-p.x, p.y);
        let (this, other) = if left { ("left", "right") } else { ("right", "left") };
        let named = |what: &str, side: &str| format!("{what} {side}");
        let (toward_neck, toward_middle) =
            (DVec2::new(neck.x - 0.006, neck.y - 0.62 * neck_drop), DVec2::new(0.60 * neck.x, drop.y));
        Outline::from(flip(hem))
            .line("hem", hem)
            .line(&named("side", this), under)
            .curve(&named("armhole", this), second, first, tip)
            .line(&named("shoulder", this), neck)
            .curve(&named("neck", this), toward_neck, toward_middle, drop)
            .curve(&named("neck", other), flip(toward_middle), flip(toward_neck), flip(neck))
            .line(&named("shoulder", other), flip(tip))
            .curve(&named("armhole", other), flip(first), flip(second), flip(under))
            .line(&named("side", other), flip(hem))
            .piece(name)
    }
}

/// The left sleeve, seen from outside: the wearer's front is at -x.
fn sleeve(front_armhole: f64, back_armhole: f64, width: f64, hem_width: f64) -> Piece {
    let cap_length = |half: f64, height: f64| {
        let piece =
            half_cap(half, height).line("x", DVec2::new(half, 0.0)).line("y", DVec2::ZERO).piece("cap");
        piece.edge_length(0)
    };
    let (front, back) = (front_armhole * CAP_EASE, back_armhole * CAP_EASE);
    let half_for = |length: f64, height: f64| bisect(0.02, 0.40, |half| cap_length(half, height) - length);
    let height = bisect(0.005, 0.9 * front.min(back), |h| width - half_for(front, h) - half_for(back, h));
    let (a, b) = (half_for(front, height), half_for(back, height));
    let middle = (b - a) / 2.0;
    let hem = hem_width / 2.0;
    Outline::from(DVec2::new(middle - hem, -SLEEVE_SEAM))
        .line("hem", DVec2::new(middle + hem, -SLEEVE_SEAM))
        .line("underarm back", DVec2::new(b, 0.0))
        .curve("cap back", DVec2::new(0.55 * b, 0.0), DVec2::new(0.45 * b, height), DVec2::new(0.0, height))
        .curve("cap front", DVec2::new(-0.45 * a, height), DVec2::new(-0.55 * a, 0.0), DVec2::new(-a, 0.0))
        .line("underarm front", DVec2::new(middle - hem, -SLEEVE_SEAM))
        .piece("sleeve left")
}

fn half_cap(half: f64, height: f64) -> Outline {
    Outline::from(DVec2::ZERO).curve(
        "cap",
        DVec2::new(0.45 * half, 0.0),
        DVec2::new(0.55 * half, -height),
        DVec2::new(half, -height),
    )
}

/// Zero of the monotonic function `f` between `low` and `high`, by bisection.
fn bisect(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let rising = f(high) > f(low);
    for _ in 0..60 {
        let middle = (low + high) / 2.0;
        if (f(middle) > 0.0) == rising { high = middle } else { low = middle }
    }
    (low + high) / 2.0
}

/// Pattern and marks of the T-shirt.
pub fn tshirt(form: &Form) -> (Pattern, Marks) {
    let block = Block::new(form);
    let bust = form.mark("bust_front").y;
    let [front_height, back_height] = block.yoke.heights;
    let mut front = block.body_piece("front", 0.095, true);
    let mut back = block.body_piece("back", 0.028, false);
    let m = &form.body.measurements;
    let mut left = sleeve(
        edge_length(&front, "armhole left"),
        edge_length(&back, "armhole left"),
        m.upper_arm + ARM_EASE,
        m.upper_arm + 0.8 * ARM_EASE,
    );
    let cap_height = left.outline.iter().map(|e| e.start.y).fold(0.0, f64::max);
    let mut right = mirrored(&left, "sleeve right");
    front.placement = Some(standing(DVec3::new(0.0, bust, 0.30), 0.0));
    back.placement = Some(standing(DVec3::new(0.0, bust, -0.30), std::f64::consts::PI));
    let elbow = form.mark("elbow_left");
    left.placement =
        Some(standing(DVec3::new(elbow.x + 0.15, elbow.y + 0.1, 0.0), std::f64::consts::FRAC_PI_2));
    right.placement =
        Some(standing(DVec3::new(-elbow.x - 0.15, elbow.y + 0.1, 0.0), -std::f64::consts::FRAC_PI_2));
    for (piece, label) in [(&mut front, "body"), (&mut back, "body"), (&mut left, "arm"), (&mut right, "arm")]
    {
        piece.label = Some(label.to_owned());
    }
    let mut pattern = Pattern::default();
    let ids: Vec<_> =
        sheet(vec![vec![front, back], vec![left, right]]).into_iter().map(|p| pattern.add_piece(p)).collect();
    let [front, back, left, right] = ids[..] else { unreachable!("four pieces were laid") };
    for side in ["left", "right"] {
        let sleeve = if side == "left" { left } else { right };
        sew(&mut pattern, (front, &format!("shoulder {side}")), (back, &format!("shoulder {side}")));
        sew(&mut pattern, (front, &format!("side {side}")), (back, &format!("side {side}")));
        sew(&mut pattern, (sleeve, "cap front"), (front, &format!("armhole {side}")));
        sew(&mut pattern, (sleeve, "cap back"), (back, &format!("armhole {side}")));
        sew(&mut pattern, (sleeve, "underarm front"), (sleeve, "underarm back"));
    }
    let mut strokes = Strokes::default();
    for (piece, side, top) in [(front, 1.0, front_height - 0.11), (back, -1.0, back_height - 0.04)] {
        let path = form.upright(0.0, form.mark("hip_front").y - 0.08, bust + top + 0.10, side);
        let anchor = form.skin(0.0, bust, side).unwrap_or_default();
        let (from, to) = (block.hem + 0.02, top);
        let body = form.part(&path, anchor, from, to);
        strokes.pair(piece, DVec2::new(0.0, from), DVec2::new(0.0, to), body);
    }
    for (piece, side) in [(left, "left"), (right, "right")] {
        let (tip, elbow) = (form.mark(&format!("shoulder_{side}")), form.mark(&format!("elbow_{side}")));
        let path = form.straight(tip, elbow);
        let (from, to) = (0.02, cap_height + SLEEVE_SEAM - 0.01);
        let body = form.part(&path, tip, from, to);
        strokes.pair(piece, DVec2::new(0.0, cap_height - from), DVec2::new(0.0, cap_height - to), body);
    }
    (pattern, strokes.finish())
}
