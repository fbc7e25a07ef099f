//! A sleeveless dress: a darted bodice on a flared skirt, sewn at the waist.

use glam::{DVec2, DVec3};

use super::draft::{Outline, edge_length, sew, sheet, standing};
use super::form::{Form, Yoke};
use super::skirt::{self, Cut, WAIST_EDGES, sew_panels};
use super::strokes::Strokes;
use crate::geometry::ids::PieceId;
use crate::pattern::{Pattern, Piece};
use crate::wrap::Marks;

/// Ease added to the bust girth, metres.
const BUST_EASE: f64 = 0.07;
/// Ease added to the waist girth, metres.
const WAIST_EASE: f64 = 0.05;
/// Ease added to the hip girth, metres.
const HIP_EASE: f64 = 0.07;
/// Width moved from each quarter of the back to the front at the bust, metres.
const FRONT_SHARE: f64 = 0.008;
/// Length and flare of the skirt, metres.
const SKIRT: [f64; 2] = [0.60, 0.10];

/// Measures in which front and back of the bodice differ, metres.
struct Bodice {
    /// 0: front, 1: back.
    side: usize,
    /// Drop from the neck end of the shoulder seam to the middle of the neckline.
    neck_drop: f64,
    /// Half-width at the bust line.
    quarter: f64,
    /// Depth of the armhole, measured in from the shoulder tip.
    hollow: f64,
    /// Length of the dart above the waist, and its width.
    dart: [f64; 2],
}

/// Lengths of the waist edges that the bodice must match, and heights above the bust line, metres.
struct Lines {
    middle: f64,
    outer: f64,
    underarm: f64,
    waist: f64,
}

/// Front or back of the bodice, seen from outside; the bust line is y = 0.
fn bodice(name: &str, yoke: &Yoke, cut: &Bodice, lines: &Lines) -> Piece {
    let [neck, tip] = yoke.seam(cut.side);
    let drop = DVec2::new(0.0, neck.y - cut.neck_drop);
    let under = DVec2::new(cut.quarter, lines.underarm);
    let [dart_length, dart_width] = cut.dart;
    let inner = DVec2::new(lines.middle / 2.0, lines.waist);
    let outer = inner + DVec2::new(dart_width, 0.0);
    let point = (inner + outer) / 2.0 + DVec2::new(0.0, dart_length);
    let side = outer + DVec2::new(lines.outer, 0.0);
    let depth = tip.y - under.y;
    let chest = tip.x - cut.hollow;
    let (high, low) = (DVec2::new(chest, tip.y - 0.45 * depth), DVec2::new(chest + 0.004, under.y));
    let near_neck = DVec2::new(neck.x - 0.006, neck.y - 0.62 * cut.neck_drop);
    let near_middle = DVec2::new(0.60 * neck.x, drop.y);
    let flip = |p: DVec2| DVec2::new(-p.x, p.y);
    Outline::from(flip(side))
        .line("waist outer left", flip(outer))
        .line("dart outer left", flip(point))
        .line("dart inner left", flip(inner))
        .line("waist middle", inner)
        .line("dart inner right", point)
        .line("dart outer right", outer)
        .line("waist outer right", side)
        .line("side right", under)
        .curve("armhole right", low, high, tip)
        .line("shoulder right", neck)
        .curve("neck right", near_neck, near_middle, drop)
        .curve("neck left", flip(near_middle), flip(near_neck), flip(neck))
        .line("shoulder left", flip(tip))
        .curve("armhole left", flip(high), flip(low), flip(under))
        .line("side left", flip(side))
        .piece(name)
}

/// Pattern and marks of the dress.
pub fn dress(form: &Form) -> (Pattern, Marks) {
    let m = &form.body.measurements;
    let [bust, waist] = ["bust_front", "waist_front"].map(|name| form.mark(name).y);
    let skirt_cut = |dart: [f64; 2]| Cut {
        girths: [m.waist + WAIST_EASE, m.hip + HIP_EASE],
        hip_depth: waist - form.mark("hip_front").y,
        dart,
        length: SKIRT[0],
        flare: SKIRT[1],
    };
    let mut skirt_front = skirt::panel("skirt front", &skirt_cut([0.020, 0.09]));
    let mut skirt_back = skirt::panel("skirt back", &skirt_cut([0.026, 0.13]));
    let yoke = Yoke::new(form, 0.100, 0.022);
    let lines = |panel: &Piece| Lines {
        middle: edge_length(panel, "waist middle"),
        outer: edge_length(panel, "waist outer right"),
        underarm: form.mark("armpit_left").y - 0.015 - bust,
        waist: waist - bust - 0.004,
    };
    let quarter = (m.bust + BUST_EASE) / 4.0;
    let front_cut = Bodice {
        side: 0,
        neck_drop: 0.115,
        quarter: quarter + FRONT_SHARE,
        hollow: 0.006,
        dart: [0.115, 0.034],
    };
    let back_cut = Bodice {
        side: 1,
        neck_drop: 0.045,
        quarter: quarter - FRONT_SHARE,
        hollow: 0.014,
        dart: [0.135, 0.028],
    };
    let mut front = bodice("bodice front", &yoke, &front_cut, &lines(&skirt_front));
    let mut back = bodice("bodice back", &yoke, &back_cut, &lines(&skirt_back));
    for (piece, height, side) in [
        (&mut front, bust, 1.0),
        (&mut back, bust, -1.0),
        (&mut skirt_front, waist, 1.0),
        (&mut skirt_back, waist, -1.0),
    ] {
        let turn = if side > 0.0 { 0.0 } else { std::f64::consts::PI };
        piece.placement = Some(standing(DVec3::new(0.0, height, 0.30 * side), turn));
        piece.label = Some("body".to_owned());
    }
    let mut pattern = Pattern::default();
    let ids: Vec<_> = sheet(vec![vec![front, back], vec![skirt_front, skirt_back]])
        .into_iter()
        .map(|piece| pattern.add_piece(piece))
        .collect();
    let [front, back, skirt_front, skirt_back] = ids[..] else { unreachable!("four pieces were laid") };
    sew_bodice(&mut pattern, front, back);
    sew_panels(&mut pattern, skirt_front, skirt_back);
    for (bodice, skirt) in [(front, skirt_front), (back, skirt_back)] {
        for label in WAIST_EDGES {
            sew(&mut pattern, (bodice, label), (skirt, label));
        }
    }
    let mut strokes = Strokes::default();
    for (piece, side, cut) in [(front, 1.0, &front_cut), (back, -1.0, &back_cut)] {
        let top = yoke.heights[cut.side] - cut.neck_drop - 0.015;
        let path = form.upright(0.0, waist - 0.10, bust + top + 0.08, side);
        let anchor = form.skin(0.0, bust, side).unwrap_or_default();
        let bottom = waist - bust + 0.005;
        let body = form.part(&path, anchor, bottom, top);
        strokes.pair(piece, DVec2::new(0.0, bottom), DVec2::new(0.0, top), body);
    }
    (pattern, strokes.finish())
}

fn sew_bodice(pattern: &mut Pattern, front: PieceId, back: PieceId) {
    for piece in [front, back] {
        for side in ["left", "right"] {
            sew(pattern, (piece, &format!("dart inner {side}")), (piece, &format!("dart outer {side}")));
        }
    }
    // The wearer's left is drawn on the right in the front piece and on the left in the back piece.
    for (side, other) in [("left", "right"), ("right", "left")] {
        for label in ["side", "shoulder"] {
            sew(pattern, (front, &format!("{label} {side}")), (back, &format!("{label} {other}")));
        }
    }
}
