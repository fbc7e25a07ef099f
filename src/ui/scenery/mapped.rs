//! Cloth in the colours of a map. No egui here: pictures without a window use it too.

use crate::render::{Mesh, Rgb, Textile};

/// Front and back colour under a map's colours, which are multiplied with it.
const PLAIN: Rgb = [255; 3];

/// The mesh with `colours`, one for each vertex; None if their number differs.
pub fn in_colours(mesh: &Mesh, colours: &[Rgb]) -> Option<Mesh> {
    (mesh.positions.len() == colours.len()).then(|| Mesh {
        colours: colours.to_vec(),
        front: PLAIN,
        back: PLAIN,
        flat: Vec::new(),
        textile: Textile::default(),
        ..mesh.clone()
    })
}
