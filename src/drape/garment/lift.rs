//! Raises draped cloth off the body where its faces or edges come too near, though its vertices do not.

use std::sync::Arc;

use crate::cloth::ClothState;
use crate::contact::Faces;
use crate::contact::faces::Lying;
use crate::drape::garment::{DrapedGarment, own_number};
use crate::geometry::crossings::meetings;
use crate::geometry::mesh::TriMesh;

/// How cloth is raised off the body.
pub(super) struct Lifting {
    /// Ticks between two checks of faces against the body.
    pub ticks: u64,
    /// Share of the offset from the body that interiors of faces and edges must keep; vertices keep all of it.
    clearance: f64,
    /// Faces whose clearance is short by no more than this share of it are left as they are.
    nearly: f64,
    /// Most that vertices are raised, in offsets.
    most: f64,
}

/// Chosen by trial; `most` bounds how far from the body cloth is lifted that cannot be kept off it.
pub(super) const LIFTING: Lifting = Lifting { ticks: 6, clearance: 0.5, nearly: 0.02, most: 8.0 };

impl DrapedGarment {
    /// Raises vertices of faces that come too near the body, twice as much after each time in vain. `precise` also checks edges,
    /// once no face is too near.
    pub(super) fn lift(&mut self, cloth: &ClothState, precise: bool) {
        let fixed = Arc::clone(&self.fixed);
        let (garment, surface) = (&*fixed.garment, &*self.collider.surface);
        let mut near = vec![false; garment.vertex_count];
        for (v, is_near) in self.near_body().into_iter().enumerate() {
            near[fixed.vertices[v] as usize] = is_near;
        }
        let lying =
            Lying { garment, surface, state: cloth, skips: self.settings.skips, split: None, apart: None };
        let clearance = LIFTING.clearance * fixed.offset;
        let lacking = self.faces.lacking(lying, &near, clearance, &mut self.counters);
        let mut raised = self.small.lift().to_vec();
        // Only cloth that moved ends the count: not every check looks at edges, so one that finds nothing says nothing.
        self.lifted_in_vain =
            if self.quiet == 0 { 0 } else { self.lifted_in_vain + i32::from(self.lacking > 0) };
        let times = 2.0f64.powi(self.lifted_in_vain.min(5));
        self.lacking = 0;
        for (vs, &lack) in garment.triangles.iter().zip(&lacking) {
            for v in vs.iter().filter_map(|&v| own_number(&fixed.own, v)) {
                let most = LIFTING.most * fixed.offset;
                if lack > LIFTING.nearly * clearance && raised[v] < most {
                    let wanted = (self.small.lift()[v] + times * lack).min(most);
                    self.lacking += usize::from(wanted > raised[v]);
                    raised[v] = raised[v].max(wanted);
                }
            }
        }
        if precise && self.lacking == 0 && !self.is_known_clean() {
            self.lift_cuts(cloth, &mut raised, times * LIFTING.clearance * fixed.offset);
        }
        self.small.set_lift(&raised);
    }

    /// Raises the vertices of cloth that rests as high as it lies, as far as its faces need that: nothing else tells how it was
    /// raised when it came to rest.
    pub(super) fn lift_as_it_lies(&mut self, cloth: &ClothState) {
        let fixed = Arc::clone(&self.fixed);
        let (garment, surface) = (&*fixed.garment, &*self.collider.surface);
        let (clearance, most) = (LIFTING.clearance * fixed.offset, LIFTING.most * fixed.offset);
        let mut near = vec![false; garment.vertex_count];
        let mut heights = vec![0.0; self.state.positions.len()];
        let mut fallen = cloth.clone();
        for ((&v, x), height) in fixed.vertices.iter().zip(&self.state.positions).zip(&mut heights) {
            if let Some(skin) = surface.nearest_within(*x, fixed.offset + most) {
                near[v as usize] = true;
                *height = (skin.distance - fixed.offset).max(0.0);
                fallen.positions[v as usize] = *x - skin.normal * *height;
            }
        }
        let lying =
            Lying { garment, surface, state: &fallen, skips: self.settings.skips, split: None, apart: None };
        let lacking = Faces::default().lacking(lying, &near, clearance, &mut self.counters);
        let mut raised = self.small.lift().to_vec();
        for (vs, lack) in garment.triangles.iter().zip(lacking) {
            for v in vs.iter().filter_map(|&v| own_number(&fixed.own, v)) {
                raised[v] = raised[v].max(lack.min(heights[v]));
            }
        }
        self.small.set_lift(&raised);
    }

    /// Raises vertices of edges and faces that intersect the body by `by` metres: samples of a face miss the sharpest edges.
    fn lift_cuts(&mut self, cloth: &ClothState, raised: &mut [f64], by: f64) {
        let fixed = Arc::clone(&self.fixed);
        let (garment, surface) = (&*fixed.garment, &*self.collider.surface);
        let laid = |vs: &[u32]| vs.iter().all(|&v| own_number(&fixed.own, v).is_some());
        let edges: Vec<[u32; 2]> = garment.adjacency.edges.iter().copied().filter(|e| laid(e)).collect();
        let triangles = garment.triangles.iter().copied().filter(|vs| laid(vs)).collect();
        let mesh = TriMesh { positions: cloth.positions.clone(), triangles };
        let body = &surface.mesh;
        let mut cut = vec![false; raised.len()];
        let mut mark =
            |vs: &[u32]| vs.iter().filter_map(|&v| own_number(&fixed.own, v)).for_each(|v| cut[v] = true);
        for [e, _] in meetings(&mesh.positions, &edges, body, surface.winding().tree()) {
            mark(&edges[e as usize]);
        }
        for [_, t] in meetings(&body.positions, &surface.adjacency.edges, &mesh, &mesh.tree()) {
            mark(&mesh.triangles[t as usize]);
        }
        let most = LIFTING.most * fixed.offset;
        for (raised, _) in raised.iter_mut().zip(cut).filter(|(raised, cut)| *cut && **raised < most) {
            *raised = (*raised + by).min(most);
            self.lacking += 1;
        }
    }
}
