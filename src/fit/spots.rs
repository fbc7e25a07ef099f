//! Locates the faults of a garment; computed only when there is a fault.

use std::collections::BTreeSet;

use glam::DVec3;

use crate::cloth::{ClothState, Garment};
use crate::fit::beside::{Beside, beside};
use crate::fit::laid::Laid;
use crate::fit::on_body::{BodyIndex, wrong_side_out};
use crate::geometry::borders::border_loops;
use crate::geometry::crossings::{meetings, self_crossings};

/// Share of the edges, those with the largest strain, that count as the place of strain.
const WORST: f64 = 0.01;

/// The place of a fault on a garment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spot {
    /// No particular place.
    Nowhere,
    /// The piece with this index in the garment's list.
    Piece(usize),
    /// Seams with a gap.
    Seams,
    /// Cloth inside the body.
    Inside,
    /// Intersections of cloth and skin.
    Through,
    /// Triangles wrong side out.
    WrongSide,
    /// Self-intersections of the cloth.
    Crossing,
    /// Edges with the largest strain.
    Strained,
    /// The opening with this index in the report.
    Opening(usize),
}

impl Spot {
    /// Vertices at the place, ascending.
    pub fn vertices(self, garment: &Garment, state: &ClothState, body: &BodyIndex<'_>) -> Vec<u32> {
        let laid = Laid::new(garment, state);
        let found: BTreeSet<u32> = match self {
            Self::Nowhere => BTreeSet::new(),
            Self::Piece(i) => piece(garment, i).collect(),
            Self::Seams => gaps(garment, state).collect(),
            Self::Inside => {
                let is_inside = |v: &u32| body.contains(laid.mesh.positions[*v as usize]);
                let inside: BTreeSet<u32> = laid.used.iter().copied().filter(is_inside).collect();
                if inside.is_empty() { through(&laid, body) } else { inside }
            }
            Self::Through => through(&laid, body),
            Self::WrongSide => {
                let wrong = wrong_side_out(&laid, body);
                let beside = beside(&laid, &wrong);
                let faces = laid.mesh.triangles.iter().zip(wrong).zip(beside);
                let faces =
                    faces.filter(|((_, wrong), beside)| *wrong == Some(true) && *beside != Beside::Smooth);
                faces.flat_map(|((t, _), _)| *t).collect()
            }
            Self::Crossing => {
                let found = self_crossings(&laid.mesh, &laid.edges, &laid.mesh.tree());
                found.into_iter().flat_map(|[e, _]| laid.edges[e as usize]).collect()
            }
            Self::Strained => strained(garment, &laid),
            Self::Opening(i) => opening(&laid, i).into_iter().collect(),
        };
        found.into_iter().collect()
    }
}

fn piece(garment: &Garment, i: usize) -> impl Iterator<Item = u32> {
    let id = garment.pieces.get(i).map(|(id, _)| *id);
    garment.corners.iter().filter(move |c| Some(c.piece) == id).map(|c| c.vertex)
}

fn gaps(garment: &Garment, state: &ClothState) -> impl Iterator<Item = u32> {
    let pairs = garment.seam_pairs.iter().flat_map(|(_, pairs)| pairs);
    let ends = pairs.map(|pair| pair.map(|c| garment.corners[c as usize].vertex));
    ends.filter(|[a, b]| state.positions.get(*a as usize) != state.positions.get(*b as usize)).flatten()
}

fn through(laid: &Laid, body: &BodyIndex<'_>) -> BTreeSet<u32> {
    let surface = body.surface();
    let cloth = meetings(&laid.mesh.positions, &laid.edges, &surface.mesh, body.tree());
    let skin = meetings(&surface.mesh.positions, &surface.adjacency.edges, &laid.mesh, &laid.mesh.tree());
    let ends = cloth.into_iter().flat_map(|[e, _]| laid.edges[e as usize]);
    ends.chain(skin.into_iter().flat_map(|[_, t]| laid.mesh.triangles[t as usize])).collect()
}

fn strained(garment: &Garment, laid: &Laid) -> BTreeSet<u32> {
    let mut edges: Vec<(f64, [u32; 2])> = Vec::new();
    for (vs, corners) in laid.mesh.triangles.iter().zip(&laid.corners) {
        for (k, j) in [(0, 1), (1, 2), (2, 0)] {
            let [a, b] = [vs[k], vs[j]].map(|v| laid.mesh.positions[v as usize]);
            let [p, q] = [corners[k], corners[j]].map(|c| garment.corners[c as usize].uv);
            edges.push(((a.distance(b) / p.distance(q).max(1e-9) - 1.0).abs(), [vs[k], vs[j]]));
        }
    }
    edges.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let worst = (edges.len() as f64 * WORST).ceil() as usize;
    edges.into_iter().take(worst).flat_map(|(_, ends)| ends).collect()
}

/// Vertices of opening `i`, in the order of the report: longest first.
fn opening(laid: &Laid, i: usize) -> Vec<u32> {
    let length = |chain: &Vec<u32>| {
        let at = |k: usize| laid.mesh.positions[chain[k % chain.len()] as usize];
        (0..chain.len()).map(|k| DVec3::distance(at(k), at(k + 1))).sum::<f64>()
    };
    let mut loops: Vec<(f64, Vec<u32>)> =
        border_loops(&laid.mesh).into_iter().map(|chain| (length(&chain), chain)).collect();
    loops.sort_by(|a, b| b.0.total_cmp(&a.0));
    loops.into_iter().nth(i).map(|(_, chain)| chain).unwrap_or_default()
}
