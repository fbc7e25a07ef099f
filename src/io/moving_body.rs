//! An animated body from a glTF file: the vertex positions of the imported body at a time of an animation.

use glam::DVec3;

use crate::body::{Imported, Unit, UpAxis, import};
use crate::io::gltf::Model;

/// A glTF scene used as a body, in metres with y up.
#[derive(Debug)]
pub struct MovingBody {
    model: Model,
    up: UpAxis,
    metres: f64,
    /// Indices, into the file's vertices, of the vertices that the import kept.
    kept: Vec<u32>,
}

impl MovingBody {
    /// Imports the scene of `model`. `up` is the file's up axis and `unit` its unit of length. Returns the scene and the body at
    /// rest.
    pub fn new(model: Model, up: UpAxis, unit: Unit) -> (Self, Imported) {
        let mut mesh = model.mesh();
        up.set_upright(&mut mesh);
        let imported = import(mesh, unit);
        (Self { model, up, metres: unit.metres(), kept: imported.kept.clone() }, imported)
    }

    /// Names of the animations, in the order of the file; empty for an animation without a name.
    pub fn animations(&self) -> impl Iterator<Item = &str> {
        self.model.animations()
    }

    /// Duration of an animation, seconds; None if there is no such animation.
    pub fn seconds(&self, animation: usize) -> Option<f64> {
        self.model.seconds(animation)
    }

    /// Positions of the imported body's vertices, metres, at rest (None) or in an animation at a time in seconds.
    pub fn positions(&self, at: Option<(usize, f64)>) -> Vec<DVec3> {
        let positions = self.model.positions(at);
        let place = |v: &u32| self.up.upright(positions[*v as usize]) * self.metres;
        self.kept.iter().map(place).collect()
    }
}
