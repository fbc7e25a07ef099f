//! Time of what a user waits for: sewing, wrapping and relaxing the samples; and of the kernels below it.
//!
//! `cargo bench` prints medians; before them one line per sample with triangles, ticks, threads and the state's hash, so
//! that a faster run that gives another result does not pass for a gain.

use std::sync::Arc;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use glam::DVec3;
use toile::body::{Surface, mannequin};
use toile::cloth::{ClothState, build};
use toile::session::samples::Sample;
use toile::sim::hash::cloth_hash;
use toile::wrap::{Dressing, Phase, coarser};

/// Edge length that gives the T-shirt about 10,000 triangles, metres.
const FINE: f64 = 0.0125;

struct Scene {
    project: toile::session::Project,
    surface: Arc<Surface>,
}

impl Scene {
    fn new(sample: Sample) -> Self {
        let body = mannequin::default();
        let surface = Arc::new(Surface::new(body.mesh.clone()).expect("the mannequin has triangles"));
        Self { project: sample.project(&body), surface }
    }

    fn dressed(&self) -> (usize, usize, ClothState) {
        let document = &self.project.document;
        let (garment, _) = build(&document.pattern, FINE);
        let triangles = garment.triangles.len();
        let coarser = coarser(&document.pattern, &garment, FINE, self.surface.scale());
        let (dressing, mut state, _) = Dressing::coarse_to_fine(
            &coarser,
            Arc::new(garment),
            self.surface.clone(),
            &document.marks,
            document.settings.relax,
        );
        let mut dressing = dressing.expect("the matrix fits in memory");
        let mut ticks = 1;
        while dressing.step(&mut state) != Phase::AtRest {
            ticks += 1;
        }
        (triangles, ticks, state)
    }
}

fn samples(c: &mut Criterion) {
    let mut group = c.benchmark_group("wrap and relax to rest");
    group.sample_size(10).measurement_time(Duration::from_secs(8));
    for sample in Sample::ALL {
        let scene = Scene::new(sample);
        let (triangles, ticks, state) = scene.dressed();
        println!(
            "{}: {triangles} triangles, {ticks} ticks, {} threads, hash {:016x}",
            sample.name(),
            rayon::current_num_threads(),
            cloth_hash(&state, Some(Phase::AtRest), true)
        );
        group.bench_function(sample.file_stem(), |b| b.iter(|| scene.dressed()));
    }
    group.finish();
}

fn kernels(c: &mut Criterion) {
    let scene = Scene::new(Sample::Tshirt);
    c.bench_function("triangulate and sew the T-shirt", |b| {
        b.iter(|| build(&scene.project.document.pattern, FINE));
    });
    let (lower, upper) = scene.surface.bounds();
    let points: Vec<DVec3> = (0..1000)
        .map(|i| {
            let at = |k: i32| f64::from((i * k) % 1009) / 1009.0;
            let near = scene.surface.nearest(lower + (upper - lower) * DVec3::new(at(7), at(31), at(101)));
            near.point + near.normal * 0.005
        })
        .collect();
    c.bench_function("1000 nearest points 5 mm above the skin", |b| {
        b.iter(|| points.iter().map(|&p| scene.surface.nearest(p).distance).sum::<f64>());
    });
}

criterion_group!(benches, samples, kernels);
criterion_main!(benches);
