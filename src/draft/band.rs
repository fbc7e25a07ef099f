//! Waistbands of two strips, one in front and one at the back.

use glam::{DVec2, DVec3};

use crate::draft::form::Form;
use crate::draft::garment::{Facing, Garment, Part, Run, UPWARDS};
use crate::draft::path::Path;

/// Distance at which the strips are placed in front of and behind the skin of the hip, metres.
const CLEARANCE: f64 = 0.10;
/// Gap between a band and the edge it is sewn to, as placed, metres.
const GAP: f64 = 0.005;

/// Drafts a band `height` metres high and `girth` metres round, places it at `level` metres above the ground and sews it to the
/// upper edges of front and back, which run from the right of the body to the left. The longer edge is gathered.
pub fn waistband(garment: &mut Garment, form: &Form, height: f64, girth: f64, level: f64, tops: [Run; 2]) {
    let lengths = tops.each_ref().map(|run| garment.length(run));
    let share = girth / (lengths[0] + lengths[1]);
    let strips = [0, 1].map(|side| {
        let half = lengths[side] * share / 2.0;
        let (name, facing) = [("waistband front", Facing::Front), ("waistband back", Facing::Back)][side];
        let path = Path::from(DVec2::ZERO)
            .line("band seam", DVec2::new(half, 0.0))
            .line("band side", DVec2::new(half, height))
            .line("band top", DVec2::new(0.0, height));
        let z = form.hip_depth[side] + [CLEARANCE, -CLEARANCE][side];
        garment.stand(path.whole(name), Part::Body, facing, DVec3::new(0.0, level + GAP, z))
    });
    for (strip, top) in strips.into_iter().zip(&tops) {
        let seam = garment.run(&[strip], "band seam", DVec3::X);
        garment.sew(&seam, top);
    }
    garment.sew_alike(&strips[..1], &strips[1..], &["band side left", "band side right"], UPWARDS);
}
