//! Draws seams as rows of stitches.

use glam::Vec3;

use crate::render::Polyline;

/// Length of a stitch, metres on a body 1.5 m tall.
const STITCH: f32 = 0.007;
/// Length of the gap between two stitches, metres on a body 1.5 m tall.
const GAP: f32 = 0.005;
/// Colour of the thread, sRGB and opacity.
const THREAD: [u8; 4] = [246, 243, 232, 235];
/// Largest width of the thread, logical pixels.
const WIDTH: f32 = 1.7;
/// Thickness of the thread, metres on a body 1.5 m tall: from afar stitches fade.
pub const THREAD_THICKNESS: f32 = 0.0012;

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

/// Dashes of the polyline, each `length` long with gaps of `gap`; corners are kept.
pub fn dashes(points: &[Vec3], length: f32, gap: f32) -> Vec<Vec<Vec3>> {
    let mut all = Vec::new();
    let mut dash: Vec<Vec3> = points.first().copied().into_iter().collect();
    // Remaining length of the current stitch or gap.
    let (mut left, mut sewing) = (length, true);
    for w in points.windows(2) {
        let side = w[0].distance(w[1]);
        let mut walked = 0.0;
        while side - walked > left {
            walked += left;
            let at = w[0].lerp(w[1], walked / side);
            if sewing {
                dash.push(at);
                all.push(std::mem::take(&mut dash));
            } else {
                dash = vec![at];
            }
            sewing = !sewing;
            left = if sewing { length } else { gap };
        }
        left -= side - walked;
        if sewing {
            dash.push(w[1]);
        }
    }
    if sewing && dash.len() > 1 {
        all.push(dash);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stitches_are_as_long_as_they_should_be_round_corners_too() {
        let corner = [Vec3::ZERO, Vec3::X * 0.1, Vec3::new(0.1, 0.095, 0.0)];
        let dashes = dashes(&corner, 0.03, 0.02);
        let long = |d: &Vec<Vec3>| d.windows(2).map(|w| w[0].distance(w[1])).sum::<f32>();
        assert_eq!(dashes.len(), 4, "just under 0.2 m in steps of 5 cm");
        assert!(dashes.iter().all(|d| (long(d) - 0.03).abs() < 1e-6));
        assert!((dashes[1][0] - Vec3::X * 0.05).length() < 1e-6);
        let starts: Vec<f32> = dashes.iter().map(|d| d[0].x + d[0].y).collect();
        for (start, wanted) in starts.iter().zip([0.0, 0.05, 0.1, 0.15]) {
            assert!((start - wanted).abs() < 1e-5, "{starts:?}");
        }
    }

    #[test]
    fn nothing_is_sewn_where_there_is_no_line() {
        assert!(dashes(&[], 0.03, 0.02).is_empty());
        assert!(dashes(&[Vec3::X], 0.03, 0.02).is_empty());
        assert!(dashes(&[Vec3::X, Vec3::X], 0.03, 0.02).iter().all(|d| d.len() > 1));
    }
}
