//! Features of neighbouring triangles, found once: their boxes always meet, so that a tree would find them in every
//! detection, and in flat cloth nearly all of them are too far apart to matter.

use crate::contact::separation::topology::Topology;

/// Pairs of features that share no vertex, but whose owning triangles do.
#[derive(Clone, Debug, Default)]
pub(super) struct Beside {
    /// A triangle, its corner, and another triangle.
    pub corners: Vec<(u32, u8, u32)>,
    /// A triangle and its side, twice.
    pub sides: Vec<(u32, u32, [u8; 2])>,
    /// The names of the corners of each triangle.
    names: Vec<[u32; 3]>,
}

impl Beside {
    /// The pairs in a mesh whose vertices are, or will be, sewn to those that `names` tells; None: each to itself.
    pub fn new(cloth: &Topology, names: Option<&[u32]>) -> Self {
        let name = |v: u32| names.map_or(v, |names| names[v as usize]);
        let named: Vec<[u32; 3]> = cloth.triangles.iter().map(|vs| vs.map(name)).collect();
        let most = named.iter().flatten().max().map_or(0, |most| *most as usize + 1);
        let mut round: Vec<Vec<u32>> = vec![Vec::new(); most];
        for (t, vs) in named.iter().enumerate() {
            vs.iter().for_each(|&v| round[v as usize].push(t as u32));
        }
        let (mut corners, mut sides) = (Vec::new(), Vec::new());
        let mut near: Vec<u32> = Vec::new();
        for (s, vs) in named.iter().enumerate() {
            near.clear();
            near.extend(vs.iter().flat_map(|&v| &round[v as usize]));
            near.sort_unstable();
            near.dedup();
            let s = s as u32;
            for &t in near.iter().filter(|&&t| t != s) {
                let others = named[t as usize];
                let apart = cloth.corners_of(s).filter(|&k| !others.contains(&vs[k]));
                corners.extend(apart.map(|k| (s, k as u8, t)));
                if t < s {
                    continue;
                }
                for k in cloth.sides_of(s) {
                    let ends = [vs[k], vs[(k + 1) % 3]];
                    let apart = cloth
                        .sides_of(t)
                        .filter(|&m| !ends.contains(&others[m]) && !ends.contains(&others[(m + 1) % 3]));
                    sides.extend(apart.map(|m| (s, t, [k as u8, m as u8])));
                }
            }
        }
        Self { corners, sides, names: named }
    }

    /// Whether two triangles share a vertex, or will when they are sewn.
    pub fn are(&self, s: u32, t: u32) -> bool {
        let [a, b, c] = self.names[s as usize];
        self.names[t as usize].iter().fold(false, |are, v| are | (*v == a) | (*v == b) | (*v == c))
    }
}
