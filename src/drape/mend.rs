//! Cloth that has run through itself in a few places for good is laid smoother there, and folds anew.
//!
//! A fold that was drawn past shut, say where sleeve and side are sewn together in an armpit, does not open by small ways: whichever
//! layer is sent where it belongs meets the next. So the cloth round such a place is taken out of the fold at once: it becomes
//! like a film spanned in what is round about, with the body before it. A film has no folds. What is too much cloth in it swells
//! once it is let go, and is kept apart from itself on the whole way.

use glam::DVec3;

use crate::body::Surface;
use crate::drape::sheet::Sheet;

/// A side's share in the film is no smaller than this, by its cotangents: what is flat counts as if it were less so.
const LEAST_SHARE: f64 = 0.1;

/// A part of the cloth that becomes a film.
#[derive(Clone, Debug)]
pub struct Film {
    /// In the order in which they are moved.
    pub vertices: Vec<u32>,
    /// For each its neighbours with their shares.
    rows: Vec<Vec<(u32, f64)>>,
}

impl Film {
    /// Of these vertices of `sheet`.
    pub fn new(sheet: &Sheet, vertices: Vec<u32>) -> Self {
        let rows = vertices.iter().map(|&v| row(sheet, v)).collect();
        Self { vertices, rows }
    }

    /// Makes it smoother, by so many sweeps over it, no nearer to the body than `distance` metres.
    pub fn smooth(&self, x: &mut [DVec3], sweeps: usize, surface: &Surface, distance: f64) {
        for _ in 0..sweeps {
            for (&v, row) in self.vertices.iter().zip(&self.rows) {
                x[v as usize] = row.iter().map(|&(w, share)| x[w as usize] * share).sum();
            }
        }
        for &v in &self.vertices {
            let near = surface.nearest(x[v as usize]);
            if near.distance < distance {
                x[v as usize] = near.point + near.normal * distance;
            }
        }
    }
}

/// The neighbours of `v` with the share each has in where the film puts it: cotangents of the flat cloth, never negative.
fn row(sheet: &Sheet, v: u32) -> Vec<(u32, f64)> {
    let mut row: Vec<(u32, f64)> = Vec::new();
    for &t in sheet.adjacency.vertex_triangles.of(v) {
        let (vs, corners) = (sheet.triangles[t as usize], sheet.rest[t as usize]);
        for k in 0..3 {
            let [a, b] = [vs[(k + 1) % 3], vs[(k + 2) % 3]];
            if a != v && b != v {
                continue;
            }
            let [to_a, to_b] = [corners[(k + 1) % 3], corners[(k + 2) % 3]].map(|p| p - corners[k]);
            let cotangent = to_a.dot(to_b) / to_a.perp_dot(to_b);
            let other = if a == v { b } else { a };
            match row.iter_mut().find(|(w, _)| *w == other) {
                Some((_, share)) => *share += cotangent,
                None => row.push((other, cotangent)),
            }
        }
    }
    row.iter_mut().for_each(|(_, share)| *share = share.max(LEAST_SHARE));
    let whole: f64 = row.iter().map(|(_, share)| share).sum();
    row.iter_mut().for_each(|(_, share)| *share /= whole);
    row
}

#[cfg(test)]
mod tests {
    use glam::DVec2;

    use super::*;
    use crate::geometry::shapes::cylinder;

    /// A strip of cloth along x, `count` squares of a centimetre and two of them wide.
    fn strip(count: u32) -> Sheet {
        let flat = |v: u32| DVec2::new(f64::from(v / 3), f64::from(v % 3)) * 0.01;
        let squares = (0..count).flat_map(|i| [3 * i, 3 * i + 1]);
        let triangles: Vec<[u32; 3]> = squares.flat_map(|a| [[a, a + 3, a + 4], [a, a + 4, a + 1]]).collect();
        let rest = triangles.iter().map(|vs| vs.map(flat)).collect();
        Sheet::new(3 * (count as usize + 1), triangles, rest).expect("a sheet")
    }

    /// A body 0.1 m thick along y through (0, 0, z).
    fn column(z: f64) -> Surface {
        let mut mesh = cylinder(0.05, 0.6, 48, 24);
        mesh.positions.iter_mut().for_each(|p| *p += DVec3::new(0.0, -0.3, z));
        Surface::new(mesh).expect("a body")
    }

    fn lying(sheet: &Sheet) -> Vec<DVec3> {
        (0..sheet.len()).map(|v| DVec3::new(0.01 * (v / 3) as f64, 0.01 * (v % 3) as f64, 0.0)).collect()
    }

    #[test]
    fn a_fold_becomes_flat_and_flat_cloth_stays() {
        let sheet = strip(20);
        let flat = lying(&sheet);
        let mut x = flat.clone();
        // A ridge that leans over and lies on what is beside it.
        (27..36).for_each(|v| x[v] += DVec3::new(0.02, 0.0, 0.015));
        let film = Film::new(&sheet, (15..48).collect());
        film.smooth(&mut x, 400, &column(9.0), 0.002);
        assert!(x.iter().all(|p| p.z.abs() < 1e-4), "a fold is left");
        assert!(x.windows(4).all(|w| w[3].x > w[0].x), "it runs back");
        // In the midst of it: at a border a film draws itself in.
        let mut x = flat.clone();
        Film::new(&sheet, vec![31]).smooth(&mut x, 1, &column(9.0), 0.002);
        assert!(x.iter().zip(&flat).all(|(now, then)| now.distance(*then) < 1e-12));
    }

    #[test]
    fn the_body_stays_before_it() {
        let sheet = strip(20);
        // Over a column, whose front is at 0.05.
        let mut x = lying(&sheet);
        x.iter_mut().for_each(|p| *p += DVec3::new(-0.1, 0.0, 0.06));
        let body = column(0.0);
        let film = Film::new(&sheet, (15..48).collect());
        (0..6).for_each(|v| x[v].z = -0.05);
        (57..63).for_each(|v| x[v].z = -0.05);
        film.smooth(&mut x, 50, &body, 0.002);
        for &v in &film.vertices {
            let distance = body.nearest(x[v as usize]).distance;
            assert!(distance > 0.002 - 1e-6, "{v} {distance}");
        }
    }
}
