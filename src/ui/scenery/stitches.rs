//! Draws seams as rows of stitches.

use crate::cloth::dashes::dashes;
use crate::cloth::trim_shapes::THREAD_THICKNESS;
use crate::render::Polyline;

/// Length of a stitch, metres on a body 1.5 m tall.
const STITCH: f32 = 0.007;
/// Length of the gap between two stitches, metres on a body 1.5 m tall.
const GAP: f32 = 0.005;
/// Colour of the thread, sRGB and opacity.
const THREAD: [u8; 4] = [246, 243, 232, 235];
/// Largest width of the thread, logical pixels.
const WIDTH: f32 = 1.7;

/// For each of `seams` the seam's line and the stitches on it.
pub fn stitched(seams: Vec<Polyline>, scale: f32) -> Vec<Polyline> {
    let mut all = Vec::new();
    for seam in seams {
        let stitches = dashes(&seam.points, STITCH * scale, GAP * scale);
        // Stitches are drawn above the line they are on.
        let thread = Polyline {
            points: Vec::new(),
            colour: THREAD,
            width: WIDTH,
            lift: seam.lift * 1.3,
            thickness: THREAD_THICKNESS * scale,
            ..seam
        };
        all.push(seam);
        all.extend(stitches.into_iter().map(|points| Polyline { points, ..thread.clone() }));
    }
    all
}
