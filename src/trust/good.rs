//! Small valid files of every format, with as many features as the format has.

use std::sync::Arc;

use glam::{DQuat, DVec2, DVec3};

use crate::geometry::ids::MarkId;
use crate::geometry::mesh::TriMesh;
use crate::geometry::shapes::cylinder;
use crate::io::glb;
use crate::io::materials::Colours;
use crate::io::obj;
use crate::io::rul::RuleTable;
use crate::pattern::grading::READY_SIZES;
use crate::pattern::{
    Edge, EdgeRef, EdgeShape, GradeRule, InternalLine, Notch, Pattern, Piece, PlanePose, Seam, SpacePose,
};
use crate::session::{BodyChoice, Command, Document, Dye, Motif, Print, Project, Session, Settings};
use crate::sim::{Runner, Simulation};
use crate::wrap::{BodyMark, ClothMark, ClothSide, Marks};

/// A pattern: a front with curves, a hole, a line, a notch and a grainline, and a plain back, sewn at both sides and placed in
/// front of and behind a limb.
pub fn pattern() -> Pattern {
    let corners = [(0.0, 0.0), (0.36, 0.0), (0.36, 0.3), (0.18, 0.33), (0.0, 0.3)].map(DVec2::from);
    let mut front = Piece::polygon("front", &corners);
    front.outline[2].shape = EdgeShape::Cubic { controls: [(0.3, 0.34), (0.24, 0.35)].map(DVec2::from) };
    front.outline[0].shape = EdgeShape::Arc { radius: 0.5, large: false, sweep: true };
    front.outline[3].shape = EdgeShape::Quadratic { control: DVec2::new(0.09, 0.34) };
    let hole = [(0.15, 0.15), (0.15, 0.2), (0.2, 0.2)].map(DVec2::from);
    front.holes = vec![Piece::polygon("hole", &hole).outline];
    let line = Edge { start: DVec2::new(0.05, 0.1), ..front.outline[1].clone() };
    front.lines = vec![InternalLine {
        name: "fold".to_owned(),
        edges: vec![line],
        end: DVec2::new(0.3, 0.1),
        ..InternalLine::default()
    }];
    front.notches = vec![Notch { edge: 1, at: 0.5 }];
    front.grainline = Some([(0.1, 0.05), (0.1, 0.25)].map(DVec2::from));
    front.allowance = 0.01;
    let mut back =
        Piece::polygon("back", &[(0.0, 0.0), (0.36, 0.0), (0.36, 0.3), (0.0, 0.3)].map(DVec2::from));
    back.pose = PlanePose { offset: DVec2::new(0.5, 0.0), ..PlanePose::default() };
    let turned = DQuat::from_rotation_y(std::f64::consts::PI);
    front.placement = Some(SpacePose::flat(DVec3::new(-0.18, 0.3, 0.2), DQuat::IDENTITY));
    back.placement = Some(SpacePose::flat(DVec3::new(0.18, 0.3, -0.2), turned));
    let mut pattern = Pattern::default();
    let [front, back] = [front, back].map(|piece| pattern.add_piece(piece));
    for (edge, other) in [(1, 3), (4, 1)] {
        let sides = [EdgeRef { piece: front, edge }, EdgeRef { piece: back, edge: other }];
        pattern.add_seam(Seam::of_edges(sides, false));
    }
    pattern
}

/// A limb as a body: a cylinder, metres.
pub fn body() -> TriMesh {
    cylinder(0.11, 1.0, 12, 8)
}

/// A project: the pattern in front of the limb, with a pair of marks.
pub fn project() -> Project {
    let pattern = pattern();
    let piece = *pattern.pieces.keys().next().expect("a front");
    let line = |at: &dyn Fn(f64) -> DVec3| (0..=4).map(|i| at(f64::from(i) / 4.0)).collect::<Vec<_>>();
    let flat = line(&|t| DVec3::new(0.1, 0.03 + 0.2 * t, 0.0));
    let marks = Marks {
        cloth: vec![ClothMark {
            id: MarkId(1),
            piece,
            side: ClothSide::Front,
            points: flat.iter().map(|p| p.truncate()).collect(),
        }],
        body: vec![BodyMark { id: MarkId(2), points: line(&|t| DVec3::new(0.0, 0.4 + 0.2 * t, 0.11)) }],
        ..Marks::default()
    };
    let document = Document {
        pattern: Arc::new(pattern),
        body: BodyChoice::Imported { name: "limb".to_owned(), mesh: Arc::new(body()) },
        marks: Arc::new(marks),
        last_mark: 2,
        settings: Settings { edge_length: 0.06, ..Settings::default() },
        ..Document::default()
    };
    Project { document, dressed: None }
}

/// A colour and a print.
pub fn dye() -> Dye {
    Dye {
        colour: Some([200, 30, 40]),
        print: Some(Print { motif: Motif::Checks, repeat_m: 0.02, colour: [240; 3] }),
        image: None,
    }
}

/// A small picture, PNG.
pub fn picture() -> Vec<u8> {
    let picture = image::RgbaImage::from_fn(16, 12, |x, y| {
        image::Rgba([16 * x as u8, 20 * y as u8, 90, 255 - x as u8])
    });
    let mut bytes = std::io::Cursor::new(Vec::new());
    picture.write_to(&mut bytes, image::ImageFormat::Png).expect("a picture");
    bytes.into_inner()
}

/// A small image of light from all sides, Radiance HDR.
pub fn environment() -> Vec<u8> {
    let mut bytes = Vec::new();
    let pixel = |i: u8| image::Rgb([f32::from(i), 3.0, 0.25 * f32::from(i % 7)]);
    let pixels: Vec<image::Rgb<f32>> = (0..128).map(pixel).collect();
    image::codecs::hdr::HdrEncoder::new(&mut bytes).encode(&pixels, 16, 8).expect("an image");
    bytes
}

/// A session in which a little was done, with cloth on the limb.
pub fn session() -> Session {
    let mut session = Session::new(project(), Runner::inline(Simulation::default()));
    let piece = *session.document().pattern.pieces.keys().next().expect("a front");
    let commands = [
        Command::Wrap,
        Command::AddPin { piece, at: DVec2::new(0.1, 0.1) },
        Command::SetFabric { piece: None, fabric: Some("wool".to_owned()) },
        Command::SetDye { piece: Some(piece), dye: dye() },
        Command::KeepColourway { name: "red".to_owned() },
        Command::RenamePiece { piece, name: "Vorderteil".to_owned() },
        Command::StepDraping { ticks: 2 },
        Command::Undo,
    ];
    for command in commands {
        session.apply_alone(command).expect("what a person could do");
        let simulation = session.runner().simulation().expect("inline");
        (0..200).take_while(|_| simulation.tick()).for_each(drop);
        session.update();
    }
    session
}

/// OBJ files: the limb, and a pyramid with polygons, texture, groups and negative indices.
pub fn objs() -> Vec<Vec<u8>> {
    let square = "# a pyramid\r\nmtllib a.mtl\no pyramid\nv 0 0 0\nv 1 0 0 1\nv 1 0 1\nv 0 0 1\nv 0.5 1e0 .5\nvt 0 0\nvt 1 1\n\
                  vn 0 1 0\ng side\nusemtl cloth\ns 1\nf 4/1/1 3/2/1 2/1/1 1/2/1\nf 1//1 2//1 5//1\nf -4 -3 -1\nf 3 4 \\\n5\n\
                  f 4 1 5\n";
    vec![obj::mesh("limb", &body()).into_bytes(), square.as_bytes().to_vec()]
}

/// OBJ files of cloth, with and without its place in the pattern.
pub fn cloths() -> Vec<Vec<u8>> {
    let text = "v 0 1 0\nv 0.1 1 0\nv 0.1 1 0.1\nv 0 1 0.1\nvt 0 0\nvt 0.1 0\nvt 0.1 0.1\nvt 0 0.1\nf 1/1 3/3 2/2\nf 1/1 4/4 3/3\n";
    vec![
        text.as_bytes().to_vec(),
        text.replace("/1", "").replace("/2", "").replace("/3", "").replace("/4", "").into_bytes(),
    ]
}

/// glTF files of the limb: one as text with two bones and inline data, and binary ones.
pub fn gltfs() -> (Vec<Vec<u8>>, Vec<Vec<u8>>) {
    use base64::Engine as _;
    let (text, numbers) = skinned();
    let inline = base64::engine::general_purpose::STANDARD.encode(&numbers);
    let uri = format!(r#""uri": "data:application/octet-stream;base64,{inline}", "#);
    let as_text = text.replace("URI", &uri).into_bytes();
    let binary = glb::container(text.replace("URI", "").into_bytes(), numbers).expect("a small scene");
    let mesh = body();
    let moved = |by: f64| mesh.positions.iter().map(|p| *p + DVec3::X * by).collect();
    let frames: Vec<Vec<DVec3>> = [0.0, 0.1, 0.3].map(moved).into();
    let moving = glb::animated::write_moving_body(&mesh.triangles, &frames, 30.0, &Colours::default());
    (vec![as_text], vec![binary, moving.expect("a small scene")])
}

/// Numbers in single precision, little-endian, as in glTF.
pub fn floats(values: impl IntoIterator<Item = f64>) -> Vec<u8> {
    values.into_iter().flat_map(|x| (x as f32).to_le_bytes()).collect()
}

/// Concatenates `parts`, each aligned to 4 bytes, and returns them with their glTF `bufferViews`.
pub fn buffer(parts: Vec<Vec<u8>>) -> (Vec<u8>, String) {
    let (mut data, mut views) = (Vec::new(), Vec::new());
    for part in parts {
        let (from, length) = (data.len(), part.len());
        views.push(format!(r#"{{"buffer": 0, "byteOffset": {from}, "byteLength": {length}}}"#));
        data.extend(part);
        data.resize(data.len().next_multiple_of(4), 0);
    }
    (data, views.join(", "))
}

/// glTF text and buffer of the limb with a bone below and one above its middle; `URI` stands for the reference to the buffer.
fn skinned() -> (String, Vec<u8>) {
    let mesh = cylinder(0.11, 1.0, 6, 4);
    let upper = |p: &DVec3| f64::from(u8::from(p.y > 0.5));
    let bind =
        |height: f64| [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -height, 0.0, 1.0];
    let turn = DQuat::from_rotation_z(1.0).to_array();
    let (data, views) = buffer(vec![
        floats(mesh.positions.iter().flat_map(|p| p.to_array())),
        mesh.triangles.iter().flatten().flat_map(|v| (*v as u16).to_le_bytes()).collect(),
        mesh.positions.iter().flat_map(|_| [0, 1, 0, 0]).collect(),
        floats(mesh.positions.iter().flat_map(|p| [1.0 - upper(p), upper(p), 0.0, 0.0])),
        floats([bind(0.0), bind(0.5)].concat()),
        floats([0.0, 1.0]),
        floats([[0.0, 0.0, 0.0, 1.0], turn].concat()),
        floats([[0.0; 3], [0.0, 0.5, 0.0], [0.0; 3], [0.0; 3], [0.1, 0.5, 0.0], [0.0; 3]].concat()),
    ]);
    let (vertices, corners) = (mesh.positions.len(), mesh.triangles.len() * 3);
    let text = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0, 1]}}],
        "nodes": [{{"mesh": 0, "skin": 0}}, {{"children": [2], "scale": [1, 1, 1]}}, {{"translation": [0, 0.5, 0]}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0, "JOINTS_0": 2, "WEIGHTS_0": 3}}, "indices": 1}}]}}],
        "skins": [{{"joints": [1, 2], "inverseBindMatrices": 4}}],
        "animations": [{{"name": "bend", "samplers": [{{"input": 5, "output": 6}}, {{"input": 5, "output": 7,
            "interpolation": "CUBICSPLINE"}}],
            "channels": [{{"sampler": 0, "target": {{"node": 2, "path": "rotation"}}}},
                {{"sampler": 1, "target": {{"node": 2, "path": "translation"}}}}]}}],
        "accessors": [
            {{"bufferView": 0, "componentType": 5126, "count": {vertices}, "type": "VEC3",
                "min": [-0.11, 0, -0.11], "max": [0.11, 1, 0.11]}},
            {{"bufferView": 1, "componentType": 5123, "count": {corners}, "type": "SCALAR"}},
            {{"bufferView": 2, "componentType": 5121, "count": {vertices}, "type": "VEC4"}},
            {{"bufferView": 3, "componentType": 5126, "count": {vertices}, "type": "VEC4"}},
            {{"bufferView": 4, "componentType": 5126, "count": 2, "type": "MAT4"}},
            {{"bufferView": 5, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]}},
            {{"bufferView": 6, "componentType": 5126, "count": 2, "type": "VEC4"}},
            {{"bufferView": 7, "componentType": 5126, "count": 6, "type": "VEC3"}}],
        "bufferViews": [{views}], "buffers": [{{URI"byteLength": {}}}]}}"#,
        data.len()
    );
    (text, data)
}

/// BVH file: a walk of two frames.
pub const MOTION: &str = "HIERARCHY\nROOT Hips\n{\n OFFSET 0 90 0\n CHANNELS 6 Xposition Yposition Zposition Zrotation \
    Xrotation Yrotation\n JOINT LeftUpLeg\n {\n  OFFSET 10 0 0\n  CHANNELS 3 Zrotation Xrotation Yrotation\n  JOINT LeftLeg\n  \
    {\n   OFFSET 0 -40 0\n   CHANNELS 3 Zrotation Xrotation Yrotation\n   End Site\n   {\n    OFFSET 0 -40 0\n   }\n  }\n }\n}\n\
    MOTION\nFrames: 2\nFrame Time: 0.0333\n0 90 0 0 0 0 0 30 0 0 10 0\n0 91 4 0 5 0 0 -30 0 0 45 0\n";

/// A grade rule table.
pub fn rules() -> Vec<u8> {
    let sizes = READY_SIZES[0].run();
    let mut table = RuleTable { sizes, ..RuleTable::default() };
    for step in [0.01, 0.02] {
        let rule = GradeRule::even(DVec2::new(step, -step), table.sizes.len(), table.sizes.base);
        table.number(&rule);
    }
    table.write("SHIRT")
}

/// CSV table of sizes.
pub const SIZES: &str =
    "size;bust;waist;hip (mm);height\n36;84;68;930;166\n38;88,5;72;;168\n40;92;76;1010;168\n";

/// JSON file of joint angles.
pub const JOINTS: &str = r#"{"left_elbow": 60, "right_hip": {"flexion": 30, "abduction": 20}}"#;

/// JSON file of a scene with falling cloth.
pub const SCENE: &str = r#"{"cloth": "cloth.obj", "seconds": 0.1, "fps": 30, "gravity": [0, -9.81, 0], "pins": [0, 1],
    "fabric": "wool", "self_collision": true, "collider": "body.obj", "thickness_m": 0.002, "steps_per_frame": 1}"#;
