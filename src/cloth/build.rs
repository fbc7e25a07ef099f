//! Builds the sewn garment: triangulates pieces and merges their vertices along seams into one mesh.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::DVec2;

use crate::cloth::trims::ClothPoint;
use crate::cloth::{Corner, Garment, GarmentTrims};
use crate::geometry::adjacency::Adjacency;
use crate::geometry::ids::{PieceId, SeamId};
use crate::geometry::words::words;
use crate::pattern::sampling::sampling;
use crate::pattern::triangulate::Meshes;
use crate::pattern::{CutPattern, EdgeRef, EdgeSeam, Pattern, Piece, PieceMesh, Problem, ProblemKind};

/// Builds the sewn garment of a pattern with edges about `edge_length` metres long. Also returns the problems that a
/// person should know or repair; a bad piece is left out and does not stop the others.
pub fn build(pattern: &Pattern, edge_length: f64) -> (Garment, Vec<Problem>) {
    build_again(pattern, edge_length, &mut Meshes::default())
}

/// Builds the garment as [`build`] does, without triangulating pieces again that have not changed since `meshes` was last used.
pub fn build_again(pattern: &Pattern, edge_length: f64, meshes: &mut Meshes) -> (Garment, Vec<Problem>) {
    let (cut, mut problems) = CutPattern::new(pattern);
    let sampling = sampling(&cut, edge_length, &mut problems);
    let meshes = meshes.update(&cut, &sampling, &mut problems);
    let mut garment = sewn(pattern, &cut, &meshes, &sampling.seams);
    garment.trims.buttons = buttons(pattern, &garment, &mut problems);
    report_twisted(pattern, &garment, &mut problems);
    (garment, problems)
}

/// Both points of each fastened button; one that is off its piece is reported.
fn buttons(pattern: &Pattern, garment: &Garment, problems: &mut Vec<Problem>) -> Vec<[ClothPoint; 2]> {
    let mut found = Vec::new();
    for (id, button) in &pattern.buttons {
        let places = [button.button, button.hole].map(|place| ClothPoint::new(garment, place));
        match places {
            [Some(a), Some(b)] if !button.open => found.push([a, b]),
            [Some(_), Some(_)] => {}
            _ => problems.push(Problem {
                kind: ProblemKind::Fastening,
                place: (*id).into(),
                words: words!("it or its buttonhole is not on the cloth; move it on to a piece"),
            }),
        }
    }
    found
}

fn sewn(
    pattern: &Pattern,
    cut: &CutPattern,
    meshes: &BTreeMap<PieceId, Arc<PieceMesh>>,
    seams: &[(SeamId, EdgeSeam)],
) -> Garment {
    let mut first_corner = BTreeMap::new();
    let mut corners: Vec<Corner> = Vec::new();
    for (&piece, mesh) in meshes {
        first_corner.insert(piece, corners.len() as u32);
        corners.extend(mesh.points.iter().map(|&uv| Corner { piece, uv, vertex: 0 }));
    }
    let mut seam_pairs: Vec<(SeamId, Vec<[u32; 2]>)> = Vec::new();
    for (id, seam) in
        seams.iter().filter(|(_, s)| s.sides.iter().all(|side| meshes.contains_key(&side.piece)))
    {
        let pairs = paired_corners(seam, meshes, &first_corner);
        match seam_pairs.last_mut() {
            Some((last, of_seam)) if last == id => of_seam.extend(pairs),
            _ => seam_pairs.push((*id, pairs)),
        }
    }
    let vertex_count = name_vertices(&mut corners, &seam_pairs);
    let trims = GarmentTrims::of(cut, meshes, &first_corner);
    let mut garment = Garment { vertex_count, seam_pairs, trims, ..Garment::default() };
    for (&piece, mesh) in meshes {
        let flat = &pattern.pieces[&piece];
        garment.pieces.push((piece, flat.name.clone()));
        if flat.layer > 0 {
            garment.layers.insert(piece, flat.layer);
        }
        if let Some(warp) = warp(flat, mesh) {
            garment.grains.insert(piece, warp);
        }
        let first = first_corner[&piece];
        for t in &mesh.triangles {
            let cs = t.map(|v| v + first);
            let vs = cs.map(|c| corners[c as usize].vertex);
            if vs[0] == vs[1] || vs[1] == vs[2] || vs[2] == vs[0] {
                continue; // A dart's tip narrower than one edge closes on itself.
            }
            garment.triangles.push(vs);
            garment.triangle_corners.push(cs);
            garment.triangle_pieces.push(piece);
            garment.rest.push(garment.along_grain(piece, front_rest(mesh, t)));
        }
    }
    garment.corners = corners;
    garment.adjacency = Adjacency::new(vertex_count, &garment.triangles);
    garment
}

/// Unit vector along the grainline of `piece` seen from the front. None if the piece has no grainline or it runs along y.
fn warp(piece: &Piece, mesh: &PieceMesh) -> Option<DVec2> {
    let along = piece.grain();
    let along = if mesh.front_is_far { DVec2::new(-along.x, along.y) } else { along };
    (along != DVec2::Y).then_some(along)
}

/// Rest shape of a triangle about its centroid, seen from the front of the cloth.
fn front_rest(mesh: &PieceMesh, t: &[u32; 3]) -> [DVec2; 3] {
    let p = t.map(|v| {
        let p = mesh.points[v as usize];
        if mesh.front_is_far { DVec2::new(-p.x, p.y) } else { p }
    });
    let centre = (p[0] + p[1] + p[2]) / 3.0;
    p.map(|q| q - centre)
}

fn paired_corners(
    seam: &EdgeSeam,
    meshes: &BTreeMap<PieceId, Arc<PieceMesh>>,
    first_corner: &BTreeMap<PieceId, u32>,
) -> Vec<[u32; 2]> {
    let side = |s: &EdgeRef| -> Vec<u32> {
        meshes[&s.piece].edge_points[s.edge].iter().map(|&v| v + first_corner[&s.piece]).collect()
    };
    let (a, mut b) = (side(&seam.sides[0]), side(&seam.sides[1]));
    if !seam.same_direction {
        b.reverse();
    }
    a.into_iter().zip(b).map(|(a, b)| [a, b]).collect()
}

/// Gives every corner the number of its sewn vertex, in the order of each vertex's lowest corner. Returns the number
/// of vertices.
fn name_vertices(corners: &mut [Corner], seam_pairs: &[(SeamId, Vec<[u32; 2]>)]) -> usize {
    let mut parent: Vec<u32> = (0..corners.len() as u32).collect();
    fn root(parent: &mut [u32], mut i: u32) -> u32 {
        while parent[i as usize] != i {
            parent[i as usize] = parent[parent[i as usize] as usize];
            i = parent[i as usize];
        }
        i
    }
    for &[a, b] in seam_pairs.iter().flat_map(|(_, pairs)| pairs) {
        let (a, b) = (root(&mut parent, a), root(&mut parent, b));
        parent[a.max(b) as usize] = a.min(b);
    }
    let mut names = vec![u32::MAX; corners.len()];
    let mut count = 0;
    for i in 0..corners.len() as u32 {
        let r = root(&mut parent, i) as usize;
        if names[r] == u32::MAX {
            names[r] = count;
            count += 1;
        }
        corners[i as usize].vertex = names[r];
    }
    count as usize
}

/// Reports seams that join front to back: both triangles at a seam must run along it in opposite directions.
fn report_twisted(pattern: &Pattern, garment: &Garment, problems: &mut Vec<Problem>) {
    for (id, pairs) in &garment.seam_pairs {
        let twisted = pairs.windows(2).any(|w| {
            let (a, b) = (garment.corners[w[0][0] as usize].vertex, garment.corners[w[1][0] as usize].vertex);
            let forward = garment
                .adjacency
                .vertex_triangles
                .of(a)
                .iter()
                .filter(|&&t| {
                    let vs = garment.triangles[t as usize];
                    (0..3).any(|k| vs[k] == a && vs[(k + 1) % 3] == b)
                })
                .count();
            a != b && forward > 1
        });
        if twisted {
            problems.push(Problem {
                kind: ProblemKind::TwistedSeam,
                place: crate::pattern::naming::seam_place(pattern, *id),
                words: words!("it joins the front of one piece to the back of the other; reverse the seam"),
            });
        }
    }
}
