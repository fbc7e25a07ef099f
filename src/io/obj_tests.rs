use super::*;
use crate::io::dressed::tests::{bent_squares, folded_square, trimmed_squares};
use crate::io::materials::Colours;
use crate::io::{cloth_obj, mtl};

const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

fn good(text: &str) -> ObjMesh {
    read(text.as_bytes()).unwrap_or_else(|e| panic!("{text}: {e}"))
}

fn bad(text: &str, expected: &str) {
    let error = read(text.as_bytes()).expect_err(text).to_string();
    assert!(error.contains(expected), "expected {expected:?}, got {error:?}");
}

#[test]
fn a_tetrahedron_is_read_exactly() {
    let read = good(&TETRAHEDRON.replace("v 1 0 0", "v 0.1234567890123 0 0"));
    assert_eq!(read.mesh.positions[1].x, 0.1234567890123);
    assert_eq!(read.mesh.triangles, [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]);
    assert_eq!(read.notes, ObjNotes::default());
}

#[test]
fn the_many_ways_to_write_a_line() {
    let plain = good(TETRAHEDRON);
    assert_eq!(good(&format!("\u{feff}{TETRAHEDRON}")), plain);
    assert_eq!(good(&TETRAHEDRON.replace('\n', "\r\n")), plain);
    assert_eq!(good(&TETRAHEDRON.replace('\n', "\r")), plain);
    assert_eq!(good(&TETRAHEDRON.replace("f 1 3 2", " f\t1  3 2  # base ")), plain);
    assert_eq!(good(&TETRAHEDRON.replace("f 1 3 2", "f 1 \\\n3 \\\r\n2")), plain);
    assert_eq!(good(&TETRAHEDRON.replace("f 1 3 2", "f 1//7 3/2 2/3/4")), plain);
    assert_eq!(good(&TETRAHEDRON.replace("f 1 3 2", "f -4 -2 -3")), plain);
    assert_eq!(good(&TETRAHEDRON.replace("v 0 0 1", "v 0 0 1 1.0")), plain);
    assert_eq!(good(&format!("mtllib ../../../etc/passwd\nusemtl a b\ns off\n{TETRAHEDRON}")), plain);
}

#[test]
fn vertices_keep_their_order_used_or_not() {
    let read = good("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 4 3 2\ng more\nv 2 2 2\nf 4 3 5\n");
    assert_eq!(read.mesh.positions.len(), 5);
    assert_eq!(read.mesh.positions[0], DVec3::splat(9.0));
    assert_eq!(read.mesh.triangles, [[3, 2, 1], [3, 2, 4]]);
    assert_eq!(read.notes.groups, 1);
}

#[test]
fn faults_are_named_with_their_line() {
    bad("", "no vertices and no faces");
    bad("hello world\n", "line 1 begins with \"hello\"");
    bad("v 0 0 0\nv 1 0 0\nv 0 1 0\n", "3 vertices but no faces");
    bad("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nt 0 1 2 3\n", "line 5 begins with \"t\"");
    bad(&TETRAHEDRON.replace("v 1 0 0", "v 1 nan 0"), "line 2: a coordinate is not a number");
    bad(&TETRAHEDRON.replace("v 1 0 0", "v 1 -inf 0"), "line 2: the coordinate \"-inf\" is infinite");
    bad(&TETRAHEDRON.replace("v 1 0 0", "v 1 1e999 0"), "line 2: the coordinate \"1e999\" is infinite");
    bad(&TETRAHEDRON.replace("v 1 0 0", "v 1 1e30 0"), "line 2: the coordinate 1e30 is out of range");
    bad(&TETRAHEDRON.replace("v 1 0 0", "v 1,5 0 0"), "decimal comma");
    bad(&TETRAHEDRON.replace("v 1 0 0", "v 1 0"), "line 2: a vertex needs three numbers");
    bad(&TETRAHEDRON.replace("f 1 3 2", "f 1 3 0"), "line 5: vertex index 0");
    bad(&TETRAHEDRON.replace("f 1 3 2", "f 1 3 5"), "line 5: vertex index 5 is out of range: the file has 4");
    bad(&TETRAHEDRON.replace("f 1 3 2", "f 1 3 -5"), "line 5: vertex index -5 is out of range");
    bad(
        &TETRAHEDRON.replace("f 1 3 2", "f 1 3 99999999999999999999"),
        "line 5: \"99999999999999999999\" is no",
    );
    bad(&TETRAHEDRON.replace("f 1 3 2", "f 1 3 x"), "line 5: \"x\" is no vertex index");
    bad("v 0 0 0\nv 1 0 0\nf 1 2\nf 1 2 2\n", "all 2 faces of the file are degenerate");
    bad("v 0 0 0\0\n", "binary file");
}

#[test]
fn limits_hold() {
    let corners = " 1".repeat(5000);
    bad(&TETRAHEDRON.replace("f 1 3 2", &format!("f{corners}")), "more than 4096 corners");
    bad(&format!("#{}\n{TETRAHEDRON}", "x".repeat(2 << 20)), "line 1 has more than");
    bad(&"o x\n".repeat(20_000), "more than 10000 groups");
}

#[test]
fn degenerate_faces_are_dropped_and_counted() {
    let read = good(&format!("{TETRAHEDRON}f 1 2\nf 1 1 2\nf 3 3 3 3\n"));
    assert_eq!((read.mesh.triangles.len(), read.notes.degenerate_faces), (4, 3));
}

#[test]
fn polygons_are_cut() {
    let read = good("v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 0.5 0\nv 0 2 0\nf 1 2 3 4 5\nf 1 2 3 5\n");
    assert_eq!((read.notes.polygons, read.notes.concave_polygons), (2, 1));
    let area: f64 = (0..3)
        .map(|t| {
            let [a, b, c] = read.mesh.corners(t);
            (b - a).cross(c - a).z / 2.0
        })
        .sum();
    assert!((area - 2.5).abs() < 1e-12, "{area}");
}

#[test]
fn a_mesh_written_is_read_back() {
    let plain = good(TETRAHEDRON).mesh;
    assert_eq!(good(&mesh("my\nbody", &plain)).mesh, plain);
}

#[test]
fn every_truncation_ends_without_panic() {
    for end in 0..TETRAHEDRON.len() {
        let _ = read(&TETRAHEDRON.as_bytes()[..end]);
    }
}

#[test]
fn trims_come_after_the_cloth_as_objects_with_materials() {
    let (pattern, garment, state, trims) = trimmed_squares();
    let text = |trims: &[crate::cloth::TrimPart]| {
        let dressed = Dressed { garment: &garment, state: &state, pattern: &pattern, trims };
        let file = mtl::write(&dressed, &Colours::default(), str::to_owned);
        garment_with(&dressed, UsedMaterials { file: &file, file_name: "a.mtl", atlas: None })
    };
    let (with, without) = (text(&trims), text(&[]));
    let rest = with.strip_prefix(&without).expect("the cloth is as without trims");
    let materials: Vec<&str> = rest.lines().filter_map(|line| line.strip_prefix("usemtl ")).collect();
    assert_eq!(materials, ["Piping", "Button", "Button_thread", "Buttonhole", "Stitches"]);
    let (mesh, cloth) = (good(&with).mesh, good(&without).mesh);
    assert_eq!(mesh.triangles[..cloth.triangles.len()], cloth.triangles[..]);
    let [own, all] = [&cloth, &mesh].map(|mesh| mesh.positions.len());
    let faces = &mesh.triangles[cloth.triangles.len()..];
    assert!(faces.iter().flatten().all(|v| (own..all).contains(&(*v as usize))), "of vertices of their own");
    // Cords, buttons and stitches lie within some millimetres of the square of 0.1 m that they are on.
    for p in &mesh.positions[own..] {
        assert!(p.x > -0.001 && p.x < 0.101 && p.y > -0.0021 && p.y < 0.101 && p.z.abs() < 0.004, "{p}");
    }
}

/// The numbers of all lines that begin with `keyword`.
fn vectors(text: &str, keyword: &str) -> Vec<DVec3> {
    let rows = text.lines().filter_map(|line| line.strip_prefix(keyword)?.strip_prefix(' '));
    rows.map(|row| {
        let numbers: Vec<f64> = row.split(' ').map(|word| word.parse().expect("a number")).collect();
        DVec3::from_slice(&numbers)
    })
    .collect()
}

/// For each face its corners as indices from 0: vertex, texture coordinate (where it has one), normal.
fn corners(text: &str) -> Vec<Vec<(usize, Option<usize>, usize)>> {
    let index = |word: &str| word.parse::<usize>().expect("an index") - 1;
    let corner = |word: &str| match word.split('/').collect::<Vec<_>>()[..] {
        [v, "", n] => (index(v), None, index(n)),
        [v, t, n] => (index(v), Some(index(t)), index(n)),
        _ => panic!("{word}"),
    };
    let faces = text.lines().filter_map(|line| line.strip_prefix("f "));
    faces.map(|line| line.split(' ').map(corner).collect()).collect()
}

#[test]
fn cloth_has_normals_that_are_parted_at_sharp_folds_and_is_read_back_as_before() {
    for (angle, is_parted) in [(40.0, false), (170.0, true)] {
        let (pattern, garment, state) = bent_squares(angle);
        let text = super::garment(&garment, &state, &pattern);
        let normals = vectors(&text, "vn");
        assert_eq!(normals.len(), garment.corners.len());
        assert!(normals.iter().all(|n| n.is_normalized()), "unit to six digits");
        let faces = corners(&text);
        assert_eq!(faces.len(), garment.triangles.len());
        let mut of_vertices = vec![Vec::new(); garment.vertex_count];
        for &(v, flat, normal) in faces.iter().flatten() {
            assert_eq!(flat, Some(normal), "a normal for each flat corner");
            of_vertices[v].push(normals[normal]);
        }
        let parted = of_vertices.iter().filter(|all| all.iter().any(|n| *n != all[0])).count();
        let on_seam = garment.seam_pairs[0].1.len();
        assert_eq!(parted, if is_parted { on_seam } else { 0 }, "{angle} degrees");
        // The vertices and triangles that a file without normals gives.
        let plain: String = text.lines().filter(|l| l.starts_with("v ")).map(|l| format!("{l}\n")).collect();
        let faces = faces.iter().map(|f| format!("f {} {} {}\n", f[0].0 + 1, f[1].0 + 1, f[2].0 + 1));
        assert_eq!(good(&text).mesh, good(&(plain + &faces.collect::<String>())).mesh);
        let rest = cloth_obj::read(text.as_bytes()).expect("cloth").rest.expect("a flat shape");
        assert_eq!(rest.len(), garment.triangles.len());
    }
}

#[test]
fn a_pressed_fold_line_parts_normals_and_nothing_else() {
    let (pattern, garment, state) = folded_square(170.0);
    let text = super::garment(&garment, &state, &pattern);
    let [positions, normals] = ["v", "vn"].map(|keyword| vectors(&text, keyword));
    assert_eq!(positions.len(), garment.vertex_count);
    assert!(normals.len() > garment.corners.len());
    let (sin, cos) = f64::to_radians(170.0).sin_cos();
    for face in corners(&text) {
        let middle: f64 = face.iter().map(|&(v, ..)| positions[v].z).sum();
        let front = if middle < -1e-6 { DVec3::new(sin, 0.0, cos) } else { DVec3::Z };
        for (v, _, normal) in face {
            let is_inside = (0.01..0.09).contains(&positions[v].y);
            assert!(!is_inside || normals[normal].dot(front) > 0.4, "{} on {front}", normals[normal]);
        }
    }
    let flat: Vec<Option<usize>> = corners(&text).concat().iter().map(|&(_, flat, _)| flat).collect();
    let own: Vec<Option<usize>> =
        garment.triangle_corners.iter().flatten().map(|&c| Some(c as usize)).collect();
    assert_eq!(flat, own, "flat corners are as they were");
}

#[test]
fn trims_have_normals_of_their_own() {
    let (pattern, garment, state, trims) = trimmed_squares();
    let dressed = Dressed { garment: &garment, state: &state, pattern: &pattern, trims: &trims };
    let file = mtl::write(&dressed, &Colours::default(), str::to_owned);
    let text = garment_with(&dressed, UsedMaterials { file: &file, file_name: "a.mtl", atlas: None });
    let [positions, normals] = ["v", "vn"].map(|keyword| vectors(&text, keyword));
    let of_trims: Vec<_> = corners(&text).into_iter().filter(|face| face[0].1.is_none()).collect();
    assert_eq!(of_trims.len(), good(&text).mesh.triangles.len() - garment.triangles.len());
    let extra = positions.len() - garment.vertex_count;
    assert_eq!(normals.len(), garment.corners.len() + extra, "one for each vertex");
    for &(v, _, normal) in of_trims.iter().flatten() {
        assert_eq!(v - garment.vertex_count, normal - garment.corners.len());
        assert!((normals[normal].length() - 1.0).abs() < 1e-4, "{}", normals[normal]);
    }
}
