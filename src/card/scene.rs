//! What a card is given: cloth and a body that do not change, and what holds for a span of small steps.

use bytemuck::{Pod, Zeroable};
use glam::{DVec3, IVec3};

use crate::card::shares::Spring;
use crate::geometry::adjacency::Adjacency;
use crate::geometry::mesh::TriMesh;

/// Length of a unit of position, metres; a position has 32 bits, so that ±4 m round the origin can be told.
pub const UNIT: f64 = 1.0 / (1_u64 << 29) as f64;
/// Largest coordinate relative to the origin, metres.
pub const FARTHEST: f64 = 3.9;

/// Cloth, as far as it does not change.
#[derive(Clone, Copy, Debug)]
pub struct Cloth<'a> {
    /// Corners of the triangles.
    pub triangles: &'a [[u32; 3]],
    /// Their adjacency.
    pub adjacency: &'a Adjacency,
    /// Springs, usually one along every edge.
    pub springs: &'a [Spring],
    /// Strain beyond which springs are rigid.
    pub limit: f64,
    /// Rows of the bending matrix: columns and values, N/m.
    pub bending: &'a [Vec<(u32, f64)>],
    /// Mass, kg, and area, m², of each vertex.
    pub mass: &'a [f64],
    /// Area of each vertex, m².
    pub area: &'a [f64],
    /// Friction coefficient of each vertex.
    pub friction: &'a [f64],
    /// Distance that the cloth keeps from itself, metres; None: it does not collide.
    pub thickness: Option<f64>,
}

/// A body at rest.
#[derive(Clone, Copy, Debug)]
pub struct Body<'a> {
    /// Its mesh: closed, facing outward.
    pub mesh: &'a TriMesh,
    /// Adjacency of the mesh.
    pub adjacency: &'a Adjacency,
    /// Pseudonormals of each triangle: of its face, its sides and its corners; of any length.
    pub normals: &'a [[DVec3; 7]],
}

/// A vertex that is pulled by a spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hand {
    /// The vertex.
    pub vertex: u32,
    /// Where it is pulled to, metres.
    pub target: DVec3,
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Largest force, N.
    pub most: f64,
}

/// Small steps of one size under the same forces.
#[derive(Clone, Copy, Debug)]
pub struct Span<'a> {
    /// Size of a small step, s.
    pub small: f64,
    /// Gravity, m/s².
    pub gravity: DVec3,
    /// Rate at which motion dies away, 1/s.
    pub damping: f64,
    /// Stiffness-proportional damping of bending, s.
    pub bending_damping: f64,
    /// Distance kept from the body, metres.
    pub offset: f64,
    /// Largest pressure that friction sees, Pa.
    pub grip: f64,
    /// Speed at which cloth leaves cloth, and a body if `eases_off_body`, when it is deeper than its motion brought it, m/s.
    pub ease: f64,
    /// See `ease`; otherwise it leaves the body at once.
    pub eases_off_body: bool,
    /// Distance that each vertex keeps from the body besides the offset, metres.
    pub lift: &'a [f64],
    /// Inverse mass of each vertex, 1/kg; zero where it is held.
    pub inverse_mass: &'a [f64],
    /// A dragged vertex.
    pub hand: Option<Hand>,
}

/// The uniform `Scene` of shaders/card/scene.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
pub struct SceneData {
    pub gravity: [f32; 3],
    pub small: f32,
    pub keep: f32,
    pub unit: f32,
    pub limit: f32,
    pub vertices: u32,
    pub offset: f32,
    pub grip: f32,
    pub body_ease: f32,
    pub ease: f32,
    pub ahead: f32,
    pub thickness: f32,
    pub triangles: u32,
    pub flags: u32,
    pub span: f32,
    pub look_span: f32,
    pub walls: u32,
    pub contacts: u32,
    pub near: u32,
    pub part_walls: u32,
    pub part_contacts: u32,
    pub rounds: u32,
    pub most_reach: f32,
    pub hand: u32,
    pub hand_share: f32,
    pub hand_most: f32,
    pub hand_target: [i32; 3],
    pub floor: f32,
}

/// `x`, relative to `origin`, in units.
pub fn in_units(x: DVec3, origin: DVec3) -> IVec3 {
    ((x - origin) / UNIT).round().as_ivec3()
}
