//! Animations of a body from a glTF file, and the moment of them that the body is in.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde::{Deserialize, Serialize, Serializer};

use crate::body::{Imported, Unit, UpAxis};
use crate::geometry::mesh::TriMesh;
use crate::geometry::words::{Words, within_quotes, words};
use crate::io::gltf;
use crate::io::moving_body::MovingBody;
use crate::session::body_choice::BodyChoice;

/// A point in time of an animation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Moment {
    /// Index of the animation in its file, from 0.
    pub animation: usize,
    /// Time since its beginning, 0 to its length.
    pub seconds: f64,
}

/// The bytes of a glTF file and of the buffer files it refers to, as read.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "StoredFile", into = "StoredFile")]
pub struct AnimatedFile {
    /// File name, for the user.
    pub name: String,
    /// Content of the file.
    pub bytes: Vec<u8>,
    /// Buffer files it refers to, by name.
    pub buffers: BTreeMap<String, Vec<u8>>,
    /// Axis that points up in the file.
    pub up: UpAxis,
    /// Unit of length in the file.
    pub unit: Unit,
}

/// Animations of a body. Serialised as their file: it is the smallest complete form, and reading it again checks it.
#[derive(Deserialize)]
#[serde(try_from = "AnimatedFile")]
pub struct Animations {
    file: AnimatedFile,
    body: MovingBody,
    /// The body at rest.
    mesh: TriMesh,
}

impl Animations {
    /// Reads the animations in `file`, and the body at rest. The error says in words why there are none.
    pub fn new(file: AnimatedFile) -> Result<(Self, Imported), Words> {
        let load = |name: &str| {
            let buffer = file.buffers.get(name).cloned();
            let lost = || words!("its buffer \"{name}\" was not kept with it", name = within_quotes(name));
            buffer.ok_or_else(lost)
        };
        let told = |why: Words| Words::plain(&file.name).and(": ", why);
        let model = gltf::read(&file.bytes, &load).map_err(|why| told(why.words()))?;
        let (body, imported) = MovingBody::new(model, file.up, file.unit);
        if body.animations().next().is_none() {
            return Err(words!("there is no animation in {name}", name = file.name));
        }
        Ok((Self { body, mesh: imported.mesh.clone(), file }, imported))
    }

    /// Name of the file, for the user.
    pub fn name(&self) -> &str {
        &self.file.name
    }

    /// The body at rest.
    pub fn mesh(&self) -> &TriMesh {
        &self.mesh
    }

    /// Names of the animations in their order; one without a name is called by its number from 1.
    pub fn names(&self) -> impl Iterator<Item = String> {
        self.body.animations().enumerate().map(|(i, name)| match name.trim() {
            "" => format!("Animation {}", i + 1),
            name => name.to_owned(),
        })
    }

    /// Length of an animation, seconds. None: there is no such animation.
    pub fn seconds(&self, animation: usize) -> Option<f64> {
        self.body.seconds(animation)
    }

    /// The body under the name `name` at a moment; at rest without one. The error says in words that there is no such moment.
    pub fn body(&self, name: &str, at: Option<Moment>) -> Result<BodyChoice, Words> {
        if let Some(Moment { animation, seconds }) = at {
            let length = self.seconds(animation);
            let length = length.ok_or_else(|| {
                words!("{name} has no animation {n}", name = self.name(), n = animation + 1)
            })?;
            if !(0.0..=length).contains(&seconds) {
                return Err(words!(
                    "animation {n} lasts from 0 to {length} s, not {seconds}",
                    n = animation + 1,
                    length,
                    seconds
                ));
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
        Self::new(file).map(|(animations, _)| animations).map_err(String::from)
    }
}

/// An [`AnimatedFile`] with its bytes in base64.
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
