//! A slightly flared skirt: front and back with two darts each, on a waistband.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DVec2, DVec3};

use super::draft::{Outline, edge_length, sew, sheet, standing};
use super::form::Form;
use super::strokes::Strokes;
use crate::geometry::ids::PieceId;
use crate::pattern::{Pattern, Piece};
use crate::wrap::Marks;

/// Ease added to the waist girth, metres: what the offset of the cloth takes all round, and a little more.
const WAIST_EASE: f64 = 0.032;
/// Ease added to the hip girth, metres.
const HIP_EASE: f64 = 0.06;
/// Width of each of the four darts, metres.
const DART: f64 = 0.026;
/// Length of the skirt below the waist, metres.
const LENGTH: f64 = 0.58;
/// Width added to each quarter at the hem, metres.
const FLARE: f64 = 0.05;
/// Height of the waistband, metres.
pub const BAND: f64 = 0.035;

/// Half a waistband, with its lower edge at the waist divided into `parts` (metres, left to right in the drawing).
pub fn band(name: &str, parts: &[f64]) -> Piece {
    let half = parts.iter().sum::<f64>() / 2.0;
    let corner = DVec2::new;
    let mut outline = Outline::from(corner(-half, 0.0));
    let mut x = -half;
    for (i, part) in parts.iter().enumerate() {
        x += part;
        outline =
            outline.line(&format!("lower {i}"), corner(if i + 1 == parts.len() { half } else { x }, 0.0));
    }
    outline
        .line("end right", corner(half, BAND))
        .line("top", corner(-half, BAND))
        .line("end left", corner(-half, 0.0))
        .piece(name)
}

/// Adds horizontal strokes on front and back band, which meet at the side seams.
pub fn band_strokes(form: &Form, front: PieceId, back: PieceId, waist: f64, strokes: &mut Strokes) {
    // The band reaches from side seam to side seam.
    let y = form.mark("waist_front").y + BAND / 2.0;
    for (piece, middle) in [(front, 0.0), (back, PI)] {
        let anchor = form.round(y, middle).unwrap_or_default();
        let path = form.level(y, middle - 1.35 * FRAC_PI_2, middle + 1.35 * FRAC_PI_2);
        let half = waist / 4.0 - 0.004;
        let body = form.part(&path, anchor, -half, half);
        strokes.pair(piece, DVec2::new(-half, BAND / 2.0), DVec2::new(half, BAND / 2.0), body);
    }
}

/// Measures of a skirt panel, metres.
pub struct Cut {
    /// Girth of the whole skirt at waist and hip.
    pub girths: [f64; 2],
    /// Distance from the waist down to the hip.
    pub hip_depth: f64,
    /// Width and length of each dart.
    pub dart: [f64; 2],
    /// Distance from the waist down to the hem.
    pub length: f64,
    /// Width added to each quarter at the hem.
    pub flare: f64,
}

/// Front or back panel, seen from outside: the waist line is y = 0 in the middle.
pub fn panel(name: &str, cut: &Cut) -> Piece {
    let [waist, hip] = cut.girths.map(|g| g / 4.0);
    let [width, depth] = cut.dart;
    let side = DVec2::new(waist + width, 0.012);
    let at_hip = DVec2::new(hip, -cut.hip_depth);
    let hem = DVec2::new(hip + cut.flare, -cut.length);
    let slope = side.y / side.x;
    let middle = 0.52 * side.x;
    let [inner, outer] = [middle - width / 2.0, middle + width / 2.0].map(|x| DVec2::new(x, x * slope));
    let tip = DVec2::new(middle, middle * slope - depth);
    let flip = |p: DVec2| DVec2::new(-p.x, p.y);
    let below = at_hip + (at_hip - hem).normalize() * (0.45 * cut.hip_depth);
    let above = DVec2::new(side.x + 0.30 * (hip - side.x), side.y - 0.30 * cut.hip_depth);
    Outline::from(flip(hem))
        .line("hem", hem)
        .line("side lower right", at_hip)
        .curve("side upper right", below, above, side)
        .line("waist outer right", outer)
        .line("dart outer right", tip)
        .line("dart inner right", inner)
        .line("waist middle", flip(inner))
        .line("dart inner left", flip(tip))
        .line("dart outer left", flip(outer))
        .line("waist outer left", flip(side))
        .curve("side upper left", flip(above), flip(below), flip(at_hip))
        .line("side lower left", flip(hem))
        .piece(name)
}

/// Labels of a panel's waist edges, left to right in the drawing.
pub const WAIST_EDGES: [&str; 3] = ["waist outer left", "waist middle", "waist outer right"];

/// Places `front` and `back` in front of and behind the body, with their own x axis at height `y`.
pub fn face(front: &mut Piece, back: &mut Piece, y: f64) {
    front.placement = Some(standing(DVec3::new(0.0, y, 0.30), 0.0));
    back.placement = Some(standing(DVec3::new(0.0, y, -0.30), PI));
}

/// Sews the ends of the two bands, and each band to the `edges` of its panels.
pub fn sew_bands(pattern: &mut Pattern, bands: [PieceId; 2], edges: [&[(PieceId, String)]; 2]) {
    for (band, edges) in bands.into_iter().zip(edges) {
        for (i, (piece, label)) in edges.iter().enumerate() {
            sew(pattern, (band, &format!("lower {i}")), (*piece, label));
        }
    }
    sew(pattern, (bands[0], "end right"), (bands[1], "end left"));
    sew(pattern, (bands[0], "end left"), (bands[1], "end right"));
}

/// Closes the darts and the side seams of a skirt.
pub fn sew_panels(pattern: &mut Pattern, front: PieceId, back: PieceId) {
    for panel in [front, back] {
        for side in ["left", "right"] {
            sew(pattern, (panel, &format!("dart inner {side}")), (panel, &format!("dart outer {side}")));
        }
    }
    for part in ["upper", "lower"] {
        for (side, other) in [("left", "right"), ("right", "left")] {
            sew(pattern, (front, &format!("side {part} {side}")), (back, &format!("side {part} {other}")));
        }
    }
}

/// Pattern and marks of the skirt.
pub fn skirt(form: &Form) -> (Pattern, Marks) {
    let m = &form.body.measurements;
    let y = form.mark("waist_front").y;
    let depth = y - form.mark("hip_front").y;
    let (waist, hip) = (m.waist + WAIST_EASE, m.hip + HIP_EASE);
    let cut = |dart: f64| Cut {
        girths: [waist, hip],
        hip_depth: depth,
        dart: [DART, dart],
        length: LENGTH,
        flare: FLARE,
    };
    let mut front = panel("skirt front", &cut(0.09));
    let mut back = panel("skirt back", &cut(0.13));
    let parts = |p: &Piece| WAIST_EDGES.map(|label| edge_length(p, label));
    let (mut front_band, mut back_band) =
        (band("waistband front", &parts(&front)), band("waistband back", &parts(&back)));
    face(&mut front, &mut back, y);
    face(&mut front_band, &mut back_band, y);
    let total: f64 = parts(&front).iter().chain(&parts(&back)).sum();
    let mut pattern = Pattern::default();
    let ids: Vec<_> = sheet(vec![vec![front_band, back_band], vec![front, back]])
        .into_iter()
        .map(|piece| pattern.add_piece(piece))
        .collect();
    let [front_band, back_band, front, back] = ids[..] else { unreachable!("four pieces were laid") };
    sew_panels(&mut pattern, front, back);
    let edges = |piece: PieceId| WAIST_EDGES.map(|label| (piece, label.to_owned()));
    sew_bands(&mut pattern, [front_band, back_band], [&edges(front), &edges(back)]);
    let mut strokes = Strokes::default();
    band_strokes(form, front_band, back_band, total, &mut strokes);
    (pattern, strokes.finish())
}
