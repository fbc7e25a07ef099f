//! Which chart each texel of a texture belongs to.

use glam::Vec2;

use super::Chart;

/// The owner of texels that belong to no chart.
pub(super) const NOBODY: u16 = u16::MAX;
/// Share of the covered texels that two charts may both cover and still count as side by side.
const SHARED: f64 = 2e-3;

/// The index of the chart of each texel of a square texture of `side` texels, rows from the top: charts cover their triangles and
/// `gutter` texels round them. Of charts that cover each other the first has the texel.
pub(super) fn owners(charts: &[Chart], side: u32, gutter: u32) -> Vec<u16> {
    let mut owners = vec![NOBODY; side as usize * side as usize];
    for (i, chart) in (0..NOBODY).zip(charts) {
        covered(chart, side, |at| {
            if owners[at] == NOBODY {
                owners[at] = i;
            }
        });
    }
    spread(&mut owners, side as usize, gutter);
    owners
}

/// Whether charts cover each other, as seen in a texture of `side` texels.
pub fn overlap(charts: &[Chart], side: u32) -> bool {
    let mut owners = vec![NOBODY; side as usize * side as usize];
    let (mut all, mut twice) = (0_usize, 0_usize);
    for (i, chart) in (0..NOBODY).zip(charts) {
        covered(chart, side, |at| {
            all += 1;
            twice += usize::from(![NOBODY, i].contains(&owners[at]));
            owners[at] = i;
        });
    }
    twice as f64 > SHARED * all as f64
}

/// Calls `found` with the index of every texel whose centre is in a triangle of `chart`.
fn covered(chart: &Chart, side: u32, mut found: impl FnMut(usize)) {
    let last = side as f32 - 1.0;
    for triangle in &chart.triangles {
        // In texels, rows from the top; centres at whole numbers.
        let [a, b, c] = triangle.map(|uv| Vec2::new(uv.x, 1.0 - uv.y) * side as f32 - 0.5);
        let doubled = (b - a).perp_dot(c - a);
        if !doubled.is_finite() || doubled == 0.0 {
            continue;
        }
        let low = a.min(b).min(c).ceil().clamp(Vec2::ZERO, Vec2::splat(last + 1.0));
        let high = a.max(b).max(c).floor().clamp(Vec2::splat(-1.0), Vec2::splat(last));
        for y in low.y as i32..=high.y as i32 {
            for x in low.x as i32..=high.x as i32 {
                let p = Vec2::new(x as f32, y as f32);
                let inside = [(a, b), (b, c), (c, a)]
                    .iter()
                    .all(|&(from, to)| (to - from).perp_dot(p - from) * doubled.signum() >= 0.0);
                if inside {
                    found(y as usize * side as usize + x as usize);
                }
            }
        }
    }
}

/// Gives free texels to the owner of a neighbour, `times` times over.
fn spread(owners: &mut [u16], width: usize, times: u32) {
    let mut border: Vec<usize> = (0..owners.len()).filter(|&at| owners[at] != NOBODY).collect();
    for _ in 0..times {
        let mut next = Vec::new();
        for at in border {
            let (x, owner) = (at % width, owners[at]);
            let beside = [(x > 0).then(|| at - 1), (x + 1 < width).then_some(at + 1)];
            let above = [at.checked_sub(width), Some(at + width).filter(|&below| below < owners.len())];
            for neighbour in beside.into_iter().chain(above).flatten() {
                if owners[neighbour] == NOBODY {
                    owners[neighbour] = owner;
                    next.push(neighbour);
                }
            }
        }
        border = next;
    }
}
