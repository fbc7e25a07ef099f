//! Borders of open meshes.

use crate::geometry::mesh::TriMesh;

/// The border loops of a mesh (chains of edges that only one triangle uses), each as its vertices in order. Borders
/// that touch in a vertex may come out as one loop.
pub fn border_loops(mesh: &TriMesh) -> Vec<Vec<u32>> {
    let directed = || (0..3).flat_map(|k| mesh.triangles.iter().map(move |t| [t[k], t[(k + 1) % 3]]));
    let mut keys: Vec<[u32; 2]> = directed().map(|[a, b]| [a.min(b), a.max(b)]).collect();
    keys.sort_unstable();
    let once = |[a, b]: [u32; 2]| {
        let key = [a.min(b), a.max(b)];
        let first = keys.partition_point(|k| *k < key);
        keys.get(first + 1) != Some(&key)
    };
    let mut next: Vec<Vec<u32>> = vec![Vec::new(); mesh.positions.len()];
    let mut starts = Vec::new();
    for [a, b] in directed().filter(|&e| once(e)) {
        starts.push(a);
        next[a as usize].push(b);
    }
    let mut loops = Vec::new();
    for start in starts {
        let (mut chain, mut at) = (Vec::new(), start);
        while let Some(b) = next[at as usize].pop() {
            chain.push(at);
            at = b;
            if at == start {
                break;
            }
        }
        if !chain.is_empty() {
            loops.push(chain);
        }
    }
    loops
}
