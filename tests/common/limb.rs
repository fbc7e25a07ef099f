//! A cylinder on two bones in glTF that bends in its middle by a right angle in one second (`bend`), or at its end (`snap`).

use std::f64::consts::FRAC_PI_2;

use glam::{DQuat, DVec2, DVec3};
use toile::geometry::ids::MarkId;
use toile::geometry::mesh::TriMesh;
use toile::geometry::shapes::cylinder;
use toile::geometry::words::Words;
use toile::io::{glb, gltf};
use toile::pattern::{Pattern, Piece};
use toile::session::{BodyChoice, Document, Project, Settings};
use toile::trust::good::{buffer, floats};
use toile::wrap::{BodyMark, ClothMark, ClothSide, Marks};

/// Metres: where it bends.
pub const MIDDLE: f64 = 0.5;

pub fn limb() -> TriMesh {
    cylinder(0.12, 1.0, 24, 30)
}

/// How much of a vertex hangs on the upper bone.
pub fn share(p: DVec3) -> f64 {
    match p.y - MIDDLE {
        d if d.abs() < 1e-9 => 0.5,
        d => f64::from(u8::from(d > 0.0)),
    }
}

/// Where a vertex is when the upper bone is turned by `angle` about z.
pub fn bent(p: DVec3, angle: f64) -> DVec3 {
    let middle = DVec3::Y * MIDDLE;
    p.lerp(DQuat::from_rotation_z(angle) * (p - middle) + middle, share(p))
}

/// The JSON text and the binary part.
pub fn skinned(uri: Option<&str>) -> (String, Vec<u8>) {
    let mesh = limb();
    // What takes the scene into the frame of each bone: columns of matrices.
    let bind =
        |height: f64| [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -height, 0.0, 1.0];
    let turn = DQuat::from_rotation_z(FRAC_PI_2).to_array();
    let (data, views) = buffer(vec![
        floats(mesh.positions.iter().flat_map(|p| p.to_array())),
        mesh.triangles.iter().flatten().flat_map(|v| v.to_le_bytes()).collect(),
        mesh.positions.iter().flat_map(|_| [0, 1, 0, 0]).collect(),
        floats(mesh.positions.iter().flat_map(|&p| [1.0 - share(p), share(p), 0.0, 0.0])),
        floats([bind(0.0), bind(MIDDLE)].concat()),
        floats([0.0, 1.0]),
        floats([[0.0, 0.0, 0.0, 1.0], turn].concat()),
    ]);
    let (vertices, corners) = (mesh.positions.len(), mesh.triangles.len() * 3);
    let uri = uri.map(|uri| format!(r#""uri": "{uri}", "#)).unwrap_or_default();
    let json = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0, 1]}}],
        "nodes": [{{"mesh": 0, "skin": 0, "translation": [5, 5, 5]}}, {{"children": [2]}},
            {{"translation": [0, {MIDDLE}, 0]}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0, "JOINTS_0": 2, "WEIGHTS_0": 3}}, "indices": 1}}]}}],
        "skins": [{{"joints": [1, 2], "inverseBindMatrices": 4}}],
        "animations": [{{"name": "bend", "samplers": [{{"input": 5, "output": 6}}],
            "channels": [{{"sampler": 0, "target": {{"node": 2, "path": "rotation"}}}}]}},
            {{"name": "snap", "samplers": [{{"input": 5, "output": 6, "interpolation": "STEP"}}],
            "channels": [{{"sampler": 0, "target": {{"node": 2, "path": "rotation"}}}}]}}],
        "accessors": [
            {{"bufferView": 0, "componentType": 5126, "count": {vertices}, "type": "VEC3",
                "min": [-0.12, 0, -0.12], "max": [0.12, 1, 0.12]}},
            {{"bufferView": 1, "componentType": 5125, "count": {corners}, "type": "SCALAR"}},
            {{"bufferView": 2, "componentType": 5121, "count": {vertices}, "type": "VEC4"}},
            {{"bufferView": 3, "componentType": 5126, "count": {vertices}, "type": "VEC4"}},
            {{"bufferView": 4, "componentType": 5126, "count": 2, "type": "MAT4"}},
            {{"bufferView": 5, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]}},
            {{"bufferView": 6, "componentType": 5126, "count": 2, "type": "VEC4"}}],
        "bufferViews": [{views}], "buffers": [{{{uri}"byteLength": {}}}]}}"#,
        data.len()
    );
    (json, data)
}

pub fn glb() -> Vec<u8> {
    let (json, data) = skinned(None);
    glb::container(json.into_bytes(), data).expect("a small scene")
}

/// The limb as it is read, and a patch of cloth marked to lie on its upper bone.
pub fn project() -> Project {
    let corners = [(0.0, 0.0), (0.25, 0.0), (0.25, 0.3), (0.0, 0.3)].map(DVec2::from);
    let mut pattern = Pattern::default();
    let piece = pattern.add_piece(Piece::polygon("patch", &corners));
    let line = |at: &dyn Fn(f64) -> DVec3| (0..=8).map(|i| at(f64::from(i) / 8.0)).collect::<Vec<_>>();
    let marks = Marks {
        cloth: vec![ClothMark {
            id: MarkId(1),
            piece,
            side: ClothSide::Front,
            points: line(&|t| DVec3::new(0.2, 0.05 + 0.2 * t, 0.0)).iter().map(|p| p.truncate()).collect(),
        }],
        body: vec![BodyMark { id: MarkId(2), points: line(&|t| DVec3::new(0.0, 0.74 + 0.2 * t, 0.12)) }],
        ..Marks::default()
    };
    let mesh =
        gltf::read(&glb(), &|name| Err(Words::plain(format!("{name} is not there")))).expect("a file").mesh();
    Project {
        document: Document {
            pattern: pattern.into(),
            body: BodyChoice::Imported { name: "limb".to_owned(), mesh: mesh.into() },
            marks: marks.into(),
            last_mark: 2,
            settings: Settings { edge_length: 0.06, ..Settings::default() },
            ..Document::default()
        },
        dressed: None,
    }
}
