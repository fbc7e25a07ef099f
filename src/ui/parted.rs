//! Cloth drawn so that frozen pieces are told from those that move. No egui here: the headless pictures use it too.

use std::collections::BTreeMap;

use crate::cloth::{ClothState, Garment};
use crate::geometry::ids::PieceId;
use crate::pattern::activity::Activity;
use crate::render::{Mesh, Rgb};

/// What the colours of frozen cloth are mixed with, and how much of it there is then.
const ICE: (Rgb, f32) = ([96, 150, 226], 0.6);

/// `whole`, the drawn mesh of `garment`, with a mesh for the pieces of each activity: a triangle has one colour up to its seams.
pub fn parted(
    whole: Mesh,
    garment: &Garment,
    state: &ClothState,
    activities: &BTreeMap<PieceId, Activity>,
) -> Vec<Mesh> {
    if activities.is_empty() {
        return vec![whole];
    }
    let of = |activity: Activity| {
        let pieces = garment.triangles.iter().zip(&garment.triangle_pieces);
        let all = pieces.filter(|(_, piece)| activities.get(piece).copied().unwrap_or_default() == activity);
        let laid = |t: &[u32; 3]| t.iter().all(|&v| state.mapped[v as usize]);
        let triangles: Vec<[u32; 3]> = all.map(|(t, _)| *t).filter(laid).collect();
        let [front, back] = [whole.front, whole.back].map(|own| looks(own, activity));
        Mesh { triangles, front, back, ..whole.clone() }
    };
    let parts = [Activity::Active, Activity::Frozen].map(of);
    parts.into_iter().filter(|mesh| !mesh.triangles.is_empty()).collect()
}

fn looks(own: Rgb, activity: Activity) -> Rgb {
    let (other, share) = match activity {
        Activity::Active => return own,
        Activity::Frozen => ICE,
    };
    [0, 1, 2].map(|k| (f32::from(own[k]) * (1.0 - share) + f32::from(other[k]) * share).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::CLOTH_FRONT;

    #[test]
    fn frozen_triangles_have_a_mesh_of_their_own() {
        let garment = Garment {
            vertex_count: 4,
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            triangle_pieces: vec![PieceId(1), PieceId(2)],
            ..Garment::default()
        };
        let state = ClothState { positions: Vec::new(), mapped: vec![true; 4] };
        let whole = Mesh { triangles: garment.triangles.clone(), front: CLOTH_FRONT, ..Mesh::default() };
        let parts = |activities: &[(PieceId, Activity)]| {
            parted(whole.clone(), &garment, &state, &activities.iter().copied().collect())
        };
        assert_eq!(parts(&[]).len(), 1);
        let two = parts(&[(PieceId(2), Activity::Frozen)]);
        assert_eq!([&two[0].triangles, &two[1].triangles], [&vec![[0, 1, 2]], &vec![[0, 2, 3]]]);
        assert_eq!(two[0].front, CLOTH_FRONT);
        assert!(two[1].front[2] > two[1].front[0] + 40, "{:?} is bluish", two[1].front);
        assert_eq!(parts(&[(PieceId(1), Activity::Frozen), (PieceId(2), Activity::Frozen)]).len(), 1);
    }
}
