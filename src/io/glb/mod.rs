//! Writes scenes as binary glTF 2.0 (GLB): the garment as one mesh per piece with a material for each side, its trims as one mesh
//! for each kind and colour, and the body.
//!
//! Texture coordinates are the pattern plane in metres, u = x and v = 1 - y, since glTF counts v downward. With textures they are
//! those of the atlas; a second set then counts repeats of the weave.

pub mod animated;
mod images;

use glam::{DVec2, DVec3};
use gltf_json::accessor::{ComponentType, GenericComponentType, Type};
use gltf_json::buffer::{Buffer, Target, View};
use gltf_json::material::{AlphaMode, Material, PbrBaseColorFactor, PbrMetallicRoughness, StrengthFactor};
use gltf_json::mesh::{Mesh, Mode, Primitive, Semantic};
use gltf_json::validation::{Checked, USize64};
use gltf_json::{Accessor, Asset, Index, Node, Root, Scene, Texture};
use images::Map;

use crate::cloth::Wedges;
use crate::geometry::ids::PieceId;
use crate::geometry::mesh::TriMesh;
use crate::geometry::words::{Words, words};
use crate::io::dressed::{Dressed, PieceArrays, TrimArrays};
use crate::io::materials::{ClothMaterial, ClothTextures, Colours, ROUGHNESS, Textures};
use crate::io::normals::Normals;

/// Why no file was written.
#[derive(Debug, thiserror::Error)]
#[error("{}", self.words())]
pub enum GlbError {
    /// There is neither cloth nor body to write.
    Empty,
    /// The scene exceeds 4 GiB; lengths in GLB are 32-bit.
    TooLarge,
    /// The JSON part could not be written.
    Json(gltf_json::Error),
}

impl GlbError {
    /// The error in words.
    pub fn words(&self) -> Words {
        match self {
            Self::Empty => words!("there is nothing to write: no cloth is on the body yet"),
            Self::TooLarge => words!("the scene is larger than 4 GiB, which is all a GLB file can hold"),
            Self::Json(why) => words!("the glTF header cannot be written: {why}", why = why.to_string()),
        }
    }
}

impl From<gltf_json::Error> for GlbError {
    fn from(error: gltf_json::Error) -> Self {
        Self::Json(error)
    }
}

/// Writes a scene; either part may be missing. Triangles that are not yet placed on the body are left out.
pub fn write(
    dressed: Option<Dressed<'_>>,
    body: Option<&TriMesh>,
    colours: &Colours,
) -> Result<Vec<u8>, GlbError> {
    let mut builder = Builder::new();
    if let Some(dressed) = dressed {
        builder.garment(&dressed, colours);
    }
    if let Some(body) = body {
        builder.body(body, colours);
    }
    builder.finish()
}

struct Builder {
    root: Root,
    data: Vec<u8>,
    nodes: Vec<Index<Node>>,
    /// Materials of cloth that are written, and their indices for both sides.
    cloth: Vec<(ClothMaterial, [Index<Material>; 2])>,
    /// Images that are written, by their numbers, and their textures.
    textures: Vec<(usize, Index<Texture>)>,
}

impl Builder {
    fn new() -> Self {
        let asset = Asset { generator: Some("Toile".to_owned()), ..Asset::default() };
        Self {
            root: Root { asset, ..Root::default() },
            data: Vec::new(),
            nodes: Vec::new(),
            cloth: Vec::new(),
            textures: Vec::new(),
        }
    }

    fn garment(&mut self, dressed: &Dressed<'_>, colours: &Colours) {
        let Dressed { garment, state, .. } = dressed;
        let triangles = dressed.laid();
        let wedges = Wedges::new(garment);
        let normals = Normals::new(garment, &wedges, &state.positions, &triangles);
        for (id, name) in &garment.pieces {
            let own = triangles.iter().copied().filter(|&t| garment.triangle_pieces[t] == *id);
            let piece = PieceArrays::new(dressed, *id, own, (&wedges, &normals), colours.textures.as_deref());
            if !piece.triangles.is_empty() {
                let sides = self.sides(colours, *id);
                self.piece(name, &piece, sides);
            }
        }
        for (part, material) in dressed.trims(colours) {
            self.trim(&TrimArrays::new(dressed, part, &normals), &material);
        }
    }

    /// Adds a piece as one mesh with two single-sided primitives, for the front and the back of the cloth.
    fn piece(&mut self, name: &str, piece: &PieceArrays, [front, back]: [Index<Material>; 2]) {
        let positions = self.vectors(&piece.positions, true);
        let mut uv = vec![self.texture_coordinates(&piece.uv)];
        uv.extend((!piece.weave.is_empty()).then(|| self.texture_coordinates(&piece.weave)));
        let normals = self.vectors(&piece.normals, false);
        let inward: Vec<DVec3> = piece.normals.iter().map(|&n| -n).collect();
        let inward = self.vectors(&inward, false);
        let turned: Vec<[u32; 3]> = piece.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
        let outside = self.triangles(&piece.triangles);
        let inside = self.triangles(&turned);
        let primitives = vec![
            primitive([positions, normals], &uv, outside, front),
            primitive([positions, inward], &uv, inside, back),
        ];
        self.node(name, primitives);
    }

    /// Adds trims as one mesh, which is called like its material. The layer of a hem is seen from both sides.
    fn trim(&mut self, trim: &TrimArrays, made_of: &ClothMaterial) {
        let ClothMaterial { name, sides: [colour, _], roughness, opacity, textures: _ } = made_of;
        let material = self.material(name, *colour, *roughness, *opacity, [None; 2]);
        if let Some(material) = self.root.materials.get_mut(material.value()) {
            material.double_sided = true;
        }
        self.plain(name, [&trim.positions, &trim.normals], &trim.triangles, material);
    }

    fn body(&mut self, body: &TriMesh, colours: &Colours) {
        let material = self.material("body", colours.body, ROUGHNESS, 1.0, [None; 2]);
        self.plain("body", [&body.positions, &body.vertex_normals()], &body.triangles, material);
    }

    /// Adds a mesh without texture coordinates.
    fn plain(
        &mut self,
        name: &str,
        [positions, normals]: [&[DVec3]; 2],
        triangles: &[[u32; 3]],
        material: Index<Material>,
    ) {
        let positions = self.vectors(positions, true);
        let normals = self.vectors(normals, false);
        let triangles = self.triangles(triangles);
        self.node(name, vec![primitive([positions, normals], &[], triangles, material)]);
    }

    fn node(&mut self, name: &str, primitives: Vec<Primitive>) {
        let mesh = self.root.push(Mesh {
            extensions: None,
            extras: Default::default(),
            name: Some(name.to_owned()),
            primitives,
            weights: None,
        });
        let node = self.root.push(Node { mesh: Some(mesh), name: Some(name.to_owned()), ..Node::default() });
        self.nodes.push(node);
    }

    /// The materials of both sides of piece `id`.
    fn sides(&mut self, colours: &Colours, id: PieceId) -> [Index<Material>; 2] {
        let wanted = colours.of(id);
        if let Some((_, sides)) = self.cloth.iter().find(|(material, _)| *material == wanted) {
            return *sides;
        }
        let ClothMaterial { name, sides, roughness, opacity, textures } = &wanted;
        let images = colours.textures.as_deref();
        let made = [0, 1].map(|side| {
            let maps = textures.zip(images).map(|(own, images)| self.maps(&own, side, images));
            // A texture is multiplied by the colour.
            let colour = if maps.is_some() { [1.0; 3] } else { sides[side] };
            let name = format!("{name}, {}", ["front", "back"][side]);
            self.material(&name, colour, *roughness, *opacity, maps.unwrap_or_default())
        });
        self.cloth.push((wanted, made));
        made
    }

    /// The base colour and the normal texture of one side: 0 the outer, 1 the inner.
    fn maps(&mut self, own: &ClothTextures, side: usize, textures: &Textures) -> [Option<Map>; 2] {
        let mut map = |image: usize, set: u32| Some(Map { texture: self.texture(textures, image)?, set });
        let colour = map(own.sides[side], 0);
        let normal = own.weave.map(|image| (image, 1)).or(own.normal.map(|image| (image, 0)));
        [colour, normal.and_then(|(image, set)| map(image, set))]
    }

    fn material(
        &mut self,
        name: &str,
        [r, g, b]: [f32; 3],
        roughness: f32,
        opacity: f32,
        [colour, normal]: [Option<Map>; 2],
    ) -> Index<Material> {
        let alpha_mode = if opacity < 1.0 { AlphaMode::Blend } else { AlphaMode::Opaque };
        self.root.push(Material {
            name: Some(name.to_owned()),
            pbr_metallic_roughness: PbrMetallicRoughness {
                base_color_factor: PbrBaseColorFactor([r, g, b, opacity]),
                metallic_factor: StrengthFactor(0.0),
                roughness_factor: StrengthFactor(roughness),
                base_color_texture: colour.map(Map::info),
                ..PbrMetallicRoughness::default()
            },
            normal_texture: normal.map(Map::normal),
            alpha_mode: Checked::Valid(alpha_mode),
            ..Material::default()
        })
    }

    fn vectors(&mut self, vectors: &[DVec3], with_bounds: bool) -> Index<Accessor> {
        // A value that is not finite would make the whole file invalid; it is written as 0.
        let vectors: Vec<[f32; 3]> =
            vectors.iter().map(|v| if v.is_finite() { v.as_vec3().to_array() } else { [0.0; 3] }).collect();
        let (mut low, mut high) = ([f32::MAX; 3], [f32::MIN; 3]);
        for v in &vectors {
            for k in 0..3 {
                low[k] = low[k].min(v[k]);
                high[k] = high[k].max(v[k]);
            }
        }
        let view = self.view(bytemuck::cast_slice(&vectors), Some(Target::ArrayBuffer));
        let mut accessor = accessor(view, vectors.len(), ComponentType::F32, Type::Vec3);
        if with_bounds {
            accessor.min = Some(gltf_json::serialize::to_value(low).unwrap_or_default());
            accessor.max = Some(gltf_json::serialize::to_value(high).unwrap_or_default());
        }
        self.root.push(accessor)
    }

    fn texture_coordinates(&mut self, uv: &[DVec2]) -> Index<Accessor> {
        let uv: Vec<[f32; 2]> = uv.iter().map(|p| [p.x as f32, (1.0 - p.y) as f32]).collect();
        let view = self.view(bytemuck::cast_slice(&uv), Some(Target::ArrayBuffer));
        self.root.push(accessor(view, uv.len(), ComponentType::F32, Type::Vec2))
    }

    fn triangles(&mut self, triangles: &[[u32; 3]]) -> Index<Accessor> {
        let view = self.view(bytemuck::cast_slice(triangles), Some(Target::ElementArrayBuffer));
        self.root.push(accessor(view, triangles.len() * 3, ComponentType::U32, Type::Scalar))
    }

    /// Adds a buffer view of `bytes`. All elements are 4-byte numbers, so every view begins at a multiple of 4 as glTF requires.
    fn view(&mut self, bytes: &[u8], target: Option<Target>) -> Index<View> {
        let byte_offset = self.data.len();
        self.data.extend_from_slice(bytes);
        self.root.push(View {
            buffer: Index::new(0),
            byte_length: USize64::from(bytes.len()),
            byte_offset: Some(USize64::from(byte_offset)),
            byte_stride: None,
            name: None,
            target: target.map(Checked::Valid),
            extensions: None,
            extras: Default::default(),
        })
    }

    fn finish(mut self) -> Result<Vec<u8>, GlbError> {
        if self.nodes.is_empty() {
            return Err(GlbError::Empty);
        }
        self.root.push(Buffer {
            byte_length: USize64::from(self.data.len()),
            name: None,
            uri: None,
            extensions: None,
            extras: Default::default(),
        });
        let scene = Scene { extensions: None, extras: Default::default(), name: None, nodes: self.nodes };
        self.root.scene = Some(self.root.push(scene));
        container(self.root.to_vec()?, self.data)
    }
}

fn accessor(view: Index<View>, count: usize, component: ComponentType, type_: Type) -> Accessor {
    Accessor {
        buffer_view: Some(view),
        byte_offset: Some(USize64(0)),
        count: USize64::from(count),
        component_type: Checked::Valid(GenericComponentType(component)),
        extensions: None,
        extras: Default::default(),
        type_: Checked::Valid(type_),
        min: None,
        max: None,
        name: None,
        normalized: false,
        sparse: None,
    }
}

fn primitive(
    [positions, normals]: [Index<Accessor>; 2],
    uv: &[Index<Accessor>],
    triangles: Index<Accessor>,
    material: Index<Material>,
) -> Primitive {
    let given = [(Semantic::Positions, positions), (Semantic::Normals, normals)];
    let uv = (0..).map(Semantic::TexCoords).zip(uv.iter().copied());
    Primitive {
        attributes: given.into_iter().chain(uv).map(|(s, a)| (Checked::Valid(s), a)).collect(),
        extensions: None,
        extras: Default::default(),
        indices: Some(triangles),
        material: Some(material),
        mode: Checked::Valid(Mode::Triangles),
        targets: None,
    }
}

/// Puts the GLB container together: header, JSON chunk and binary chunk, both padded to a multiple of 4 bytes.
///
/// # Errors
/// The file would be too large.
pub fn container(mut json: Vec<u8>, mut data: Vec<u8>) -> Result<Vec<u8>, GlbError> {
    json.resize(json.len().next_multiple_of(4), b' ');
    data.resize(data.len().next_multiple_of(4), 0);
    let length = u32::try_from(28 + json.len() + data.len()).map_err(|_| GlbError::TooLarge)?;
    let mut bytes = Vec::with_capacity(length as usize);
    bytes.extend_from_slice(b"glTF");
    bytes.extend_from_slice(&2u32.to_le_bytes());
    bytes.extend_from_slice(&length.to_le_bytes());
    bytes.extend_from_slice(&(json.len() as u32).to_le_bytes());
    bytes.extend_from_slice(b"JSON");
    bytes.append(&mut json);
    bytes.extend_from_slice(&(data.len() as u32).to_le_bytes());
    bytes.extend_from_slice(b"BIN\0");
    bytes.extend_from_slice(&data);
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use gltf_json::validation::Validate;

    use super::*;
    use crate::io::dressed::tests::{trimmed_squares, two_squares};

    pub(super) fn parsed(bytes: &[u8]) -> (Root, &[u8]) {
        assert_eq!(&bytes[..4], b"glTF");
        let number = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().expect("4 bytes")) as usize;
        assert_eq!(number(8), bytes.len());
        let json = number(12);
        let root = Root::from_slice(&bytes[20..20 + json]).expect("glTF JSON");
        let mut errors = Vec::new();
        root.validate(&root, gltf_json::Path::new, &mut |path, error| {
            errors.push(format!("{}: {error:?}", path()))
        });
        assert!(errors.is_empty(), "{errors:?}");
        assert_eq!(number(20 + json), bytes.len() - 28 - json);
        (root, &bytes[28 + json..])
    }

    #[test]
    fn a_garment_on_a_body_is_valid_gltf() {
        let (pattern, garment, state) = two_squares();
        let body = TriMesh { positions: vec![DVec3::ZERO, DVec3::X, DVec3::Y], triangles: vec![[0, 1, 2]] };
        let dressed = Dressed { garment: &garment, state: &state, pattern: &pattern, trims: &[] };
        let bytes = write(Some(dressed), Some(&body), &Colours::default()).expect("a file");
        let (root, data) = parsed(&bytes);
        let names: Vec<_> = root.nodes.iter().filter_map(|n| n.name.as_deref()).collect();
        assert_eq!(names, ["a", "b", "body"]);
        assert_eq!((root.materials.len(), root.meshes[0].primitives.len()), (3, 2));
        for view in &root.buffer_views {
            let start = view.byte_offset.map_or(0, |o| o.0);
            assert!(start % 4 == 0 && start + view.byte_length.0 <= data.len() as u64);
        }
        let triangles: u64 = root
            .meshes
            .iter()
            .flat_map(|m| &m.primitives)
            .filter_map(|p| root.get(p.indices?))
            .map(|a| a.count.0 / 3)
            .sum();
        assert_eq!(triangles as usize, 2 * garment.triangles.len() + 1);
    }

    #[test]
    fn cloth_not_yet_on_the_body_is_left_out() {
        let (pattern, garment, mut state) = two_squares();
        state.mapped.fill(false);
        state.positions.fill(DVec3::NAN);
        let dressed = Dressed { garment: &garment, state: &state, pattern: &pattern, trims: &[] };
        assert!(matches!(write(Some(dressed), None, &Colours::default()), Err(GlbError::Empty)));
    }

    #[test]
    fn trims_are_meshes_of_their_own_where_the_cloth_has_them() {
        let (pattern, garment, state, trims) = trimmed_squares();
        let dressed = Dressed { garment: &garment, state: &state, pattern: &pattern, trims: &trims };
        let bytes = write(Some(dressed), None, &Colours::default()).expect("a file");
        let (root, _) = parsed(&bytes);
        let names: Vec<_> = root.nodes.iter().filter_map(|n| n.name.as_deref()).collect();
        assert_eq!(names, ["a", "b", "Piping", "Button", "Button thread", "Buttonhole", "Stitches"]);
        for mesh in &root.meshes[2..] {
            let material = root.get(mesh.primitives[0].material.expect("a material")).expect("a material");
            assert_eq!(material.name, mesh.name);
            assert!(material.double_sided);
        }
        let bounds = |name: &str| {
            let mesh = root.meshes.iter().find(|m| m.name.as_deref() == Some(name)).expect("a mesh");
            let positions = mesh.primitives[0].attributes[&Checked::Valid(Semantic::Positions)];
            let positions = root.get(positions).expect("positions");
            let corner = |value: &Option<serde_json::Value>| {
                let value = value.as_ref().expect("bounds");
                DVec3::from_array([0, 1, 2].map(|k| value[k].as_f64().expect("a number")))
            };
            (corner(&positions.min), corner(&positions.max))
        };
        let is_near = |a: DVec3, b: DVec3| a.distance(b) < 2e-4;
        // A cord of 2 mm radius along the lower edge of 0.1 m, with domed ends.
        let (low, high) = bounds("Piping");
        assert!(is_near(low, DVec3::new(-0.0008, -0.002, -0.002)), "{low}");
        assert!(is_near(high, DVec3::new(0.1008, 0.002, 0.002)), "{high}");
        // The button is fastened: on its hole, 3.45 mm high.
        let (low, high) = bounds("Button");
        assert!(is_near(low, DVec3::new(0.0545, 0.0445, 0.00095)), "{low}");
        assert!(is_near(high, DVec3::new(0.0655, 0.0555, 0.00345)), "{high}");
        let (low, high) = bounds("Stitches");
        assert!(is_near(low.with_y(0.0), DVec3::new(0.01 - 0.00042, 0.0, -0.00042)), "{low}");
        assert!(is_near(high.with_y(0.0), DVec3::new(0.01 + 0.00042, 0.0, 0.00042)), "{high}");
        assert!(low.y < 0.002 && high.y > 0.098, "{low} {high}");
        let without = write(Some(Dressed { trims: &[], ..dressed }), None, &Colours::default());
        assert_eq!(parsed(&without.expect("a file")).0.meshes.len(), 2);
    }
}
