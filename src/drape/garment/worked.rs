//! What is worked on a garment, as the solver sees it: folds, elastic, buttons, hems, piping and wrinkles.

use std::collections::BTreeMap;

use glam::DVec3;

use crate::cloth::fabric::Bending as Plate;
use crate::cloth::{Fabric, Garment};
use crate::drape::forces::bands::Bands;
use crate::drape::forces::folds::Folds;
use crate::drape::sheet::Sheet;
use crate::drape::solver::small_steps::SmallSteps;
use crate::drape::solver::ties::Fastened;

/// Bending stiffness of a hem in that of the cloth: between two layers that slide on each other (2) and that are one (8). Piping has
/// the same, whatever its radius: both allowances of its cover lie on those of the seam, four layers that slide on each other. Its
/// cord adds nothing, as its yarns slide too.
const HEM_STIFFNESS: f64 = 4.0;

/// Folds, elastic and fastened buttons of a garment that is draped.
pub(in crate::drape) struct Worked {
    /// Those of fold lines and wrinkles.
    pub folds: Folds,
    pub bands: Bands,
    /// Both points of each fastened button.
    pub buttons: Vec<[[(u32, f64); 3]; 2]>,
}

impl Worked {
    /// What is worked on `garment`, whose vertices are numbered `own` in `sheet`. The sheet is then creased along the folds
    /// and at all edges in wrinkles; `fabric` is that of a vertex of the sheet. While it is still `open`, to be sewn from these
    /// positions (metres), only what was placed turned over is folded: elastic without weight slides off upwards.
    pub fn new<'a>(
        sheet: Sheet,
        garment: &Garment,
        own: &[u32],
        fabric: impl Fn(&Sheet, u32) -> &'a Fabric,
        open: Option<&[DVec3]>,
    ) -> (Sheet, Self) {
        let ends = |corners: [u32; 2]| {
            let ends = corners.map(|c| own[garment.corners[c as usize].vertex as usize]);
            ends.iter().all(|&v| v != u32::MAX).then_some(ends)
        };
        let trims = &garment.trims;
        let folds = trims.folds.iter().filter(|f| open.is_none() || f.what.turns_over());
        let folds = folds.filter_map(|f| Some((ends(f.corners)?, f.what.angle, f.what.strength)));
        if let Some(positions) = open {
            let folds = Folds::new(&sheet, folds).folded(positions);
            let sheet =
                sheet.creased(folds.hinges().iter().map(|hinge| [hinge.vertices[0], hinge.vertices[1]]));
            return (sheet, Self { folds, bands: Bands::default(), buttons: Vec::new() });
        }
        let elastics = trims.elastics.iter();
        let bands = elastics.filter_map(|e| Some((ends(e.corners)?, e.what.ratio, e.what.tension)));
        let bands = Bands::new(&sheet, bands);
        let bent = trims.wrinkles.iter().filter_map(|bend| {
            let ends = ends(bend.corners)?;
            let Plate { warp, weft, .. } = fabric(&sheet, ends[0]).bending;
            Some((ends, bend.what.angle, bend.what.strength((warp * weft).sqrt())))
        });
        // Where both are, the fold counts: it comes first.
        let edges: Vec<([u32; 2], f64, f64)> = folds.chain(bent).collect();
        let sheet = sheet.creased(edges.iter().map(|(ends, ..)| *ends));
        let folds = Folds::new(&sheet, edges);
        let point = |point: &crate::cloth::trims::ClothPoint| {
            let vertices = point.vertices(garment).map(|(v, share)| (own[v as usize], share));
            vertices.iter().all(|&(v, _)| v != u32::MAX).then_some(vertices)
        };
        let buttons = trims.buttons.iter().filter_map(|[a, b]| Some([point(a)?, point(b)?])).collect();
        (sheet, Self { folds, bands, buttons })
    }

    /// Hands it to the solver; cloth is `thickness` metres thick.
    pub fn give(self, small: &mut SmallSteps, thickness: f64) {
        // A button holds two layers a little farther apart than contact keeps them.
        let length = 1.2 * thickness;
        small.fastened = self.buttons.into_iter().map(|ends| Fastened { ends, length }).collect();
        (small.folds, small.bands) = (self.folds, self.bands);
    }
}

/// Bending stiffness at each of `count` vertices: that of the cloth, `of`, and more in hems and along piping.
pub(in crate::drape) fn plates(
    garment: &Garment,
    own: &[u32],
    count: usize,
    of: impl Fn(u32) -> Plate,
) -> Vec<Plate> {
    let mut plates: Vec<Plate> = (0..count as u32).map(of).collect();
    let mut is_stiff = vec![false; count];
    for corner in garment.trims.stiff_corners() {
        let v = own[garment.corners[corner as usize].vertex as usize];
        if let Some(stiff) = is_stiff.get_mut(v as usize) {
            *stiff = true;
        }
    }
    for (plate, _) in plates.iter_mut().zip(is_stiff).filter(|(_, is_stiff)| *is_stiff) {
        plate.warp *= HEM_STIFFNESS;
        plate.weft *= HEM_STIFFNESS;
        plate.bias *= HEM_STIFFNESS;
    }
    plates
}

/// Masses of the simulated vertices, kg, with that of piping added to `mass`: half of each edge's to each of its ends. Sewn edges
/// have one cord, the first that one of them names. While pieces are still sewn (`is_sewn`), it weighs nothing.
pub(in crate::drape) fn weighted(
    mut mass: Vec<f64>,
    garment: &Garment,
    own: &[u32],
    is_sewn: bool,
) -> Vec<f64> {
    let mut cords: BTreeMap<[u32; 2], f64> = BTreeMap::new();
    for along in garment.trims.piped.iter().filter(|_| !is_sewn) {
        let [a, b] = along.corners.map(|c| garment.corners[c as usize]);
        let ends = [a.vertex.min(b.vertex), a.vertex.max(b.vertex)];
        cords.entry(ends).or_insert_with(|| a.uv.distance(b.uv) * along.kg_per_m());
    }
    for (ends, kg) in cords {
        let ends = ends.map(|v| own[v as usize] as usize);
        if ends.iter().all(|&v| v < mass.len()) {
            ends.into_iter().for_each(|v| mass[v] += kg / 2.0);
        }
    }
    mass
}
