//! The choice of a body: the mannequin, posed or not, or a body from a file.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use crate::body::mannequin::{Measurements, mannequin};
use crate::body::pose::anatomy::Anatomy;
use crate::body::{NamedPose, Pose};
use crate::geometry::mesh::TriMesh;

/// The body that the cloth is put on.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BodyChoice {
    /// The built-in mannequin, made to measurements.
    Mannequin(Measurements),
    /// The mannequin with its joints rotated.
    Posed { measurements: Measurements, pose: Pose },
    /// A mesh from a file. It may have faults, which [`crate::session::body`] reports.
    Imported {
        name: String,
        #[serde(with = "mesh_as_arrays")]
        mesh: Arc<TriMesh>,
    },
}

impl BodyChoice {
    /// The mannequin of this body in `pose`; [`Self::Mannequin`] where no joint is rotated. None for a body from a file.
    pub fn posed(&self, pose: Pose) -> Option<Self> {
        let measurements = self.measurements()?;
        Some(match pose.turns.is_empty() {
            true => Self::Mannequin(measurements),
            false => Self::Posed { measurements, pose },
        })
    }

    /// The mannequin in the pose that it is built in. None where it is in that pose, and for a body from a file.
    pub fn as_built(&self) -> Option<Self> {
        match self {
            Self::Posed { measurements, .. } => Some(Self::Mannequin(*measurements)),
            Self::Mannequin(_) | Self::Imported { .. } => None,
        }
    }

    /// The mannequin of this body in a named pose. None for a body from a file, and for invalid measurements.
    pub fn in_named_pose(&self, pose: NamedPose) -> Option<Self> {
        let figure = mannequin(&self.measurements()?).ok()?;
        self.posed(pose.pose(&figure.skeleton))
    }

    /// Rotation axes of the mannequin's joints. None for a body from a file, and for invalid measurements.
    pub fn anatomy(&self) -> Option<Anatomy> {
        let figure = mannequin(&self.measurements()?).ok()?;
        Some(Anatomy::new(&figure.skeleton))
    }

    /// Measurements of the mannequin. None for a body from a file.
    pub fn measurements(&self) -> Option<Measurements> {
        match self {
            Self::Mannequin(measurements) | Self::Posed { measurements, .. } => Some(*measurements),
            Self::Imported { .. } => None,
        }
    }

    /// Joint rotations of the mannequin; empty in the pose it is built in. None for a body from a file.
    pub fn pose(&self) -> Option<Pose> {
        match self {
            Self::Mannequin(_) => Some(Pose::default()),
            Self::Posed { pose, .. } => Some(pose.clone()),
            Self::Imported { .. } => None,
        }
    }

    /// Name for the user.
    pub fn name(&self) -> &str {
        match self {
            Self::Mannequin(_) | Self::Posed { .. } => "mannequin",
            Self::Imported { name, .. } => name,
        }
    }
}

impl PartialEq for BodyChoice {
    fn eq(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Mannequin(one), Self::Mannequin(other)) => one == other,
            (Self::Posed { measurements, pose }, Self::Posed { measurements: other, pose: other_pose }) => {
                measurements == other && pose == other_pose
            }
            (Self::Imported { name, mesh }, Self::Imported { name: other_name, mesh: other_mesh }) => {
                name == other_name && (Arc::ptr_eq(mesh, other_mesh) || mesh == other_mesh)
            }
            _ => false,
        }
    }
}

impl Default for BodyChoice {
    fn default() -> Self {
        Self::Mannequin(Measurements::default())
    }
}

mod mesh_as_arrays {
    use std::sync::Arc;

    use glam::DVec3;
    use serde::{Deserialize, Deserializer, Serialize, Serializer, de};

    use crate::geometry::mesh::TriMesh;

    #[derive(Serialize)]
    struct Borrowed<'a> {
        positions: &'a [DVec3],
        triangles: &'a [[u32; 3]],
    }

    #[derive(Deserialize)]
    struct Owned {
        positions: Vec<DVec3>,
        triangles: Vec<[u32; 3]>,
    }

    pub fn serialize<S: Serializer>(mesh: &Arc<TriMesh>, to: S) -> Result<S::Ok, S::Error> {
        Borrowed { positions: &mesh.positions, triangles: &mesh.triangles }.serialize(to)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Arc<TriMesh>, D::Error> {
        let Owned { positions, triangles } = Owned::deserialize(from)?;
        if triangles.iter().flatten().any(|&v| v as usize >= positions.len()) {
            return Err(de::Error::custom("a triangle of the body names a vertex that is not there"));
        }
        Ok(Arc::new(TriMesh { positions, triangles }))
    }
}
