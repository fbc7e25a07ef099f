//! The body a document chooses, made ready for queries.

use std::sync::Arc;

use crate::body::Surface;
use crate::body::mannequin::mannequin;
use crate::geometry::mesh::TriMesh;
use crate::session::command::Rejection;
use crate::session::document::BodyChoice;

/// Surfaces kept, so that undo of a change of body is quick.
const MOST_KEPT: usize = 4;

/// Surfaces made before, the newest last.
#[derive(Debug, Default)]
pub struct BodyCache {
    kept: Vec<(BodyChoice, Arc<Surface>)>,
}

impl BodyCache {
    /// The surface of `choice`. The error says why cloth cannot be put on it.
    pub fn surface(&mut self, choice: &BodyChoice) -> Result<Arc<Surface>, Rejection> {
        if let Some(i) = self.kept.iter().position(|(kept, _)| kept == choice) {
            let found = self.kept.remove(i);
            let surface = Arc::clone(&found.1);
            self.kept.push(found);
            return Ok(surface);
        }
        let surface = surface_of(choice)?;
        if self.kept.len() >= MOST_KEPT {
            self.kept.remove(0);
        }
        self.kept.push((choice.clone(), Arc::clone(&surface)));
        Ok(surface)
    }

    /// The surface of `choice`, if it was made before.
    pub fn kept(&self, choice: &BodyChoice) -> Option<&Arc<Surface>> {
        self.kept.iter().find(|(kept, _)| kept == choice).map(|(_, surface)| surface)
    }
}

/// Makes the surface of `choice`.
pub fn surface_of(choice: &BodyChoice) -> Result<Arc<Surface>, Rejection> {
    match choice {
        BodyChoice::Mannequin(measurements) => {
            let figure = mannequin(measurements).map_err(|e| Rejection(e.to_string()))?;
            ready(figure.mesh.clone(), "the mannequin")
        }
        BodyChoice::Imported { name, mesh } => ready(mesh.as_ref().clone(), name),
    }
}

fn ready(mesh: TriMesh, name: &str) -> Result<Arc<Surface>, Rejection> {
    let surface = Surface::new(mesh).map(Arc::new);
    surface.ok_or_else(|| Rejection(format!("{name} has no triangle that cloth could lie on")))
}
