//! The cloth of a scene in the colours of a map. No egui here: the headless pictures use it too.

use std::sync::Arc;

use crate::render::{Mesh, Rgb, Scene};

/// What the colours of a map are multiplied with.
const PLAIN: Rgb = [255; 3];

/// `scene` with `colours`, one for each vertex of its cloth, instead of the cloth's own. Cloth with another number of vertices
/// keeps its own.
pub fn mapped(mut scene: Scene, colours: &[Rgb]) -> Scene {
    for mesh in &mut scene.meshes {
        if mesh.cloth > 0.0
            && let Some(coloured) = in_colours(mesh, colours)
        {
            *mesh = Arc::new(coloured);
        }
    }
    scene
}

/// A mesh in `colours`, one for each vertex. None for another number of them.
pub fn in_colours(mesh: &Mesh, colours: &[Rgb]) -> Option<Mesh> {
    (mesh.positions.len() == colours.len()).then(|| Mesh {
        colours: colours.to_vec(),
        front: PLAIN,
        back: PLAIN,
        ..mesh.clone()
    })
}
