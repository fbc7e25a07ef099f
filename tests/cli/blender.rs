//! What Blender makes of exported cloth. The tests step aside unless there is a Python with the module bpy: the one that
//! TOILE_BPY names, or python3.

use std::process::Command;

use crate::program::Place;
use crate::textures::{Scene, dressed};

/// A Python with Blender in it.
fn python() -> Option<String> {
    let name = std::env::var("TOILE_BPY").unwrap_or_else(|_| "python3".to_owned());
    let asks = "import importlib.util, sys; sys.exit(importlib.util.find_spec('bpy') is None)";
    let has = Command::new(&name).args(["-c", asks]).output().is_ok_and(|out| out.status.success());
    if !has {
        println!("skipped: {name} has no module bpy (name one that has it in TOILE_BPY)");
    }
    has.then_some(name)
}

/// Runs `script` in the folder of `place`; the JSON object of the last line it prints.
pub fn told(python: &str, place: &Place, script: &str) -> serde_json::Value {
    place.write("script.py", script);
    let done = Command::new(python).arg("script.py").current_dir(place.path("")).output().expect("it starts");
    let (out, err) = (String::from_utf8_lossy(&done.stdout), String::from_utf8_lossy(&done.stderr));
    let line = out.lines().rfind(|line| line.starts_with("told ")).unwrap_or_else(|| panic!("{out}\n{err}"));
    serde_json::from_str(line.trim_start_matches("told ")).expect("JSON")
}

/// Looks at the meshes of the scene: size, images that the materials' colour and normal come from, texture coordinates.
const LOOK: &str = r#"
import json
def source(node, name):
    links = node.inputs[name].links
    while links:
        other = links[0].from_node
        if other.type == 'TEX_IMAGE':
            return [other.image.name, list(other.image.size)]
        links = [link for key in other.inputs for link in key.links]
    return None
def look(o):
    mesh = o.data
    of = {}
    for slot in o.material_slots:
        shader = next(n for n in slot.material.node_tree.nodes if n.type == 'BSDF_PRINCIPLED')
        of[slot.material.name] = {
            'colour': source(shader, 'Base Color'), 'normal': source(shader, 'Normal'),
            'roughness': shader.inputs['Roughness'].default_value,
            'strength': [n.inputs['Strength'].default_value for n in slot.material.node_tree.nodes if n.type == 'NORMAL_MAP'],
        }
    places = [[round(c, 5) for c in o.matrix_world @ v.co] for v in mesh.vertices]
    uv = [[c for c in d.uv] for d in mesh.uv_layers[0].data] if mesh.uv_layers else []
    return {'materials': of, 'places': places, 'layers': len(mesh.uv_layers), 'faces': len(mesh.polygons),
            'uv': [min(map(min, uv), default=0), max(map(max, uv), default=0)]}
print('told ' + json.dumps({o.name: look(o) for o in bpy.data.objects if o.type == 'MESH'}))
"#;

/// Places of a mesh, rounded, as text.
fn places(mesh: &serde_json::Value) -> std::collections::BTreeSet<String> {
    mesh["places"].as_array().expect("places").iter().map(ToString::to_string).collect()
}

#[test]
fn blender_gets_materials_scale_and_seams() {
    let Some(python) = python() else { return };
    let place = dressed();
    place.ends(0, "export dressed.toile -o cloth.glb --textures 128 --fabric denim-11oz");
    let script = format!(
        "import bpy\nbpy.ops.wm.read_factory_settings(use_empty=True)\nbpy.ops.import_scene.gltf(filepath='cloth.glb')\n{LOOK}"
    );
    let seen = told(&python, &place, &script);
    let [left, right] = ["left", "right"].map(|name| &seen[name]);
    assert!(seen["body"].is_object() && left.is_object() && right.is_object(), "{seen}");
    for piece in [left, right] {
        assert_eq!(piece["layers"], 2, "the atlas and the weave");
        let front = &piece["materials"]["denim-11oz, front"];
        assert_eq!(front["colour"][1], serde_json::json!([128, 128]), "{front}");
        assert!(front["normal"].is_array(), "{front}");
        assert!((front["roughness"].as_f64().unwrap_or_default() - 0.75).abs() < 1e-6, "{front}");
        assert!(piece["materials"]["denim-11oz, back"].is_object(), "{piece}");
    }
    // A metre is a metre: the ball of 0.75 m is 1.5 m high, Blender's z up.
    let heights = seen["body"]["places"].as_array().expect("places").iter().filter_map(|p| p[2].as_f64());
    let (low, high) = heights.fold((f64::MAX, f64::MIN), |(low, high), z| (low.min(z), high.max(z)));
    assert!((high - low - 1.5).abs() < 1e-3, "{low} {high}");
    // The seam of 0.3 m in edges of 0.06 m: both sides are at the same places.
    let shared = places(left).intersection(&places(right)).count();
    assert!((5..=8).contains(&shared), "{shared} places are shared");
}

#[test]
fn blender_gets_the_images_of_an_obj() {
    let Some(python) = python() else { return };
    let place = dressed();
    place.ends(0, "export dressed.toile -o cloth.obj --textures 128 --fabric denim-11oz");
    let script = format!(
        "import bpy\nbpy.ops.wm.read_factory_settings(use_empty=True)\nbpy.ops.wm.obj_import(filepath='cloth.obj')\n{LOOK}"
    );
    let seen = told(&python, &place, &script);
    for piece in ["left", "right"] {
        let material = &seen[piece]["materials"]["denim-11oz"];
        assert_eq!(material["colour"][1], serde_json::json!([128, 128]), "{seen}");
        assert_eq!(material["normal"][1], serde_json::json!([128, 128]), "{material}");
        assert_eq!(material["strength"], serde_json::json!([1.0]), "one normal map");
        assert!((material["roughness"].as_f64().unwrap_or_default() - 0.75).abs() < 1e-3, "{material}");
        let uv = &seen[piece]["uv"];
        assert!(uv[0].as_f64() >= Some(0.0) && uv[1].as_f64() <= Some(1.0), "{uv}");
    }
    let shared = places(&seen["left"]).intersection(&places(&seen["right"])).count();
    assert!(shared >= 5, "{shared} places are shared");
}

#[test]
fn blender_gets_buttons_piping_and_stitches() {
    let Some(python) = python() else { return };
    let place = crate::trims::trimmed();
    place.ends(0, "export dressed.toile -o cloth.glb --textures 16");
    let script = format!(
        "import bpy\nbpy.ops.wm.read_factory_settings(use_empty=True)\nbpy.ops.import_scene.gltf(filepath='cloth.glb')\n{LOOK}"
    );
    let seen = told(&python, &place, &script);
    let cloth = places(&seen["left"]).len();
    for name in crate::trims::NAMES {
        let trim = &seen[name];
        assert!(trim["faces"].as_u64() > Some(20), "{name}: {seen}");
        assert!(trim["materials"][name].is_object(), "{name}: {}", trim["materials"]);
    }
    assert!(cloth > 10 && places(&seen["Piping"]).len() > cloth);
}

/// The skirt of the walk that ends with an export, in "skirt.glb"; None where the recording was made on another kind of machine,
/// whose bits differ.
fn walked() -> Option<Place> {
    let text = toile::session::demos::Demo::Export.recording();
    let recording = toile::session::recording::Recording::parse(text).expect("a recording");
    if recording.machine != toile::session::recording::machine() {
        println!("skipped: the walk was recorded on {}", recording.machine);
        return None;
    }
    let place = Place::new();
    let done = place.ends(0, "replay demo:export --out out --save skirt.toile");
    assert!(done.out.contains("hashes the same"), "{done:?}");
    assert!(place.read("out/garment.obj").contains("skirt_front"));
    place.ends(0, "export skirt.toile -o skirt.glb --textures 256");
    Some(place)
}

#[test]
fn the_walk_ends_with_cloth_that_has_its_print() {
    let Some(place) = walked() else { return };
    let scene = Scene::read(&place, "skirt.glb");
    let colours = |name: &str| {
        let (_, image) = scene.outside(name);
        let image = image.expect("base colours");
        let light = image.pixels().filter(|p| p.0.iter().all(|c| *c > 120)).count();
        light as f64 / f64::from(image.width() * image.height())
    };
    assert!(colours("skirt front") > 0.02, "light checks");
}

#[test]
fn blender_gets_the_skirt_of_the_walk() {
    let Some(python) = python() else { return };
    let Some(place) = walked() else { return };
    let script = format!(
        "import bpy\nbpy.ops.wm.read_factory_settings(use_empty=True)\nbpy.ops.import_scene.gltf(filepath='skirt.glb')\n{LOOK}"
    );
    let seen = told(&python, &place, &script);
    assert!(seen["body"].is_object(), "{seen}");
    for piece in ["waistband front", "waistband back", "skirt front", "skirt back"] {
        // Blender numbers materials of the same name.
        let materials = seen[piece]["materials"].as_object().expect("materials");
        let (_, front) = materials.iter().find(|(name, _)| name.starts_with("wool, front")).expect("wool");
        assert_eq!(front["colour"][1], serde_json::json!([256, 256]), "{piece}");
        assert!(front["normal"].is_array(), "{piece}: {front}");
    }
    // Blender's z is up: the skirt hangs between knee and waist of a body of usual height.
    let places = seen["skirt front"]["places"].as_array().expect("places");
    let heights: Vec<f64> = places.iter().filter_map(|p| p[2].as_f64()).collect();
    assert!(heights.iter().all(|z| (0.2..1.4).contains(z)), "metres");
}
