//! Waistbands of two strips, one in front and one at the back.

use glam::{DVec2, DVec3};

use crate::draft::form::Form;
use crate::draft::garment::{Facing, Garment, Part, Run, UPWARDS};
use crate::draft::path::Path;
use crate::geometry::ids::PieceId;

/// Gap between a band and what it is sewn to, as placed, metres.
pub const GAP: f64 = 0.005;

/// A waistband; metres.
#[derive(Clone, Copy, Debug)]
pub struct Band {
    /// Its height.
    pub height: f64,
    /// Its length round the body.
    pub girth: f64,
    /// Height above the ground at which it is placed.
    pub level: f64,
    /// Distance at which its strips are placed in front of and behind the skin of the hip.
    pub clearance: f64,
    /// Half widths of what is sewn to the middle of its upper edge in front and at the back, along "panel seam"; None: nothing.
    pub panels: Option<[f64; 2]>,
}

impl Band {
    /// A plain band `height` metres high and `girth` metres round.
    pub fn plain(height: f64, girth: f64, level: f64) -> Self {
        Self { height, girth, level, clearance: 0.10, panels: None }
    }
}

/// Drafts a band and sews it to the upper edges of front and back, which run from the right of the body to the left. The longer
/// edge is gathered. Returns its front and its back.
pub fn waistband(garment: &mut Garment, form: &Form, band: &Band, tops: &[Run; 2]) -> [PieceId; 2] {
    let Band { height, girth, level, clearance, panels } = *band;
    let lengths = tops.each_ref().map(|run| garment.length(run));
    let share = girth / (lengths[0] + lengths[1]);
    let strips = [0, 1].map(|side| {
        let half = lengths[side] * share / 2.0;
        let (name, facing) = [("waistband front", Facing::Front), ("waistband back", Facing::Back)][side];
        let at = |x: f64| DVec2::new(x, height);
        let path =
            Path::from(DVec2::ZERO).line("band seam", DVec2::new(half, 0.0)).line("band side", at(half));
        let path = match panels {
            Some(wide) => path.line("band top", at(wide[side])).line("panel seam", at(0.0)),
            None => path.line("band top", at(0.0)),
        };
        let z = form.hip_depth[side] + [clearance, -clearance][side];
        garment.stand(path.whole(name), Part::Body, facing, DVec3::new(0.0, level + GAP, z))
    });
    for (strip, top) in strips.into_iter().zip(tops) {
        let seam = garment.run(&[strip], "band seam", DVec3::X);
        garment.sew(&seam, top);
    }
    garment.sew_alike(&strips[..1], &strips[1..], &["band side left", "band side right"], UPWARDS);
    strips
}
