//! Independent subtrees of the elimination tree, which can be solved in parallel.

use std::ops::Range;

/// Number of columns below which a factor is solved on one thread.
const WORTH_IT: usize = 1500;
/// A subtree with more than this fraction of all work is split into those of its children.
const LARGE: f64 = 0.2;
/// Limit of the work above all subtrees, which one thread does, as a fraction of all work; beyond it no further
/// subtree is split.
const MOST_ABOVE: f64 = 0.5;

/// The elimination tree of supernodes (groups of columns), split into independent subtrees and the supernodes above
/// them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Trees {
    /// The subtrees, in order.
    pub parts: Vec<Part>,
    /// The supernodes above all subtrees, in order.
    pub top: Vec<usize>,
    /// The columns of the supernodes in `top`, in order.
    pub columns: Vec<usize>,
    /// Index of each column in `columns`; `u32::MAX` for columns of subtrees.
    pub place: Vec<u32>,
}

/// One subtree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// Its supernodes.
    pub groups: Range<usize>,
    /// Its columns.
    pub columns: Range<usize>,
}

impl Trees {
    /// Splits the elimination tree of supernodes that own `columns`. `parent` is a later supernode, or the number of
    /// supernodes for a root; `work` is a count of operations for each. The result is the same on any machine.
    pub fn new(columns: &[Range<usize>], parent: &[usize], work: &[usize]) -> Self {
        let groups = columns.len();
        let count = columns.last().map_or(0, |last| last.end);
        let mut below: Vec<usize> = work.to_vec();
        let mut first: Vec<usize> = (0..groups).collect();
        let mut sizes = vec![1; groups];
        for (group, &on) in parent.iter().enumerate().filter(|(_, on)| **on < groups) {
            below[on] += below[group];
            sizes[on] += sizes[group];
            first[on] = first[on].min(first[group]);
        }
        // The descendants of each supernode must come right before it; otherwise the tree is not split.
        let is_in_order = (0..groups).all(|g| g + 1 - first[g] == sizes[g]);
        let all: usize = work.iter().sum();
        let mut roots: Vec<usize> = Vec::new();
        let mut top: Vec<usize> = (0..groups).collect();
        if is_in_order && count >= WORTH_IT {
            (roots, top) = ((0..groups).filter(|&g| parent[g] >= groups).collect(), Vec::new());
            let mut above = 0;
            while let Some(at) = (0..roots.len()).max_by_key(|&at| (below[roots[at]], roots[at])) {
                let root = roots[at];
                above += work[root];
                if below[root] as f64 <= LARGE * all as f64 || above as f64 > MOST_ABOVE * all as f64 {
                    break;
                }
                roots.swap_remove(at);
                roots.extend((first[root]..root).filter(|&g| parent[g] == root));
                top.push(root);
            }
            roots.sort_unstable();
            top.sort_unstable();
        }
        let part = |&root: &usize| Part {
            groups: first[root]..root + 1,
            columns: columns[first[root]].start..columns[root].end,
        };
        let on_top: Vec<usize> = top.iter().flat_map(|&g| columns[g].clone()).collect();
        let mut place = vec![u32::MAX; count];
        on_top.iter().enumerate().for_each(|(at, &column)| place[column] = at as u32);
        Self { parts: roots.iter().map(part).collect(), top, columns: on_top, place }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_halves_of_a_chain_of_groups_meet_at_the_top() {
        // Two chains of 1,000 columns each, then one group they both hang on.
        let columns: Vec<Range<usize>> =
            (0..2000).map(|k| k..k + 1).chain(std::iter::once(2000..2040)).collect();
        let parent: Vec<usize> =
            (0..2000).map(|k| if k == 999 { 2000 } else { k + 1 }).chain([2001]).collect();
        let mut work = vec![10; 2000];
        work.push(2000);
        let trees = Trees::new(&columns, &parent, &work);
        // The chains are cut up at their ends until what is left of them is small enough.
        assert_eq!(trees.parts.len(), 2);
        assert!(trees.top.ends_with(&[2000]) && trees.columns.ends_with(&[2038, 2039]));
        let held: usize = trees.parts.iter().map(|part| part.columns.len()).sum();
        assert_eq!(held + trees.columns.len(), 2040);
        assert!(trees.parts.iter().all(|part| part.columns.clone().all(|c| trees.place[c] == u32::MAX)));
        assert!(trees.columns.iter().enumerate().all(|(at, &c)| trees.place[c] == at as u32));
    }

    #[test]
    fn small_or_unordered_ones_stay_whole() {
        let columns: Vec<Range<usize>> = (0..4).map(|k| k..k + 1).collect();
        let whole = Trees::new(&columns, &[1, 3, 3, 4], &[1; 4]);
        assert_eq!((whole.parts.len(), whole.top), (0, vec![0, 1, 2, 3]));
        let columns: Vec<Range<usize>> = (0..4).map(|k| k * 1000..(k + 1) * 1000).collect();
        // 0 hangs on 2, but 1, which does not, stands between.
        assert_eq!(Trees::new(&columns, &[2, 3, 3, 4], &[1; 4]).parts, []);
        assert_ne!(Trees::new(&columns, &[1, 3, 3, 4], &[1; 4]).parts, []);
    }
}
