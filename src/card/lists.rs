//! Lists as shaders read them: entry k of item i at k × items + i, so that neighbouring threads read neighbouring memory.

use crate::geometry::adjacency::Adjacency;
use crate::geometry::bvh::Bvh;

/// Interleaved lists.
pub fn interleaved<T: Copy + Default>(lists: &[Vec<T>]) -> Vec<T> {
    let width = lists.iter().map(Vec::len).max().unwrap_or(0);
    let mut all = vec![T::default(); width * lists.len()];
    for (i, list) in lists.iter().enumerate() {
        list.iter().enumerate().for_each(|(k, entry)| all[k * lists.len() + i] = *entry);
    }
    all
}

/// Corners of each triangle and, last, what it owns, see [`Adjacency::owned`].
pub fn owned(triangles: &[[u32; 3]], adjacency: &Adjacency) -> Vec<[u32; 4]> {
    let owned = adjacency.owned(triangles);
    triangles.iter().zip(owned).map(|(&[a, b, c], bits)| [a, b, c, bits.into()]).collect()
}

/// For each triangle those that share a vertex with it: where its list begins, and all lists.
pub fn beside(triangles: &[[u32; 3]], adjacency: &Adjacency) -> (Vec<u32>, Vec<u32>) {
    let (mut starts, mut all) = (vec![0], Vec::new());
    for (t, vs) in triangles.iter().enumerate() {
        let round = vs.iter().flat_map(|&v| adjacency.vertex_triangles.of(v));
        let mut near: Vec<u32> = round.copied().filter(|&u| u as usize != t).collect();
        near.sort_unstable();
        near.dedup();
        all.extend(near);
        starts.push(all.len() as u32);
    }
    (starts, all)
}

/// Each vertex with each of the triangles round it: where those of a vertex begin, and all.
pub fn rounds(vertices: usize, adjacency: &Adjacency) -> (Vec<u32>, Vec<[u32; 2]>) {
    let (mut starts, mut all) = (vec![0], Vec::new());
    for v in 0..vertices as u32 {
        all.extend(adjacency.vertex_triangles.of(v).iter().map(|&t| [v, t]));
        starts.push(all.len() as u32);
    }
    (starts, all)
}

/// Right child (0 for a leaf), first slot and number of slots of each node.
pub fn nodes(tree: &Bvh) -> Vec<[u32; 4]> {
    tree.nodes.iter().map(|node| [node.right, node.first, node.count, 0]).collect()
}

/// The nodes, the deepest level first, and the first node and number of nodes of each level.
pub fn levels(tree: &Bvh) -> (Vec<u32>, Vec<[u32; 2]>) {
    let mut depth = vec![0_usize; tree.nodes.len()];
    for (at, node) in tree.nodes.iter().enumerate().filter(|(_, node)| !node.is_leaf()) {
        depth[at + 1] = depth[at] + 1;
        depth[node.right as usize] = depth[at] + 1;
    }
    let mut order: Vec<u32> = (0..tree.nodes.len() as u32).collect();
    order.sort_by_key(|&at| std::cmp::Reverse(depth[at as usize]));
    let mut ranges: Vec<[u32; 2]> = Vec::new();
    for (place, &at) in order.iter().enumerate() {
        let is_new = place == 0 || depth[order[place - 1] as usize] != depth[at as usize];
        match ranges.last_mut() {
            Some([_, count]) if !is_new => *count += 1,
            _ => ranges.push([place as u32, 1]),
        }
    }
    (order, ranges)
}
