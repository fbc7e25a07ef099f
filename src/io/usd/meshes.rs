//! Meshes of USD.

use glam::{DVec2, DVec3};

use super::prim::{Prim, integers, quoted, tuples};
use crate::geometry::mesh::bounds;

/// A mesh; one entry of each array per vertex.
#[derive(Clone, Copy, Debug)]
pub(super) struct MeshArrays<'a> {
    /// Metres.
    pub positions: &'a [DVec3],
    /// Unit normals.
    pub normals: &'a [DVec3],
    /// Counter-clockwise seen from outside.
    pub triangles: &'a [[u32; 3]],
    /// Texture coordinates with v upwards, by their names; those without entries are left out.
    pub coordinates: [(&'static str, &'a [DVec2]); 2],
    /// Whether the other side is seen, too.
    pub is_double_sided: bool,
    /// Base colour, linear RGB, 0..=1, for programs that show no materials.
    pub colour: [f32; 3],
}

/// Positions and normals of a mesh in one frame.
pub(super) type MovedMesh = (Vec<DVec3>, Vec<DVec3>);

/// The mesh called `name`, made of the material at `material`.
pub(super) fn mesh(name: &str, material: &str, arrays: MeshArrays<'_>) -> Prim {
    let MeshArrays { positions, normals, triangles, coordinates, is_double_sided, colour } = arrays;
    let mut mesh = Prim::new("Mesh", name);
    mesh.metadata("prepend apiSchemas", "[\"MaterialBindingAPI\"]");
    mesh.attribute("uniform bool doubleSided", if is_double_sided { "1" } else { "0" });
    mesh.attribute("float3[] extent", &extent(positions));
    mesh.attribute("int[] faceVertexCounts", &integers(triangles.iter().map(|_| 3)));
    mesh.attribute("int[] faceVertexIndices", &integers(triangles.iter().flatten().copied()));
    mesh.relate("material:binding", material);
    mesh.of_vertices("normal3f[] normals", &vectors(normals));
    mesh.attribute("uniform token orientation", &quoted("rightHanded"));
    mesh.attribute("point3f[] points", &vectors(positions));
    mesh.attribute("color3f[] primvars:displayColor", &tuples([colour].into_iter()));
    for (name, places) in coordinates {
        if !places.is_empty() {
            let places = tuples(places.iter().map(|p| p.as_vec2().to_array()));
            mesh.of_vertices(&format!("texCoord2f[] primvars:{name}"), &places);
        }
    }
    mesh.attribute("uniform token subdivisionScheme", &quoted("none"));
    mesh
}

/// Moves `mesh` through `frames`.
pub(super) fn move_through(mesh: &mut Prim, frames: &[MovedMesh]) {
    mesh.samples("float3[] extent", frames.iter().map(|(positions, _)| extent(positions)));
    mesh.samples("normal3f[] normals", frames.iter().map(|(_, normals)| vectors(normals)));
    mesh.samples("point3f[] points", frames.iter().map(|(positions, _)| vectors(positions)));
}

/// The lower and the upper corner of the box around `points`. Cloth that is not yet on the body has points that are not finite.
fn extent(points: &[DVec3]) -> String {
    let finite: Vec<DVec3> = points.iter().copied().filter(|p| p.is_finite()).collect();
    let (low, high) = bounds(&finite);
    vectors(&[low, high])
}

fn vectors(vectors: &[DVec3]) -> String {
    tuples(vectors.iter().map(|v| v.as_vec3().to_array()))
}
