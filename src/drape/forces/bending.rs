//! Bending: an energy that is quadratic in the positions and exact for cylinders on any mesh.
//!
//! Each vertex gets the second derivatives x,11 x,12 x,22 from a quadratic fitted by weighted least squares to it and its
//! neighbours, unfolded into the pattern plane. On an isometrically bent surface these vectors are normal to the surface, so
//! their dot products are the products of the curvatures: the energy A/2 (B1 |x,11|² + B2 |x,22|² + 2 B12 x,11·x,22 + 4 B33
//! |x,12|²) needs no normal, is quadratic and invariant under rotation.
//!
//! This differs from the smoothed hinge of Liang (arXiv 2502.10872) in two ways. It needs no lagged normal. And it fits more than
//! the six corners of a triangle and its neighbours: such a fit measures the energy of a cylinder as exactly, but leaves
//! deformations without energy. Where the diagonals of a mesh alternate, all those stencils are centred on every other vertex,
//! and a cantilever hangs down more than twice as far as it should.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use crate::cloth::fabric::Bending as Stiffness;
use crate::drape::sheet::Sheet;
use crate::geometry::parallel::LEAST_SUMS;

/// Bending energy as a sparse symmetric matrix Q, N/m: xᵀQx/2 in each axis.
#[derive(Clone, Debug)]
pub struct Bending {
    /// Row starts in `columns` and `values`.
    starts: Vec<u32>,
    columns: Vec<u32>,
    values: Vec<f64>,
}

/// Second derivatives at a vertex as weighted sums over nearby vertices, 1/m².
#[derive(Clone, Debug)]
pub struct Stencil {
    /// Vertices of the sums.
    pub vertices: Vec<u32>,
    /// Weight of each vertex in x,11 (warp), x,22 (weft) and x,12.
    pub weights: Vec<[f64; 3]>,
}

impl Bending {
    /// Bending of all of `sheet`; an empty matrix where the stiffness is zero.
    pub fn new(sheet: &Sheet, stiffness: &Stiffness) -> Self {
        Self::of(sheet, |_| stiffness)
    }

    /// Bending of `sheet` with a stiffness for each vertex.
    pub fn of<'a>(sheet: &Sheet, stiffness: impl Fn(u32) -> &'a Stiffness) -> Self {
        Self::summed(sheet.len(), &energies(sheet, stiffness), &[])
    }

    /// Bending like [`Self::of`], but softened round vertices that with their `mass` (kg) would oscillate at an angular frequency
    /// above `rate` (1/s, by Gershgorin's bound); these are corners of slivers. Explicit steps are stable up to a certain
    /// frequency. Where no vertex exceeds it the result equals [`Self::of`] bit for bit.
    pub fn slower_than<'a>(
        rate: f64,
        mass: &[f64],
        sheet: &Sheet,
        stiffness: impl Fn(u32) -> &'a Stiffness,
    ) -> Self {
        let energies = energies(sheet, stiffness);
        let limit = |i: usize| rate * rate * mass[i];
        let mut bending = Self::summed(sheet.len(), &energies, &[]);
        let (mut is_fast, mut whole) = (vec![false; sheet.len()], Vec::new());
        loop {
            // Vertices softened once keep to their limit in later rounds. Entries cancel less after softening, so others may
            // exceed theirs.
            let faster = (0..sheet.len()).filter(|&i| !is_fast[i] && bending.stiffest(i) > limit(i));
            let faster: Vec<usize> = faster.collect();
            if faster.is_empty() {
                return bending;
            }
            faster.into_iter().for_each(|i| is_fast[i] = true);
            if whole.is_empty() {
                whole.resize(sheet.len(), 0.0);
                for energy in &energies {
                    energy.entries.iter().for_each(|&(i, _, q)| whole[i as usize] += q.abs());
                }
            }
            let share = |energy: &Energy| {
                let fast = energy.stencil.iter().map(|&v| v as usize).filter(|&v| is_fast[v]);
                fast.map(|v| (limit(v) / whole[v]).min(1.0)).fold(1.0, f64::min)
            };
            let shares: Vec<f64> = energies.iter().map(share).collect();
            bending = Self::summed(sheet.len(), &energies, &shares);
        }
    }

    /// Gershgorin's bound of the stiffness at vertex `i`, N/m.
    pub fn stiffest(&self, i: usize) -> f64 {
        self.row(i).map(|(_, q)| q.abs()).sum()
    }

    /// The sum of `energies`, each times its entry in `shares`; empty `shares` leave all of them whole.
    fn summed(rows: usize, energies: &[Energy], shares: &[f64]) -> Self {
        let mut entries: Vec<(u32, u32, f64)> = match shares {
            [] => energies.iter().flat_map(|energy| energy.entries.iter().copied()).collect(),
            _ => energies
                .iter()
                .zip(shares)
                .flat_map(|(energy, share)| energy.entries.iter().map(move |&(i, j, q)| (i, j, q * share)))
                .collect(),
        };
        entries.sort_by_key(|&(i, j, _)| (i, j));
        let (mut columns, mut values) = (Vec::new(), Vec::<f64>::new());
        let mut starts = vec![0u32; rows + 1];
        let mut last = None;
        for (i, j, value) in entries {
            match values.last_mut() {
                Some(sum) if last == Some((i, j)) => *sum += value,
                _ => {
                    columns.push(j);
                    values.push(value);
                    starts[i as usize + 1] += 1;
                }
            }
            last = Some((i, j));
        }
        for i in 0..rows {
            starts[i + 1] += starts[i];
        }
        Self { starts, columns, values }
    }

    /// Bending energy, J.
    pub fn energy(&self, x: &[DVec3]) -> f64 {
        (0..x.len()).map(|i| (x[i] - x[0]).dot(self.row_times(i, x))).sum::<f64>() / 2.0
    }

    /// Adds the gradient, N, and returns the energy, J.
    pub fn add_gradient(&self, x: &[DVec3], gradient: &mut [DVec3]) -> f64 {
        if self.values.is_empty() {
            return 0.0;
        }
        let mut energy = 0.0;
        for (i, g) in gradient.iter_mut().enumerate() {
            let force = self.row_times(i, x);
            energy += force.dot(x[i] - x[0]) / 2.0;
            *g += force;
        }
        energy
    }

    /// Writes the gradient, N, of each vertex times its `factor`.
    pub fn write_forces(&self, x: &[DVec3], forces: &mut [DVec3], factor: impl Fn(usize) -> f64 + Sync) {
        let rows = forces.par_iter_mut().enumerate().with_min_len(LEAST_SUMS);
        rows.for_each(|(i, force)| *force = self.row_times(i, x) * factor(i));
    }

    /// Entries of row `i`: column and value (N/m).
    pub fn row(&self, i: usize) -> impl Iterator<Item = (u32, f64)> {
        let range = self.starts[i] as usize..self.starts[i + 1] as usize;
        self.columns[range.clone()].iter().copied().zip(self.values[range].iter().copied())
    }

    fn row_times(&self, i: usize, x: &[DVec3]) -> DVec3 {
        // Rows sum to zero: summing differences to x_i keeps precision far from the origin.
        let range = self.starts[i] as usize..self.starts[i + 1] as usize;
        let (at, mut sum) = (x[i], DVec3::ZERO);
        for (&j, &q) in self.columns[range.clone()].iter().zip(&self.values[range]) {
            sum += (x[j as usize] - at) * q;
        }
        sum
    }
}

/// Mixed Voronoi area of each vertex, m² (Meyer et al. 2003, 3.3): of an obtuse triangle half goes to the obtuse corner. Where
/// vertex valences differ, a third of each triangle would make every other vertex, and so all the cloth, bend more easily.
fn nearest_areas(sheet: &Sheet) -> Vec<f64> {
    let mut areas = vec![0.0; sheet.len()];
    for ((vs, p), area) in sheet.triangles.iter().zip(&sheet.rest).zip(&sheet.areas) {
        let sides = [0, 1, 2].map(|k| (p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]));
        let obtuse = sides.iter().position(|(u, v)| u.dot(*v) < 0.0);
        let cotangents = sides.map(|(u, v)| u.dot(v) / (2.0 * area));
        for k in 0..3 {
            let (u, v) = sides[k];
            let [b, c] = [cotangents[(k + 1) % 3], cotangents[(k + 2) % 3]];
            areas[vs[k] as usize] += match obtuse {
                Some(at) => area * if at == k { 0.5 } else { 0.25 },
                None => (u.length_squared() * c + v.length_squared() * b) / 8.0,
            };
        }
    }
    areas
}

/// Bending energy of the cloth nearest to one vertex.
struct Energy {
    /// Vertices that it depends on.
    stencil: Vec<u32>,
    /// Matrix entries: row, column and value, N/m.
    entries: Vec<(u32, u32, f64)>,
}

/// Bending energies of a sheet; across its creases there is none.
fn energies<'a>(sheet: &Sheet, stiffness: impl Fn(u32) -> &'a Stiffness) -> Vec<Energy> {
    let Some((parted, whole)) = sheet.parted() else { return smooth_energies(sheet, stiffness) };
    let mut energies = smooth_energies(&parted, |v| stiffness(whole[v as usize]));
    for energy in &mut energies {
        energy.stencil.iter_mut().for_each(|v| *v = whole[*v as usize]);
        for (i, j, _) in &mut energy.entries {
            (*i, *j) = (whole[*i as usize], whole[*j as usize]);
        }
    }
    energies
}

fn smooth_energies<'a>(sheet: &Sheet, stiffness: impl Fn(u32) -> &'a Stiffness) -> Vec<Energy> {
    let of = |(v, area): (usize, f64)| {
        let own = stiffness(v as u32);
        if own.warp <= 0.0 && own.weft <= 0.0 && own.bias <= 0.0 {
            return None;
        }
        let stencil = stencil(sheet, v as u32)?;
        let entries = entries(&stencil, own, area);
        Some(Energy { stencil: stencil.vertices, entries })
    };
    nearest_areas(sheet).into_iter().enumerate().filter_map(of).collect()
}

fn entries(stencil: &Stencil, b: &Stiffness, area: f64) -> Vec<(u32, u32, f64)> {
    let (cross, twist) = (b.cross(), b.twist());
    let mut entries = Vec::with_capacity(stencil.vertices.len().pow(2));
    for (&i, a) in stencil.vertices.iter().zip(&stencil.weights) {
        for (&j, c) in stencil.vertices.iter().zip(&stencil.weights) {
            let along = b.warp * a[0] * c[0] + b.weft * a[1] * c[1];
            let across = cross * (a[0] * c[1] + a[1] * c[0]);
            entries.push((i, j, area * (along + across + 4.0 * twist * a[2] * c[2])));
        }
    }
    entries
}

/// Finite-difference stencil of the second derivatives at vertex `v` of `sheet`: over its neighbours or, on the border and where
/// these are too few, also over their neighbours. None where even those do not determine a quadratic.
pub fn stencil(sheet: &Sheet, v: u32) -> Option<Stencil> {
    let t = *sheet.adjacency.vertex_triangles.of(v).first()?;
    let own = sheet.rest[t as usize];
    let k = sheet.triangles[t as usize].iter().position(|&c| c == v)?;
    let size = sheet.areas[t as usize].sqrt();
    let round = |t: u32, _: usize| sheet.triangles[t as usize].contains(&v);
    let near = patch(sheet, t, &own, round);
    let inner = sheet.adjacency.vertex_triangles.of(v).len() + 1 == near.len();
    if inner && let Some(stencil) = fitted(&near, own[k], size) {
        return Some(stencil);
    }
    let beside = |t: u32, steps: usize| {
        let vs = sheet.triangles[t as usize];
        steps < 8 && vs.iter().any(|&c| near.iter().any(|&(n, _)| n == c))
    };
    fitted(&patch(sheet, t, &own, beside), own[k], size)
}

/// Vertices of `t` and of the triangles reached from it, unfolded into the plane of `t`. `goes` tells whether to step into a
/// triangle after that many steps.
fn patch(sheet: &Sheet, t: u32, own: &[DVec2; 3], goes: impl Fn(u32, usize) -> bool) -> Vec<(u32, DVec2)> {
    let mut points: Vec<(u32, DVec2)> = sheet.triangles[t as usize].into_iter().zip(*own).collect();
    let mut laid = vec![(t, *own, 0)];
    let mut at = 0;
    while at < laid.len() {
        let (from, corners, steps) = laid[at];
        for k in 0..3 {
            let Some((other, flat)) = sheet.unfolded(from, &corners, k) else { continue };
            if goes(other, steps) && laid.iter().all(|&(known, ..)| known != other) {
                laid.push((other, flat, steps + 1));
                for (v, p) in sheet.triangles[other as usize].into_iter().zip(flat) {
                    if points.iter().all(|&(known, _)| known != v) {
                        points.push((v, p));
                    }
                }
            }
        }
        at += 1;
    }
    points
}

/// Least-squares quadratic through `points`, weighted by nearness to `centre`; for six points it interpolates them. None where it
/// is ill-conditioned.
fn fitted(points: &[(u32, DVec2)], centre: DVec2, size: f64) -> Option<Stencil> {
    if points.len() < 6 {
        return None;
    }
    let rows: Vec<[f64; 6]> = points.iter().map(|&(_, p)| monomials((p - centre) / size)).collect();
    let nearness: Vec<f64> =
        points.iter().map(|&(_, p)| (0.1 + (p - centre).length_squared() / (size * size)).powi(-2)).collect();
    let mut normal = [[0.0; 6]; 6];
    for (row, w) in rows.iter().zip(&nearness) {
        for i in 0..6 {
            for j in 0..6 {
                normal[i][j] += w * row[i] * row[j];
            }
        }
    }
    let inverse = inverse(normal)?;
    let second = |row: &[f64; 6], w: f64, of: usize| -> f64 {
        (0..6).map(|j| inverse[of][j] * row[j]).sum::<f64>() * w / (size * size)
    };
    let weights: Vec<[f64; 3]> =
        rows.iter().zip(&nearness).map(|(row, &w)| [4, 3, 5].map(|of| second(row, w, of))).collect();
    // The largest coefficient of a second derivative: a fit beyond twenty amplifies noise.
    let gain = weights.iter().flatten().fold(0.0, |most: f64, w| most.max(w.abs())) * size * size;
    (gain <= 20.0).then(|| Stencil { vertices: points.iter().map(|&(v, _)| v).collect(), weights })
}

/// Monomials of a quadratic: 1, u, v, u²/2, v²/2, uv.
fn monomials(p: DVec2) -> [f64; 6] {
    [1.0, p.x, p.y, p.x * p.x / 2.0, p.y * p.y / 2.0, p.x * p.y]
}

/// Inverse matrix by Gauss–Jordan elimination with partial pivoting; None where it is singular.
fn inverse(mut a: [[f64; 6]; 6]) -> Option<[[f64; 6]; 6]> {
    let mut b = [[0.0; 6]; 6];
    (0..6).for_each(|i| b[i][i] = 1.0);
    let largest = a.iter().flatten().fold(0.0, |most: f64, v| most.max(v.abs()));
    // With a smaller pivot the points do not determine a quadratic.
    let least_pivot = 1e-6 * largest;
    for c in 0..6 {
        let pivot = (c..6).max_by(|&i, &j| a[i][c].abs().total_cmp(&a[j][c].abs()))?;
        if a[pivot][c].abs() <= least_pivot {
            return None;
        }
        a.swap(c, pivot);
        b.swap(c, pivot);
        let over = 1.0 / a[c][c];
        for j in 0..6 {
            a[c][j] *= over;
            b[c][j] *= over;
        }
        for i in (0..6).filter(|&i| i != c) {
            let times = a[i][c];
            for j in 0..6 {
                a[i][j] -= times * a[c][j];
                b[i][j] -= times * b[c][j];
            }
        }
    }
    Some(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A sheet of squares of 1 cm; the vertex in the middle lies `near` metres beside the one to its left.
    fn sheet(near: f64) -> Sheet {
        let at = |i: u32, j: u32| if (i, j) == (6, 6) { 0.05 + near } else { 0.01 * f64::from(i) };
        let point = |v: u32| DVec2::new(at(v % 13, v / 13), 0.01 * f64::from(v / 13));
        let cells = (0..144u32).map(|k| k / 12 * 13 + k % 12);
        let triangles: Vec<[u32; 3]> =
            cells.flat_map(|a| [[a, a + 1, a + 14], [a, a + 14, a + 13]]).collect();
        let rest = triangles.iter().map(|vs| vs.map(point)).collect();
        Sheet::new(169, triangles, rest).expect("a sheet")
    }

    fn fastest(bending: &Bending, mass: &[f64]) -> f64 {
        (0..mass.len()).map(|i| bending.stiffest(i) / mass[i]).fold(0.0, f64::max).sqrt()
    }

    #[test]
    fn only_what_is_too_stiff_for_its_steps_is_softened() {
        let plate = Stiffness { warp: 1e-5, weft: 1e-5, bias: 1e-5, poisson: 0.3 };
        let mass = |sheet: &Sheet| -> Vec<f64> { sheet.vertex_area.iter().map(|a| a * 0.15).collect() };
        let even = sheet(0.01);
        let (plain, rate) =
            (Bending::new(&even, &plate), fastest(&Bending::new(&even, &plate), &mass(&even)));
        let same = Bending::slower_than(rate * 1.001, &mass(&even), &even, |_| &plate);
        assert_eq!((&plain.columns, &plain.values), (&same.columns, &same.values));
        let sliver = sheet(2e-4);
        let mass = mass(&sliver);
        let (plain, soft) =
            (Bending::new(&sliver, &plate), Bending::slower_than(rate * 1.001, &mass, &sliver, |_| &plate));
        assert!(fastest(&plain, &mass) > 3.0 * rate, "{} of {rate}", fastest(&plain, &mass));
        assert!(fastest(&soft, &mass) <= rate * 1.002, "{} of {rate}", fastest(&soft, &mass));
        let corner = |v: usize| soft.row(v).zip(plain.row(v)).all(|(soft, plain)| soft == plain);
        assert!([0, 12, 156, 168].map(corner) == [true; 4], "far from the sliver it is as stiff as it was");
        let turned = |v: usize| DVec3::new(0.3, 0.01 * (v % 13) as f64, 0.01 * (v / 13) as f64);
        let bowl = |v: usize| turned(v) + DVec3::X * ((v * v) as f64 * 1e-4).sin() * 0.01;
        let energy = |bending: &Bending, of: &dyn Fn(usize) -> DVec3| {
            bending.energy(&(0..169).map(of).collect::<Vec<_>>())
        };
        let (least, whole) = (energy(&soft, &bowl), energy(&plain, &bowl));
        assert!(least > 0.0 && least <= whole, "{least} of {whole}");
    }
}
