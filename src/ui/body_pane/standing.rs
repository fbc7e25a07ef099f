//! Meshes of pieces placed in space before they are sewn. No egui here.

use std::collections::BTreeMap;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::cloth::{Garment, build_again};
use crate::drag::Ray;
use crate::geometry::ids::PieceId;
use crate::pattern::triangulate::Meshes;
use crate::pattern::{Pattern, SpacePose};
use crate::render::{CLOTH_BACK, Mesh, cloth_front};
use crate::ui::body_pane::pick::meets;

/// Edge length of their triangles, metres; fine enough for rolled pieces to look round.
const EDGE: f64 = 0.03;

/// The placed pieces of a pattern as meshes, built anew when it changes.
#[derive(Debug, Default)]
pub struct Standing {
    of: Arc<Pattern>,
    flat: Meshes,
    garment: Garment,
    places: Vec<Option<DVec3>>,
    meshes: Arc<Vec<Arc<Mesh>>>,
}

impl Standing {
    /// Updates the meshes to those of `pattern`.
    pub fn update(&mut self, pattern: &Arc<Pattern>) {
        if Arc::ptr_eq(&self.of, pattern) {
            return;
        }
        self.of = Arc::clone(pattern);
        (self.garment, _) = build_again(pattern, EDGE, &mut self.flat);
        let corners = self.garment.corners.iter();
        let pose = |piece: &PieceId| pattern.pieces.get(piece).and_then(|piece| piece.placement);
        self.places = corners.clone().map(|c| pose(&c.piece).map(|pose| pose.at(c.uv))).collect();
        let out: Vec<DVec3> = corners
            .map(|c| {
                let piece = pattern.pieces.get(&c.piece);
                let outer = piece.map_or(1.0, |p| if p.signed_area() < 0.0 { -1.0 } else { 1.0 });
                pose(&c.piece).map_or(DVec3::Z, |pose| normal(&pose, c.uv) * outer)
            })
            .collect();
        let mut of_pieces: BTreeMap<PieceId, Vec<[u32; 3]>> = BTreeMap::new();
        for (t, corners) in self.garment.triangle_corners.iter().enumerate() {
            if corners.iter().all(|&c| self.places[c as usize].is_some()) {
                of_pieces.entry(self.garment.triangle_pieces[t]).or_default().push(*corners);
            }
        }
        let positions: Vec<_> = self.places.iter().map(|p| p.unwrap_or_default().as_vec3()).collect();
        let normals: Vec<_> = out.iter().map(|n| n.as_vec3()).collect();
        let mesh = |(piece, triangles): (PieceId, Vec<[u32; 3]>)| {
            let layer = self.garment.layer(piece);
            Arc::new(Mesh {
                positions: positions.clone(),
                normals: normals.clone(),
                triangles,
                colours: Vec::new(),
                front: cloth_front(layer),
                back: CLOTH_BACK,
                cloth: 1.0,
                ..Mesh::default()
            })
        };
        self.meshes = Arc::new(of_pieces.into_iter().map(mesh).collect());
    }

    /// The meshes to be drawn.
    pub fn meshes(&self) -> &Arc<Vec<Arc<Mesh>>> {
        &self.meshes
    }

    /// The first piece that a ray hits, the point, and its distance from the ray's origin, metres.
    pub fn under(&self, ray: Ray) -> Option<(PieceId, DVec3, f64)> {
        let triangles = self.garment.triangle_corners.iter().zip(&self.garment.triangle_pieces);
        let direction = ray.direction.normalize();
        let hits = triangles.filter_map(|(corners, &piece)| {
            let [a, b, c] = corners.map(|c| self.places[c as usize]);
            let (far, _) = meets(ray.origin, direction, [a?, b?, c?])?;
            Some((piece, ray.origin + direction * far, far))
        });
        hits.min_by(|a, b| a.2.total_cmp(&b.2))
    }
}

/// Unit normal of the piece's front at `p` under `pose`.
fn normal(pose: &SpacePose, p: DVec2) -> DVec3 {
    const STEP: f64 = 1e-4;
    let slope = |d: DVec2| pose.at(p + d * STEP) - pose.at(p - d * STEP);
    slope(DVec2::X).cross(slope(DVec2::Y)).normalize_or(DVec3::Z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pattern::{Piece, Roll};
    use glam::DQuat;

    fn pattern(roll: Option<Roll>) -> Arc<Pattern> {
        let corners = [(-0.2, 0.0), (0.2, 0.0), (0.2, 0.3), (-0.2, 0.3)].map(DVec2::from);
        let pose = SpacePose { roll, ..SpacePose::flat(DVec3::new(0.0, 1.0, 0.5), DQuat::IDENTITY) };
        let mut pattern = Pattern::default();
        pattern.add_piece(Piece { placement: Some(pose), ..Piece::polygon("panel", &corners) });
        pattern.add_piece(Piece::polygon("on the table", &corners));
        Arc::new(pattern)
    }

    #[test]
    fn what_stands_is_met_by_rays_and_what_does_not_is_not_there() {
        let mut standing = Standing::default();
        standing.update(&pattern(None));
        assert_eq!(standing.meshes().len(), 1);
        let ahead = Ray { origin: DVec3::new(0.1, 1.2, 2.0), direction: DVec3::NEG_Z };
        let (piece, at, far) = standing.under(ahead).expect("the panel");
        assert!(piece == PieceId(1) && (far - 1.5).abs() < 1e-12, "{piece:?} {far}");
        assert!(at.distance(DVec3::new(0.1, 1.2, 0.5)) < 1e-12);
        assert!(standing.under(Ray { origin: DVec3::new(0.3, 1.2, 2.0), ..ahead }).is_none());
        assert!(standing.under(Ray { direction: DVec3::Z, ..ahead }).is_none());
    }

    #[test]
    fn a_tube_looks_outward_all_round() {
        let roll = Roll { centre: DVec2::ZERO, along: DVec2::Y, radius: 0.4 / std::f64::consts::TAU };
        let mut standing = Standing::default();
        standing.update(&pattern(Some(roll)));
        let mesh = &standing.meshes()[0];
        let axis = glam::Vec3::new(0.0, 0.0, 0.5 - roll.radius as f32);
        for &t in &mesh.triangles {
            for v in t.map(|v| v as usize) {
                let from_axis = (mesh.positions[v] - axis) * glam::Vec3::new(1.0, 0.0, 1.0);
                assert!((from_axis.length() - roll.radius as f32).abs() < 1e-5);
                assert!(mesh.normals[v].dot(from_axis.normalize()) > 0.999);
            }
        }
    }
}
