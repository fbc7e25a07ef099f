//! A body from a file that has animations: its vertices as it was imported, through them.

use glam::DVec3;

use crate::body::{Imported, Unit, UpAxis, import};
use crate::io::gltf::Model;

/// A scene taken as a body, in metres and upright.
#[derive(Debug)]
pub struct MovingBody {
    model: Model,
    up: UpAxis,
    metres: f64,
    /// Of the file's vertices those that the body has.
    kept: Vec<u32>,
}

impl MovingBody {
    /// The scene of `model`, where `up` points up and lengths are in `unit`; with the body that it is at rest.
    pub fn new(model: Model, up: UpAxis, unit: Unit) -> (Self, Imported) {
        let mut mesh = model.mesh();
        up.set_upright(&mut mesh);
        let imported = import(mesh, unit);
        (Self { model, up, metres: unit.metres(), kept: imported.kept.clone() }, imported)
    }

    /// Names of its animations, in their order; the empty name where one has none.
    pub fn animations(&self) -> impl Iterator<Item = &str> {
        self.model.animations()
    }

    /// How long an animation lasts, seconds. None: there is no such animation.
    pub fn seconds(&self, animation: usize) -> Option<f64> {
        self.model.seconds(animation)
    }

    /// Where the vertices of the imported body are, metres, at rest or in an animation at a time in seconds.
    pub fn positions(&self, at: Option<(usize, f64)>) -> Vec<DVec3> {
        let positions = self.model.positions(at);
        let place = |v: &u32| self.up.upright(positions[*v as usize]) * self.metres;
        self.kept.iter().map(place).collect()
    }
}
