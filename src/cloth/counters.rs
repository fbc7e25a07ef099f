//! Counters of work done and work skipped.

use serde::Serialize;

/// Counters since the simulation began, which show what work a scene did not need.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counters {
    /// Vertices whose contact with the body was checked.
    pub contact_checks: u64,
    /// Contact checks that needed a closest point query on the body.
    pub contact_queries: u64,
    /// Contact checks answered from the triangles round the last nearest one, as a gap certificate allowed.
    pub contact_walks: u64,
    /// Gap certificates computed, each at about the cost of a closest point query.
    pub contact_gaps: u64,
    /// Faces of resting cloth that were checked: whether they cut the body, or face away from it.
    pub face_checks: u64,
    /// Points of faces for which the body was queried in face checks.
    pub face_queries: u64,
    /// Searches for self-intersections of the cloth.
    pub self_tests: u64,
    /// Edges checked for whether the body may cut them.
    pub edge_checks: u64,
    /// Edges whose intersection with the body was tested exactly.
    pub edge_tests: u64,
    /// Edges split because the body cut them.
    pub split_edges: u64,
    /// Split edges that were joined again.
    pub joined_edges: u64,
    /// Edges tested against bones.
    pub bone_tests: u64,
    /// Edges stopped from crossing a bone.
    pub bone_stops: u64,
    /// Solves of the global step.
    pub solves: u64,
    /// Numeric factorisations of the global step's matrix.
    pub factorisations: u64,
    /// Triangles processed in local steps, summed over passes.
    pub local_triangles: u64,
    /// Vertices moved by drags, summed over drags.
    pub drag_vertices: u64,
    /// Vertices placed by growth.
    pub grown_vertices: u64,
}
