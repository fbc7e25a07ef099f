//! A smooth map of space that carries given points to given points (biharmonic spline).

use glam::{DMat3, DVec3};

/// A biharmonic spline: a weighted sum of the distances |x - p| to the given points p, plus an affine map; the
/// smoothest such map in space. Where the given points differ by an affine map, it is that map everywhere.
#[derive(Clone, Debug)]
pub struct Warp {
    points: Vec<DVec3>,
    weights: Vec<DVec3>,
    linear: DMat3,
    shift: DVec3,
}

impl Warp {
    /// The spline that takes the first point of each pair to the second. None with fewer than four pairs, with first
    /// points in one plane, or two at one position.
    pub fn new(pairs: &[(DVec3, DVec3)]) -> Option<Self> {
        let n = pairs.len();
        let size = n + 4;
        let mut rows = vec![vec![0.0; size + 3]; size];
        for (i, (p, image)) in pairs.iter().enumerate() {
            for (j, (q, _)) in pairs.iter().enumerate() {
                rows[i][j] = p.distance(*q);
            }
            let affine = [1.0, p.x, p.y, p.z];
            for (k, value) in affine.into_iter().enumerate() {
                (rows[i][n + k], rows[n + k][i]) = (value, value);
            }
            rows[i][size..].copy_from_slice(&image.to_array());
        }
        let solved = solved(rows)?;
        let shift = solved[n];
        let linear = DMat3::from_cols(solved[n + 1], solved[n + 2], solved[n + 3]);
        let points = pairs.iter().map(|(p, _)| *p).collect();
        Some(Self { points, weights: solved[..n].to_vec(), linear, shift })
    }

    /// The image of `p`.
    pub fn image(&self, p: DVec3) -> DVec3 {
        let bend: DVec3 = self.points.iter().zip(&self.weights).map(|(q, w)| *w * p.distance(*q)).sum();
        bend + self.linear * p + self.shift
    }
}

/// Solves the linear system whose last three columns are right-hand sides, by Gaussian elimination with partial
/// pivoting. None when it is singular.
fn solved(mut rows: Vec<Vec<f64>>) -> Option<Vec<DVec3>> {
    let n = rows.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|&i, &j| rows[i][k].abs().total_cmp(&rows[j][k].abs()))?;
        rows.swap(k, pivot);
        if rows[k][k].abs() < 1e-9 {
            return None;
        }
        let (above, below) = rows.split_at_mut(k + 1);
        for row in below {
            let factor = row[k] / above[k][k];
            for (value, known) in row[k..].iter_mut().zip(&above[k][k..]) {
                *value -= factor * known;
            }
        }
    }
    let mut found = vec![DVec3::ZERO; n];
    for k in (0..n).rev() {
        let rest: DVec3 = (k + 1..n).map(|j| found[j] * rows[k][j]).sum();
        found[k] = (DVec3::from_slice(&rows[k][n..]) - rest) / rows[k][k];
    }
    Some(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn corners() -> Vec<DVec3> {
        (0..8).map(|i| DVec3::new((i & 1) as f64, ((i >> 1) & 1) as f64, ((i >> 2) & 1) as f64)).collect()
    }

    #[test]
    fn points_go_where_they_should_and_affine_maps_are_exact() {
        let affine = |p: DVec3| DMat3::from_rotation_y(0.3) * p * DVec3::new(1.0, 2.0, 1.2) + DVec3::X;
        let pairs: Vec<_> = corners().into_iter().map(|p| (p, affine(p))).collect();
        let warp = Warp::new(&pairs).expect("a map");
        for p in [DVec3::new(0.3, 0.4, 0.9), DVec3::new(-2.0, 5.0, 1.0)] {
            assert!((warp.image(p) - affine(p)).length() < 1e-9);
        }
        let mut bent = pairs;
        bent[3].1 += DVec3::new(0.1, -0.2, 0.05);
        let warp = Warp::new(&bent).expect("a map");
        assert!(bent.iter().all(|(p, image)| (warp.image(*p) - *image).length() < 1e-9));
    }

    #[test]
    fn points_that_say_too_little_give_no_map() {
        let flat: Vec<_> = corners().into_iter().map(|p| (p.with_y(0.0), p)).collect();
        assert!(Warp::new(&flat[..2]).is_none() && Warp::new(&flat).is_none());
    }
}
