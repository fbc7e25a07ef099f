//! The plain way: bounding boxes in columns across the strip, longest first.

use super::strip::Spot;
use super::{Nesting, Numbered};

/// The layout of bounding boxes in columns; `numbers` are the ways in which each shape fits the strip.
pub(super) fn shelves(nesting: &Nesting, numbers: &[Vec<Numbered>]) -> Vec<Spot> {
    let boxed = |part: usize| {
        let shape = nesting.parts[part];
        let (number, turn, lower) = numbers[shape][0];
        let upper = nesting.shapes[shape][turn].iter().copied().reduce(glam::DVec2::max).unwrap_or_default();
        (number, upper - lower)
    };
    let mut order: Vec<usize> = (0..nesting.parts.len()).collect();
    order.sort_by(|&i, &j| boxed(j).1.x.total_cmp(&boxed(i).1.x).then(i.cmp(&j)));
    let mut spots = vec![Spot { turned: 0, x: 0.0, y: 0.0 }; order.len()];
    // Of each column: where it begins, how long it is, and the height up to which it is full.
    let mut columns: Vec<[f64; 3]> = Vec::new();
    for part in order {
        let (turned, size) = boxed(part);
        let free = columns.iter_mut().find(|column| column[2] + size.y <= nesting.width + 1e-9);
        let column = match free {
            Some(column) => column,
            None => {
                let x = columns.last().map_or(0.0, |last| last[0] + last[1] + nesting.gap);
                columns.push([x, size.x, 0.0]);
                columns.last_mut().unwrap_or_else(|| unreachable!("one was pushed"))
            }
        };
        spots[part] = Spot { turned, x: column[0], y: column[2] };
        column[2] += size.y + nesting.gap;
    }
    spots
}
