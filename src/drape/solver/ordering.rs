//! Elimination order of a sparse factor: nested dissection along breadth-first levels (George 1973; George and Liu 1978).

use crate::geometry::adjacency::{Lists, NONE};

/// Parts of at most this many vertices are not divided further. Chosen by trial; it bounds how far an order of elimination with few
/// numbers in the factor is looked for.
const LEAST_PART: usize = 24;

/// Elimination order of all vertices of a graph, with little fill-in for meshes.
pub fn nested_dissection(neighbours: &Lists) -> Vec<u32> {
    let count = neighbours.len();
    let mut cut =
        Cut { neighbours, part: vec![0; count], parts: 0, level: vec![NONE; count], order: Vec::new() };
    let all: Vec<u32> = (0..count as u32).collect();
    // Separators come last, so the order is found backwards.
    let mut stack = vec![all];
    while let Some(part) = stack.pop() {
        cut.divide(part, &mut stack);
    }
    cut.order.reverse();
    cut.order
}

struct Cut<'a> {
    neighbours: &'a Lists,
    /// Number of the part that each vertex is in.
    part: Vec<u32>,
    parts: u32,
    /// Level of each vertex; [`NONE`] for those not reached.
    level: Vec<u32>,
    /// Elimination order, last vertex first.
    order: Vec<u32>,
}

impl Cut<'_> {
    fn divide(&mut self, part: Vec<u32>, stack: &mut Vec<Vec<u32>>) {
        self.parts += 1;
        part.iter().for_each(|&v| self.part[v as usize] = self.parts);
        if part.len() <= LEAST_PART {
            self.order.extend(part.iter().rev());
            return;
        }
        let far = *self.levels(&part, part[0]).last().unwrap_or(&part[0]);
        let far = *self.levels(&part, far).last().unwrap_or(&far);
        let reached = self.levels(&part, far);
        if reached.len() < part.len() {
            let rest = part.iter().copied().filter(|&v| self.level[v as usize] == NONE).collect();
            stack.push(rest);
            stack.push(reached);
            return;
        }
        let middle = self.middle_level(&reached);
        let (mut low, mut high, mut between) = (Vec::new(), Vec::new(), Vec::new());
        for &v in &reached {
            let level = self.level[v as usize];
            // Only vertices of the middle level that touch the upper half are needed in the separator.
            let touches =
                |w: &&u32| self.part[**w as usize] == self.parts && self.level[**w as usize] == middle + 1;
            match level.cmp(&middle) {
                std::cmp::Ordering::Less => low.push(v),
                std::cmp::Ordering::Greater => high.push(v),
                std::cmp::Ordering::Equal if self.neighbours.of(v).iter().any(|w| touches(&w)) => {
                    between.push(v)
                }
                std::cmp::Ordering::Equal => low.push(v),
            }
        }
        if low.is_empty() || high.is_empty() {
            self.order.extend(reached.iter().rev());
            return;
        }
        self.order.extend(between.iter().rev());
        stack.push(low);
        stack.push(high);
    }

    /// Breadth-first search from `from` within `part`: the vertices reached, nearest first. Stores their levels.
    fn levels(&mut self, part: &[u32], from: u32) -> Vec<u32> {
        part.iter().for_each(|&v| self.level[v as usize] = NONE);
        self.level[from as usize] = 0;
        let mut reached = vec![from];
        let mut at = 0;
        while at < reached.len() {
            let v = reached[at];
            for &w in self.neighbours.of(v) {
                if self.part[w as usize] == self.parts && self.level[w as usize] == NONE {
                    self.level[w as usize] = self.level[v as usize] + 1;
                    reached.push(w);
                }
            }
            at += 1;
        }
        reached
    }

    /// The smallest of the levels that leave at least a third of the other vertices on either side.
    fn middle_level(&self, reached: &[u32]) -> u32 {
        let last = self.level[reached[reached.len() - 1] as usize];
        let mut sizes = vec![0usize; last as usize + 1];
        reached.iter().for_each(|&v| sizes[self.level[v as usize] as usize] += 1);
        let (mut below, mut best) = (0, (usize::MAX, last / 2));
        for (level, &size) in sizes.iter().enumerate() {
            let above = reached.len() - below - size;
            if below.min(above) * 3 >= reached.len() - size && size < best.0 {
                best = (size, level as u32);
            }
            below += size;
        }
        best.1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_vertex_is_eliminated_once() {
        let at = |i: u32, j: u32| i * 20 + j;
        let mut pairs = Vec::new();
        for i in 0..20 {
            for j in 0..20 {
                let next = [(i + 1, j), (i, j + 1)].into_iter().filter(|&(a, b)| a < 20 && b < 20);
                next.for_each(|(a, b)| pairs.extend([(at(i, j), at(a, b)), (at(a, b), at(i, j))]));
            }
        }
        pairs.sort_unstable();
        // Two parts that do not touch, and a vertex alone.
        let twice: Vec<(u32, u32)> = pairs.iter().map(|&(a, b)| (a + 400, b + 400)).collect();
        pairs.extend(twice);
        let mut order = nested_dissection(&Lists::grouped(801, pairs.iter().copied()));
        order.sort_unstable();
        assert!(order.iter().copied().eq(0..801));
    }
}
