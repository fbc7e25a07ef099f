//! Dungarees: trousers on a waistband, with a bib, and straps over the shoulders to a back that is sewn to the waistband, too.

use glam::{DVec2, DVec3};

use crate::draft::band::{Band, GAP, waistband};
use crate::draft::form::Form;
use crate::draft::garment::{Facing, Garment, Part};
use crate::draft::path::Path;
use crate::draft::skirt::CLEARANCE;
use crate::draft::trousers::{Trousers, trousers};
use crate::geometry::ids::PieceId;
use crate::pattern::Pattern;

/// Length of cloth over the fullness of chest or back, relative to its height.
const ROUND: f64 = 1.03;
/// Length by which straps are shorter than the body there, metres: they are taut, and stay on the shoulders.
const TAUT: f64 = 0.01;
/// Height at which the back forks into straps, as a share of its height.
const FORK: f64 = 0.62;

/// Measures of dungarees, metres.
#[derive(Clone, Copy, Debug)]
pub struct Dungarees {
    pub legs: Trousers,
    /// Ease added to the girth of the waist.
    pub waist_ease: f64,
    /// Height of the waistband.
    pub band: f64,
    /// Half widths of the bib and of the back at their lower edges.
    pub bib: [f64; 2],
    /// Height of the bib's upper edge above the bust line.
    pub above_bust: f64,
    /// Distance of the middle of a strap from the body's middle, on bib and shoulder.
    pub strap_at: f64,
    /// Width of a strap.
    pub strap: f64,
}

impl Dungarees {
    /// Distances of a strap's outer and inner edge from the body's middle.
    fn strap_edges(&self) -> [f64; 2] {
        [self.strap_at + self.strap / 2.0, self.strap_at - self.strap / 2.0]
    }
}

/// Drafts dungarees for the body of `form`, places the pieces round it and sews them.
pub fn dungarees(form: &Form, cut: &Dungarees) -> Pattern {
    let mut garment = Garment::default();
    let girth = form.measurements.waist + cut.waist_ease;
    let tops = trousers(&mut garment, form, &cut.legs, girth, form.waist);
    let band =
        Band { clearance: CLEARANCE, panels: Some(cut.bib), ..Band::plain(cut.band, girth, form.waist) };
    let bands = waistband(&mut garment, form, &band, &tops);
    let low = form.waist + GAP + cut.band + GAP;
    let bib_height = ROUND * (form.bust + cut.above_bust - low);
    // Tapes from the shoulder down to the bust line, in front and at the back.
    let drops = form.yoke(cut.strap_at, 0.0).neck.map(|neck| neck.y);
    let bib = bib(&mut garment, form, cut, bib_height, low);
    let back = back(&mut garment, form, cut, drops[1] + ROUND * (form.bust - low), low);
    for (band, panel) in bands.into_iter().zip([bib, back]) {
        let runs = [(band, "panel seam"), (panel, "panel bottom")];
        let runs = runs.map(|(piece, label)| garment.run(&[piece], label, DVec3::X));
        garment.sew(&runs[0], &runs[1]);
    }
    let straps = straps(&mut garment, form, cut, drops[0] - cut.above_bust - TAUT, low + bib_height + GAP);
    for (strap, hand) in straps.into_iter().zip(["left", "right"]) {
        for (end, panel, seam) in [("strap bottom", bib, "strap seam"), ("strap top", back, "strap top")] {
            let own = garment.run(&[strap], end, DVec3::X);
            let other = garment.run(&[panel], &format!("{seam} {hand}"), DVec3::X);
            garment.sew(&own, &other);
        }
    }
    garment.pattern
}

/// Drafts the bib, `height` metres high, and places its lower edge at `low`.
fn bib(garment: &mut Garment, form: &Form, cut: &Dungarees, height: f64, low: f64) -> PieceId {
    let ([outer, inner], wide) = (cut.strap_edges(), cut.bib[0]);
    let path = Path::from(DVec2::ZERO)
        .line("panel bottom", DVec2::new(wide, 0.0))
        .curve(
            "bib side",
            DVec2::new(0.92 * wide, 0.35 * height),
            DVec2::new(outer, 0.6 * height),
            DVec2::new(outer, height),
        )
        .line("strap seam", DVec2::new(inner, height))
        .line("bib top", DVec2::new(0.0, height));
    let at = DVec3::new(0.0, low, form.depth[0] + CLEARANCE);
    garment.stand(path.whole("bib"), Part::Body, Facing::Front, at)
}

/// Drafts the back, which reaches `height` metres up to the shoulders, and places its lower edge at `low`.
fn back(garment: &mut Garment, form: &Form, cut: &Dungarees, height: f64, low: f64) -> PieceId {
    let ([outer, inner], wide) = (cut.strap_edges(), cut.bib[1]);
    let path = Path::from(DVec2::ZERO)
        .line("panel bottom", DVec2::new(wide, 0.0))
        .curve(
            "back side",
            DVec2::new(0.75 * wide, 0.3 * height),
            DVec2::new(0.65 * outer, 0.55 * height),
            DVec2::new(outer, height),
        )
        .line("strap top", DVec2::new(inner, height))
        .curve(
            "back top",
            DVec2::new(0.75 * inner, (FORK + 0.18) * height),
            DVec2::new(0.45 * inner, FORK * height),
            DVec2::new(0.0, FORK * height),
        );
    let at = DVec3::new(0.0, low, form.depth[1] - CLEARANCE);
    garment.stand(path.whole("back"), Part::Body, Facing::Back, at)
}

/// Drafts both straps, `length` metres long from the bib up to the shoulder, and places their lower ends at `low`.
fn straps(garment: &mut Garment, form: &Form, cut: &Dungarees, length: f64, low: f64) -> [PieceId; 2] {
    let [outer, inner] = cut.strap_edges();
    let left = Path::from(DVec2::new(inner, 0.0))
        .line("strap bottom", DVec2::new(outer, 0.0))
        .line("strap outer", DVec2::new(outer, length))
        .line("strap top", DVec2::new(inner, length))
        .closed("strap left", "strap inner");
    let at = DVec3::new(0.0, low, form.depth[0] + CLEARANCE);
    garment.stand_pair(left, Part::Body, Facing::Front, at, 0.0)
}
