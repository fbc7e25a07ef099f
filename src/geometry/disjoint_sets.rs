//! Disjoint sets of numbers, which can be united (union-find).

/// Disjoint sets of the numbers from 0; each is represented by its lowest member.
#[derive(Clone, Debug)]
pub struct DisjointSets(Vec<u32>);

impl DisjointSets {
    /// A set for each of `count` numbers.
    pub fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    /// The lowest member of the set that `v` belongs to.
    pub fn root(&mut self, mut v: u32) -> u32 {
        while self.0[v as usize] != v {
            let up = self.0[self.0[v as usize] as usize];
            self.0[v as usize] = up;
            v = up;
        }
        v
    }

    /// Unites the sets of `a` and `b`.
    pub fn join(&mut self, a: u32, b: u32) {
        let [a, b] = [self.root(a), self.root(b)];
        self.0[a.max(b) as usize] = a.min(b);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_joined_has_one_root_the_lowest() {
        let mut sets = DisjointSets::new(7);
        [(5, 3), (6, 5), (0, 2), (3, 6)].into_iter().for_each(|(a, b)| sets.join(a, b));
        assert_eq!([0, 1, 2, 3, 4, 5, 6].map(|v| sets.root(v)), [0, 1, 0, 3, 4, 3, 3]);
    }
}
