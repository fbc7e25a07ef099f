//! The animations that came with a body from a file, and which moment of them it is in.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde::{Deserialize, Serialize, Serializer};

use crate::body::{Imported, Unit, UpAxis};
use crate::geometry::mesh::TriMesh;
use crate::io::gltf;
use crate::io::moving_body::MovingBody;
use crate::session::body_choice::BodyChoice;

/// A moment of an animation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Moment {
    /// Its place among those of its file, from 0.
    pub animation: usize,
    /// Since its beginning, 0 to its length.
    pub seconds: f64,
}

/// A glTF file with what it names, as it was read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "StoredFile", into = "StoredFile")]
pub struct AnimatedFile {
    /// For people.
    pub name: String,
    /// All of it.
    pub bytes: Vec<u8>,
    /// Files that it names.
    pub buffers: BTreeMap<String, Vec<u8>>,
    /// What points up in it.
    pub up: UpAxis,
    /// What its lengths are in.
    pub unit: Unit,
}

/// The animations of a body. Kept with their file: it says the least there is to say, and reading it again checks it.
#[derive(Deserialize)]
#[serde(try_from = "AnimatedFile")]
pub struct Animations {
    file: AnimatedFile,
    body: MovingBody,
    /// At rest.
    mesh: TriMesh,
}

impl Animations {
    /// Those in `file`, and the body that it is at rest. The error says in words why there are none.
    pub fn new(file: AnimatedFile) -> Result<(Self, Imported), String> {
        let load = |name: &str| {
            let buffer = file.buffers.get(name).cloned();
            buffer.ok_or_else(|| format!("its buffer {name:?} was not kept with it"))
        };
        let model = gltf::read(&file.bytes, &load).map_err(|why| format!("{}: {why}", file.name))?;
        let (body, imported) = MovingBody::new(model, file.up, file.unit);
        if body.animations().next().is_none() {
            return Err(format!("there is no animation in {}", file.name));
        }
        Ok((Self { body, mesh: imported.mesh.clone(), file }, imported))
    }

    /// Of their file, for people.
    pub fn name(&self) -> &str {
        &self.file.name
    }

    /// The body that they move, at rest.
    pub fn mesh(&self) -> &TriMesh {
        &self.mesh
    }

    /// What they are called, in their order: by their number from 1 where one has no name.
    pub fn names(&self) -> impl Iterator<Item = String> {
        self.body.animations().enumerate().map(|(i, name)| match name.trim() {
            "" => format!("Animation {}", i + 1),
            name => name.to_owned(),
        })
    }

    /// How long an animation lasts, seconds. None: there is no such animation.
    pub fn seconds(&self, animation: usize) -> Option<f64> {
        self.body.seconds(animation)
    }

    /// The body of this name at a moment; at rest without one. The error says in words that there is no such moment.
    pub fn body(&self, name: &str, at: Option<Moment>) -> Result<BodyChoice, String> {
        if let Some(Moment { animation, seconds }) = at {
            let length = self.seconds(animation);
            let length =
                length.ok_or_else(|| format!("{} has no animation {}", self.name(), animation + 1))?;
            if !(0.0..=length).contains(&seconds) {
                return Err(format!("animation {} lasts from 0 to {length} s, not {seconds}", animation + 1));
            }
        }
        let positions = self.body.positions(at.map(|at| (at.animation, at.seconds)));
        let mesh = Arc::new(TriMesh { positions, triangles: self.mesh.triangles.clone() });
        Ok(BodyChoice::Imported { name: name.to_owned(), mesh })
    }
}

impl PartialEq for Animations {
    fn eq(&self, other: &Self) -> bool {
        self.file == other.file
    }
}

impl fmt::Debug for Animations {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Animations").field("name", &self.file.name).finish_non_exhaustive()
    }
}

impl Serialize for Animations {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        self.file.serialize(to)
    }
}

impl TryFrom<AnimatedFile> for Animations {
    type Error = String;

    fn try_from(file: AnimatedFile) -> Result<Self, String> {
        Self::new(file).map(|(animations, _)| animations)
    }
}

/// The same as text.
#[derive(Serialize, Deserialize)]
struct StoredFile {
    name: String,
    file: String,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    buffers: BTreeMap<String, String>,
    up: UpAxis,
    unit: Unit,
}

impl From<AnimatedFile> for StoredFile {
    fn from(file: AnimatedFile) -> Self {
        let AnimatedFile { name, bytes, buffers, up, unit } = file;
        let buffers = buffers.into_iter().map(|(name, bytes)| (name, STANDARD.encode(bytes))).collect();
        Self { name, file: STANDARD.encode(bytes), buffers, up, unit }
    }
}

impl TryFrom<StoredFile> for AnimatedFile {
    type Error = String;

    fn try_from(stored: StoredFile) -> Result<Self, String> {
        let StoredFile { name, file, buffers, up, unit } = stored;
        let bytes = |text: String| {
            STANDARD.decode(text).map_err(|why| format!("the animations of {name} are not whole: {why}"))
        };
        let buffers = buffers.into_iter().map(|(name, text)| Ok((name, bytes(text)?)));
        let (buffers, bytes) = (buffers.collect::<Result<_, String>>()?, bytes(file)?);
        Ok(Self { name, bytes, buffers, up, unit })
    }
}
