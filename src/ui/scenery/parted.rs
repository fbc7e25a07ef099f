//! Divides cloth into meshes of different colours, by layer and by activity (frozen, deactivated). No egui here: pictures without
//! a window use it too.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use crate::cloth::{ClothState, Garment, Wedges};
use crate::geometry::ids::PieceId;
use crate::pattern::activity::Activity;
use crate::render::{Mesh, Rgb, Textile, cloth_front};
use crate::ui::scenery::fabric_looks::{PieceLook, PieceLooks, flat};

/// The colour that is mixed into frozen cloth, and its fraction.
const ICE: (Rgb, f32) = ([96, 150, 226], 0.6);
/// The colour that is mixed into deactivated cloth, and its fraction.
const PALE: (Rgb, f32) = ([228, 228, 226], 0.8);
/// Stretch of an edge (length over rest length) above which triangles of deactivated pieces are left out: their seams do not
/// hold, so cloth that moved has pulled them apart.
const TORN: f64 = 1.5;

/// The parts of a garment that are drawn alike.
#[derive(Clone, Copy, PartialEq)]
struct Group<'a> {
    activity: Activity,
    layer: u8,
    look: Option<&'a PieceLook>,
}

/// Divides `whole`, the mesh of `garment`, into meshes of the active and of the frozen pieces of each layer and appearance, so that
/// colours end exactly at seams.
pub fn parted(
    whole: Mesh,
    garment: &Garment,
    state: &ClothState,
    activities: &BTreeMap<PieceId, Activity>,
    looks: &PieceLooks,
) -> Vec<Mesh> {
    let group = |piece: PieceId| {
        let activity = activities.get(&piece).copied().unwrap_or_default();
        Group { activity, layer: garment.layer(piece), look: looks.get(&piece) }
    };
    let mut groups: Vec<(Group<'_>, Vec<usize>)> = Vec::new();
    // Triangles of a piece follow each other.
    for run in runs(&garment.triangle_pieces) {
        let own = group(garment.triangle_pieces[run.start]);
        let at = groups.iter().position(|(group, _)| *group == own).unwrap_or_else(|| {
            groups.push((own, Vec::new()));
            groups.len() - 1
        });
        groups[at].1.extend(run.filter(|&t| is_laid(garment, state, t)));
    }
    groups.retain(|(group, triangles)| !group.activity.is_deactivated() && !triangles.is_empty());
    groups.sort_by_key(|(group, _)| (group.activity != Activity::Active, group.layer));
    // Without fold lines the sides of seams are all that is parted.
    let wedges = (!garment.trims.folds.is_empty()).then(|| Wedges::new(garment).triangles);
    let mesh = |(group, triangles): (Group<'_>, Vec<usize>)| {
        let own = wedges.as_ref().map(|wedges| triangles.iter().map(|&t| wedges[t]).collect());
        Mesh { wedges: own.unwrap_or_default(), ..part(&whole, garment, &triangles, group) }
    };
    groups.into_iter().map(mesh).collect()
}

/// A mesh without triangles in the colours that `piece` has among the parts of `whole`; None: it is deactivated.
pub fn painted(
    whole: &Mesh,
    garment: &Garment,
    activities: &BTreeMap<PieceId, Activity>,
    looks: &PieceLooks,
    piece: PieceId,
) -> Option<Mesh> {
    let activity = activities.get(&piece).copied().unwrap_or_default();
    let (front, back, cloth) = (whole.front, whole.back, whole.cloth);
    let bare = Mesh { front, back, cloth, ..Mesh::default() };
    let group = Group { activity, layer: garment.layer(piece), look: looks.get(&piece) };
    (!activity.is_deactivated()).then(|| part(&bare, garment, &[], group))
}

/// Ranges of equal neighbours.
fn runs(pieces: &[PieceId]) -> impl Iterator<Item = Range<usize>> {
    let mut start = 0;
    pieces.chunk_by(|a, b| a == b).map(move |run| {
        let range = start..start + run.len();
        start = range.end;
        range
    })
}

/// The mesh of the deactivated pieces of `garment`, the mesh of which is `whole`. Torn triangles are left out.
pub fn deactivated(
    whole: &Mesh,
    garment: &Garment,
    state: &ClothState,
    activities: &BTreeMap<PieceId, Activity>,
) -> Mesh {
    let activity = Activity::Deactivated;
    let is_of = |t: &usize| activities.get(&garment.triangle_pieces[*t]) == Some(&activity);
    let all = (0..garment.triangles.len()).filter(is_of);
    let triangles: Vec<usize> =
        all.filter(|&t| is_laid(garment, state, t) && !is_torn(garment, state, t)).collect();
    part(whole, garment, &triangles, Group { activity, layer: 0, look: None })
}

/// These triangles of `garment`, the mesh of which is `whole`, in the colours of `group`.
fn part(whole: &Mesh, garment: &Garment, triangles: &[usize], group: Group<'_>) -> Mesh {
    let Group { activity, layer, look } = group;
    let own = look.and_then(|look| look.colours).unwrap_or([cloth_front(layer), whole.back]);
    let [front, back] = own.map(|own| looks(own, activity));
    let textile = look.map(|look| look.textile).unwrap_or_default();
    let second = textile.second.map(|own| looks(own, activity));
    let flat = look.map(|look| triangles.iter().map(|&t| flat(garment, t, look.grain)).collect());
    Mesh {
        triangles: triangles.iter().map(|&t| garment.triangles[t]).collect(),
        front,
        back,
        flat: flat.unwrap_or_default(),
        textile: Textile { second, ..textile },
        decals: look.map(|look| Arc::clone(&look.decals)).unwrap_or_default(),
        ..whole.clone()
    }
}

fn is_laid(garment: &Garment, state: &ClothState, t: usize) -> bool {
    garment.triangles[t].iter().all(|&v| state.mapped[v as usize])
}

fn is_torn(garment: &Garment, state: &ClothState, t: usize) -> bool {
    let (place, rest) = (garment.triangles[t].map(|v| state.positions[v as usize]), garment.rest[t]);
    [(0, 1), (1, 2), (2, 0)]
        .iter()
        .any(|&(i, j)| place[i].distance(place[j]) > TORN * rest[i].distance(rest[j]))
}

fn looks(own: Rgb, activity: Activity) -> Rgb {
    let (other, share) = match activity {
        Activity::Active => return own,
        Activity::Frozen => ICE,
        Activity::Deactivated => PALE,
    };
    [0, 1, 2].map(|k| (f32::from(own[k]) * (1.0 - share) + f32::from(other[k]) * share).round() as u8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::CLOTH_FRONT;
    use glam::{DVec2, DVec3};

    fn square() -> (Garment, ClothState, Mesh) {
        let flat = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
        let triangles = vec![[0, 1, 2], [0, 2, 3]];
        let garment = Garment {
            vertex_count: 4,
            rest: triangles.iter().map(|t: &[u32; 3]| t.map(|v| flat[v as usize])).collect(),
            triangles: triangles.clone(),
            triangle_pieces: vec![PieceId(1), PieceId(2)],
            pieces: [1, 2].map(|id| (PieceId(id), id.to_string())).to_vec(),
            ..Garment::default()
        };
        let positions: Vec<DVec3> = flat.iter().map(|p| p.extend(0.0)).collect();
        let whole = Mesh { triangles, front: CLOTH_FRONT, ..Mesh::default() };
        (garment, ClothState { positions, mapped: vec![true; 4] }, whole)
    }

    #[test]
    fn frozen_triangles_have_a_mesh_of_their_own() {
        let (garment, state, whole) = square();
        let parts = |activities: &[(PieceId, Activity)]| {
            parted(whole.clone(), &garment, &state, &activities.iter().copied().collect(), &PieceLooks::new())
        };
        assert_eq!(parts(&[]).len(), 1);
        let two = parts(&[(PieceId(2), Activity::Frozen)]);
        assert_eq!([&two[0].triangles, &two[1].triangles], [&vec![[0, 1, 2]], &vec![[0, 2, 3]]]);
        assert_eq!(two[0].front, CLOTH_FRONT);
        assert!(two[1].front[2] > two[1].front[0] + 40, "{:?} is bluish", two[1].front);
        assert_eq!(parts(&[(PieceId(1), Activity::Frozen), (PieceId(2), Activity::Frozen)]).len(), 1);
    }

    #[test]
    fn what_is_worn_over_other_cloth_has_another_colour() {
        let (mut garment, state, whole) = square();
        garment.layers = BTreeMap::from([(PieceId(2), 1)]);
        let fronts = |activities: &BTreeMap<PieceId, Activity>| {
            let meshes = parted(whole.clone(), &garment, &state, activities, &PieceLooks::new());
            meshes.iter().map(|mesh| (mesh.triangles.clone(), mesh.front)).collect::<Vec<_>>()
        };
        let two = fronts(&BTreeMap::new());
        assert_eq!(two, [(vec![[0, 1, 2]], CLOTH_FRONT), (vec![[0, 2, 3]], cloth_front(1))]);
        assert!((1..=15).all(|layer| cloth_front(layer) != cloth_front(layer - 1)));
        let frozen = fronts(&BTreeMap::from([(PieceId(2), Activity::Frozen)]));
        assert!(frozen.len() == 2 && frozen[0] == two[0] && frozen[1].1 != two[1].1, "{frozen:?}");
    }

    #[test]
    fn deactivated_triangles_are_pale_and_left_out_where_they_would_be_drawn_out() {
        let (garment, mut state, whole) = square();
        let activities = BTreeMap::from([(PieceId(1), Activity::Deactivated)]);
        assert_eq!(
            parted(whole.clone(), &garment, &state, &activities, &PieceLooks::new())[0].triangles,
            [[0, 2, 3]]
        );
        let mesh = deactivated(&whole, &garment, &state, &activities);
        assert_eq!(mesh.triangles, [[0, 1, 2]]);
        assert!(mesh.front.iter().zip(CLOTH_FRONT).all(|(pale, own)| *pale > own));
        state.positions[2].y = 4.0;
        assert!(deactivated(&whole, &garment, &state, &activities).triangles.is_empty());
    }
}
