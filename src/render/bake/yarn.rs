//! Threads of cloth on the processor: the formulas of shaders/textile.wgsl, function by function. Noise repeats after a whole
//! number of cells, so that a texture of it tiles.

use std::f32::consts::PI;

use glam::{IVec2, Vec2};

use crate::render::wgsl::{mix, smoothstep};

/// A place of the cloth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Yarn {
    /// Height of the surface, 0 in the gaps..1 on top of a thread.
    pub height: f32,
    /// Share of the second colour, 0..=1.
    pub second: f32,
}

/// Noise on a lattice that repeats after so many cells; zero: never.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Lattice(pub IVec2);

impl Lattice {
    fn wrapped(self, cell: IVec2) -> IVec2 {
        let one = |c: i32, n: i32| if n > 0 { c.rem_euclid(n) } else { c };
        IVec2::new(one(cell.x, self.0.x), one(cell.y, self.0.y))
    }

    fn hash(self, cell: IVec2) -> f32 {
        hash(self.wrapped(cell))
    }

    /// The lattice of the same repeat where lengths are multiplied by `scale`.
    fn scaled(self, scale: Vec2) -> Self {
        Self((self.0.as_vec2() * scale).round().as_ivec2())
    }

    /// Value noise, 0..1, one bump a unit.
    pub fn noise(self, p: Vec2) -> f32 {
        let cell = p.floor();
        let part = p - cell;
        let t = part * part * (Vec2::splat(3.0) - 2.0 * part);
        let cell = cell.as_ivec2();
        let at = |x, y| self.hash(cell + IVec2::new(x, y));
        let low = mix(at(0, 0), at(1, 0), t.x);
        let high = mix(at(0, 1), at(1, 1), t.x);
        mix(low, high, t.y)
    }

    fn noise_at(self, p: Vec2, scale: Vec2) -> f32 {
        self.scaled(scale).noise(p * scale)
    }

    /// Distances to the nearest and the second nearest of scattered points, one a unit.
    fn nearest_two(self, p: Vec2) -> [f32; 2] {
        let cell = p.floor().as_ivec2();
        let mut best = [9.0_f32; 2];
        for i in -1..=1 {
            for j in -1..=1 {
                let other = cell + IVec2::new(i, j);
                let key = self.wrapped(other);
                let place = other.as_vec2() + Vec2::new(hash(key), hash(key + IVec2::new(57, 113)));
                let far = p.distance(place);
                best = if far < best[0] { [far, best[0]] } else { [best[0], best[1].min(far)] };
            }
        }
        best
    }
}

fn hash(cell: IVec2) -> f32 {
    let mut n =
        (cell.x as u32).wrapping_mul(0x9e37_79b9).wrapping_add((cell.y as u32).wrapping_mul(0x85eb_ca6b));
    n = (n ^ (n >> 16)).wrapping_mul(0x7feb_352d);
    n = (n ^ (n >> 15)).wrapping_mul(0x846c_a68b);
    ((n ^ (n >> 16)) >> 8) as f32 / 16_777_216.0
}

fn fract(x: f32) -> f32 {
    x - x.floor()
}

fn fract2(p: Vec2) -> Vec2 {
    p - p.floor()
}

/// Threads along y over n - 1 of n threads across, each column moved on by `step`.
fn woven(p: Vec2, n: f32, step: f32) -> Yarn {
    let column = p.x.floor();
    let along = (p.y + step * column).rem_euclid(n);
    let f = fract2(p) - 0.5;
    let round_warp = (1.0 - 3.6 * f.x * f.x).max(0.0).sqrt();
    let round_weft = (1.0 - 3.6 * f.y * f.y).max(0.0).sqrt();
    let from_crossing = (along - 0.5).abs().min(n - (along - 0.5).abs());
    let warp = round_warp * mix(0.2, 1.0, smoothstep(0.1, 1.0, from_crossing));
    let weft = round_weft * if along < 1.0 { mix(0.3, 1.0, (PI * f.x).cos()) } else { 0.2 };
    Yarn { height: warp.max(weft), second: f32::from(weft > warp) }
}

/// Columns of stitches, each a pair of slanting legs.
fn knitted(p: Vec2) -> f32 {
    let x = (fract(p.x) - 0.5).abs();
    let across = (x - 0.25) / 0.25;
    let along = fract(p.y - 1.3 * x);
    (1.0 - across * across).max(0.0).sqrt() * (0.45 + 0.55 * (PI * along).sin())
}

/// Hexagons: the distance to the borders between two grids of points.
fn net(p: Vec2) -> f32 {
    let size = Vec2::new(1.0, 3.0_f32.sqrt());
    let one = (p - size * (p / size).round()).abs();
    let two = (p - size * ((p / size).floor() + 0.5)).abs();
    let q = if one.length_squared() < two.length_squared() { one } else { two };
    let border = 0.5 - q.x.max(q.dot(Vec2::new(0.5, 0.866_025_4)));
    1.0 - smoothstep(0.07, 0.12, border)
}

/// The yarn of a weave at the place `p` in threads: x across the grain, y along it. The kinds are those of `Weave`.
pub(super) fn yarn(kind: u32, p: Vec2, lattice: Lattice) -> Yarn {
    let of = |height| Yarn { height, second: 0.0 };
    match kind {
        1 => woven(p, 2.0, 1.0),
        2 => woven(p, 4.0, 1.0),
        3 => woven(p, 5.0, 2.0),
        4 => of(knitted(p)),
        5 => {
            let wale = 0.5 + 0.5 * (PI / 2.0 * p.x).cos();
            of(0.75 * smoothstep(0.0, 0.9, wale) + 0.25 * knitted(p))
        }
        6 => {
            let wale = (PI * p.x).sin().abs();
            of(wale.powf(0.7) * 0.85 + 0.15 * lattice.noise_at(p, Vec2::new(9.0, 5.0)))
        }
        7 => of(net(p)),
        8 => {
            let [near, next] = lattice.nearest_two(p);
            let crease = smoothstep(0.02, 0.22, next - near);
            of(crease * (0.85 + 0.15 * lattice.noise_at(p, Vec2::splat(5.0))))
        }
        9 => {
            let octave = |scale| lattice.noise_at(p, Vec2::splat(scale));
            of(0.6 * octave(1.0) + 0.3 * octave(2.3) + 0.1 * octave(5.1))
        }
        _ => of(1.0),
    }
}

/// The mean over a repeat.
pub(super) fn mean_yarn(kind: u32) -> Yarn {
    let (height, second) = match kind {
        1 => (0.64, 0.45),
        2 => (0.73, 0.22),
        3 => (0.75, 0.18),
        4 => (0.63, 0.0),
        5 => (0.56, 0.0),
        6 | 8 => (0.67, 0.0),
        7 => (0.9, 0.0),
        9 => (0.5, 0.0),
        _ => (1.0, 0.0),
    };
    Yarn { height, second }
}

/// The number of threads after which the weave repeats, and its noise with it.
pub(super) fn repeat(kind: u32) -> Vec2 {
    match kind {
        1 => Vec2::splat(2.0),
        2 => Vec2::splat(4.0),
        3 => Vec2::splat(5.0),
        4 => Vec2::ONE,
        5 => Vec2::new(4.0, 1.0),
        6 => Vec2::splat(4.0),
        7 => Vec2::new(1.0, 3.0_f32.sqrt()),
        // 2.3 and 5.1 bumps a unit come out even after ten.
        _ => Vec2::splat(10.0),
    }
}

/// Share of a stripe as wide as its gap, one a unit, averaged over `width` units.
fn stripe(x: f32, width: f32) -> f32 {
    let edge = (fract(x) - 0.5).abs() - 0.25;
    let sharp = (0.5 - edge / width.max(1e-4)).clamp(0.0, 1.0);
    mix(sharp, 0.5, smoothstep(0.4, 1.0, width))
}

/// Share of the print's colour at the place `p` in repeats, averaged over `width` repeats. The kinds are those of `Motif`.
pub(super) fn printed(kind: u32, p: Vec2, width: f32) -> f32 {
    match kind {
        1 => stripe(p.x, width),
        2 => stripe(p.y, width),
        3 => 0.5 * (stripe(p.x, width) + stripe(p.y, width)),
        4 => {
            let row = (p.y * 2.0).floor();
            let x = fract(p.x + 0.5 * row.rem_euclid(2.0)) - 0.5;
            let q = Vec2::new(x, (fract(p.y * 2.0) - 0.5) * 0.5);
            let sharp = (0.5 - (q.length() - 0.15) / width.max(1e-4)).clamp(0.0, 1.0);
            mix(sharp, 0.141, smoothstep(0.3, 0.8, width))
        }
        _ => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_weave_repeats_and_has_its_mean() {
        for kind in 1..=9 {
            let size = repeat(kind);
            let lattice = Lattice(size.round().as_ivec2());
            let (mut height, mut second) = (0.0, 0.0);
            let n = 120;
            for k in 0..n * n {
                let p = Vec2::new((k % n) as f32 + 0.5, (k / n) as f32 + 0.5) / n as f32 * size;
                let here = yarn(kind, p, lattice);
                let next = yarn(kind, p + size, lattice);
                assert!((here.height - next.height).abs() < 2e-2, "{kind} at {p}: {here:?}, {next:?}");
                assert!((-1e-3..=1.001).contains(&here.height), "{kind} at {p}: {here:?}");
                height += here.height / (n * n) as f32;
                second += here.second / (n * n) as f32;
            }
            let mean = mean_yarn(kind);
            // A net's holes have no height: its mean is that of its threads.
            let near = if kind == 7 { 1.0 } else { 0.12 };
            assert!((mean.height - height).abs() < near, "{kind}: {height} {mean:?}");
            assert!((mean.second - second).abs() < 0.12, "{kind}: {second} {mean:?}");
        }
    }

    #[test]
    fn prints_cover_half_or_what_their_dots_do() {
        for (kind, share) in [(1, 0.5), (2, 0.5), (3, 0.5), (4, 0.141)] {
            let n = 100;
            let place = |k: usize| Vec2::new((k % n) as f32 + 0.5, (k / n) as f32 + 0.5) / n as f32;
            let sum: f32 = (0..n * n).map(|k| printed(kind, place(k), 0.01)).sum();
            assert!((sum / (n * n) as f32 - share).abs() < 0.01, "{kind}: {sum}");
            assert!((printed(kind, Vec2::ZERO, 2.0) - share).abs() < 1e-6, "blurred");
        }
    }
}
