//! Dressed cloth as USD, read back; and by USD itself where there is a Python with the module pxr (usd-core): the one that
//! TOILE_USD names, or python3. Without it that test steps aside.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{Cursor, Read as _};
use std::process::Command;

use glam::DVec3;
use zip::{CompressionMethod, ZipArchive};

use crate::blender::told;
use crate::program::Place;
use crate::repose::vertices;
use crate::textures::dressed;

/// The lines of `text` that begin an object of an OBJ or a vertex of it, for example.
fn count(text: &str, start: &str) -> usize {
    text.lines().filter(|line| line.starts_with(start)).count()
}

/// The files of a USDZ by their names. All are stored, at multiples of 64 bytes.
pub fn unpacked(place: &Place, name: &str) -> BTreeMap<String, Vec<u8>> {
    let mut zip =
        ZipArchive::new(Cursor::new(std::fs::read(place.path(name)).expect("a file"))).expect("zip");
    let mut files = BTreeMap::new();
    for i in 0..zip.len() {
        let mut file = zip.by_index(i).expect("a file");
        let name = file.name().expect("a name").to_string();
        assert_eq!(file.compression(), CompressionMethod::Stored, "{name}");
        assert_eq!(file.data_start().expect("a place") % 64, 0, "{name}");
        assert!(i > 0 || name.ends_with(".usda"), "the scene comes first: {name}");
        let mut bytes = Vec::new();
        file.read_to_end(&mut bytes).expect("its content");
        files.insert(name, bytes);
    }
    files
}

#[test]
fn usd_has_its_images_beside_it_or_inside() {
    let place = dressed();
    place.ends(0, "export dressed.toile -o cloth.usda --textures 128 --fabric denim-11oz");
    let images = ["cloth-colour.png", "cloth-weave-1.png"];
    assert_eq!(
        place.names(""),
        ["ball.toile", images[0], images[1], "cloth.usda", "dressed.toile", "out"],
        "the inner side is not seen"
    );
    let colour = image::open(place.path(images[0])).expect("a picture");
    assert_eq!((colour.width(), colour.height()), (128, 128));
    let text = place.read("cloth.usda");
    for name in images {
        assert_eq!(text.matches(&format!("@./{name}@")).count(), 1, "one material for both pieces: {name}");
    }
    place.ends(0, "export dressed.toile -o cloth.USDZ --textures 128 --fabric denim-11oz");
    let files = unpacked(&place, "cloth.USDZ");
    assert_eq!(
        files.keys().collect::<Vec<_>>(),
        ["garment.usda", "textures/colour.png", "textures/weave-1.png"]
    );
    assert_eq!(files["textures/colour.png"], std::fs::read(place.path(images[0])).expect("a file"));
    let inside = String::from_utf8_lossy(&files["garment.usda"]);
    assert_eq!(inside.replace("textures/", "cloth-"), text);
    place.ends(0, "export dressed.toile -o plain.usdz --textures 0");
    assert_eq!(unpacked(&place, "plain.usdz").len(), 1);
    place.ends_with_words(3, "export ball.toile -o cloth.usdz", "no dressed cloth");
}

#[test]
fn a_sequence_is_written_as_usd_where_that_is_asked() {
    let place = dressed();
    std::fs::create_dir(place.path("frames")).expect("a folder");
    for i in 0..3 {
        let there = |p: DVec3| p + DVec3::Y * (0.05 * f64::from(i));
        place.write(&format!("frames/ball{i}.obj"), crate::repose::moved(&place.read("out/body.obj"), there));
    }
    let ended = place.run(
        "repose dressed.toile --sequence --body frames --textures 16 --unit m --fps 25 --usd --out posed",
    );
    assert!([0, 1].contains(&ended.code), "{ended:#?}");
    let files = unpacked(&place, "posed/sequence.usdz");
    let text = String::from_utf8_lossy(&files["garment.usda"]);
    for words in ["endTimeCode = 2\n", "timeCodesPerSecond = 25\n"] {
        assert!(text.contains(words), "{words}");
    }
    assert_eq!(text.matches("points.timeSamples").count(), 3, "two pieces and the body");
    place.run("repose dressed.toile --sequence --body frames --textures 16 --unit m --out posed");
    assert!(place.names("posed").contains(&"sequence.glb".to_owned()));
    assert!(!place.names("posed").contains(&"sequence.usdz".to_owned()), "that was of another motion");
    place.ends_with_words(
        2,
        "repose dressed.toile --body frames/ball1.obj --usd --out x",
        "--sequence or --motion",
    );
}

/// A Python with USD in it.
fn python() -> Option<String> {
    let name = std::env::var("TOILE_USD").unwrap_or_else(|_| "python3".to_owned());
    let asks = "import importlib.util, sys; sys.exit(importlib.util.find_spec('pxr') is None)";
    let has = Command::new(&name).args(["-c", asks]).output().is_ok_and(|out| out.status.success());
    if !has {
        println!("skipped: {name} has no module pxr (name one that has it in TOILE_USD)");
    }
    has.then_some(name)
}

/// Looks at a scene, and at all that USD finds wrong with it.
const LOOK: &str = r#"
import json
from pxr import Usd, UsdGeom, UsdShade, UsdUtils
def faults(name, stage):
    try:
        from pxr import UsdValidation
    except ImportError:
        checker = UsdUtils.ComplianceChecker()
        checker.CheckCompliance(name)
        return checker.GetErrors() + checker.GetFailedChecks()
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    assert len(validators) > 10
    return [str(error.GetMessage()) for error in UsdValidation.ValidationContext(validators).Validate(stage)]
def look(prim):
    mesh = UsdGeom.Mesh(prim)
    points = mesh.GetPointsAttr().Get(0)
    material = UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0]
    shaders = [UsdShade.Shader(child) for child in material.GetPrim().GetChildren()]
    images = [shader.GetInput('file').Get() for shader in shaders if shader.GetInput('file')]
    st = UsdGeom.PrimvarsAPI(prim).GetPrimvar('st')
    return {
        'material': str(material.GetPath()), 'points': len(points),
        'places': [[round(c, 6) for c in p] for p in points],
        'triangles': [len(mesh.GetFaceVertexCountsAttr().Get()), len(mesh.GetFaceVertexIndicesAttr().Get()) / 3],
        'valid': all(UsdGeom.Mesh.ValidateTopology(mesh.GetFaceVertexIndicesAttr().Get(),
                                                   mesh.GetFaceVertexCountsAttr().Get(), len(points))[:1]),
        'normals': [len(mesh.GetNormalsAttr().Get()), mesh.GetNormalsInterpolation()],
        'st': len(st.Get()) if st.IsDefined() and st.HasValue() else 0,
        'images': [bool(image.resolvedPath) for image in images],
        'surface': material.ComputeSurfaceSource()[0].GetIdAttr().Get(),
        'samples': mesh.GetPointsAttr().GetNumTimeSamples(),
    }
def scene(name):
    stage = Usd.Stage.Open(name)
    meshes = {p.GetName(): look(p) for p in stage.Traverse() if p.IsA(UsdGeom.Mesh)}
    return {'up': UsdGeom.GetStageUpAxis(stage), 'metres': UsdGeom.GetStageMetersPerUnit(stage),
            'default': str(stage.GetDefaultPrim().GetPath()), 'faults': faults(name, stage), 'meshes': meshes}
print('told ' + json.dumps([scene(name) for name in ('cloth.usda', 'cloth.usdz')]))
"#;

#[test]
fn usd_itself_finds_the_whole_garment_and_no_fault() {
    let Some(python) = python() else { return };
    let place = dressed();
    for name in ["cloth.usda", "cloth.usdz"] {
        place.ends(0, &format!("export dressed.toile -o {name} --textures 128 --fabric denim-11oz"));
    }
    place.ends(0, "export dressed.toile -o cloth.obj");
    let (garment, body) = (place.read("cloth.obj"), place.read("out/body.obj"));
    for scene in told(&python, &place, LOOK).as_array().expect("two scenes") {
        assert_eq!((&scene["up"], &scene["metres"]), (&"Y".into(), &1.0.into()), "{scene}");
        assert_eq!((&scene["default"], &scene["faults"]), (&"/garment".into(), &serde_json::json!([])));
        let meshes = scene["meshes"].as_object().expect("meshes");
        let names: BTreeSet<&str> = meshes.keys().map(String::as_str).collect();
        assert_eq!(names, BTreeSet::from(["body", "left", "right"]));
        for (name, mesh) in meshes {
            let points = &mesh["points"];
            assert_eq!(mesh["triangles"][0].as_f64(), mesh["triangles"][1].as_f64(), "{name}");
            assert_eq!(mesh["valid"], true, "{name}");
            assert_eq!(mesh["normals"], serde_json::json!([points, "vertex"]), "{name}");
            assert_eq!(mesh["surface"], "UsdPreviewSurface", "{name}");
            let (st, images) = if name == "body" { (&0.into(), 0) } else { (points, 2) };
            assert_eq!((&mesh["st"], &mesh["images"]), (st, &vec![true; images].into()), "{name}");
        }
        assert_eq!(meshes["left"]["material"], meshes["right"]["material"]);
        let sum = |key: &str| -> u64 {
            let of = |name: &str| {
                let found = &meshes[name][key];
                found.as_u64().or(found[0].as_u64()).expect("a number")
            };
            of("left") + of("right")
        };
        assert_eq!(sum("triangles"), count(&garment, "f ") as u64);
        assert_eq!(sum("points"), count(&garment, "vt ") as u64);
        assert_eq!(meshes["body"]["triangles"][0], count(&body, "f "));
        assert_eq!(meshes["body"]["points"], count(&body, "v "));
        let skin = meshes["body"]["places"].as_array().expect("places");
        for (place, wanted) in skin.iter().zip(vertices(&body)) {
            let place = DVec3::from_array([0, 1, 2].map(|k| place[k].as_f64().expect("a number")));
            assert!(place.distance(wanted) < 1e-5, "{place} is not {wanted}");
        }
    }
}
