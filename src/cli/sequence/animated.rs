//! Frames of a sequence as the animation of a body in glTF.

use std::path::Path;
use std::sync::Arc;

use glam::DVec3;

use crate::body::{Surface, import};
use crate::cli::arguments::BodyFile;
use crate::cli::failure::Failure;
use crate::cli::formats;
use crate::geometry::mesh::TriMesh;
use crate::io::gltf::Model;

/// An animated body.
pub struct Animated {
    model: Model,
    how: BodyFile,
    metres: f64,
    /// Of the file's vertices those that the body has, as it is at rest.
    kept: Vec<u32>,
    at_rest: TriMesh,
    fps: f64,
}

impl Animated {
    /// The body in `bytes`, read from `path`, so many frames a second. It is brought to metres as it is at rest.
    pub fn new(path: &Path, bytes: &[u8], how: BodyFile, fps: f64) -> Result<Self, Failure> {
        let model = formats::model(path, bytes)?;
        if model.animations().next().is_none() {
            return Err(Failure::input(path, "there is no animation in it"));
        }
        let mut mesh = model.mesh();
        how.up.set_upright(&mut mesh);
        let unit = formats::body_unit(path, bytes, &mesh, how)?;
        let imported = import(mesh, unit);
        Ok(Self { model, how, metres: unit.metres(), kept: imported.kept, at_rest: imported.mesh, fps })
    }

    /// Frames of its first animation, the last one included.
    pub fn frames(&self) -> usize {
        ((self.model.seconds(0).unwrap_or(0.0) * self.fps + 1e-6).floor() as usize).saturating_add(1)
    }

    /// Which animations are left out, in words.
    pub fn notes(&self) -> Vec<String> {
        let names: Vec<&str> = self.model.animations().collect();
        let words =
            || format!("it has {} animations ({}): the first is taken", names.len(), names.join(", "));
        if names.len() > 1 { vec![words()] } else { Vec::new() }
    }

    /// The body in frame `i`. At rest it must have the triangles of `dressed`.
    pub fn body(&self, i: usize, dressed: &Surface, path: &Path) -> Result<Arc<Surface>, Failure> {
        formats::same_triangles(path, &self.at_rest, &dressed.mesh)?;
        let positions = self.model.positions(Some((0, i as f64 / self.fps)));
        let kept: Vec<DVec3> = self.kept.iter().map(|&v| positions[v as usize]).collect();
        let mut mesh = TriMesh { positions: kept, triangles: Vec::new() };
        self.how.up.set_upright(&mut mesh);
        mesh.positions.iter_mut().for_each(|p| *p *= self.metres);
        let words = || format!("frame {}: a vertex of it is no place", i + 1);
        dressed.reposed(mesh.positions).map(Arc::new).ok_or_else(|| Failure::input(path, words()))
    }
}
