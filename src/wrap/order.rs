//! Order of growth: pieces with marks first, then those sewn to them, and so on (tiers); within a tier by distance.

use std::cmp::Reverse;
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BinaryHeap, VecDeque};

use crate::cloth::Garment;
use crate::geometry::ids::PieceId;
use crate::wrap::roots::Root;

/// Order in which vertices are placed.
#[derive(Clone, Debug, PartialEq)]
pub struct Order {
    /// For each vertex its tier, the lowest of its pieces; None where no seam leads to a mark.
    pub tier: Vec<Option<u32>>,
    /// For each vertex its distance over the mesh, metres: in tier 0 to the nearest mark, else to the seams with earlier tiers.
    pub distance: Vec<f64>,
    /// Number of tiers.
    pub tiers: u32,
    /// The tier of each piece to which seams lead from a mark.
    pub piece_tier: BTreeMap<PieceId, u32>,
}

impl Order {
    /// The order of growth from `roots`; `marked` are the pieces with marks.
    pub fn new(garment: &Garment, roots: &[Root], marked: &[PieceId]) -> Self {
        let piece_tier = piece_tiers(garment, marked);
        let mut tier = vec![None; garment.vertex_count];
        for (t, vs) in garment.triangles.iter().enumerate() {
            let Some(&of_piece) = piece_tier.get(&garment.triangle_pieces[t]) else { continue };
            for &v in vs {
                let own = &mut tier[v as usize];
                *own = Some(own.map_or(of_piece, |tier: u32| tier.min(of_piece)));
            }
        }
        let tiers = piece_tier.values().map(|t| t + 1).max().unwrap_or(0);
        let mut distance = vec![f64::INFINITY; garment.vertex_count];
        for current in 0..tiers {
            let mut sources: Vec<(u32, f64)> = Vec::new();
            if current == 0 {
                sources.extend(roots.iter().map(|r| (r.vertex, r.distance)));
            } else {
                for v in 0..garment.vertex_count as u32 {
                    let is_before = tier[v as usize].is_some_and(|tier| tier < current);
                    if is_before && touches(garment, v, &piece_tier, current) {
                        sources.push((v, 0.0));
                    }
                }
            }
            spread(garment, &piece_tier, current, &sources, &tier, &mut distance);
        }
        Self { tier, distance, tiers, piece_tier }
    }
}

fn touches(garment: &Garment, v: u32, piece_tier: &BTreeMap<PieceId, u32>, tier: u32) -> bool {
    garment
        .adjacency
        .vertex_triangles
        .of(v)
        .iter()
        .any(|&t| piece_tier.get(&garment.triangle_pieces[t as usize]) == Some(&tier))
}

fn piece_tiers(garment: &Garment, marked: &[PieceId]) -> BTreeMap<PieceId, u32> {
    let mut tiers: BTreeMap<PieceId, u32> = BTreeMap::new();
    let mut sewn: BTreeMap<PieceId, Vec<PieceId>> = BTreeMap::new();
    for (_, pairs) in &garment.seam_pairs {
        if let Some(&[a, b]) = pairs.first() {
            let (a, b) = (garment.corners[a as usize].piece, garment.corners[b as usize].piece);
            sewn.entry(a).or_default().push(b);
            sewn.entry(b).or_default().push(a);
        }
    }
    let mut queue: VecDeque<PieceId> = VecDeque::new();
    for &piece in marked {
        if tiers.insert(piece, 0).is_none() {
            queue.push_back(piece);
        }
    }
    while let Some(piece) = queue.pop_front() {
        let next = tiers[&piece] + 1;
        for &other in sewn.get(&piece).into_iter().flatten() {
            if let Entry::Vacant(tier) = tiers.entry(other) {
                tier.insert(next);
                queue.push_back(other);
            }
        }
    }
    tiers
}

/// Distances within one tier: Dijkstra over the rest lengths of edges in its pieces.
fn spread(
    garment: &Garment,
    piece_tier: &BTreeMap<PieceId, u32>,
    current: u32,
    sources: &[(u32, f64)],
    tier: &[Option<u32>],
    distance: &mut [f64],
) {
    let mut best: BTreeMap<u32, f64> = BTreeMap::new();
    // Distances are not negative, so that their bits sort as they do.
    let mut queue = BinaryHeap::new();
    for &(v, d) in sources {
        if best.get(&v).is_none_or(|&b| d < b) {
            best.insert(v, d);
            queue.push(Reverse((d.to_bits(), v)));
        }
    }
    while let Some(Reverse((bits, v))) = queue.pop() {
        let d = f64::from_bits(bits);
        if best[&v] < d {
            continue;
        }
        for &t in garment.adjacency.vertex_triangles.of(v) {
            let t = t as usize;
            if piece_tier.get(&garment.triangle_pieces[t]) != Some(&current) {
                continue;
            }
            let vs = garment.triangles[t];
            let Some(k) = vs.iter().position(|&w| w == v) else { continue };
            for j in [(k + 1) % 3, (k + 2) % 3] {
                let next = d + (garment.rest[t][j] - garment.rest[t][k]).length();
                if best.get(&vs[j]).is_none_or(|&b| next < b) {
                    best.insert(vs[j], next);
                    queue.push(Reverse((next.to_bits(), vs[j])));
                }
            }
        }
    }
    for (v, d) in best {
        if tier[v as usize] == Some(current) {
            distance[v as usize] = d;
        }
    }
}
