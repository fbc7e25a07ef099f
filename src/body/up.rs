//! The up axis of meshes and motions from files.

use std::fmt;
use std::str::FromStr;

use glam::DVec3;

use crate::geometry::mesh::TriMesh;

/// The axis of a file that points up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum UpAxis {
    /// y is up, as in this program.
    #[default]
    Y,
    /// z is up, as in CAD and game programs; the body faces -y there.
    Z,
}

/// Ratio of z extent to y extent above which z is taken for the up axis.
const LYING: f64 = 2.0;

impl UpAxis {
    /// Both axes.
    pub const ALL: [Self; 2] = [Self::Y, Self::Z];

    /// The likely up axis of a body or a skeleton, by the sides of its bounding box (x, y, z): z where it is much
    /// longer in z than in y, because it would be lying otherwise.
    pub fn guess(size: DVec3) -> Self {
        if size.z > LYING * size.y { Self::Z } else { Self::Y }
    }

    /// Height of a body with these sides of its bounding box.
    pub fn height(self, size: DVec3) -> f64 {
        match self {
            Self::Y => size.y,
            Self::Z => size.z,
        }
    }

    /// Rotates `mesh` so that this axis becomes y.
    pub fn set_upright(self, mesh: &mut TriMesh) {
        mesh.positions.iter_mut().for_each(|p| *p = self.upright(*p));
    }

    /// The point `p` after the rotation that turns this axis to y.
    pub fn upright(self, p: DVec3) -> DVec3 {
        match self {
            Self::Y => p,
            Self::Z => DVec3::new(p.x, p.z, -p.y),
        }
    }
}

impl fmt::Display for UpAxis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Y => "y",
            Self::Z => "z",
        })
    }
}

/// Error: a text that names no axis.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0:?} is no axis that points up; y and z are known")]
pub struct UnknownAxis(pub String);

impl FromStr for UpAxis {
    type Err = UnknownAxis;

    fn from_str(text: &str) -> Result<Self, UnknownAxis> {
        match text.trim().to_ascii_lowercase().as_str() {
            "y" => Ok(Self::Y),
            "z" => Ok(Self::Z),
            _ => Err(UnknownAxis(text.chars().take(40).collect())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_body_that_lies_is_set_upright_and_keeps_its_outside() {
        // Standing along z, facing -y, its left hand at +x.
        let points = [[0.0, 0.0, 0.0], [0.3, 0.0, 0.0], [0.0, -0.1, 0.0], [0.0, 0.0, 1.7]].map(DVec3::from);
        let mut mesh = TriMesh {
            positions: points.to_vec(),
            triangles: vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
        };
        let (lower, upper) = mesh.bounds();
        assert_eq!(UpAxis::guess(upper - lower), UpAxis::Z);
        let volume = |mesh: &TriMesh| -> f64 {
            let corners = mesh.triangles.iter().map(|t| t.map(|v| mesh.positions[v as usize]));
            corners.map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
        };
        let before = volume(&mesh);
        UpAxis::Z.set_upright(&mut mesh);
        assert_eq!(mesh.positions[3], DVec3::Y * 1.7);
        assert_eq!(mesh.positions[2], DVec3::Z * 0.1, "it faces +z");
        assert!((volume(&mesh) - before).abs() < 1e-12);
        let (lower, upper) = mesh.bounds();
        assert_eq!(UpAxis::guess(upper - lower), UpAxis::Y);
        assert_eq!(UpAxis::guess(DVec3::new(1.7, 1.7, 0.3)), UpAxis::Y);
        assert!("w".parse::<UpAxis>().is_err() && "Z".parse() == Ok(UpAxis::Z));
    }
}
