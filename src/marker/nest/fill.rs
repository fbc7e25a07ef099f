//! Bottom-left fill: one part after the other goes as far left as it can, and there as far down.

use super::strip::{Block, Spot, Strip, leftmost};

/// Distance of the heights that are tried besides those of contact, metres.
const STEP: f64 = 0.02;
/// Steps by which the best height is refined, metres.
const REFINED: [f64; 5] = [0.008, 0.004, 0.002, 0.001, 0.0005];

/// Lays the parts out in `order`. `work` is what is left to spend, in looks at a pair of parts; it is taken off.
pub fn fill(strip: &Strip<'_>, order: &[usize], work: &mut u64) -> Vec<Spot> {
    let mut placed: Vec<Spot> = Vec::with_capacity(order.len());
    for &part in order {
        let spot = best(strip, &strip.parts[part], &placed, work);
        placed.push(spot);
    }
    let mut spots = placed.clone();
    for (k, &part) in order.iter().enumerate() {
        spots[part] = placed[k];
    }
    spots
}

/// Moves parts to the left, one after the other from the left, wherever there is room, until none moves or `passes` are over.
pub fn compact(strip: &Strip<'_>, spots: &mut [Spot], passes: usize, work: &mut u64) {
    for _ in 0..passes {
        let mut order: Vec<usize> = (0..spots.len()).collect();
        order.sort_by(|&i, &j| spots[i].x.total_cmp(&spots[j].x).then(i.cmp(&j)));
        let mut has_moved = false;
        for i in order {
            let others: Vec<Spot> = (0..spots.len()).filter(|&j| j != i).map(|j| spots[j]).collect();
            let spot = best(strip, &strip.parts[i], &others, work);
            let end = |spot: &Spot| spot.x + strip.turned[spot.turned].size[0];
            if end(&spot) < end(&spots[i]) - 1e-6 {
                spots[i] = spot;
                has_moved = true;
            }
        }
        if !has_moved || *work == 0 {
            return;
        }
    }
}

/// The spot at which a part ends furthest left. Once the layout is stopped any spot will do: it is thrown away.
fn best(strip: &Strip<'_>, turns: &[usize], placed: &[Spot], work: &mut u64) -> Spot {
    let mut best: Option<(f64, Spot)> = None;
    let first = turns[0];
    let turns = if strip.watch.is_stopped() { &[] } else { turns };
    let (mut heights, mut blocks) = (Vec::new(), Vec::new());
    for &turned in turns {
        heights.clear();
        strip.contacts(turned, placed.iter(), &mut heights);
        let highest = strip.highest(turned);
        heights.extend((1..(highest / STEP).ceil() as usize).map(|k| k as f64 * STEP));
        let mut own: Option<(f64, Spot)> = None;
        for &y in &heights {
            take(&mut own, ends(strip, placed, turned, y, &mut blocks));
        }
        *work = work.saturating_sub((heights.len() * placed.len()) as u64);
        for step in REFINED {
            let Some((_, spot)) = own else { break };
            for y in [spot.y - step, spot.y + step] {
                if (0.0..=highest).contains(&y) {
                    take(&mut own, ends(strip, placed, turned, y, &mut blocks));
                }
            }
        }
        own.into_iter().for_each(|found| take(&mut best, found));
    }
    best.map_or(Spot { turned: first, x: 0.0, y: 0.0 }, |best| best.1)
}

/// Where a part would end at height `y`, and its spot there.
fn ends(strip: &Strip<'_>, placed: &[Spot], turned: usize, y: f64, blocks: &mut Vec<Block>) -> (f64, Spot) {
    strip.blocks(turned, y, placed.iter().map(|spot| (spot, 1.0)), blocks);
    let x = leftmost(blocks);
    (x + strip.turned[turned].size[0], Spot { turned, x, y })
}

/// Keeps what ends further left, or as far and lies lower.
fn take(best: &mut Option<(f64, Spot)>, found: (f64, Spot)) {
    let is_better = best.is_none_or(|(end, spot)| {
        found.0 < end - 1e-9 || (found.0 <= end + 1e-9 && found.1.y < spot.y - 1e-9)
    });
    if is_better {
        *best = Some(found);
    }
}
