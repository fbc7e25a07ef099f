//! Cloth in the colours of a map. No egui here: the headless pictures use it too.

use crate::render::{Mesh, Rgb};

/// What the colours of a map are multiplied with.
const PLAIN: Rgb = [255; 3];

/// A mesh in `colours`, one for each vertex. None for another number of them.
pub fn in_colours(mesh: &Mesh, colours: &[Rgb]) -> Option<Mesh> {
    (mesh.positions.len() == colours.len()).then(|| Mesh {
        colours: colours.to_vec(),
        front: PLAIN,
        back: PLAIN,
        ..mesh.clone()
    })
}
