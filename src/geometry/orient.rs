//! Orientation of triangle meshes: counting how edges are used, and flipping triangles until neighbours agree.

use std::collections::VecDeque;

/// Numbers of irregular edges in a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct EdgeUses {
    /// Border edges: used by one triangle.
    pub open: usize,
    /// Non-manifold edges: used by three or more triangles.
    pub non_manifold: usize,
    /// Edges that two triangles run along in the same direction, so that one of them faces the wrong way.
    pub misoriented: usize,
}

/// One side of a triangle. Sides sort by edge, so that those of one edge come together.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Side {
    edge: [u32; 2],
    triangle: u32,
    /// Whether the triangle runs along the edge from the lower to the higher vertex.
    up: bool,
}

fn sides(triangles: &[[u32; 3]]) -> Vec<Side> {
    let mut sides: Vec<Side> = (0u32..)
        .zip(triangles)
        .flat_map(|(triangle, t)| {
            [0, 1, 2].map(|k| {
                let (a, b) = (t[k], t[(k + 1) % 3]);
                Side { edge: [a.min(b), a.max(b)], triangle, up: a < b }
            })
        })
        .collect();
    sides.sort_unstable();
    sides
}

/// Counts the border, non-manifold and misoriented edges of a mesh.
pub fn edge_uses(triangles: &[[u32; 3]]) -> EdgeUses {
    let mut uses = EdgeUses::default();
    for group in sides(triangles).chunk_by(|a, b| a.edge == b.edge) {
        match group {
            [_] => uses.open += 1,
            [a, b] => uses.misoriented += usize::from(a.up == b.up),
            _ => uses.non_manifold += 1,
        }
    }
    uses
}

/// Border edges (used by one triangle), ascending.
pub fn open_edges(triangles: &[[u32; 3]]) -> Vec<[u32; 2]> {
    sides(triangles)
        .chunk_by(|a, b| a.edge == b.edge)
        .filter(|group| group.len() == 1)
        .map(|group| group[0].edge)
        .collect()
}

/// Result of [`make_consistent`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Oriented {
    /// Number of triangles flipped.
    pub turned: usize,
    /// Number of components connected over edges.
    pub components: usize,
}

/// Flips triangles until neighbours across edges of two triangles are oriented alike; of each component the smaller
/// group is flipped. A component that cannot be oriented, such as a Möbius strip, keeps some disagreement.
pub fn make_consistent(triangles: &mut [[u32; 3]]) -> Oriented {
    let neighbours = neighbours(triangles);
    let mut turn: Vec<Option<bool>> = vec![None; triangles.len()];
    let mut done = Oriented::default();
    for seed in 0..triangles.len() {
        if turn[seed].is_some() {
            continue;
        }
        done.components += 1;
        let part = spread(seed, &neighbours, &mut turn);
        let turned = part.iter().filter(|&&t| turn[t] == Some(true)).count();
        let fewer = turned * 2 <= part.len();
        done.turned += if fewer { turned } else { part.len() - turned };
        for t in part {
            if turn[t] == Some(fewer) {
                triangles[t].swap(1, 2);
            }
        }
    }
    done
}

/// For each triangle its neighbours across edges, each with whether it is oriented the other way; false across edges
/// of more than two triangles.
fn neighbours(triangles: &[[u32; 3]]) -> Vec<Vec<(usize, bool)>> {
    let mut neighbours = vec![Vec::new(); triangles.len()];
    for group in sides(triangles).chunk_by(|a, b| a.edge == b.edge) {
        let differ = group.len() == 2 && group[0].up == group[1].up;
        for pair in group.windows(2) {
            let [a, b] = [pair[0].triangle as usize, pair[1].triangle as usize];
            neighbours[a].push((b, differ));
            neighbours[b].push((a, differ));
        }
    }
    neighbours
}

fn spread(seed: usize, neighbours: &[Vec<(usize, bool)>], turn: &mut [Option<bool>]) -> Vec<usize> {
    let mut part = Vec::new();
    let mut queue = VecDeque::from([seed]);
    turn[seed] = Some(false);
    while let Some(t) = queue.pop_front() {
        part.push(t);
        let own = turn[t] == Some(true);
        for &(next, differ) in &neighbours[t] {
            if turn[next].is_none() {
                turn[next] = Some(own != differ);
                queue.push_back(next);
            }
        }
    }
    part
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_are_counted() {
        let uses = edge_uses(&[[0, 1, 2], [0, 1, 3], [4, 5, 6], [5, 4, 7], [4, 5, 8]]);
        assert_eq!(uses, EdgeUses { open: 10, non_manifold: 1, misoriented: 1 });
        assert_eq!(open_edges(&[[0, 1, 2], [0, 1, 3]]), [[0, 2], [0, 3], [1, 2], [1, 3]]);
    }

    #[test]
    fn the_fewer_are_turned() {
        let mut strip: Vec<[u32; 3]> =
            (0..9).map(|k| if k % 2 == 0 { [k, k + 1, k + 2] } else { [k + 1, k, k + 2] }).collect();
        let good = strip.clone();
        strip[4].swap(0, 1);
        strip[0].swap(1, 2);
        assert_eq!(make_consistent(&mut strip), Oriented { turned: 2, components: 1 });
        assert_eq!(edge_uses(&strip).misoriented, 0);
        assert_eq!(strip[1..4], good[1..4]);
    }

    #[test]
    fn a_moebius_strip_cannot_agree() {
        // Five triangles round, with one half turn.
        let mut strip: Vec<[u32; 3]> = (0..5).map(|k| [k, (k + 1) % 5, (k + 2) % 5]).collect();
        make_consistent(&mut strip);
        assert!(edge_uses(&strip).misoriented > 0);
    }
}
