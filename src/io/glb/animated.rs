//! Animated glTF scenes: each frame after the first is a morph target of every mesh, and one animation interpolates linearly
//! between the frames' weights.
//!
//! Morph targets are the only way of glTF 2.0 to move single vertices (section 3.7.2.2). They hold positions and normals as
//! 32-bit floats, so a vertex of the body or of trims takes 24 bytes per frame, and a cloth vertex 36, as its two sides have their
//! own normals.

use glam::DVec3;
use gltf_json::accessor::{ComponentType, Type};
use gltf_json::animation::{Animation, Channel, Interpolation, Property, Sampler, Target};
use gltf_json::mesh::MorphTarget;
use gltf_json::validation::Checked;
use gltf_json::{Accessor, Index};

use super::{Builder, GlbError, accessor};
use crate::cloth::{ClothState, Wedges};
use crate::geometry::mesh::{TriMesh, vertex_normals};
use crate::io::dressed::{Dressed, Frame, PieceArrays, TrimArrays};
use crate::io::materials::Colours;
use crate::io::normals::Normals;

/// Approximate number of bytes that one frame adds to the file; trims count as the body does.
pub fn bytes_per_frame(cloth_vertices: usize, body_vertices: usize) -> usize {
    36 * cloth_vertices + 24 * body_vertices
}

/// Writes the garment with its trims and the body animated through `frames`. The vertices of each frame are those of
/// `dressed.garment` and of `body`, of which only the triangles are used. Triangles that are not yet placed on the body are left
/// out.
pub fn write_animated(
    dressed: Dressed<'_>,
    body: &TriMesh,
    frames: &[Frame],
    frames_per_second: f64,
    colours: &Colours,
) -> Result<Vec<u8>, GlbError> {
    let first = frames.first().ok_or(GlbError::Empty)?;
    let mut builder = Builder::new();
    let cloth =
        |frame: &Frame| ClothState { positions: frame.cloth.clone(), mapped: dressed.state.mapped.clone() };
    let triangles = Dressed { state: &cloth(first), ..dressed }.laid();
    let wedges = Wedges::new(dressed.garment);
    let moved = |frame: &Frame| {
        let state = cloth(frame);
        let normals = Normals::new(dressed.garment, &wedges, &state.positions, &triangles);
        (state, normals)
    };
    let states: Vec<(ClothState, Normals)> = frames.iter().map(moved).collect();
    for (id, name) in &dressed.garment.pieces {
        let own = || triangles.iter().copied().filter(|&t| dressed.garment.triangle_pieces[t] == *id);
        let arrays = |(state, normals): &(ClothState, Normals)| {
            let dressed = Dressed { state, ..dressed };
            PieceArrays::new(&dressed, *id, own(), (&wedges, normals), colours.textures.as_deref())
        };
        let shown = arrays(&states[0]);
        if shown.triangles.is_empty() {
            continue;
        }
        let sides = builder.sides(colours, *id);
        builder.piece(name, &shown, sides);
        let others = states[1..].iter().map(arrays);
        let moves = others.map(|piece| (piece.positions, piece.normals));
        builder.moving((&shown.positions, &shown.normals), moves, 2);
    }
    for (part, material) in dressed.trims(colours) {
        let arrays = |(state, normals): &(ClothState, Normals)| {
            TrimArrays::new(&Dressed { state, ..dressed }, part, normals)
        };
        let shown = arrays(&states[0]);
        builder.trim(&shown, &material);
        let moves = states[1..].iter().map(arrays).map(|trim| (trim.positions, trim.normals));
        builder.moving((&shown.positions, &shown.normals), moves, 1);
    }
    let bodies: Vec<&[DVec3]> = frames.iter().map(|frame| &*frame.body).collect();
    builder.moving_body(&body.triangles, &bodies, colours);
    if frames.len() > 1 {
        builder.animation(frames.len(), frames_per_second);
    }
    builder.finish()
}

/// Writes a body of `triangles` animated through `frames`, each the vertex positions in metres.
pub fn write_moving_body(
    triangles: &[[u32; 3]],
    frames: &[Vec<DVec3>],
    frames_per_second: f64,
    colours: &Colours,
) -> Result<Vec<u8>, GlbError> {
    if frames.is_empty() {
        return Err(GlbError::Empty);
    }
    let mut builder = Builder::new();
    let bodies: Vec<&[DVec3]> = frames.iter().map(|frame| &**frame).collect();
    builder.moving_body(triangles, &bodies, colours);
    if frames.len() > 1 {
        builder.animation(frames.len(), frames_per_second);
    }
    builder.finish()
}

fn less(of: &[DVec3], by: &[DVec3]) -> Vec<DVec3> {
    of.iter().zip(by).map(|(p, q)| *p - *q).collect()
}

impl Builder {
    /// Adds the body with a morph target for each frame after the first. Without frames nothing is added.
    fn moving_body(&mut self, triangles: &[[u32; 3]], frames: &[&[DVec3]], colours: &Colours) {
        let [first, others @ ..] = frames else { return };
        self.body(&TriMesh { positions: first.to_vec(), triangles: triangles.to_vec() }, colours);
        let normals = vertex_normals(first, triangles);
        let moves = others.iter().map(|frame| (frame.to_vec(), vertex_normals(frame, triangles)));
        self.moving((first, &normals), moves, 1);
    }

    /// Adds a morph target for each of `moves` (positions and normals) to the last mesh, whose positions and normals are `first`.
    /// `primitives` is 1 or 2; the second primitive is the reverse side and has the normals negated.
    fn moving(
        &mut self,
        first: (&[DVec3], &[DVec3]),
        moves: impl Iterator<Item = (Vec<DVec3>, Vec<DVec3>)>,
        primitives: usize,
    ) {
        let mut targets: Vec<Vec<MorphTarget>> = vec![Vec::new(); primitives];
        for (positions, normals) in moves {
            let positions = self.vectors(&less(&positions, first.0), true);
            let turned = less(&normals, first.1);
            for (side, targets) in targets.iter_mut().enumerate() {
                let normals: Vec<DVec3> = turned.iter().map(|&n| if side == 0 { n } else { -n }).collect();
                let normals = Some(self.vectors(&normals, false));
                targets.push(MorphTarget { positions: Some(positions), normals, tangents: None });
            }
        }
        let Some(mesh) = self.root.meshes.last_mut() else { return };
        let count = targets.first().map_or(0, Vec::len);
        if count == 0 {
            return;
        }
        mesh.weights = Some(vec![0.0; count]);
        for (primitive, targets) in mesh.primitives.iter_mut().zip(targets) {
            primitive.targets = Some(targets);
        }
    }

    /// Adds the animation of all meshes' weights: all 0 in the first frame, and in frame i the i-th weight 1 and the others 0.
    fn animation(&mut self, frames: usize, frames_per_second: f64) {
        let times: Vec<f32> = (0..frames).map(|i| (i as f64 / frames_per_second) as f32).collect();
        let targets = frames - 1;
        let mut weights = vec![0.0_f32; frames * targets];
        (0..targets).for_each(|i| weights[(i + 1) * targets + i] = 1.0);
        let input = self.scalars(&times);
        let end = times.last().copied().unwrap_or_default();
        let bounds = |value: f32| gltf_json::serialize::to_value([value]).ok();
        let of_times = &mut self.root.accessors[input.value()];
        (of_times.min, of_times.max) = (bounds(0.0), bounds(end));
        let output = self.scalars(&weights);
        let sampler = Sampler {
            extensions: None,
            extras: Default::default(),
            input,
            interpolation: Checked::Valid(Interpolation::Linear),
            output,
        };
        let channel = |&node| Channel {
            sampler: Index::new(0),
            target: Target {
                extensions: None,
                extras: Default::default(),
                node,
                path: Checked::Valid(Property::MorphTargetWeights),
            },
            extensions: None,
            extras: Default::default(),
        };
        let channels = self.nodes.iter().map(channel).collect();
        self.root.push(Animation {
            extensions: None,
            extras: Default::default(),
            channels,
            name: Some("sequence".to_owned()),
            samplers: vec![sampler],
        });
    }

    /// Adds an accessor of numbers that belong to no vertex, such as key times.
    fn scalars(&mut self, numbers: &[f32]) -> Index<Accessor> {
        let view = self.view(bytemuck::cast_slice(numbers), None);
        self.root.push(accessor(view, numbers.len(), ComponentType::F32, Type::Scalar))
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::parsed;
    use super::*;
    use crate::io::dressed::tests::{trimmed_squares, two_squares};
    use crate::io::materials::{TextureImage, Textures};

    /// The vectors of an accessor.
    fn vectors(root: &gltf_json::Root, data: &[u8], at: Index<Accessor>) -> Vec<DVec3> {
        let accessor = root.get(at).expect("an accessor");
        let view = root.get(accessor.buffer_view.expect("a view")).expect("a view");
        let start = view.byte_offset.map_or(0, |o| o.0 as usize);
        let number = |k: usize| {
            let bytes = data[start + 4 * k..start + 4 * k + 4].try_into().expect("4 bytes");
            f64::from(f32::from_le_bytes(bytes))
        };
        (0..accessor.count.0 as usize)
            .map(|i| DVec3::from_array([0, 1, 2].map(|k| number(3 * i + k))))
            .collect()
    }

    #[test]
    fn every_frame_is_its_morph_target_over_the_first() {
        let (pattern, garment, state) = two_squares();
        let body = TriMesh { positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y], triangles: vec![[0, 1, 2]] };
        let frame = |i: usize| {
            let shift = DVec3::new(0.1, -0.2, 0.3) * i as f64;
            let cloth = state.positions.iter().map(|p| *p + shift * (1.0 + p.x)).collect();
            Frame { cloth, body: body.positions.iter().map(|p| *p - shift).collect() }
        };
        let frames: Vec<Frame> = (0..4).map(frame).collect();
        let dressed = Dressed { garment: &garment, state: &state, pattern: &pattern, trims: &[] };
        let bytes = write_animated(dressed, &body, &frames, 25.0, &Colours::default()).expect("a file");
        let (root, data) = parsed(&bytes);
        assert_eq!((root.meshes.len(), root.animations.len()), (3, 1));
        let channels = &root.animations[0].channels;
        assert_eq!(channels.iter().map(|c| c.target.node.value()).collect::<Vec<_>>(), [0, 1, 2]);
        let sampler = &root.animations[0].samplers[0];
        let end = root.get(sampler.input).and_then(|times| times.max.clone()).expect("an end");
        assert!((end[0].as_f64().expect("seconds") - 3.0 / 25.0).abs() < 1e-6);
        assert_eq!(root.get(sampler.output).expect("weights").count.0, 4 * 3);
        for mesh in &root.meshes {
            assert_eq!(mesh.weights.as_deref(), Some(&[0.0; 3][..]));
            for primitive in &mesh.primitives {
                assert_eq!(primitive.targets.as_ref().map(Vec::len), Some(3));
            }
        }
        let skin = &root.meshes[2].primitives[0];
        let at = |semantic| skin.attributes[&Checked::Valid(semantic)];
        let base = vectors(&root, data, at(gltf_json::mesh::Semantic::Positions));
        for (i, target) in skin.targets.iter().flatten().enumerate() {
            let moved = vectors(&root, data, target.positions.expect("places"));
            for (v, p) in frames[i + 1].body.iter().enumerate() {
                assert!((base[v] + moved[v]).distance(*p) < 1e-6, "frame {} vertex {v}", i + 1);
            }
        }
    }

    #[test]
    fn trims_and_textures_move_along() {
        let (pattern, garment, state, trims) = trimmed_squares();
        let shift = DVec3::new(0.1, -0.2, 0.3);
        let frame = |i: usize| Frame {
            cloth: state.positions.iter().map(|p| *p + shift * i as f64).collect(),
            body: vec![DVec3::ZERO, DVec3::X, DVec3::Y],
        };
        let frames: Vec<Frame> = (0..3).map(frame).collect();
        let body = TriMesh { positions: frames[0].body.clone(), triangles: vec![[0, 1, 2]] };
        let dressed = Dressed { garment: &garment, state: &state, pattern: &pattern, trims: &trims };
        let image = TextureImage { name: "colour".to_owned(), png: std::sync::Arc::new(vec![1, 2, 3]) };
        let textures = Textures { images: vec![image], ..Textures::default() };
        let textured = crate::io::materials::ClothMaterial {
            textures: Some(crate::io::materials::ClothTextures { sides: [0; 2], normal: None, weave: None }),
            ..Colours::default().of(crate::geometry::ids::PieceId(0))
        };
        let colours = Colours {
            pieces: pattern.pieces.keys().map(|&id| (id, textured.clone())).collect(),
            textures: Some(std::sync::Arc::new(textures)),
            ..Colours::default()
        };
        let bytes = write_animated(dressed, &body, &frames, 25.0, &colours).expect("a file");
        let (root, data) = parsed(&bytes);
        assert_eq!((root.images.len(), root.textures.len()), (1, 1));
        let front = root.get(root.meshes[0].primitives[0].material.expect("a material")).expect("it");
        assert!(front.pbr_metallic_roughness.base_color_texture.is_some());
        assert_eq!(root.meshes.len(), 2 + trims.len() + 1);
        assert_eq!(root.animations[0].channels.len(), root.meshes.len());
        for mesh in &root.meshes[2..2 + trims.len()] {
            let name = mesh.name.as_deref().unwrap_or_default();
            let targets = mesh.primitives[0].targets.as_ref().expect("they move");
            assert_eq!(targets.len(), 2, "{name}");
            for (i, target) in targets.iter().enumerate() {
                for moved in vectors(&root, data, target.positions.expect("places")) {
                    assert!(moved.distance(shift * (i + 1) as f64) < 1e-6, "{name}: {moved}");
                }
            }
        }
    }
}
