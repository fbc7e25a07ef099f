//! The body chosen in a document, prepared for queries.

use std::sync::{Arc, OnceLock};

use crate::body::mannequin::{Counterpart, mannequin};
use crate::body::pose::rig;
use crate::body::readings::{Reading, readings};
use crate::body::{Landmarks, Surface, bones};
use crate::contact::Bone;
use crate::geometry::mesh::TriMesh;
use crate::geometry::words::words;
use crate::repose::PosePath;
use crate::session::body_choice::BodyChoice;
use crate::session::command::Rejection;
use crate::session::document::Aim;

/// Most bodies cached, so that undo of a change of body is fast.
const MOST_KEPT: usize = 4;

/// A body's surface and its named points.
#[derive(Debug)]
pub struct Body {
    /// Its skin.
    pub surface: Arc<Surface>,
    /// Bones it was made with, or else those found in it; computed once.
    bones: OnceLock<Arc<Vec<Bone>>>,
    /// Landmarks it was made with; None for a body from a file.
    own: Option<Landmarks>,
}

impl Body {
    /// Builds the body of `choice`. The error says why cloth cannot be put on it.
    pub fn new(choice: &BodyChoice) -> Result<Self, Rejection> {
        let (surface, bones, own) = match choice {
            BodyChoice::Mannequin(measurements) => {
                let figure = mannequin(measurements).map_err(|e| Rejection(e.words()))?;
                let surface = ready(figure.mesh.clone(), "the mannequin")?;
                let bones = Arc::new(figure.skeleton.six_segments());
                (surface, OnceLock::from(bones), Some(figure.landmarks.clone()))
            }
            BodyChoice::Imported { name, mesh } => {
                (ready(mesh.as_ref().clone(), name)?, OnceLock::new(), None)
            }
            BodyChoice::Posed { measurements, pose } => {
                let rig = rig(measurements).map_err(|e| Rejection(e.words()))?;
                let posed = rig.posed(pose);
                let posed = posed.ok_or_else(|| Rejection(words!("the mannequin cannot take this pose")))?;
                let bones = Arc::new(posed.skeleton.six_segments());
                (posed.surface, OnceLock::from(bones), Some(posed.landmarks))
            }
        };
        Ok(Self { surface, bones, own })
    }

    /// Bones that cloth cannot be pulled across: of its skeleton, or found between the landmarks of a body that looks human.
    pub fn bones(&self) -> &Arc<Vec<Bone>> {
        self.bones.get_or_init(|| {
            let marks = self.landmarks();
            Arc::new(marks.map(|marks| bones::extracted(&self.surface, marks)).unwrap_or_default())
        })
    }

    /// Landmarks of the body, if it has any.
    pub fn landmarks(&self) -> Option<&Landmarks> {
        self.own.as_ref().or_else(|| self.surface.landmarks())
    }

    /// Landmarks of this body and of `other` with the same meaning: those both were made with, or else those found on both.
    pub fn common_landmarks<'a>(&'a self, other: &'a Self) -> Option<(&'a Landmarks, &'a Landmarks)> {
        match (&self.own, &other.own) {
            (Some(own), Some(others)) => Some((own, others)),
            _ => Some((self.surface.landmarks()?, other.surface.landmarks()?)),
        }
    }
}

/// Cache of bodies, the newest last.
#[derive(Debug, Default)]
pub struct BodyCache {
    kept: Vec<(BodyChoice, Arc<Body>)>,
    /// The last pose interpolation path.
    way: Option<(Arc<Aim>, PosePath)>,
}

impl BodyCache {
    /// The body of `choice`, from the cache or built. The error says why cloth cannot be put on it.
    pub fn body(&mut self, choice: &BodyChoice) -> Result<Arc<Body>, Rejection> {
        if let Some(i) = self.kept.iter().position(|(kept, _)| kept == choice) {
            let found = self.kept.remove(i);
            let body = Arc::clone(&found.1);
            self.kept.push(found);
            return Ok(body);
        }
        let body = Arc::new(Body::new(choice)?);
        if self.kept.len() >= MOST_KEPT {
            self.kept.remove(0);
        }
        self.kept.push((choice.clone(), Arc::clone(&body)));
        Ok(body)
    }

    /// The body at `share` 0..=1 of the way from `aim.from` to `aim.to`. The error says why there is none.
    pub fn between(&mut self, aim: &Arc<Aim>, share: f64) -> Result<BodyChoice, Rejection> {
        if share == 0.0 || share == 1.0 {
            return Ok(if share == 0.0 { aim.from.clone() } else { aim.to.clone() });
        }
        if self.way.as_ref().is_none_or(|(of, _)| !Arc::ptr_eq(of, aim)) {
            let (from, to) = (self.surface(&aim.from)?, self.surface(&aim.to)?);
            let words =
                words!("there is no way from {one} to {other}", one = aim.from.name(), other = aim.to.name());
            let way = PosePath::new(&from, &to).ok_or(Rejection(words))?;
            self.way = Some((Arc::clone(aim), way));
        }
        let way = self.way.as_ref().map(|(_, way)| way);
        let positions = way.and_then(|way| way.positions(share));
        let positions =
            positions.ok_or_else(|| Rejection(words!("the body cannot take a pose on this way")))?;
        let triangles = self.surface(&aim.from)?.mesh.triangles.clone();
        let mesh = Arc::new(TriMesh { positions, triangles });
        Ok(BodyChoice::Imported { name: aim.to.name().to_owned(), mesh })
    }

    /// Positions of the mannequin `to` in the triangles of the mannequin `from`, as a surface. The error says why there is none.
    pub fn in_triangles_of(&mut self, from: &BodyChoice, to: &BodyChoice) -> Result<Arc<Surface>, Rejection> {
        let words = || {
            Rejection(words!("{name} is not {other} in another size", name = to.name(), other = from.name()))
        };
        let figure = |choice: &BodyChoice| mannequin(&choice.measurements()?).ok();
        let same = figure(from).zip(figure(to)).and_then(|(one, other)| Counterpart::new(&one, &other));
        let positions = same.ok_or_else(words)?.positions(&self.surface(to)?.mesh);
        self.surface(from)?.reposed(positions).map(Arc::new).ok_or_else(words)
    }

    /// The surface of `choice`. The error says why cloth cannot be put on it.
    pub fn surface(&mut self, choice: &BodyChoice) -> Result<Arc<Surface>, Rejection> {
        self.body(choice).map(|body| Arc::clone(&body.surface))
    }

    /// The surface of `choice`, if it is in the cache.
    pub fn kept(&self, choice: &BodyChoice) -> Option<&Arc<Surface>> {
        self.kept.iter().find(|(kept, _)| kept == choice).map(|(_, body)| &body.surface)
    }
}

/// Builds the surface of `choice`, without a cache.
pub fn surface_of(choice: &BodyChoice) -> Result<Arc<Surface>, Rejection> {
    Body::new(choice).map(|body| body.surface)
}

/// Body measurements of `choice`, whose skin is `mesh`. None for a body that is not a standing human.
pub fn readings_of(choice: &BodyChoice, mesh: &TriMesh) -> Option<Vec<Reading>> {
    let own = match choice {
        BodyChoice::Mannequin(measurements) => {
            mannequin(measurements).ok().map(|figure| figure.landmarks.clone())
        }
        BodyChoice::Posed { measurements, pose } => {
            rig(measurements).ok().and_then(|rig| rig.posed(pose)).map(|posed| posed.landmarks)
        }
        BodyChoice::Imported { .. } => None,
    };
    readings(mesh, own.as_ref())
}

fn ready(mesh: TriMesh, name: &str) -> Result<Arc<Surface>, Rejection> {
    let surface = Surface::new(mesh).map(Arc::new);
    surface.ok_or_else(|| Rejection(words!("{name} has no triangle that cloth could lie on", name)))
}
