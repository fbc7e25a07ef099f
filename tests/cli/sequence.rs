//! `toile repose` with frames: files of bodies, and captured motions.

use glam::{DQuat, DVec3};

use crate::program::Place;
use crate::repose::{dressed, moved, vertices};
use crate::textures::normals;

/// Where everything is in frame `i`.
fn turned(i: usize) -> impl Fn(DVec3) -> DVec3 {
    let turn = DQuat::from_rotation_y(0.2 * i as f64) * DQuat::from_rotation_x(0.1 * i as f64);
    move |p| turn * p + DVec3::new(0.05, 0.02, -0.1) * i as f64
}

/// The dressed ball and a folder of frames in which it turns.
fn with_frames() -> Place {
    let place = dressed();
    std::fs::create_dir(place.path("frames")).expect("a folder");
    let body = place.read("out/body.obj");
    for i in 0..11 {
        place.write(&format!("frames/ball{i}.obj"), moved(&body, turned(i)));
    }
    place
}

/// The JSON part of a GLB file.
fn gltf(place: &Place, name: &str) -> gltf_json::Root {
    let bytes = std::fs::read(place.path(name)).expect("a file");
    let length = u32::from_le_bytes(bytes[12..16].try_into().expect("4 bytes")) as usize;
    gltf_json::Root::from_slice(&bytes[20..20 + length]).expect("glTF")
}

#[test]
fn cloth_goes_along_through_a_folder_of_frames() {
    let place = with_frames();
    let ended = place
        .run("repose dressed.toile --sequence --body frames --textures 16 --unit m --fps 25 --out posed");
    assert!([0, 1].contains(&ended.code), "{ended:#?}");
    let before = vertices(&place.read("out/garment.obj"));
    for i in 0..11 {
        let text = place.read(&format!("posed/garment_{i:04}.obj"));
        let (after, there) = (vertices(&text), turned(i));
        let turn = |n: [f32; 3]| there(DVec3::from_array(n.map(f64::from))) - there(DVec3::ZERO);
        let [dressed, posed] = [&place.read("out/garment.obj"), &text].map(|text| normals(text));
        assert!(dressed.len() > 50 && dressed.len() == posed.len(), "frame {i}: {}", posed.len());
        let apart = |(&n, &q): (&[f32; 3], &[f32; 3])| turn(n).distance(DVec3::from_array(q.map(f64::from)));
        let apart = dressed.iter().zip(&posed).map(apart).fold(0.0, f64::max);
        assert!(apart < 0.05, "frame {i}: normals turn along, {apart}");
        let worst = before.iter().zip(&after).map(|(&p, q)| there(p).distance(*q)).fold(0.0, f64::max);
        assert!(before.len() == after.len() && worst < 1e-4, "frame {i}: {worst}");
    }
    let report = place.json("posed/report.json");
    let frames = report["frames"].as_array().expect("frames");
    assert!(frames.len() == 11 && frames[10]["name"].as_str().expect("a name").contains("ball10"));
    assert!(frames.iter().all(|frame| frame["excess_p99"].as_f64().expect("strain") < 1e-6), "{frames:?}");
    assert!(ended.out.contains("frame 11 of 11"), "{ended:#?}");
    let root = gltf(&place, "posed/sequence.glb");
    let targets = |mesh: &gltf_json::Mesh| mesh.primitives[0].targets.as_ref().map_or(0, Vec::len);
    assert!(root.meshes.iter().all(|mesh| targets(mesh) == 10) && root.animations.len() == 1);
    let times = root.get(root.animations[0].samplers[0].input).expect("times");
    assert!((times.max.as_ref().expect("an end")[0].as_f64().expect("seconds") - 0.4).abs() < 1e-6);
}

#[test]
fn some_of_the_frames_are_made_and_threads_change_nothing() {
    let place = with_frames();
    let hash = |threads: usize| {
        let out = format!("posed{threads}");
        place.run(&format!(
            "repose dressed.toile --sequence --body frames/ball*.obj --frames 2..9 --every 3 --textures 16 --unit m --out {out} --threads {threads}"
        ));
        let names = place.names(&out);
        assert_eq!(
            names,
            ["garment_0000.obj", "garment_0001.obj", "garment_0002.obj", "report.json", "sequence.glb"]
        );
        let report = place.json(&format!("{out}/report.json"));
        assert!(report["frames"][2]["name"].as_str().expect("a name").contains("ball8"));
        (report["state_hash"].clone(), std::fs::read(place.path(&format!("{out}/sequence.glb"))).expect("it"))
    };
    assert!(hash(1) == hash(3));
}

#[test]
fn frames_of_another_body_are_refused_by_name() {
    let place = with_frames();
    place.write(
        "frames/ball7.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n",
    );
    let run = |rest: &str| format!("repose dressed.toile --sequence --unit m --out posed {rest}");
    place.ends_with_words(3, &run("--body frames"), "ball7.obj: it has 4 vertices and 4 triangles");
    place.ends_with_words(3, &run("--body nothing*.obj"), "no file nothing*.obj");
    place.ends_with_words(6, &run("--body nowhere.obj"), "nowhere.obj");
    place.ends_with_words(2, &run("--body frames --frames 3..40"), "there are 11 frames");
    place.ends_with_words(2, &run("--body frames --frames 4..4"), "FROM..TO");
    place.ends_with_words(2, &run("--body frames --every 0"), "from 1 on");
    place.ends_with_words(2, &run("--body frames --save one.toile"), "cannot be used with");
}

/// The left forearm bends by 0° to 90° while the whole walks 1 m forth.
const BEND: &str = "HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT LeftArm
  {
    OFFSET 20 40 0
    CHANNELS 3 Zrotation Xrotation Yrotation
    JOINT LeftForeArm
    {
      OFFSET 20 -20 0
      CHANNELS 3 Zrotation Xrotation Yrotation
      JOINT LeftHand { 
        OFFSET 18 -18 0
        CHANNELS 3 Zrotation Xrotation Yrotation
        End Site
        {
          OFFSET 8 -8 0
        }
      }
    }
  }
  JOINT Tail
  {
    OFFSET 0 -90 -10
    CHANNELS 0
    End Site
    {
      OFFSET 0 0 -10
    }
  }
}
MOTION
Frames: 3
Frame Time: 0.05
0 90 0 0 0 0 0 0 0 0 0 0 0 0 0
0 90 50 0 0 0 0 0 0 0 -45 0 0 0 0
0 90 100 0 0 0 0 0 0 0 -90 0 0 0 0
";

#[test]
fn a_captured_motion_moves_the_mannequin() {
    let place = Place::new();
    place.write("bend.bvh", BEND);
    let report = place.run("dress sample:scarf --edge-length 0.05 --save scarf.toile --out scarf");
    assert!([0, 1].contains(&report.code), "{report:#?}");
    let ended = place.run("repose scarf.toile --motion bend.bvh --textures 16 --out posed");
    assert!([0, 1].contains(&ended.code), "{ended:#?}");
    assert!(ended.err.contains("that move nothing of the mannequin: Tail"), "{ended:#?}");
    assert!(ended.err.contains("that nothing moves: spine, chest"), "{ended:#?}");
    let report = place.json("posed/report.json");
    assert_eq!(report["frames_per_second"].as_f64().map(f64::round), Some(20.0));
    let middle = |i: usize| {
        let cloth = vertices(&place.read(&format!("posed/garment_{i:04}.obj")));
        cloth.iter().sum::<DVec3>() / cloth.len() as f64
    };
    // No legs are known: the heights of both figures' pelvises tell the scale.
    let walked = middle(2) - middle(0);
    assert!((walked.z / (middle(1) - middle(0)).z - 2.0).abs() < 0.02 && walked.z > 0.5, "{walked}");
    assert!(walked.x.abs() < 0.01 && walked.y.abs() < 0.01, "{walked}");
}

/// `BEND` with z up: every offset and every row of numbers by hand.
const UPRIGHT_IN_Z: &str = "HIERARCHY
ROOT Hips
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Yrotation Xrotation Zrotation
  JOINT LeftArm
  {
    OFFSET 20 0 40
    CHANNELS 3 Yrotation Xrotation Zrotation
    JOINT LeftForeArm
    {
      OFFSET 20 0 -20
      CHANNELS 3 Yrotation Xrotation Zrotation
      JOINT LeftHand {
        OFFSET 18 0 -18
        CHANNELS 3 Yrotation Xrotation Zrotation
        End Site
        {
          OFFSET 8 0 -8
        }
      }
    }
  }
  JOINT Tail
  {
    OFFSET 0 10 -90
    CHANNELS 0
    End Site
    {
      OFFSET 0 10 0
    }
  }
}
MOTION
Frames: 3
Frame Time: 0.05
0 0 90 0 0 0 0 0 0 0 0 0 0 0 0
0 -50 90 0 0 0 0 0 0 0 -45 0 0 0 0
0 -100 90 0 0 0 0 0 0 0 -90 0 0 0 0
";

#[test]
fn a_motion_with_z_up_is_set_upright() {
    let place = Place::new();
    place.write("bend.bvh", BEND);
    place.write("upright.bvh", UPRIGHT_IN_Z);
    let dressed = place.run("dress sample:scarf --edge-length 0.05 --save scarf.toile --out scarf");
    assert!([0, 1].contains(&dressed.code), "{dressed:#?}");
    let last = |name: &str, up: &str| {
        let ended = place.run(&format!(
            "repose scarf.toile --motion {name}.bvh {up} --frames 2..3 --textures 16 --out {name}"
        ));
        assert!([0, 1].contains(&ended.code), "{ended:#?}");
        let is_told = ended.err.contains("z is taken to point up, by its rest pose (see --up)");
        (place.read(&format!("{name}/garment_0000.obj")), is_told)
    };
    let bend = last("bend", "");
    assert!(!bend.1 && last("bend", "--up y") == bend);
    assert_eq!(last("upright", ""), (bend.0.clone(), true));
    assert_eq!(last("upright", "--up z"), (bend.0.clone(), false));
    assert_ne!(last("upright", "--up y").0, bend.0);
}

#[test]
fn faulty_motions_are_refused_with_file_and_line() {
    let place = dressed();
    place.write("bend.bvh", BEND);
    place.write("cut.bvh", &BEND[..BEND.len() - 40]);
    place.write("odd.bvh", BEND.replace("OFFSET 20 40 0", "OFFSET 20 forty 0"));
    let run = |name: &str| format!("repose sample:scarf --motion {name} --out posed");
    place.ends_with_words(3, &run("odd.bvh"), "odd.bvh: line 8: \"forty\" is no number");
    place.ends_with_words(3, &run("cut.bvh"), "cut.bvh: line 38: a frame has 15 numbers");
    place.ends_with_words(3, &run("ball.toile"), "ball.toile: line 1");
    place.ends_with_words(3, "repose dressed.toile --motion bend.bvh --out posed", "is for the mannequin");
    place.ends_with_words(3, &run("bend.bvh --animation walk"), "bend.bvh: --animation chooses among");
    place.ends_with_words(
        2,
        "repose dressed.toile --motion bend.bvh --body a.obj --out posed",
        "cannot be used with",
    );
}
