//! Stitches along a line: where on it each begins and ends.

use glam::Vec3;

/// A point of a polyline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// The side that it is on: that from point `side` to the next.
    pub side: u32,
    /// How far along the side, 0..=1.
    pub share: f32,
}

impl Station {
    /// The point on `points`, or what else is known at these.
    pub fn on(self, points: &[Vec3]) -> Vec3 {
        let at = self.side as usize;
        match self.share {
            0.0 => points[at],
            1.0 => points[at + 1],
            share => points[at].lerp(points[at + 1], share),
        }
    }
}

/// Dashes of the polyline, each `length` long with gaps of `gap`; corners are kept. Each has two stations or more.
pub fn dash_stations(points: &[Vec3], length: f32, gap: f32) -> Vec<Vec<Station>> {
    let mut all = Vec::new();
    let mut dash = vec![Station { side: 0, share: 0.0 }];
    // Remaining length of the current stitch or gap.
    let (mut left, mut sewing) = (length, true);
    for (side, w) in (0..).zip(points.windows(2)) {
        let long = w[0].distance(w[1]);
        let mut walked = 0.0;
        while long - walked > left {
            walked += left;
            let at = Station { side, share: walked / long };
            if sewing {
                dash.push(at);
                all.push(std::mem::take(&mut dash));
            } else {
                dash = vec![at];
            }
            sewing = !sewing;
            left = if sewing { length } else { gap };
        }
        left -= long - walked;
        if sewing {
            dash.push(Station { side, share: 1.0 });
        }
    }
    if sewing && dash.len() > 1 {
        all.push(dash);
    }
    all
}

/// Dashes of the polyline as polylines.
pub fn dashes(points: &[Vec3], length: f32, gap: f32) -> Vec<Vec<Vec3>> {
    let line = |dash: Vec<Station>| dash.into_iter().map(|station| station.on(points)).collect();
    dash_stations(points, length, gap).into_iter().map(line).collect()
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

    #[test]
    fn stations_follow_the_line_wherever_it_goes() {
        let points = [Vec3::ZERO, Vec3::X * 0.004, Vec3::X * 0.01];
        let stations = dash_stations(&points, 0.003, 0.001);
        let lifted = points.map(|p| p * 2.0 + Vec3::Y);
        for (dash, line) in stations.iter().zip(dashes(&points, 0.003, 0.001)) {
            for (station, p) in dash.iter().zip(line) {
                assert!(station.on(&lifted).distance(p * 2.0 + Vec3::Y) < 1e-7);
            }
        }
        assert_eq!(stations.len(), 3);
        let corner = [Vec3::ZERO, Vec3::X * 0.1, Vec3::new(0.1, 0.095, 0.0)];
        assert_eq!(dashes(&corner, 0.03, 0.015)[2][1], corner[1], "the corner itself, to the bit");
    }
}
