use glam::*;
use std::sync::Arc;
use toile::render::*;
fn mesh(m: &toile::geometry::mesh::TriMesh, front: [u8; 3], back: [u8; 3], cloth: f32) -> Arc<Mesh> {
    Arc::new(Mesh {
        positions: m.positions.iter().map(|p| p.as_vec3()).collect(),
        normals: m.vertex_normals().iter().map(|p| p.as_vec3()).collect(),
        triangles: m.triangles.clone(),
        front,
        back,
        cloth,
        ..Default::default()
    })
}
fn obj(path: &str) -> toile::geometry::mesh::TriMesh {
    let mut m = toile::geometry::mesh::TriMesh::default();
    for l in std::fs::read_to_string(path).unwrap().lines() {
        let mut p = l.split_whitespace();
        match p.next() {
            Some("v") => {
                let v: Vec<f64> = p.map(|x| x.parse().unwrap()).collect();
                m.positions.push(DVec3::new(v[0], v[1], v[2]));
            }
            Some("f") => {
                let f: Vec<u32> =
                    p.map(|x| x.split('/').next().unwrap().parse::<u32>().unwrap() - 1).collect();
                m.triangles.push([f[0], f[1], f[2]]);
            }
            _ => {}
        }
    }
    m
}
#[test]
fn pic() {
    let args = std::env::var("PIC").unwrap_or_default();
    let mut studio = Studio::new().unwrap();
    let look = Look::default();
    let mut scene = Scene::default();
    let mut it = args.split(' ');
    let body = it.next().unwrap_or("");
    let b = if body.is_empty() { toile::body::mannequin::default().mesh.clone() } else { obj(body) };
    scene.meshes.push(mesh(&b, [214, 190, 172], [120, 80, 80], 0.0));
    if let Some(g) = it.next() {
        scene.meshes.push(mesh(&obj(g), [120, 176, 130], [226, 160, 170], 1.0));
    }
    for (name, view) in
        [("front", View::Front), ("three", View::ThreeQuarter), ("back", View::Back), ("left", View::Left)]
    {
        let p = studio.picture(&scene, view, &look, UVec2::new(600, 900)).unwrap();
        save_png(&p, std::path::Path::new(&format!("/tmp/try/pic_{name}.png"))).unwrap();
    }
}
