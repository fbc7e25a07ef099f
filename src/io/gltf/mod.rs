//! Bodies from glTF 2.0, text (.gltf) or binary (.glb): meshes with their nodes, skins, morph targets and animations.
//!
//! The `gltf` crate reads the structure and checks its references. The numbers are read from the buffers here, each within its
//! bounds. All meshes of the scene become one; materials and images are not read.

mod animate;
mod numbers;

use base64::Engine as _;
use glam::{DAffine3, DMat4, DQuat, DVec3};
use gltf::mesh::{Mode, Semantic};
use gltf::scene::Transform;

use crate::geometry::mesh::TriMesh;
use crate::geometry::words::{Words, words};
use crate::io::Limits;
use crate::io::words::readable_words;
use animate::Clip;
use numbers::Numbers;

/// Number of attribute sets `JOINTS_n` and `WEIGHTS_n` that are read; each gives a vertex up to 4 joints.
const MOST_JOINT_SETS: u32 = 4;
/// Prefix of a data URI, which holds a buffer in the text itself.
const INLINE: &str = "data:";

/// Why a file cannot be read as a body.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", self.words())]
pub enum GltfError {
    /// What is wrong, and where: "mesh 2, primitive 0: ...".
    File(Words),
    /// The file exceeds a limit; the text names it.
    OverLimit(Words),
}

impl GltfError {
    /// The error in words.
    pub fn words(&self) -> Words {
        match self {
            Self::File(words) => words.clone(),
            Self::OverLimit(what) => words!("over the limit: {what}", what),
        }
    }
}

fn fault(words: Words) -> GltfError {
    GltfError::File(words)
}

/// A scene of meshes with its nodes, skins and animations, evaluated by [`Model::positions`].
#[derive(Debug)]
pub struct Model {
    nodes: Vec<Node>,
    /// Indices of `nodes` with each parent before its children.
    order: Vec<usize>,
    parts: Vec<Part>,
    skins: Vec<Skin>,
    clips: Vec<Clip>,
    triangles: Vec<[u32; 3]>,
}

/// A node of the scene in its rest state.
#[derive(Clone, Debug)]
struct Node {
    parent: Option<usize>,
    at_rest: Pose,
    /// Weights of its mesh's morph targets.
    weights: Vec<f64>,
}

/// Local transform of a node, relative to its parent.
#[derive(Clone, Copy, Debug)]
struct Pose {
    translation: DVec3,
    rotation: DQuat,
    scale: DVec3,
}

impl Pose {
    fn matrix(&self) -> DMat4 {
        DMat4::from_scale_rotation_translation(self.scale, self.rotation, self.translation)
    }
}

/// The vertices and triangles of one primitive.
#[derive(Debug)]
struct Part {
    node: usize,
    positions: Vec<DVec3>,
    /// For each morph target the displacement of each vertex.
    targets: Vec<Vec<DVec3>>,
    /// Triangles as indices into `positions`.
    triangles: Vec<[u32; 3]>,
    /// Index of the skin, and the skin weights of the vertices.
    skin: Option<(usize, Hanging)>,
}

/// Skin weights: for each vertex its joints (indices into the skin's joints) and their weights, whose sum is 1.
type Hanging = Vec<Vec<(usize, f64)>>;

#[derive(Debug)]
struct Skin {
    /// For each joint the index of its node and the inverse bind matrix.
    joints: Vec<(usize, DMat4)>,
}

/// Whether `bytes` are glTF: binary by its magic number, text by a JSON object with an "asset".
pub fn is_gltf(bytes: &[u8]) -> bool {
    let head = &bytes[..bytes.len().min(1 << 16)];
    let has = |word: &[u8]| head.windows(word.len()).any(|at| at == word);
    let is_object = || head.trim_ascii_start().first() == Some(&b'{');
    // JSON keys may come in any order, so "asset" may be at the end of the file. "panels" is the key of a GarmentCode pattern.
    bytes.starts_with(b"glTF")
        || (is_object() && (has(b"\"asset\"") || tail_has(bytes, b"\"asset\"")) && !has(b"\"panels\""))
}

fn tail_has(bytes: &[u8], word: &[u8]) -> bool {
    let tail = &bytes[bytes.len().saturating_sub(1 << 16)..];
    tail.windows(word.len()).any(|at| at == word)
}

/// Reads a scene. `load` gives the buffer file that the text names, or the error in words.
pub fn read(bytes: &[u8], load: &dyn Fn(&str) -> Result<Vec<u8>, Words>) -> Result<Model, GltfError> {
    let most = Limits::default().file_bytes;
    if bytes.len() > most {
        return Err(GltfError::OverLimit(words!("the file has more than {most} bytes", most)));
    }
    let unread = |error: gltf::Error| {
        let why = error.to_string();
        fault(readable_words(words!("this is no glTF that can be read: {why}", why)))
    };
    told_length(bytes)?;
    let file = gltf::Gltf::from_slice_without_validation(bytes).map_err(unread)?;
    names_what_is_there(file.document.as_json())?;
    let document = gltf::Document::from_json(file.document.into_json()).map_err(unread)?;
    let buffers = document.buffers().map(|buffer| match buffer.source() {
        gltf::buffer::Source::Bin => {
            file.blob.clone().ok_or_else(|| fault(words!("its binary part is missing")))
        }
        gltf::buffer::Source::Uri(uri) if uri.starts_with(INLINE) => inline(uri),
        gltf::buffer::Source::Uri(uri) => load(uri).map_err(fault),
    });
    let buffers: Vec<Vec<u8>> = buffers.collect::<Result<_, _>>()?;
    Model::new(&document, &Numbers { buffers: &buffers })
}

/// Refuses a binary file whose header states a length shorter than the header itself, which the crate does not check.
fn told_length(bytes: &[u8]) -> Result<(), GltfError> {
    const HEADER: usize = 12;
    let told = bytes.strip_prefix(b"glTF").and_then(|rest| rest.get(4..8));
    match told.map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]) as usize) {
        Some(length) if length < HEADER => Err(fault(words!(
            "its header says that it has {length} bytes, but the header alone has {least}",
            length,
            least = HEADER
        ))),
        _ => Ok(()),
    }
}

/// Checks references that the crate takes for granted: the accessors of positions, and what animations move.
fn names_what_is_there(root: &gltf::json::Root) -> Result<(), GltfError> {
    let missing = |place: Words, words: Words| {
        Err(fault(words!("this is no glTF that can be read: {why}", why = place.and(": ", words))))
    };
    let positions = gltf::json::validation::Checked::Valid(Semantic::Positions);
    for (m, mesh) in root.meshes.iter().enumerate() {
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            let accessor = primitive.attributes.get(&positions);
            if accessor.is_some_and(|accessor| accessor.value() >= root.accessors.len()) {
                return missing(primitive_place(m, p), words!("its places are not there"));
            }
        }
    }
    for (a, animation) in root.animations.iter().enumerate() {
        for (c, channel) in animation.channels.iter().enumerate() {
            if channel.target.node.value() >= root.nodes.len() {
                return missing(channel_place(a, c), words!("the node that it moves is not there"));
            }
            if !matches!(channel.target.path, gltf::json::validation::Checked::Valid(_)) {
                return missing(channel_place(a, c), words!("what it moves of the node is not known"));
            }
        }
    }
    Ok(())
}

fn primitive_place(mesh: usize, primitive: usize) -> Words {
    words!("mesh {mesh}, primitive {primitive}", mesh, primitive)
}

fn channel_place(animation: usize, channel: usize) -> Words {
    words!("animation {animation}, channel {channel}", animation, channel)
}

/// Decodes a data URI, such as "data:application/octet-stream;base64,AAAA".
fn inline(uri: &str) -> Result<Vec<u8>, GltfError> {
    let text = uri.split_once(";base64,").map(|(_, text)| text);
    let text = text.ok_or_else(|| fault(words!("a buffer in the text is not written as base64")))?;
    let bytes = base64::engine::general_purpose::STANDARD.decode(text);
    bytes.map_err(|e| fault(words!("a buffer in the text is no base64: {why}", why = e.to_string())))
}

impl Model {
    fn new(document: &gltf::Document, numbers: &Numbers<'_>) -> Result<Self, GltfError> {
        let (nodes, order) = nodes(document)?;
        let shown = shown(document, &nodes, &order);
        let (mut parts, mut triangles, mut vertices) = (Vec::new(), Vec::new(), 0);
        for node in document.nodes().filter(|node| shown[node.index()]) {
            let Some(mesh) = node.mesh() else { continue };
            for primitive in mesh.primitives() {
                let place = primitive_place(mesh.index(), primitive.index());
                let Some(part) = part(&node, &primitive, numbers, &place)? else { continue };
                let first = u32::try_from(vertices).map_err(|_| over(&place))?;
                vertices += part.positions.len();
                triangles.extend(part.triangles.iter().map(|t| t.map(|v| first + v)));
                if vertices > Limits::default().vertices || triangles.len() > Limits::default().faces {
                    return Err(over(&place));
                }
                parts.push(part);
            }
        }
        if triangles.is_empty() {
            return Err(fault(words!("there are no triangles in its scene")));
        }
        let skins = document.skins().map(|skin| Skin::new(&skin, numbers)).collect::<Result<Vec<_>, _>>()?;
        for part in &parts {
            let Some((skin, weights)) = &part.skin else { continue };
            let count = skins[*skin].joints.len();
            if weights.iter().flatten().any(|(joint, _)| *joint >= count) {
                return Err(fault(words!("a vertex hangs on a joint that skin {skin} has not", skin)));
            }
        }
        let clips = document.animations().map(|clip| Clip::new(&clip, numbers)).collect::<Result<_, _>>()?;
        Ok(Self { nodes, order, parts, skins, clips, triangles })
    }

    /// The mesh of the whole scene at rest, in the file's unit (metres by the format). Vertices are split along texture seams.
    pub fn mesh(&self) -> TriMesh {
        TriMesh { positions: self.positions(None), triangles: self.triangles.clone() }
    }

    /// Names of the animations, in the order of the file; empty for an animation without a name.
    pub fn animations(&self) -> impl Iterator<Item = &str> {
        self.clips.iter().map(|clip| clip.name.as_str())
    }

    /// Duration of animation `clip`, seconds; None if there is no such animation.
    pub fn seconds(&self, clip: usize) -> Option<f64> {
        self.clips.get(clip).map(|clip| clip.seconds)
    }

    /// Positions of the vertices of [`Model::mesh`], at rest (None) or in animation `clip` at a time in seconds.
    pub fn positions(&self, at: Option<(usize, f64)>) -> Vec<DVec3> {
        let mut poses: Vec<Pose> = self.nodes.iter().map(|node| node.at_rest).collect();
        let mut weights: Vec<Vec<f64>> = self.nodes.iter().map(|node| node.weights.clone()).collect();
        if let Some((clip, seconds)) = at
            && let Some(clip) = self.clips.get(clip)
        {
            clip.apply(seconds, &mut poses, &mut weights);
        }
        let mut whole = vec![DMat4::IDENTITY; self.nodes.len()];
        for &i in &self.order {
            let own = poses[i].matrix();
            whole[i] = self.nodes[i].parent.map_or(own, |parent| whole[parent] * own);
        }
        self.parts.iter().flat_map(|part| part.placed(&whole, &weights[part.node], &self.skins)).collect()
    }
}

fn over(place: &Words) -> GltfError {
    let Limits { vertices, faces, .. } = Limits::default();
    let words = words!("more than {vertices} vertices or {faces} triangles", vertices, faces);
    GltfError::OverLimit(place.clone().and(": ", words))
}

/// All nodes, and their indices ordered with each parent before its children.
fn nodes(document: &gltf::Document) -> Result<(Vec<Node>, Vec<usize>), GltfError> {
    let mut nodes: Vec<Node> = document.nodes().map(|node| Node::new(&node)).collect();
    for node in document.nodes() {
        for child in node.children() {
            if nodes[child.index()].parent.replace(node.index()).is_some() {
                return Err(fault(words!("node {n} hangs on two nodes", n = child.index())));
            }
        }
    }
    let mut order: Vec<usize> = (0..nodes.len()).filter(|&i| nodes[i].parent.is_none()).collect();
    let children: Vec<Vec<usize>> =
        document.nodes().map(|node| node.children().map(|child| child.index()).collect()).collect();
    let mut next = 0;
    while let Some(&i) = order.get(next) {
        order.extend(&children[i]);
        next += 1;
    }
    match order.len() == nodes.len() {
        true => Ok((nodes, order)),
        false => Err(fault(words!("some of its nodes hang on each other in a ring"))),
    }
}

/// For each node whether it is part of the default scene, else of the first; all are shown when the file has no scene.
fn shown(document: &gltf::Document, nodes: &[Node], order: &[usize]) -> Vec<bool> {
    let Some(scene) = document.default_scene().or_else(|| document.scenes().next()) else {
        return vec![true; nodes.len()];
    };
    let mut shown = vec![false; nodes.len()];
    scene.nodes().for_each(|node| shown[node.index()] = true);
    for &i in order {
        shown[i] |= nodes[i].parent.is_some_and(|parent| shown[parent]);
    }
    shown
}

impl Node {
    fn new(node: &gltf::Node<'_>) -> Self {
        let at_rest = match node.transform() {
            Transform::Decomposed { translation, rotation, scale } => Pose {
                translation: DVec3::from_array(translation.map(f64::from)),
                rotation: turn(rotation.map(f64::from)),
                scale: DVec3::from_array(scale.map(f64::from)),
            },
            Transform::Matrix { matrix } => {
                let columns = matrix.map(|column| column.map(f64::from));
                let matrix = DAffine3::from_mat4(DMat4::from_cols_array_2d(&columns));
                let (scale, rotation, translation) = matrix.to_scale_rotation_translation();
                Pose { translation, rotation, scale }
            }
        };
        let own = node.weights().or_else(|| node.mesh().and_then(|mesh| mesh.weights()));
        let weights = own.unwrap_or_default().iter().map(|&weight| f64::from(weight)).collect();
        Self { parent: None, at_rest, weights }
    }
}

/// A unit quaternion from x, y, z, w; the identity if they cannot be normalised.
fn turn(numbers: [f64; 4]) -> DQuat {
    let turn = DQuat::from_array(numbers);
    if turn.length() > 1e-9 && turn.is_finite() { turn.normalize() } else { DQuat::IDENTITY }
}

/// Reads the vertices and triangles of a primitive; None for points and lines.
fn part(
    node: &gltf::Node<'_>,
    primitive: &gltf::Primitive<'_>,
    numbers: &Numbers<'_>,
    place: &Words,
) -> Result<Option<Part>, GltfError> {
    let placed = |words: Words| fault(place.clone().and(": ", words));
    let at = |error: GltfError| match error {
        GltfError::File(words) => placed(words),
        over => over,
    };
    if !matches!(primitive.mode(), Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
        return Ok(None);
    }
    let Some(accessor) = primitive.get(&Semantic::Positions) else { return Ok(None) };
    let positions = numbers.vectors(&accessor).map_err(at)?;
    let count = positions.len();
    let corners = match primitive.indices() {
        Some(accessor) => numbers.integers::<1>(&accessor).map_err(at)?.into_iter().map(|[v]| v).collect(),
        None => (0..count as u32).collect::<Vec<u32>>(),
    };
    if corners.iter().any(|&v| v as usize >= count) {
        return Err(placed(words!("a triangle names a vertex that is not there")));
    }
    let mut targets = Vec::new();
    for target in primitive.morph_targets() {
        let moved =
            target.positions().map_or(Ok(vec![DVec3::ZERO; count]), |a| numbers.vectors(&a).map_err(at))?;
        if moved.len() != count {
            return Err(placed(words!("a morph target has other vertices")));
        }
        targets.push(moved);
    }
    let skin = match node.skin() {
        Some(skin) => Some((skin.index(), hanging(primitive, numbers, count).map_err(at)?)),
        None => None,
    };
    let triangles = triangles(primitive.mode(), &corners);
    Ok(Some(Part { node: node.index(), positions, targets, triangles, skin }))
}

/// Reads the skin weights of `count` vertices and normalises their sums to 1.
fn hanging(
    primitive: &gltf::Primitive<'_>,
    numbers: &Numbers<'_>,
    count: usize,
) -> Result<Hanging, GltfError> {
    let mut hanging: Hanging = vec![Vec::new(); count];
    for set in 0..MOST_JOINT_SETS {
        let given = primitive.get(&Semantic::Joints(set)).zip(primitive.get(&Semantic::Weights(set)));
        let Some((joints, weights)) = given else { break };
        let (joints, weights) = (numbers.integers::<4>(&joints)?, numbers.floats::<4>(&weights)?);
        if joints.len() != count || weights.len() != count {
            return Err(fault(words!("its vertices have other numbers of joints")));
        }
        for (own, (joints, weights)) in hanging.iter_mut().zip(joints.iter().zip(&weights)) {
            let some = joints.iter().zip(weights).filter(|(_, weight)| **weight > 0.0);
            own.extend(some.map(|(&joint, &weight)| (joint as usize, weight)));
        }
    }
    for own in &mut hanging {
        let sum: f64 = own.iter().map(|(_, weight)| weight).sum();
        own.iter_mut().for_each(|(_, weight)| *weight /= sum);
    }
    Ok(hanging)
}

fn triangles(mode: Mode, corners: &[u32]) -> Vec<[u32; 3]> {
    let strip = |(i, t): (usize, &[u32])| if i % 2 == 0 { [t[0], t[1], t[2]] } else { [t[1], t[0], t[2]] };
    let all: Vec<[u32; 3]> = match mode {
        Mode::TriangleStrip => corners.windows(3).enumerate().map(strip).collect(),
        Mode::TriangleFan => corners.windows(2).skip(1).map(|t| [corners[0], t[0], t[1]]).collect(),
        _ => corners.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect(),
    };
    all.into_iter().filter(|[a, b, c]| a != b && b != c && c != a).collect()
}

impl Skin {
    fn new(skin: &gltf::Skin<'_>, numbers: &Numbers<'_>) -> Result<Self, GltfError> {
        let joints: Vec<usize> = skin.joints().map(|joint| joint.index()).collect();
        let binds = match skin.inverse_bind_matrices() {
            Some(accessor) => {
                let matrices = numbers.floats::<16>(&accessor)?;
                matrices.iter().map(DMat4::from_cols_array).collect()
            }
            None => vec![DMat4::IDENTITY; joints.len()],
        };
        if binds.len() < joints.len() {
            return Err(fault(words!("skin {n} has fewer matrices than joints", n = skin.index())));
        }
        Ok(Self { joints: joints.into_iter().zip(binds).collect() })
    }
}

impl Part {
    /// Positions of the vertices in the scene. Skinned vertices follow their joints only, not their own node (glTF 2.0).
    fn placed(&self, whole: &[DMat4], weights: &[f64], skins: &[Skin]) -> Vec<DVec3> {
        let mut positions = self.positions.clone();
        for (target, &weight) in self.targets.iter().zip(weights).filter(|(_, weight)| **weight != 0.0) {
            positions.iter_mut().zip(target).for_each(|(p, way)| *p += *way * weight);
        }
        let Some((skin, hanging)) = &self.skin else {
            return positions.into_iter().map(|p| whole[self.node].transform_point3(p)).collect();
        };
        let joints: Vec<DMat4> =
            skins[*skin].joints.iter().map(|(node, bind)| whole[*node] * *bind).collect();
        let place = |(p, own): (DVec3, &Vec<(usize, f64)>)| match own[..] {
            [] => whole[self.node].transform_point3(p),
            _ => own.iter().map(|&(joint, weight)| joints[joint].transform_point3(p) * weight).sum(),
        };
        positions.into_iter().zip(hanging).map(place).collect()
    }
}
