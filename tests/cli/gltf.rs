//! Bodies and animations in glTF.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use base64::Engine as _;
use toile::geometry::words::Words;
use toile::io::gltf::{self, Model};
use toile::session::project_file;

use crate::common::limb::{self, bent, glb, limb, skinned};
use crate::program::Place;
use crate::repose::vertices;

fn alone(bytes: &[u8]) -> Result<Model, gltf::GltfError> {
    gltf::read(bytes, &|name| Err(Words::plain(format!("{name} is not there"))))
}

fn check(model: &Model) {
    let flat = limb();
    assert_eq!(model.mesh().triangles, flat.triangles);
    assert_eq!(model.animations().collect::<Vec<_>>(), ["bend", "snap"]);
    assert_eq!([0, 1, 2].map(|clip| model.seconds(clip)), [Some(1.0), Some(1.0), None]);
    let times = [
        (None, 0.0),
        (Some((0, 0.0)), 0.0),
        (Some((0, 0.5)), FRAC_PI_4),
        (Some((0, 1.0)), FRAC_PI_2),
        (Some((0, 9.0)), FRAC_PI_2),
        (Some((1, 0.5)), 0.0),
        (Some((1, 1.0)), FRAC_PI_2),
    ];
    for (at, angle) in times {
        let there = model.positions(at);
        let worst = there.iter().zip(&flat.positions).map(|(p, &q)| p.distance(bent(q, angle)));
        let worst = worst.fold(0.0, f64::max);
        assert!(worst < 1e-6, "{at:?}: {worst}");
    }
}

#[test]
fn a_skinned_cylinder_bends_exactly_in_every_kind_of_file() {
    check(&alone(&glb()).expect("a binary file"));
    let (json, data) = skinned(Some("limb.bin"));
    let beside = gltf::read(json.as_bytes(), &|name| {
        (name == "limb.bin").then(|| data.clone()).ok_or_else(Words::default)
    });
    check(&beside.expect("a text with a file"));
    let inline = base64::engine::general_purpose::STANDARD.encode(&data);
    let (json, _) = skinned(Some(&format!("data:application/octet-stream;base64,{inline}")));
    check(&alone(json.as_bytes()).expect("a text with all in it"));
    let why = alone(skinned(Some("limb.bin")).0.as_bytes()).expect_err("no file").to_string();
    assert!(why.contains("limb.bin is not there"), "{why}");
}

/// The same, with the places of vertices 3 and 700 and the second time only as sparse values.
fn sparse() -> (String, Vec<u8>) {
    let (json, mut data) = skinned(Some("limb.bin"));
    let full = data.len();
    let mut kept = Vec::new();
    for vertex in [3, 700] {
        let place = &mut data[12 * vertex..12 * (vertex + 1)];
        kept.extend_from_slice(place);
        place.fill(0xff); // What is no number may stand where it is replaced.
    }
    let mut views = String::new();
    for bytes in [&[3, 0, 0xbc, 2][..], &kept, &[1], &1_f32.to_le_bytes()] {
        let (start, length) = (data.len(), bytes.len());
        views += &format!(r#", {{"buffer": 0, "byteOffset": {start}, "byteLength": {length}}}"#);
        data.extend(bytes);
        data.resize(data.len().next_multiple_of(4), 0);
    }
    let places = r#""type": "VEC3", "sparse": {"count": 2, "indices": {"bufferView": 7, "componentType": 5123},
        "values": {"bufferView": 8}},"#;
    let times = r#"{"componentType": 5126, "sparse": {"count": 1, "indices": {"bufferView": 9, "componentType": 5121},
        "values": {"bufferView": 10}},"#;
    let json = json
        .replacen(r#""type": "VEC3","#, places, 1)
        .replacen(r#"{"bufferView": 5, "componentType": 5126,"#, times, 1)
        .replacen(r#"], "buffers""#, &format!(r#"{views}], "buffers""#), 1)
        .replacen(
            &format!(r#""byteLength": {full}}}]}}"#),
            &format!(r#""byteLength": {}}}]}}"#, data.len()),
            1,
        );
    (json, data)
}

#[test]
fn sparse_values_stand_for_those_they_replace() {
    let (json, data) = sparse();
    check(&gltf::read(json.as_bytes(), &|_| Ok(data.clone())).expect("a sparse file"));
    for (from, to, words) in [
        (
            r#""bufferView": 7, "componentType": 5123"#,
            r#""bufferView": 7, "componentType": 5121"#,
            "do not rise",
        ),
        (
            r#""bufferView": 9, "componentType": 5121"#,
            r#""bufferView": 10, "componentType": 5125"#,
            "below 2",
        ),
        (
            r#""bufferView": 7, "componentType": 5123"#,
            r#""bufferView": 7, "componentType": 5125"#,
            "beyond its buffer",
        ),
        (r#"{"bufferView": 8}"#, r#"{"bufferView": 8, "byteOffset": 4}"#, "beyond its buffer"),
        (r#"{"bufferView": 8}"#, r#"{"bufferView": 80}"#, "no glTF that can be read"),
        (
            r#"{"count": 2, "indices""#,
            r#"{"count": 4000000000, "indices""#,
            "accessor 0 reaches beyond its buffer",
        ),
    ] {
        let changed = json.replacen(from, to, 1);
        assert_ne!(changed, json, "{from}");
        let why = gltf::read(changed.as_bytes(), &|_| Ok(data.clone())).expect_err(to).to_string();
        assert!(why.contains(words), "{to}: {why}");
    }
    for length in (0..data.len()).step_by(5) {
        let cut = gltf::read(json.as_bytes(), &|_| Ok(data[..length].to_vec()));
        assert!(cut.is_err(), "cut after {length} bytes");
    }
}

#[test]
fn faulty_scenes_are_refused_in_words() {
    let (json, data) = skinned(Some("limb.bin"));
    let read = |json: &str| gltf::read(json.as_bytes(), &|_| Ok(data.clone()));
    for (from, to, words) in [
        (
            r#""count": 2, "type": "MAT4""#,
            r#""count": 3, "type": "MAT4""#,
            "accessor 4 reaches beyond its buffer",
        ),
        (r#""JOINTS_0": 2"#, r#""JOINTS_0": 3"#, "does not hold whole numbers"),
        (r#""joints": [1, 2]"#, r#""joints": [1]"#, "a joint that skin 0 has not"),
        (r#"{"children": [2]}"#, r#"{"children": [1, 2]}"#, "ring"),
        (r#""indices": 1"#, r#""indices": 6"#, "mesh 0, primitive 0"),
        (r#""target": {"node": 2"#, r#""target": {"node": 9"#, "the node that it moves is not there"),
        (r#""POSITION": 0"#, r#""POSITION": 90"#, "no glTF that can be read"),
        (r#""indices": 1"#, r#""indices": 60"#, "no glTF that can be read"),
        (r#""path": "rotation""#, r#""path": "rotten""#, "what it moves of the node is not known"),
        (r#""path": "rotation""#, r#""path": "scale""#, "animation 0, channel 0"),
        (r#""nodes": [0, 1]"#, r#""nodes": [1]"#, "no triangles"),
    ] {
        let changed = json.replacen(from, to, 1);
        assert_ne!(changed, json, "{from}");
        let why = read(&changed).expect_err(to).to_string();
        assert!(why.contains(words), "{to}: {why}");
    }
    let bytes = glb();
    let mut short = bytes.clone();
    short[8..12].copy_from_slice(&3_u32.to_le_bytes());
    let why = alone(&short).expect_err("shorter than its header").to_string();
    assert!(why.contains("its header says that it has 3 bytes"), "{why}");
    for at in (0..bytes.len()).step_by(7) {
        let _ = alone(&bytes[..at]);
    }
    for at in 0..3000 {
        for byte in [0, b'9', b'}', 0xff] {
            let mut bytes = bytes.clone();
            bytes[at] = byte;
            if let Ok(model) = alone(&bytes) {
                let _ = model.positions(Some((0, 0.3)));
            }
        }
    }
}

#[test]
fn cloth_goes_along_with_an_animated_body() {
    let place = Place::new();
    place.write("limb.glb", glb());
    place.ends(0, "check limb.glb --unit m");
    place.save("still.toile", &limb::project());
    place.run("dress still.toile --body limb.glb --unit m --out still --save kept.toile");
    let kept = project_file::open(&place.path("kept.toile")).expect("a project").document.animations;
    assert_eq!(kept.expect("kept for the window").names().collect::<Vec<_>>(), ["bend", "snap"]);
    place.save("marked.toile", &limb::project());
    let ended = place.run("dress marked.toile --out out --save dressed.toile");
    assert!([0, 1].contains(&ended.code), "{ended:#?}");
    let ended =
        place.run("repose dressed.toile --motion limb.glb --textures 16 --unit m --fps 10 --out posed");
    assert!([0, 1].contains(&ended.code), "{ended:#?}");
    let report = place.json("posed/report.json");
    let frames = report["frames"].as_array().expect("frames");
    assert!(frames.len() == 11 && frames.iter().all(|frame| frame["inside"] == 0), "{frames:?}");
    let [before, after] =
        ["posed/garment_0000.obj", "posed/garment_0010.obj"].map(|name| vertices(&place.read(name)));
    // All of it is above the bend and beside the other bone: it turns with its own.
    let off = before.iter().zip(&after).map(|(&p, q)| q.distance(bent(p, FRAC_PI_2)));
    let worst = off.fold(0.0, f64::max);
    let enough = before.len() > 5 && before.iter().all(|p| p.y > 0.65);
    assert!(enough && worst < 1e-6, "{} vertices, {worst}", before.len());
    assert!(ended.err.contains("2 animations: 1 bend, 2 snap: the first is taken"), "{ended:#?}");
    let other = |asked: &str| {
        format!(
            "repose dressed.toile --motion limb.glb --animation {asked} --textures 16 --unit m --fps 10 --frames 5..6 --out {asked}"
        )
    };
    // The other one stands still until its end, by either name.
    for asked in ["snap", "2"] {
        let ended = place.run(&other(asked));
        assert!([0, 1].contains(&ended.code) && !ended.err.contains("the first is taken"), "{ended:#?}");
        let cloth = vertices(&place.read(&format!("{asked}/garment_0000.obj")));
        let worst = before.iter().zip(&cloth).map(|(p, q)| p.distance(*q)).fold(0.0, f64::max);
        assert!(worst < 1e-6, "{asked}: {worst}");
    }
    let why = "limb.glb: there is no animation \"leap\" in it; it has 2 animations: 1 bend, 2 snap";
    place.ends_with_words(3, &other("leap"), why);
    let still = place.run("repose dressed.toile --motion marked.toile --out still");
    assert!(still.code == 3 && still.err.contains("marked.toile"), "{still:#?}");
}
