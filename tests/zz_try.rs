mod exact;
use exact::*;
use std::io::Write;
use std::sync::Arc;
use toile::body::Surface;
use toile::cloth::{ClothState, Garment, build};
use toile::relax::RelaxSettings;
use toile::wrap::{Dressing, Phase};
fn load(path: &str) -> Surface {
    let (m, _) = tobj::load_obj(
        path,
        &tobj::LoadOptions { single_index: false, triangulate: true, ..Default::default() },
    )
    .unwrap();
    let m = &m[0].mesh;
    let positions =
        m.positions.chunks(3).map(|c| glam::DVec3::new(c[0] as f64, c[1] as f64, c[2] as f64)).collect();
    let triangles = m.indices.chunks(3).map(|c| [c[0], c[1], c[2]]).collect();
    Surface::new(toile::geometry::mesh::TriMesh { positions, triangles }).unwrap()
}
fn write(path: &str, g: &Garment, s: &ClothState) {
    let mut f = std::io::BufWriter::new(std::fs::File::create(path).unwrap());
    for p in &s.positions {
        writeln!(f, "v {} {} {}", p.x, p.y, p.z).unwrap();
    }
    for c in &g.corners {
        writeln!(f, "vt {} {}", c.uv.x, c.uv.y).unwrap();
    }
    let mut last = None;
    for (t, vs) in g.triangles.iter().enumerate() {
        if !vs.iter().all(|v| s.mapped[*v as usize]) {
            continue;
        }
        if last != Some(g.triangle_pieces[t]) {
            last = Some(g.triangle_pieces[t]);
            writeln!(f, "o p{}", last.unwrap().0).unwrap();
        }
        let c = g.triangle_corners[t];
        writeln!(f, "f {}/{} {}/{} {}/{}", vs[0] + 1, c[0] + 1, vs[1] + 1, c[1] + 1, vs[2] + 1, c[2] + 1)
            .unwrap();
    }
}
#[test]
fn trace() {
    let data = std::env::var("TOILE_DATA").unwrap();
    let name = std::env::var("G").unwrap_or("tee_mean_all".into());
    let edge: f64 = std::env::var("E").ok().and_then(|e| e.parse().ok()).unwrap_or(0.015);
    let sample = toile::session::samples::Sample::ALL.into_iter().find(|s| s.file_stem() == name);
    let body = toile::body::mannequin::default();
    let surface = if sample.is_some() {
        Arc::new(Surface::new(body.mesh.clone()).unwrap())
    } else {
        Arc::new(load(&format!("{data}/bodies/garmentcode/mean_all.obj")))
    };
    let project = sample.map(|s| s.project(&body));
    if sample.is_some() {
        let mut f = std::io::BufWriter::new(std::fs::File::create("/tmp/try/mannequin.obj").unwrap());
        for p in &body.mesh.positions {
            writeln!(f, "v {} {} {}", p.x, p.y, p.z).unwrap();
        }
        for t in &body.mesh.triangles {
            writeln!(f, "f {} {} {}", t[0] + 1, t[1] + 1, t[2] + 1).unwrap();
        }
    }
    let pattern = if let Some(p) = &project {
        (*p.document.pattern).clone()
    } else {
        toile::io::garmentcode::read(
            &std::fs::read(format!("{data}/patterns/garmentcode/{name}_specification.json")).unwrap(),
        )
        .unwrap()
    };
    let t0 = std::time::Instant::now();
    let (garment, problems) = build(&pattern, edge);
    println!("{problems:?}");
    println!(
        "triangles {} vertices {} build {:?}",
        garment.triangles.len(),
        garment.vertex_count,
        t0.elapsed()
    );
    let settings = RelaxSettings::default();
    let marks = project
        .as_ref()
        .map(|p| (*p.document.marks).clone())
        .unwrap_or_else(|| toile::wrap::suggested(&pattern, &surface, settings.offset * surface.scale()));
    for (c, b) in marks.pairs() {
        println!(
            "mark {} {} -> {} {}  {} pts",
            c.piece,
            c.points[0],
            b.points[0],
            b.points.last().unwrap(),
            b.points.len()
        );
    }
    let garment = Arc::new(garment);
    let t0 = std::time::Instant::now();
    let (d, mut state, problems) = Dressing::new(garment.clone(), surface.clone(), &marks, settings);
    println!("{problems:?}");
    let mut d = d.unwrap();
    println!("{:?}", d.stretches.iter().map(|s| s.stretch()).collect::<Vec<_>>());
    let mut ticks = 0;
    let mut prev = state.clone();
    let mut grown = false;
    while d.step(&mut state) != Phase::AtRest {
        ticks += 1;
        let mv = state
            .positions
            .iter()
            .zip(&prev.positions)
            .zip(&prev.mapped)
            .filter(|(_, m)| **m)
            .map(|((a, b), _)| (*a - *b).length())
            .fold(0.0, f64::max);
        let all = state.mapped.iter().all(|m| *m);
        if all && !grown {
            grown = true;
            write("/tmp/try/grown.obj", &garment, &state);
        }
        if ticks % 20 == 0 {
            let s = if all { strains(&garment, &state) } else { vec![0.0] };
            println!(
                "{ticks} {:?} moved {mv:.6} p99 {:.4} med {:.4} lowest {:.5} {:?}",
                d.phase(),
                quantile(&s, 0.99),
                quantile(&s, 0.5),
                if all { lowest(&surface, &state) } else { 0.0 },
                t0.elapsed()
            );
        }
        if std::env::var("SHOTS").is_ok() && ticks % 5 == 0 {
            write(&format!("/tmp/try/t{ticks:03}.obj"), &garment, &state);
        }
        prev = state.clone();
        if ticks > 600 {
            break;
        }
    }
    println!("{ticks} {:?} {:?}", t0.elapsed(), d.counters());
    write(&format!("/tmp/try/{name}.obj"), &garment, &state);
}
