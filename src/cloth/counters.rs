//! Work done and work skipped.

use serde::Serialize;

/// Counts since the simulation began. They prove what a scene did not need.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Counters {
    /// Vertices whose contact was looked at.
    pub contact_checks: u64,
    /// Of these, how many asked the body.
    pub contact_queries: u64,
    /// Answers got by looking only at the triangles round the last nearest one, which a certificate allowed.
    pub contact_walks: u64,
    /// Such certificates sought, each at about the cost of another query.
    pub contact_gaps: u64,
    /// Faces looked at where cloth seemed to lie still: whether they cut the body, or face it.
    pub face_checks: u64,
    /// Points of faces for which the body was asked then.
    pub face_queries: u64,
    /// Searches for places where the cloth passes through itself.
    pub self_tests: u64,
    /// Edges looked at: whether the body may cut them.
    pub edge_checks: u64,
    /// Of these, how many were tested exactly.
    pub edge_tests: u64,
    /// Edges split because the body cut them.
    pub split_edges: u64,
    /// Split edges joined again.
    pub joined_edges: u64,
    /// Edges tested against bones.
    pub bone_tests: u64,
    /// Edges kept from crossing a bone.
    pub bone_stops: u64,
    /// Global solves.
    pub solves: u64,
    /// Numeric factorisations.
    pub factorisations: u64,
    /// Jacobi passes over triangles, in triangles.
    pub local_triangles: u64,
    /// Vertices that drags reach, summed over drags.
    pub drag_vertices: u64,
    /// Vertices laid by growing.
    pub grown_vertices: u64,
}
